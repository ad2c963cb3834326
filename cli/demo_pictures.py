"""The pictures of `inertance demo`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import CenteredNorm
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from ..machines import PlanetaryGeometry, Sinusoid, ge_wang
from .outputs import draw

if TYPE_CHECKING:
    from .demo_runs import Cycle, Responses

LINE_STYLES: dict[str, dict[str, Any]] = {
    "planetary": {"color": "tab:blue", "linewidth": 1.6},
    "disk": {"color": "tab:orange", "linewidth": 1.2, "linestyle": "--"},
}


def draw_cycles(path: Path, tests: Sequence[Sinusoid], cycles: Mapping[str, Sequence[Cycle]]) -> Path:
    """Draw force over time and over displacement for every test, and return the path."""
    figure = Figure(figsize=(15, 7.5), layout="constrained")
    axes = figure.subplots(2, len(tests))
    for column, test in enumerate(tests):
        over_time, over_travel = axes[:, column]
        for name, look in LINE_STYLES.items():
            cycle = cycles[name][column]
            over_time.plot(cycle.t, cycle.F, label=name, **look)
            over_travel.plot(1e3 * cycle.x, cycle.F, label=name, **look)
        over_time.set_title(f"{1e3 * test.amplitude:g} mm, {test.frequency:g} Hz")
        over_time.set_xlabel("time in the cycle [s]")
        over_travel.set_xlabel("displacement [mm]")
        for ax in (over_time, over_travel):
            ax.grid(alpha=0.3)
    for ax in axes[:, 0]:
        ax.set_ylabel("force on the rod [N]")
    axes[0, 0].legend(title="flywheel")
    figure.suptitle("Inerters of equal inertance, 385 kg, under sinusoidal displacement")
    return draw(figure, path, dpi=130)


def draw_responses(path: Path, responses: Responses) -> Path:
    """Draw gain, phase and the ratio of both gains over frequency, and return the path."""
    figure = Figure(figsize=(9, 9), layout="constrained")
    gain, phase, ratio = figure.subplots(3, 1, sharex=True, height_ratios=(3, 1.5, 1.5))
    f = responses.f
    ideal = (ge_wang.B + ge_wang.SCREW["m_r"]) * (2 * np.pi * f) ** 2
    gain.loglog(f, ideal, color="0.5", linewidth=1, linestyle=":", label="ideal, $(b + m_r)\\,\\omega^2$")
    for name, H in (("planetary", responses.planetary), ("disk", responses.disk)):
        gain.loglog(f, np.abs(H), label=name, **LINE_STYLES[name])
        phase.semilogx(f, np.degrees(np.angle(H)) % 360, **LINE_STYLES[name])
    ratio.semilogx(f, responses.ratio, color="tab:blue")
    ratio.axhline(1, color="0.5", linewidth=1)
    gain.set_ylabel("gain |H| [N/m]")
    gain.legend(title="flywheel")
    phase.set_ylabel("phase [°]")
    ratio.set_ylabel("gain of planetary\nover disk")
    ratio.set_xlabel("frequency [Hz]")
    ratio.set_xticks([0.5, 1, 2, 5, 10, 15])
    ratio.xaxis.set_major_formatter(ScalarFormatter())
    ratio.set_xlim(f[0], f[-1])
    for ax in (gain, phase, ratio):
        ax.grid(which="both", alpha=0.25)
        ax.axvline(2, color="tab:green", linewidth=1)
    figure.suptitle("Force per displacement under random displacement, 0.5 to 15 Hz")
    return draw(figure, path, dpi=130)


def draw_design_map(path: Path, prototype: PlanetaryGeometry) -> Path:
    """Draw the gain of eq. (15) over lambda and tau, with the prototype on it; return the path."""
    lam, tau = np.meshgrid(np.linspace(0.01, 0.46, 200), np.linspace(0.0, 4.0, 200))
    gain = PlanetaryGeometry(prototype.N, lam, prototype.beta, tau).gain
    figure = Figure(figsize=(8.5, 6), layout="constrained")
    ax = figure.subplots()
    levels = np.arange(0.84, 1.27, 0.02)
    filled = ax.contourf(lam, tau, gain, levels, cmap="RdBu", norm=CenteredNorm(1.0), extend="both")
    lines = ax.contour(lam, tau, gain, np.delete(levels, 8)[::2], colors="0.25", linewidths=0.5)
    ax.clabel(lines, fmt="%.2f", fontsize=8)
    limit = float(prototype.adjacency_limit)
    ax.axvspan(limit, 0.46, facecolor="white", alpha=0.6, hatch="//", edgecolor="0.4")
    ax.axvline(float(prototype.threshold), color="k", linestyle="--", label="A = A', threshold of (15)")
    ax.axvline(limit, color="0.4", label="planets touch, (12)")
    ax.plot(prototype.lam, prototype.tau, "*", color="gold", markeredgecolor="k", markersize=16,
            linestyle="none", label=f"prototype, A/A' = {prototype.gain:.3f}")  # fmt: skip
    ax.set_xlabel("radius of a planet over that of the ring, λ")
    ax.set_ylabel("thickness of the planets over that of the bracket, τ")
    ax.set_title(f"Inertia per mass against a disk, N = {prototype.N}, β = {prototype.beta:.2f}")
    ax.legend(loc="lower left")
    figure.colorbar(filled, ax=ax, label="A/A'")
    return draw(figure, path, dpi=130)
