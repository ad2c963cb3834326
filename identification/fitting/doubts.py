"""What makes the values of a fit doubtful: misfit, priors, noise, told in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from ..campaign.priors import Prior
from ..records.noise import spectral_floor
from .outcome import Comparison, Fit
from .suspects import FLED_DEVIATIONS, told_of

INCOMPLETE_RATIO = 2.0  # residual over noise above which a model is not taken for complete
OUTLIER_RATIO = 3.0  # times by which the residual of one record exceeds that of others to be named
PRIOR_DEVIATIONS = 3.0  # of a prior within which a parameter should stay
MISSED_SHARE = 0.3  # share of a signal that must be missed before a channel is suspected
WHITE_SHARE = 0.8  # share of a residual that is white noise, above which the noise was but stated wrongly
INCOMPLETE = "the model lacks something, or a channel is not what it says"
SOURCES = {"stated": "[noise]", "spectrum": "the spectrum", "quietest instants": "the quietest instants"}


def warnings(fit: Fit) -> Iterator[str]:
    """Yield what one should know before using the values, the gravest first."""
    if fit.interrupted:
        yield "the fit was interrupted before its end; these are the best values until then"
    yield from told_of(fit.suspects)
    misfits = [line for channel in fit.campaign.outputs for line in _misfit(fit, channel)]
    yield from misfits
    if any(INCOMPLETE in line for line in misfits):
        yield (
            "standard errors are those of scatter; how far an incomplete model moves the parameters, they do "
            "not tell. `inertance diagnose` looks for what is missing"
        )
    for name, value in fit.values.items():
        yield from left_prior(name, value, fit.campaign.priors[name], fit.campaign.dae.unit(name))
    for c in fit.comparisons:
        for name, value in c.own.items():
            prior, unit = fit.campaign.per_record[name], fit.campaign.dae.unit(name)
            yield from left_prior(f"{name} of {c.experiment.name}", value, prior, unit)
    yield from _failures(fit)


def _failures(fit: Fit) -> Iterator[str]:
    """Yield what a fit did not get done, and what its stages say of their values."""
    for done in fit.stages:
        yield from done.uncertainty.warnings
    for name, interval in fit.intervals.items():
        yield from interval.told(name)
    for number, done in enumerate(fit.stages, start=1):
        if done.optimum.ended == "interrupted":
            yield f"stage {number} was interrupted; the best values until then are kept"
        elif done.optimum.ended != "converged":
            yield f"stage {number} did not converge ({done.optimum.ended})"
    yield from (f"{c.experiment.name}: {c.problem}" for c in fit.comparisons if c.problem)
    failed = [start.problem for start in fit.starts if start.problem]
    if failed:
        yield f"{len(failed)} of {len(fit.starts)} starts failed, the first with: {failed[0]}"


def is_doubtful(fit: Fit) -> bool:
    """Tell whether so much is left, or a parameter has moved so far, that a channel may be a wrong one."""
    priors = fit.campaign.priors
    return any(priors[name].moved(value) > FLED_DEVIATIONS for name, value in fit.values.items()) or any(
        over_noise(fit, c, name) > INCOMPLETE_RATIO and c.rms(name, c.after) > MISSED_SHARE * c.size(name)
        for c in fit.comparisons
        for name in fit.campaign.outputs
        if not c.tested and not c.problem
    )


def over_noise(fit: Fit, comparison: Comparison, channel: str) -> float:
    """Return the residual of a record over the noise, as the stage that fitted the channel last saw both.

    NaN where the record could not be predicted.
    """
    if channel not in comparison.after:
        return float("nan")
    residual = comparison.residual(channel, comparison.after)
    sigma = fit.campaign.floors[channel].sigma
    filters = [done.stage.filter for done in fit.stages if channel in done.stage.channels]
    if filters and filters[-1] is not None:
        rate = comparison.experiment.record.rate
        residual = filters[-1].apply(residual, rate)
        sigma *= float(np.sqrt(filters[-1].share(rate)))
    return float(np.sqrt(np.mean(residual**2))) / sigma


def _misfit(fit: Fit, channel: str) -> Iterator[str]:
    ratios = {c: over_noise(fit, c, channel) for c in fit.comparisons}
    train, test = (
        {c: ratio for c, ratio in ratios.items() if c.kind in kinds and np.isfinite(ratio)}
        for kinds in (("train",), ("test",))
    )
    if not train:
        return
    left = _rms(train.values())
    floor, si = fit.campaign.floors[channel], fit.campaign.measured[channel].si
    noise = f"{floor.sigma:.3g} {si} from {SOURCES.get(floor.source, f'the {floor.source}')}"
    if left < 1 / INCOMPLETE_RATIO:
        yield (
            f"{channel}: the fit leaves {left:.2g} times the noise, {noise}; so records count for too little "
            "beside priors: correct [noise]"
        )
    elif left > INCOMPLETE_RATIO and _is_white(train, channel):
        yield (
            f"{channel}: what the fit leaves is white noise, but {left:.3g} times the {noise}; "
            "correct [noise]"
        )
    elif left > INCOMPLETE_RATIO:
        yield _incomplete(channel, train, test)
    for comparison, ratio in ratios.items():
        change = comparison.experiment.change
        if change is not None and ratio > INCOMPLETE_RATIO * max(left, 1.0):
            told = change.told(fit.campaign.dae)
            yield (
                f"{comparison.experiment.name}: {channel}: after a change ({told}) it is missed by "
                f"{ratio:.3g} times the noise, the training records by {left:.3g} times: the model fits them "
                "for another reason than the right one, or the change is not what it says"
            )
    for comparison, ratio in test.items():
        if ratio > INCOMPLETE_RATIO and ratio > OUTLIER_RATIO * max(left, 1.0):
            yield (
                f"{comparison.experiment.name}: {channel}: this test record is missed by {ratio:.3g} times "
                f"the noise, the training records by {left:.3g} times: what was fitted does not hold there. "
                "Another unit or state of the machine, or a motion that the training records lack"
            )


def _incomplete(channel: str, train: dict[Comparison, float], test: dict[Comparison, float]) -> str:
    share = _rms(c.rms(channel, c.after) for c in train) / _rms(c.size(channel) for c in train)
    tested = f", {_rms(test.values()):.3g} times on the test records" if test else ""
    worst = max(train, key=lambda c: train[c])
    others = [ratio for c, ratio in train.items() if c is not worst]
    outlies = others and train[worst] > OUTLIER_RATIO * _rms(others)
    named = f", most of it in {worst.experiment.name}" if outlies else ""
    return (
        f"{channel}: the fit leaves {_rms(train.values()):.3g} times the noise, {share:.1%} of the signal"
        f"{named}{tested}; {INCOMPLETE}"
    )


def left_prior(name: str, value: float, prior: Prior, unit: str) -> Iterator[str]:
    """Say that a parameter is far from what was assumed, if it is."""
    moved = prior.moved(value)
    if moved > PRIOR_DEVIATIONS:
        yield (
            f"{name}: {value:.6g} {unit} is {value / prior.center:.3g} times what was assumed, {moved:.3g} "
            "standard deviations; either that was known less well than rel = "
            f"{prior.sd / abs(prior.center):.3g} says, or a wrong model, unit or record moves it"
        )


def _is_white(comparisons: Iterable[Comparison], channel: str) -> bool:
    residuals = [c.residual(channel, c.after) for c in comparisons]
    shares = [spectral_floor(r).sigma / max(float(np.std(r)), 1e-300) for r in residuals]
    return min(shares, default=0.0) > WHITE_SHARE


def _rms(values: Iterable[float]) -> float:
    return float(np.sqrt(np.mean(np.square([*values]))))
