"""Closed: the equations with their inputs put in, so that only time is left of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from numbers import Real
from typing import Any

import casadi as ca
import numpy as np

from ..components.base import ModelError, Sampled, nearest, numpy_on_symbols
from .compiled import Compiled, dense
from .dae import DAE, Input
from .stepper import Stepper, Tolerance
from .switchfunctions import SwitchFunctions
from .vectors import pick


class Closed:
    """A DAE as functions of (x, z, q, t), q being all that is constant within a segment.

    Sampled inputs enter at MX level, around the SX equations; everything else stays SX.
    """

    def __init__(self, dae: DAE, signals: Mapping[str, Any]) -> None:
        self.dae = dae
        self.signals = signals
        self._steppers: dict[tuple[str, Tolerance, int], Stepper] = {}
        self._tangents: dict[tuple[tuple[int, ...], bool], Any] = {}
        self.sampled = any(isinstance(s, Sampled) for s in self.signals.values())
        kind: Any = ca.MX if self.sampled else ca.SX
        self.x: Any = kind.sym("x", dae.x.numel()) if self.sampled else dae.x
        self.z: Any = kind.sym("z", dae.z.numel()) if self.sampled else dae.z
        self.q: Any = kind.sym("q", dae.constants.numel()) if self.sampled else dae.constants
        self.t: Any = kind.sym("t") if self.sampled else dae.time
        self.u = ca.densify(ca.vertcat(kind(0, 1), *[self._input(i) for i in dae.inputs]))

    def _input(self, declared: Input) -> Any:
        signal = self.signals[declared.path]
        value = _traced(declared.path, signal, self.t)
        for _ in range(declared.order):
            value = ca.jacobian(value, self.t)
        return declared.sign * value

    def close(self, expression: Any) -> Any:
        """Put the inputs into an expression of the DAE's symbols."""
        dae = self.dae
        if self.sampled:
            inner = ca.Function("inner", dae.arguments(), [expression])
            return inner(self.x, self.z, self.u, self.q, self.t)
        if not dae.inputs:
            return expression
        return ca.substitute(expression, dae.u, self.u)

    def function(self, name: str, *closed: Any) -> Any:
        """Return a function of (x, z, q, t) of expressions that are already closed."""
        return ca.Function(name, [self.x, self.z, self.q, self.t], list(closed))

    def compiled(self, name: str, *closed: Any, instants: int = 0) -> Compiled:
        """Return such a function on NumPy buffers; for many `instants` at once, q being common."""
        function = self.function(name, *dense(*closed))
        if instants:
            function = function.map(f"{name}_map", "serial", instants, [2], [])
        return Compiled(function)

    def evaluator(self, *expressions: Any) -> Any:
        """Return a function of (x, z, q, t) of expressions in the DAE's symbols."""
        joined = ca.vertcat(*expressions)
        return self.function("evaluate", self.close(joined))

    def tangent(self, variables: tuple[int, ...], algebraic: bool) -> Any:
        """Return a function of joined variables (and algebraic residuals) and their slopes in x and z."""
        key = variables, algebraic
        if key not in self._tangents:
            values = pick(self.dae.variables, variables)
            values = self.close(ca.vertcat(values, self.dae.alg) if algebraic else values)
            slopes = ca.jacobian(values, self.x), ca.jacobian(values, self.z)
            self._tangents[key] = self.function("tangent", values, *slopes)
        return self._tangents[key]

    def rate(self, closed: Any) -> Any:
        """Return the time derivative of a closed expression along the motion."""
        motion = self.close(self.dae.ode)
        moved = ca.jtimes(closed, self.x, motion) + ca.jacobian(closed, self.t)
        if not self.dae.z.numel():
            return moved
        residual = self.close(self.dae.alg)
        drift = ca.jtimes(residual, self.x, motion) + ca.jacobian(residual, self.t)
        return moved - ca.jtimes(closed, self.z, ca.solve(ca.jacobian(residual, self.z), drift))

    @cached_property
    def switch_functions(self) -> SwitchFunctions:
        """The compiled functions of the event loop."""
        return SwitchFunctions(self)

    def stepper(self, solver: str, tolerance: Tolerance, nodes: int) -> Stepper:
        """Return a compiled integrator, made once for each choice."""
        key = (solver, tolerance, nodes)
        if key not in self._steppers:
            self._steppers[key] = Stepper(self, solver, tolerance, nodes)
        return self._steppers[key]


def chosen_signals(dae: DAE, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the signal of every input: the run's own, else the one bound to the component."""
    names = dae.input_names
    problems = [f"there is no input '{name}'{nearest(name, names)}" for name in given if name not in names]
    chosen = {}
    for declared in dae.inputs:
        if declared.order:
            continue
        signal = given.get(declared.path, declared.signal)
        if signal is None:
            problems.append(
                f"input '{declared.path}' [{declared.unit}] has no signal; connect it, bind it, or "
                f"give inputs={{'{declared.path}': ...}}"
            )
        chosen[declared.path] = Sampled(*signal) if isinstance(signal, tuple) else signal
    if problems:
        raise ModelError(f"'{dae.name}' cannot run:", problems)
    return chosen


def _traced(path: str, signal: Any, t: Any) -> Any:
    if isinstance(signal, Sampled):
        return signal.interpolant("signal")(t)
    if isinstance(signal, Real) and np.isfinite(float(signal)):
        return type(t)(float(signal))
    if isinstance(signal, Callable):  # type: ignore[arg-type]
        return _called(path, signal, t)
    raise ModelError(
        f"input '{path}' takes a finite number, a function of time, a Sampled or (time, values), "
        f"got {signal!r}"
    )


def _called(path: str, function: Any, t: Any) -> Any:
    try:
        with numpy_on_symbols():
            value = type(t)(function(t))
    except Exception as error:
        told = str(error).partition("\n")[0]
        raise ModelError(
            f"input '{path}': the function of time could not be read ({told}); write it with CasADi "
            "or NumPy functions (`ca.sin`, `ca.if_else`), or give Sampled data"
        ) from error
    if value.numel() != 1:
        raise ModelError(f"input '{path}': the function of time must return one number, got {value.shape}")
    return value
