"""Candidates: the excitations among which an experiment is chosen, each as large as the inputs allow."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np

from ...base import Array
from ...identification import Chirp, Multisine, Shuttle, SineDwells, sampled
from .. import criteria
from .envelope import Envelope

Signal = Callable[[Any], Any]
Named = tuple[
    str, tuple[float, float], Signal
]  # what it is called, its band [Hz], a function of time of any size


@dataclass(frozen=True, eq=False)
class Candidate:
    """An excitation.

    Attributes:
        told: what it is, in words.
        drives: by input that moves, its samples about where it rests, in SI units.
        share: of the largest that the limits of the inputs allow.
        band: between which frequencies it moves [Hz].
    """

    told: str
    drives: Mapping[str, Array]
    share: float
    band: tuple[float, float]

    def scaled(self, factor: float) -> Candidate:
        """Return it larger or smaller."""
        drives = {name: factor * values for name, values in self.drives.items()}
        return replace(self, drives=drives, share=factor * self.share)


def candidates(inputs: Sequence[Envelope], lasting: float, rate: float) -> Iterator[Candidate]:
    """Yield excitations of each input alone, and of all of them at once.

    Args:
        inputs: what may be asked of each.
        lasting: how long an experiment takes [s].
        rate: of its samples [Hz].
    """
    for one in inputs:
        for told, band, signal in _signals(one, lasting):
            whole = _made({one.channel: (one, signal)}, told, band, lasting, rate)
            yield from (whole.scaled(share) for share in criteria.DESIGN_AMPLITUDE_SHARES)
    if len(inputs) > 1:
        yield together(inputs, lasting, rate, 0)


def together(inputs: Sequence[Envelope], lasting: float, rate: float, seed: int) -> Candidate:
    """Return multisines of different phases on all inputs."""
    drives: dict[str, tuple[Envelope, Signal]] = {}
    for number, one in enumerate(inputs):
        signal = _multisine(one, one.band, lasting, len(inputs) * seed + number)
        drives[one.channel] = one, signal or Chirp(1.0, one.band[0], one.band[1], lasting)
    ends = np.array([one.band for one in inputs])
    band = float(ends[:, 0].min()), float(ends[:, 1].max())
    return _made(drives, f"multisines (seed {seed})", band, lasting, rate)


def refined(best: Candidate, inputs: Sequence[Envelope], lasting: float, rate: float) -> Iterator[Candidate]:
    """Yield what lies near a candidate: other amplitudes, frequencies or parts of its band, and phases."""
    for factor in criteria.REFINED_AMPLITUDE_FACTORS:
        if factor * best.share <= 1:
            yield best.scaled(factor)
    moving = [one for one in inputs if one.channel in best.drives]
    if len(moving) > 1:
        for seed in range(1, 1 + criteria.REFINED_SEEDS):
            yield together(moving, lasting, rate, seed).scaled(best.share)
        return
    (one,), (low, high) = moving, best.band
    for told, band, signal in _near(one, low, high, lasting):
        yield _made({one.channel: (one, signal)}, told, band, lasting, rate).scaled(best.share)


def _near(one: Envelope, low: float, high: float, lasting: float) -> Iterator[Named]:
    """Yield excitations of an input in a band and in parts of it; sines beside one that is best."""
    if low == high:
        for factor in criteria.REFINED_FREQUENCY_FACTORS:
            frequency = factor * low
            if one.band[0] <= frequency <= one.band[1]:
                yield "sine", (frequency, frequency), _sine(frequency, lasting)
        return
    for seed in range(1, 1 + criteria.REFINED_SEEDS):
        signal = _multisine(one, (low, high), lasting, seed)
        if signal is not None:
            yield f"multisine (seed {seed})", (low, high), signal
    share = (high / low) ** (1 / 3)
    for band in ((low, low * share), (low * share, high / share), (high / share, high)):
        yield "chirp", band, Chirp(1.0, band[0], band[1], lasting)


def _signals(one: Envelope, lasting: float) -> Iterator[Named]:
    """Yield excitations of an input."""
    (low, high), middle = one.band, float(np.sqrt(one.band[0] * one.band[1]))
    for told, band in (("", (low, high)), ("slow ", (low, middle)), ("fast ", (middle, high))):
        signal = _multisine(one, band, lasting, 0)
        if signal is not None:
            yield f"{told}multisine (seed 0)", band, signal
    yield "chirp", (low, high), Chirp(1.0, low, high, lasting)
    for frequency in np.geomspace(low, high, criteria.TRIAL_FREQUENCIES).tolist():
        yield "sine", (frequency, frequency), _sine(frequency, lasting)
    steps = np.geomspace(low, high, criteria.DESIGN_STEPS)
    cycles = int(lasting / float(np.sum(1 / steps)))
    if cycles:
        amplitudes = tuple(one.amplitude(f) for f in steps)
        yield "stepped sine", (low, high), SineDwells(amplitudes, tuple(steps), cycles)
    for frequency in (low, middle):
        shuttle = Shuttle(1.0, frequency, min(1.0, max(criteria.SHUTTLE_SHARE, frequency / high)))
        yield "to and fro with rests", (frequency, high), shuttle


def _sine(frequency: float, lasting: float) -> SineDwells:
    return SineDwells((1.0,), (frequency,), max(1, int(lasting * frequency + 1e-9)))


def _multisine(one: Envelope, band: tuple[float, float], lasting: float, seed: int) -> Multisine | None:
    """Return a multisine, of even speed where speed is limited; None if no line lies in a band."""
    first, last = np.ceil(band[0] * lasting - 1e-9), np.floor(band[1] * lasting + 1e-9)
    if last < first or band[1] <= band[0]:
        return None
    ends = (first - 0.25) / lasting, (last + 0.25) / lasting
    return Multisine(1.0, *ends, period=lasting, seed=seed, slope=float(one.limit.peaks[1] < inf))


def _made(
    signals: Mapping[str, tuple[Envelope, Signal]],
    told: str,
    band: tuple[float, float],
    lasting: float,
    rate: float,
) -> Candidate:
    fade = min(criteria.TRIAL_FADE_SECONDS, criteria.DESIGN_FADE_SHARE * lasting)
    drives = {
        name: one.scaled(sampled(signal, lasting, rate, fade).values, rate)
        for name, (one, signal) in signals.items()
    }
    where = " and ".join(f"'{name}'" for name in drives)
    ends = f"{band[0]:.3g} Hz" if band[0] == band[1] else f"{band[0]:.3g} to {band[1]:.3g} Hz"
    return Candidate(f"{told}, {ends}, on {where}", drives, 1.0, band)
