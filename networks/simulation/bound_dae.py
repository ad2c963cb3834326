"""`BoundDAE`: the equations with their inputs put in, so that only time is left of them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from threading import get_ident
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...base import Array, ModelError, named
from ...components.language import Sampled
from ..dae import DAE, Input
from ..evaluation.compiled import Batch, Compiled, dense
from ..flattening.vectors import pick, stacked
from .events.functions import SwitchFunctions
from .events.shocks import Shocks
from .input_signals import Given, chosen_signals, input_value
from .integrator import Stepper
from .legs import Leg, legs_of
from .polynomial import Polynomial
from .splines import sampled_at
from .time_signals import TimeSignals, timed_rows
from .tolerance import Tolerance

if TYPE_CHECKING:
    from ..csource.native import Native

BINDINGS, LEGS_KEPT = 4, 64  # bindings of a DAE, and legs, that are kept
_LEGS: dict[tuple[Any, ...], list[Leg]] = {}  # where equations hold signals as given


class BoundDAE:
    """A DAE as functions of (x, z, q, t), q being all that is constant within a segment.

    Sampled inputs enter at MX level, around the SX equations; everything else stays SX.
    """

    def __init__(self, dae: DAE, signals: Mapping[str, Any]) -> None:
        self.dae = dae
        self.signals = signals
        self._steppers: dict[tuple[str, Tolerance, int, int], Stepper] = {}
        self._tangents: dict[tuple[tuple[int, ...], bool], Any] = {}
        self._evaluators: dict[str, Batch] = {}
        self._legs: dict[tuple[Any, ...], list[Leg]] = {}
        self.sampled = any(isinstance(s, Sampled) for s in self.signals.values())
        kind: Any = ca.MX if self.sampled else ca.SX
        constants = dae.constants
        self._constant, self.courses = constants.numel(), _courses(constants.numel(), signals)
        added = sum(place.stop - place.start for place in self.courses.values())
        self.x: Any = kind.sym("x", dae.x.numel()) if self.sampled else dae.x
        self.z: Any = kind.sym("z", dae.z.numel()) if self.sampled else dae.z
        self.q: Any = (
            kind.sym("q", self._constant + added)
            if self.sampled
            else stacked(constants, ca.SX.sym("course", added))
        )
        self.t: Any = kind.sym("t") if self.sampled else dae.time
        self.u = ca.densify(ca.vertcat(kind(0, 1), *[self._input(i) for i in dae.inputs]))

    def _input(self, declared: Input) -> Any:
        signal = self.signals[declared.path]
        if isinstance(signal, Polynomial):
            signal = signal.along(self.q[self.courses[declared.path]])
        return input_value(declared, signal, self.t)

    def blank(self, numbers: Array) -> Array:
        """Return the constants of a run that has not begun: numbers of the parameters, then zeros."""
        return np.concatenate([numbers, np.zeros(self.q.numel() - len(numbers))])

    def close(self, expression: Any) -> Any:
        """Put the inputs into an expression of the DAE's symbols."""
        dae = self.dae
        if self.sampled:
            inner = ca.Function("inner", dae.arguments(), [expression])
            return inner(self.x, self.z, self.u, self.q[: self._constant], self.t)
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

    def signal(self, name: str) -> Batch:
        """Return a function of (x, z, u, q, t), at many points, of a signal by its full name, made once."""
        if name not in self._evaluators:
            expression = ca.densify(self.dae.expression(name))
            self._evaluators[name] = Batch(ca.Function("signal", self.dae.arguments(), [expression]))
        return self._evaluators[name]

    def moving_signal(self, name: str) -> Batch:
        """Return a function of (x, z, q, t), at many points, of a signal and its rate, made once."""
        if (key := f"moving {name}") not in self._evaluators:
            value = self.close(ca.densify(self.dae.expression(name)))
            self._evaluators[key] = Batch(self.function("moving", *dense(value, self.rate(value))))
        return self._evaluators[key]

    @cached_property
    def motion(self) -> Batch:
        """A function of (x, z, q, t), at many points: the rates of the states."""
        return Batch(self.function("motion", *dense(self.close(self.dae.ode))))

    def input_values(self, q: Any, times: Any) -> Any:
        """Return the inputs and their derivatives at instants, (instants, inputs).

        Args:
            q: what is constant within a segment, at the instants, (instants, constants).
            times: the instants.
        """
        values = np.empty((len(times), len(self.dae.inputs)))
        if self._others:
            values[:, self._others] = self._other_inputs(q, times[:, None])[0][:, :, 0]
        for k, declared in enumerate(self.dae.inputs):
            if k not in self._others:
                signal = self.signals[declared.path]
                values[:, k] = declared.sign * sampled_at(signal, times, declared.order)
        return values

    @cached_property
    def _others(self) -> list[int]:
        """Places of the inputs that are no records."""
        return [k for k, i in enumerate(self.dae.inputs) if not isinstance(self.signals[i.path], Sampled)]

    @cached_property
    def _other_inputs(self) -> Batch:
        return Batch(ca.Function("inputs", [self.q, self.t], [pick(self.u, self._others)]))

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

    @cached_property
    def shocks(self) -> Shocks | None:
        """What jumps of prescribed motions do, if there are motions that may jump."""
        return Shocks(self, self.dae.jumps) if self.dae.jumps is not None else None

    @cached_property
    def native(self) -> Native:
        """The network as a compiled program."""
        from ..csource.native import Native

        return Native(self)

    def formula(self, place: int, t: Any) -> Any:
        """Return one of the DAE's inputs as an SX expression of time, None if only its numbers are known."""
        declared = self.dae.inputs[place]
        signal = self.signals[declared.path]
        if isinstance(signal, Sampled | Polynomial):
            return None
        try:
            return input_value(declared, signal, t)
        except ModelError:
            return None

    @cached_property
    def timed_rows(self) -> Any:
        """What the equations hold that depends on time, inputs and parameters alone, as SX."""
        given = [k for k, i in enumerate(self.dae.inputs) if not isinstance(self.signals[i.path], Polynomial)]
        return timed_rows(self.dae, given, watched=bool(self.courses))

    def legs(self, q: Array, begin: float, stop: float) -> list[Leg]:
        """Return the parts of a run between the instants at which inputs switch; found once for each run."""
        parameters = q[: self.dae.p.numel()]
        signals = TimeSignals(self, parameters, begin, stop)
        known = _LEGS
        given = {
            (k, self.dae.inputs[k].order): self.signals[self.dae.inputs[k].path] for k in signals.plain or ()
        }
        key: tuple[Any, ...] = begin, stop, Given(given)
        if signals.plain is None:
            known = self._legs
            key = begin, stop, parameters.tobytes() if ca.depends_on(self.timed_rows, self.dae.p) else b""
        if key not in known:
            known[key] = legs_of(signals, begin, stop)
            if len(known) > LEGS_KEPT:
                known.pop(next(iter(known)), None)
        return known[key]

    def stepper(self, solver: str, tolerance: Tolerance, nodes: int, most_steps: int) -> Stepper:
        """Return a compiled integrator, made once for each choice."""
        key = (solver, tolerance, nodes, most_steps)
        if key not in self._steppers:
            self._steppers[key] = Stepper(self, *key)
        return self._steppers[key]


def bound(dae: DAE, inputs: Mapping[str, Any]) -> BoundDAE:
    """Return a DAE with input signals put in; the last few of each thread are kept, compiled.

    Raises:
        ModelError: for unknown inputs and for inputs without a signal.
    """
    chosen = chosen_signals(dae, named("inputs", inputs))
    known, key = dae.bindings, (get_ident(), Given(chosen))
    binding = known[key] = known.pop(key, None) or BoundDAE(dae, chosen)
    if len(known) > BINDINGS:
        del known[next(iter(known))]
    return binding


def _courses(first: int, signals: Mapping[str, Any]) -> dict[str, slice]:
    """Return where in q the instant and the coefficients of each polynomial input stand."""
    places = {}
    for path, signal in signals.items():
        if isinstance(signal, Polynomial):
            places[path] = slice(first, first + signal.degree + 2)
            first = places[path].stop
    return places
