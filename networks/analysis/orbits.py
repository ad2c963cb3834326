"""Periodic motions: what harmonic balance finds, and whether they persist."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base import Array, Complex, UnknownNameError, between, demand, nearest, shown, text, whole
from ..dae import DAE


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
        value = abs(self._lines(output, harmonic)[harmonic])
        return float(value if harmonic == 0 else 2 * value)

    def phase(self, output: str, harmonic: int = 1) -> float:
        """Return the phase of a harmonic against the drive's sine [rad]."""
        return float(np.angle(1j * self._lines(output, harmonic)[harmonic]))

    def over_period(self, output: str, points: int = 400) -> tuple[Array, Array]:
        """Return instants of one period [s] and an output there."""
        demand("over_period()", points=(points, whole(2)))
        phase = np.linspace(0.0, 2 * np.pi, points)
        lines = self._lines(output)
        waves = np.exp(1j * np.outer(phase, np.arange(len(lines))))
        values = 2 * (waves @ lines).real - lines[0].real
        return phase / (2 * np.pi * self.frequency), values

    def peak(self, output: str) -> float:
        """Return half of what an output covers from its least to its greatest value in a period."""
        values = self.over_period(output)[1]
        return float(np.ptp(values) / 2)

    def _lines(self, output: str, harmonic: int = 0) -> Complex:
        return harmonics_of(self.outputs, output, harmonic)


def harmonics_of(outputs: dict[str, Complex], output: str, harmonic: int = 0) -> Complex:
    """Return the harmonics of an output, which are along its last axis, one of them being asked for.

    Raises:
        UnknownNameError: for an unknown output, with the nearest one.
        ModelError: for a harmonic that was not computed.
    """
    if text(output) or output not in outputs:
        told = nearest(str(output), outputs)
        raise UnknownNameError(f"'{shown(output)}' was not among the outputs{told}")
    lines = outputs[output]
    demand("this", harmonic=(harmonic, whole(0)))
    demand("this", harmonic=(harmonic, between(0, lines.shape[-1] - 1)))
    return lines
