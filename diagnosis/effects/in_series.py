"""Effects in series with a site, or at its node: play, compliance, inertia."""

from __future__ import annotations

import numpy as np

from ...base import Array
from ...components import Backlash, Component, Domain, rotational
from ...networks import parallel
from .. import criteria
from .edits import Add, Connect, Edit, Insert
from .effect import Effect, Motion, Values, both, register
from .sites import Site


def _stop(site: Site) -> float:
    """Return the stiffness of a stop, so large that no record shows it."""
    return site.force / (criteria.STOP_DEFLECTION_RATIO * site.travel)


CLEARANCES: dict[str, tuple[type[Component], str, float]] = {  # element, its width, halves of play in that
    Domain.TRANSLATIONAL: (Backlash, "eps", 1.0),
    Domain.ROTATIONAL: (rotational.ElastoBacklash, "b", 2.0),
}


def _width(site: Site, values: Values) -> dict[str, float]:
    _, name, halves = CLEARANCES[site.domain]
    return {name: halves * values["eps"]}


def _play(site: Site, name: str, values: Values) -> list[Edit]:
    stiffness, oil = _stop(site), criteria.OIL_FORCE_RATIO * site.force / site.speed
    calming = criteria.SETTLING_SECONDS * stiffness if site.sticks else 0.0
    kind, _, _ = CLEARANCES[site.domain]
    gap = kind(**{site.mechanics.stiffness: stiffness}, d=calming, **_width(site, values))
    both_ways = parallel(gap=gap, oil=site.family.Damper(d=oil))
    return [Insert(site.moving, name, both_ways), *_ballast(site, name, stiffness)]


def _ballast(site: Site, name: str, stiffness: float) -> list[Edit]:
    """Return what gives dry friction an inertia of its own, so small that it settles in next to no time."""
    if not site.sticks:
        return []
    inertia = site.family.Mass(**{site.mechanics.inertia: stiffness * criteria.SETTLING_SECONDS**2})
    return [Add(f"{name}_ballast", inertia), Connect((f"{name}_ballast.flange", f"{name}.flange_a"))]


def _yielding(site: Site, name: str, values: Values) -> list[Edit]:
    value = 1 / max(values["compliance"], criteria.LEAST_COMPLIANCE)
    spring = site.family.SpringDamper(
        **{site.mechanics.stiffness: value}, d=criteria.SETTLING_SECONDS * value
    )
    return [Insert(site.moving, name, spring), *_ballast(site, name, _stop(site))]


def _inertia(site: Site, name: str, values: Values) -> list[Edit]:
    return [Add(name, site.family.Mass(**values)), Connect((f"{name}.flange", site.moving))]


def _play_parameters(site: Site, name: str, values: Values) -> dict[str, float]:
    return {f"{name}.gap.{key}": value for key, value in _width(site, values).items()}


def _yield_parameters(site: Site, name: str, values: Values) -> dict[str, float]:
    value = 1 / max(values["compliance"], criteria.LEAST_COMPLIANCE)
    return {f"{name}.{site.mechanics.stiffness}": value, f"{name}.d": criteria.SETTLING_SECONDS * value}


def _taken_up(motion: Motion, _: Values) -> list[Array]:
    """Return where play lies: on the side to which the force presses."""
    return [np.tanh(motion.f / (criteria.PLAY_FORCE_RATIO * float(np.abs(motion.f).max())))]


BACKLASH = register(
    Effect(
        "backlash",
        "series",
        both(eps=(("eps", "m"), ("eps", "rad"))),
        _play,
        _taken_up,
        parameters=_play_parameters,
        step=criteria.CLEARANCE_STEP_RATIO,
    )
)
COMPLIANCE = register(
    Effect(
        "compliance",
        "series",
        both(compliance=(("compliance", "m/N"), ("compliance", "rad/(N.m)"))),
        _yielding,
        lambda motion, _: [motion.f],
        parameters=_yield_parameters,
    )
)
INERTIA = register(
    Effect(
        "added_inertia", "node", both(m=(("m", "kg"), ("J", "kg.m2"))), _inertia, lambda motion, _: [motion.a]
    )
)
