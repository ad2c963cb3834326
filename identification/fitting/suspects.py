"""Suspects: channels that explain a misfit if they are in another unit, have another sign, or are swapped."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import isclose

import numpy as np

from ...base import unit_for, units_like
from ...components import InertanceError
from ..campaign.campaign import Campaign
from ..campaign.experiment import Experiment
from ..campaign.priors import Prior
from ..records.channel import Channel
from .campaign_model import Accuracy, CampaignModel
from .problem import Optimum, Problem
from .residual_block import Block

EXPLAINS = 0.1  # share of the sum of squares that a suspect may leave
EQUAL = 1.5  # times the residual of the best within which a suspect explains as much
NEAR = 4.0  # times by which a nominal model may miss the size of a signal
UNLIKE = 0.2  # correlation with the nominal model below which a sign may be wrong
MOST_TRIED = 12
STEPS = 15
FLED, STAYED = 10.0, 5.0  # standard deviations of priors: parameters that a wrong unit moved, and others
GENERAL = 1e3, 1e-3


@dataclass(frozen=True)
class Suspect:
    """What is likely wrong with channels.

    Attributes:
        channels: one, or two that are exchanged.
        factor: by what the values of the column must be multiplied; 1 if two are exchanged.
        told: in words.
        left: residual, as it would be, over the residual as it is.
    """

    channels: tuple[str, ...]
    factor: float
    told: str
    left: float = 1.0


def told_of(found: Sequence[Suspect]) -> str:
    """Say what is likely wrong with channels; empty if nothing is."""
    if not found:
        return ""
    either, left = ", or ".join(suspect.told for suspect in found), found[0].left
    much = f"{left:.2g} of what is left now" if left < 0.5 else "as little, with parameters as assumed"
    return f"{either}: then the same model would leave {much}"


def suspects(
    campaign: Campaign,
    values: Mapping[str, float],
    accuracy: Accuracy,
    report: Callable[[str], None] = lambda line: None,
) -> list[Suspect]:
    """Return what explains the training records far better than `values` do, with the same model.

    The model is fitted anew, from its own parameters, to the records as they would be.
    """
    experiments = campaign.training
    as_given = _fitted(campaign, experiments, campaign.sigma, values, accuracy)
    if as_given is None:
        return []
    found: list[Suspect] = []
    tried = list(_candidates(campaign, accuracy))[:MOST_TRIED]
    for number, suspect in enumerate(tried, start=1):
        report(f"much is left; trying whether a channel is in another unit, {number} of {len(tried)}")
        changed = [_changed(e, suspect) for e in experiments]
        sigma = campaign.sigma
        for name in suspect.channels if len(suspect.channels) == 1 else ():
            if name in sigma:
                sigma[name] *= abs(suspect.factor)
        other = _fitted(campaign, changed, sigma, campaign.start, accuracy)
        if other is not None and _is_better(other, as_given, campaign.priors):
            found.append(replace(suspect, left=float(np.sqrt(other.cost / as_given.cost))))
    best = min((suspect.left for suspect in found), default=0.0)
    return [suspect for suspect in found if suspect.left <= EQUAL * best]


def _fitted(
    campaign: Campaign,
    experiments: Sequence[Experiment],
    sigma: Mapping[str, float],
    values: Mapping[str, float],
    accuracy: Accuracy,
) -> Optimum | None:
    """Fit all parameters to all channels; None if the model cannot be run."""
    bench = CampaignModel(campaign.dae, campaign.measured, experiments, list(campaign.priors))
    blocks = [Block(stand, campaign.outputs, sigma, None) for stand in bench.stands]
    try:
        for block in blocks:
            block.prepare(values, accuracy)
        columns = list(range(len(campaign.priors)))
        found = Problem(blocks, campaign.priors, columns, values, accuracy).minimise(values, most=STEPS)
    except InertanceError:
        return None
    if found.ended == "interrupted":
        raise KeyboardInterrupt
    return found


def _is_better(other: Optimum, given: Optimum, priors: Mapping[str, Prior]) -> bool:
    """Tell whether a fit leaves far less, or no more with parameters that stay near what was assumed."""
    if other.cost < EXPLAINS * given.cost:
        return True
    fled, stayed = (max(p.moved(one.values[n]) for n, p in priors.items()) for one in (given, other))
    return other.cost < EQUAL * given.cost and fled > FLED and stayed < STAYED


def _changed(experiment: Experiment, suspect: Suspect) -> Experiment:
    """Return a record as it would be."""
    values = dict(experiment.record.values)
    if len(suspect.channels) == 2:
        one, other = suspect.channels
        values[one], values[other] = values[other], values[one]
    else:
        name = suspect.channels[0]
        values[name] = suspect.factor * values[name]
    return replace(experiment, record=replace(experiment.record, values=values))


def _candidates(campaign: Campaign, accuracy: Accuracy) -> Iterator[Suspect]:
    """Yield what may be wrong by the size and the sign of what the model predicts as it was given."""
    sizes, likeness = _nominal(campaign, accuracy)
    if not sizes:
        return
    ranked = []
    in_si = all("record" in entry for entry in campaign.train)
    for name, channel in campaign.measured.items():
        outputs = list(sizes) if channel.driven else [name]
        size = float(np.exp(np.mean([np.log(sizes[n]) for n in outputs])))
        if max(likeness[n] for n in outputs) < UNLIKE:
            ranked.append((0.0, Suspect((name,), -1.0, f"the sign of {name} is likely wrong")))
        own = channel.si if in_si else channel.unit
        for factor, told in _factors(channel, own or "1"):
            missed = abs(np.log(size * (1 / factor if channel.driven else factor)))
            if missed < np.log(NEAR) and missed < abs(np.log(size)):
                ranked.append((missed, Suspect((name,), factor, f"{name} is likely {told}")))
    yield from (suspect for _, suspect in sorted(ranked, key=lambda entry: entry[0]))
    for (one, first), (other, second) in combinations(campaign.measured.items(), 2):
        if first.si == second.si and first.driven == second.driven:
            yield Suspect((one, other), 1.0, f"{one} and {other} are likely exchanged")


def likely_unit(channel: Channel, factor: float, share: float) -> str | None:
    """Return the unit in which a column is if its values are to be multiplied by a factor.

    None if there is none within a share of the factor, or the factor is all but one.
    """
    near = {unit: (abs(times / factor - 1), times) for unit, times in _others(channel, channel.unit)}
    unit = min(near, key=lambda one: near[one])
    missed, times = near[unit]
    return unit if missed < share and not isclose(times, 1.0) else None


def _others(channel: Channel, own: str) -> Iterator[tuple[str, float]]:
    """Yield the units in which a column may be, and by what one in its own is multiplied then."""
    said = unit_for(own, channel.si)
    yield from ((unit, size / said.factor) for unit, size in units_like(said).items())


def _factors(channel: Channel, own: str) -> Iterator[tuple[float, str]]:
    """Yield by what a column is to be multiplied if it is in another unit than was said, and what to say."""
    known = []
    for unit, factor in _others(channel, own):
        if not isclose(factor, 1.0):
            known.append(factor)
            yield factor, f"in {unit}, not in {own}"
    for factor in GENERAL:
        if not any(isclose(factor, other) for other in known):
            much = "large" if factor < 1 else "small"
            yield factor, f"1000 times too {much}"


def _nominal(campaign: Campaign, accuracy: Accuracy) -> tuple[dict[str, float], dict[str, float]]:
    """Return how large outputs are over what the model predicts as it was given, and how alike both are."""
    bench = CampaignModel(campaign.dae, campaign.measured, campaign.training)
    sizes, likeness = {}, {}
    try:
        predicted = bench.simulate(campaign.start, accuracy=accuracy, slopes=False)
    except InertanceError:
        return {}, {}
    for name in campaign.outputs:
        mine = [stand.record.values[name] for stand in bench.stands]
        theirs = [prediction.values[name] for prediction in predicted]
        x = np.concatenate([v - v.mean() for v in mine])
        y = np.concatenate([v - v.mean() for v in theirs])
        if x.any() and y.any():
            sizes[name] = float(np.linalg.norm(x) / np.linalg.norm(y))
            likeness[name] = float(x @ y / (np.linalg.norm(x) * np.linalg.norm(y)))
    return (sizes, likeness) if len(sizes) == len(campaign.outputs) else ({}, {})
