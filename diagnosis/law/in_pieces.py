"""What follows a machine in pieces of its records, where no free run follows it through whole ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf

from ...base import computing
from ...components import InertanceError
from ..criteria import (
    LAW_FORESEEN_SHARE,
    LAW_RESOLVED,
    LIKENED_LEAST_GAIN,
    PIECE_ROUNDS,
    PIECE_WON_SHARE,
)
from ..effects.hypothesis import Hypothesis
from ..models.network_predictor import NetworkPredictor
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.score_test import Candidate
from .along import Beside
from .law import Law
from .likened import likened
from .missing_force import MissingForce, force_of
from .pieces import Follower, cut
from .polish import placed, polished
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
        law: that is foreseen, as pieces of the training records tell it; None if there is none.
        listed: effects of the list that are like it, or like the force in series with a spring.
        foreseen: how much of the force a law foresees, by site.
    """

    study: Study
    model: Refit
    missing: MissingForce
    law: Law | None
    listed: Sequence[Candidate]
    foreseen: dict[str, float]

    @classmethod
    @computing("the search for what records in pieces lack")
    def of(cls, study: Study, model: Refit, known: MissingForce | None = None) -> InPieces | None:
        """Return it for a model; None where no law follows the machine long, and no effect is like the force.

        The missing force may be known. A model without states, as of a rig that prescribes all motion, loses
        nothing in free runs.
        """
        if not NetworkPredictor(study.campaign, (), (), ()).dae.state_names:
            return None
        try:
            missing, law, foreseen = best_law(study, model, known or force_of(study, model))
            learnt = _learnt(study, law, missing) if law.explained >= LAW_FORESEEN_SHARE else None
            listed = likened(missing, learnt, model)
            if learnt is None and listed:
                listed = sized(study, missing, listed)
        except InertanceError:
            return None
        return cls(study, model, missing, learnt, listed, foreseen) if learnt or listed else None

    @property
    def likest(self) -> Candidate | None:
        """The plainest of the effects that are likest to the force."""
        if not self.listed:
            return None
        least = self.listed[0].gain - LIKENED_LEAST_GAIN * self.model.cost
        return min((c for c in self.listed if c.gain > least), key=lambda c: len(c.values))

    def cut_by_effect(self, one: Candidate) -> Study | None:
        """Return the records in pieces that an effect follows."""
        effect = Hypothesis(one.effect, one.site, f"{one.effect.kind}_1", one.values)
        law = self.law if self.law and one.effect.is_static else self.missing.by_position
        return self._cut(effect, one.parameters, law)

    def cut_by_law(self) -> Study | None:
        """Return the records in pieces that the law follows."""
        return None if self.law is None else self._cut(placed(self.law), self.law.given, self.law)

    def sought(self, pieces: Study, base: Refit) -> Sought | None:
        """Return what comes of the law in pieces of the records, held against a model in them."""
        assert self.law is not None
        try:
            found = polished(pieces, self.law)
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
        campaign, count = copy(self.study.campaign), len(self.study.campaign.training)
        campaign.training, campaign.testing = self.study.campaign.testing, []
        near = replace(self.model, starts=self.model.starts[count:])
        number, rough = self.missing.settled.number, self.missing.settled.rough
        return Search(replace(self.study, campaign=campaign), near).settled(number, rough).runs


def _learnt(study: Study, law: Law, missing: MissingForce) -> Law | None:
    """Return a law fitted to pieces of the training records; what is learnt of it makes them longer."""
    training = copy(study.campaign)
    training.testing = []
    alone, runs = replace(study, campaign=training), missing.settled.runs
    learnt, left = None, inf
    for _ in range(PIECE_ROUNDS):
        if study.late():
            break
        try:
            pieces = cut(alone, Follower.of(alone, missing, law, placed(law), law.given), runs)
            found = polished(pieces, law)
        except InertanceError:
            break
        if found.left <= LAW_RESOLVED * max(1.0, missing.misfit):
            return found.law
        if found.left > PIECE_WON_SHARE * left:
            break
        learnt, left = found.law, found.left
        law = learnt.finer()
    return learnt


def refitted(study: Study, model: Refit) -> tuple[Refit, Refit]:
    """Return a model without effects as it was given, and fitted, in the records of another study."""
    joint = JointFit(study, model.parameters)
    return joint.seen(joint.vector(study.campaign.start, [])), joint.fitted()
