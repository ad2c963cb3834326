"""A round of the search: effects screened, and the leading ones fitted."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from math import inf

from ...components import InertanceError
from ...identification import Campaign
from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .contenders import leading, promising, ready, reserve
from .crew import Crew, Outcome
from .fit import LATE, Fit
from .followed import fitted_to_followed
from .joint_fit import JointFit
from .model_comparison import Refit, best_of, unexplained
from .needless import leaves_chance, needless
from .score_test import Candidate, screen


@dataclass(eq=False)
class Round:
    """One round of the search: the model so far, the candidates, what fits of them gave, why some gave none.

    Attributes:
        failed: by label of a candidate, why its fit came to nothing.
        unscreened: why there are no candidates, or none where the parameters were given, if it cannot be run
            beside probes.
    """

    base: Refit
    candidates: list[Candidate]
    fitted: list[Refit]
    failed: dict[str, str] = field(default_factory=dict)
    unscreened: str = ""

    @property
    def nearest(self) -> Refit:
        """Of what was fitted, the model nearest to the training records."""
        return min(self.fitted, key=lambda model: model.cost)

    def keep(self, found: Refit) -> None:
        """Add a fit; of two that end elsewhere from other starts, the better one stays."""
        label = found.effects[-1].label
        before = next((n for n, other in enumerate(self.fitted) if other.effects[-1].label == label), None)
        if before is None:
            self.fitted.append(found)
        elif found.cost < self.fitted[before].cost:
            self.fitted[before] = found


def run_round(
    study: Study, base: Refit, rounds: list[Round], before: Sequence[Round] = (), found: Refit | None = None
) -> Round:
    """Screen all effects on top of a model and fit the leading ones; what is known stands in `rounds`.

    What was fitted in rounds `before`, with other noise in mind, goes on from there. Beside a model that was
    `found` already only what may come near it is fitted.
    """
    told = " on top of what was found" if base.effects else ""
    study.tell(f"screening effects{told}")
    early = None if base.effects else Crew(study).ask(_screened_as_given, base)
    try:
        candidates = screen(study, base.parameters, base.effects, near=base)
    except InertanceError as error:
        if not base.effects:
            raise
        rounds.append(Round(base, [], [], unscreened=error.headline))
        return rounds[-1]
    rounds.append(Round(base, list(candidates), [] if found is None else [found]))
    same = (done for done in before if done.base.labels == base.labels)
    known = {model.effects[-1].label: model for done in same for model in done.fitted}
    kept, others = 0.0, candidates
    if found is not None:
        kept, others = base.cost - found.cost, [c for c in candidates if c.label != found.labels[-1]]
    _fit(study, rounds[-1], others, rounds[0], early, known=known, kept=kept)
    if rounds[-1].fitted:
        _fit(study, rounds[-1], _richer(study, rounds[-1], candidates), rounds[0], None, known=known)
        _fit_elsewhere(study, rounds[-1])
    return rounds[-1]


def _richer(study: Study, done: Round, candidates: Sequence[Candidate]) -> list[Candidate]:
    """Return what was none of the leading, and generalises the model nearest to the training records.

    Or a special case of it: that promises as much as what a fit has shown. None where only chance is left.
    """
    nearest = done.nearest
    if leaves_chance(study, nearest):
        return []
    last = [model.effects[-1] for model in done.fitted]
    named = nearest.effects[-1]
    kin = [placed for placed in last if placed is named or named.generalises(placed)]
    known = {placed.label for placed in last} | done.failed.keys()
    richer = (c for c in candidates if c.label not in known and any(c.generalises(p) for p in kin))
    return [*richer][: criteria.RESERVES_PER_ROUND]


def _fit_elsewhere(study: Study, done: Round) -> None:
    """Fit the nearest effect at other sites once more, where parameters that ran away led fits of it astray.

    They go on from the parameters of the nearest model.
    """
    if study.late() or not _ran_away(study.campaign, done.base):
        return
    nearest, crew, under_way = done.nearest, Crew(study), list[Outcome]()
    kind, screened = nearest.effects[-1].effect.kind, {c.label: c.values for c in done.candidates}
    for model in done.fitted:
        placed = model.effects[-1]
        if model is nearest or placed.effect.kind != kind or not _ran_away(study.campaign, model):
            continue
        study.tell(f"fitting {placed.label} from where {nearest.labels[-1]} led")
        values = [placed.values, screened.get(placed.label, placed.values)]
        fit = Fit(placed, done.base, [(nearest.parameters, v) for v in values], nearest.cost)
        under_way.append(crew.begin(fit))
    for found in [outcome() for outcome in under_way]:
        if isinstance(found, Refit):
            done.keep(found)


def follow(study: Study, done: Round) -> None:
    """Fit the model of a round nearest to the training records to what it follows of them."""
    if done.fitted:
        nearest = done.nearest
        done.fitted[done.fitted.index(nearest)] = fitted_to_followed(study, nearest)


def nearest_in_series(done: Round) -> Refit | None:
    """Return the model with an effect in series nearest to the training records, if any comes near."""
    in_series = (model for model in done.fitted if model.effects[-1].effect.place == "series")
    found = min(in_series, key=lambda model: model.cost, default=None)
    most = max((done.base.cost - model.cost for model in done.fitted), default=0.0)
    near = found is not None and done.base.cost - found.cost > criteria.RIVAL_DROP_RATIO * most
    return found if near else None


def go_on(study: Study, done: Round, candidates: Sequence[Candidate], near: Refit) -> None:
    """Fit candidates in a first round that came to nothing, from where they were screened.

    Records begin where those of the model do that is `near`. A candidate that was fitted before is fitted
    once more, and the better fit stays.
    """
    _fit(study, done, candidates, done, None, near)
    known = {c.label for c in done.candidates}
    done.candidates.extend(c for c in candidates if c.label not in known)


def _fit(
    study: Study,
    done: Round,
    candidates: Sequence[Candidate],
    first: Round,
    early: Callable[[], tuple[list[Candidate], str]] | None,
    near: Refit | None = None,
    known: Mapping[str, Refit] | None = None,
    kept: float = 0.0,
) -> None:
    """Fit the leading candidates of a round, unless they promise far less than what a fit has `kept`.

    `early` gives those that are screened where the parameters were given, for when much is left; by label,
    `known` are models from where fits may go on.
    """
    base, fitted, failed = near or done.base, done.fitted, done.failed
    waiting = promising(leading(candidates, base.labels), kept, fitted)
    crew, tried, hidden = Crew(study), list[Candidate](), list[Candidate]()
    hides = early is not None and _hides(study.campaign, base, candidates)
    under_way = deque[tuple[Candidate, Outcome]]()
    while under_way or (waiting and not study.late()):
        chosen = ready(waiting, [candidate for candidate, _ in under_way])
        if chosen is not None and len(under_way) < criteria.FITS_UNDER_WAY and not study.late():
            waiting.remove(chosen)
            tried.append(chosen)
            fit = Fit.of(chosen, base, fitted, (known or {}).get(chosen.label))
            if why := needless(study, fit.placed, base, fitted) or only_bends(fit.placed, base, first):
                failed[chosen.label] = why
            else:
                under_way.append((chosen, crew.begin(fit)))
            continue
        candidate, outcome = under_way.popleft()
        found = outcome()
        study.tell(f"fitted {candidate.label}, at most {len(under_way) + len(waiting)} to go")
        if isinstance(found, str):
            failed[candidate.label] = found
        else:
            done.keep(found)
            kept = max(kept, min(candidate.gain, base.cost - found.cost))
        waiting = promising(waiting, kept, fitted)
        if hides and early is not None and len(tried) - len(under_way) >= criteria.RESERVES_PER_ROUND:
            hides = False
            if _much_is_left(study.campaign, (base, *fitted), base):
                study.tell("parameters went far off: screening where they were given")
                hidden, done.unscreened = early()
                waiting = [*leading(hidden, ())[: criteria.CONTENDERS_BESIDE_HELD], *waiting]
        over = not waiting and not under_way and not study.late()
        if over and early is not None and _much_is_left(study.campaign, (base, *fitted), base):
            overlooked = list[Candidate]()
            if not hidden:
                study.tell("much is left: screening where the parameters were given")
                hidden, done.unscreened = early()
                overlooked = hidden
            waiting, early = reserve(candidates, overlooked, tried, _ran_away(study.campaign, base)), None
        elif over and early is not None and _ran_away(study.campaign, best_of((base, *fitted))):
            study.tell("what fits best takes parameters far off: trying what is in series")
            waiting, early = reserve(candidates, (), tried, True), None
    failed.update((c.label, LATE) for c in waiting)
    screened = {c.label for c in candidates}
    done.candidates.extend(c for c in hidden if c.label not in screened)


def _screened_as_given(study: Study, base: Refit) -> tuple[list[Candidate], str]:
    """Return effects as they are screened where the parameters were given; none with why they cannot be.

    Of a model with parameters that ran away the others are fitted beside these.
    """
    try:
        held = _held(study, base)
        return screen(study, held.parameters if held else study.campaign.start, near=held), ""
    except InertanceError as error:
        return [], error.headline


def _held(study: Study, base: Refit) -> Refit | None:
    """Return the model whose parameters that run away are held where they were given; None if none do."""
    campaign, known, model = copy(study.campaign), study.campaign.priors, None
    away, held = _away(study.campaign, base), set[str]()
    while away - held:
        held |= away
        campaign.priors = {
            n: replace(prior, sd=criteria.HELD_SHARE * prior.sd) if n in held else prior
            for n, prior in known.items()
        }
        model = JointFit(replace(study, campaign=campaign), campaign.start).fitted()
        away = _away(study.campaign, model)
    return model


def only_bends(placed: Hypothesis, base: Refit, first: Round) -> str:
    """Return of which effect of a model another one would only bend the law, being of its nature and motion.

    The `first` round shows what is one motion.
    """
    of = (p for p in base.effects if p.generalises(placed) or (p.effect.memory and placed.effect.memory))
    bent = next((p for p in of if _in_one_motion(p, placed, first)), None)
    return f"it would only bend the law of {bent.label}" if bent is not None else ""


def _in_one_motion(placed: Hypothesis, other: Hypothesis, first: Round) -> bool:
    """Tell whether effects stand at one site, or one of them, alone, took nearly all of the gap at either."""
    if placed.site.path == other.site.path:
        return True
    left = {
        model.effects[0].site.path: float(model.blocks.sum())
        for model in first.fitted
        if len(model.effects) == 1 and model.effects[0].effect.kind == placed.effect.kind
    }
    less, more = sorted(left.get(p.site.path, inf) for p in (placed, other))
    nearly_all = more < criteria.NEARLY_ALL_LEFT * float(first.base.blocks.sum())
    return nearly_all and more < criteria.ONE_MOTION_RATIO * less


def _ran_away(campaign: Campaign, base: Refit) -> bool:
    """Tell whether parameters are so far from what was assumed that other starts than there must be tried."""
    return bool(_away(campaign, base))


def _away(campaign: Campaign, model: Refit) -> set[str]:
    """Return the parameters of a model that are far from what was assumed."""
    moved = {name: campaign.priors[name].moved(value) for name, value in model.parameters.items()}
    return {name for name, far in moved.items() if far > criteria.MOVED_STANDARD_DEVIATIONS}


def _hides(campaign: Campaign, base: Refit, candidates: Sequence[Candidate]) -> bool:
    """Tell whether parameters went far off for something that no candidate explains from there, by far."""
    missed = base.cost * (1 - 1 / max(base.misfit, 1.0) ** 2)
    most = max((candidate.gain for candidate in candidates), default=0.0)
    return _ran_away(campaign, base) and most < criteria.SCREENED_SHARE * missed


def _much_is_left(campaign: Campaign, models: Sequence[Refit], base: Refit) -> bool:
    """Tell whether the best model leaves more than one that is right would.

    A little may be left of one whose parameters stayed near what was assumed.
    """
    best = min(models, key=lambda model: model.misfit)
    least = criteria.HIDDEN_RESIDUAL_SHARE if _ran_away(campaign, best) else criteria.NEARLY_ALL_LEFT
    return best.misfit > criteria.COLOURED_MISFIT and unexplained(best, base) > least
