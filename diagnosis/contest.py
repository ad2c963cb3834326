"""A round of the search: effects screened, and the leading ones fitted."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import lru_cache

from ..components import InertanceError
from ..identification import Accuracy, Campaign
from .placed import Placed
from .refit import Refit, refit
from .screening import Candidate, screen
from .thinning import thinned

Report = Callable[[str], None]

CONTENDERS = 8  # effects fitted in each round
BATCH = 3  # fitted before those are left out that promise much less than was found
HOPELESS = 0.4  # share of the best drop of chi squared below which a promise is much less
SIZES = (0.3, 1.0, 3.0)  # of an effect in series, of which small ones tell little, to start from
LEAST_GAIN = 40.0  # drop of chi squared below which no effect is worth a fit


@dataclass(frozen=True, eq=False)
class Round:
    """One round of the search: the model so far, the candidates and what fitting them gave."""

    base: Refit
    candidates: list[Candidate]
    fitted: list[Refit]


def held(
    campaign: Campaign, base: Refit, accuracy: Accuracy, executor: Executor | None, tell: Report
) -> Round:
    """Screen all effects on top of a model and fit the leading ones."""
    told = " on top of what was found" if base.effects else ""
    tell(f"screening effects{told}")
    candidates = screen(campaign, campaign.network, base.parameters, base.effects, accuracy)
    waiting = _leading(candidates, {placed.effect.kind for placed in base.effects})
    fitted = list[Refit]()
    payload = campaign.pickled() if executor is not None else b""
    while waiting:
        batch, waiting = waiting[:BATCH], waiting[BATCH:]
        if executor is None:
            results = (_fit(campaign, base, candidate, accuracy) for candidate in batch)
        else:
            jobs = [executor.submit(_job, payload, base, candidate, accuracy) for candidate in batch]
            results = (job.result() for job in jobs)
        for left, candidate, found in zip(reversed(range(len(batch))), batch, results, strict=True):
            tell(f"fitted {candidate.label}, at most {left + len(waiting)} to go")
            if found is not None:
                fitted.append(found)
        waiting = _promising(waiting, base, fitted)
    return Round(base, candidates, fitted)


def _promising(waiting: Sequence[Candidate], base: Refit, fitted: Sequence[Refit]) -> list[Candidate]:
    """Return those that may still be best; of effects in series screening says too little."""
    best = max((base.cost - found.cost for found in fitted), default=0.0)
    return [c for c in waiting if c.effect.place == "series" or c.gain > HOPELESS * best]


def _fit(campaign: Campaign, base: Refit, candidate: Candidate, accuracy: Accuracy) -> Refit | None:
    name = f"{candidate.effect.kind}_{len(base.effects) + 1}"
    placed = Placed(candidate.effect, candidate.site, name, candidate.values)
    sizes = SIZES if candidate.effect.place == "series" else (1.0,)
    try:
        return refit(campaign, campaign.network, base.parameters, [*base.effects, placed], accuracy, sizes)
    except InertanceError:
        return None


def _job(payload: bytes, base: Refit, candidate: Candidate, accuracy: Accuracy) -> Refit | None:
    return _fit(_received(payload), base, candidate, accuracy)


@lru_cache(maxsize=1)
def _received(payload: bytes) -> Campaign:
    """Return a campaign in the process that it was sent to, with what is compared there again."""
    return thinned(pickle.loads(payload))


def _leading(candidates: Sequence[Candidate], found: Collection[str]) -> list[Candidate]:
    """Return the candidates worth a fit, one for each motion and kind, whose site is the same for all kinds.

    A kind that was found is not looked for again: it would but mend the shape of the first.
    """
    chosen: list[Candidate] = []
    for candidate in candidates:
        if candidate.gain < LEAST_GAIN or len(chosen) >= CONTENDERS:
            break
        if candidate.effect.kind in found:
            continue
        alike = next((n for n, other in enumerate(chosen) if same_motion(candidate, other)), None)
        if alike is None:
            chosen.append(candidate)
        else:
            chosen[alike] = max(chosen[alike], candidate, key=lambda c: (c.site.rank, c.site.path))
    return chosen


def same_motion(one: Candidate, other: Candidate) -> bool:
    """Tell whether two candidates are one effect seen from two sites of one motion."""
    return one.effect.kind == other.effect.kind and abs(one.gain - other.gain) <= 1e-6 * other.gain
