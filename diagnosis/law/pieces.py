"""Records cut in pieces, each followed by a run: for motions that no free run follows for long."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from math import ceil

import numpy as np

from ...base import Array
from ...components import SimulationError
from ...identification import Experiment
from ..criteria import (
    LOST_GAP_SHARE,
    LOST_LEAST,
    LOST_LENGTH_SHARE,
    LOST_STANDARD_DEVIATIONS,
    PIECE_GROWS,
    PIECE_KEPT,
    PIECE_MOST_SAMPLES,
    PIECE_SAMPLES,
    PIECE_STARTS,
    PIECES,
    PIECES_AT_FIRST,
    PIECES_SPREAD,
)
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .along import Bench, Beside, samples_before
from .law import Law
from .missing_force import MissingForce
from .regression import own_of


@dataclass(frozen=True, eq=False)
class Follower:
    """A model that is to follow a machine, at a site `within` a distance.

    `states` are those of the model `without` an effect. What that has `missed` is told of one that follows
    through impacts, for a short time and closely: with play, or another effect in series.
    """

    bench: Bench
    without: Bench
    given: Mapping[str, float]
    states: Sequence[str]
    site: int
    within: float
    missed: Array | None

    @classmethod
    def of(
        cls, study: Study, missing: MissingForce, law: Law, effect: Hypothesis, given: Mapping[str, float]
    ) -> Follower:
        """Return that with an effect beside a model, as near as what is to follow a law."""
        beside = missing.search.bench
        bench = Bench(study, beside.names, [*beside.effects, effect])
        within = LOST_LENGTH_SHARE * law.length
        missed = None
        if effect.effect.place == "series":
            left = np.concatenate([run.left for run in missing.search.nominal])
            missed = np.sqrt(np.mean(left**2, axis=0))
        return cls(bench, beside, given, beside.predictor.dae.state_names, law.number, within, missed)

    def followed(self, run: Beside, along: Beside, begin: int) -> int:
        """Return for how many samples a run of a piece follows a record, and one that goes along it."""
        kept = run.followed(along.experiment, self.missed)
        if not goes_along(along):
            return kept
        there = along.motion(self.site).s[along.found.at][begin : begin + len(run.found.at)]
        away = np.abs(run.motion(self.site).s[run.found.at] - there)
        return min(kept, samples_before(away > self.within))

    def follows(self, run: Beside, along: Beside, begin: int) -> bool:
        """Tell whether a run of a piece follows all of it, and misses little where that is to be close."""
        if self.followed(run, along, begin) < len(run.found.at):
            return False
        missed = _rms(run)
        return self.missed is None or missed < LOST_LEAST or missed < LOST_GAP_SHARE * self._bare(run)

    def _bare(self, run: Beside) -> float:
        """Return what the model without what is to follow, which has states of its own, misses of a piece."""
        assert run.begin.start is not None  # a piece begins in motion
        known = dict(zip(run.bench.predictor.dae.state_names, run.begin.start.tolist(), strict=True))
        begin = replace(self.without.begin(run.experiment, self.given, known), own=run.begin.own)
        try:
            return _rms(self.without.run(run.experiment, self.given, begin))
        except SimulationError:
            return 0.0

    def spread(self, along: Beside, count: int, most: int) -> Iterator[tuple[int, Experiment]]:
        """Yield where parts begin that are spread over a record, and those, of so many samples at most.

        They begin as the machine did, and share no instant but where they meet; a short record has few.
        """
        time = along.experiment.compared.time
        last = len(time) - 1
        count = max(1, min(count, last // (2 * PIECE_SAMPLES)))
        most = min(most, last // count)
        for begin in np.linspace(0, last - most, count).astype(int).tolist():
            yield begin, along.experiment.part(begin, begin + most, _motion(along, float(time[begin]), self))


def cut(study: Study, follower: Follower, runs: Sequence[Beside]) -> Study:
    """Return a study with a record for each piece of what it has, of which `runs` go along what was measured.

    Raises:
        SimulationError: if the model follows the machine nowhere.
    """
    there = study.campaign.training, study.campaign.testing
    along = runs[: len(there[0])], runs[len(there[0]) :]
    cut_up = [[piece for run in some for piece in _few(follower, run)] for some in along]
    if any(whole and not parts for whole, parts in zip(there, cut_up, strict=True)):
        raise SimulationError("no run follows the machine for long")
    campaign = study.campaign.with_records(*cut_up)
    longest = max(float(np.ptp(piece.record.time)) for piece in campaign.experiments)
    return replace(study, campaign=campaign, pieces=longest)


def _few(follower: Follower, along: Beside) -> list[Experiment]:
    """Return the pieces of a record; parts that are spread over it if those are many, or followed closely."""
    if follower.missed is None:
        found, (begin, end) = list[Experiment](), along.experiment.compared.time[[0, -1]]
        for piece in _pieces(follower, along):
            found.append(piece)
            passed = (piece.compared.time[-1] - begin) / (end - begin)
            if len(found) > max(PIECES * passed, PIECES_AT_FIRST):
                break
        else:
            return found
    return [*_spread(follower, along)] if goes_along(along) else []


def _spread(follower: Follower, along: Beside) -> Iterator[Experiment]:
    """Yield parts of a record that a model follows, of those that are spread over it; none within another.

    Those that are followed closely are short, as impacts make much of small errors.
    """
    end, last = 0, len(along.experiment.compared.time) - 1
    closely = follower.missed is not None
    most, grows = PIECE_MOST_SAMPLES if closely else last, PIECE_GROWS[closely]
    for begin, part in follower.spread(along, PIECES_SPREAD, PIECE_SAMPLES):
        found = None if begin < end else _grown(follower, along, begin, part, min(most, last - begin), grows)
        if found is not None:
            yield found
            end = begin + len(found.compared.time) - 1


def _grown(
    follower: Follower, along: Beside, begin: int, part: Experiment, last: int, grows: float
) -> Experiment | None:
    """Return a part of a record, grown as long as a run follows it, begun ever nearer; None if none does."""
    kept, time = None, float(part.compared.time[0])
    while True:
        end = len(part.compared.time) - 1
        try:
            run = follower.bench.nearest(part, follower.given)
        except SimulationError:
            return kept
        if not follower.follows(run, along, begin):
            return kept
        motion = _motion(run, time, follower)
        kept = along.experiment.part(begin, begin + end, motion)
        if end == last:
            return kept
        part = along.experiment.part(begin, begin + min(ceil(grows * end), last), motion)


def _pieces(follower: Follower, along: Beside) -> Iterator[Experiment]:
    """Yield the pieces of a record: where a model is lost, another begins as it moved shortly before.

    It may also begin as the machine does in a run `along` what was measured.
    """
    experiment = along.experiment
    time = experiment.compared.time
    begin, end, last = 0, 2 * PIECE_SAMPLES, len(time) - 1
    before: Beside | None = None
    while begin < last:
        there = along if begin == 0 or before is None or goes_along(along) else None
        motions = [_motion(run, time[begin], follower) for run in (there, before) if run is not None]
        found, kept = _begun(follower, along, begin, min(end, last), motions)
        if begin + kept > end < last:
            end = min(begin + 2 * kept, last)
            continue
        stop = last if begin + kept >= last else begin + max(int(PIECE_KEPT * kept), PIECE_SAMPLES)
        stop = last if last - stop < PIECE_SAMPLES else stop
        motion = motions[0] if found is None else _motion(found, time[begin], follower)
        yield experiment.part(begin, stop, motion)
        begin, end, before = stop, stop + max(kept, 2 * PIECE_SAMPLES), found


def _rms(run: Beside) -> float:
    """Return the root mean square of what a run misses, in units of noise."""
    return float(np.sqrt(run.squares / run.left.size))


def goes_along(run: Beside) -> bool:
    """Tell whether a run is where the machine was."""
    return _rms(run) < LOST_STANDARD_DEVIATIONS


def _motion(run: Beside, time: float, follower: Follower) -> dict[str, float]:
    """Return the states of the model without a law in a run, by path."""
    found = run.found.run
    return {name: float(np.interp(time, found.time, found[name])) for name in follower.states}


def _begun(
    follower: Follower, along: Beside, begin: int, end: int, motions: Sequence[Mapping[str, float]]
) -> tuple[Beside | None, int]:
    """Return the run of a piece that follows farthest, from a motion or what that tells, and how far."""
    best: tuple[Beside | None, int] = None, 0
    for motion in motions:
        with suppress(SimulationError):
            found = _rebegun(follower, along, begin, along.experiment.part(begin, end, motion))
            best = found if best[0] is None or found[1] > best[1] else best
    return best


def _rebegun(follower: Follower, along: Beside, begin: int, piece: Experiment) -> tuple[Beside, int]:
    """Return the run of a piece from where it follows farthest, sought about where it begins, and how far."""
    bench, given = follower.bench, follower.given
    run = bench.run(piece, given, bench.begin(piece, given, {}))
    kept = follower.followed(run, along, begin)
    for _ in range(PIECE_STARTS):
        columns, _, priors = replace(run, until=max(kept, PIECE_SAMPLES)).columns(fixed=True)
        step = own_of(columns[:, :, 0], columns[:, :, 1:], priors)
        other = bench.run(piece, given, run.began(step, 0))
        farther = follower.followed(other, along, begin)
        if farther <= kept:
            break
        run, kept = other, farther
    return run, kept
