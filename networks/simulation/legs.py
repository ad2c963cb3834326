"""Legs: the parts of a run between the instants at which inputs switch, and how long a step may be in each.

An integrator sees its inputs only where it evaluates them. From rest it takes steps as long as it likes, and
a pulse between two of them was never there. So what is given is looked at before a run: by interval
arithmetic, which misses no switch, and by samples, which tell how fine a course is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...base import Array, Flags
from .time_signals import TimeSignals

EIGHTHS = np.arange(9) / 8
PARTS = 16
MOST_BLOCKS = 400_000
MOST_SWITCHES = 4096
ADJACENT_SHARE = 1e-25
MISSED_SHARE = 0.02  # a flank between two of nine samples is off by 0.04 at least
NEGLIGIBLE_SHARE = 1e-7
NEIGHBOURS, MOVING_RATIO = 64, 4.0  # floats about a switch, and of what moves there a float, that is no jump
UNSEEN_SHARE = 1e-8  # of a value that samples show at rest: what may hide between them
EQUAL_SHARE = 1e-9  # of a step within which steps are equal but for rounding
ROUNDING = 8 * np.finfo(float).eps
HIDDEN_SHARE = 0.25
STEP_SHARE = 0.5
FINER_RATIO, COARSER_RATIO, RESTART_STEPS = 0.25, 8.0, 256  # the last: steps that starting anew may cost
# Values of a quartic through 0, 2, 4, 6 and 8 at 1, 3, 5 and 7.
_QUARTIC = np.array(
    [[35, 140, -70, 28, -5], [-5, 60, 90, -20, 3], [3, -20, 90, 60, -5], [-5, 28, -70, 140, 35]]
) / 128  # fmt: skip


@dataclass(frozen=True)
class Leg:
    """A part of a run in which nothing that is given switches.

    Attributes:
        begin: first instant [s]; the leg before ends at the floating-point number below, or where it began.
        end: last instant [s].
        max_step: longest step [s] that cannot step over what is given; infinite where that is at rest.
        jumps: whether a signal jumps where the leg begins.
    """

    begin: float
    end: float
    max_step: float = np.inf
    jumps: bool = False


def legs_of(signals: TimeSignals, begin: float, stop: float) -> list[Leg]:
    """Return the legs of a run, in order."""
    if not signals.count:
        return [Leg(begin, stop)]
    spans = _spans(signals, begin, stop) or (np.array([begin]), np.array([stop]))
    return _legs_between(signals, *spans)


def together(parts: Sequence[Sequence[Leg]]) -> list[Leg]:
    """Return the legs of a run whose signals have legs each: none steps over any of them."""
    if len(parts) == 1:
        return [*parts[0]]
    begins = np.unique([leg.begin for legs in parts for leg in legs])
    end, step = np.append(begins[1:], np.inf), np.full(len(begins), np.inf)
    jumps = np.zeros(len(begins), dtype=bool)
    for legs in parts:
        own = np.array([leg.begin for leg in legs])
        at = np.searchsorted(own, begins, side="right") - 1
        end = np.minimum(end, np.array([leg.end for leg in legs])[at])
        step = np.minimum(step, np.array([leg.max_step for leg in legs])[at])
        jumps |= np.array([leg.jumps for leg in legs])[at] & (own[at] == begins)
    columns = begins.tolist(), end.tolist(), step.tolist(), jumps.tolist()
    return [Leg(*told) for told in zip(*columns, strict=True)]


def endless_legs(signals: TimeSignals, stop: float) -> list[Leg]:
    """Return the legs of runs from 0 on that may end anywhere; the last leg has no end.

    They are found up to `stop`, or to where they are too many to be kept; from there on steps stay as
    short as the shortest needed so far.
    """
    if not signals.count:
        return [Leg(0.0, np.inf)]
    seen = stop
    while (spans := _spans(signals, 0.0, seen)) is None or len(spans[0]) > MOST_SWITCHES + 1:
        seen /= 10
    legs = _legs_between(signals, *spans)
    shortest = min(leg.max_step for leg in legs)
    if seen < stop:
        shortest = min(shortest, STEP_SHARE * min(leg.end - leg.begin for leg in legs if leg.end > leg.begin))
    return [*legs, Leg(seen, np.inf, shortest)]


def _spans(signals: TimeSignals, begin: float, stop: float) -> tuple[Array, Array] | None:
    """Return where the parts begin and end in which no formula may switch; None if they are too many."""
    low, high = _split(np.array([begin]), np.array([stop]), PARTS)
    smallest = ADJACENT_SHARE * max(abs(begin), abs(stop))
    found = [signals.ends(begin, stop)]
    while len(low):
        if len(low) > MOST_BLOCKS:
            return None
        switching = signals.may_switch(low, high)
        low, high = low[switching], high[switching]
        final = (high <= np.nextafter(low, np.inf)) | (high - low <= smallest)
        found.append((low[final], high[final]))
        low, high = _split(low[~final], high[~final], PARTS)
    before, after = (np.concatenate(side) for side in zip(*found, strict=True))
    order = np.lexsort((after, before))
    starts, ends = np.append(begin, after[order]), np.append(before[order], stop)
    lasting = starts < ends
    lasting[[0, -1]] = True
    return starts[lasting], ends[lasting]


def _legs_between(signals: TimeSignals, starts: Array, ends: Array) -> list[Leg]:
    blocks = _blocks(signals, starts, ends)
    places = np.searchsorted(blocks[0], [*starts, np.inf]).tolist()
    jumped = _jumps(signals, ends[:-1], starts[1:])
    legs: list[Leg] = []
    for first, last, jumps, span in zip(starts, ends, jumped, pairwise(places), strict=True):
        part = _joined(*(column[slice(*span)] for column in blocks)) or [Leg(first, last)]
        part[0] = replace(part[0], begin=float(first), jumps=jumps)
        part[-1] = replace(part[-1], end=float(last))
        legs += part
    return legs


def _jumps(signals: TimeSignals, before: Array, after: Array) -> list[bool]:
    """Tell of the start and of each switch whether a signal jumps there.

    That is by more than rounding explains, and by more than it moves about there: a ramp begins from nothing.
    """
    far = NEIGHBOURS * (after - before)
    early, one, other, late = (signals(side) for side in (before - far, before, after, after + far))
    with np.errstate(invalid="ignore"):
        moved = [np.nan_to_num(np.abs(far - near), posinf=0.0) for near, far in ((one, early), (other, late))]
    moving = np.maximum(*moved) * (MOVING_RATIO / NEIGHBOURS)
    one, other = np.nan_to_num(one), np.nan_to_num(other)
    size = np.maximum(np.abs(one), np.abs(other)).max(axis=0, initial=0.0)
    return [False, *(np.abs(other - one) > NEGLIGIBLE_SHARE * size + moving).any(axis=1).tolist()]


def _blocks(signals: TimeSignals, starts: Array, ends: Array) -> tuple[Array, Array, Array]:
    """Halve intervals until a few samples of each show all that happens; return them and how fine that is."""
    low, high = _split(starts, ends, max(1, PARTS // len(starts)))
    widest = 1.5 * (ends[-1] - starts[0]) / PARTS
    size = np.zeros(signals.count)
    kept = [(low[:0], high[:0], low[:0])]
    spent = 0
    while len(low):
        spent += len(low)
        scale, shown = _looked_at(signals, low, high, size, closely=spent + 2 * len(low) > MOST_BLOCKS)
        shown = shown & (high - low <= widest) | (high <= np.nextafter(low, np.inf))
        if spent + 2 * np.count_nonzero(~shown) > MOST_BLOCKS:
            shown[:] = True
        kept.append((low[shown], high[shown], scale[shown]))
        low, high = _split(low[~shown], high[~shown], 2)
    columns = [np.concatenate(column) for column in zip(*kept, strict=True)]
    order = np.argsort(columns[0], kind="stable")
    first, last, scale = (column[order] for column in columns)
    return first, last, _after_rest(first, last, scale)


def _after_rest(low: Array, high: Array, scale: Array) -> Array:
    """Return how fine courses are that are polynomials (NaN): a share of all that moves there without rest.

    However small a pulse is beside others, its parts look like polynomials, and a step from rest passes over
    it. Where a course moves from the start or from a switch on, an integrator sees it.
    """
    moves = ~np.isinf(scale)
    cut = np.append(True, low[1:] > high[:-1])
    begins = np.flatnonzero(moves & (cut | np.append(True, ~moves[:-1])))
    if not len(begins):
        return scale
    group = np.searchsorted(begins, np.arange(len(low)), side="right") - 1
    last = np.maximum.reduceat(np.where(moves, high, -np.inf), begins)
    share = np.where(cut[begins], np.inf, (last - low[begins]) / PARTS)
    return np.where(np.isnan(scale), share[group], scale)


def _looked_at(
    signals: TimeSignals, low: Array, high: Array, size: Array, closely: bool
) -> tuple[Array, Flags]:
    """Return how fine the course in each interval is, and which show all that happens.

    It is infinite at rest, and NaN where the course is a polynomial. The `size` of each signal, its range so
    far, is updated. Intervals that will be halved, as their samples tell, are not looked into unless
    `closely`.
    """
    times = low[:, None] + (high - low)[:, None] * EIGHTHS
    values = signals(times.ravel()).reshape(len(low), 9, -1)
    broken = ~np.isfinite(values).all(axis=1)
    values = np.nan_to_num(values, posinf=0.0, neginf=0.0)
    ranges = np.ptp(values, axis=1)
    np.maximum(size, ranges.max(axis=0, initial=0.0), out=size)
    missed = np.abs(np.einsum("oe,ber->bor", _QUARTIC, values[:, ::2]) - values[:, 1::2]).max(axis=1)
    largest = np.abs(values).max(axis=(0, 1), initial=0.0)
    least = NEGLIGIBLE_SHARE * size + ROUNDING * largest
    few = ~signals.formal & signals.within_data(low, high)[:, None]
    known = broken | few
    even = missed <= MISSED_SHARE * ranges + least
    final = closely | (few | even).all(axis=1) | (high <= np.nextafter(low, np.inf))
    asked = np.flatnonzero(final & ~known.all(axis=1))
    if len(asked):
        with np.errstate(invalid="ignore"):
            hidden = _hidden(signals, times[asked], values[asked])
            known[asked] |= hidden <= np.where(signals.formal, 0.0, HIDDEN_SHARE * ranges[asked]) + least
    unknown = asked[~known[asked].all(axis=1)]
    scale = high - low
    if len(unknown):
        allowed = HIDDEN_SHARE * ranges[unknown] + least + UNSEEN_SHARE * largest
        between = _between(signals, low[unknown], high[unknown], allowed)
        bound = between <= allowed
        known[unknown] |= bound
        share = np.where(bound, 1.0, allowed / np.where(bound, 1.0, between))
        scale[unknown] *= np.maximum(share.min(axis=1), 1 / 16)
    rests, polynomial = (((what <= least) & known).all(axis=1) for what in (ranges, missed))
    shown = (few | even & known).all(axis=1)
    return np.select([rests, polynomial], [np.inf, np.nan], scale), shown


def _between(signals: TimeSignals, low: Array, high: Array, allowed: Array) -> Array:
    """Return how far signals can go from the nearest of nine samples; if too far, from the chord of two."""
    width = (high - low)[:, None]
    between = signals.steepest(low, high) * width / 16
    far = (between > allowed).any(axis=1)
    if far.any():
        bent = signals.most_bent(low[far], high[far]) * width[far] ** 2 / 512
        between[far] = np.minimum(between[far], bent)
    return between


def _hidden(signals: TimeSignals, times: Array, values: Array) -> Array:
    """Return how far signals can go beyond neighbouring samples, (intervals, signals).

    Formulas alone are asked for how far they go at all, which is as telling of what does not move.
    """
    if signals.formal.all():
        below, above = signals.bounds(times[:, 0], times[:, -1])
        return above - below
    bounds = signals.bounds(times[:, :-1].ravel(), times[:, 1:].ravel())
    below, above = (bound.reshape(len(times), 8, -1) for bound in bounds)
    least, most = np.minimum(values[:, :-1], values[:, 1:]), np.maximum(values[:, :-1], values[:, 1:])
    beyond: Array = np.maximum(above - most, least - below).max(axis=1)
    return beyond


def _joined(low: Array, high: Array, scale: Array) -> list[Leg]:
    """Join neighbouring intervals of like scale, then parts that save fewer steps than a new start costs."""
    columns = _even(low, high, STEP_SHARE * scale)
    legs = [Leg(*part) for part in zip(*(column.tolist() for column in columns), strict=True)]
    for belong in _alike, _hardly_worthwhile:
        joined: list[Leg] = []
        for leg in legs:
            while joined and belong(joined[-1], leg):
                before = joined.pop()
                leg = Leg(before.begin, leg.end, min(before.max_step, leg.max_step))
            joined.append(leg)
        legs = joined
    return legs


def _even(low: Array, high: Array, step: Array) -> tuple[Array, Array, Array]:
    """Join neighbouring intervals of equal steps, but for rounding."""
    if not len(step):
        return low, high, step
    with np.errstate(invalid="ignore"):
        equal = (step[1:] == step[:-1]) | (np.abs(step[1:] - step[:-1]) < EQUAL_SHARE * step[1:])
    begins = np.flatnonzero(np.append(True, ~equal))
    return low[begins], high[np.append(begins[1:], len(high)) - 1], np.minimum.reduceat(step, begins)


def _alike(before: Leg, after: Leg) -> bool:
    finer, coarser = FINER_RATIO * before.max_step, COARSER_RATIO * before.max_step
    return before.max_step == after.max_step or finer < after.max_step < coarser


def _hardly_worthwhile(before: Leg, after: Leg) -> bool:
    finer, coarser = sorted((before, after), key=lambda leg: leg.max_step)
    return coarser.end - coarser.begin < RESTART_STEPS * finer.max_step


def _split(low: Array, high: Array, parts: int) -> tuple[Array, Array]:
    """Divide intervals into equal parts, as far as floating-point numbers allow; they stay in order."""
    edges = low[:, None] + (high - low)[:, None] * (np.arange(parts + 1) / parts)
    edges[:, -1] = high
    first, last = edges[:, :-1].ravel(), edges[:, 1:].ravel()
    return first[last > first], last[last > first]
