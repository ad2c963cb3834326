"""Plausibility: whether an effect's values are a machine's, by how that moves and what was recorded."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import inf, pi
from typing import NamedTuple

import numpy as np

from ...components import Domain
from ...identification import Campaign, Machine, likely_unit
from .. import criteria
from .hypothesis import Hypothesis

DRY = "coulomb_friction"
FORCES = {Domain.TRANSLATIONAL: "N", Domain.ROTATIONAL: "N.m"}
INERTIAS = {Domain.TRANSLATIONAL: "kg", Domain.ROTATIONAL: "kg.m2"}
SIGN = -1.0


class _Doubt(NamedTuple):
    """How far a value is from what machines have, (refused, doubtful) beyond which, and what is odd."""

    amount: float
    limits: tuple[float, float]
    told: str


def inertias(machine: Machine, unit: str) -> dict[str, float]:
    """Return the inertias of a machine that are in a unit, by the parameters that tell them."""
    return {name: value for name, value in machine.parameter_values.items() if machine.unit(name) == unit}


def implausible(placed: Hypothesis, campaign: Campaign) -> str | None:
    """Return why no machine has an effect with these values, None if one may.

    Its site tells how it moves in the nominal model, the campaign what was recorded.
    """
    return next((doubt.told for doubt in _doubts(placed, campaign) if doubt.amount > doubt.limits[0]), None)


def refused(placed: Hypothesis, campaign: Campaign) -> str:
    """Return why no machine has an effect as it was fitted; nothing if one may."""
    values = placed.values
    if not placed.effect.credible(values):
        return f"no such machine: {', '.join(f'{name} = {value:.3g}' for name, value in values.items())}"
    odd = implausible(placed, campaign)
    return "" if odd is None else f"no such machine: {odd}"


def doubtful(placed: Hypothesis, campaign: Campaign) -> Iterator[str]:
    """Yield what is odd about an effect that some machine may have, or that none has."""
    yield from (doubt.told for doubt in _doubts(placed, campaign) if doubt.amount > doubt.limits[1])


def _doubts(placed: Hypothesis, campaign: Campaign) -> Iterator[_Doubt]:
    for rule in RULES:
        yield from rule(placed, campaign)


def _sized(placed: Hypothesis, unit: str) -> Iterator[tuple[str, float]]:
    """Yield names and sizes of the quantities of a unit."""
    sizes = (q for q in placed.quantities if q.unit == unit)
    yield from ((q.name, abs(placed.values[q.name])) for q in sizes)


def _absent(placed: Hypothesis, _: Campaign) -> Iterator[_Doubt]:
    sizes = [(placed.values[q.name], q.low) for q in placed.effect.sizes(placed.site.domain)]
    if all(value == 0 or value <= low for value, low in sizes):
        yield _Doubt(inf, (0.0, 0.0), "all its sizes are as small as they may be: it does nothing")


def _ripple(placed: Hypothesis, _: Campaign) -> Iterator[_Doubt]:
    if "period" not in placed.values or _is_dry(placed):
        return
    unit = next(q.unit for q in placed.quantities if q.name == "period")
    passed = 2 * placed.site.travel / placed.values["period"]
    least, few = criteria.RIPPLE_PERIODS_PASSED
    yield _Doubt(
        -passed,
        (-least, -few),
        f"its period of {placed.values['period']:.3g} {unit} is passed {passed:.2g} times in the "
        "range of the site, where any force that depends on position looks so",
    )


def _friction_along_the_way(placed: Hypothesis, _: Campaign) -> Iterator[_Doubt]:
    if "period" not in placed.values or not _is_dry(placed):
        return
    passed = 2 * placed.site.travel / placed.values["period"]
    if passed < criteria.RIPPLE_PERIODS_PASSED[0]:
        told = "it would be seen once along the way: that is a change with time, in a motion that never turns"
        least = criteria.LEAST_PASSES
        yield _Doubt(-placed.site.passes, (-least, -least), told)


def _spring_on_a_shaft(placed: Hypothesis, _: Campaign) -> Iterator[_Doubt]:
    sizes = placed.effect.sizes(placed.site.domain)
    stiff = any(q.unit.startswith("N.m/rad") and not q.name.startswith("d") for q in sizes)
    turns = placed.site.travel / pi
    if stiff and not placed.effect.memory and not _is_dry(placed):
        yield _Doubt(turns, criteria.TURNS_OF_A_SPRING, f"it holds a shaft that turns {turns:.3g} times")


def _sticking(placed: Hypothesis, campaign: Campaign) -> Iterator[_Doubt]:
    if placed.site.domain not in FORCES or not _is_dry(placed) or placed.site.largest == inf:
        return
    unit = FORCES[placed.site.mechanics]
    measured = [name for name, channel in campaign.measured.items() if channel.si == unit]
    peaks = [float(np.abs(e.record.values[n]).max()) for e in campaign.training for n in measured]
    largest = max([placed.site.largest, *peaks])
    for name, level in _sized(placed, unit):
        told = f"{name} = {level:.3g} {unit} is {level / largest:.3g} times the largest force there is"
        yield _Doubt(level / largest, criteria.FRICTION_OVER_FORCE, told)


def _own_load(placed: Hypothesis, _: Campaign) -> Iterator[_Doubt]:
    if placed.effect.place != "loaded":
        return
    mu = abs(placed.values.get("mu", 0.0))
    yield _Doubt(mu, criteria.FRICTION_COEFFICIENT, f"a coefficient of friction of {mu:.3g}")
    if placed.site.sticks:
        yield _Doubt(inf, (0.0, 0.0), "what loads it is the dry friction that the model has there")


def _gain(placed: Hypothesis, campaign: Campaign) -> Iterator[_Doubt]:
    if placed.site.domain != "channel" or "gain" not in placed.values:
        return
    gain, channel = 1 + placed.values["gain"], campaign.measured[placed.site.path]
    tolerance = criteria.UNIT_GAIN_TOLERANCE
    if gain and (abs(gain - SIGN) < tolerance or likely_unit(channel, 1 / gain, tolerance)):
        return
    ratio = max(abs(gain), 1 / abs(gain)) if gain else inf
    told = f"a gain of {gain:.4g} is no fault of a sensor: look whether '{placed.site.path}' is what it says"
    yield _Doubt(ratio, criteria.SENSOR_GAIN_RATIO, told)


def _late(placed: Hypothesis, campaign: Campaign) -> Iterator[_Doubt]:
    longest = max(float(np.ptp(e.record.time)) for e in campaign.training)
    for name, seconds in _sized(placed, "s") if placed.site.domain == "channel" else ():
        told = f"{name} = {seconds:.3g} s is {seconds / longest:.0%} of the longest record"
        yield _Doubt(seconds / longest, criteria.DELAY_RECORD_SHARE, told)


def _inertia(placed: Hypothesis, campaign: Campaign) -> Iterator[_Doubt]:
    if placed.effect.place != "node":
        return
    unit = INERTIAS[placed.site.mechanics]
    largest = max([*inertias(campaign.machine, unit).values(), placed.site.inertia])
    for name, value in _sized(placed, unit) if largest > 0 else ():
        told = f"{name} = {value:.3g} {unit} is {value / largest:.3g} times the largest inertia of the model"
        yield _Doubt(value / largest, criteria.ADDED_INERTIA_RATIO, told)


def _blocked(placed: Hypothesis, campaign: Campaign) -> Iterator[_Doubt]:
    if not placed.effect.drives:
        return
    path = placed.site.path
    commands = [e.record.values[path] for e in campaign.training]
    largest = max(float(np.abs(u - np.median(u)).max()) for u in commands)
    unit = campaign.measured[path].si
    for name, width in _sized(placed, "unit") if largest else ():
        told = f"{name} = {width:.3g} {unit} holds back {width / largest:.0%} of the largest '{path}'"
        yield _Doubt(width / largest, criteria.BLOCKED_COMMAND_SHARE, told)


def _flanks(placed: Hypothesis, _: Campaign) -> Iterator[_Doubt]:
    if {"eps", "compliance"} <= placed.values.keys() and placed.values["compliance"] > 0:
        yielding, play = placed.values["compliance"] * placed.site.force, placed.values["eps"]
        told = f"a play of {play:.3g} is nothing beside the {yielding:.3g} by which its flanks yield"
        yield _Doubt(yielding / play if play else inf, criteria.YIELDING_OVER_PLAY, told)


def _is_dry(placed: Hypothesis) -> bool:
    return placed.effect.kind == DRY or placed.effect.generalises(DRY)


RULES: tuple[Callable[[Hypothesis, Campaign], Iterator[_Doubt]], ...] = (
    _absent,
    _ripple,
    _friction_along_the_way,
    _spring_on_a_shaft,
    _sticking,
    _own_load,
    _gain,
    _late,
    _inertia,
    _blocked,
    _flanks,
)
