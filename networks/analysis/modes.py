"""Modes: natural frequencies, damping ratios and shapes, drawn and moving; and transmission zeros."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Complex, ModelError, demand, finite, shown, whole
from ..dae import DAE
from ..given import dae_of
from ..network import Network
from .statespace import StateSpace, slowest_first

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Mode:
    """One natural motion, exp(pole t) times its shape.

    Attributes:
        pole: [rad/s]; one of a conjugate pair stands for both.
        shape: complex amplitudes of the outputs, by name; the greatest is 1.
        state: the same of the states.
    """

    pole: complex
    shape: dict[str, complex]
    state: dict[str, complex]

    @property
    def frequency(self) -> float:
        """Undamped natural frequency [Hz]."""
        return abs(self.pole) / (2 * math.pi)

    @property
    def damped_frequency(self) -> float:
        """Frequency of the oscillation [Hz], 0 if it creeps."""
        return abs(self.pole.imag) / (2 * math.pi)

    @property
    def damping(self) -> float:
        """Damping ratio: 1 and above creeps, below 0 grows; nan for a free motion."""
        return -self.pole.real / abs(self.pole) if self.pole else math.nan

    def __str__(self) -> str:
        return f"{self.frequency:.4g} Hz, damping {100 * self.damping:.3g} %"


def modes(system: StateSpace) -> list[Mode]:
    """Return a system's modes; see `StateSpace.modes`."""
    poles, vectors = (m.astype(np.complex128) for m in np.linalg.eig(system.A))
    return [
        Mode(
            complex(poles[k]),
            _scaled(system.outputs, system.C @ vectors[:, k]),
            _scaled(system.states, vectors[:, k]),
        )
        for k in slowest_first(poles)
        if poles[k].imag >= 0
    ]


def _scaled(names: Sequence[str], values: Complex) -> dict[str, complex]:
    """Return amplitudes by name, the greatest being 1."""
    top = values[np.argmax(np.abs(values))] if len(values) else 0.0
    return dict(zip(names, (values / top if top else values).tolist(), strict=True))


def transmission_zeros(system: StateSpace) -> Complex:
    """Return the finite generalised eigenvalues of [[A, B], [C, D]]; see `StateSpace.zeros`."""
    import scipy.linalg

    n, m = system.B.shape
    if len(system.C) != m or not system.proper:
        raise ModelError(
            f"'{system.name}': zeros are those of a proper system with as many inputs as outputs; pick "
            "a pair: system[output, input]"
        )
    pencil = np.block([[system.A, system.B], [system.C, system.D]])
    weight = scipy.linalg.block_diag(np.eye(n), np.zeros((m, m)))
    found = scipy.linalg.eigvals(pencil, weight, homogeneous_eigvals=True)
    alpha, beta = np.asarray(found, dtype=np.complex128)
    finite = np.abs(beta) > 1e-10 * np.abs(alpha)
    zeros: Complex = alpha[finite] / beta[finite]
    zeros = zeros[np.abs(zeros) < 1e6 * np.abs(system.poles).max(initial=1.0)]
    return zeros[slowest_first(zeros)]


def body_positions(network: Network | DAE) -> list[str]:
    """Return the names of the positions of all masses, in the order they were added.

    Raises:
        ModelError: if nothing there has a mass that slides.
    """
    dae = dae_of(network)
    found = [
        f"{path}.s"
        for path, instance in dae.flat.instances.items()
        if {"m", "s", "v", "a"} <= type(instance.component).fields.keys()
    ]
    if not found:
        angles = [v for v in dae.state_names if dae.unit(v) == "rad"]
        told = f"; it turns: name its angles, {', '.join(angles)}" if angles else ""
        raise ModelError(f"'{dae.name}' has no mass that slides, and so no positions of bodies{told}")
    return found


def plot_modes(modes: Sequence[Mode], *, phase: float = 0.0, axes: Any = None) -> Figure:
    """Draw mode shapes side by side: one point a body, bodies upwards, the motion to the side.

    The full line is the shape at `phase`, the grey ones its extent over a period.

    Args:
        modes: what to draw.
        phase: where in the period [rad].
        axes: matplotlib axes, one a mode; a new figure if None.
    """
    from ..results.figures import subplots

    modes = _modes(modes)
    demand("plot_modes()", phase=(phase, finite("rad")))
    if axes is None:
        size = (1.5 + 1.8 * len(modes), 4.0)
        _, axes = subplots(1, len(modes), sharey=True, figsize=size, layout="constrained")
    drawn_on = np.ravel(axes)
    if len(drawn_on) != len(modes) or not all(hasattr(ax, "fill_betweenx") for ax in drawn_on):
        raise ModelError(f"{len(modes)} modes need as many matplotlib axes, got {shown(axes)}")
    for ax, mode in zip(drawn_on, modes, strict=True):
        _draw(ax, mode, phase)
    figure: Figure = drawn_on[0].get_figure()
    return figure


def animate_modes(modes: Sequence[Mode], frames: int = 40) -> FuncAnimation:
    """Return the shapes in motion, one period; `.save("modes.gif", writer="pillow")` keeps it.

    Args:
        modes: what to draw.
        frames: pictures in a period.
    """
    from matplotlib.animation import FuncAnimation

    demand("animate_modes()", frames=(frames, whole(1)))
    modes = _modes(modes)
    figure = plot_modes(modes)

    def draw(frame: int) -> list[Any]:
        for ax, mode in zip(figure.axes, modes, strict=True):
            ax.clear()
            _draw(ax, mode, 2 * math.pi * frame / frames)
        return []

    return FuncAnimation(figure, draw, frames=frames, interval=50)


def _modes(given: Any) -> list[Mode]:
    if isinstance(given, Sequence) and len(given) and all(isinstance(mode, Mode) for mode in given):
        return list(given)
    raise ModelError(
        f"modes are those of a system, `linearise(...).modes()`, at least one; got {shown(given)}"
    )


def _draw(ax: Any, mode: Mode, phase: float) -> None:
    shape = np.array(list(mode.shape.values()))
    height = np.arange(len(shape))
    swing = np.abs(shape)
    ax.fill_betweenx(height, -swing, swing, color="0.92")
    ax.plot((shape * np.exp(1j * phase)).real, height, "o-", linewidth=1.6)
    ax.axvline(0.0, color="0.6", linewidth=0.8)
    ax.set_xlim(-1.15, 1.15)
    ax.set_yticks(height, list(mode.shape))
    ax.set_title(f"{mode.frequency:.3g} Hz\n{100 * mode.damping:.2g} %", fontsize="small")
    ax.set_xlabel("shape")
