"""Effects across a site: forces that depend on how its two flanges move against each other."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import inf, pi
from typing import Any

import numpy as np

from ...base import Array
from ...components import Component, signals
from .. import criteria
from .edits import Add, Connect, Edit, Insert, between
from .effect import Effect, Extent, Motion, Quantity, Values, both, register
from .sites import Site

Maker = Callable[[Site, Values], Component]


def _across(
    kind: str,
    quantities: dict[str, tuple[Quantity, ...]],
    make: Maker,
    basis: Callable[[Motion, Values], list[Array]],
    **more: Any,
) -> Effect:
    def edits(site: Site, name: str, values: Values) -> list[Edit]:
        return between(name, make(site, values), site.fixed, site.moving)

    return register(Effect(kind, "across", quantities, edits, basis, **more))


def _speeds(motion: Extent) -> list[dict[str, float]]:
    return [{"v_s": share * motion.speed} for share in criteria.STRIBECK_SPEED_RATIOS]


def _periods(motion: Extent) -> list[dict[str, float]]:
    return [
        {"period": 2 * motion.travel / count}
        for count in np.geomspace(*criteria.RIPPLES_PER_TRAVEL, criteria.RIPPLE_PERIODS)
    ]


def _yields(motion: Extent) -> list[dict[str, float]]:
    return [{"s_y": share * motion.travel} for share in criteria.YIELD_TRAVEL_RATIOS]


def _shape(values: Values) -> float:
    return next(iter(values.values()))


def _unstretched(site: Site) -> dict[str, float]:
    return {f"{site.mechanics.across}_rel0": site.rest}


def _stribeck(motion: Motion, shape: Values) -> list[Array]:
    fading = np.exp(-np.abs(motion.v) / _shape(shape))
    return [motion.direction * (1 - fading), motion.direction * fading]


def _breaks_away(values: Values) -> bool:
    """Tell whether friction falls with speed; what rises from rest is no Stribeck effect."""
    sliding, static, _ = values.values()
    return static >= sliding


def _ripple(motion: Motion, shape: Values) -> list[Array]:
    angle = 2 * pi * motion.s / shape["period"]
    return [np.sin(angle), np.cos(angle)]


def _hysteresis(motion: Motion, shape: Values) -> list[Array]:
    """Return the hysteretic displacement of a Bouc-Wen element (n = 2) that yields at s_y, stroke by stroke.

    Along a stroke z falls to zero as far as s moves, and rises from zero as s_y tanh(s/s_y).
    """
    s_y, s, z = _shape(shape), motion.s, np.zeros(len(motion.s))
    turns = np.flatnonzero(np.diff(np.sign(np.diff(s))) != 0) + 1
    for begin, end in pairwise([0, *turns.tolist(), len(s) - 1]):
        stroke = s[begin + 1 : end + 1] - s[begin]
        way = np.sign(stroke[-1]) if len(stroke) else 0.0
        first = way * z[begin] / s_y
        rising = np.arctanh(min(first, 1 - 1e-12)) if first > 0 else first
        moved = rising + np.abs(stroke) / s_y
        z[begin + 1 : end + 1] = way * s_y * np.where(moved > 0, np.tanh(moved), moved)
    return [z]


VISCOUS = _across(
    "viscous_damping",
    both(d=(("d", "N.s/m"), ("d", "N.m.s/rad"))),
    lambda at, p: at.family.Damper(**p),
    lambda motion, _: [motion.v],
)
QUADRATIC = _across(
    "quadratic_damping",
    both(c=(("c", "N.s2/m2"), ("k", "N.m.s2/rad2"))),
    lambda at, p: at.family.QuadraticDamper(**p),
    lambda motion, _: [motion.v * np.abs(motion.v)],
)
COULOMB = _across(
    "coulomb_friction",
    both(f=(("f_c", "N"), ("tau_c", "N.m"))),
    lambda at, p: at.family.CoulombFriction(**p),
    lambda motion, _: [motion.direction],
)
STRIBECK = _across(
    "stribeck_friction",
    both(
        f_c=(("f_c", "N"), ("tau_c", "N.m")),
        f_s=(("f_s", "N"), ("tau_s", "N.m")),
        v_s=(("v_s", "m/s"), ("w_s", "rad/s"), 0.0, True),
    ),
    lambda at, p: at.family.StribeckFriction(**p),
    _stribeck,
    shapes=_speeds,
    credible=_breaks_away,
    plain=("coulomb_friction", (1.0, 1.0)),
)
ASYMMETRIC = _across(
    "asymmetric_friction",
    both(
        forward=(("f_forward", "N"), ("tau_forward", "N.m")),
        backward=(("f_backward", "N"), ("tau_backward", "N.m")),
    ),
    lambda at, p: at.family.AsymmetricFriction(**p),
    lambda motion, _: [np.maximum(motion.direction, 0), np.minimum(motion.direction, 0)],
    plain=("coulomb_friction", (1.0, 1.0)),
)
RIPPLE = _across(
    "position_ripple",
    both(
        f_sin=(("f_sin", "N"), ("tau_sin", "N.m"), -inf),
        f_cos=(("f_cos", "N"), ("tau_cos", "N.m"), -inf),
        period=(("period", "m"), ("period", "rad"), 0.0, True),
    ),
    lambda at, p: at.family.Ripple(**p),
    _ripple,
    shapes=_periods,
    absolute=True,
)
LINEAR = _across(
    "linear_stiffness",
    both(k=(("k", "N/m"), ("c", "N.m/rad"))),
    lambda at, p: at.family.Spring(**_unstretched(at), **p),
    lambda motion, _: [motion.s],
)
CUBIC = _across(
    "cubic_stiffness",
    both(k3=(("k3", "N/m3"), ("c3", "N.m/rad3"), -inf)),
    lambda at, p: at.family.CubicSpring(**{at.mechanics.stiffness: 0.0}, **_unstretched(at), **p),
    lambda motion, _: [motion.s**3],
)
BILINEAR = _across(
    "bilinear_stiffness",
    both(
        pull=(("k_pull", "N/m"), ("c_pull", "N.m/rad")),
        push=(("k_push", "N/m"), ("c_push", "N.m/rad")),
    ),
    lambda at, p: at.family.BilinearSpring(**_unstretched(at), **p),
    lambda motion, _: [np.maximum(motion.s, 0), np.minimum(motion.s, 0)],
    plain=("linear_stiffness", (1.0, 1.0)),
)


def _bouc_wen_values(site: Site, p: Values) -> dict[str, float]:
    stiffness, reach = site.mechanics.stiffness, p[f"{site.mechanics.across}_y"]
    return {stiffness: p[stiffness], "beta": 0.5 / reach**2, "gamma": 0.5 / reach**2}


HYSTERESIS = _across(
    "hysteresis",
    both(k=(("k", "N/m"), ("c", "N.m/rad")), s_y=(("s_y", "m"), ("phi_y", "rad"), 0.0, True)),
    lambda at, p: at.family.BoucWen(**_bouc_wen_values(at, p), alpha=0.0, n=2.0),
    _hysteresis,
    shapes=_yields,
    parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _bouc_wen_values(at, p).items()},
    memory=True,
)


def _loaded(site: Site, name: str, values: Values) -> list[Edit]:
    """Return friction by the force that arrives at a site, not by what friction leaves of it."""
    friction = site.family.LoadedFriction(regularised=criteria.REVERSAL_SPEED_RATIO * site.speed, **values)
    return [
        Insert(site.moving, f"{name}_load", site.family.ForceSensor()),
        *between(name, friction, site.fixed, f"{name}_load.flange_a"),
        Connect((f"{name}_load.{site.mechanics.through}", f"{name}.load")),
    ]


def _drifting(site: Site, name: str, values: Values) -> list[Edit]:
    friction = site.family.DriftingFriction(regularised=criteria.REVERSAL_SPEED_RATIO * site.speed, **values)
    return [
        *between(name, friction, site.fixed, site.moving),
        Add(f"{name}_clock", signals.Clock()),
        Connect((f"{name}_clock.y", f"{name}.u")),
    ]


LOADED = register(
    Effect(
        "load_dependent_friction",
        "loaded",
        both(mu=(("mu", "1"), ("mu", "1"))),
        _loaded,
        lambda motion, _: [np.abs(motion.f) * motion.direction],
    )
)
DRIFT = register(
    Effect(
        "friction_drift",
        "across",
        both(
            f_c=(("f_c", "N"), ("tau_c", "N.m"), -inf),
            f_u=(("f_u", "N/s"), ("tau_u", "N.m/s"), -inf),
        ),
        _drifting,
        lambda motion, _: [motion.direction, motion.t * motion.direction],
        plain=("coulomb_friction", (1.0, 0.0)),
    )
)
