"""What a law may depend on, and the curves and maps it is made of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array
from ..criteria import LAW_POINTS, LAW_POINTS_OF_PAIRS, LAW_SLOW_SHARE
from ..effects.effect import Motion

VARIABLES = ("position", "speed", "acceleration", "load", "time")
UNITS = {
    "translational": dict(zip(VARIABLES, ("m", "m/s", "m/s2", "N", "s"), strict=True)),
    "rotational": dict(zip(VARIABLES, ("rad", "rad/s", "rad/s2", "N.m", "s"), strict=True)),
}


def along(motion: Motion, variable: str) -> Array:
    """Return a variable along a motion."""
    of = {"position": motion.s, "speed": motion.v, "acceleration": motion.a, "load": motion.f}
    return motion.elapsed if variable == "time" else of[variable]


@dataclass(frozen=True, eq=False)
class Axis:
    """One variable of a law, and the points between which it is straight or, of position alone, smooth."""

    variable: str
    points: Array
    smooth: bool = False

    @classmethod
    def over(
        cls, variable: str, motions: Sequence[Motion], pair: bool, finer: int = 1, even: bool = False
    ) -> Axis:
        """Return the axis that spans what was visited; points of speed lie close about rest, or all `even`.

        It has so many times as many points as usual.
        """
        values = np.concatenate([along(motion, variable) for motion in motions])
        low, high = float(values.min()), float(values.max())
        count = finer * (LAW_POINTS_OF_PAIRS if pair else LAW_POINTS)[VARIABLES.index(variable)]
        if variable == "speed" and low < 0 < high and not even:
            most = max(-low, high)
            widest, slow = np.arcsinh(1 / LAW_SLOW_SHARE), most * LAW_SLOW_SHARE
            points = slow * np.sinh(np.linspace(-widest, widest, count | 1))
            inside = (points > low + slow) & (points < high - slow)
            return cls(variable, np.concatenate([[low], points[inside], [high]]))
        return cls(variable, np.linspace(low, high, count), smooth=not pair and variable == "position")

    def basis(self, values: Array) -> Array:
        """Return for each point the curve that is 1 there and 0 at the others; held beyond the ends."""
        from scipy.interpolate import CubicSpline, interp1d

        unit = np.eye(len(self.points))
        within = np.clip(values, self.points[0], self.points[-1])
        if self.smooth:
            return np.asarray(CubicSpline(self.points, unit, bc_type="natural")(within))
        return np.asarray(interp1d(self.points, unit, axis=0)(within))

    @property
    def unevenness(self) -> Array:
        """Return rows that are zero of a straight line: bends, over how far points are apart."""
        apart = np.diff(self.points)
        slopes = np.diff(np.eye(len(self.points)), axis=0) / apart[:, None]
        return np.asarray(np.diff(slopes, axis=0) * (0.5 * (apart[1:] + apart[:-1]))[:, None])


@dataclass(frozen=True, eq=False)
class Grid:
    """One axis, or two that span a map."""

    axes: tuple[Axis, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        """What it is over."""
        return tuple(axis.variable for axis in self.axes)

    @property
    def size(self) -> int:
        """The number of its points."""
        return int(np.prod([len(axis.points) for axis in self.axes]))

    def basis(self, motion: Motion) -> Array:
        """Return what each point contributes along a motion; the last axis is the fastest."""
        first, *rest = (axis.basis(along(motion, axis.variable)) for axis in self.axes)
        for other in rest:
            first = (first[:, :, None] * other[:, None, :]).reshape(len(first), -1)
        return first

    @property
    def unevenness(self) -> Array:
        """Return rows that are zero of a plane."""
        if len(self.axes) == 1:
            return self.axes[0].unevenness
        one, other = (axis.unevenness for axis in self.axes)
        sizes = [len(axis.points) for axis in self.axes]
        rows = [np.kron(one, np.eye(sizes[1])), np.kron(np.eye(sizes[0]), other)]
        return np.asarray(np.vstack(rows), dtype=float)

    @property
    def places(self) -> Array:
        """The coordinates of its points, (points, axes)."""
        return np.stack(np.meshgrid(*(axis.points for axis in self.axes), indexing="ij"), -1).reshape(
            self.size, -1
        )
