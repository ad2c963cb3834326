"""Excitations: what to drive a machine with so that its parameters show."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from typing import Any

import casadi as ca
import numpy as np

from ...base import (
    Array,
    above,
    at_least,
    between,
    demand,
    finite,
    function,
    numbers,
    numpy_on_symbols,
    whole,
)
from ...components import ModelError, Sampled

MOST_SAMPLES, MOST_LINES = 50_000_000, 1_000_000
PHASE_DRAWS = 64


def sampled(signal: Callable[[Any], Any], stop: float, rate: float = 1000.0, fade: float = 0.0) -> Sampled:
    """Return samples of an excitation, faded in from rest and out again, so that it can drive a position.

    Args:
        signal: a function of time: `SineDwells`, `Chirp`, `Multisine`, `machines.Sinusoid`,
            `machines.RandomDisplacement` ...
        stop: its length [s].
        rate: samples a second [Hz].
        fade: how long it takes to fade in, and out [s].

    Example:
        >>> from inertance.identification import sampled
        >>> from inertance.machines import Sinusoid
        >>> drive = sampled(Sinusoid(0.01, 3.0), stop=4.0, fade=0.5)
        >>> drive.values[0], len(drive.time)
        (np.float64(0.0), 4001)
    """
    demand(
        "sampled()",
        signal=(signal, function),
        stop=(stop, above(0, "s")),
        rate=(rate, above(0, "Hz")),
        fade=(fade, at_least(0, "s")),
    )
    if stop * rate > MOST_SAMPLES:
        raise ModelError(f"{stop:g} s at {rate:g} Hz are over {MOST_SAMPLES:.0e} samples; take a lower rate")
    count = round(stop * rate)
    if count < 4 or not 0 <= 2 * fade <= stop:
        raise ModelError(
            f"an excitation of {stop:g} s at {rate:g} Hz with fades of {fade:g} s cannot be sampled"
        )
    time = np.arange(count + 1) / rate
    t = ca.SX.sym("t")
    window = _smooth_step(t / fade) * _smooth_step((stop - t) / fade) if fade else 1.0
    try:
        with numpy_on_symbols():
            function_ = ca.Function("signal", [t], [ca.SX(signal(t)) * window])
    except Exception as error:
        told = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
        raise ModelError(
            f"sampled(): the signal could not be read ({told}); write it with ca.sin or np.sin"
        ) from error
    values = np.array(function_.map(len(time))(time[None, :])).ravel()
    return Sampled(time, values)


def _check(excitation: Any, **checks: Callable[[Any], str]) -> None:
    fields = {name: (getattr(excitation, name), check) for name, check in checks.items()}
    demand(f"a {type(excitation).__name__}", **fields)


@dataclass(frozen=True)
class Chirp:
    """A sine whose frequency rises evenly: x = amplitude sin(2 pi (low t + (high - low) t^2/(2 duration))).

    Args:
        amplitude: in the unit of what is driven.
        low, high: frequency at the begin and at the end [Hz].
        duration: [s].
    """

    amplitude: float
    low: float
    high: float
    duration: float

    def __post_init__(self) -> None:
        frequency = at_least(0, "Hz")
        _check(self, amplitude=finite(), low=frequency, high=frequency, duration=above(0, "s"))

    def __call__(self, t: Any) -> Any:
        turns = self.low * t + (self.high - self.low) * t**2 / (2 * self.duration)
        return self.amplitude * ca.sin(2 * pi * turns)


@dataclass(frozen=True)
class SineDwells:
    """One sine after the other, each for a whole number of cycles, from zero to zero.

    Over `fade` of the first and of the last cycle of a step the amplitude grows and falls smoothly.

    Args:
        amplitudes, frequencies: of the steps, the latter in Hz.
        cycles: of each step.
    """

    amplitudes: tuple[float, ...]
    frequencies: tuple[float, ...]
    cycles: int = 10

    def __post_init__(self) -> None:
        _check(self, amplitudes=numbers(finite()), frequencies=numbers(finite("Hz")), cycles=whole(1))
        for name in ("amplitudes", "frequencies"):
            object.__setattr__(self, name, tuple(np.ravel(getattr(self, name)).tolist()))
        if len(self.amplitudes) != len(self.frequencies) or min(self.frequencies, default=0.0) <= 0:
            raise ModelError("a SineDwells has as many amplitudes as frequencies, and these are above 0 Hz")

    @property
    def duration(self) -> float:
        """Length of all steps [s]."""
        return sum(self.cycles / f for f in self.frequencies)

    def __call__(self, t: Any) -> Any:
        value, begin = 0, 0.0
        for amplitude, frequency in zip(self.amplitudes, self.frequencies, strict=True):
            end = begin + self.cycles / frequency
            window = _smooth_step((t - begin) * frequency) * _smooth_step((end - t) * frequency)
            value = value + amplitude * window * ca.sin(2 * pi * frequency * (t - begin))
            begin = end
        return value


@dataclass(frozen=True)
class Shuttle:
    """From one side to the other and back, with a rest on each: for dry friction, whose rest tells most.

    Args:
        amplitude: of the sides.
        frequency: of going to and fro [Hz].
        moving: share of the time in which it moves; a quintic each time, as smooth as a fade.
    """

    amplitude: float
    frequency: float
    moving: float = 0.4

    def __post_init__(self) -> None:
        _check(self, amplitude=finite(), frequency=above(0, "Hz"), moving=between(0.01, 1))

    def __call__(self, t: Any) -> Any:
        turns = self.frequency * t
        phase = 2 * (turns - ca.floor(turns)) / self.moving
        there, back = _smooth_step(phase), _smooth_step(phase - 1 / self.moving)
        return self.amplitude * (2 * (there - back) - 1)


def _smooth_step(share: Any) -> Any:
    """Return a step from 0 to 1, twice continuously differentiable."""
    share = ca.fmin(ca.fmax(share, 0), 1)
    return share**3 * (10 - 15 * share + 6 * share**2)


@dataclass(frozen=True)
class Multisine:
    """A sum of sines at the multiples of 1/period within a band, of low crest factor.

    The best of some draws of random phases; each draw is a fresh experiment, and the mean of several shows
    what a machine does linearly, their scatter what it does not.

    Args:
        rms: root mean square, in the unit of what is driven.
        low, high: the band [Hz].
        period: time after which it repeats [s].
        seed: of the phases.
        slope: amplitudes fall like f^-slope: 0 flat, 1 for flat velocity when a displacement is driven.

    Source: R. Pintelon, J. Schoukens, System Identification (2012), chapter 5.
    """

    rms: float
    low: float
    high: float
    period: float = 10.0
    seed: int = 0
    slope: float = 0.0

    def __post_init__(self) -> None:
        frequency = above(0, "Hz")
        drawn = {"seed": whole(0), "slope": between(-10, 10)}
        _check(self, rms=finite(), low=frequency, high=frequency, period=above(0, "s"), **drawn)
        if self.high * self.period > MOST_LINES:
            raise ModelError(
                f"a Multisine up to {self.high:g} Hz in steps of {1 / self.period:g} Hz has over "
                f"{MOST_LINES:.0e} lines; give a shorter period"
            )
        if not 0 < self.low < self.high or not len(self.frequencies):
            raise ModelError(f"a Multisine needs a band above 0 Hz, got {self.low:g} to {self.high:g} Hz")

    @property
    def frequencies(self) -> Array:
        """The lines [Hz]."""
        lines = np.arange(np.ceil(self.low * self.period), np.floor(self.high * self.period) + 1)
        return np.asarray(lines / self.period)

    @property
    def amplitudes(self) -> Array:
        """Amplitude of each line."""
        shape = self.frequencies**-self.slope
        return np.asarray(self.rms * shape * np.sqrt(2 / np.sum(shape**2)))

    @property
    def phases(self) -> Array:
        """Phases of the draw with the least peak [rad]."""
        draws = np.random.default_rng(self.seed).uniform(0, 2 * pi, (PHASE_DRAWS, len(self.frequencies)))
        count = 1 << int(np.ceil(np.log2(16 * self.high * self.period)))
        lines = np.round(self.frequencies * self.period).astype(int)
        spectrum = np.zeros((PHASE_DRAWS, count // 2 + 1), dtype=complex)
        spectrum[:, lines] = self.amplitudes * np.exp(1j * draws)
        peaks = np.abs(np.fft.irfft(spectrum, count)).max(axis=1)
        return np.asarray(draws[int(peaks.argmin())])

    def __call__(self, t: Any) -> Any:
        angles = ca.DM(2 * pi * self.frequencies) * t + ca.DM(self.phases)
        return ca.dot(ca.DM(self.amplitudes), ca.cos(angles))
