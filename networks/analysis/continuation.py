"""Frequency response of nonlinear networks: harmonic balance followed along the curve, through folds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ...base import Array, Flags, ModelError, SimulationError, demand, numbers, shown, whole
from ..dae import DAE
from ..network import Network
from .balance import Balance
from .orbits import Orbit, drive_frequency

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIRST_STEP, LONGEST_STEP, SHORTEST_STEP = 0.02, 0.2, 1e-5  # along the curve, scaled


@dataclass(frozen=True, eq=False)
class ResponseCurve:
    """Periodic motions along a frequency response, in the order of the curve."""

    orbits: list[Orbit]

    @property
    def frequency(self) -> Array:
        """Frequencies [Hz]; where the curve folds back they fall."""
        return np.array([orbit.frequency for orbit in self.orbits])

    @property
    def stable(self) -> Flags:
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
        from ..results.figures import subplots
        from ..results.plotting import pretty_unit

        if not (axes is None or hasattr(axes, "plot")):
            raise ModelError(f"axes are matplotlib axes, got {shown(axes)}")
        f, size = self.frequency, self.peak(output)
        ax = axes if axes is not None else subplots(figsize=(7.0, 4.5), layout="constrained")[1]
        lost = ~self.stable
        edges = lost | np.r_[lost[1:], False] | np.r_[False, lost[:-1]]
        for label, drawn, style in (("stable", ~lost, "C0-"), ("unstable", edges, "C3--")):
            ax.plot(f, np.where(drawn, size, np.nan), style, label=label)
        unit = pretty_unit(self.orbits[0].dae.unit(output))
        ax.set(xlabel="frequency [Hz]", ylabel=f"{output} [{unit}]")
        ax.grid(alpha=0.3)
        ax.legend(frameon=False)
        return cast("Figure", ax.get_figure())


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
    balance = Balance(network, driven, amplitude, outputs, harmonics, signals, parameters)
    return ResponseCurve([balance.orbit(y, w) for y, w in _followed(balance, band, most)])


def _band(value: Any) -> str:
    pair = isinstance(value, tuple | list) and len(value) == 2 and not numbers(drive_frequency)(value)
    good = pair and value[0] != value[1]
    return "" if good else "must be (first, last) frequency [Hz], two different ones above 0"


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

    `frequency` is that of the drive [Hz]; all other arguments, and errors, are as for `harmonic_response`.
    """
    demand("harmonic_orbit()", frequency=(frequency, drive_frequency))
    balance = Balance(network, driven, amplitude, outputs, harmonics, signals, parameters)
    w = 2 * np.pi * frequency
    return balance.orbit(_at_frequency(balance, balance.start(), w), w)


def _followed(balance: Balance, band: tuple[float, float], most: int) -> list[tuple[Array, float]]:
    """Return coefficients and frequency [rad/s] along the curve: predicted by its tangent, then corrected."""
    begin, end = (2 * np.pi * f for f in band)
    point = np.append(_at_frequency(balance, balance.start(), begin), begin)
    sizes = _sizes(point, balance.size, begin)
    toward_end = np.append(np.zeros(len(point) - 1), np.sign(end - begin))
    tangent, step = _ahead(_bordered(balance, point, toward_end, sizes)[1]), FIRST_STEP
    curve = [point]
    while len(curve) < most:
        found = _corrected(balance, point + step * tangent * sizes, tangent, sizes)
        if found is None:
            step /= 2
            if step < SHORTEST_STEP:
                f = point[-1] / (2 * np.pi)
                raise SimulationError(
                    f"'{balance.dae.name}': the response is lost past {f:.6g} Hz; take more harmonics"
                )
            continue
        new, turned, iterations = found
        if turned @ tangent < 0.9 and step > 100 * SHORTEST_STEP:
            step /= 2
            continue
        point = new
        curve.append(point)
        if (point[-1] - end) * (end - begin) >= 0:
            curve[-1] = np.append(_at_frequency(balance, point[:-1], end), end)
            return [(each[:-1], float(each[-1])) for each in curve]
        wider = _sizes(point, balance.size, begin, sizes)
        tangent = turned * sizes / wider
        tangent, sizes = tangent / np.linalg.norm(tangent), wider
        step = min(LONGEST_STEP, step * (1.4 if iterations <= 3 else 0.8 if iterations > 5 else 1.0))
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


def _sizes(point: Array, unknowns: int, w: float, before: Array | None = None) -> Array:
    """Return the sizes of coefficients and frequency on which arc length is measured; they only grow."""
    coefficients = point[:-1].reshape(-1, unknowns)
    extent = np.linalg.norm(coefficients, axis=0)
    if before is not None:
        extent = np.maximum(extent, before[:unknowns])
    extent = np.maximum(extent, 1e-3 * extent.max(initial=1e-12))
    return np.append(np.tile(extent, len(coefficients)), w)


def _bordered(balance: Balance, point: Array, tangent: Array, sizes: Array) -> tuple[Array, Array]:
    """Return the residual and its slopes, scaled, with a tangent as the last row."""
    missed, slope, of_w = balance.residual(point[:-1], float(point[-1]))
    rows = sizes[:-1] * point[-1]
    slopes = np.column_stack([slope, of_w]) * sizes / rows[:, None]
    return missed / rows, np.vstack([slopes, tangent])


def _corrected(
    balance: Balance, guess: Array, tangent: Array, sizes: Array
) -> tuple[Array, Array, int] | None:
    """Return the point of the curve abreast of a guess, the tangent there and how often was iterated."""
    point = guess
    if point[-1] <= 0:
        return None
    for iteration in range(1, 12):
        missed, whole = _bordered(balance, point, tangent, sizes)
        try:
            step = np.linalg.solve(whole, -np.append(missed, tangent @ ((point - guess) / sizes)))
        except np.linalg.LinAlgError:
            return None
        point = point + step * sizes
        length = float(np.linalg.norm(step))
        if not length <= 2.0 or point[-1] <= 0:
            return None
        if length < 1e-9:
            return point, _ahead(whole), iteration
    return None


def _ahead(whole: Array) -> Array:
    """Return the direction along the curve, scaled, on the side of the last one."""
    direction = np.linalg.solve(whole, np.append(np.zeros(len(whole) - 1), 1.0))
    return np.asarray(direction / np.linalg.norm(direction))
