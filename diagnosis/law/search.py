"""The force at each site that explains records: sought by smoothing along runs that have it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import inf

import numpy as np

from ...base import Array
from ...components import ModelError, SimulationError
from ..criteria import (
    FORCE_HALVINGS,
    FORCE_MOST_RUNS,
    FORCE_PARAMETER_STEP,
    FORCE_RUNS,
    FORCE_SETTLED,
    FORCE_SHARES,
    FORCE_SIZE_RATIO,
    FORCE_SUFFICES,
    FORCE_WON_SHARE,
    PART_CHI_SQUARED,
)
from ..models.force import Force
from ..models.study import Study
from ..search.model_comparison import Refit
from .along import Bench, Beside
from .course import Roughness
from .likeliest import likeliest
from .smoother import Filtered, filtered, smoothed


@dataclass(frozen=True, eq=False)
class Settled:
    """Runs with a force at a site, and the force that was found along them.

    Attributes:
        number: of the site.
        given: the parameters.
        rough: how fast the force changes.
        runs: one of each record.
        forces, errors: with standard errors, at the points of each run.
        levels_known: by record, whether its runs tell a constant in the force; all do if empty.
    """

    number: int
    given: Mapping[str, float]
    rough: Roughness
    runs: tuple[Beside, ...]
    forces: tuple[Force, ...]
    errors: tuple[Force, ...]
    levels_known: tuple[bool, ...] = ()

    @property
    def misfit(self) -> float:
        """The root mean square of what the runs miss, in units of noise."""
        return _misfit(self.runs)

    @property
    def rms(self) -> float:
        """The root mean square of the force."""
        return float(np.sqrt(np.mean(np.concatenate([force.values for force in self.forces]) ** 2)))

    def beside(self, moved: Array) -> list[Array]:
        """Return the force along the runs if the parameters are so far from the centers of their priors."""
        courses = [run.course([self.number]).held(moved) for run in self.runs]
        force, _ = smoothed(filtered(courses, self.rough))
        found = [force[: len(course.t), place, 0] for place, course in enumerate(courses)]
        told = self.levels_known or (True,) * len(found)
        parts = zip(found, self.forces, told, strict=True)
        return [one if known else one + np.mean(f.values - one) for one, f, known in parts]


def _between(run: Beside, force: Force, share: float) -> Force:
    """Return a force with a share of the way to it from that of a run."""
    before = np.zeros_like(force.t) if run.force is None else run.force.at(force.t)
    return Force(force.t, share * force.values + (1 - share) * before)


def _misfit(runs: Sequence[Beside]) -> float:
    return float(np.sqrt(np.mean(np.concatenate([run.left.ravel() for run in runs]) ** 2)))


class Search:
    """The forces at sites of a model that explain records, sought by smoothing along runs with them.

    What effects in the model do stays as it is.
    """

    def __init__(self, study: Study, near: Refit) -> None:
        self.study, self.given = study, dict(near.parameters)
        self.bench = Bench(study, [*near.parameters], near.effects)
        starts = zip(study.campaign.training, near.starts, strict=False)
        self.nominal = [self.bench.run(e, self.given, self.bench.begin(e, self.given, s)) for e, s in starts]

    @property
    def misfit(self) -> float:
        """The root mean square of what the model as given misses, in units of noise."""
        return _misfit(self.nominal)

    def best(self, number: int | None = None) -> tuple[list[tuple[int, float, Roughness]], Settled]:
        """Return the sites, the likeliest first, and the force at the first of them, or at one.

        They are ranked once more along the motion that a force has made: from there slopes are right.
        """
        numbers, sizes = self.movable()
        if not numbers or number not in (None, *numbers):
            where = "at any site" if number is None else f"at '{self.bench.sites[number].path}'"
            raise ModelError(
                f"no force {where} would change what is measured; measure more, or name another site"
            )
        ranked = self.rank(self.nominal, numbers, sizes)
        settled = self.settled(ranked[0][0], ranked[0][2])
        if len(numbers) > 1:
            ranked = self.rank(settled.runs, numbers, sizes)
        here = next(one for one in ranked if one[0] == settled.number)
        if number is None and here[1] > ranked[0][1] - PART_CHI_SQUARED / 2:
            return [here, *(one for one in ranked if one is not here)], settled
        chosen = next(one for one in ranked if number in (None, one[0]))
        if chosen is not here:
            settled = self.settled(chosen[0], chosen[2], settled.runs)
        return ranked, settled

    def movable(self) -> tuple[list[int], Array]:
        """Return the sites at which a force changes what is measured, and how large it has to be."""
        largest = {number: self._scale(number) for number in range(len(self.bench.sites))}
        scales = {number: scale for number, scale in largest.items() if scale.all()}
        missed, answered = 0.0, np.zeros((len(scales), 2))
        for beside in self.nominal:  # all sites of a run, whose slopes are kept until the next
            missed += float((beside.columns(True)[0][:, :, 0] ** 2).sum())
            for place, (number, scale) in enumerate(scales.items()):
                motion = beside.motion(number)
                forces = np.column_stack([motion.s - motion.distance, motion.v]) / scale
                answered[place] += (beside.answers(number, forces) ** 2).sum(axis=(0, 1))
        most = answered.max(axis=1, initial=0.0)
        seen = (most > 0) & np.isfinite(most)
        return [n for n, kept in zip(scales, seen, strict=True) if kept], np.sqrt(missed / most[seen])

    def _scale(self, number: int) -> Array:
        """Return the largest travel and speed of a site in any record."""
        motions = [beside.motion(number) for beside in self.nominal]
        return np.array([max(m.travel for m in motions), max(m.speed for m in motions)])

    def rank(
        self, runs: Sequence[Beside], numbers: Sequence[int], sizes: Array
    ) -> list[tuple[int, float, Roughness]]:
        """Return sites with evidence and roughness, the likeliest first, along runs that may have a force."""
        courses = [beside.course(numbers) for beside in runs]
        found: list[tuple[int, float, Roughness]] = []
        for roughness in likeliest(courses, sizes):
            evidence = filtered(courses, roughness, keep=False).evidence
            for place, number in enumerate(numbers):
                found.append((number, float(evidence[place]), roughness.of(place)))
        found.sort(key=lambda one: -one[1])
        best: dict[int, tuple[int, float, Roughness]] = {}
        for one in found:
            best.setdefault(one[0], one)
        return list(best.values())

    def settled(self, number: int, rough: Roughness, runs: Sequence[Beside] | None = None) -> Settled:
        """Return the force at a site along the motion that it makes, run after run until it stays."""
        here = list(runs or self.nominal)
        size, best, before = rough.size / FORCE_SIZE_RATIO, None, inf
        for count in range(FORCE_MOST_RUNS):
            courses = [beside.course([number]) for beside in here]
            if count in (1, 2):
                (rough,) = likeliest(courses, size, [rough.order])
            passed = filtered(courses, rough)
            promised = float(np.sqrt(passed.chi_squared[0] / sum(run.residual.size for run in here)))
            found = self._moved_on(number, here, passed)
            here = list(found.runs)
            best = found if best is None or found.misfit < best.misfit else best
            stays = count >= FORCE_RUNS and found.misfit > FORCE_WON_SHARE * before
            if best.misfit < FORCE_SETTLED * promised or stays:
                break
            before = found.misfit
        assert best is not None
        return best

    def resized(self, found: Settled) -> Settled:
        """Return a force of the size that it was found to have, where it could first be of any.

        What is steady in it is so told from where records begin, and from sensors whose zero is unknown.
        """
        here, number = list(found.runs), found.number
        courses = [beside.course([number]) for beside in here]
        size = np.array([found.rms]) / FORCE_SIZE_RATIO
        tried = [(filtered(courses, rough), rough) for rough in likeliest(courses, size)]
        passed, _ = max(tried, key=lambda one: float(one[0].evidence[0]))
        return self._moved_on(number, here, passed)

    def _moved_on(self, number: int, here: Sequence[Beside], passed: Filtered) -> Settled:
        """Return the force that a filter has passed along runs, and the runs that it makes.

        Where parameters would go farther than slopes hold, it is the force beside those that go as far.
        """
        courses, rough = passed.courses, passed.roughness
        wanted = passed.unknown[0, 0, : courses[0].shared]
        given = self._given(here[0].given, wanted)
        moved = self.bench.away(given)
        if not np.allclose(moved, wanted):
            passed = filtered([course.held(moved) for course in courses], rough)
        forces, errors = (
            [Force(beside.t, part[: len(beside.t), place, 0]) for place, beside in enumerate(here)]
            for part in smoothed(passed)
        )
        own = passed.unknown[:, 0, passed.courses[0].shared :]
        after = self._after(number, here, forces, given, own)
        forces, errors = (
            [Force(run.t, one.at(run.t)) for run, one in zip(after, some, strict=True)]
            for some in (forces, errors)
        )
        return Settled(number, given, rough, tuple(after), tuple(forces), tuple(errors))

    def _after(
        self,
        number: int,
        runs: Sequence[Beside],
        forces: Sequence[Force],
        given: Mapping[str, float],
        own: Array,
    ) -> list[Beside]:
        """Return runs with forces, or with so much of the change that they can be run."""
        error = None
        for _ in range(FORCE_HALVINGS):
            try:
                found = [
                    self.bench.run(run.experiment, given, run.began(begun, 0), number, force)
                    for run, begun, force in zip(runs, own, forces, strict=True)
                ]
            except SimulationError as told:
                error = told
                forces = [_between(run, force, 0.5) for run, force in zip(runs, forces, strict=True)]
            else:
                return [*map(self._held_back, runs, found, own, forces)]
        assert error is not None
        raise error

    def _held_back(self, run: Beside, found: Beside, own: Array, force: Force) -> Beside:
        """Return the next run of a record, with less of the change of its force where that leads away.

        Parts of a machine that stick or hit do not answer in a line.
        """
        best = found
        for share in FORCE_SHARES:
            if best.squares <= max(run.squares, FORCE_SUFFICES**2 * best.left.size):
                break
            begin, less = run.began(share * own, 0), _between(run, force, share)
            with suppress(SimulationError):
                tried = self.bench.run(run.experiment, found.given, begin, found.number, less)
                best = min(best, tried, key=lambda one: one.squares)
        return best

    def _given(self, before: Mapping[str, float], unknown: Array) -> dict[str, float]:
        """Return parameters on their way to what a smoother found of them, no farther than slopes hold."""
        given = {}
        for name, away in zip(self.bench.names, unknown.tolist(), strict=True):
            prior = self.study.campaign.priors[name]
            at = (before[name] - prior.center) / prior.scale
            low, high = min(at - FORCE_PARAMETER_STEP, 0.0), max(at + FORCE_PARAMETER_STEP, 0.0)
            given[name] = prior.at(min(max(away, low), high))
        return given
