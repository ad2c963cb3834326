"""Spectrogram: what a signal is made of over time, by short-time Fourier transform."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, ModelError, above, demand, instance, one_name, optional, shown
from ..results.over_time import OverTime
from ..results.plotting import pretty_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_SAMPLES, LEAST_SAMPLES = 10_000_000, 8  # in all, in a window
HOPS_A_WINDOW = 8
LEAKED = 2  # lines that the mean leaks into


@dataclass(frozen=True, eq=False)
class ChangingSpectrum:
    """Amplitudes of a signal's parts in windows: (parts, windows)."""

    name: str
    unit: str
    time: Array
    amplitude: Array


@dataclass(frozen=True, eq=False)
class Spectrogram(ChangingSpectrum):
    """What a signal is made of over time: a lasting sine shows at its frequency, with its amplitude.

    Attributes:
        name, unit: of the signal.
        time: middles of the windows [s].
        frequency: [Hz].
        amplitude: (frequencies, windows), in the signal's unit.
    """

    frequency: Array

    def strongest(self) -> Array:
        """Return the frequency of the greatest amplitude in each window, the mean left out [Hz]."""
        return strongest_part(self, self.frequency)

    def plot(self, axes: Any = None) -> Figure:
        """Draw amplitudes over time and frequency."""
        return drawn(self, self.time, self.frequency, ("time [s]", "frequency [Hz]"), axes)


def spectrogram(run: OverTime, name: str, window: float, *, rate: float | None = None) -> Spectrogram:
    """Return the amplitudes of a signal's parts over time and frequency.

    Hann windows, each an eighth of its length after the last; frequencies lie 1/window apart.

    Args:
        run: a `Result`, or anything else that is `OverTime`, as `Recorded(table)`.
        name: of the signal.
        window: length of a window [s].
        rate: samples a second [Hz]; as many as the run has points if None.

    Raises:
        UnknownNameError: for an unknown name, with the nearest one.
        ModelError: for a window longer than the run, or with fewer than 8 samples.

    Limits: what is above rate/2 folds back.

    Example:
        >>> import numpy as np, pandas as pd
        >>> from inertance import Recorded
        >>> from inertance.analysis import spectrogram
        >>> t = np.arange(0.0, 10.0, 1e-3)
        >>> table = pd.DataFrame({"y": np.sin(50 * np.pi * t)}, index=t)
        >>> told = spectrogram(Recorded(table), "y", window=1.0)
        >>> round(float(told.strongest()[0]), 6), round(float(told.amplitude.max()), 6)
        (25.0, 1.0)
    """
    demand(
        "spectrogram()",
        run=(run, instance(OverTime)),
        name=(name, one_name),
        window=(window, above(0, "s")),
        rate=(rate, optional(above(0, "Hz"))),
    )
    begin, end = float(run.time[0]), float(run.time[-1])
    if rate is None:
        rate = (len(run.time) - 1) / (end - begin) if end > begin else 1.0
    if not (window <= (end - begin) * (1 + 1e-9) and window * rate >= LEAST_SAMPLES):
        raise ModelError(
            f"a window of '{name}' lasts at least {LEAST_SAMPLES} samples and at most as long as "
            f"'{run.name}', {end - begin:g} s; got {window:g} s at {rate:g} Hz"
        )
    if (end - begin) * rate > MOST_SAMPLES:
        raise ModelError(f"at {rate:g} Hz '{run.name}' has over {MOST_SAMPLES:g} samples; give a lower rate")
    instants = begin + np.arange(int((end - begin) * rate * (1 + 1e-12)) + 1) / rate
    values = run.at(name, np.minimum(instants, end))
    middles, frequency, amplitude = amplitudes_in_windows(values, rate, window)
    return Spectrogram(name, run.unit(name), begin + middles, amplitude, frequency)


def amplitudes_in_windows(values: Array, rate: float, window: float) -> tuple[Array, Array, Array]:
    """Return middles of the windows that lie within the samples, frequencies, and amplitudes."""
    from scipy.signal import ShortTimeFFT
    from scipy.signal.windows import hann

    samples = min(round(window * rate), len(values))
    hop = max(1, samples // HOPS_A_WINDOW)
    transform = ShortTimeFFT(hann(samples, sym=False), hop, rate, fft_mode="onesided2X", scale_to="magnitude")
    count, first = (len(values) - samples) // hop + 1, -(-(samples // 2) // hop)
    ahead = first * hop - samples // 2  # so that the first window begins with the first sample
    padded = np.concatenate([np.zeros(ahead), values])
    amplitude = np.abs(transform.stft(padded, first, first + count))
    middles = transform.t(len(padded), first, first + count) - ahead / rate
    return middles, transform.f, amplitude


def strongest_part(spectrum: ChangingSpectrum, parts: Array) -> Array:
    """Return the part of the greatest amplitude in each window, at the top of a parabola through its line."""
    k = LEAKED + spectrum.amplitude[LEAKED:-1].argmax(axis=0)
    level = np.log(np.maximum(spectrum.amplitude, 1e-300))
    before, top, after = (level[k + shift, np.arange(len(k))] for shift in (-1, 0, 1))
    bend = np.minimum(before - 2 * top + after, -1e-12)
    aside = np.clip((before - after) / (2 * bend), -0.5, 0.5)
    return np.asarray(parts[k] + aside * (parts[1] - parts[0]))


def drawn(
    spectrum: ChangingSpectrum, across: Array, parts: Array, labels: tuple[str, str], axes: Any
) -> Figure:
    """Return the picture of amplitudes over two quantities."""
    from ..results.figures import subplots

    if not (axes is None or hasattr(axes, "pcolormesh")):
        raise ModelError(f"axes are matplotlib axes, got {shown(axes)}")
    ax: Any = axes if axes is not None else subplots(figsize=(7.5, 4.5), layout="constrained")[1]
    mesh = ax.pcolormesh(across, parts, spectrum.amplitude, shading="nearest", cmap="magma_r")
    figure: Figure = ax.get_figure()
    unit = pretty_unit(spectrum.unit)
    figure.colorbar(mesh, ax=ax, label=f"amplitude [{unit}]" if unit else "amplitude")
    ax.set(xlabel=labels[0], ylabel=labels[1], title=spectrum.name)
    return figure
