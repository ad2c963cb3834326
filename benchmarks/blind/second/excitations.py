"""What drives a rig before and during a record, with exact derivatives.

A record is cut from a run that began PREROLL before it. A machine that is to begin at rest is driven from the
record's first second on, one that is to begin in motion from that of the run.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from excitations import RATE, STEP
from stepper import Array, Drive

PREROLL = 4.0
SPARE = 0.1
FADE = 1.0
SHAPES = ("random", "sine", "levels", "chirp", "decay")


def times(duration: float) -> Array:
    """Return the middles of all steps; a record begins at PREROLL."""
    return np.arange(round((PREROLL + duration + SPARE) * RATE) + 1) * STEP


def excitation(
    shape: str,
    size: float,
    band: tuple[float, float],
    rng: np.random.Generator,
    moving: bool,
    duration: float,
    rested: bool,
    bias: float = 0.0,
) -> Drive:
    """Return one excitation.

    Args:
        shape: "random", "sine", "levels" (a sine at several amplitudes), "chirp", or "decay": random until
            it is let go, just before the record begins or within its first half.
        size: root mean square before it is let go.
        band: lowest and highest frequency [Hz].
        rng: draws phases, frequencies, levels.
        moving: whether it prescribes a motion rather than a force; a motion falls with frequency.
        duration: of the record [s].
        rested: whether the record begins at rest; "decay" does not.
        bias: mean of it, to either side.
    """
    t = times(duration)
    made = {"sine": _sine, "levels": _sine, "chirp": _chirp}.get(shape, _random)(band, rng, moving, t)
    made = made / np.std(made[0]) * size
    made[0] += bias * rng.choice([-1, 1])
    start = PREROLL if rested else 0.0
    steps = [(start, FADE, 1.0)]
    if shape == "levels":
        steps += _levels(rng, duration)
    if shape == "decay":
        steps += [(PREROLL + rng.uniform(-0.02, 0.5) * duration, 0.3 if moving else 0.02, -1.0)]
    y, yd, ydd = _shaped(made, steps, t)
    zero = np.zeros_like(y)
    return Drive(zero, y, yd, ydd) if moving else Drive(y, zero, zero, zero)


def _random(band: tuple[float, float], rng: np.random.Generator, moving: bool, t: Array) -> Array:
    count = 2 * (len(t) // 2)
    lines = np.arange(np.ceil(band[0] * count * STEP), np.floor(band[1] * count * STEP) + 1).astype(int)
    omega = 2 * np.pi * lines / (count * STEP)
    spectrum = np.zeros(count // 2 + 1, complex)
    drawn = np.exp(2j * np.pi * rng.uniform(size=len(lines))) / (omega if moving else 1)
    period = []
    for order in range(3):
        spectrum[lines] = drawn * (1j * omega) ** order
        period.append(np.resize(np.fft.irfft(spectrum, count), len(t)))
    return np.array(period)


def _sine(band: tuple[float, float], rng: np.random.Generator, moving: bool, t: Array) -> Array:
    omega = 2 * np.pi * band[0] * (band[1] / band[0]) ** rng.uniform(0.25, 0.7)
    angle = omega * t + rng.uniform(0, 2 * np.pi)
    return np.array([np.sin(angle), omega * np.cos(angle), -(omega**2) * np.sin(angle)])


def _chirp(band: tuple[float, float], rng: np.random.Generator, moving: bool, t: Array) -> Array:
    """Sweep exponentially, up or down, a motion with less amplitude at higher frequency."""
    low, high = band if rng.uniform() < 0.5 else band[::-1]
    rate = np.log(high / low) / t[-1]
    omega = 2 * np.pi * low * np.exp(rate * t)
    fall, angle = rate * moving, omega / rate
    y, yd = np.sin(angle), omega * np.cos(angle)
    ydd = rate * yd - omega**2 * y
    size = np.exp(-fall * t)
    return np.asarray(size * np.array([y, yd - fall * y, ydd - 2 * fall * yd + fall**2 * y]))


def _levels(rng: np.random.Generator, duration: float) -> list[tuple[float, float, float]]:
    """Return steps between amplitudes, every two to four seconds."""
    steps, now, level = [], PREROLL, 1.0
    while (now := now + rng.uniform(2.0, 4.0)) < PREROLL + duration:
        to = rng.uniform(0.2, 1.4)
        steps.append((now, 0.5, to - level))
        level = to
    return steps


def _shaped(signal: Array, steps: Sequence[tuple[float, float, float]], t: Array) -> Array:
    """Return a signal times an envelope of smooth steps (when, how long, how high)."""
    f, fd, fdd = np.zeros((3, len(t)))
    for when, long, high in steps:
        r = np.clip((t - when) / long, 0, 1)
        f += high * r**4 * (35 - 84 * r + 70 * r**2 - 20 * r**3)
        fd += high * 140 * r**3 * (1 - r) ** 3 / long
        fdd += high * 420 * r**2 * (1 - r) ** 2 * (1 - 2 * r) / long**2
    y, yd, ydd = signal
    return np.array([f * y, fd * y + f * yd, fdd * y + 2 * fd * yd + f * ydd])
