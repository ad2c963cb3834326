"""Adaptive master: a Jacobi master whose communication step follows from the error that is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...base import Array
from ..errors import FMUError
from .jacobi_master import JacobiMaster, Link
from .participants import CommunicationPoints, Member, Participant

FIRST_SHARE, LEAST_SHARE = 1e-2, 1e-10  # of the longest step, and of the run
GROWING = 0.5
SAFETY, SHRINK, GROWTH = 0.85, 0.1, 3.0
UNFORESEEN, UNFORESEEN_SHARE = 3, 0.02  # rejections after which an event is supposed, which may cost more
INSTANT_SHARE = 1e-3  # of the tolerance and the run: a jump within adds no more than the tolerance
INTEGRATOR_SHARE, FINEST_INTEGRATOR = 1e-3, 1e-10  # of the tolerance, and at least: for the FMUs themselves
NOISE_SHARE, LEAST_SIZE = 1e-9, 1e-30  # of a value, what moves less does not count; of anything
SCOUTS, SCOUT_TOLERANCE, SCOUTED = (50, 100, 200, 400, 800, 1600), 1e-4, 0.1
BEGIN, MIDDLE = "begin", "middle"
LATE_SHARE = 0.6  # of what the whole step misses; where nothing jumps, a half misses a third or so


@dataclass(frozen=True)
class _Arrival:
    """Where a step led: when, what all agree on there, what each shows, whether an event ended it.

    `missed` is by how much the course of the inputs was another than what all agree on there.
    """

    time: float
    agreed: Array
    rows: dict[str, Array]
    event: bool
    missed: Array

    @property
    def scale(self) -> Array:
        """How large what is exchanged is."""
        found: Array = np.abs(self.agreed)
        return found


class AdaptiveMaster(JacobiMaster):
    """Makes each step once whole and once in halves, and goes on from the halves if both agree.

    With inputs held the error of a run falls with the step, with lines with its square (p = 1, 2). What a
    step adds to it is the difference of both, divided by 2^p - 1. It may be the tolerance times the share
    that the step is of the run, of how far each state goes (each output, of an FMU that tells no states), and
    half of that, as errors also grow. How far states go, runs with long steps tell beforehand.

    After an event, and where the run begins, there is no past to extrapolate: the step is made with inputs
    held first, and then along the line to where that led, so that the order is kept. An event that an FMU
    tells ends a step for all. One that it keeps to itself is noticed as the second half misses as much as the
    whole step, and is then made again along the line to where it led; or as smaller steps do not help as they
    should. It is passed in a small step, after which extrapolation begins anew.

    Attributes:
        costs: by number of the link, the sum of what the steps were estimated to add.
    """

    def __init__(
        self, members: Mapping[str, Member], links: Sequence[Link], points: CommunicationPoints,
        tolerance: float,
    ) -> None:  # fmt: skip
        super().__init__(members, links, points, max(INTEGRATOR_SHARE * tolerance, FINEST_INTEGRATOR))
        self._scouts = partial(JacobiMaster, members, links)
        self._tolerance, self._power = tolerance, points.order + 1
        self._span = points.stop - points.begin
        self._size = FIRST_SHARE * points.step
        self._least = INSTANT_SHARE * tolerance * self._span
        self.stats |= {"attempts": 0, "rejected": 0, "scouting steps": 0}
        self.stats |= {"shortest step": np.inf, "longest step": 0.0}
        self.costs = np.zeros(len(links))
        self._late = np.zeros(0)

    def _begin(self) -> None:
        super()._begin()
        for name, one in self.everyone.items():
            if not (one.reversible and one.stepper.flexible):
                lacks = "save its state" if one.stepper.flexible else "take steps of any size"
                raise FMUError(
                    f"FMU '{one.fmu.name}' ({name}) cannot {lacks}, which keeping a tolerance needs; "
                    "give a communication_step instead"
                )
        self._watched = np.concatenate([_watched(one) for one in self.everyone.values()])
        self._first = self._shown(self._rows())
        self._moved = self._scouted()

    def _scouted(self) -> Array:
        """Return how far signals go in runs with long steps, which are shortened until two agree on it."""
        found: Array | None = None
        for count in SCOUTS:
            points = replace(self.points, step=self._span / count)
            scout = self._scouts(points, SCOUT_TOLERANCE)
            try:
                runs = scout.march()
            except FMUError:
                continue
            finally:
                self.stats["scouting steps"] += scout.stats["communication steps"]
            moved = {n: np.array([np.ptp(run[v]) for v in run.units]) for n, run in runs.items()}
            ranges = self._shown(moved)
            if found is not None and np.allclose(ranges, found, rtol=SCOUTED, atol=0.0):
                return ranges
            found = ranges
        return np.zeros_like(self._first) if found is None else found

    def _rows(self) -> dict[str, Array]:
        return {name: one.row for name, one in self.everyone.items()}

    def _shown(self, rows: dict[str, Array]) -> Array:
        """Return what is watched among all that is shown."""
        found: Array = np.concatenate(list(rows.values()))[self._watched]
        return found

    def _step(self, target: float) -> None:
        begin, past, rejected, unforeseen, ratio = self.time, list(self._past), 0, False, 1.0
        self._save(BEGIN)
        while True:
            whole, mid, halves = self._tried(begin, past, self._goal(begin, target))
            length = halves.time - begin
            at_once = whole.event and length <= LEAST_SHARE * self._span
            if at_once and self._power > 1 and not self._ended():
                self._power, past = 1, past[-1:]  # the line brings it about, what is there now does not
                self._return(begin, past)
                continue
            if mid is None:  # an event, in less than half of a step that should be good enough
                break
            unforeseen = rejected >= UNFORESEEN
            share = max(length / self._span, UNFORESEEN_SHARE if unforeseen else 0.0)
            ratio = self._error(whole, halves) / (GROWING * self._tolerance * share)
            if ratio <= 1:
                break
            if length <= self._least * (1 + LEAST_SHARE):  # in which something jumps
                unforeseen, ratio = True, 1.0
                break
            rejected += 1
            self._return(begin, past)
            shorter = length * float(np.clip(SAFETY * ratio ** (-1 / self._power), SHRINK, 0.5))
            self._size = max(shorter, self._least)
        self._accept(mid, halves, whole)
        self._power = self.points.order + 1
        if unforeseen:
            del self._past[:-1]
        growth = SAFETY * max(ratio, 1e-9) ** (-1 / self._power)
        most = GROWTH if not rejected or unforeseen else 1.0
        size = max(length * float(np.clip(growth, SHRINK, most)), GROWTH * self._least)
        self._size = min(max(size, self._size) if length < self._size else size, self.points.step)
        self.stats["rejected"] += rejected
        self.stats["shortest step"] = min(self.stats["shortest step"], length)
        self.stats["longest step"] = max(self.stats["longest step"], length)

    def _goal(self, begin: float, target: float) -> float:
        """Return where the next step is to lead: no sliver of a step is left before the target."""
        rest = target - begin
        if self._size >= rest * (1 - LEAST_SHARE):
            return target
        return begin + (self._size if self._size < rest / 2 else rest / 2)

    def _tried(
        self, begin: float, past: list[tuple[float, Array]], goal: float
    ) -> tuple[_Arrival, _Arrival | None, _Arrival]:
        """Go to the goal, at once and in halves; the middle is None if an event came before it."""
        line = past
        if len(past) < self._power:
            ahead = self._arrived(goal)
            if self._instant(begin, ahead):
                return ahead, None, ahead
            self._return(begin, line := [(ahead.time, ahead.agreed), *past])
            goal = ahead.time
        whole = self._arrived(goal)
        if self._instant(begin, whole):
            return whole, None, whole
        self._return(begin, line)
        mid = self._arrived(begin + (whole.time - begin) / 2)
        if mid.event:
            return whole, None, mid
        known = [*past, (mid.time, mid.agreed)][-self._power :]
        self._past = known
        self._save(MIDDLE)
        halves = self._arrived(whole.time)
        self._late = np.zeros(0)
        if self._power > 1 and (halves.missed > LATE_SHARE * whole.missed + NOISE_SHARE * halves.scale).any():
            self._return(mid.time, [(halves.time, halves.agreed), (mid.time, mid.agreed)], MIDDLE)
            first, halves = halves, self._arrived(halves.time)
            self._past = known
            self._late = np.abs(self._shown(halves.rows) - self._shown(first.rows))
        return whole, mid, halves

    def _instant(self, begin: float, end: _Arrival) -> bool:
        return end.time - begin <= LEAST_SHARE * self._span

    def _arrived(self, goal: float) -> _Arrival:
        """Advance all to the goal or an event before, and let them agree there."""
        self.stats["attempts"] += 1
        self._advance(goal, {name: self._course(name) for name in self.everyone})
        foreseen = self._ahead(self.time)
        agreed = self._agreed(foreseen)
        event = self.time < goal or any(one.stepper.event for one in self.everyone.values())
        return _Arrival(self.time, agreed, self._rows(), event or self._ended(), np.abs(agreed - foreseen))

    def _save(self, place: str) -> None:
        for one in self.everyone.values():
            one.stepper.save(place)

    def _return(self, begin: float, past: list[tuple[float, Array]], place: str = BEGIN) -> None:
        for one in self.everyone.values():
            one.stepper.restore(place)
        self.time, self._past = begin, past

    def _error(self, whole: _Arrival, halves: _Arrival) -> float:
        """Return the estimated error of a step, of how far signals have gone."""
        now = self._shown(halves.rows)
        apart = np.abs(now - self._shown(whole.rows)) / (2**self._power - 1)
        apart = apart + self._late if len(self._late) else apart
        size = np.maximum(self._moved, np.abs(now - self._first))
        return float((apart / np.maximum(size, NOISE_SHARE * np.abs(now) + LEAST_SIZE)).max(initial=0.0))

    def _accept(self, mid: _Arrival | None, end: _Arrival, whole: _Arrival) -> None:
        for arrival in (mid, end):
            if arrival is not None:
                moved = np.abs(self._shown(arrival.rows) - self._first)
                self._moved = np.maximum(self._moved, moved)
        if mid is not None:
            self.costs += np.abs(end.agreed - whole.agreed) / (2**self._power - 1)
            for name, one in self.everyone.items():
                one.run.record(mid.time, mid.rows[name].tolist())
        self._close(end.agreed)


def _watched(one: Participant) -> list[bool]:
    """Tell which of what an FMU shows counts for the error: its states, or all signals if it tells none."""
    states = [name in one.fmu.states for name in one.run.units]
    return states if any(states) else [one.fmu.variables[name].is_signal for name in one.run.units]
