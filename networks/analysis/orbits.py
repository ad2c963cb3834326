"""Periodic motions: what harmonic balance finds, and whether they persist."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import Array, Complex, UnknownNameError, above, between, demand, nearest, shown, text, whole
from ..dae import DAE

drive_frequency = between(1e-6, 1e6, "Hz")


def drive_amplitude(value: Any) -> str:
    """Say that an amplitude must be above 0, and such that its powers are numbers, too."""
    return above(0)(value) or between(0, 1e100)(value)


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic motion of a driven network.

    Attributes:
        frequency: of the drive [Hz].
        multipliers: Floquet multipliers, of one period; the motion persists if all lie in the unit circle.
        error: share of the outputs' power in the highest tenth of the harmonics.
    """

    dae: DAE
    frequency: float
    coefficients: Complex
    outputs: dict[str, Complex]
    multipliers: Complex
    error: float

    @property
    def stable(self) -> bool:
        """Whether small disturbances die out."""
        return bool((np.abs(self.multipliers) < 1.0 + 1e-6).all())

    def amplitude(self, output: str, harmonic: int = 1) -> float:
        """Return the amplitude of one harmonic of an output, or its mean for harmonic 0."""
        value = abs(harmonics_of(self.outputs, output, harmonic)[harmonic])
        return float(value if harmonic == 0 else 2 * value)

    def phase(self, output: str, harmonic: int = 1) -> float:
        """Return the phase of a harmonic against the drive's sine [rad]."""
        return float(np.angle(1j * harmonics_of(self.outputs, output, harmonic)[harmonic]))

    def over_period(self, output: str, points: int = 400) -> tuple[Array, Array]:
        """Return instants of one period [s] and an output there."""
        demand("over_period()", points=(points, whole(2)))
        phase = np.linspace(0.0, 2 * np.pi, points)
        lines = harmonics_of(self.outputs, output)
        waves = np.exp(1j * np.outer(phase, np.arange(len(lines))))
        values = 2 * (waves @ lines).real - lines[0].real
        return phase / (2 * np.pi * self.frequency), values

    def peak(self, output: str) -> float:
        """Return half of what an output covers from its least to its greatest value in a period."""
        return float(np.ptp(self.over_period(output)[1]) / 2)


def harmonics_of(outputs: dict[str, Complex], output: str, harmonic: int = 0) -> Complex:
    """Return the harmonics of an output, along its last axis; an error unless the one asked for is there."""
    if text(output) or output not in outputs:
        raise UnknownNameError(f"'{shown(output)}' was not among the outputs{nearest(str(output), outputs)}")
    lines = outputs[output]
    last = lines.shape[-1] - 1
    demand("this", harmonic=(harmonic, lambda number: whole(0)(number) or between(0, last)(number)))
    return lines
