"""From fitted models to the verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import TypeVar

import numpy as np

from ...components import SimulationError
from ...identification import Campaign
from ..criteria import (
    ALIKE_RIGHT_SHARE,
    CERTAIN_GAP_SHARE,
    CERTAIN_RESIDUAL_SHARE,
    CLEAR_RIGHT_SHARE,
    COLOURED_MISFIT,
    EXPLAINED_GAP_SHARE,
    NOISE_MISFIT,
)
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from ..search.choice import is_told
from ..search.contenders import same_motion
from ..search.model_comparison import Refit, are_alike, clearness, gap_taken
from ..search.revision import Rivals
from ..search.round import Round
from .all_records import alike_by_all, are_one_delay
from .cautions import cautions, led_astray, suspicions
from .counterfactual import Foretold, counterfactuals, parting, told_apart
from .gap import Gap, gaps
from .localisation import located, shares
from .next_experiment import separating
from .ranked import Ranked, ranked
from .resolution import unresolved
from .steadiness import Unsteady, unsteady
from .verdict import Evidence, Verdict, moved_parameters

Told = TypeVar("Told")
OPEN_END = "partial", "unknown"  # verdicts that leave something unexplained
NOT_BY_SINES = (
    "No sine within what was measured parts them by more than twice the noise; measure another quantity, or "
    "excite another input."
)


def decided(
    study: Study,
    start: Refit,
    base: Refit,
    best: Refit,
    rounds: Sequence[Round],
    notes: Sequence[str],
    rivals: Rivals,
) -> Verdict:
    """Return the verdict on the model: nominal as `start`, refitted as `base`, with effects as `best`.

    Each of several effects may have `rivals`.

    Where the time of the study is over, nothing is said of what was not looked for.
    """
    alone = replace(study, executor=None, report=None)
    all_told = not best.effects or study.late() or leaves_noise(best, study)
    changing, unknown = list[Unsteady](), list[str]()
    if not all_told:
        changing, unknown = _told("whether effects change with time", alone, best, unsteady)
    best = certain_part(best, base, rounds, study, changing)
    first, beyond = rounds[0] if rounds else Round(base, [], []), _round_on(best, rounds)
    known, foretold = [best, *_alike(best, rounds, rivals, alone)], Foretold(alone)
    if study.campaign.changed:
        study.tell("predicting the machine after its changes")
    best, alike, apart = told_apart(foretold, known) if not study.late() else (best, known[1:], {})
    evidence = Evidence(alone, start, base, best, tuple(first.candidates), first.failed)
    word = _word(evidence)
    if study.late() and (best.effects or best.misfit > NOISE_MISFIT):
        word = "interrupted"
    closed = closed_by(best, base, study)
    gap = gaps(study, start, base, best)
    others = any(_kinds(other) != _kinds(best) for other in alike)
    further = None
    if word == "effect" and others:
        word, further = "ambiguous", separating(study, best, alike[0]) or NOT_BY_SINES
    open_end = word in OPEN_END
    astray = led_astray(study.campaign, base) if best is not base else ()
    doubts, untold = list[str](), list[str]()
    if not study.late():
        doubts, untold = _told("how well records tell the effects", alone, best, unresolved)
    suspected = suspicions(study, best) if open_end else ()
    return Verdict(
        verdict=word,
        effects=best.effects,
        confidence=tuple(
            _confidence(best, n, rounds, rivals, apart, study.campaign) for n in range(len(best.effects))
        ),
        equivalent=_class(best, first, alike),
        next_experiment=further,
        where=shares(first.candidates),
        windows=located(study, best, (rounds[-1] if rounds else first).candidates) if open_end else {},
        ranking=_ranked(study, first),
        gap=gap,
        closed=closed,
        parameters=best.parameters,
        network=study.campaign.network,
        evidence=evidence,
        notes=(
            *notes,
            *map(str, changing),
            *suspected,
            *_noises(evidence, gap),
            *cautions(study.campaign, best),
            *astray,
            *doubts,
            *dict.fromkeys((*unknown, *untold)),
        ),
        further=_ranked(study, beyond) if best.effects and beyond is not None else (),
        counterfactual=tuple(counterfactuals(foretold, base, best)),
        parted=tuple(
            parting(foretold, best, other, _other(other, best), apart[id(other)])
            for other in known
            if id(other) in apart
        ),
    )


def _told(
    what: str, study: Study, model: Refit, tell: Callable[[Study, Refit], Iterable[Told]]
) -> tuple[list[Told], list[str]]:
    """Return what is told of a model; nothing, and a note, if it cannot be run beside where it is."""
    try:
        return [*tell(study, model)], []
    except SimulationError as error:
        return [], [f"{what} is not known: {error.headline}"]


def closed_by(best: Refit, base: Refit, study: Study) -> float:
    """Return the share that a model closes of what lies between another one and noise, as that looks."""
    underrated = best.misfit > COLOURED_MISFIT and best.is_noise(study.judged)
    noise = best.misfit if underrated else 1.0
    return float(np.clip((base.misfit - best.misfit) / max(base.misfit - noise, 1e-9), 0.0, 1.0))


def leaves_noise(model: Refit, study: Study) -> bool:
    """Tell whether what a model misses is not clearly more than noise, or looks like noise itself."""
    return model.misfit <= COLOURED_MISFIT or model.is_noise(study.judged)


def explains(best: Refit, base: Refit, study: Study) -> bool:
    """Tell whether nothing but noise is left, or what no law is so right that it would not leave it.

    In pieces of records, in which an error grows until they end, that counts by its square.
    """
    share = closed_by(best, base, study) if study.pieces is None else gap_taken(best, base)
    return leaves_noise(best, study) or share >= EXPLAINED_GAP_SHARE


def certain_part(
    best: Refit, base: Refit, rounds: Sequence[Round], study: Study, changing: Sequence[Unsteady] = ()
) -> Refit:
    """Return the model with those effects that are no mere likeness of what is missing.

    They are all, where these explain enough and none is `changing` with time. If something else stays
    missing, they are the first ones, as long as each takes most of what was left and does not change, and all
    of them together take most of the gap.
    """
    if explains(best, base, study) and not changing:
        return best
    named, certain = {*best.labels}, base
    odd = {found.placed.label for found in changing}
    before = [done.base for done in rounds if set() < {*done.base.labels} < named]
    for model in (*before, best):
        if _taken(certain, model) < CERTAIN_RESIDUAL_SHARE or odd & {*model.labels}:
            break
        certain = model
    return certain if gap_taken(certain, base) >= CERTAIN_GAP_SHARE else base


def _taken(before: Refit, after: Refit) -> float:
    """Return the share of the squared residual that another model takes away."""
    return float(1 - after.blocks.sum() / before.blocks.sum())


def _word(evidence: Evidence) -> str:
    refitted, best, study = evidence.refit, evidence.after, evidence.study
    if best.effects:
        return "effect" if explains(best, refitted, study) else "partial"
    if not leaves_noise(refitted, study):
        return "unknown"
    moved = moved_parameters(evidence.campaign, best.parameters)
    return "parameters" if moved or evidence.nominal.misfit > COLOURED_MISFIT * refitted.misfit else "none"


def _round_on(model: Refit, rounds: Sequence[Round]) -> Round | None:
    """Return the round that looked for more than the effects of a model, if one did."""
    return next((done for done in rounds if done.base.labels == model.labels), None)


def _ranked(study: Study, done: Round) -> tuple[Ranked, ...]:
    units = [f.effects[-1].units(study.campaign) for f in done.fitted]
    return ranked(done.fitted, done.base, units)


def _noises(evidence: Evidence, gaps: Mapping[str, Gap]) -> Iterator[str]:
    """Say which noise is larger than it was thought to be, and which rests on what a model leaves."""
    for name, gap in gaps.items():
        floor, left = evidence.campaign.floors[name], gap.after / gap.floor
        if left > COLOURED_MISFIT and leaves_noise(evidence.after, evidence.study):
            told = f"what is left is white noise, but {left:.3g} times that assumed ({floor.source})"
            yield f"{name}: {told}; correct [noise]"
        if floor.passed < inf:
            highest = evidence.campaign.training[0].weights[name].highest
            yield (
                f"{name}: a filter takes away what the model foresees from about {floor.passed:.2g} Hz on; "
                f"model and record are compared up to {highest:.2g} Hz, where it has changed next to nothing"
            )
        if not floor.is_sure:
            yield (
                f"{name}: passed up to {floor.band:.3g} Hz only, where its noise is what a fit leaves, so "
                "that a small effect may pass for noise; state [noise], or measure a run twice (repeat_of)"
            )


def _kinds(model: Refit) -> list[str]:
    return sorted(placed.effect.kind for placed in model.effects)


def _alike(best: Refit, rounds: Sequence[Round], rivals: Rivals, study: Study) -> list[Refit]:
    """Return models with another effect for one of those found that are as good, the likest first."""
    if not best.effects:
        return []
    *earlier, last = best.effects
    models = [f for placed in earlier for f in rivals.get(placed.label, ())]
    for done in rounds:
        if done.base.labels == [placed.label for placed in earlier]:
            models += [f for f in done.fitted if not f.effects[-1].effect.generalises(last.effect.kind)]
    others = [f for f in models if len(f.effects) == len(best.effects) and {*f.labels} != {*best.labels}]
    near = [f for f in others if are_alike(f, best) and not is_told(f, best)]
    alike = [f for f in others if f in near or are_one_delay(study.campaign, f, best)]
    alike += alike_by_all(study, best, [f for f in others if f not in alike])
    return sorted(alike, key=lambda f: abs(clearness(f, best)))


def _other(model: Refit, best: Refit) -> Hypothesis:
    """Return the effect that a model has and another has not."""
    return next(placed for placed in model.effects if placed.label not in best.labels)


def _class(best: Refit, first: Round, alike: Sequence[Refit]) -> tuple[tuple[str, str], ...]:
    """Return kind and site of what cannot be told from an effect: by its fit, or by screening already."""
    labels = best.labels[:1]
    chosen = next((c for c in first.candidates if c.label in labels), None)
    moved = [c.key for c in first.candidates if chosen and c is not chosen and same_motion(c, chosen)]
    own = {placed.key for placed in best.effects}
    return tuple(k for k in dict.fromkeys([*(_other(f, best).key for f in alike), *moved]) if k not in own)


def _confidence(
    best: Refit,
    position: int,
    rounds: Sequence[Round],
    rivals: Rivals,
    apart: Mapping[int, float],
    campaign: Campaign,
) -> float:
    """Return how often an effect is there that is named as clearly before the other fitted ones.

    So often it was on blind sets: mostly where others are alike, as the plainest is named of those, and never
    always, as what is in no list may be like what is.

    Records of a changed machine may tell some models `apart`, by so many standard errors.
    """
    from scipy.stats import norm

    def clear(worse: Refit, better: Refit) -> float:
        told = 0.0 if are_one_delay(campaign, worse, better) else clearness(worse, better)
        return max(told, apart.get(id(worse), 0.0))

    placed = best.effects[position]
    done = rounds[position]
    own = next((f for f in done.fitted if f.effects[-1].label == placed.label), None)
    margins = [
        clear(f, best) for f in rivals.get(placed.label, ()) if not _other(f, best).generalises(placed)
    ]
    if own is not None:
        margins.append(clearness(done.base, own))
        if placed.label not in rivals:
            rest = (f for f in done.fitted if f is not own and not f.effects[-1].generalises(placed))
            margins += [clear(f, own) for f in rest]
    clearer = 2 * float(norm.cdf(max(0.0, min(margins, default=0.0)))) - 1
    return ALIKE_RIGHT_SHARE + (CLEAR_RIGHT_SHARE - ALIKE_RIGHT_SHARE) * clearer
