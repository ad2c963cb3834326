"""Cautions: what one should know before believing the figures of a verdict."""

from __future__ import annotations

from collections.abc import Iterator
from math import isclose

import numpy as np

from ...identification import Campaign, Prior, left_prior, likely_unit, suspects, told_of
from ...networks import DAE
from ..criteria import (
    BOUND_SCALE_TOLERANCE,
    BOUND_TOLERANCE,
    COLOURED_MISFIT,
    LOST_MISFIT,
    MOVED_STANDARD_DEVIATIONS,
    SUSPECT_SIGNAL_SHARE,
    UNIT_GAIN_TOLERANCE,
)
from ..effects.hypothesis import Hypothesis, told
from ..effects.plausibility import doubtful
from ..models.study import Study, at_ends
from ..search.model_comparison import Refit, rms


def cautions(campaign: Campaign, best: Refit) -> Iterator[str]:
    """Yield what is odd about effects, and parameters that are far from what was assumed or at a bound."""
    for placed in best.effects:
        if placed.effect.kind == "sensor_gain":
            yield from _gain(campaign, placed)
        yield from (f"{placed.label}: {odd}" for odd in doubtful(placed, campaign))
    for name, value in best.parameters.items():
        prior = campaign.priors[name]
        yield from left_prior(name, value, prior, campaign.machine.unit(name))
        yield from _at_bound(name, value, prior, _why_at_bound(name, best))
    yield from _own_cautions(campaign, best)
    yield from _lost(campaign, best)
    yield from _omissions(campaign)


def _omissions(campaign: Campaign) -> Iterator[str]:
    omitted = [
        (float((e.omitted & ~at_ends(e)).sum()) / e.rate, e.name)
        for e in campaign.experiments
        if e.omitted is not None
    ]
    spans = ", ".join(f"{seconds:.3g} s of {name}" for seconds, name in omitted if seconds)
    if spans:
        yield f"all motion stands still in {spans}: not compared, as dry friction may hold any force there"


def _lost(campaign: Campaign, best: Refit) -> Iterator[str]:
    """Yield which training records a model with effects is lost in, if it follows others."""
    lost = [
        f"{experiment.name} ({missed:.3g} times its noise)"
        for experiment, missed in zip(campaign.training, best.trained, strict=True)
        if missed > LOST_MISFIT
    ]
    if best.effects and lost and min(best.trained) < COLOURED_MISFIT:
        yield (
            f"the model follows other training records, but not {', '.join(lost)}: either its run falls to "
            "another side there than the machine did, or something happened there that did not elsewhere"
        )


def _own_cautions(campaign: Campaign, best: Refit) -> Iterator[str]:
    for experiment, own in zip(campaign.experiments, best.own, strict=True):
        for name, value in own.items():
            prior, told = campaign.per_record[name], f"{name} of {experiment.name}"
            yield from left_prior(told, value, prior, campaign.machine.unit(name))
            yield from _at_bound(told, value, prior, "the bound or the model is wrong")


def _at_bound(told: str, value: float, prior: Prior, why: str) -> Iterator[str]:
    for side in (prior.min, prior.max):
        if isclose(value, side, rel_tol=BOUND_TOLERANCE, abs_tol=BOUND_SCALE_TOLERANCE * prior.scale):
            yield f"{told}: ends at its bound {side:.6g}; {why}"


def _why_at_bound(parameter: str, best: Refit) -> str:
    part = parameter.rpartition(".")[0]
    for placed in best.effects:
        if part in (placed.site.path, *placed.site.same):
            return f"{told(*placed.key)} takes the place of what the model has there"
    return "the bound or the model is wrong"


def led_astray(campaign: Campaign, refit: Refit) -> Iterator[str]:
    """Say which parameters the fit without effects moved far, to make up for what is missing."""
    moved = {name: campaign.priors[name].moved(value) for name, value in refit.parameters.items()}
    far = [f"{name} by {sd:.3g}" for name, sd in moved.items() if sd > MOVED_STANDARD_DEVIATIONS]
    if far:
        yield (
            f"the fit without effects moves {', '.join(far)} standard deviations from what was assumed: "
            "something large is missing, for which parameters cannot make up"
        )


def suspicions(study: Study, best: Refit) -> Iterator[str]:
    """Yield what channels would explain what no effect does, if they were in another unit or exchanged."""
    campaign = study.campaign
    shares = (
        experiment.sigma[name] * rms([residual]) / size
        for experiment, residuals in zip(campaign.training, best.train, strict=True)
        for name, residual in residuals.items()
        if (size := float(np.std(experiment.record.values[name])))
    )
    if not isinstance(campaign.machine, DAE) or max(shares) <= SUSPECT_SIGNAL_SHARE:
        return
    yield from told_of(suspects(campaign, best.parameters, study.accuracy))


def _gain(campaign: Campaign, placed: Hypothesis) -> Iterator[str]:
    name, gain = placed.site.path, 1 + placed.values["gain"]
    channel = campaign.measured[name]
    if isclose(gain, -1.0, rel_tol=UNIT_GAIN_TOLERANCE):
        yield f"{name}: a gain of {gain:.4g} is a wrong sign rather than a fault of the sensor"
    unit = likely_unit(channel, 1 / gain, UNIT_GAIN_TOLERANCE) if gain else None
    if unit:
        yield (
            f"{name}: a gain of {gain:.4g} is a wrong unit rather than a fault of the sensor: the column is "
            f"likely in {unit}, not in {channel.unit}"
        )
