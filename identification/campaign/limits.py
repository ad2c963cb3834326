"""`Limits`: what a designed experiment may ask of the rig."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np

from ...base import Array, is_number, rate_unit, unit_for
from ...components import ModelError, nearest
from ...networks import DAE
from ..records.record import Channel
from .experiment import Experiment
from .machine import Machine
from .problems import Problems

UNITS: dict[str, tuple[str, ...]] = {  # what each key limits, or a derivative of it; amplitude anything
    "amplitude": (),
    "travel": ("m", "rad"),
    "speed": ("m/s", "rad/s"),
    "acceleration": ("m/s2", "rad/s2"),
    "force": ("N",),
    "torque": ("N.m",),
}
KEYS = (*UNITS, "band")
WHOLE = {"duration": "s", "rate": "Hz"}
ORDERS = 3  # a quantity, and its first and second derivative
SAMPLES_PER_CYCLE = 5  # of the fastest sine, below which a curve through samples is another one
EXCEEDED = 1.05  # of a limit, up to which a record may go without a word


@dataclass(frozen=True)
class Limit:
    """What may be asked of a quantity, in SI units.

    Attributes:
        path: its full name.
        peaks: its largest distance from where it rests, and the largest first and second derivative of it.
        band: of an input, between which frequencies it may move [Hz]; what was measured if None.
    """

    path: str
    peaks: tuple[float, ...] = (inf,) * ORDERS
    band: tuple[float, float] | None = None

    def share(self, values: Array, rate: float) -> float:
        """Return the largest share of its limits that values, at a rate [Hz], take; where it rests is 0."""
        shares = [0.0]
        for peak in self.peaks:
            if peak < inf:
                shares.append(float(np.abs(values).max()) / peak)
            values = np.gradient(values, 1 / rate)
        return max(shares)


@dataclass(frozen=True)
class Limits:
    """What a designed experiment may ask of the rig: by quantity, and of its length [s] and rate [Hz]."""

    quantities: Mapping[str, Limit] = field(default_factory=dict)
    duration: float | None = None
    rate: float | None = None


def read_limits(
    entries: Mapping[str, Any], channels: Mapping[str, Channel], machine: Machine, problems: Problems
) -> Limits:
    """Return the limits: of channels in their units, of other quantities in SI; a text names its unit."""
    whole: dict[str, float] = {}
    quantities: dict[str, Limit] = {}
    for name, entry in entries.items():
        where = f"limits.{name}"
        with problems.of(where):
            if name in WHOLE and name not in channels:
                whole[name] = _amount(entry, WHOLE[name], WHOLE[name], 1.0)
            else:
                of = _quantity(name, channels, machine)
                quantities[name] = _limit(entry, of, where, problems)
    problems.add(*_impossible(whole, quantities))
    return Limits(quantities, **whole)


def _quantity(name: str, channels: Mapping[str, Channel], machine: Machine) -> Channel:
    """Return what a name stands for, as a channel."""
    if name in channels:
        return channels[name]
    if not isinstance(machine, DAE) or name not in machine.names():
        known = [*WHOLE, *channels, *(machine.names() if isinstance(machine, DAE) else ())]
        told = nearest(name, known) or f"; give {', '.join([*WHOLE, *channels])}"
        raise ModelError(f"there is no channel or quantity of the model '{name}'{told}")
    unit = machine.unit(name)
    return Channel(name, False, unit, unit)


def _limit(entry: Any, of: Channel, where: str, problems: Problems) -> Limit:
    if not isinstance(entry, Mapping) or not entry:
        raise ModelError(f"a table of {', '.join(_fitting(of))} is needed, got {entry!r}")
    peaks, band = [inf] * ORDERS, None
    for key, value in entry.items():
        with problems.of(where):
            if key == "band":
                band = _band(value, of)
            else:
                order, peak = _peak(key, value, of)
                peaks[order] = min(peaks[order], peak)
    return Limit(of.path, tuple(peaks), band)


def _peak(key: str, value: Any, of: Channel) -> tuple[int, float]:
    """Return of which derivative a key is the limit, and that in SI units."""
    if key not in UNITS:
        known = nearest(str(key), KEYS) or f"; known are {', '.join(KEYS)}"
        raise ModelError(f"there is no key '{key}'{known}")
    order = _order(key, of.si)
    if order is None:
        raise ModelError(
            f"{key} is in {' or '.join(UNITS[key])}, and what is limited in {of.si or '1'}: "
            f"give {', '.join(_fitting(of))}"
        )
    unit = rate_unit(of.unit, order) if of.unit else "1"
    return order, _amount(value, rate_unit(of.si, order), unit, unit_for(of.unit, of.si).factor, key)


def _order(key: str, si: str) -> int | None:
    """Return of which derivative of a quantity in a unit a key is the limit."""
    if key == "amplitude":
        return 0
    return next((k for k in range(ORDERS) if rate_unit(si, k) in UNITS[key]), None)


def _fitting(of: Channel) -> list[str]:
    keys = [key for key in UNITS if _order(key, of.si) is not None]
    return [*keys, "band"] if of.driven else keys


def _amount(value: Any, si: str, unit: str, size: float, key: str = "") -> float:
    """Return a limit in SI units, given as a number in a unit of that size, or as a text with its unit."""
    of = f"{key} " if key else ""
    if isinstance(value, str):
        figure, _, written = value.strip().partition(" ")
        try:
            number = float(figure) * (unit_for(written, si).factor if written else size)
        except ModelError as error:
            raise ModelError(f"{of}{error}") from None
        except ValueError:
            told = f"a number [{unit}], or a text such as '2 {unit}'"
            raise ModelError(f"{of}must be {told}, got {value!r}") from None
    elif is_number(value):
        number = float(value) * size
    else:
        raise ModelError(f"{of}must be a number [{unit}], or a text such as '2 {unit}', got {value!r}")
    if not 0 < number < inf:
        raise ModelError(f"{of}must be above 0 {unit}, got {value!r}")
    return number


def _band(value: Any, of: Channel) -> tuple[float, float]:
    if not of.driven:
        raise ModelError("band is of an input; what else moves follows from the model")
    if not isinstance(value, list | tuple) or len(value) != 2 or not all(map(is_number, value)):
        raise ModelError(f"band must be [lowest, highest] in Hz, got {value!r}")
    low, high = float(value[0]), float(value[1])
    if not 0 < low < high:
        told = "; the lower frequency comes first" if low > high > 0 else ""
        raise ModelError(f"band must go from above 0 Hz upwards, got {low:g} to {high:g} Hz{told}")
    return low, high


def _impossible(whole: Mapping[str, float], quantities: Mapping[str, Limit]) -> Iterator[str]:
    for name, limit in quantities.items():
        if limit.band is None:
            continue
        (low, high), where = limit.band, f"limits.{name}: band"
        if "duration" in whole and low * whole["duration"] < 1:
            least, given = 1 / low, whole["duration"]
            yield f"{where}: {low:g} Hz has no whole cycle in the {given:g} s; last at least {least:.3g} s"
        if "rate" in whole and SAMPLES_PER_CYCLE * high > whole["rate"]:
            least, given = SAMPLES_PER_CYCLE * high, whole["rate"]
            yield f"{where}: {high:g} Hz is too fast for {given:g} samples a second; give at least {least:g}"


def needed(limits: Limits, channels: Mapping[str, Channel]) -> Iterator[str]:
    """Yield what limits must say where there is no record that could tell what the rig bears."""
    inputs = {name: channel for name, channel in channels.items() if channel.driven}
    told = "before there are records, nothing else tells what the rig bears"
    if limits.duration is None:
        yield f"limits: duration [s] must be given: {told}"
    if not limits.quantities.keys() & inputs.keys():
        name, channel = next(iter(inputs.items()), ("x", Channel("", True, "m", "m")))
        keys = ", ".join(key for key in _fitting(channel) if key != "band")
        yield f"limits: an input must be limited, such as {name} = {{ {keys}, band }}: {told}"
    for name, limit in limits.quantities.items():
        if name in inputs and limit.band is None:
            yield f"limits.{name}: band = [lowest, highest] in Hz must be given: {told}"
        if name in inputs and min(limit.peaks) == inf:
            keys = ", ".join(key for key in _fitting(inputs[name]) if key != "band")
            yield f"limits.{name}: give {keys}: {told}"


def exceeded(
    limits: Limits, channels: Mapping[str, Channel], experiments: Sequence[Experiment]
) -> Iterator[str]:
    """Yield a note on each record in which a channel went beyond its limit."""
    for name, limit in limits.quantities.items():
        for experiment in experiments if name in channels and limit.peaks[0] < inf else ():
            values = experiment.record.values[name]
            reached = float(np.abs(values - np.median(values)).max())
            if reached > EXCEEDED * limit.peaks[0]:
                unit = unit_for(channels[name].unit, channels[name].si)
                went, may = (
                    f"{v / unit.factor:.3g} {channels[name].unit}" for v in (reached, limit.peaks[0])
                )
                yield f"{experiment.name}: '{name}' went {went} from its middle, beyond its limit of {may}"
