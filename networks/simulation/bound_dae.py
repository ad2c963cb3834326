"""Closed: the equations with their inputs put in, so that only time is left of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...base import ModelError, is_number, nearest, numpy_on_symbols
from ...components.language import RealInput, Sampled
from ..dae import DAE, Input
from ..flattening.vectors import pick, stacked
from .batch import Batch
from .compiled import Compiled, dense
from .events.functions import SwitchFunctions
from .events.shocks import Shocks
from .integrator import Stepper
from .legs import Leg, legs_of
from .polynomial import Polynomial
from .splines import SMOOTHNESS, curvature, sampled_at, traced
from .time_signals import TimeSignals, timed_rows
from .tolerance import Tolerance

if TYPE_CHECKING:
    from ..csource.native import Native

Array = NDArray[np.float64]
KEPT = 64
_LEGS: dict[tuple[Any, ...], list[Leg]] = {}  # where equations hold signals as given


class Closed:
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

    def evaluator(self, *expressions: Any) -> Any:
        """Return a function of (x, z, q, t) of expressions in the DAE's symbols."""
        joined = ca.vertcat(*expressions)
        return self.function("evaluate", self.close(joined))

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
            if len(known) > KEPT:
                known.pop(next(iter(known)), None)
        return known[key]

    def stepper(self, solver: str, tolerance: Tolerance, nodes: int, most_steps: int) -> Stepper:
        """Return a compiled integrator, made once for each choice."""
        key = (solver, tolerance, nodes, most_steps)
        if key not in self._steppers:
            self._steppers[key] = Stepper(self, *key)
        return self._steppers[key]


class Given:
    """Signals by name as a key: equal numbers and polynomials are the same, anything else only itself."""

    def __init__(self, signals: Mapping[Any, Any]) -> None:
        self._signals = [*signals.items()]
        plain = Real, Polynomial
        self._told = tuple((name, s if isinstance(s, plain) else id(s)) for name, s in self._signals)

    def __hash__(self) -> int:
        return hash(self._told)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Given) and self._told == other._told


def _courses(first: int, signals: Mapping[str, Any]) -> dict[str, slice]:
    """Return where in q the instant and the coefficients of each polynomial input stand."""
    places = {}
    for path, signal in signals.items():
        if isinstance(signal, Polynomial):
            places[path] = slice(first, first + signal.degree + 2)
            first = places[path].stop
    return places


def chosen_signals(dae: DAE, given: Mapping[str, Any], free: bool = False) -> dict[str, Any]:
    """Return the signal of every input: the run's own, else the one bound to the component.

    An input without a signal is a problem, or, if it may be `free`, left out.
    """
    names = dae.input_names
    problems = [f"there is no input '{name}'{_meant(dae, name)}" for name in given if name not in names]
    chosen = {}
    for declared in dae.inputs:
        if declared.order:
            continue
        signal = given.get(declared.path, declared.signal)
        if signal is None and free:
            continue
        if signal is None:
            problems.append(
                f"input '{declared.path}' [{declared.unit}] has no signal; connect it, bind it, or "
                f"give inputs={{'{declared.path}': ...}}"
            )
        try:
            chosen[declared.path] = _smooth_enough(dae, declared.path, signal)
        except ModelError as error:
            problems.append(f"input '{declared.path}': {error}")
    if problems:
        raise ModelError(f"'{dae.name}' cannot run:", problems)
    return chosen


def _meant(dae: DAE, name: str) -> str:
    """Return the input that was meant, or why it may be missing, or all inputs."""
    names = dae.input_names
    component, _, field = name.rpartition(".")
    instance = dae.system.flat.instances.get(component)
    if instance is not None and isinstance(type(instance.component).fields.get(field), RealInput):
        return "; it is connected to a signal of the network"
    return nearest(name, names) or f"; the inputs are {', '.join(names) or 'none'}"


def _smooth_enough(dae: DAE, path: str, signal: Any) -> Any:
    """Return a signal, of a pair (time, values) what it means, if it has the derivatives that are needed."""
    made = Sampled(*_pair(signal)) if isinstance(signal, tuple) else signal
    if isinstance(made, Sampled):
        order = max(declared.order for declared in dae.inputs if declared.path == path)
        if order > SMOOTHNESS[made.interpolation]:
            raise ModelError(
                f"its derivative of order {order} is needed, which {made.interpolation} data do not have; "
                "give them as cubic, or a function of time"
            )
    return made


def _pair(signal: tuple[Any, ...]) -> tuple[Any, Any]:
    if len(signal) != 2:
        raise ModelError(f"a sampled signal is a pair (time, values), got {len(signal)} items")
    return signal[0], signal[1]


def input_value(declared: Input, signal: Any, t: Any) -> Any:
    """Return an input, or the derivative that it is, as an expression of time.

    Raises:
        ModelError: for what is no signal, by the name of its input.
    """
    curved = isinstance(signal, Sampled) and declared.order >= 2
    value = curvature(signal)(t) if curved else _traced(declared.path, signal, t)
    for _ in range(declared.order - 2 * curved):
        value = ca.jacobian(value, t)
    return declared.sign * value


def _traced(path: str, signal: Any, t: Any) -> Any:
    if isinstance(signal, Sampled):
        return traced(signal)(t)
    if is_number(signal):
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
            value, again = type(t)(function(t)), type(t)(function(t))
    except Exception as error:
        told = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
        raise ModelError(
            f"input '{path}': the function of time could not be read ({told}); write it with CasADi "
            "or NumPy functions (`ca.sin`, `ca.if_else`), or give Sampled data"
        ) from error
    if value.numel() != 1:
        raise ModelError(f"input '{path}': the function of time must return one number, got {value.shape}")
    if value.is_constant() and not np.isfinite(float(value)):
        raise ModelError(
            f"input '{path}': the function of time must return a finite number, got {float(value)}"
        )
    if not _same(value, again):
        raise ModelError(
            f"input '{path}': the function of time is read once, as a formula, and this one returns another "
            "each time; draw random numbers beforehand and give them as Sampled(time, values)"
        )
    return value


def _same(one: Any, other: Any) -> bool:
    """Tell whether two expressions of time, and of the coefficients of a polynomial, are equal in numbers."""
    both = [ca.densify(one), ca.densify(other)]
    symbols = ca.symvar(ca.vertcat(*both))
    values = ca.Function("values", symbols, both)
    pairs = (
        [m.full() for m in values.call([ca.DM(at + k) for k in range(len(symbols))])]
        for at in (0.1, 1.7, 23.0)
    )
    return all(np.array_equal(first, second, equal_nan=True) for first, second in pairs)
