"""A round of the search: effects screened, and the leading ones fitted."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import lru_cache

from ...components import InertanceError
from ...identification import Accuracy, Campaign
from ..criteria import (
    COLOURED_MISFIT,
    CONTENDERS_PER_ROUND,
    FITS_PER_BATCH,
    HIDDEN_RESIDUAL_SHARE,
    HOPELESS_GAIN_RATIO,
    LEAST_CHI_SQUARED_GAIN,
    RESERVES_PER_ROUND,
    SAME_MOTION_GAIN_TOLERANCE,
    SERIES_START_SIZES,
)
from ..effects.hypothesis import Hypothesis
from .decimation import thinned
from .joint_fit import Refit, Start, refit
from .model_comparison import misfit, unexplained
from .score_test import Candidate, screen

Report = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Round:
    """One round of the search: the model so far, the candidates and what fitting them gave."""

    base: Refit
    candidates: list[Candidate]
    fitted: list[Refit]


def run_round(
    campaign: Campaign,
    base: Refit,
    accuracy: Accuracy,
    executor: Executor | None,
    tell: Report,
    rounds: list[Round],
) -> Round:
    """Screen all effects on top of a model and fit the leading ones; what is known stands in `rounds`."""
    told = " on top of what was found" if base.effects else ""
    tell(f"screening effects{told}")
    candidates = screen(campaign, campaign.network, base.parameters, base.effects, accuracy)
    waiting = _leading(candidates, {placed.effect.kind for placed in base.effects})
    tried, fitted, kept = list[Candidate](), list[Refit](), 0.0
    payload = campaign.pickled() if executor is not None else b""
    rounds.append(Round(base, list(candidates), fitted))
    early: list[Candidate] | None = [] if base.effects else None
    while waiting:
        batch, waiting = _next(waiting)
        tried += batch
        if executor is None:
            results = (_fit(campaign, base, candidate, fitted, accuracy) for candidate in batch)
        else:
            jobs = [executor.submit(_job, payload, base, candidate, fitted, accuracy) for candidate in batch]
            results = (job.result() for job in jobs)
        for left, candidate, found in zip(reversed(range(len(batch))), batch, results, strict=True):
            tell(f"fitted {candidate.label}, at most {left + len(waiting)} to go")
            if found is not None:
                fitted.append(found)
                kept = max(kept, min(candidate.gain, base.cost - found.cost))
        waiting = _promising(waiting, kept)
        if not waiting and early is None and _much_is_left((base, *fitted), base):
            tell("much is left: screening where the parameters were given")
            early = screen(campaign, campaign.network, campaign.start, (), accuracy)
            waiting = _reserve(candidates, early, tried)
    screened = {c.label for c in candidates}
    rounds[-1].candidates.extend(c for c in early or () if c.label not in screened)
    return rounds[-1]


def _much_is_left(models: Sequence[Refit], base: Refit) -> bool:
    best = min(models, key=misfit)
    return misfit(best) > COLOURED_MISFIT and unexplained(best, base) > HIDDEN_RESIDUAL_SHARE


def _promising(waiting: Sequence[Candidate], kept: float) -> list[Candidate]:
    """Return those that may be best, by the best promise that was kept, and their special cases.

    Screening underrates what is in series.
    """
    good = [c for c in waiting if c.effect.place == "series" or c.gain > HOPELESS_GAIN_RATIO * kept]
    return [c for c in waiting if c in good or any(_starts_from(other, c) for other in good)]


def _next(waiting: list[Candidate]) -> tuple[list[Candidate], list[Candidate]]:
    """Return the candidates to be fitted next, none of which starts from what another one will give."""
    for number, candidate in enumerate(waiting[:FITS_PER_BATCH]):
        if any(_starts_from(candidate, other) for other in waiting[:number]):
            return waiting[:number], waiting[number:]
    return waiting[:FITS_PER_BATCH], waiting[FITS_PER_BATCH:]


def _starts_from(candidate: Candidate, plain: Candidate | Hypothesis) -> bool:
    return candidate.effect.generalises(plain.effect.kind) and candidate.site.path == plain.site.path


def _fit(
    campaign: Campaign, base: Refit, candidate: Candidate, fitted: Sequence[Refit], accuracy: Accuracy
) -> Refit | None:
    name = f"{candidate.effect.kind}_{len(base.effects) + 1}"
    placed = Hypothesis(candidate.effect, candidate.site, name, candidate.values)
    starts = _starts(candidate, fitted)
    try:
        found = refit(campaign, campaign.network, base.parameters, [*base.effects, placed], accuracy, starts)
    except InertanceError:
        return None
    return found if candidate.effect.credible(found.effects[-1].values) else None


def _starts(candidate: Candidate, fitted: Sequence[Refit]) -> list[Start]:
    """Return parameters and values to fit a candidate from: as screened, or as its special case."""
    if candidate.effect.place == "series":
        return [
            (candidate.parameters, {k: size * v for k, v in candidate.values.items()})
            for size in SERIES_START_SIZES
        ]
    starts: list[Start] = [(candidate.parameters, candidate.values)]
    effect, site = candidate.effect, candidate.site
    for plain in fitted:
        last = plain.effects[-1]
        if effect.plain and _starts_from(candidate, last):
            size = next(iter(last.values.values()))
            values = dict(zip([q.name for q in effect.sizes(site.domain)], effect.plain[1], strict=True))
            sized = {name: value * size for name, value in values.items()}
            starts += [(plain.parameters, sized | shape) for shape in effect.shaped(site.domain, site)]
    return starts


def _job(
    payload: bytes, base: Refit, candidate: Candidate, fitted: Sequence[Refit], accuracy: Accuracy
) -> Refit | None:
    return _fit(_received(payload), base, candidate, fitted, accuracy)


@lru_cache(maxsize=1)
def _received(payload: bytes) -> Campaign:
    """Return a campaign in the process that it was sent to, with what is compared there again."""
    return thinned(pickle.loads(payload))


def _leading(candidates: Sequence[Candidate], found: Collection[str]) -> list[Candidate]:
    """Return the candidates worth a fit, one for each motion and kind, whose site is the same for all kinds.

    A kind that was found is not looked for again: it would but mend the shape of the first. Special cases go
    before what generalises them.
    """
    chosen: list[Candidate] = []
    for candidate in candidates:
        if candidate.gain < LEAST_CHI_SQUARED_GAIN or len(chosen) >= CONTENDERS_PER_ROUND:
            break
        if candidate.effect.kind in found:
            continue
        alike = next((n for n, other in enumerate(chosen) if same_motion(candidate, other)), None)
        if alike is None:
            chosen.append(candidate)
        else:
            chosen[alike] = _named(chosen[alike], candidate)
    special = [c for c in candidates if c.effect.kind not in found]
    ordered = [one for c in chosen for one in (*(p for p in special if _starts_from(c, p)), c)]
    return list(dict.fromkeys(ordered))


def _named(one: Candidate, other: Candidate) -> Candidate:
    """Return of two that are one motion the whole rather than its part, or whose name says most."""
    if one.site.holds(other.site):
        return one
    if other.site.holds(one.site):
        return other
    return max(one, other, key=lambda c: (c.site.rank, c.site.path))


def _reserve(
    candidates: Sequence[Candidate], early: Sequence[Candidate], tried: Sequence[Candidate]
) -> list[Candidate]:
    """Return what may have been overlooked: effects in series, and those that a large one hid.

    Parameters that were fitted without a large effect go far off, and there it looks like another: what was
    screened `early`, where they were given, is fitted from there.
    """
    series = [c for c in candidates if c.effect.place == "series" and c.gain > LEAST_CHI_SQUARED_GAIN]
    series = [c for c in series if not any(c is other or same_motion(c, other) for other in tried)]
    labels = {c.label for c in tried}
    hidden = [c for c in _leading(early, ()) if c.label not in labels]
    return [*series[:RESERVES_PER_ROUND], *hidden[:RESERVES_PER_ROUND]]


def same_motion(one: Candidate, other: Candidate) -> bool:
    """Tell whether two candidates are one effect seen from two sites of one motion; channels have none."""
    moved = "channel" not in one.site.places and other.gain > 0
    close = abs(one.gain - other.gain) <= SAME_MOTION_GAIN_TOLERANCE * other.gain
    return moved and one.effect.kind == other.effect.kind and close
