"""Families of equations: one residual in local symbols, many instances.

All instances of one component class share their equations, so that whatever is done to an equation
symbolically (differentiate it, solve it for a variable) is done once and then evaluated for all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from .vectors import column, pick

Ints = NDArray[np.int64]


@dataclass(eq=False)
class Family:
    """N equations `residual = 0` of one form.

    Args:
        residual: SX scalar in `locals`, `given` and `time`.
        locals: SX vector (n,) of the variables in it.
        given: SX vector (k,) of parameters, modes and impulses in it.
        time: SX scalar.
        columns: (N, n), the variable each local symbol stands for, per instance.
        signs: (N, n), its sign.
        arguments: SX (k, N), what `given` stands for.
        label: names the component of an instance in messages.
        modes: those of `given` that are modes.
    """

    residual: Any
    locals: Any
    given: Any
    time: Any
    columns: Ints
    signs: Ints
    arguments: Any
    label: Callable[[int], str]
    modes: Any = field(default_factory=lambda: ca.SX(0, 1))
    _solved: dict[tuple[int, ...], tuple[Any, Any] | None] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.columns)

    def evaluate(self, expression: Any, rows: Ints, values: Any, time: Any) -> Any:
        """Return `expression` (of local symbols) for some instances, as an SX row.

        `values` is the SX vector of all variables.
        """
        n, count = self.columns.shape[1], len(rows)
        function = ca.Function("family", [self.locals, self.given, self.time], [expression])
        chosen = ca.reshape(values[self.columns[rows].ravel().tolist()], n, count)
        signs = self.signs[rows]
        if (signs < 0).any():
            chosen = chosen * ca.DM(signs.T)
        arguments = self.arguments[:, rows.tolist()]
        return function.map(count)(chosen, arguments, ca.repmat(time, 1, count))

    def differentiated(self, rows: Ints, derivative_of: Callable[[int], tuple[int, int]]) -> Family:
        """Return the family of the time derivatives of some instances' residuals."""
        n = self.locals.numel()
        rates = ca.vertcat(*[ca.SX.sym(f"der({self.locals[i].name()})") for i in range(n)])
        slope = ca.jtimes(self.residual, self.locals, rates) + ca.jacobian(self.residual, self.time)
        keep, again = (ca.jacobian_sparsity(slope, v).get_col() for v in (rates, self.locals))
        unique, inverse = np.unique(self.columns[rows][:, keep], return_inverse=True)
        found = np.array([derivative_of(int(c)) for c in unique], dtype=np.int64).reshape(-1, 2)
        of_rates = found[inverse.reshape(len(rows), len(keep))]
        return Family(
            slope,
            column([pick(self.locals, again), pick(rates, keep)]),
            self.given,
            self.time,
            np.hstack([self.columns[rows][:, again], of_rates[..., 0]]),
            np.hstack([self.signs[rows][:, again], self.signs[rows][:, keep] * of_rates[..., 1]]),
            self.arguments[:, rows.tolist()],
            lambda row: self.label(int(rows[row])),
            self.modes,
        )

    def chosen(self, rows: Ints) -> Family:
        """Return the family of some instances."""
        label = self.label
        return Family(
            self.residual,
            self.locals,
            self.given,
            self.time,
            self.columns[rows],
            self.signs[rows],
            self.arguments[:, rows.tolist()],
            lambda row: label(int(rows[row])),
            self.modes,
        )

    def is_hybrid(self, expression: Any) -> bool:
        """Tell whether an expression of local symbols depends on a mode."""
        return self.modes.numel() > 0 and bool(ca.depends_on(expression, self.modes))

    def solved(self, pattern: tuple[int, ...]) -> tuple[Any, Any] | None:
        """Solve for the variable that some local symbols stand for.

        Args:
            pattern: 1 or -1 for a local symbol that is the variable or its negative, else 0.

        Returns:
            (slope, offset) with residual = slope * variable + offset, or None if it is not linear.
        """
        if pattern not in self._solved:
            places = [i for i, sign in enumerate(pattern) if sign]
            stand_ins = pick(self.locals, places)
            slope = ca.jacobian(self.residual, stand_ins) @ ca.DM([pattern[i] for i in places])
            linear = not ca.depends_on(slope, stand_ins)
            offset = ca.substitute(self.residual, stand_ins, ca.DM.zeros(len(places)))
            self._solved[pattern] = (slope, offset) if linear else None
        return self._solved[pattern]


def sum_family(
    columns: Sequence[Sequence[int]], signs: Sequence[Sequence[int]], labels: Sequence[str] | str
) -> Family:
    """Return the equations that state that signed variables sum to zero."""
    symbols = ca.SX.sym("term", len(columns[0]))
    return Family(
        ca.sum1(symbols),
        symbols,
        ca.SX(0, 1),
        ca.SX.sym("time"),
        np.array(columns, dtype=np.int64),
        np.array(signs, dtype=np.int64),
        ca.SX(0, len(columns)),
        lambda row: labels if isinstance(labels, str) else labels[row],
    )
