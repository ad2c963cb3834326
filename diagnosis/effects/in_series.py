"""Effects in series with a site, or at its node: play, compliance, inertia."""

from __future__ import annotations

import numpy as np

from ... import components as ia
from ...components import rotational
from ...networks import parallel
from ..criteria import (
    CLEARANCE_STEP_RATIO,
    LEAST_COMPLIANCE,
    OIL_FORCE_RATIO,
    PLAY_FORCE_RATIO,
    SETTLING_SECONDS,
    STOP_DEFLECTION_RATIO,
)
from .edits import Add, Connect, Edit, Insert
from .effect import Array, Effect, Motion, Values, both, register
from .sites import Site


def _stop(site: Site) -> float:
    """Return the stiffness of a stop, so large that no record shows it."""
    return site.force / (STOP_DEFLECTION_RATIO * site.travel)


def _play(site: Site, name: str, values: Values) -> list[Edit]:
    stiffness, oil = _stop(site), OIL_FORCE_RATIO * site.force / site.speed
    calming = SETTLING_SECONDS * stiffness if site.sticks else 0.0
    if site.domain == "rotational":
        turn = rotational.ElastoBacklash(c=stiffness, d=calming, b=2 * values["eps"])
        both_ways = parallel(gap=turn, oil=rotational.Damper(d=oil))
    else:
        gap = ia.Backlash(k=stiffness, d=calming, eps=values["eps"])
        both_ways = parallel(gap=gap, oil=ia.Damper(d=oil))
    return [Insert(site.moving, name, both_ways), *_ballast(site, name, stiffness)]


def _ballast(site: Site, name: str, stiffness: float) -> list[Edit]:
    """Return what gives dry friction an inertia of its own, so small that it settles in next to no time."""
    if not site.sticks:
        return []
    size = stiffness * SETTLING_SECONDS**2
    inertia = rotational.Inertia(J=size) if site.domain == "rotational" else ia.Mass(m=size)
    return [Add(f"{name}_ballast", inertia), Connect((f"{name}_ballast.flange", f"{name}.flange_a"))]


def _yielding(site: Site, name: str, values: Values) -> list[Edit]:
    value = 1 / max(values["compliance"], LEAST_COMPLIANCE)
    turning = site.domain == "rotational"
    damping = SETTLING_SECONDS * value
    spring = rotational.SpringDamper(c=value, d=damping) if turning else ia.SpringDamper(k=value, d=damping)
    return [Insert(site.moving, name, spring), *_ballast(site, name, _stop(site))]


def _inertia(site: Site, name: str, values: Values) -> list[Edit]:
    turning = site.domain == "rotational"
    inertia = rotational.Inertia(**values) if turning else ia.Mass(**values)
    return [Add(name, inertia), Connect((f"{name}.flange", site.moving))]


def _play_parameters(site: Site, name: str, values: Values) -> dict[str, float]:
    width = {"b": 2 * values["eps"]} if site.domain == "rotational" else {"eps": values["eps"]}
    return {f"{name}.gap.{key}": value for key, value in width.items()}


def _yield_parameters(site: Site, name: str, values: Values) -> dict[str, float]:
    stiffness = "c" if site.domain == "rotational" else "k"
    value = 1 / max(values["compliance"], LEAST_COMPLIANCE)
    return {f"{name}.{stiffness}": value, f"{name}.d": SETTLING_SECONDS * value}


def _taken_up(motion: Motion, _: Values) -> list[Array]:
    """Return where play lies: on the side to which the force presses."""
    return [np.tanh(motion.f / (PLAY_FORCE_RATIO * float(np.abs(motion.f).max())))]


BACKLASH = register(
    Effect(
        "backlash",
        "series",
        both(eps=(("eps", "m"), ("eps", "rad"))),
        _play,
        _taken_up,
        parameters=_play_parameters,
        step=CLEARANCE_STEP_RATIO,
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
