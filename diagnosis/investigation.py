"""`Investigation`: a diagnosis under way, what is known so far, and what is done next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf

from ..components import InertanceError
from . import criteria
from .law.forced import screened_along
from .law.sought import Sought, sought
from .models.study import FMUStudy, Study
from .search.ahead import gone_ahead
from .search.choice import taken
from .search.hearing import heard_beside
from .search.horizon import fitted_to_loudest, foreseen
from .search.joint_fit import JointFit
from .search.model_comparison import Refit, gap_taken, is_clear, unexplained
from .search.recast import Recast
from .search.revision import Rivals, plainer, pruned, revised
from .search.reweighed import is_slight, reweighed
from .search.ringing import behind_low_pass
from .search.round import Round, follow, go_on, run_round
from .search.tried import Tried, without
from .verdict.beyond import beyond_the_list
from .verdict.decide import certain_part, decided, explains, leaves_noise
from .verdict.verdict import Verdict


@dataclass(eq=False)
class Investigation:
    """What a diagnosis knows so far.

    Attributes:
        study: the campaign, with its records as they are compared, and their noise.
        start: the model as it was given.
        base: the same, its parameters fitted.
        best: the best model so far, with the effects that were found.
        rounds: of the search, whose `Round` tells what was screened and fitted beside which model.
        before: rounds with other noise in mind, or of records that were compared otherwise.
        rivals: of each effect, what comes close to it beside the others.
        notes: what the verdict says beside its results.
        known: what stands if the search that has begun anew comes to nothing.
        law: what came of looking for a static law beside no effect.
    """

    study: Study
    start: Refit
    base: Refit
    best: Refit
    tried: Tried
    rounds: list[Round] = field(default_factory=list)
    before: list[Round] = field(default_factory=list)
    rivals: Rivals = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    known: Investigation | None = None
    law: Sought | None = None
    asked: bool = False  # whether a law was looked for
    ahead: bool = False  # whether models of two effects that say nothing alone were tried
    looked_at: Refit | None = None  # whose effects were last held against all others

    @classmethod
    def of(cls, study: Study) -> Investigation:
        """Return that of a study before its first round: its parameters are fitted."""
        study, start, base = refitted_as_heard(study)
        return cls(study, start, base, base, Tried(study), notes=study.limits())

    def run(self) -> None:
        """Look for effects until none could take away enough to be believed, or time is up."""
        while self._goes_on():
            pass
        self.best = plainer(self.best, self.tried)

    def decided(self) -> Verdict:
        """Return the verdict, with a law of its own where nothing listed explains enough."""
        told = self.known if self.known and self.study.late() and not self.best.effects else self
        verdict = decided(told.study, told.start, told.base, told.best, told.rounds, self.notes, self.rivals)
        return beyond_the_list(told.study, verdict, told.law)

    def broken_off(self) -> Verdict:
        """Return the verdict on what is known, for which nothing more is begun."""
        told = self.known if self.known and not self.best.effects else self
        study = replace(told.study, deadline=-inf)
        return decided(study, told.start, told.base, told.best, told.rounds, self.notes, self.rivals)

    def _goes_on(self) -> bool:
        """Look for one more effect, or hold those there are against all others; tell whether to go on."""
        chosen = self._from_a_round() or self._from_two_at_once()
        if chosen is None:
            return self._holds_against_all_others()
        self.tried.begin(chosen, chosen.effects[:-1])
        if not self._had_ended_early(chosen):
            self._take(chosen)
        return True

    def _from_a_round(self) -> Refit | None:
        """Return the best model with one more effect; None if there is none, or it is not looked for."""
        if not _may_go_on(self.best, self.base, self.study):
            return None
        if len(self.best.effects) >= criteria.EFFECTS_BEFORE_LAW and self._is_a_law():
            return None
        done = run_round(self.study, self.best, self.rounds, self.before)
        other = None if self.before else _recast(self.study, self.start, done)
        if other is not None:
            self.notes.append(other.told)
            self._begin_anew(other.study, other.start, other.base)
            done = run_round(self.study, self.best, self.rounds, self.before, other.model)
        follow(self.study, done)
        return taken(done, self.base) or _chosen_along(self.study, done, self.base)

    def _from_two_at_once(self) -> Refit | None:
        """Return a model of two effects that say nothing alone, going on from one of them; None if none is.

        It is sought once. What would be named of the best so far gives way only to what explains the gap.
        """
        if self.ahead or not self.rounds or explains(self.best, self.base, self.study):
            return None
        self.ahead = True
        if self._is_a_law() or (self.law is not None and self.law.follows):
            return None
        named = certain_part(self.best, self.base, self.rounds, self.study).effects
        found = gone_ahead(
            self.study,
            self.rounds,
            self.best,
            self.base,
            lambda model: not named or explains(model, self.base, self.study),
        )
        if found is None:
            return None
        self.best, chosen = found
        return chosen

    def _is_a_law(self) -> bool:
        """Tell whether one static law alone leaves nothing but noise, which then stands for all effects.

        It is looked for once, in whole records.
        """
        if not self.asked and not self.study.late() and not isinstance(self.study, FMUStudy):
            self.study.tell("looking for a law of its own")
            self.law, self.asked = sought(self.study, self.base), True
        model = None if self.law is None else self.law.model
        if model is None or not leaves_noise(model, self.study):
            return False
        self.best = self.base
        return True

    def _holds_against_all_others(self) -> bool:
        """Exchange effects for what does better beside the others; tell whether one was."""
        last = self.best
        if last is self.looked_at or not _is_worth_a_look(last, self.base, self.study):
            return False
        self.best, self.rivals = revised(pruned(last, self.tried), self.rounds, self.tried, anew=True)
        self.looked_at = self.best
        return self.best is not last

    def _had_ended_early(self, chosen: Refit) -> bool:
        """Go on from a chosen model without its last effect, if that is far better than the model before."""
        most = criteria.EARLY_END_COST_RATIO * self.best.cost
        less = without(self.study, chosen.effects[-1], chosen, most)
        if less is None or less.cost >= most:
            return False
        self.study.tell("the fit before had ended early: once more from where this one led")
        self.best, self.base = less, self.base if self.best.effects else less
        self.rounds.pop()
        return True

    def _take(self, chosen: Refit) -> None:
        """Go on with a chosen model, or begin anew with the noise that shows beside it."""
        self.known = replace(self, best=chosen, known=None)
        heard = self.study if self.study.late() else _heard(self.study, chosen)
        again = chosen if heard is self.study else self._as_heard(heard, chosen)
        if again is not None:
            self.best, self.rivals = revised(pruned(again, self.tried), self.rounds, self.tried)

    def _as_heard(self, heard: Study, chosen: Refit) -> Refit | None:
        """Return a chosen model in a study with other noise; None if the search begins anew with that."""
        stays = bool(self.before) or is_slight(self.study.campaign, heard.campaign)
        given = self.study, heard, self.start, self.base, chosen, self.rounds
        again = reweighed(*given) if stays else None
        if again is not None:
            self._enter(heard)
            self.start, self.base, chosen, self.rounds = again
        elif not self.before:
            self._begin_anew(heard, *_refitted(heard, chosen.parameters))
            return None
        return chosen

    def _begin_anew(self, study: Study, start: Refit, base: Refit) -> None:
        """Begin the search anew in a study of other records or other noise; what was fitted stays known."""
        self._enter(study)
        self.start, self.base = start, base
        self.best, self.rivals, self.before, self.rounds, self.ahead = base, {}, self.rounds, [], False

    def _enter(self, study: Study) -> None:
        """Go on in a study of other records or other noise, in which nothing was tried."""
        self.study, self.tried, self.law, self.asked = study, Tried(study), None, False


def _recast(study: Study, start: Refit, done: Round) -> Recast | None:
    """Return what an effect in series comes to in records compared otherwise, if it explains them there.

    It is asked in a first round that leaves much: behind a low pass, as impacts ring; and, fitted to the
    loudest record before, which may do, in records as far as it foresees them. There must be something left
    to explain.
    """
    base = done.base
    if base.effects or study.late() or explains(taken(done, base) or base, base, study):
        return None
    slow = behind_low_pass(study, start, done)
    if slow is not None and _explains_there(slow):
        return slow
    loudest = fitted_to_loudest(study, done)
    if loudest is None:
        return None
    done.keep(loudest)
    found = None if explains(loudest, base, study) else foreseen(study, start, base, loudest)
    return found if found is not None and _explains_there(found) else None


def _explains_there(found: Recast) -> bool:
    """Tell whether an effect explains a gap that is clear in records compared otherwise."""
    return is_clear(found.base, found.model) and explains(found.model, found.base, found.study)


def _chosen_along(study: Study, done: Round, base: Refit) -> Refit | None:
    """Return the best model of a first round that came to nothing, gone on with along the missing force.

    It is sought only of a network of which nothing is found otherwise.
    """
    model = done.base
    if model.effects or study.late() or isinstance(study, FMUStudy) or explains(model, base, study):
        return None
    study.tell("screening effects along the motion that the missing force makes")
    try:
        candidates, near = screened_along(study, model)
    except InertanceError:
        return None
    go_on(study, done, candidates, near)
    return taken(done, base)


def refitted_as_heard(study: Study) -> tuple[Study, Refit, Refit]:
    """Return the model as it was given and fitted, and the study with the noise that shows beside it."""
    start, base = _refitted(study, study.campaign.start)
    heard = _heard(study, base)
    if heard is not study:
        start, base = _refitted(heard, base.parameters, base)
    return heard, start, base


def _refitted(
    study: Study, parameters: Mapping[str, float], near: Refit | None = None
) -> tuple[Refit, Refit]:
    """Return the model as it was given, and with its parameters fitted from a start."""
    joint = JointFit(study, parameters, near=near)
    given = joint.vector(study.campaign.start, [])
    return joint.seen(given), joint.fitted()


def _heard(study: Study, model: Refit) -> Study:
    """Return the study with the noise that shows beside a model; itself if no other noise shows."""
    heard = heard_beside(study, model)
    if heard is not study:
        study.tell("refitting with the noise that a filter has left")
    return heard


def _may_go_on(best: Refit, base: Refit, study: Study) -> bool:
    """Tell whether there is time for another effect, and one could take away enough to be believed."""
    if study.late() or len(best.effects) >= criteria.MOST_EFFECTS:
        return False
    if not best.effects:
        return best.misfit > criteria.NOISE_MISFIT or not study.noise_is_sure
    if best.misfit <= criteria.COLOURED_MISFIT or best.is_noise(study.judged):
        return False
    return unexplained(best, base) > criteria.HIDDEN_RESIDUAL_SHARE


def _is_worth_a_look(best: Refit, base: Refit, study: Study) -> bool:
    """Tell whether several effects would be named, so that each is to be held against all others."""
    return len(best.effects) > 1 and not study.late() and gap_taken(best, base) >= criteria.CERTAIN_GAP_SHARE
