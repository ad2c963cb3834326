"""Coverage: whether sampled inputs are known throughout a run, and whether they are what they seem."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from ...base import Array, ModelError
from ...components.language import Sampled
from ..dae import Input
from .splines import CACHED_SIGNALS, piecewise

USED_SHARE = 0.01  # of the data's span, below which a run makes one ask for the unit of their time
OVERSHOOT_SHARE = 0.5  # share of the data's range by which a spline that goes beyond them is no signal
JUMP_SHARE = 0.2  # share of the data's range by which they jump within a sample ...
JUMP_RATIO = 10.0  # ... so many times more than in the samples beside it
NEIGHBOURS = 4


def check_covered(name: str, signals: Mapping[str, Any], begin: float, stop: float) -> None:
    """Raise for sampled inputs that are not known from `begin` to `stop` [s].

    Raises:
        ModelError: naming each input, its data's span, and what to do.
    """
    wanted = f"t = {begin:.9g} s" if begin == stop else f"{begin:.9g} to {stop:.9g} s"
    problems = [
        f"input '{path}': its data are from {s.time[0]:.9g} to {s.time[-1]:.9g} s, wanted are {wanted}; "
        "keep to the data, or give Sampled(time, values, extrapolation='hold')"
        for path, s in signals.items()
        if isinstance(s, Sampled) and not s.covers(begin, stop)
    ]
    if problems:
        raise ModelError(f"'{name}' cannot run on these data:", problems)


def data_notes(
    inputs: Sequence[Input], signals: Mapping[str, Any], begin: float, stop: float
) -> Iterator[str]:
    """Yield what may be wrong with sampled inputs that a run from `begin` to `stop` [s] has used."""
    for path, signal in signals.items():
        if not isinstance(signal, Sampled):
            continue
        span = float(np.ptp(signal.time))
        if stop - begin < USED_SHARE * span:
            yield (
                f"input '{path}': the run uses {(stop - begin) / span:.2g} of its data, which are from "
                f"{signal.time[0]:g} to {signal.time[-1]:g} s; is their time in seconds?"
            )
        if told := between_samples(signal):
            yield f"input '{path}': {told}; {jump_remedy(inputs, path)}"


def jump_remedy(inputs: Sequence[Input], path: str) -> str:
    """Return what helps an input of which a cubic spline makes something else."""
    if any(declared.path == path and declared.order for declared in inputs):
        return "its derivative is needed, so sample it faster, or give it as smooth as it can have been"
    return "interpolation='linear' stays within the samples, 'hold' keeps each until the next"


@lru_cache(maxsize=CACHED_SIGNALS)
def between_samples(signal: Sampled) -> str:
    """Say where a cubic spline makes of a signal what was not measured; empty if nowhere."""
    size = float(np.ptp(signal.values))
    if signal.interpolation != "cubic" or not size:
        return ""
    at, beyond = _beyond(signal)
    if beyond > OVERSHOOT_SHARE * size:
        return (
            f"the spline through its samples goes {beyond / size:.3g} times their range beyond them at "
            f"t = {at:.6g} s, where they are far apart or next to each other"
        )
    jump = _jump(np.abs(np.diff(signal.values)), size)
    if jump is None:
        return ""
    return (
        f"it jumps within one sample at t = {signal.time[jump]:.6g} s, which a cubic spline overshoots by "
        f"{beyond / size:.0%} of its range"
    )


def _beyond(signal: Sampled) -> tuple[float, float]:
    """Return where and by how much the signal leaves the range of its samples most."""
    course = piecewise(signal)
    turns = course.derivative().roots(extrapolate=False)
    turns = np.append(turns[np.isfinite(turns)], signal.time)
    values = course(turns)
    outside = np.maximum(values - signal.values.max(), signal.values.min() - values)
    worst = int(np.argmax(outside))
    return float(turns[worst]), float(outside[worst])


def _jump(changes: Array, size: float) -> int | None:
    """Return the sample before the largest lonely change, None if there is none."""
    if len(changes) < 2 * NEIGHBOURS + 1:
        return None
    windows = np.lib.stride_tricks.sliding_window_view(changes, 2 * NEIGHBOURS + 1)
    middle = windows[:, NEIGHBOURS]
    others = np.delete(windows, NEIGHBOURS, axis=1).max(axis=1)
    lonely = np.flatnonzero((middle > JUMP_SHARE * size) & (middle > JUMP_RATIO * others))
    return int(lonely[np.argmax(middle[lonely])]) + NEIGHBOURS if len(lonely) else None
