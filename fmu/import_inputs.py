"""What a run gives to an FMU: values before the start, signals during it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

import numpy as np

from ..components import Sampled
from ..networks import cubic_spline
from .errors import FMUError
from .foreign import Group, Instance, Values
from .import_description import ForeignVariable
from .imported import FMU


def groups(variables: Iterable[ForeignVariable]) -> list[Group]:
    """Return variables as groups to get, one a variable run of the same type, in their order."""
    found: list[Group] = []
    for v in variables:
        if found and found[-1][0] == v.type:
            kind, references, count = found[-1]
            found[-1] = (kind, [*references, v.reference], count + v.size)
        else:
            found.append((v.type, [v.reference], v.size))
    return found


def chosen_values(
    fmu: FMU, parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> list[tuple[Group, Values]]:
    """Return values to set before the start.

    Raises:
        FMUError: for unknown names, what cannot be set, and values out of range.
    """
    chosen = []
    for name, value in parameters.items():
        chosen.append((fmu.variable(name, fmu.parameters), value))
    for name, value in start.items():
        variable = fmu.variable(name)
        if not variable.settable or variable.causality in ("parameter", "input"):
            told = variable.initial or variable.variability
            raise FMUError(f"FMU '{fmu.name}': '{name}' ({variable.causality}, {told}) takes no start value")
        chosen.append((variable, value))
    return [((v.type, [v.reference], v.size), checked(fmu, v, value)) for v, value in chosen]


def checked(fmu: FMU, variable: ForeignVariable, value: Any) -> Values:
    """Return the elements of a value in the unit of its variable.

    Raises:
        FMUError: if type, number or range is wrong.
    """
    value = fmu.converted(variable, value)
    values = [value] if np.ndim(value) == 0 else list(np.ravel(value))
    unit = f" {variable.unit}" if variable.unit else ""
    where = f"FMU '{fmu.name}': '{variable.name}'"
    if len(values) != variable.size:
        raise FMUError(f"{where} takes {variable.size} value(s), got {len(values)}")
    for element in values:
        if variable.type == "String":
            if not isinstance(element, str):
                raise FMUError(f"{where} takes a text, got {element!r}")
        elif not isinstance(element, Real) and not isinstance(element, np.bool_):
            raise FMUError(f"{where} takes a number{unit and f' [{variable.unit}]'}, got {element!r}")
        elif not variable.minimum <= float(element) <= variable.maximum:
            raise FMUError(
                f"{where} must be between {variable.minimum:g} and {variable.maximum:g}{unit}, got {element}"
            )
    return values if variable.type == "String" else [float(element) for element in values]


@dataclass(eq=False)
class Inputs:
    """Signals of a run.

    Attributes:
        driven: continuous real inputs, set with every evaluation; a function of time each.
        held: the others, constant between their jumps.
    """

    fmu: FMU
    driven: dict[str, Callable[[float], float]] = field(default_factory=dict)
    held: dict[str, Callable[[float], Any]] = field(default_factory=dict)
    jumps: list[float] = field(default_factory=list)

    @property
    def references(self) -> list[int]:
        """Value references of what is driven."""
        return [self.fmu.variables[name].reference for name in self.driven]

    def at(self, t: float) -> Values:
        """Return what is driven, at an instant.

        Raises:
            FMUError: if a signal gives no finite number.
        """
        values = [float(signal(t)) for signal in self.driven.values()]
        for name, value in zip(self.driven, values, strict=True):
            if not np.isfinite(value):
                raise FMUError(f"input '{name}' of FMU '{self.fmu.name}' is {value} at t = {t:g} s")
        return values

    def hold(self, instance: Instance, t: float) -> None:
        """Set the held inputs for the time after t."""
        for name, signal in self.held.items():
            v = self.fmu.variables[name]
            instance.set((v.type, [v.reference], v.size), checked(self.fmu, v, signal(t)))

    def next_jump(self, t: float) -> float:
        """Return when a held input changes next."""
        return min((jump for jump in self.jumps if jump > t), default=np.inf)


def chosen_inputs(fmu: FMU, signals: Mapping[str, Any]) -> Inputs:
    """Return the signals of a run.

    Raises:
        FMUError: for unknown inputs and signals that are none.
    """
    inputs = Inputs(fmu)
    for name, signal in signals.items():
        v = fmu.variable(name, fmu.inputs)
        if v.type in ("Real", "Float64") and v.variability == "continuous" and v.size == 1:
            inputs.driven[name] = _continuous(fmu, v, signal)
        else:
            inputs.held[name] = _held(inputs, v, signal)
    return inputs


def _continuous(fmu: FMU, v: ForeignVariable, signal: Any) -> Callable[[float], float]:
    signal = fmu.converted(v, signal)
    if callable(signal):
        given: Callable[[float], Any] = signal
        return lambda t: float(given(t))
    if isinstance(signal, Real):
        number = checked(fmu, v, signal)[0]
        return lambda t: float(number)
    sampled = signal if isinstance(signal, Sampled) else Sampled(*_pair(fmu, v, signal))
    spline = cubic_spline(sampled)
    return lambda t: float(spline(t))


def _held(inputs: Inputs, v: ForeignVariable, signal: Any) -> Callable[[float], Any]:
    if callable(signal):
        raise FMUError(
            f"input '{v.name}' of FMU '{inputs.fmu.name}' is {v.variability} {v.type}: give a value or "
            "(time, values), each held until the next"
        )
    signal = inputs.fmu.converted(v, signal)
    if not isinstance(signal, tuple):
        return lambda t: signal
    time, values = (np.asarray(a) for a in _pair(inputs.fmu, v, signal))
    if (np.diff(time) <= 0).any() or len(time) != len(values):
        raise FMUError(f"input '{v.name}' of FMU '{inputs.fmu.name}': time must increase, one value each")
    inputs.jumps = sorted({*inputs.jumps, *time.tolist()})
    return lambda t: values[max(0, int(np.searchsorted(time, t, side="right")) - 1)]


def _pair(fmu: FMU, v: ForeignVariable, signal: Any) -> tuple[Any, Any]:
    if not isinstance(signal, tuple) or len(signal) != 2:
        raise FMUError(
            f"input '{v.name}' of FMU '{fmu.name}' takes a number, a function of time or (time, values), "
            f"got {signal!r}"
        )
    return signal
