"""What an engineer sees in a drawn law, in words: steps, symmetry, direction, waves, memory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ..criteria import LAW_EVEN_SHARE, LAW_MEMORY_SHARE, LAW_STEP_SHARE, LAW_STEP_WITHIN, LAW_WAVES

if TYPE_CHECKING:
    from .law import Law


def traits_of(law: Law) -> list[str]:
    """Return what a law looks like."""
    told = []
    if len(law.grid.axes) == 1:
        x, f, error = law.grid.axes[0].points, law.values, law.standard_error
        span = float(np.ptp(f))
        told += [*_step(law, x, f, span), *_symmetry(x, f, error, span), *_direction(f, error, span)]
    if not law.level_known:
        told.append("known but for a constant, which zeros of sensors or starts of records make up for")
    if law.is_static and law.explained < 1 - LAW_MEMORY_SHARE:
        told.append(
            f"{1 - law.explained:.0%} of what is missing is no law of it: memory, or another cause beside it"
        )
    return told


def _step(law: Law, x: Array, f: Array, span: float) -> list[str]:
    near = LAW_STEP_WITHIN * float(np.abs(x).max())
    if law.variables != ("speed",) or not x[0] < -near < near < x[-1]:
        return []
    rise = float(np.interp(near, x, f) - np.interp(-near, x, f))
    return [f"a step of {rise:.3g} {law.unit} at rest"] if abs(rise) > LAW_STEP_SHARE * span else []


def _symmetry(x: Array, f: Array, error: Array, span: float) -> list[str]:
    reach = min(-float(x[0]), float(x[-1]))
    if reach < 0.3 * float(np.abs(x).max()):
        return []
    at = np.linspace(0, reach, 50)
    right, left = np.interp(at, x, f), np.interp(-at, x, f)
    middle = float(np.interp(0.0, x, f))
    noise = float(np.median(error))
    odd = float(np.sqrt(np.mean((right + left - 2 * middle) ** 2))) / 2
    even = float(np.sqrt(np.mean((right - left) ** 2))) / 2
    allowed = max(LAW_EVEN_SHARE * span, 2 * noise)
    if odd < allowed < even:
        return ["odd: alike both ways"]
    if even < allowed < odd:
        return ["even: the same force both ways"]
    return ["neither odd nor even"] if odd > allowed and even > allowed else []


def _direction(f: Array, error: Array, span: float) -> list[str]:
    slack = np.hypot(error[1:], error[:-1]) + 0.01 * span
    rise = np.diff(f)
    turns = int(np.count_nonzero(np.diff(np.sign(_turning(f, 0.15 * span)))))
    if turns >= LAW_WAVES:
        return [f"waves: it turns {turns} times"]
    if (rise > -slack).all():
        return ["rising throughout"]
    return ["falling throughout"] if (rise < slack).all() else []


def _turning(f: Array, least: float) -> Array:
    """Return the differences between those highest and lowest values that are at least so far apart."""
    kept = [float(f[0])]
    for value in f[1:].tolist():
        if len(kept) > 1 and (value - kept[-1]) * (kept[-1] - kept[-2]) >= 0:
            kept[-1] = value
        elif abs(value - kept[-1]) >= least:
            kept.append(value)
    return np.diff(kept)
