"""Effects that come back with travel: threads, poles, teeth."""

from __future__ import annotations

from itertools import pairwise
from math import inf, pi
from typing import Any

import numpy as np

from ...base import Array
from .. import criteria
from .across import across
from .effect import Extent, Motion, Values, both
from .sites import Site

_PERIOD = (("period", "m"), ("period", "rad"), 0.0, True)


def _amplitudes(suffix: str = "") -> dict[str, tuple[Any, ...]]:
    """Return sine and cosine of a ripple as quantities of both signs."""
    return {
        f"{wave}{suffix}": ((f"f_{wave}{suffix}", "N"), (f"tau_{wave}{suffix}", "N.m"), -inf)
        for wave in ("sin", "cos")
    }


def _periods(extent: Extent, counts: tuple[int, int], bands: int) -> list[dict[str, float]]:
    """Return periods to try: where it is known what waves would explain, the best of each band of them."""
    if isinstance(extent, Site) or extent.missed is None:
        most = criteria.MOST_RIPPLES_PER_TRAVEL if isinstance(extent, Site) else counts[1]
        tried = np.geomspace(counts[0], most, bands)
    else:
        tried = _promising(
            extent, extent.missed, np.geomspace(counts[0], _most(extent, counts[1]), bands + 1)
        )
    return [{"period": 2 * extent.travel / count} for count in tried.tolist()]


def _most(motion: Motion, least: int) -> float:
    """Return how many periods in the range of a site are passed by no faster than can be seen."""
    seen = motion.travel * len(motion.t) / (np.ptp(motion.t) * np.abs(motion.v).max())
    return float(np.clip(seen, least, criteria.MOST_RIPPLES_PER_TRAVEL))


def _promising(motion: Motion, missed: tuple[Array, Array], edges: Array) -> Array:
    """Return the highest peak in each band of the periodogram of what is missed over distance, or its middle.

    However many periods the range of the site has, a peak is one of them wide.
    """
    s, product = missed
    points = criteria.RIPPLE_POINTS * edges[-1]  # in the range of the site
    place = ((s - s.min()) * points / (2 * motion.travel)).astype(int)
    over_distance = np.bincount(place, product)
    length = criteria.RIPPLE_PEAK_POINTS * max(int(points), len(over_distance))
    height = np.abs(np.fft.rfft(over_distance, length))
    peaks = 1 + np.flatnonzero((height[1:-1] > height[:-2]) & (height[1:-1] >= height[2:]))
    counts = peaks * points / length
    found = np.sqrt(edges[1:] * edges[:-1])
    for band, (low, high) in enumerate(pairwise(edges)):
        inside = (counts >= low) & (counts < high)
        if inside.any():
            found[band] = counts[inside][np.argmax(height[peaks[inside]])]
    return found


def _waves(motion: Motion, shape: Values, harmonics: int) -> list[Array]:
    x = 2 * pi * motion.s / shape["period"]
    return [wave(h * x) for h in range(1, harmonics + 1) for wave in (np.sin, np.cos)]


def _as_overtone(values: Values) -> list[dict[str, float]]:
    """Return a ripple's wave as the second and the third of a longer period."""
    *waves, period = values
    first = [values[name] for name in waves[:2]]
    return [
        dict.fromkeys(waves, 0.0)
        | dict(zip(waves[2 * n - 2 : 2 * n], first, strict=True))
        | {period: n * values[period]}
        for n in (2, 3)
    ]


def _has_waves(values: Values) -> bool:
    """Tell whether a ripple is more than one overtone, which would be a plain one of a shorter period."""
    *waves, _ = values.values()
    first, *overtones = np.square(waves).reshape(-1, 2).sum(axis=1)
    strongest = max(overtones)
    return bool(first + sum(overtones) - strongest >= criteria.WAVES_LEAST_SHARE * strongest)


across(
    "position_ripple",
    "Ripple",
    both(**_amplitudes(), period=_PERIOD),
    lambda motion, shape: _waves(motion, shape, 1),
    shapes=lambda motion: _periods(motion, criteria.RIPPLES_PER_TRAVEL, criteria.RIPPLE_PERIODS),
    origin=lambda site: 0.0,
    rough=True,
    displaces=True,
)
across(
    "harmonic_ripple",
    "HarmonicRipple",
    both(**_amplitudes(), **_amplitudes("_2"), **_amplitudes("_3"), period=_PERIOD),
    lambda motion, shape: _waves(motion, shape, 3),
    shapes=lambda motion: _periods(motion, criteria.HARMONICS_PER_TRAVEL, criteria.HARMONIC_PERIODS),
    origin=lambda site: 0.0,
    rough=True,
    displaces=True,
    plain={"position_ripple": tuple(map(tuple, np.eye(6, 2).tolist()))},
    credible=_has_waves,
    likewise=_as_overtone,
)
