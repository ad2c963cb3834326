"""Records: what was measured in one run, as channels in SI units over evenly spaced time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import ceil, inf
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ...base import Array, above, between, demand, finite, instance, one_of, optional, shown, text, whole
from ...components import ModelError, Sampled, UnknownNameError, nearest
from ...components.language import INTERPOLATIONS
from .columns import JITTER, LEAST_SAMPLES
from .filters import Filter


@dataclass(frozen=True)
class Channel:
    """A column of the data and the quantity of the network that it measures.

    Args:
        path: full name of the quantity.
        driven: whether it is an input of the network; an output otherwise.
        unit: of the column.
        si: unit of the quantity in the network.
        interpolation: of an input between its samples, as of `Sampled`.
        delay: by how much an input acts later than it was recorded [s]; earlier if negative.
        cutoff: of a low pass through which model and record go before an output is compared [Hz].
    """

    path: str
    driven: bool
    unit: str
    si: str
    interpolation: str = "cubic"
    delay: float = 0.0
    cutoff: float = inf

    @property
    def held(self) -> bool:
        """Whether it keeps each sample until the next."""
        return self.interpolation == "hold"


def outputs_of(channels: Mapping[str, Channel]) -> list[str]:
    """Return the channels that the network predicts."""
    return [name for name, channel in channels.items() if not channel.driven]


@dataclass(frozen=True, eq=False)
class Record:
    """What was measured in one run.

    Attributes:
        name: what it is called in reports.
        time: instants, evenly spaced [s].
        values: channels by name, in SI units.
        notes: what was tolerated or changed on reading.
        temperature: a channel for effects that follow it, if there is one.
        began: the first instant of what it was cut from [s]; None if that is its own.

    Raises:
        ModelError: for instants that are not even, and columns of other lengths or with values that are no
            finite numbers.
    """

    name: str
    time: Array
    values: dict[str, Array]
    notes: tuple[str, ...] = ()
    temperature: Array | None = field(default=None, repr=False)
    began: float | None = field(default=None, repr=False)
    _signals: dict[tuple[str, str, float], Sampled] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        demand("a Record", name=(self.name, text), began=(self.began, optional(finite("s"))))
        if instance(Mapping)(self.values):
            told = f"values map channels to columns, such as {{'F': force}}, got {shown(self.values)}"
            raise ModelError(f"record '{self.name}': {told}")
        problems: list[str] = []
        columns = {"time": self.time, **self.values}
        if self.temperature is not None:
            columns["temperature"] = self.temperature
        sound = {name: _column(name, column, problems) for name, column in columns.items()}
        time = sound["time"]
        if not problems:
            lengths = {name: len(column) for name, column in sound.items() if len(column) != len(time)}
            problems = [f"'{n}' has {count} samples, time has {len(time)}" for n, count in lengths.items()]
        if not problems:
            problems = _uneven(time)
        if problems:
            raise ModelError(f"record '{self.name}' cannot be used:", problems)
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "values", {name: sound[name] for name in self.values})

    @property
    def rate(self) -> float:
        """Samples a second [Hz]."""
        return (len(self.time) - 1) / float(self.time[-1] - self.time[0])

    def sampled(self, channel: str, interpolation: str = "cubic", delay: float = 0.0) -> Sampled:
        """Return a channel as an input signal for the time of the record: u(t) = channel(t - delay).

        What lies before the first sample or after the last one is their value, of a cubic signal the course
        beside it, turned about it, so that its slope goes on.

        Args:
            channel: its name.
            interpolation: what it is between its samples, as of `Sampled`.
            delay: by how much it acts later than it was recorded [s], shorter than the record.

        Raises:
            UnknownNameError: for an unknown channel, with the nearest one.
        """
        if text(channel) or channel not in self.values:
            told = nearest(channel, self.values)
            raise UnknownNameError(f"record '{self.name}' has no channel '{channel}'{told}")
        length = float(self.time[-1] - self.time[0])
        demand(
            "sampled()",
            interpolation=(interpolation, one_of(INTERPOLATIONS)),
            delay=(delay, between(-length, length, "s")),
        )
        key = channel, interpolation, delay
        if key not in self._signals:
            missing = ceil(abs(delay) * self.rate)
            ends = (missing, 0) if delay > 0 else (0, missing)
            turned: Any = {"mode": "reflect", "reflect_type": "odd"}
            time = np.pad(self.time, ends, **turned) + delay
            beyond: Any = turned if interpolation == "cubic" else {"mode": "edge"}
            values = np.pad(self.values[channel], ends, **beyond)
            self._signals[key] = Sampled(time, values, interpolation=interpolation)
        return self._signals[key]

    def window(self, begin: float, end: float) -> Self:
        """Return the part between two instants [s].

        Raises:
            ModelError: if too little is left.
        """
        demand("window()", begin=(begin, finite("s")), end=(end, finite("s")))
        began = float(self.time[0]) if self.began is None else self.began
        return replace(self._taken(rows_within(self.name, self.time, (begin, end))), began=began)

    def thinned(self, every: int) -> Self:
        """Return every so many samples as they are, noise and all."""
        demand("thinned()", every=(every, whole(1)))
        return self if every == 1 else self._taken(slice(None, None, every))

    def resampled(self, rate: float) -> Self:
        """Return the record at a lower rate [Hz], aliases removed without phase."""
        demand("resampled()", rate=(rate, above(0, "Hz")))
        stride = max(1, round(self.rate / rate))
        values = self.values
        if stride > 1:
            smooth = Filter(cutoff=0.4 * self.rate / stride, order=6)
            values = {name: smooth.apply(v, self.rate) for name, v in values.items()}
        note = f"resampled from {self.rate:g} to {self.rate / stride:g} Hz"
        return replace(self, values=values, notes=(*self.notes, note)).thinned(stride)

    def _taken(self, rows: slice | NDArray[np.bool_]) -> Self:
        values = {name: v[rows] for name, v in self.values.items()}
        temperature = None if self.temperature is None else self.temperature[rows]
        return replace(self, time=self.time[rows], values=values, temperature=temperature)


def _column(name: str, given: Any, problems: list[str]) -> Array:
    """Return a column as numbers; note what is wrong with it."""
    try:
        column = np.asarray(given, dtype=float)
    except (TypeError, ValueError, OverflowError):
        problems.append(f"'{name}' must be a column of numbers, got {shown(given)}")
        return np.zeros(0)
    wrong = np.flatnonzero(~np.isfinite(column))
    if column.ndim != 1:
        problems.append(f"'{name}' must be one column, got an array of shape {column.shape}")
    elif len(wrong):
        problems.append(f"'{name}' is {column[wrong[0]]} at sample {wrong[0]}; fill it or cut it out")
    return column


def _uneven(time: Array) -> list[str]:
    """Say why instants are not those of a record."""
    if len(time) < 2:
        return [f"at least 2 samples are needed, got {len(time)}"]
    steps, usual = np.diff(time), (time[-1] - time[0]) / (len(time) - 1)
    if not (steps > 0).all():
        row = int(np.argmin(steps > 0)) + 1
        told = f"time does not increase at sample {row} ({time[row]:g} s after {time[row - 1]:g} s); sort it"
        return [told]
    row = int(np.abs(steps - usual).argmax()) + 1
    told = f"{steps[row - 1]:g} s before sample {row}, {usual:g} s on average"
    uneven = abs(steps[row - 1] - usual) > JITTER * usual
    return [f"samples are not evenly spaced ({told}); resample them"] if uneven else []


def rows_within(source: str, time: Array, window: tuple[float, float] | None) -> NDArray[np.bool_]:
    """Return which rows lie in a window, once they are seen to be enough."""
    slack = 0.5 * float(np.median(np.diff(time))) if len(time) > 1 else 0.0
    begin, end = window or (-np.inf, np.inf)
    inside = (time >= begin - slack) & (time <= end + slack)
    count = np.count_nonzero(inside)
    if count < LEAST_SAMPLES:
        of = f" in the window {begin:g} to {end:g} s" if window else ""
        there = f", from {time[0]:g} to {time[-1]:g} s" if len(time) else ""
        raise ModelError(f"{source}: {count} samples{of}{there}; at least {LEAST_SAMPLES} are needed")
    return inside
