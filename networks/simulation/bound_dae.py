"""`BoundDAE`: the equations with their inputs put in, so that only time is left of them."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from contextvars import ContextVar
from functools import cache, cached_property, partial
from hashlib import sha256
from itertools import accumulate, pairwise, starmap
from numbers import Real
from threading import get_ident
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...base import Array, ModelError, named
from ...components.language import Sampled, calls
from ..dae import DAE, Input
from ..evaluation.compiled import Batch, Compiled, dense
from ..flattening.vectors import pick, stacked
from .events.functions import SwitchFunctions
from .events.shocks import Shocks
from .input_signals import Polynomial, SignalKey, chosen_signals, input_value
from .integrator import Stepper
from .legs import Leg, legs_of, together
from .splines import sampled_at
from .time_signals import TimeSignals, timed_rows

if TYPE_CHECKING:
    from ..csource.native import Native
    from ..csource.native_program import NativeProgram

CACHED_BINDINGS, CACHED_LEGS = 4, 64  # bindings of a DAE, and legs, that are kept
BINDING_THREAD: ContextVar[int] = ContextVar(
    "BINDING_THREAD", default=0
)  # for which it goes on, if not itself
_LEGS: dict[tuple[Any, ...], list[Leg]] = {}  # where equations hold signals as given


class BoundDAE:
    """A DAE as functions of (x, z, q, t), q being all that is constant within a segment.

    Sampled inputs enter at MX level, around the SX equations; everything else stays SX.
    """

    def __init__(self, dae: DAE, signals: Mapping[str, Any]) -> None:
        self.dae, self.signals = dae, signals
        self.given: list[tuple[Input, Any]] = [(i, signals[i.path]) for i in dae.inputs]
        self.sampled = any(isinstance(s, Sampled) for s in signals.values())
        self._constant, self.courses = dae.constants.numel(), _courses(dae.constants.numel(), signals)
        added = sum(place.stop - place.start for place in self.courses.values())
        symbols: list[Any] = [dae.x, dae.z, stacked(dae.constants, ca.SX.sym("course", added)), dae.time]
        if self.sampled:
            symbols = [ca.MX.sym(name, each.numel()) for name, each in zip("xzqt", symbols, strict=True)]
        self.x, self.z, self.q, self.t = symbols
        self.u = ca.densify(ca.vertcat(type(self.x)(0, 1), *starmap(self._input, self.given)))
        self._legs: dict[tuple[Any, ...], list[Leg]] = {}
        # Made once for each choice of arguments.
        self.stepper = cache(partial(Stepper, self))
        self.signal, self.moving_signal = cache(self._signal), cache(self._moving_signal)
        self.tangent = cache(self._tangent)

    def _input(self, declared: Input, signal: Any) -> Any:
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

    def _signal(self, name: str) -> Batch:
        """Return a function of (x, z, u, q, t), at many points, of a signal by its full name."""
        expression = ca.densify(self.dae.expression(name))
        return Batch(ca.Function("signal", self.dae.arguments(), [expression]))

    def _moving_signal(self, name: str) -> Batch:
        """Return a function of (x, z, q, t), at many points, of a signal and its rate."""
        value = self.close(ca.densify(self.dae.expression(name)))
        return Batch(self.function("moving", *dense(value, self.rate(value))))

    @cached_property
    def motion(self) -> Batch:
        """A function of (x, z, q, t), at many points: the rates of the states."""
        return Batch(self.function("motion", *dense(self.close(self.dae.ode))))

    def input_values(self, q: Array, times: Array) -> Array:
        """Return inputs and their derivatives, (instants, inputs); `q` is given for each instant, too."""
        values = np.empty((len(times), len(self.dae.inputs)))
        if self._others:
            values[:, self._others] = self._other_inputs(q, times[:, None])[0][:, :, 0]
        for k, (declared, signal) in enumerate(self.given):
            if isinstance(signal, Sampled):
                values[:, k] = declared.sign * sampled_at(signal, times, declared.order)
            elif isinstance(signal, Real):
                values[:, k] = 0.0 if declared.order else declared.sign * float(signal)
        return values

    @cached_property
    def _others(self) -> list[int]:
        """Places of the inputs that are neither records nor numbers."""
        return [k for k, (_, signal) in enumerate(self.given) if not isinstance(signal, Sampled | Real)]

    @cached_property
    def _other_inputs(self) -> Batch:
        values = [self._input(*self.given[k]) for k in self._others]
        return Batch(ca.Function("inputs", [self.q, self.t], [ca.densify(ca.vertcat(*values))]))

    def _tangent(self, variables: tuple[int, ...], algebraic: bool) -> Compiled:
        """Return a function of joined variables (and algebraic residuals) and their slopes in x and z."""
        values = pick(self.dae.variables, variables)
        values = self.close(ca.vertcat(values, self.dae.alg) if algebraic else values)
        return self.compiled("tangent", values, ca.jacobian(values, self.x), ca.jacobian(values, self.z))

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
    def functions(self) -> dict[str, Any]:
        """The signals that are neither numbers nor data: a compiled program has them built in."""
        return {path: s for path, s in self.signals.items() if not isinstance(s, Sampled | Real)}

    @cached_property
    def read(self) -> dict[int, Any]:
        """By place, the inputs that can be read as expressions of time."""
        found = {}
        for k, (declared, signal) in enumerate(self.given):
            if not isinstance(signal, Sampled | Polynomial):
                with suppress(ModelError):
                    found[k] = ca.densify(input_value(declared, signal, self.dae.time))
        return found

    @cached_property
    def formulas(self) -> dict[int, Any]:
        """Those of them that are formulas of time alone; all other inputs are known by their numbers.

        An expression that calls a function, such as an interpolant, tells no more than these, and where it
        switches itself.
        """
        return {k: expression for k, expression in self.read.items() if not calls(expression)}

    @cached_property
    def mark(self) -> str:
        """What tells most networks and their functions apart, at next to no cost."""
        dae = self.dae
        sizes = [s.numel() for s in (dae.x, dae.z, dae.u, dae.p, dae.modes, dae.switching.expressions)]
        told = dae.name, sizes, len(dae.switching.changes), sorted(self.functions)
        return sha256(repr(told).encode()).hexdigest()[:12]

    @cached_property
    def program(self) -> NativeProgram:
        """The network as C, with its functions built in."""
        from ..csource.native_program import program_of

        return program_of(self)

    @cached_property
    def native(self) -> Native:
        """The program, compiled and loaded."""
        from ..csource.native import Native

        return Native(self)

    @cached_property
    def timed_rows(self) -> Any:
        """What the equations hold that depends on time, inputs and parameters alone, as SX."""
        signals = [signal for _, signal in self.given]
        still = tuple(k for k, signal in enumerate(signals) if isinstance(signal, Real))
        given = tuple(k for k, s in enumerate(signals) if k not in still and not isinstance(s, Polynomial))
        drawn = tuple(k for k in given if k not in self.formulas)
        known, key = self.dae.timed, (given, still, drawn, bool(self.courses))
        if key not in known:
            known[key] = timed_rows(self.dae, *key)
        return known[key]

    def legs(self, q: Array, begin: float, stop: float) -> list[Leg]:
        """Return the parts of a run between the instants at which inputs switch; found once for each run."""
        parameters = q[: self.dae.p.numel()]
        parts = []
        for told, signals in TimeSignals(self, parameters, begin, stop).apart():
            known = self._legs if told is None else _LEGS
            key = told or (parameters.tobytes() if signals.is_led else b"")
            parts.append(_known_legs(known, key, signals, begin, stop))
        return together(parts) if parts else [Leg(begin, stop)]


def bound(dae: DAE, inputs: Mapping[str, Any]) -> BoundDAE:
    """Return a DAE with input signals put in; the last few of each thread are kept, compiled.

    Raises:
        ModelError: for unknown inputs and for inputs without a signal.
    """
    chosen = chosen_signals(dae, named("inputs", inputs))
    known, key = dae.bindings, (BINDING_THREAD.get() or get_ident(), SignalKey(chosen))
    binding = known[key] = known.pop(key, None) or BoundDAE(dae, chosen)
    if len(known) > CACHED_BINDINGS:
        del known[next(iter(known))]
    return binding


def _known_legs(
    known: dict[Any, list[Leg]], told: Any, signals: TimeSignals, begin: float, stop: float
) -> list[Leg]:
    key = begin, stop, told
    legs = known[key] = known.pop(key, []) or legs_of(signals, begin, stop)
    if len(known) > CACHED_LEGS:
        known.pop(next(iter(known)), None)
    return legs


def _courses(first: int, signals: Mapping[str, Any]) -> dict[str, slice]:
    """Return where in q the instant and the coefficients of each polynomial input stand."""
    sizes = {path: s.degree + 2 for path, s in signals.items() if isinstance(s, Polynomial)}
    spans = pairwise(accumulate(sizes.values(), initial=first))
    return dict(zip(sizes, starmap(slice, spans), strict=True))
