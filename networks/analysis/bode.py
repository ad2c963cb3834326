"""Bode and Nyquist plots with names and units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, Complex, ModelError, between, demand, numbers, optional
from ..results.plotting import pretty_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .statespace import StateSpace


def plot_bode(system: StateSpace, f: ArrayLike | None = None) -> Figure:
    """Draw gain and phase over frequency, one column an input; see `StateSpace.plot_bode`."""
    from ..results.figures import subplots

    at, response = _response(system, f, "plot_bode()", 600)
    size = (1.0 + 6.0 * len(system.inputs), 6.0)
    figure, axes = subplots(
        2, len(system.inputs), sharex=True, squeeze=False, figsize=size, layout="constrained"
    )
    figure.suptitle(system.name)
    for column, (gain, phase) in enumerate(axes.T):
        for row, output in enumerate(system.outputs):
            curve = response[:, row, column]
            gain.loglog(at, np.abs(curve), label=f"{output} {_unit_of_gain(system, row, column)}")
            phase.semilogx(at, np.rad2deg(np.unwrap(np.angle(curve))))
        gain.set_title(f"from {system.inputs[column]}", fontsize="medium")
        gain.legend(fontsize="small", frameon=False)
        phase.set_xlabel("frequency [Hz]")
    for ax in axes.ravel():
        ax.grid(which="both", alpha=0.3)
        ax.margins(x=0)
    axes[0, 0].set_ylabel("gain")
    axes[1, 0].set_ylabel("phase [deg]")
    return figure


def plot_nyquist(system: StateSpace, f: ArrayLike | None = None) -> Figure:
    """Draw the frequency response in the complex plane; see `StateSpace.plot_nyquist`."""
    from ..results.figures import subplots

    _, response = _response(system, f, "plot_nyquist()", 2000)
    figure, ax = subplots(figsize=(6.0, 5.5), layout="constrained")
    for row, output in enumerate(system.outputs):
        for column, name in enumerate(system.inputs):
            curve = response[:, row, column]
            ax.plot(curve.real, curve.imag, label=f"{name} → {output} {_unit_of_gain(system, row, column)}")
    ax.axhline(0.0, color="0.6", linewidth=0.8)
    ax.axvline(0.0, color="0.6", linewidth=0.8)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set(xlabel="real part", ylabel="imaginary part", title=system.name)
    ax.legend(fontsize="small", frameon=False)
    return figure


def _response(system: StateSpace, f: Any, where: str, count: int) -> tuple[Array, Complex]:
    """Return frequencies [Hz], about the poles and a decade beyond if none are given, and the response."""
    demand(where, f=(f, optional(numbers(between(0, 1e60, "Hz")))))
    if not system.inputs:
        raise ModelError(f"'{system.name}' has no inputs to draw a response to; give linearise() some")
    if f is None:
        natural = np.abs(system.poles) / (2 * np.pi)
        natural = natural[natural > 1e-9 * natural.max(initial=1.0)]
        low, high = (natural.min(), natural.max()) if len(natural) else (1.0, 10.0)
        f = np.geomspace(low / 10, high * 10, count)
    at = np.ravel(np.asarray(f, dtype=float))
    return at, system.response(at)


def _unit_of_gain(system: StateSpace, row: int, column: int) -> str:
    output, given = system.output_units[row], system.input_units[column]
    if output == given:
        return ""
    above, below = pretty_unit(output) or "1", pretty_unit(given)
    return f"[{above}]" if not below else f"[{above} / ({below})]"
