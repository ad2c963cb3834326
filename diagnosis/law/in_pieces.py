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
from .missing_force import MissingForce, force_of
from .pieces import Follower, cut
from .polish import placed, polished
from .search import Search
from .sought import Sought, best_law, refusal


@dataclass(frozen=True, eq=False)
class InPieces:
    """A law that is foreseen along the motion that the missing force makes, and learnt in pieces of records.

    A free run with it parts from the machine sooner or later, as a small error grows in valleys and at gaps.
    A piece ends where a run does so, and another begins where the machine is.

    Attributes:
        study: with whole records.
        model: in them.
        missing: the force.
        law: as the training records tell it.
        foreseen: how much of the force a law foresees, by site.
    """

    study: Study
    model: Refit
    missing: MissingForce
    law: Law
    foreseen: dict[str, float]

    @classmethod
    @computing("the search for what records in pieces lack")
    def of(cls, study: Study, model: Refit, known: MissingForce | None = None) -> InPieces | None:
        """Return it for a model; None where no law foresees enough, or none follows the machine for long.

        The missing force may be known. A model without states, as of a rig that prescribes all motion, loses
        nothing in free runs.
        """
        if not NetworkPredictor(study.campaign, (), (), ()).dae.state_names:
            return None
        try:
            missing, law, foreseen = best_law(study, model, known or force_of(study, model))
            if law.explained < LAW_FORESEEN_SHARE:
                return None
            learnt = _learnt(study, law, missing)
        except InertanceError:
            return None
        return None if learnt is None else cls(study, model, missing, learnt, foreseen)

    def cut_by_effect(self, listed: Sequence[Candidate]) -> Study | None:
        """Return the records in pieces that the plainest of the effects likest to the law follows."""
        if not listed:
            return None
        least = listed[0].gain - LIKENED_LEAST_GAIN * self.model.cost
        plainest = min((c for c in listed if c.gain > least), key=lambda c: len(c.values))
        name = f"{plainest.effect.kind}_1"
        effect = Hypothesis(plainest.effect, plainest.site, name, plainest.values)
        return self._cut(effect, plainest.parameters)

    def cut_by_law(self) -> Study | None:
        """Return the records in pieces that the law follows."""
        return self._cut(placed(self.law), self.law.given)

    def sought(self, pieces: Study, base: Refit) -> Sought | None:
        """Return what comes of the law in pieces of the records, held against a model in them."""
        try:
            found = polished(pieces, self.law)
        except InertanceError:
            return None
        return Sought(base, self.missing, self.foreseen, found, refusal(base, found))

    def _cut(self, effect: Hypothesis, given: Mapping[str, float]) -> Study | None:
        """Return the records in pieces that an effect follows; None if it follows none for long."""
        try:
            runs = [*self.missing.settled.runs, *self._tested]
            return cut(self.study, Follower.of(self.study, self.law, effect, runs, given), runs)
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
            pieces = cut(alone, Follower.of(alone, law, placed(law), runs, law.given), runs)
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
