"""Bode and Nyquist plots with names and units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError
from ..results.plotting import pretty_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .statespace import StateSpace


def frequencies(system: StateSpace, count: int = 600) -> Array:
    """Return frequencies [Hz] that show what the poles do: from a decade below them to one above."""
    natural = np.abs(system.poles) / (2 * np.pi)
    natural = natural[natural > 1e-9 * natural.max(initial=1.0)]
    if not len(natural):
        return np.geomspace(0.1, 100.0, count)
    return np.geomspace(natural.min() / 10, natural.max() * 10, count)


def plot_bode(system: StateSpace, f: ArrayLike | None = None) -> Figure:
    """Draw gain and phase over frequency, one column an input; see `StateSpace.plot_bode`."""
    from matplotlib import pyplot

    _check_inputs(system)
    at = frequencies(system) if f is None else np.atleast_1d(np.asarray(f, dtype=float)).ravel()
    response = system.response(at)
    figure, axes = pyplot.subplots(
        2, len(system.inputs), sharex=True, squeeze=False, figsize=(1.0 + 6.0 * len(system.inputs), 6.0),
        layout="constrained",
    )  # fmt: skip
    figure.suptitle(system.name)
    for column, (name, unit) in enumerate(zip(system.inputs, system.input_units, strict=True)):
        gain, phase = axes[0, column], axes[1, column]
        for row, (output, own) in enumerate(zip(system.outputs, system.output_units, strict=True)):
            curve = response[:, row, column]
            gain.loglog(at, np.abs(curve), label=f"{output} {_ratio(own, unit)}")
            phase.semilogx(at, np.rad2deg(np.unwrap(np.angle(curve))))
        gain.set_title(f"from {name}", fontsize="medium")
        gain.legend(fontsize="small", frameon=False)
        phase.set_xlabel("frequency [Hz]")
        for ax in (gain, phase):
            ax.grid(which="both", alpha=0.3)
            ax.margins(x=0)
    axes[0, 0].set_ylabel("gain")
    axes[1, 0].set_ylabel("phase [deg]")
    return figure


def plot_nyquist(system: StateSpace, f: ArrayLike | None = None) -> Figure:
    """Draw the frequency response in the complex plane; see `StateSpace.plot_nyquist`."""
    from matplotlib import pyplot

    _check_inputs(system)
    at = frequencies(system, 2000) if f is None else np.atleast_1d(np.asarray(f, dtype=float)).ravel()
    response = system.response(at)
    figure, ax = pyplot.subplots(figsize=(6.0, 5.5), layout="constrained")
    for row, output in enumerate(system.outputs):
        for column, name in enumerate(system.inputs):
            curve = response[:, row, column]
            unit = _ratio(system.output_units[row], system.input_units[column])
            ax.plot(curve.real, curve.imag, label=f"{name} → {output} {unit}")
    ax.axhline(0.0, color="0.6", linewidth=0.8)
    ax.axvline(0.0, color="0.6", linewidth=0.8)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("real part")
    ax.set_ylabel("imaginary part")
    ax.set_title(system.name)
    ax.legend(fontsize="small", frameon=False)
    return figure


def _check_inputs(system: StateSpace) -> None:
    if not system.inputs:
        raise ModelError(f"'{system.name}' has no inputs to draw a response to; give linearise() some")


def _ratio(output: str, given: str) -> str:
    if output == given:
        return ""
    above, below = pretty_unit(output) or "1", pretty_unit(given)
    return f"[{above}]" if not below else f"[{above} / ({below})]"
