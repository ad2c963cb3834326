"""What is wrong with measured columns, told by file, line and column, with a remedy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ...base.tables import Table

LEAST_SAMPLES = 32
JITTER = 0.25  # of a step
GAP = 1.75  # in steps
CLIPPED_SAMPLES = 5
CLIPPED_STEEPNESS = 1.0  # of the step before a plateau, over the usual one
COARSE_STEEPNESS = 1.5  # of that step over the smallest there is, up to which a coarse signal may turn
TURNING_STEPS = 4.0  # of a sensor, from which a signal comes in half the time it stays at the last
LARGEST_VALUE = 1e12
MOVED_SHARE = 0.01  # of its range, by which a channel moves that does not rest
SWITCHED_SHARE = 0.5  # of samples at the two extremes, above which a signal switches between them
REPEATED_SHARE = 0.01  # of samples that repeat the one before, above which a sensor is coarse or at rest


def time_problems(table: Table, name: str, time: Array) -> Iterator[str]:
    """Yield what keeps a column from being the time of a record."""
    if wrong := table.time_problem(name, time):
        yield wrong
        return
    step = np.diff(time)
    usual = float(np.median(step)) if len(step) else 0.0
    holes = np.flatnonzero(step > GAP * usual)
    if len(holes):
        row = int(np.argmax(step)) + 1
        told = (
            f"a gap of {time[row] - time[row - 1]:g} s before {time[row]:g} s, where samples are {usual:g} s "
            f"apart ({len(holes)} such); cut the record there with window = [from, to], or fill it"
        )
        yield f"{table.at(name, row)}: {told}"
    elif len(step) and float(np.abs(step - usual).max()) > JITTER * usual:
        row = int(np.argmax(np.abs(step - usual))) + 1
        told = f"samples are not evenly spaced ({step.min():g} to {step.max():g} s); resample the record"
        yield f"{table.at(name, row)}: {told}"


def number_problems(table: Table, name: str, values: Array) -> Iterator[str]:
    """Yield where a column holds no number that a machine could have."""
    if wrong := table.number_problem(name, values):
        yield wrong
    elif np.abs(values).max() > LARGEST_VALUE:
        row = int(np.abs(values).argmax())
        told = f"{values[row]:g} is beyond any machine; correct it, or the unit of the column"
        yield f"{table.at(name, row)}: {told}"


def value_problems(table: Table, name: str, values: Array, others: Sequence[Array]) -> Iterator[str]:
    """Yield what keeps a column from being a channel, beside the other columns of its record."""
    if unusable := list(number_problems(table, name, values)):
        yield from unusable
    elif (row := clipped(values, others)) is not None:
        told = (
            f"stays at {values[row]:g}, an extreme, as if the sensor were saturated; measure with a larger "
            "range, or cut with window = [from, to]"
        )
        yield f"{table.at(name, row)}: {told}"


def stuck(values: Array, others: Sequence[Array]) -> tuple[int, int] | None:
    """Return the first and the last sample of the longest stretch of one value, None if that is not strange.

    It is strange if it is long, another channel moves in it, and values hardly ever repeat outside of it, as
    those of a coarse sensor do.
    """
    stretches = _stretches(np.diff(values) == 0)
    first, last = max(stretches, key=lambda ends: ends[1] - ends[0], default=(0, 0))
    length = last - first
    outside = sum(end - begin for begin, end in stretches) - length
    strange = length >= LEAST_SAMPLES and outside <= REPEATED_SHARE * (len(values) - length)
    return (first, last) if strange and _move(others, first, last) else None


def clipped(values: Array, others: Sequence[Array] = ()) -> int | None:
    """Return where a signal runs against a limit and stays there, at least twice; None if it does not.

    A plateau that is reached gently is none: the step before it must be as steep as the signal mostly is, and
    over half of its length before it, the signal must come from farther than it does where it turns. Nor is
    one in which all other channels rest, or a signal clipped that is mostly at its two extremes, as it
    switches between two levels, or that stays as long at others while something moves, as it is coarse.
    """
    low, high = float(values.min()), float(values.max())
    if np.mean((values == low) | (values == high)) > SWITCHED_SHARE:
        return None
    change = np.abs(np.diff(values))
    moving = change[change > 0]
    if not len(moving):
        return None
    steep = max(CLIPPED_STEEPNESS * float(np.median(moving)), COARSE_STEEPNESS * float(moving.min()))
    far = TURNING_STEPS * float(moving.min())
    long = [ends for ends in _stretches(change == 0) if ends[1] - ends[0] >= CLIPPED_SAMPLES - 1]
    plateaus = [(begin, end) for begin, end in long if _move(others, begin, end)]
    if any(low < values[begin] < high for begin, _ in plateaus):
        return None
    for limit in (high, low):
        ends = [(begin, end) for begin, end in plateaus if values[begin] == limit and begin > 0]
        runs = [n for n, _ in ends if change[n - 1] + change[max(n - 2, 0)] > steep]
        reached = [n for n, end in ends if abs(limit - values[max(0, n - max(2, (end - n) // 2))]) > far]
        if len(runs) > 1 and len(reached) > 1:
            return runs[0]
    return None


def _move(others: Sequence[Array], first: int, last: int) -> bool:
    """Return whether one of other channels moves between two samples, or there is none."""
    return not others or any(np.ptp(v[first : last + 1]) > MOVED_SHARE * np.ptp(v) for v in others)


def _stretches(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return where stretches of true begin, and where they have ended."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]))).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))
