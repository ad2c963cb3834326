"""What makes the values of a fit doubtful: misfit, priors, noise, told in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..campaign.priors import Prior
from ..records.noise import spectral_floor
from .suspects import FLED, told_of

if TYPE_CHECKING:
    from .outcome import Comparison, Fit

FAR = 2.0  # residual over noise above which a model is not taken for complete
APART = 3.0  # times by which the residual of one record exceeds that of others to be named
LEFT = 3.0  # standard deviations of a prior within which a parameter should stay
MUCH = 0.3  # share of a signal that must be missed before a channel is suspected
INCOMPLETE = "the model lacks something, or a channel is not what it says"
WHITE = 0.8  # share of a residual that is white noise, above which the noise was but stated wrongly


def doubts(fit: Fit) -> Iterator[str]:
    """Yield what one should know before believing the values, the gravest first."""
    if fit.suspects:
        yield told_of(fit.suspects)
    misfits = [line for channel in fit.campaign.outputs for line in _misfit(fit, channel)]
    yield from misfits
    if any(INCOMPLETE in line for line in misfits):
        yield (
            "standard errors are those of scatter; how far an incomplete model moves the parameters, they do "
            "not tell. `inertance diagnose` looks for what is missing"
        )
    for name, value in fit.values.items():
        far = left_prior(name, value, fit.campaign.priors[name], fit.campaign.dae.unit(name))
        if far:
            yield far


def is_doubtful(fit: Fit) -> bool:
    """Tell whether so much is left, or a parameter has moved so far, that a channel may be a wrong one."""
    train = [c for c in fit.comparisons if not c.tested and not c.problem]
    misses = any(
        over_noise(fit, c, name) > FAR and c.rms(name, c.after) > MUCH * c.size(name)
        for c in train
        for name in fit.campaign.outputs
    )
    priors = fit.campaign.priors
    return misses or any(priors[name].moved(value) > FLED for name, value in fit.values.items())


def over_noise(fit: Fit, comparison: Comparison, channel: str) -> float:
    """Return the residual of a record over the noise, as the stage that fitted the channel last saw both.

    NaN where the record could not be predicted.
    """
    if channel not in comparison.after:
        return float("nan")
    record = comparison.experiment.record
    residual = record.values[channel] - comparison.after[channel]
    sigma = fit.campaign.floors[channel].sigma
    filters = [done.stage.filter for done in fit.stages if channel in done.stage.channels]
    last = filters[-1] if filters else None
    if last is not None:
        residual = last.apply(residual, record.rate)
        sigma *= float(np.sqrt(last.share(record.rate)))
    return float(np.sqrt(np.mean(residual**2))) / sigma


def _misfit(fit: Fit, channel: str) -> Iterator[str]:
    ratios = {c: over_noise(fit, c, channel) for c in fit.comparisons}
    known = {c: ratio for c, ratio in ratios.items() if np.isfinite(ratio)}
    train = [ratio for c, ratio in known.items() if not c.tested]
    if not train:
        return
    left = _together(train)
    floor = fit.campaign.floors[channel]
    if left < 1 / FAR:
        yield (
            f"{channel}: the fit leaves {left:.2g} times the noise, {floor.sigma:.3g} {_si(fit, channel)} "
            f"from {_source(floor.source)}; so records count for too little beside priors: correct [noise]"
        )
    elif left > FAR and _is_white(fit, channel):
        yield (
            f"{channel}: what the fit leaves is white noise, but {left:.3g} times the "
            f"{floor.sigma:.3g} {_si(fit, channel)} from {_source(floor.source)}; correct [noise]"
        )
    elif left > FAR:
        yield _incomplete(fit, channel, known, left)
    for comparison, ratio in known.items():
        if comparison.tested and ratio > FAR and ratio > APART * max(left, 1.0):
            yield (
                f"{comparison.experiment.name}: {channel}: this test record is missed by {ratio:.3g} times "
                f"the noise, the training records by {left:.3g} times: what was fitted does not hold there. "
                "Another unit or state of the machine, or a motion that the training records lack"
            )


def _incomplete(fit: Fit, channel: str, known: dict[Comparison, float], left: float) -> str:
    test = [ratio for c, ratio in known.items() if c.tested]
    share = _together([c.rms(channel, c.after) / c.size(channel) for c in known if not c.tested])
    tested = f", {_together(test):.3g} times on the test records" if test else ""
    train = {c: ratio for c, ratio in known.items() if not c.tested}
    worst = max(train, key=lambda c: train[c])
    others = [ratio for c, ratio in train.items() if c is not worst]
    named = ""
    if others and train[worst] > APART * _together(others):
        named = f", most of it in {worst.experiment.name}"
    return (
        f"{channel}: the fit leaves {left:.3g} times the noise, {share:.1%} of the signal{named}{tested}; "
        f"{INCOMPLETE}"
    )


def left_prior(name: str, value: float, prior: Prior, unit: str) -> str:
    """Say that a parameter is far from what was assumed; empty if it is not."""
    moved = prior.moved(value)
    if moved <= LEFT:
        return ""
    return (
        f"{name}: {value:.6g} {unit} is {value / prior.center:.3g} times what was assumed, {moved:.3g} "
        f"standard deviations; either that was known less well than rel = {prior.sd / abs(prior.center):.3g} "
        "says, or a wrong model, unit or record moves it"
    )


def _is_white(fit: Fit, channel: str) -> bool:
    """Tell whether what is left of the training records is white."""
    shares = []
    for c in fit.comparisons:
        if not c.tested and channel in c.after:
            residual = c.experiment.record.values[channel] - c.after[channel]
            shares.append(spectral_floor(residual).sigma / max(float(np.std(residual)), 1e-300))
    return min(shares, default=0.0) > WHITE


def _together(ratios: list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(ratios))))


def _si(fit: Fit, channel: str) -> str:
    return fit.campaign.measured[channel].si


def _source(source: str) -> str:
    return {"stated": "[noise]", "spectrum": "the spectrum"}.get(source, f"the {source}")
