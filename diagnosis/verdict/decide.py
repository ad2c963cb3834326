"""From fitted models to the verdict."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...identification import Accuracy, Campaign
from ..criteria import COLOURED_MISFIT, EXPLAINED_GAP_SHARE
from ..effects.hypothesis import Hypothesis
from ..search.joint_fit import Refit
from ..search.model_comparison import are_alike, blocks, clearness, is_simpler, misfit
from ..search.round import Round, same_motion
from .cautions import cautions, suspicions
from .evidence import Evidence, judged, moved_parameters
from .localisation import located, shares
from .next_experiment import separating
from .verdict import Gap, Ranked, Verdict

NOT_BY_SINES = (
    "No sine within what was measured parts them by more than twice the noise; measure another quantity, or "
    "excite another input."
)


def decided(
    campaign: Campaign,
    accuracy: Accuracy,
    start: Refit,
    base: Refit,
    best: Refit,
    rounds: Sequence[Round],
    notes: list[str],
    interrupted: bool = False,
) -> Verdict:
    """Return the verdict.

    Args:
        campaign: records, channels, priors and model.
        accuracy: solver and tolerances.
        start: the nominal model.
        base: its parameters refitted.
        best: with the effects that were chosen.
        rounds: what was screened and fitted.
        notes: what limits the verdict.
        interrupted: whether the search was stopped before its end.
    """
    gap = _gaps(campaign, start, base, best)
    misfits = [misfit(fitted) for fitted in (start, base, best)]
    closed = _closed(*misfits[1:])
    word = "interrupted" if interrupted else _word(campaign, best, misfits, closed)
    first = rounds[0] if rounds else Round(base, [], [])
    named = {placed.label for placed in best.effects[:1]}
    own = next((f for f in first.fitted if f.effects[-1].label in named), None)
    alike = _alike(first, own, best.effects, campaign) if own is not None else []
    others = {f.effects[-1].effect.kind for f in alike} - {p.effect.kind for p in best.effects}
    further = None
    if word == "effect" and own is not None and others:
        word, further = "ambiguous", separating(campaign, own, alike[0], accuracy) or NOT_BY_SINES
    suspected = suspicions(campaign, best, accuracy) if word == "unknown" else ()
    ranking = [_ranked(f, first.base, campaign) for f in first.fitted]
    confidence = [_confidence(done, p, campaign) for done, p in zip(rounds, best.effects, strict=False)]
    return Verdict(
        verdict=word,
        effects=best.effects,
        confidence=tuple(confidence),
        equivalent=_class(first, own, alike) if own is not None else (),
        next_experiment=further,
        where=shares(first.candidates),
        windows=located(campaign, base, first.candidates, accuracy) if word == "unknown" else {},
        ranking=tuple(sorted(ranking, key=lambda r: -r.test_gain)),
        gap=gap,
        closed=closed,
        parameters=best.parameters,
        network=campaign.network,
        evidence=Evidence(campaign, start, base, best, tuple(first.candidates), accuracy),
        notes=(*notes, *suspected, *cautions(campaign, best)),
    )


def _word(campaign: Campaign, best: Refit, misfits: Sequence[float], closed: float) -> str:
    nominal, refitted, after = misfits
    if best.effects:
        return "effect" if closed >= EXPLAINED_GAP_SHARE or after < COLOURED_MISFIT else "unknown"
    if refitted > COLOURED_MISFIT:
        return "unknown"
    wrong = moved_parameters(campaign, best.parameters) or nominal > COLOURED_MISFIT * refitted
    return "parameters" if wrong else "none"


def _closed(refitted: float, after: float) -> float:
    return float(np.clip((refitted - after) / max(refitted - 1.0, 1e-9), 0.0, 1.0))


def _gaps(campaign: Campaign, start: Refit, base: Refit, best: Refit) -> dict[str, Gap]:
    experiments = campaign.testing or campaign.training
    gaps = {}
    for name in campaign.outputs:
        measured = np.concatenate([e.record.values[name] for e in experiments])
        size = float(np.sqrt(np.mean(measured**2))) or 1.0
        sigma = campaign.floors[name].sigma
        nominal, refitted, after = (
            sigma * float(np.sqrt(np.mean(np.concatenate([r[name] for r in f.test or f.train]) ** 2))) / size
            for f in (start, base, best)
        )
        unit = f"{campaign.measured[name].si}, NRMSE of the {judged(campaign)}"
        gaps[name] = Gap(nominal, refitted, after, sigma / size, unit)
    return gaps


def _alike(first: Round, own: Refit, effects: Sequence[Hypothesis], campaign: Campaign) -> list[Refit]:
    """Return the fitted effects that the data cannot tell from the first of those found, the likest first."""
    chosen, alike = own.effects[-1], []
    found = {placed.label for placed in effects}
    for other in first.fitted:
        placed = other.effects[-1]
        if placed.label in found or placed.effect.generalises(chosen.effect.kind):
            continue
        if are_alike(other, own, campaign):
            alike.append(other)
    return sorted(alike, key=lambda other: abs(clearness(other, own, campaign)))


def _class(first: Round, own: Refit, alike: Sequence[Refit]) -> tuple[tuple[str, str], ...]:
    """Return kind and site of what cannot be told from an effect: by its fit, or by screening already."""
    chosen = next(c for c in first.candidates if c.label == own.effects[-1].label)
    moved = [c for c in first.candidates if c is not chosen and same_motion(c, chosen)]
    fitted = [(f.effects[-1].effect.kind, f.effects[-1].site.path) for f in alike]
    return tuple(dict.fromkeys([*fitted, *((c.effect.kind, c.site.path) for c in moved)]))


def _ranked(fitted: Refit, base: Refit, campaign: Campaign) -> Ranked:
    from scipy.stats import norm

    placed = fitted.effects[-1]
    before, after = blocks(base, campaign).sum(), blocks(fitted, campaign).sum()
    p = float(norm.sf(clearness(base, fitted, campaign)))
    return Ranked(placed.effect.kind, placed.site.path, float((before - after) / before), p, placed.values)


def _confidence(done: Round, placed: Hypothesis, campaign: Campaign) -> float:
    """Return the chance that no other fitted effect is better on further data, a half of what is alike."""
    from scipy.stats import norm

    own = next((f for f in done.fitted if f.effects[-1].label == placed.label), None)
    if own is None:
        return 0.5
    others = [f for f in done.fitted if f is not own and not is_simpler(own, f)]
    margins = [clearness(f, own, campaign) for f in (done.base, *others)]
    return float(norm.cdf(max(0.0, min(margins))))
