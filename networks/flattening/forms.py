"""`Form`: one equation in local symbols, which many equations of a network share.

Whatever is done to an equation symbolically (differentiate it, solve it for a variable) is done once for all
equations of its form.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...components.language import calls, slopes_of
from .vectors import column, pick


@dataclass(eq=False)
class Form:
    """An equation `residual = 0`.

    Args:
        residual: SX scalar in `locals`, `given` and `time`.
        locals: SX vector (n,) of the variables in it.
        given: SX vector (k,) of parameters, modes and impulses in it.
        modes: those of `given` that are modes.
        time: SX scalar.
        slopes: the residual's slope in each local symbol.
    """

    residual: Any
    locals: Any
    given: Any = field(default_factory=lambda: ca.SX(0, 1))
    modes: Any = field(default_factory=lambda: ca.SX(0, 1))
    time: Any = field(default_factory=lambda: ca.SX.sym("time"))
    slopes: list[Any] = field(default_factory=list)
    _known: dict[tuple[int, ...], Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not self.slopes:
            self.slopes = slopes_of(self.residual, self.locals).nonzeros()

    @cached_property
    def numbers(self) -> NDArray[np.float64]:
        """The slopes that are numbers, NaN for the others."""
        return np.array([float(s) if s.is_constant() else np.nan for s in self.slopes])

    @cached_property
    def calls(self) -> bool:
        """Whether it calls a function."""
        return calls(self.residual)

    def function(self, *expressions: Any) -> Any:
        """Return expressions of local symbols as a function of locals, given and time."""
        return ca.Function("form", [self.locals, self.given, self.time], list(expressions))

    def is_hybrid(self, expression: Any) -> bool:
        """Tell whether a number or an expression of local symbols depends on a mode."""
        if isinstance(expression, float) or not self.modes.numel():
            return False
        return bool(ca.depends_on(expression, self.modes))

    def slope(self, pattern: tuple[int, ...]) -> Any | None:
        """Return the slope in the variable that some local symbols stand for, None if it depends on that.

        A number, or SX in local symbols; `pattern` as for `Family.solved`.
        """
        if pattern not in self._known:
            places = [i for i, sign in enumerate(pattern) if sign]
            slope: Any = float(sum(pattern[i] * self.numbers[i] for i in places))
            if np.isnan(slope):
                slope = sum(pattern[i] * self.slopes[i] for i in places)
                slope = None if ca.depends_on(slope, pick(self.locals, places)) else slope
            self._known[pattern] = slope
        return self._known[pattern]

    def solution(self, slope: Any) -> Any:
        """Return what a variable is by the equation, zero for itself in it, by the residual's slope in it."""
        if isinstance(slope, float) and abs(slope) == 1:
            return self.residual if slope < 0 else -self.residual
        return -self.residual / slope

    def differentiated(self) -> tuple[Form, list[int], list[int]]:
        """Return the form of the residual's time derivative.

        Of (form, again, moved) the symbols are the local ones numbered `again`, then the derivatives of
        those numbered `moved`.
        """
        rates = ca.vertcat(*[ca.SX.sym(f"der({symbol.name()})") for symbol in self.locals.elements()])
        if not np.isnan(self.numbers).any() and not ca.depends_on(self.residual, self.time):
            slope = ca.dot(ca.DM(self.numbers), rates)
            form = Form(slope, rates, self.given, self.modes, self.time, self.slopes)
            return form, [], [*range(rates.numel())]
        slope = ca.jtimes(self.residual, self.locals, rates) + ca.jacobian(self.residual, self.time)
        moved, again = (ca.jacobian_sparsity(slope, v).get_col() for v in (rates, self.locals))
        locals_ = column([pick(self.locals, again), pick(rates, moved)])
        return Form(slope, locals_, self.given, self.modes, self.time), again, moved
