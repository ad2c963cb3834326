"""Frequency response of nonlinear networks: harmonic balance followed along the curve, through folds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...base import Array, ModelError, SimulationError, between, demand, named, numbers, shown, whole
from ..dae import DAE
from ..given import dae_of
from ..network import Network
from .balance import Balance
from .orbits import Orbit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SLOWEST = 1e-6
LONGEST, SHORTEST = 0.2, 1e-5


@dataclass(frozen=True, eq=False)
class ResponseCurve:
    """Periodic motions along a frequency response, in the order of the curve."""

    orbits: list[Orbit]

    @property
    def frequency(self) -> Array:
        """Frequencies [Hz]; where the curve folds back they fall."""
        return np.array([orbit.frequency for orbit in self.orbits])

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Which of the motions persist."""
        return np.array([orbit.stable for orbit in self.orbits])

    def amplitude(self, output: str, harmonic: int = 1) -> Array:
        """Return amplitudes of a harmonic of an output."""
        return np.array([orbit.amplitude(output, harmonic) for orbit in self.orbits])

    def peak(self, output: str) -> Array:
        """Return half the extent of an output in a period."""
        return np.array([orbit.peak(output) for orbit in self.orbits])

    def plot(self, output: str, axes: Any = None) -> Figure:
        """Draw the amplitude of an output over frequency: full where stable, dashed where not."""
        from matplotlib import pyplot

        from ..results.plotting import pretty_unit

        if not (axes is None or hasattr(axes, "plot")):
            raise ModelError(f"axes are matplotlib axes, got {shown(axes)}")
        f, size = self.frequency, self.peak(output)
        ax = axes if axes is not None else pyplot.subplots(figsize=(7.0, 4.5), layout="constrained")[1]
        lost = ~self.stable
        edges = lost | np.r_[lost[1:], False] | np.r_[False, lost[:-1]]
        for stable, style in ((True, "-"), (False, "--")):
            kept = np.where(self.stable if stable else edges, size, np.nan)
            ax.plot(f, kept, style, color="C0" if stable else "C3", label="stable" if stable else "unstable")
        ax.set_xlabel("frequency [Hz]")
        ax.set_ylabel(f"{output} [{pretty_unit(self.orbits[0].dae.unit(output))}]")
        ax.grid(alpha=0.3)
        ax.legend(frameon=False)
        figure: Any = ax.get_figure()
        return figure  # type: ignore[no-any-return]


def harmonic_response(
    network: Network | DAE,
    driven: str,
    amplitude: float,
    band: tuple[float, float],
    outputs: Sequence[str],
    *,
    harmonics: int = 9,
    signals: Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    most: int = 2000,
) -> ResponseCurve:
    """Return the periodic response to amplitude sin(2 pi f t) over a band, by harmonic balance.

    The curve is followed by its arc length, so that it is traced through folds, and each motion is judged
    stable or not by its Floquet multipliers.

    Args:
        network: without modes; friction takes part with `regularised=`.
        driven: the input.
        amplitude: of its sine, in its unit.
        band: first and last frequency [Hz]; the curve begins at the first, which may be the higher one.
        outputs: what is looked at, by name.
        harmonics: how many; more for sharper corners (see `Orbit.error`).
        signals: constant values of other inputs; 0 if not given.
        parameters: changed parameters.
        most: points after which a curve is given up.

    Raises:
        ModelError: for networks with modes or unknown names.
        SimulationError: if the curve cannot be followed.

    Limits: motions of the drive's period; subharmonics and torus motions show only as lost stability.

    Source: Krack & Gross, Harmonic Balance for Nonlinear Vibration Problems (2019), chapter 4.
    """
    demand("harmonic_response()", band=(band, _band), most=(most, whole(2)))
    dae = dae_of(network)
    balance = Balance(
        dae, driven, amplitude, outputs, harmonics, named("signals", signals), named("parameters", parameters)
    )
    return ResponseCurve([balance.orbit(y, w) for y, w in _followed(balance, band, most)])


def _band(value: Any) -> str:
    good = (
        isinstance(value, tuple | list)
        and len(value) == 2
        and not numbers(between(SLOWEST, 1 / SLOWEST))(value)
    )
    return (
        ""
        if good and value[0] != value[1]
        else "must be (first, last) frequency [Hz], two different ones above 0"
    )


def harmonic_orbit(
    network: Network | DAE,
    driven: str,
    amplitude: float,
    frequency: float,
    outputs: Sequence[str],
    *,
    harmonics: int = 9,
    signals: Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
) -> Orbit:
    """Return one periodic motion under amplitude sin(2 pi f t): the one that grows from rest.

    Args:
        network: as for `harmonic_response`, like all that follows.
        driven: the input.
        amplitude: of its sine, in its unit.
        frequency: [Hz].
        outputs: what is looked at, by name.
        harmonics: how many.
        signals: constant values of other inputs.
        parameters: changed parameters.
    """
    demand("harmonic_orbit()", frequency=(frequency, between(SLOWEST, 1 / SLOWEST, "Hz")))
    dae = dae_of(network)
    balance = Balance(
        dae, driven, amplitude, outputs, harmonics, named("signals", signals), named("parameters", parameters)
    )
    w = 2 * np.pi * frequency
    return balance.orbit(_at_frequency(balance, balance.start(), w), w)


def _followed(balance: Balance, band: tuple[float, float], most: int) -> list[tuple[Array, float]]:
    begin, end = (2 * np.pi * f for f in band)
    y = _at_frequency(balance, balance.start(), begin)
    scale = _Scale(y, begin, balance.size)
    point, step = scale.packed(y, begin), 0.02
    tangent = np.zeros(len(point))
    tangent[-1] = np.sign(end - begin)
    tangent = scale.tangent(balance, point, tangent)
    curve = [(y, begin)]
    while len(curve) < most:
        found = scale.corrected(balance, point + step * tangent, tangent)
        if found is None:
            step /= 2
            if step < SHORTEST:
                f = scale.unpacked(point)[1] / (2 * np.pi)
                raise SimulationError(
                    f"'{balance.dae.name}': the response is lost past {f:.6g} Hz; take more harmonics"
                )
            continue
        new, turned, iterations = found
        if turned @ tangent < 0.9 and step > 100 * SHORTEST:
            step /= 2
            continue
        point, tangent = new, turned
        y, w = scale.unpacked(point)
        curve.append((y, w))
        if (w - end) * (end - begin) >= 0:
            curve[-1] = (_at_frequency(balance, y, end), end)
            return curve
        wider = _Scale(y, begin, balance.size, scale)
        tangent = wider.direction(*scale.unpacked(tangent))
        scale, point = wider, wider.packed(y, w)
        step = min(LONGEST, step * (1.4 if iterations <= 3 else 0.8 if iterations > 5 else 1.0))
    raise SimulationError(f"'{balance.dae.name}': the response has not left the band after {most} points")


def _at_frequency(balance: Balance, y: Array, w: float) -> Array:
    """Solve at one frequency: from a guess, else from a simulated motion, else with rising amplitude."""
    found = _newton(balance, y, w)
    if found is None:
        found = _newton(balance, balance.simulated(w), w)
    return _raised(balance, w) if found is None else found


def _raised(balance: Balance, w: float) -> Array:
    """Raise the amplitude from nothing, in steps as long as they go."""
    full, done, step = balance.amplitude, 0.0, 0.1
    y = balance.start()
    try:
        while done < 1.0 and step > 2e-3:
            share = min(1.0, done + step)
            balance.amplitude = full * share
            found = _newton(balance, y, w)
            if found is None:
                step /= 2
            else:
                y, done, step = found, share, 1.5 * step
    finally:
        balance.amplitude = full
    if done < 1.0:
        raise SimulationError(
            f"'{balance.dae.name}': no periodic motion was found at {w / (2 * np.pi):.6g} Hz; follow "
            "harmonic_response() from another frequency, or take more harmonics"
        )
    return y


def _newton(balance: Balance, y: Array, w: float) -> Array | None:
    """Return the solution near a guess, None if Newton's method does not reach it."""
    missed, slope, _ = balance.residual(y, w)
    for _ in range(25):
        try:
            step = np.linalg.solve(slope, -missed)
        except np.linalg.LinAlgError:
            return None
        size, length = float(np.linalg.norm(missed)), 1.0
        while True:
            tried = balance.residual(y + length * step, w)
            if np.linalg.norm(tried[0]) <= size * (1 - 0.1 * length) + 1e-300 or length < 0.02:
                break
            length /= 2
        y, (missed, slope, _) = y + length * step, tried
        if np.linalg.norm(length * step) < 1e-10 * np.linalg.norm(y) + 1e-300:
            return y
    return None


class _Scale:
    """Coefficients and frequency brought to like size, on which arc length is measured."""

    def __init__(self, y: Array, w: float, size: int, before: _Scale | None = None) -> None:
        extent = np.sqrt((y.reshape(-1, size) ** 2).sum(axis=0))
        if before is not None:
            extent = np.maximum(extent, before.extent)
        self.extent: Array = np.maximum(extent, 1e-3 * extent.max(initial=1e-12))
        self.w = w
        self.weight: Array = np.tile(self.extent, len(y) // size)

    def packed(self, y: Array, w: float) -> Array:
        point: Array = np.r_[y / self.weight, w / self.w]
        return point

    def unpacked(self, point: Array) -> tuple[Array, float]:
        return point[:-1] * self.weight, float(point[-1] * self.w)

    def direction(self, y: Array, w: float) -> Array:
        packed = self.packed(y, w)
        unit: Array = packed / np.linalg.norm(packed)
        return unit

    def _bordered(self, balance: Balance, point: Array, tangent: Array) -> tuple[Array, Array]:
        y, w = self.unpacked(point)
        missed, slope, of_w = balance.residual(y, w)
        rows = np.tile(self.extent, len(y) // balance.size) * w
        slope = slope * self.weight / rows[:, None]
        whole = np.vstack([np.column_stack([slope, of_w * self.w / rows]), tangent])
        return missed / rows, whole

    def tangent(self, balance: Balance, point: Array, before: Array) -> Array:
        return _ahead(self._bordered(balance, point, before)[1])

    def corrected(self, balance: Balance, guess: Array, tangent: Array) -> tuple[Array, Array, int] | None:
        point = guess.copy()
        if point[-1] <= 0:
            return None
        for iteration in range(1, 12):
            missed, whole = self._bordered(balance, point, tangent)
            try:
                step = np.linalg.solve(whole, -np.r_[missed, tangent @ (point - guess)])
            except np.linalg.LinAlgError:
                return None
            point = point + step
            size = float(np.linalg.norm(step))
            if not np.isfinite(size) or size > 2.0 or point[-1] <= 0:
                return None
            if size < 1e-9:
                return point, _ahead(whole), iteration
        return None


def _ahead(whole: Array) -> Array:
    """Return the direction along the curve, on the side of the last one."""
    direction = np.linalg.solve(whole, np.r_[np.zeros(len(whole) - 1), 1.0])
    unit: Array = direction / np.linalg.norm(direction)
    return unit
