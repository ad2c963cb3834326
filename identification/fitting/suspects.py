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
from ..records.record import Channel
from .campaign_model import Accuracy, CampaignModel, Values
from .problem import FitProblem, Optimum
from .residual_block import ResidualBlock

EXPLAINED_SHARE = 0.1  # share of the sum of squares that a suspect may leave
EQUAL_RATIO = 1.5  # times the residual of the best within which a suspect explains as much
SIZE_RATIO = 4.0  # times by which a nominal model may miss the size of a signal
SIGN_CORRELATION = 0.2  # with the nominal model below which a sign may be wrong
MOST_TRIED = 12
MOST_STEPS = 15
FLED_DEVIATIONS, STAYED_DEVIATIONS = 10.0, 5.0  # of priors: parameters that a wrong unit moved, and others
PREFIXES = {1e3: "small", 1e-3: "large"}


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


def told_of(found: Sequence[Suspect]) -> Iterator[str]:
    """Say what is likely wrong with channels, if anything is."""
    if found:
        left = found[0].left
        much = f"{left:.2g} of what is left now" if left < 0.5 else "as little, with parameters as assumed"
        yield f"{', or '.join(suspect.told for suspect in found)}: then the same model would leave {much}"


def suspects(
    campaign: Campaign, values: Values, accuracy: Accuracy, report: Callable[[str], None] = lambda line: None
) -> list[Suspect]:
    """Return what explains the training records far better than `values` do, with the same model.

    The model is fitted anew, from its own parameters, to the records as they would be.
    """
    as_given = _fitted(campaign, campaign.training, campaign.sigma, values, accuracy)
    if as_given is None:
        return []
    found: list[Suspect] = []
    tried = list(_candidates(campaign, accuracy))[:MOST_TRIED]
    for number, suspect in enumerate(tried, start=1):
        report(f"much is left; trying whether a channel is in another unit, {number} of {len(tried)}")
        changed = [_changed(e, suspect) for e in campaign.training]
        sigma = campaign.sigma
        sigma |= {name: sigma[name] * abs(suspect.factor) for name in suspect.channels if name in sigma}
        other = _fitted(campaign, changed, sigma, campaign.start, accuracy)
        if other is not None and _is_better(other, as_given, campaign.priors):
            found.append(replace(suspect, left=float(np.sqrt(other.cost / as_given.cost))))
    best = min((suspect.left for suspect in found), default=0.0)
    return [suspect for suspect in found if suspect.left <= EQUAL_RATIO * best]


def _fitted(
    campaign: Campaign, experiments: Sequence[Experiment], sigma: Values, values: Values, accuracy: Accuracy
) -> Optimum | None:
    """Fit all parameters to all channels; None if the model cannot be run."""
    bench = CampaignModel(campaign.dae, campaign.measured, experiments, list(campaign.priors))
    blocks = [ResidualBlock(stand, campaign.outputs, sigma, None) for stand in bench.stands]
    try:
        return FitProblem(blocks, campaign.priors, values, accuracy).minimise(most=MOST_STEPS)
    except InertanceError:
        return None


def _is_better(other: Optimum, given: Optimum, priors: Mapping[str, Prior]) -> bool:
    """Tell whether a fit leaves far less, or no more with parameters that stay near what was assumed."""
    if other.cost < EXPLAINED_SHARE * given.cost:
        return True
    fled, stayed = (
        max((p.moved(one.values[n]) for n, p in priors.items()), default=0.0) for one in (given, other)
    )
    return other.cost < EQUAL_RATIO * given.cost and fled > FLED_DEVIATIONS and stayed < STAYED_DEVIATIONS


def _changed(experiment: Experiment, suspect: Suspect) -> Experiment:
    given = experiment.record.values
    pairs = zip(suspect.channels, reversed(suspect.channels), strict=True)
    values = {**given, **{one: suspect.factor * given[other] for one, other in pairs}}
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
        if max(likeness[n] for n in outputs) < SIGN_CORRELATION:
            ranked.append((0.0, Suspect((name,), -1.0, f"the sign of {name} is likely wrong")))
        own = channel.si if in_si else channel.unit
        for factor, told in _factors(channel, own or "1"):
            missed = abs(np.log(size / factor if channel.driven else size * factor))
            if missed < np.log(SIZE_RATIO) and missed < abs(np.log(size)):
                ranked.append((missed, Suspect((name,), factor, f"{name} is likely {told}")))
    yield from (suspect for _, suspect in sorted(ranked, key=lambda entry: entry[0]))
    for (one, first), (other, second) in combinations(campaign.measured.items(), 2):
        if first.si == second.si and first.driven == second.driven:
            yield Suspect((one, other), 1.0, f"{one} and {other} are likely exchanged")


def likely_unit(channel: Channel, factor: float, share: float) -> str | None:
    """Return the unit in which a column is if its values are to be multiplied by a factor.

    None if there is none within a share of the factor, or the factor is all but one.
    """
    factors = _unit_factors(channel, channel.unit)
    unit = min(factors, key=lambda one: abs(factors[one] / factor - 1))
    near = abs(factors[unit] / factor - 1) < share
    return unit if near and not isclose(factors[unit], 1.0) else None


def _unit_factors(channel: Channel, own: str) -> dict[str, float]:
    """Return by unit in which a column may be by what one in its own is multiplied then."""
    said = unit_for(own, channel.si)
    return {unit: size / said.factor for unit, size in units_like(said).items()}


def _factors(channel: Channel, own: str) -> Iterator[tuple[float, str]]:
    """Yield by what a column is to be multiplied if it is in another unit than was said, and what to say."""
    known = {unit: factor for unit, factor in _unit_factors(channel, own).items() if not isclose(factor, 1.0)}
    yield from ((factor, f"in {unit}, not in {own}") for unit, factor in known.items())
    for factor, much in PREFIXES.items():
        if not any(isclose(factor, other) for other in known.values()):
            yield factor, f"1000 times too {much}"


def _nominal(campaign: Campaign, accuracy: Accuracy) -> tuple[dict[str, float], dict[str, float]]:
    """Return how large outputs are over what the model predicts as it was given, and how alike both are."""
    bench = CampaignModel(campaign.dae, campaign.measured, campaign.training)
    sizes, likeness = {}, {}
    try:
        predicted = bench.simulate(campaign.start, accuracy=accuracy)
    except InertanceError:
        return {}, {}
    for name in campaign.outputs:
        signals = [stand.record.values[name] for stand in bench.stands], [p.values[name] for p in predicted]
        x, y = (np.concatenate([v - v.mean() for v in values]) for values in signals)
        if x.any() and y.any():
            sizes[name] = float(np.linalg.norm(x) / np.linalg.norm(y))
            likeness[name] = float(x @ y / (np.linalg.norm(x) * np.linalg.norm(y)))
    return (sizes, likeness) if len(sizes) == len(campaign.outputs) else ({}, {})
