"""Elastic bars with mass: rods and shafts, by modes and by lumps, and how far off their frequencies are."""

from itertools import pairwise
from math import pi, sin

import numpy as np

from ..base.checks import Check, must, whole
from .language import Expression

End = tuple[Expression, Expression, Expression]  # position, speed and acceleration


def modal_bar(
    mass: Expression, stiffness: Expression, damping: Expression, ends: tuple[End, End], modes: list[End]
) -> tuple[Expression, Expression, list[Expression]]:
    """Return the forces into both ends of a bar, and what vanishes for each mode between held ends.

    The bar's shape is a straight line between its ends and n half waves of amplitude q_n on it, which takes
    their inertia into account exactly.

    Source: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA Journal 6
    (1968) 1313-1319, with the modes of a uniform bar.
    """
    (x_a, v_a, a_a), (x_b, v_b, a_b) = ends
    pull = stiffness * (x_b - x_a) + damping * (v_b - v_a)
    f_a, f_b, laws = mass * (a_a / 3 + a_b / 6) - pull, mass * (a_a / 6 + a_b / 3) + pull, []
    for n, (q, v, a) in enumerate(modes, start=1):
        sign = -((-1) ** n)
        f_a, f_b = f_a + mass / (n * pi) * a, f_b + sign * mass / (n * pi) * a
        elastic = (n * pi) ** 2 / 2 * (stiffness * q + damping * v)
        laws.append(mass / (n * pi) * (a_a + sign * a_b) + mass / 2 * a + elastic)
    return f_a, f_b, laws


def lumped_bar(
    mass: Expression, stiffness: Expression, damping: Expression, ends: tuple[End, End], inner: list[End]
) -> tuple[Expression, Expression, list[Expression]]:
    """Return the same for a row of springs and masses, halves at the ends, counted from the straight line."""
    count = len(inner) + 1
    line = [[a + i / count * (b - a) for a, b in zip(*ends, strict=True)] for i in range(1, count)]
    off = [[x + q for x, q in zip(*both, strict=True)] for both in zip(line, inner, strict=True)]
    points = [ends[0], *off, ends[1]]
    pulls = [
        count * (stiffness * (right[0] - left[0]) + damping * (right[1] - left[1]))
        for left, right in pairwise(points)
    ]
    f_a = mass / (2 * count) * points[0][2] - pulls[0]
    f_b = mass / (2 * count) * points[-1][2] + pulls[-1]
    laws = [
        mass / count * point[2] + before - after
        for point, (before, after) in zip(off, pairwise(pulls), strict=True)
    ]
    return f_a, f_b, laws


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
