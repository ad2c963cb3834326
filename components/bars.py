"""Elastic bars with mass: rods and shafts, by modes and by lumps, and how far off their frequencies are."""

from itertools import pairwise
from math import pi, sin

import numpy as np

from ..base import counting, demand
from ..base.checks import Check, must, whole
from .language import Component, Expression, dissipation, energy, option
from .lossy import Lossy

Triple = tuple[Expression, Expression, Expression]
Moving = Triple  # position, speed and acceleration


class Bar(Lossy):
    """An elastic bar, straight between its ends but for coordinates `shape1`, `shape2`, ...

    A rod or a shaft gives `solid`, its mass, stiffness and damping, `ends` and how its coordinates move,
    `inner`; `shape` is one of them. By modes or by lumps, it gives `shapes`, `forces` and `works`.
    """

    shape: type[Component]
    kinetic = energy(lambda self: self.works[0])
    potential = energy(lambda self: self.works[1])
    lossPower = dissipation(lambda self: self.works[2])

    @property
    def solid(self) -> Triple:
        """Mass, stiffness and damping, or inertia and those against twist."""
        raise NotImplementedError

    @property
    def ends(self) -> tuple[Moving, Moving]:
        """How the ends move."""
        raise NotImplementedError

    @property
    def inner(self) -> list[Moving]:
        """How the coordinates move."""
        raise NotImplementedError

    @property
    def shapes(self) -> int:
        """Number of coordinates between the ends."""
        raise NotImplementedError

    @property
    def forces(self) -> tuple[Expression, Expression, list[Expression]]:
        """Forces into the ends, and what vanishes for each coordinate."""
        raise NotImplementedError

    @property
    def works(self) -> Triple:
        """Kinetic energy, potential energy and dissipated power."""
        raise NotImplementedError

    def parts(self) -> dict[str, Component]:
        """Return the coordinates."""
        return {f"shape{n}": self.shape() for n in range(1, self.shapes + 1)}


class ModalBar(Bar):
    """A bar whose shape is a straight line between its ends and n half waves of amplitude q_n on it.

    The waves take the inertia of the line into account exactly.

    Source: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA Journal 6
    (1968) 1313-1319, with the modes of a uniform bar.
    """

    modes = option("number of modes", default=4, check=counting)

    @property
    def shapes(self) -> int:
        return int(self.modes)

    def frequency_error(self, mode: int) -> float:
        """Return by what share a natural frequency, both ends free, is too high.

        Args:
            mode: its number, from 1 to modes + 1.

        Raises:
            ModelError: for a mode that it has not.
        """
        demand("frequency_error()", mode=(mode, one_up_to(self.modes + 1)))
        return modal_error(self.modes, mode)

    @property
    def waves(self) -> list[tuple[float, int, Moving]]:
        """Angle, sign at the right end, and motion of each."""
        return [(n * pi, -((-1) ** n), moving) for n, moving in enumerate(self.inner, start=1)]

    @property
    def forces(self) -> tuple[Expression, Expression, list[Expression]]:
        (mass, stiffness, damping), ((x_a, v_a, a_a), (x_b, v_b, a_b)) = self.solid, self.ends
        pull = stiffness * (x_b - x_a) + damping * (v_b - v_a)
        f_a, f_b, laws = mass * (a_a / 3 + a_b / 6) - pull, mass * (a_a / 6 + a_b / 3) + pull, []
        for angle, sign, (q, v, a) in self.waves:
            f_a, f_b = f_a + mass / angle * a, f_b + sign * mass / angle * a
            elastic = angle**2 / 2 * (stiffness * q + damping * v)
            laws.append(mass / angle * (a_a + sign * a_b) + mass / 2 * a + elastic)
        return f_a, f_b, laws

    @property
    def works(self) -> Triple:
        (mass, stiffness, damping), ((x_a, v_a, _), (x_b, v_b, _)) = self.solid, self.ends
        kinetic, strain, rubbed = (v_a**2 + v_a * v_b + v_b**2) / 6, (x_b - x_a) ** 2, (v_b - v_a) ** 2
        for angle, sign, (q, v, _) in self.waves:
            kinetic += (v_a + sign * v_b) * v / angle + v**2 / 4
            strain, rubbed = strain + (angle * q) ** 2 / 2, rubbed + (angle * v) ** 2 / 2
        return mass * kinetic, stiffness * strain / 2, damping * rubbed


class LumpedBar(Bar):
    """A bar as a row of springs and masses, halves at the ends, counted from the straight line."""

    segments = option("number of springs", default=8, check=counting)

    @property
    def shapes(self) -> int:
        return int(self.segments) - 1

    def frequency_error(self, mode: int) -> float:
        """Return by what share a natural frequency, both ends free, is off: below 0, as it is too low.

        Args:
            mode: its number, from 1 to segments.

        Raises:
            ModelError: for a mode that it has not.
        """
        demand("frequency_error()", mode=(mode, one_up_to(self.segments)))
        return lumped_error(self.segments, mode)

    @property
    def points(self) -> list[Moving]:
        """How the masses move, from end to end."""
        inner, (a, b), count = self.inner, self.ends, self.segments
        off = [(0.0, 0.0, 0.0), *inner, (0.0, 0.0, 0.0)]
        return [
            tuple(x + i / count * (y - x) + q for x, y, q in zip(a, b, shape, strict=True))
            for i, shape in enumerate(off)
        ]

    @property
    def forces(self) -> tuple[Expression, Expression, list[Expression]]:
        (mass, stiffness, damping), points, count = self.solid, self.points, self.segments
        pulls = [
            count * (stiffness * (right[0] - left[0]) + damping * (right[1] - left[1]))
            for left, right in pairwise(points)
        ]
        f_a = mass / (2 * count) * points[0][2] - pulls[0]
        f_b = mass / (2 * count) * points[-1][2] + pulls[-1]
        laws = [
            mass / count * point[2] + before - after
            for point, (before, after) in zip(points[1:-1], pairwise(pulls), strict=True)
        ]
        return f_a, f_b, laws

    @property
    def works(self) -> Triple:
        (mass, stiffness, damping), points, count = self.solid, self.points, self.segments
        squares = [v**2 for _, v, _ in points]
        moving = (sum(squares[:-1]) + sum(squares[1:])) / 2
        strain, rubbed = (sum((b[k] - a[k]) ** 2 for a, b in pairwise(points)) for k in (0, 1))
        return mass / count * moving / 2, count * stiffness * strain / 2, count * damping * rubbed


def modal_error(modes: int, mode: int) -> float:
    """Return by what share a natural frequency of a free bar is too high with some modes."""
    count = modes + 2
    inertia, elasticity = np.zeros((count, count)), np.zeros((count, count))
    inertia[:2, :2], elasticity[:2, :2] = [[1 / 3, 1 / 6], [1 / 6, 1 / 3]], [[1, -1], [-1, 1]]
    for n in range(1, modes + 1):
        coupling = np.array([1.0, -((-1.0) ** n)]) / (n * pi)
        inertia[:2, n + 1] = inertia[n + 1, :2] = coupling
        inertia[n + 1, n + 1], elasticity[n + 1, n + 1] = 0.5, (n * pi) ** 2 / 2
    squares = np.sort(np.abs(np.linalg.eigvals(np.linalg.solve(inertia, elasticity))))
    return float(np.sqrt(squares[mode]) / (mode * pi)) - 1


def lumped_error(segments: int, mode: int) -> float:
    """Return by what share a natural frequency of a free bar is too high (below 0: too low) in lumps."""
    x = mode * pi / (2 * segments)
    return sin(x) / x - 1


def one_up_to(most: int) -> Check:
    """Return a check for a whole number from 1 to another."""
    return lambda value: whole(1)(value) or must(f"be at most {most}", lambda given: given <= most)(value)
