"""What follows a machine in pieces of its records, where no free run follows it through whole ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf

from ...base import computing
from ...components import InertanceError
from ..criteria import (
    LAW_RESOLVED,
    LIKENED_LEAST_GAIN,
    LOST_LEAST,
    PIECE_ROUNDS,
    PIECE_WON_SHARE,
)
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.score_test import Candidate
from .along import Beside
from .law import Law
from .likened import likened_across, likened_in_series
from .missing_force import MissingForce, force_of
from .pieces import Follower, cut
from .polish import as_it_is, placed, polished
from .search import Search
from .sized import sized
from .sought import Sought, best_law, refusal


@dataclass(frozen=True, eq=False)
class InPieces:
    """What does as the missing force does along the motion that this makes, held against pieces of records.

    A free run with it parts from the machine sooner or later, as a small error grows in valleys and at gaps.
    A piece ends where a run does so, and another begins where the machine is.

    Attributes:
        study: with whole records.
        model: in them.
        missing: the force.
        drawn: the law that foresees most of it.
        foreseen: how much of the force a law foresees, by site.
        follows: whether free runs with the law follow all of the training records; then nothing is in series.
    """

    study: Study
    model: Refit
    missing: MissingForce
    drawn: Law
    foreseen: dict[str, float]
    follows: bool = False

    @classmethod
    def of(cls, study: Study, model: Refit, known: Sought | None = None) -> InPieces | None:
        """Return it for a model; None for one without states, or which cannot be run beside a force.

        What came of a law in whole records may be known. A model without states, as of a rig that prescribes
        all motion, loses nothing in free runs.
        """
        if study.is_led:
            return None
        if known is not None and known.found is not None and known.follows:
            return cls(study, model, known.missing, known.found.law, dict(known.foreseen), follows=True)
        try:
            missing = force_of(study, model) if known is None else known.missing
            return cls(study, model, *best_law(study, model, missing))
        except InertanceError:
            return None

    @cached_property
    def in_series(self) -> list[Candidate]:
        """Effects in series with a spring that are like the force, with the sizes that short runs tell."""
        if self.follows:
            return []
        try:
            return sized(self.study, self.missing, likened_in_series(self.missing, self.model))
        except InertanceError:
            return []

    def at_spring(self) -> InPieces | None:
        """Return it with the force at the likeliest spring, where it is sought at none."""
        sites = {site.path: site for site in self.missing.search.bench.sites}
        springs = [one.site for one in self.missing.ranking if sites[one.site].spring]
        if self.follows or self.missing.site.spring or not springs:
            return None
        try:
            return replace(self, missing=force_of(self.study, self.model, springs[0]))
        except InertanceError:
            return None

    @property
    def as_drawn(self) -> list[Candidate]:
        """Static effects that are like the law as the force shows it."""
        return likened_across(self.drawn, self.model)

    @property
    def law(self) -> Law | None:
        """The law, fitted to pieces of the training records; None if it follows the machine nowhere long."""
        return self._learnt[0]

    @property
    def across(self) -> list[Candidate]:
        """Static effects that are like the law, fitted to pieces."""
        return self._learnt[1]

    @cached_property
    @computing("the search for what records in pieces lack")
    def _learnt(self) -> tuple[Law | None, list[Candidate]]:
        """What is learnt of the law, until it follows the records or an effect that is like it is near."""
        if self.follows:
            return self.drawn, []
        law, listed = None, list[Candidate]()
        for law, left in _rounds(self.study, self.drawn, self.missing):
            listed = likened_across(law, self.model)
            if listed and left < LOST_LEAST:
                break
        return law, listed

    def cut_by_effect(self, one: Candidate) -> Study | None:
        """Return the records in pieces that an effect follows."""
        effect = Hypothesis(one.effect, one.site, f"{one.effect.kind}_1", one.values)
        law = self.drawn if one.effect.is_static else self.missing.by_position
        return self._cut(effect, one.parameters, law)

    def cut_by_law(self) -> Study | None:
        """Return the records in pieces that the law follows."""
        return None if self.law is None else self._cut(placed(self.law), self.law.given, self.law)

    def sought(self, pieces: Study, base: Refit) -> Sought | None:
        """Return what comes of the law in pieces of the records, held against a model in them."""
        assert self.law is not None
        try:
            found = (as_it_is if self.follows else polished)(pieces, self.law)
        except InertanceError:
            return None
        return Sought(base, self.missing, self.foreseen, found, refusal(base, found))

    def _cut(self, effect: Hypothesis, given: Mapping[str, float], law: Law) -> Study | None:
        """Return the records in pieces that an effect follows, as a law would; None if it follows none."""
        try:
            runs = [*self.missing.settled.runs, *self._tested]
            return cut(self.study, Follower.of(self.study, self.missing, law, effect, given), runs)
        except InertanceError:
            return None

    @cached_property
    def _tested(self) -> Sequence[Beside]:
        """The test records along the motion that the missing force makes at the same site."""
        if not self.study.campaign.testing:
            return []
        campaign = self.study.campaign.with_records(self.study.campaign.testing, [])
        count = len(self.study.campaign.training)
        near = replace(self.model, starts=self.model.starts[count:])
        number, rough = self.missing.settled.number, self.missing.settled.rough
        return Search(replace(self.study, campaign=campaign), near).settled(number, rough).runs


def _rounds(study: Study, law: Law, missing: MissingForce) -> Iterator[tuple[Law, float]]:
    """Yield a law fitted to pieces of the training records, and what it misses of them [noise], ever less.

    What is learnt of it makes them longer. A law that foresees little of the force is not fitted.
    """
    if not law.is_foreseen:
        return
    alone = replace(study, campaign=study.campaign.with_records(testing=[]))
    runs, left = missing.settled.runs, inf
    for _ in range(PIECE_ROUNDS):
        if study.late():
            break
        try:
            pieces = cut(alone, Follower.of(alone, missing, law, placed(law), law.given), runs)
            found = polished(pieces, law)
        except InertanceError:
            break
        if found.left > PIECE_WON_SHARE * left:
            break
        yield found.law, found.left
        if found.left <= LAW_RESOLVED * max(1.0, missing.misfit):
            break
        left, law = found.left, found.law.finer()


def likest(listed: Sequence[Candidate], model: Refit) -> Candidate | None:
    """Return the plainest of the effects that are likest to what a model misses."""
    if not listed:
        return None
    least = max(one.gain for one in listed) - LIKENED_LEAST_GAIN * model.cost
    return min((one for one in listed if one.gain > least), key=lambda one: len(one.values))


def refitted(study: Study, model: Refit) -> tuple[Refit, Refit]:
    """Return a model without effects as it was given, and fitted, in the records of another study."""
    joint = JointFit(study, model.parameters)
    return joint.seen(joint.vector(study.campaign.start, [])), joint.fitted()
