"""`diagnose`: find what parts the records of a campaign and its model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from copy import copy
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..components import InertanceError
from ..identification import Accuracy, Campaign, Experiment, Filter
from ..networks import ToolchainError, compiler
from .evidence import Evidence
from .placed import Placed
from .refit import Joint, Refit, refit
from .screening import Candidate, screen
from .separating import separating
from .verdict import Gap, Ranked, Verdict
from .where import located, shares

Array = NDArray[np.float64]
Report = Callable[[str], None]

CONTENDERS = 8  # effects fitted in each round
BATCH = 3  # fitted before those are left out that promise much less than was found
HOPELESS = 0.4  # share of the best drop of chi squared below which a promise is much less
MOST_EFFECTS = 2
LEAST_GAIN = 40.0  # drop of chi squared below which no effect is worth a fit
ENOUGH = 250.0  # Hz, at which outputs are compared
BLOCK = 1.0  # s, stretches by which test residuals are compared
CLEAR = 3.0  # standard errors by which an effect must beat the model without it
ALIKE = 2.0  # standard errors within which two effects cannot be told apart
LEAST_DROP = 0.01  # share of the squared test residual that an effect must take away
EXPLAINED = 0.5  # share of the gap below which the effect found is not what is missing
NOISE = 1.03  # misfit over noise at which there is nothing left to find
COLOURED = 1.1  # misfit over noise above which something is left
GENERALISES = {
    "stribeck_friction": ("coulomb_friction",),
    "asymmetric_friction": ("coulomb_friction",),
    "friction_drift": ("coulomb_friction",),
    "bilinear_stiffness": ("linear_stiffness",),
}


@dataclass(frozen=True, eq=False)
class Round:
    """One round of the search: the model so far, the candidates and what fitting them gave."""

    base: Refit
    candidates: list[Candidate]
    fitted: list[Refit]


def diagnose(
    campaign: Campaign,
    *,
    executor: Executor | None = None,
    solver: str = "auto",
    rtol: float = 1e-5,
    report: Report | None = None,
) -> Verdict:
    """Say what parts measured data and model: where, why, and how much of it goes away.

    The parameters are refitted; every effect at every site is screened by a one-sided score test; the
    leading ones are fitted together with the parameters and ranked by the test records, which are never
    fitted; what cannot be told apart forms a class.

    Args:
        campaign: records, channels, priors and model.
        executor: fits candidates; any `concurrent.futures.Executor`.
        solver: as for `DAE.simulate`; "auto" compiles models where there is a C compiler.
        rtol: relative tolerance of the runs.
        report: called with a line of progress.

    Returns:
        The verdict; after Ctrl-C, that of what was done until then, which says so.
    """
    tell = report or (lambda line: None)
    campaign = _thinned(campaign)
    accuracy = Accuracy(_fastest() if solver == "auto" else solver, rtol, 1e-2 * rtol)
    tell("refitting the parameters")
    nominal = Joint(campaign, campaign.network, campaign.start, (), accuracy)
    start = nominal.seen(nominal.start)
    base = nominal.fitted()
    rounds: list[Round] = []
    notes: list[str] = []
    best = base
    try:
        while len(best.effects) < MOST_EFFECTS and _misfit(best, campaign) > NOISE:
            done = _round(campaign, best, accuracy, executor, tell)
            rounds.append(done)
            chosen = _chosen(done, campaign)
            if chosen is None:
                break
            best = _pruned(chosen, campaign, accuracy)
    except KeyboardInterrupt:
        notes.append("interrupted; this is what was known until then")
        tell(notes[-1])
    return _verdict(campaign, accuracy, start, base, best, rounds, notes)


def _fastest() -> str:
    """Return the solver for thousands of runs: the compiled one, if there is a compiler."""
    try:
        compiler()
    except ToolchainError:
        return "auto"
    return "compiled"


def _thinned(campaign: Campaign) -> Campaign:
    """Return a campaign whose outputs are compared as often as machines need, and no more often.

    Inputs lose what is too fast to be compared: there it is noise, and their second derivatives feel it.
    """
    thin = copy(campaign)
    driven = [name for name, channel in campaign.measured.items() if channel.driven]
    for name in ("training", "testing"):
        setattr(thin, name, [_slowed(experiment, driven) for experiment in getattr(campaign, name)])
    return thin


def _slowed(experiment: Experiment, driven: Sequence[str]) -> Experiment:
    record = experiment.record
    every = max(1, int(record.rate / ENOUGH))
    if every > 1:
        smooth = Filter(cutoff=0.5 * record.rate / every)
        slow = {name: smooth.apply(record.values[name], record.rate) for name in driven}
        record = replace(record, values={**record.values, **slow})
    return replace(experiment, record=record, every=every)


def _round(
    campaign: Campaign, base: Refit, accuracy: Accuracy, executor: Executor | None, tell: Report
) -> Round:
    told = " on top of what was found" if base.effects else ""
    tell(f"screening effects{told}")
    candidates = screen(campaign, campaign.network, base.parameters, base.effects, accuracy)
    waiting = _leading(candidates)
    count, fitted = len(waiting), list[Refit]()
    while waiting:
        batch, waiting = waiting[:BATCH], waiting[BATCH:]
        jobs = [(campaign, base, candidate, accuracy) for candidate in batch]
        results = executor.map(_fit, jobs) if executor is not None else map(_fit, jobs)
        for candidate, found in zip(batch, results, strict=True):
            tell(f"fitted {candidate.label}, at most {count - 1} to go")
            count -= 1
            if found is not None:
                fitted.append(found)
        waiting = _promising(waiting, base, fitted)
        count = len(waiting)
    return Round(base, candidates, fitted)


def _promising(waiting: Sequence[Candidate], base: Refit, fitted: Sequence[Refit]) -> list[Candidate]:
    """Return those that may still be best; of effects in series screening says too little."""
    best = max((base.cost - found.cost for found in fitted), default=0.0)
    return [c for c in waiting if c.effect.place == "series" or c.gain > HOPELESS * best]


def _fit(job: tuple[Campaign, Refit, Candidate, Accuracy]) -> Refit | None:
    campaign, base, candidate, accuracy = job
    name = f"{candidate.effect.kind}_{len(base.effects) + 1}"
    placed = Placed(candidate.effect, candidate.site, name, candidate.values)
    try:
        return refit(campaign, campaign.network, base.parameters, [*base.effects, placed], accuracy)
    except InertanceError:
        return None


def _leading(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Return the candidates worth a fit, one of those that are one effect on one motion."""
    chosen: list[Candidate] = []
    for candidate in candidates:
        if candidate.gain < LEAST_GAIN or len(chosen) >= CONTENDERS:
            break
        if not any(same_motion(candidate, other) for other in chosen):
            chosen.append(candidate)
    return chosen


def same_motion(one: Candidate, other: Candidate) -> bool:
    """Tell whether two candidates are one effect seen from two sites of one motion."""
    return one.effect.kind == other.effect.kind and abs(one.gain - other.gain) <= 1e-6 * other.gain


def blocks(fitted: Refit, campaign: Campaign) -> Array:
    """Return the squared test residual by stretches of a second."""
    sums = []
    experiments = campaign.testing or campaign.training
    for residuals, experiment in zip(fitted.test or fitted.train, experiments, strict=True):
        time = experiment.record.time
        count = max(2, round(float(time[-1] - time[0]) / BLOCK))
        squares = np.sum([r**2 for r in residuals.values()], axis=0)
        sums += [float(part.sum()) for part in np.array_split(squares, count)]
    return np.array(sums)


def clearness(worse: Refit, better: Refit, campaign: Campaign) -> float:
    """Return by how many standard errors a model's test residual is below another's, in logarithms."""
    drop = np.log(blocks(worse, campaign) / blocks(better, campaign))
    spread = float(drop.std(ddof=1) / np.sqrt(len(drop)))
    return float(drop.mean()) / spread if spread > 0 else 0.0


def _chosen(done: Round, campaign: Campaign) -> Refit | None:
    """Return the best model of a round, the simplest of equals, if it is clearly better than the first."""
    if not done.fitted:
        return None
    before = blocks(done.base, campaign).sum()
    best = min(done.fitted, key=lambda f: blocks(f, campaign).sum())
    for other in done.fitted:
        if _is_simpler(other, best) and clearness(other, best, campaign) < CLEAR:
            best = other
    drop = (before - blocks(best, campaign).sum()) / before
    clear = clearness(done.base, best, campaign) > CLEAR and drop > LEAST_DROP
    return best if clear else None


def _is_simpler(one: Refit, other: Refit) -> bool:
    kind, site = one.effects[-1].effect.kind, one.effects[-1].site.path
    richer = other.effects[-1]
    return kind in GENERALISES.get(richer.effect.kind, ()) and site == richer.site.path


def _pruned(best: Refit, campaign: Campaign, accuracy: Accuracy) -> Refit:
    """Return the model without those effects that a later one has made needless."""
    for placed in best.effects[:-1]:
        others = [p for p in best.effects if p is not placed]
        try:
            less = refit(campaign, campaign.network, best.parameters, others, accuracy)
        except InertanceError:
            continue
        if clearness(less, best, campaign) < CLEAR:
            best = less
    return best


def _verdict(
    campaign: Campaign,
    accuracy: Accuracy,
    start: Refit,
    base: Refit,
    best: Refit,
    rounds: Sequence[Round],
    notes: list[str],
) -> Verdict:
    gap = _gaps(campaign, start, base, best)
    misfits = [_misfit(fitted, campaign) for fitted in (start, base, best)]
    closed = _closed(*misfits[1:])
    word = _word(campaign, best, misfits, closed)
    first = rounds[0] if rounds else Round(base, [], [])
    named = {placed.label for placed in best.effects[:1]}
    own = next((f for f in first.fitted if f.effects[-1].label in named), None)
    alike = _alike(first, own, campaign) if own is not None else []
    if word == "effect" and {f.effects[-1].effect.kind for f in alike} - {
        p.effect.kind for p in best.effects
    }:
        word = "ambiguous"
    ranking = [_ranked(f, first.base, campaign) for f in first.fitted]
    confidence = [_confidence(done, p, campaign) for done, p in zip(rounds, best.effects, strict=False)]
    return Verdict(
        verdict=word,
        effects=best.effects if word in ("effect", "ambiguous") else (),
        confidence=tuple(confidence) if word in ("effect", "ambiguous") else (),
        equivalent=tuple((f.effects[-1].effect.kind, f.effects[-1].site.path) for f in alike),
        next_experiment=separating(campaign, own, alike[0], accuracy)
        if own and word == "ambiguous"
        else None,
        where=shares(first.candidates),
        windows=located(campaign, base, first.candidates) if word == "unknown" else {},
        ranking=tuple(sorted(ranking, key=lambda r: -r.test_gain)),
        gap=gap,
        closed=closed,
        parameters=best.parameters,
        network=campaign.network,
        evidence=Evidence(campaign, start, base, best, tuple(first.candidates)),
        notes=tuple(notes),
    )


def _word(campaign: Campaign, best: Refit, misfits: Sequence[float], closed: float) -> str:
    nominal, refitted, after = misfits
    if best.effects:
        return "effect" if closed >= EXPLAINED or after < COLOURED else "unknown"
    if refitted > COLOURED:
        return "unknown"
    moved = any(
        abs(value - campaign.priors[name].center) > 3 * campaign.priors[name].sd
        for name, value in best.parameters.items()
    )
    return "parameters" if moved or nominal > COLOURED * refitted else "none"


def _misfit(fitted: Refit, campaign: Campaign) -> float:
    """Return the root mean square of the test residual, in units of noise."""
    parts = [r for record in fitted.test or fitted.train for r in record.values()]
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


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
        unit = f"{campaign.measured[name].si}, NRMSE of the test runs"
        gaps[name] = Gap(nominal, refitted, after, sigma / size, unit)
    return gaps


def _alike(first: Round, own: Refit, campaign: Campaign) -> list[Refit]:
    """Return the fitted effects that the data cannot tell from one, the likest first."""
    chosen, apart = own.effects[-1], []
    for other in first.fitted:
        placed = other.effects[-1]
        if placed.label == chosen.label or chosen.effect.kind in GENERALISES.get(placed.effect.kind, ()):
            continue
        apart.append((abs(clearness(other, own, campaign)), other))
    return [other for distance, other in sorted(apart, key=lambda pair: pair[0]) if distance < ALIKE]


def _ranked(fitted: Refit, base: Refit, campaign: Campaign) -> Ranked:
    from scipy.stats import norm

    placed = fitted.effects[-1]
    before, after = blocks(base, campaign).sum(), blocks(fitted, campaign).sum()
    p = float(norm.sf(clearness(base, fitted, campaign)))
    return Ranked(placed.effect.kind, placed.site.path, float((before - after) / before), p, placed.values)


def _confidence(done: Round, placed: Placed, campaign: Campaign) -> float:
    """Return the chance that no other fitted effect is better on further data."""
    from scipy.stats import norm

    own = next((f for f in done.fitted if f.effects[-1].label == placed.label), None)
    if own is None:
        return 0.5
    others = [f for f in done.fitted if f is not own and not _is_simpler(own, f)]
    margins = [clearness(f, own, campaign) for f in (done.base, *others)]
    return float(norm.cdf(min(margins)))
