"""Input signals: what is given for each input of a network, read as expressions of time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any

import casadi as ca
import numpy as np

from ...base import ModelError, demand, is_number, nearest, numpy_on_symbols, whole
from ...components.language import RealInput, Sampled
from ..dae import DAE, Input
from ..flattening.vectors import pick
from .splines import SMOOTHNESS, traced


@dataclass(frozen=True)
class Polynomial:
    """An input that is a polynomial of time, exchanged on the way: u = c0 + c1 (t - t0) + c2 (t - t0)^2 ...

    Its instant t0 and its coefficients are constants of a segment, so that one compiled integrator serves
    all pieces. Derivatives of the input are those of the polynomial.

    Args:
        degree: highest power.
    """

    degree: int = 1

    def __post_init__(self) -> None:
        demand("a Polynomial", degree=(self.degree, whole(0)))

    def along(self, course: Any) -> Callable[[Any], Any]:
        """Return the signal, from the symbols of its instant and coefficients."""
        falling = pick(course, range(self.degree + 1, 0, -1))
        return lambda t: ca.polyval(falling, t - course[0])


class SignalKey:
    """Signals by name as a key: equal numbers and polynomials are the same, anything else only itself."""

    def __init__(self, signals: Mapping[Any, Any]) -> None:
        self._signals = [*signals.items()]
        plain = Real, Polynomial
        self._told = tuple((name, s if isinstance(s, plain) else id(s)) for name, s in self._signals)

    def __hash__(self) -> int:
        return hash(self._told)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SignalKey) and self._told == other._told


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
    instance = dae.flat.instances.get(component)
    if instance is not None and isinstance(type(instance.component).fields.get(field), RealInput):
        return "; it is connected to a signal of the network"
    return nearest(name, names) or f"; the inputs are {', '.join(names) or 'none'}"


def _smooth_enough(dae: DAE, path: str, signal: Any) -> Any:
    """Return a signal, of a pair (time, values) what it means, if it has the derivatives that are needed."""
    if isinstance(signal, tuple) and len(signal) != 2:
        raise ModelError(f"a sampled signal is a pair (time, values), got {len(signal)} items")
    made = Sampled(*signal) if isinstance(signal, tuple) else signal
    if isinstance(made, Sampled):
        order = max(declared.order for declared in dae.inputs if declared.path == path)
        if order > SMOOTHNESS[made.interpolation]:
            raise ModelError(
                f"its derivative of order {order} is needed, which {made.interpolation} data do not have; "
                "give them as cubic, or a function of time"
            )
    return made


def input_value(declared: Input, signal: Any, t: Any) -> Any:
    """Return an input, or the derivative that it is, as an expression of time.

    Raises:
        ModelError: for what is no signal, by the name of its input.
    """
    curved = isinstance(signal, Sampled) and declared.order >= 2
    value = traced(signal, 2)(t) if curved else _traced(declared.path, signal, t)
    for _ in range(declared.order - 2 * curved):
        value = ca.jacobian(value, t)
    return declared.sign * value


def _traced(path: str, signal: Any, t: Any) -> Any:
    if isinstance(signal, Sampled):
        return traced(signal)(t)
    if is_number(signal):
        return type(t)(float(signal))
    if not callable(signal):
        raise ModelError(
            f"input '{path}' takes a finite number, a function of time, a Sampled or (time, values), "
            f"got {signal!r}"
        )
    try:
        with numpy_on_symbols():
            value, again = type(t)(signal(t)), type(t)(signal(t))
    except Exception as error:
        told = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
        raise ModelError(
            f"input '{path}': the function of time could not be read ({told}); write it with CasADi "
            "or NumPy functions (`ca.sin`, `ca.if_else`), or give Sampled data"
        ) from error
    problem = _unlike_a_formula(value, again)
    if problem:
        raise ModelError(f"input '{path}': the function of time {problem}")
    return value


def _unlike_a_formula(value: Any, again: Any) -> str:
    """Say what is wrong with what a function of time has returned twice."""
    if value.numel() != 1:
        return f"must return one number, got {value.shape}"
    if value.is_constant() and not np.isfinite(float(value)):
        return f"must return a finite number, got {float(value)}"
    if not _same(value, again):
        return (
            "is read once, as a formula, and this one returns another each time; draw random numbers "
            "beforehand and give them as Sampled(time, values)"
        )
    return ""


def _same(one: Any, other: Any) -> bool:
    """Tell whether two expressions of time, and of the coefficients of a polynomial, are equal in numbers."""
    both = [ca.densify(one), ca.densify(other)]
    symbols = ca.symvar(ca.vertcat(*both))
    values = ca.Function("values", symbols, both)
    instants = np.array([[0.1, 1.7, 23.0]])
    points = [ca.DM(np.repeat(instants + k, symbol.numel(), axis=0)) for k, symbol in enumerate(symbols)]
    first, second = (m.full() for m in values.call(points))
    return np.array_equal(first, second, equal_nan=True)
