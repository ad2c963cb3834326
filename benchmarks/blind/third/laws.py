"""Laws drawn at random, of which no list has a name, and causes that no static law can be."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Law = Callable[[Array, Array], Array]  # of elongation and its speed, each over what is usual
LAWS = ("monotone", "comb", "dead_band", "map")
OTHERS = ("jam", "loose_part", "varying_mass", "softening")


def drawn(kind: str, rng: np.random.Generator) -> Law:
    """Return a law, about 1 in size where elongation and speed are about 1."""
    return {"monotone": _monotone, "comb": _comb, "dead_band": _dead_band, "map": _map}[kind](rng)


def _steps(rng: np.random.Generator, least: float) -> Callable[[Array], Array]:
    """Return a curve that rises by steps of random place, height and width, and is 0 at 0."""
    places, heights = rng.uniform(-1.5, 1.5, 4), rng.dirichlet(np.ones(4)) * 2
    widths = rng.uniform(least, 0.6, 4)

    def curve(x: Array) -> Array:
        return sum(
            h * (np.tanh((x - p) / w) + np.tanh(p / w))
            for p, h, w in zip(places, heights, widths, strict=True)
        )

    return curve


def _monotone(rng: np.random.Generator) -> Law:
    curve = _steps(rng, 0.08)
    return lambda s, v: curve(v)


def _comb(rng: np.random.Generator) -> Law:
    """Return two waves over position whose periods have no common one."""
    first = rng.uniform(0.5, 1.2)
    periods, phases = (first, first * rng.uniform(1.4, 1.9)), rng.uniform(0, 2 * np.pi, 2)
    sizes = (1.0, rng.uniform(0.4, 0.9))

    def law(s: Array, v: Array) -> Array:
        waves = zip(sizes, periods, phases, strict=True)
        return sum(a * (np.sin(2 * np.pi * s / p + f) - np.sin(f)) for a, p, f in waves)

    return law


def _dead_band(rng: np.random.Generator) -> Law:
    """Return a spring that begins beyond a gap, of another gap, slope and bend on each side."""
    gaps, slopes, bends = rng.uniform(0.3, 0.9, 2), rng.uniform(0.8, 2.5, 2), rng.uniform(1.0, 1.6, 2)

    def law(s: Array, v: Array) -> Array:
        right, left = np.maximum(s - gaps[0], 0.0), np.maximum(-s - gaps[1], 0.0)
        return slopes[0] * right ** bends[0] - slopes[1] * left ** bends[1]

    return law


def _map(rng: np.random.Generator) -> Law:
    """Return a curve over speed whose size is another one at each position."""
    curve = _steps(rng, 0.25)
    places, widths, sizes = rng.uniform(-1.2, 1.2, 3), rng.uniform(0.4, 0.9, 3), rng.uniform(0.3, 2.0, 3)

    def law(s: Array, v: Array) -> Array:
        bumps = sum(a * np.exp(-(((s - p) / w) ** 2)) for a, p, w in zip(sizes, places, widths, strict=True))
        return (0.2 + bumps) * curve(v)

    return law
