"""Power spectral density of a signal of a run, by Welch's method."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, ModelError, above, demand, instance, one_name, shown
from ..results.over_time import OverTime
from ..results.plotting import pretty_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_SAMPLES, LEAST_SAMPLES = 10_000_000, 8  # in all, in a window


@dataclass(frozen=True, eq=False)
class PowerSpectrum:
    """One-sided power spectral density of a signal.

    Attributes:
        name, unit: of the signal; the density is in unit^2/Hz.
        frequency: [Hz].
        density: its integral over frequency is the variance of the signal.
        windows: how many were averaged; a density scatters by about 1/sqrt(windows) of itself.
    """

    name: str
    unit: str
    frequency: Array
    density: Array
    windows: int

    def plot(self, axes: Any = None) -> Figure:
        """Draw the density over frequency."""
        from ..results.figures import subplots

        if not (axes is None or hasattr(axes, "loglog")):
            raise ModelError(f"axes are matplotlib axes, got {shown(axes)}")
        ax: Any = axes if axes is not None else subplots(figsize=(7.0, 4.0), layout="constrained")[1]
        ax.loglog(self.frequency[1:], self.density[1:], linewidth=1.2)
        unit = pretty_unit(self.unit)
        squared = f"({unit})²/Hz" if unit and not unit.isalpha() else f"{unit}²/Hz" if unit else "1/Hz"
        ax.set(xlabel="frequency [Hz]", ylabel=f"density [{squared}]", title=self.name)
        ax.grid(which="both", alpha=0.3)
        figure: Figure = ax.get_figure()
        return figure


def power_spectrum(run: OverTime, name: str, window: float, *, rate: float) -> PowerSpectrum:
    """Return the one-sided power spectral density of a signal.

    Hann windows that overlap by half, the mean of each taken off (SciPy's `welch`); frequencies lie 1/window
    apart.

    Args:
        run: a `Result`, or anything else that is `OverTime`, as `Recorded(table)`.
        name: the signal.
        window: length of a window [s].
        rate: samples a second [Hz]; what is faster than half of it appears at lower frequencies.

    Raises:
        UnknownNameError: for an unknown signal, with the nearest one.
        ModelError: for a window that is longer than the run or has fewer than 8 samples.

    Source: P. D. Welch, The use of fast Fourier transform for the estimation of power spectra, IEEE Trans.
    Audio Electroacoust. 15 (1967) 70-73.
    """
    from scipy.signal import welch

    demand(
        "power_spectrum()",
        run=(run, instance(OverTime)),
        name=(name, one_name),
        window=(window, above(0, "s")),
        rate=(rate, above(0, "Hz")),
    )
    span = float(run.time[-1] - run.time[0])
    if span * rate > MOST_SAMPLES:
        raise ModelError(f"at {rate:g} Hz '{run.name}' has over {MOST_SAMPLES:g} samples; give a lower rate")
    samples = round(min(window, span + 1 / rate) * rate)
    if samples < LEAST_SAMPLES or window > span * (1 + 1e-9):
        raise ModelError(
            f"a window of '{name}' lasts at least {LEAST_SAMPLES} samples and at most as long as "
            f"'{run.name}', {span:g} s; got {window:g} s at {rate:g} Hz"
        )
    values = run.resample(1 / rate, name)[name].to_numpy(dtype=float)
    samples = min(samples, len(values))
    frequency, density = welch(values, rate, "hann", samples)
    windows = (len(values) - samples) // (samples - samples // 2) + 1
    return PowerSpectrum(name, run.unit(name), np.asarray(frequency), np.asarray(density), windows)
