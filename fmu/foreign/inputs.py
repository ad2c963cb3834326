"""What a run gives to an FMU: values before the start, signals during it."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from itertools import groupby
from numbers import Real
from typing import Any

import numpy as np

from ...components import Sampled
from ...networks import breaks, check_covered, piecewise
from ..errors import FMUError
from .description import FMUDescription
from .initialization import checked
from .instance import Group, Instance, Values
from .variable import ForeignVariable

SAMPLES_A_STEP, STRAIGHT_SAMPLES, STRAIGHT_SHARE = 4, 4, 1e-9


def groups(variables: Iterable[ForeignVariable]) -> list[Group]:
    """Return variables as groups to get, one a variable run of the same type, in their order."""
    alike = ((kind, list(group)) for kind, group in groupby(variables, key=lambda v: v.type))
    return [(kind, [v.reference for v in group], sum(v.size for v in group)) for kind, group in alike]


@dataclass(eq=False)
class Inputs:
    """Signals of a run.

    Attributes:
        continuous: real inputs, set with every evaluation; a function of time each.
        discrete: the others, constant between their `jumps`.
        held: real inputs of those that are constant between their `jumps` too; `present` is what they are.
        longest_step: steps [s] that do not pass over what data do between their samples.
        bends: instants at which data bend again that had been straight.
    """

    fmu: FMUDescription
    continuous: dict[str, Callable[[float], float]] = field(default_factory=dict)
    discrete: dict[str, Callable[[float], Any]] = field(default_factory=dict)
    held: dict[str, Callable[[float], Any]] = field(default_factory=dict)
    present: dict[str, float] = field(default_factory=dict)
    jumps: list[float] = field(default_factory=list)
    longest_step: float = np.inf
    bends: list[float] = field(default_factory=list)

    def named(self, name: str) -> str:
        """Return an input as messages name it."""
        return f"input '{name}' of FMU '{self.fmu.name}'"

    def at(self, t: float) -> Values:
        """Return the continuous inputs at an instant; refuse what is no finite number."""
        values = [float(signal(t)) for signal in self.continuous.values()]
        for name, value in zip(self.continuous, values, strict=True):
            if not np.isfinite(value):
                raise FMUError(f"{self.named(name)} is {value} at t = {t:g} s")
        return values

    def set_discrete(self, instance: Instance, t: float) -> None:
        """Set what is constant between jumps for the time after t."""
        if self.held:
            self.present = {name: float(course(t)) for name, course in self.held.items()}
            instance.drive(self.at(t))
        for name, signal in self.discrete.items():
            v = self.fmu.variables[name]
            instance.set((v.type, [v.reference], v.size), checked(self.fmu, v, signal(t)))

    def next_changes(self, t: float) -> tuple[float, float]:
        """Return when a discrete input jumps next, and when data bend next that are straight now."""
        return _next(self.jumps, t), _next(self.bends, t)


def _next(instants: list[float], t: float) -> float:
    place = bisect_right(instants, t)
    return instants[place] if place < len(instants) else np.inf


def chosen_inputs(fmu: FMUDescription, signals: Mapping[str, Any], begin: float, stop: float) -> Inputs:
    """Return the signals of a run; refuse data that are not known from `begin` to `stop` [s]."""
    inputs = Inputs(fmu)
    smooth: dict[str, Sampled] = {}
    for name, signal in signals.items():
        v = fmu.variable(name, fmu.inputs)
        signal = fmu.converted(v, signal)
        if v.is_signal and v.variability == "continuous":
            inputs.continuous[name] = _continuous(inputs, v, signal, smooth)
        else:
            inputs.discrete[name] = _discrete(inputs, v, signal, begin)
    check_covered(fmu.name, smooth, begin, stop)
    return inputs


def _continuous(
    inputs: Inputs, v: ForeignVariable, signal: Any, smooth: dict[str, Sampled]
) -> Callable[[float], float]:
    """Return a signal as a function of time; note it in `smooth` if it is sampled."""
    if callable(signal):
        function: Any = signal
        return lambda t: float(function(t))
    if isinstance(signal, Real):
        number = float(checked(inputs.fmu, v, signal)[0])
        return lambda t: number
    sampled = signal if isinstance(signal, Sampled) else Sampled(*_pair(inputs.named(v.name), signal))
    smooth[v.name] = sampled
    if sampled.interpolation == "hold":
        return _held(inputs, v, sampled)
    inputs.longest_step = min(inputs.longest_step, SAMPLES_A_STEP * float(np.median(np.diff(sampled.time))))
    inputs.bends = sorted({*inputs.bends, *_bends(sampled)})
    course = piecewise(sampled)
    return lambda t: float(course(t))


def _held(inputs: Inputs, v: ForeignVariable, sampled: Sampled) -> Callable[[float], float]:
    inputs.held[v.name] = piecewise(sampled)
    inputs.jumps = sorted({*inputs.jumps, *breaks(sampled).tolist()})
    return lambda t: inputs.present[v.name]


def _bends(data: Sampled) -> list[float]:
    """Return the instants at which data bend again after some that lay on a line."""
    slopes = np.diff(data.values) / np.diff(data.time)
    steepest = np.abs(slopes).max()
    bent = np.concatenate([[False] * STRAIGHT_SAMPLES, np.abs(np.diff(slopes)) > STRAIGHT_SHARE * steepest])
    straight = np.convolve(bent, np.ones(STRAIGHT_SAMPLES), "full")[: len(bent)] - bent == 0
    return [float(t) for t in data.time[np.flatnonzero((bent & straight)[STRAIGHT_SAMPLES:])]]


def _discrete(inputs: Inputs, v: ForeignVariable, signal: Any, begin: float) -> Callable[[float], Any]:
    where = inputs.named(v.name)
    if callable(signal):
        raise FMUError(
            f"{where} is {v.variability} {v.type}: give a value or (time, values), each held until the next"
        )
    if not isinstance(signal, tuple):
        checked(inputs.fmu, v, signal)
        return lambda t: signal
    time, values = (np.asarray(a) for a in _pair(where, signal))
    if (np.diff(time) <= 0).any() or len(time) != len(values):
        raise FMUError(f"{where}: time must increase, one value each")
    for value in values:
        checked(inputs.fmu, v, value)
    if not len(time) or time[0] > begin:
        raise FMUError(
            f"{where}: its values begin after the run does, at {begin:g} s; give the value at its start"
        )
    inputs.jumps = sorted({*inputs.jumps, *time.tolist()})
    return lambda t: values[max(0, int(np.searchsorted(time, t, side="right")) - 1)]


def _pair(where: str, signal: Any) -> tuple[Any, Any]:
    if not isinstance(signal, tuple) or len(signal) != 2:
        raise FMUError(f"{where} takes a number, a function of time or (time, values), got {signal!r}")
    return signal
