"""Effects that come back with travel: threads, poles, teeth."""

from __future__ import annotations

from math import inf, pi
from typing import Any

import numpy as np

from ...base import Array
from .. import criteria
from .across import across
from .effect import Extent, Motion, Values, both

_PERIOD = (("period", "m"), ("period", "rad"), 0.0, True)


def _amplitudes(suffix: str = "") -> dict[str, tuple[Any, ...]]:
    """Return sine and cosine of a ripple as quantities of both signs."""
    return {
        f"{wave}{suffix}": ((f"f_{wave}{suffix}", "N"), (f"tau_{wave}{suffix}", "N.m"), -inf)
        for wave in ("sin", "cos")
    }


def _periods(motion: Extent, counts: tuple[int, int], tried: int) -> list[dict[str, float]]:
    return [{"period": 2 * motion.travel / count} for count in np.geomspace(*counts, tried)]


def _waves(motion: Motion, shape: Values, harmonics: int) -> list[Array]:
    x = 2 * pi * motion.s / shape["period"]
    return [wave(h * x) for h in range(1, harmonics + 1) for wave in (np.sin, np.cos)]


across(
    "position_ripple",
    "Ripple",
    both(**_amplitudes(), period=_PERIOD),
    lambda motion, shape: _waves(motion, shape, 1),
    shapes=lambda motion: _periods(motion, criteria.RIPPLES_PER_TRAVEL, criteria.RIPPLE_PERIODS),
    origin=lambda site: 0.0,
)
across(
    "harmonic_ripple",
    "HarmonicRipple",
    both(**_amplitudes(), **_amplitudes("_2"), **_amplitudes("_3"), period=_PERIOD),
    lambda motion, shape: _waves(motion, shape, 3),
    shapes=lambda motion: _periods(motion, criteria.HARMONICS_PER_TRAVEL, criteria.HARMONIC_PERIODS),
    origin=lambda site: 0.0,
    plain=("position_ripple", tuple(map(tuple, np.eye(6, 2).tolist()))),
)
