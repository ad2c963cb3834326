"""Campbell diagram: natural frequencies over the speed of a shaft, and where excitation orders meet them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError, above, at_least, between, demand, named, numbers, shown, text
from ..dae import DAE
from ..given import dae_of
from ..network import Network
from .linearise import linearise
from .modes import Mode

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_SPEEDS, FASTEST, HIGHEST_ORDER = 10_000, 1e9, 1e6  # FASTEST in rad/s
UNLIKE = 1.8  # of 2: modes that have neither pole nor shape in common


@dataclass(frozen=True, eq=False)
class Campbell:
    """Oscillating modes over speed.

    Attributes:
        name: of the network.
        shaft: whose speed it is.
        speed: [rad/s].
        frequency: damped natural frequencies [Hz], (modes, speeds); nan where a mode does not oscillate.
        damping: their damping ratios; below 0 they grow.
    """

    name: str
    shaft: str
    speed: Array
    frequency: Array
    damping: Array
    modes_at: Callable[[float], list[Mode]]

    def crossings(self, order: float) -> list[tuple[float, float]]:
        """Return where a mode has `order` times the frequency of the shaft: speeds [rad/s], frequencies [Hz].

        Between two speeds of the diagram each is found by Brent's method on the network itself.
        """
        demand("crossings()", order=(order, _order))
        found = []
        for curve in self.frequency:
            gap = curve - order * self.speed / (2 * np.pi)
            for k in range(len(gap) - 1):
                if gap[k] == 0 or gap[k] * gap[k + 1] < 0:
                    speed = self._crossing(curve, k, order)
                    found.append((speed, order * speed / (2 * np.pi)))
            if gap[-1] == 0:
                found.append((float(self.speed[-1]), float(curve[-1])))
        return sorted(found)

    def _crossing(self, curve: Array, k: int, order: float) -> float:
        from scipy.optimize import root_scalar

        ends = self.speed[k : k + 2]

        def gap(speed: float) -> float:
            expected = np.interp(speed, ends, curve[k : k + 2])
            oscillating = [mode.damped_frequency for mode in _oscillating(self.modes_at(speed))]
            return min(oscillating, key=lambda f: abs(f - expected)) - order * speed / (2 * np.pi)

        if gap(float(ends[0])) * gap(float(ends[1])) >= 0:
            return float(ends[0])
        return float(root_scalar(gap, bracket=ends.tolist(), method="brentq", rtol=1e-12).root)

    def plot(self, orders: Sequence[float] = (1.0,), axes: Any = None) -> Figure:
        """Draw frequencies over speed, orders as rays, a dot where they meet; what grows is dotted.

        Args:
            orders: excitations per turn.
            axes: matplotlib axes; a new figure if None.
        """
        from ..results.figures import subplots

        demand("plot()", orders=(orders, numbers(_order)))
        if not (axes is None or hasattr(axes, "plot")):
            raise ModelError(f"axes are matplotlib axes, got {shown(axes)}")
        ax: Any = axes if axes is not None else subplots(figsize=(7.0, 4.5), layout="constrained")[1]
        for curve, damping in zip(self.frequency, self.damping, strict=True):
            (line,) = ax.plot(self.speed, curve, linewidth=1.6)
            ax.plot(self.speed, np.where(damping < -1e-9, curve, np.nan), ":", color="w", linewidth=1.6)
            line.set_zorder(1)
        top = 1.15 * float(np.nanmax(self.frequency))
        for order in np.ravel(orders).tolist():
            ax.plot(self.speed, order * self.speed / (2 * np.pi), color="0.6", linewidth=0.9)
            end = min(float(self.speed[-1]), 0.97 * top * 2 * np.pi / order)
            ax.annotate(f"{order:g}", (end, order * end / (2 * np.pi)), fontsize="small", color="0.4")
            for speed, frequency in self.crossings(order):
                ax.plot(speed, frequency, "ko", markersize=4)
        ax.set(xlim=(self.speed[0], self.speed[-1]), ylim=(0.0, top), title=self.name)
        ax.set(xlabel=f"{self.shaft} [rad/s]", ylabel="damped natural frequency [Hz]")
        ax.grid(alpha=0.3)
        figure: Figure = ax.get_figure()
        return figure


def campbell(
    network: Network | DAE,
    speed: str,
    speeds: ArrayLike,
    *,
    start: Mapping[str, float] | None = None,
    signals: Mapping[str, Any] | None = None,
    parameters: Mapping[str, float] | None = None,
) -> Campbell:
    """Return the modes of a network over the speed of a shaft, each followed from speed to speed.

    Modes are those of `linearise` at each speed: at the equilibrium if the speed is a parameter, at the
    start if it is an input or a start value, as a shaft that turns has no equilibrium. They are followed
    by their poles and shapes.

    Args:
        network: with the shaft in it.
        speed: the speed [rad/s]: a parameter ("rotor.w"), an input ("drive.w_ref") or a variable ("rotor.w").
        speeds: its values, rising, at least two.
        start: further start values by name.
        signals: constant parts of other inputs by name.
        parameters: changed parameters by name.

    Raises:
        ModelError: for a speed that is not there, not in rad/s, or values that do not rise; and if nothing
            oscillates.

    Example:
        >>> from inertance import Network, rotational
        >>> from inertance.analysis import campbell
        >>> net = Network("shaft", wall=rotational.Fixed(), shaft=rotational.Spring(c=900.0))
        >>> net = net.add(fan=rotational.Inertia(J=1.0), drive=rotational.Inertia(J=1.0))
        >>> net = net.connect(net.wall.flange, net.shaft.flange_a).connect(net.shaft.flange_b, net.fan.flange)
        >>> diagram = campbell(net, "drive.w", [1.0, 100.0])
        >>> [round(speed, 6) for speed, _ in diagram.crossings(order=3)]
        [10.0]
    """
    dae = dae_of(network)
    values = _speeds(speeds)
    kind = _kind(dae, speed)
    given: dict[str, Any] = {
        "start": named("start", start),
        "signals": named("signals", signals),
        "parameters": named("parameters", parameters),
    }
    at = "equilibrium" if kind == "parameters" else "start"

    def modes_at(value: float) -> list[Mode]:
        changed = given | {kind: given[kind] | {speed: value}}
        return linearise(dae, (), at=at, **changed).modes()

    tracks = _followed([_oscillating(modes_at(value)) for value in values.tolist()])
    if not tracks:
        raise ModelError(f"nothing in '{dae.name}' oscillates at any of these speeds")
    frequency = np.array([[mode.damped_frequency if mode else np.nan for mode in track] for track in tracks])
    damping = np.array([[mode.damping if mode else np.nan for mode in track] for track in tracks])
    order = np.argsort([np.nanmin(curve) for curve in frequency], kind="stable")
    return Campbell(dae.name, speed, values, frequency[order], damping[order], modes_at)


def _order(value: Any) -> str:
    return above(0)(value) or between(0, HIGHEST_ORDER)(value)


def _speeds(given: Any) -> Array:
    demand("campbell()", speeds=(given, numbers(at_least(0, "rad/s"))))
    values = np.ravel(np.asarray(given, dtype=float))
    if not (2 <= len(values) <= MOST_SPEEDS and (np.diff(values) > 0).all() and values[-1] <= FASTEST):
        raise ModelError(
            f"campbell() takes 2 to {MOST_SPEEDS} rising speeds up to {FASTEST:g} rad/s, got {shown(given)}"
        )
    return values


def _kind(dae: DAE, speed: str) -> str:
    """Return as what a speed is given."""
    if text(speed):
        raise ModelError(f"campbell() takes the name of a speed, got {shown(speed)}")
    if dae.unit(speed) != "rad/s":
        raise ModelError(f"'{speed}' of '{dae.name}' is in {dae.unit(speed) or '1'}, a speed is in rad/s")
    if speed in dae.parameter_values:
        return "parameters"
    return "signals" if speed in dae.input_names else "start"


def _oscillating(modes: list[Mode]) -> list[Mode]:
    return [mode for mode in modes if mode.damped_frequency > 1e-9 * mode.frequency > 0]


def _followed(found: list[list[Mode]]) -> list[list[Mode | None]]:
    """Return the modes at each speed as tracks, one after the other or None."""
    from scipy.optimize import linear_sum_assignment

    tracks: list[list[Mode | None]] = []
    for step, modes in enumerate(found):
        last = [next(mode for mode in reversed(track) if mode) for track in tracks]
        cost = np.zeros((len(last), len(modes)))
        for row, old in enumerate(last):
            cost[row] = [_unlikeness(old, new) for new in modes]
        taken = {
            int(new): int(old)
            for old, new in zip(*linear_sum_assignment(cost), strict=True)
            if cost[old, new] < UNLIKE
        }
        for track in tracks:
            track.append(None)
        for k, mode in enumerate(modes):
            if k in taken:
                tracks[taken[k]][-1] = mode
            else:
                tracks.append([*[None] * step, mode])
    return tracks


def _unlikeness(old: Mode, new: Mode) -> float:
    """Return the distance of the poles of two modes, and 1 less their modal assurance criterion."""
    a, b = (np.array(list(mode.state.values())) for mode in (old, new))
    alike = abs(np.vdot(a, b)) ** 2 / (np.vdot(a, a).real * np.vdot(b, b).real)
    return float(min(abs(old.pole - new.pole) / abs(old.pole), 1.0) + 1 - alike)
