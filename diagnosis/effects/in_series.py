"""Effects in series with a site, or at its node: play, compliance, inertia."""

from __future__ import annotations

import numpy as np

from ...base import Array
from ...components import Backlash, Component, Domain, rotational
from ...networks import parallel
from .. import criteria
from .edits import AddPart, Connect, Edit, Exchange, Insert
from .effect import Effect, Motion, Values, both, register
from .sites import Site


def _stop(site: Site) -> float:
    """Return the stiffness of a stop, so large that no record shows it."""
    return site.force / (criteria.STOP_DEFLECTION_RATIO * site.travel)


def _give(site: Site, values: Values) -> float:
    """Return the compliance of flanks: that of a stop if none is told, and a hundredth of it at least."""
    stop = 1 / _stop(site)
    return max(values.get("compliance", stop), criteria.LEAST_FLANK_RATIO * stop)


CLEARANCES: dict[str, tuple[type[Component], str, float]] = {  # element, its width, halves of play in that
    Domain.TRANSLATIONAL: (Backlash, "eps", 1.0),
    Domain.ROTATIONAL: (rotational.ElastoBacklash, "b", 2.0),
}


def _gives_at_once(site: Site) -> bool:
    """Tell whether the damper of a spring, which elastic flanks would hold back, bears little."""
    made = dict(site.spring)
    sprung, damped = made[site.mechanics.stiffness] * site.travel, made.get("d", 0.0) * site.speed
    return damped <= criteria.FLANKS_DAMPER_SHARE * sprung


def _width(site: Site, values: Values) -> dict[str, float]:
    _, name, halves = CLEARANCES[site.domain]
    return {name: halves * values["eps"]}


def _play(site: Site, name: str, values: Values) -> list[Edit]:
    """Return the flanks that a spring becomes; with all else a gap is in series, stiff if nothing is told."""
    if site.spring:
        return [Exchange(site.path, _flanks(site, values))]
    stiffness, oil = 1 / _give(site, values), criteria.OIL_FORCE_RATIO * site.force / site.speed
    calming = criteria.IMPACT_SECONDS * stiffness
    kind, _, _ = CLEARANCES[site.domain]
    gap = kind(**{site.mechanics.stiffness: stiffness}, d=calming, **_width(site, values))
    both_ways = parallel(gap=gap, oil=site.family.Damper(d=oil))
    return [Insert(site.moving, name, both_ways), *_ballast(site, name, stiffness)]


def _flanks(site: Site, values: Values) -> Component:
    """Return a spring with play, which relaxes where its damper bears a share."""
    made, family = {"d": 0.0, **dict(site.spring), "b": 2 * values["eps"]}, site.family
    found: Component = (
        family.ElastoBacklash(**made)
        if _gives_at_once(site)
        else family.RelaxingBacklash(**made, d_0=criteria.OIL_DAMPER_SHARE * made["d"])
    )
    return found


def _gap(site: Site, name: str, values: Values) -> dict[str, float]:
    """Return the width of the gap by its path."""
    if site.spring:
        return {f"{site.path}.b": 2 * values["eps"]}
    return {f"{name}.gap.{key}": value for key, value in _width(site, values).items()}


def _elastic_gap(site: Site, name: str, values: Values) -> dict[str, float]:
    """Return width, stiffness and damping of the gap by their paths."""
    stiffness = 1 / _give(site, values)
    flanks = {site.mechanics.stiffness: stiffness, "d": criteria.IMPACT_SECONDS * stiffness}
    return _gap(site, name, values) | {f"{name}.gap.{key}": value for key, value in flanks.items()}


def _ballast(site: Site, name: str, stiffness: float) -> list[Edit]:
    """Return what gives dry friction an inertia of its own, so small that it settles in next to no time."""
    if not site.sticks:
        return []
    return _body(site, f"{name}_ballast", f"{name}.flange_a", stiffness * criteria.BALLAST_SECONDS**2)


def _body(site: Site, name: str, port: str, inertia: float) -> list[Edit]:
    body = site.family.Mass(**{site.mechanics.inertia: inertia})
    return [AddPart(name, body), Connect((f"{name}.flange", port))]


def _spring(site: Site, values: Values) -> dict[str, float]:
    """Return stiffness and damping of a compliance."""
    stiffness = 1 / max(values["compliance"], criteria.LEAST_COMPLIANCE)
    return {site.mechanics.stiffness: stiffness, "d": criteria.SETTLING_SECONDS * stiffness}


def _yielding(site: Site, name: str, values: Values) -> list[Edit]:
    spring = site.family.SpringDamper(**_spring(site, values))
    return [Insert(site.moving, name, spring), *_ballast(site, name, _stop(site))]


def _taken_up(motion: Motion, _: Values) -> list[Array]:
    """Return where play lies: on the side to which the force presses."""
    return [np.tanh(motion.f / (criteria.PLAY_FORCE_RATIO * float(np.abs(motion.f).max())))]


def _in_the_gap(motion: Motion, stiffness: float, values: Values) -> Array:
    """Return what a spring bears less if play is in series with it: all of it where it presses nowhere."""
    eps = values["eps"]
    return np.where(np.abs(motion.s) < eps, motion.f, stiffness * eps * np.sign(motion.s))


def _softer(motion: Motion, stiffness: float, values: Values) -> Array:
    """Return what a spring bears less if another one is in series with it."""
    both_ways = stiffness * values["compliance"]
    return motion.f * both_ways / (1 + both_ways)


register(
    Effect(
        "backlash",
        "series",
        both(eps=(("eps", "m"), ("eps", "rad"))),
        _play,
        _taken_up,
        eased=_in_the_gap,
        parameters=_gap,
        step=criteria.CLEARANCE_STEP_RATIO,
        rough=True,
    )
)
register(
    Effect(
        "compliance",
        "series",
        both(compliance=(("compliance", "m/N"), ("compliance", "rad/(N.m)"))),
        _yielding,
        lambda motion, _: [motion.f],
        eased=_softer,
        parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _spring(at, p).items()},
    )
)
register(
    Effect(
        "elastic_backlash",
        "series",
        both(
            eps=(("eps", "m"), ("eps", "rad")),
            compliance=(("compliance", "m/N"), ("compliance", "rad/(N.m)")),
        ),
        _play,
        lambda motion, shape: [*_taken_up(motion, shape), motion.f],
        parameters=_elastic_gap,
        step=criteria.CLEARANCE_STEP_RATIO,
        rough=True,
        unsprung=True,
        plain={"compliance": ((0.0,), (1.0,)), "backlash": ((1.0,), (0.0,))},
    )
)
register(
    Effect(
        "added_inertia",
        "node",
        both(m=(("m", "kg"), ("J", "kg.m2"), criteria.LEAST_INERTIA)),
        lambda at, name, p: _body(at, name, at.moving, *p.values()),
        lambda motion, _: [motion.a],
    )
)
