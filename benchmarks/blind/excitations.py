"""What drives a rig: random, sine and chirp, each faded in from rest, with exact derivatives."""

from __future__ import annotations

import os

import numpy as np
from stepper import Array, Drive

RATE = 20_000
STEP = 1 / RATE
DURATION = float(os.environ.get("BLIND_SECONDS", "20"))
FADE = 1.0
SPARE = 0.02


def times() -> Array:
    """Return the middles of all steps, from 0 to a little past the end of a record."""
    return np.arange(round((DURATION + SPARE) * RATE) + 1) * STEP


def excitation(
    kind: str, size: float, band: tuple[float, float], rng: np.random.Generator, moving: bool
) -> Drive:
    """Return one excitation; a motion falls with 1/frequency (white velocity), a force is white.

    Args:
        kind: "random", "sine" or "chirp".
        size: root mean square.
        band: lowest and highest frequency [Hz].
        rng: draws phases and frequencies.
        moving: whether it prescribes a motion rather than a force.
    """
    made = {"random": _random, "sine": _sine, "chirp": _chirp}[kind](band, rng, moving)
    made = made / np.std(made[0]) * size
    y, yd, ydd = _faded(made)
    zero = np.zeros_like(y)
    return Drive(zero, y, yd, ydd) if moving else Drive(y, zero, zero, zero)


def _random(band: tuple[float, float], rng: np.random.Generator, moving: bool) -> Array:
    t = times()
    lines = np.arange(np.ceil(band[0] * DURATION), np.floor(band[1] * DURATION) + 1)
    omega = 2 * np.pi * lines / DURATION
    spectrum = np.zeros(round(DURATION * RATE) // 2 + 1, complex)
    spectrum[lines.astype(int)] = np.exp(2j * np.pi * rng.uniform(size=len(lines))) / (omega if moving else 1)
    full = np.zeros_like(spectrum)
    full[lines.astype(int)] = omega
    period = [np.fft.irfft(spectrum * (1j * full) ** k) for k in range(3)]
    return np.array([np.resize(signal, len(t)) for signal in period])


def _sine(band: tuple[float, float], rng: np.random.Generator, moving: bool) -> Array:
    low, high = band
    omega = 2 * np.pi * low * (high / low) ** rng.uniform(0.25, 0.6)
    t = times()
    return np.array([np.sin(omega * t), omega * np.cos(omega * t), -(omega**2) * np.sin(omega * t)])


def _chirp(band: tuple[float, float], rng: np.random.Generator, moving: bool) -> Array:
    """Sweep exponentially, up or down, a motion with less amplitude as time goes on."""
    low, high = band if rng.uniform() < 0.5 else band[::-1]
    t, rate = times(), np.log(high / low) / DURATION
    omega = 2 * np.pi * low * np.exp(rate * t)
    phase = omega / rate
    fall = rate if moving else 0.0
    size = np.exp(-fall * t)
    y, yd = np.sin(phase), omega * np.cos(phase)
    ydd = rate * omega * np.cos(phase) - omega**2 * np.sin(phase)
    return size * np.array([y, yd - fall * y, ydd - 2 * fall * yd + fall**2 * y])


def _faded(signal: Array) -> Array:
    """Fade in over FADE seconds with a polynomial whose first three derivatives vanish at both ends."""
    r = np.clip(times() / FADE, 0, 1)
    f = r**4 * (35 - 84 * r + 70 * r**2 - 20 * r**3)
    fd = 140 * r**3 * (1 - r) ** 3 / FADE
    fdd = 420 * r**2 * (1 - r) ** 2 * (1 - 2 * r) / FADE**2
    y, yd, ydd = signal
    return np.array([f * y, fd * y + f * yd, fdd * y + 2 * fd * yd + f * ydd])
