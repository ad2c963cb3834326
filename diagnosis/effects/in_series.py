"""Effects in series with a site, or at its node: play, compliance, inertia."""

from __future__ import annotations

import numpy as np

from ... import components as ia
from ...components import rotational
from ...networks import parallel
from .edits import Add, Connect, Edit, Insert
from .effect import Array, Effect, Motion, Values, both, register
from .sites import Site

STIFF = 1e-3  # travel of a site over the deflection of a stop under its largest force
FAST = 1e-4  # s, in which a compliance settles
TINY = 1e-15  # least compliance
SHARP = 0.02  # force at which play is taken up, over the largest
WIDE = 0.1  # change of a clearance by which its effect is judged: on a smaller scale impacts make it rough
LEAK = 1e-4  # force of the oil in a clearance at the usual speed, over the largest force


def _play(site: Site, name: str, values: Values) -> list[Edit]:
    stiffness, oil = site.force / (STIFF * site.travel), LEAK * site.force / site.speed
    calming = FAST * stiffness if site.sticks else 0.0
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
    size = stiffness * FAST**2
    inertia = rotational.Inertia(J=size) if site.domain == "rotational" else ia.Mass(m=size)
    return [Add(f"{name}_ballast", inertia), Connect((f"{name}_ballast.flange", f"{name}.flange_a"))]


def _yielding(site: Site, name: str, values: Values) -> list[Edit]:
    value = 1 / max(values["compliance"], TINY)
    turning = site.domain == "rotational"
    damping = FAST * value
    spring = rotational.SpringDamper(c=value, d=damping) if turning else ia.SpringDamper(k=value, d=damping)
    return [Insert(site.moving, name, spring), *_ballast(site, name, site.force / (STIFF * site.travel))]


def _inertia(site: Site, name: str, values: Values) -> list[Edit]:
    turning = site.domain == "rotational"
    inertia = rotational.Inertia(**values) if turning else ia.Mass(**values)
    return [Add(name, inertia), Connect((f"{name}.flange", site.moving))]


def _play_parameters(site: Site, name: str, values: Values) -> dict[str, float]:
    width = {"b": 2 * values["eps"]} if site.domain == "rotational" else {"eps": values["eps"]}
    return {f"{name}.gap.{key}": value for key, value in width.items()}


def _yield_parameters(site: Site, name: str, values: Values) -> dict[str, float]:
    stiffness = "c" if site.domain == "rotational" else "k"
    value = 1 / max(values["compliance"], TINY)
    return {f"{name}.{stiffness}": value, f"{name}.d": FAST * value}


def _taken_up(motion: Motion, _: Values) -> list[Array]:
    """Return where play lies: on the side to which the force presses."""
    return [np.tanh(motion.f / (SHARP * float(np.abs(motion.f).max())))]


BACKLASH = register(
    Effect(
        "backlash",
        "series",
        both(eps=(("eps", "m"), ("eps", "rad"))),
        _play,
        _taken_up,
        parameters=_play_parameters,
        step=WIDE,
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
