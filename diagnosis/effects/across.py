"""Effects across a site: forces that depend on how its two flanges move against each other."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import inf, pi
from typing import Any

import numpy as np

from ...base import Array
from ...components import signals
from .. import criteria
from .edits import AddPart, Connect, Edit, Insert, between
from .effect import Effect, Extent, Motion, Quantity, Values, both, register
from .sites import Site


def _across(
    kind: str,
    element: str,
    quantities: dict[str, tuple[Quantity, ...]],
    basis: Callable[[Motion, Values], list[Array]],
    given: Callable[[Site, Values], dict[str, float]] = lambda site, values: dict(values),
    **more: Any,
) -> None:
    """Register an effect of one element between two flanges; `given` are its parameters, of those fitted."""

    def edits(site: Site, name: str, values: Values) -> list[Edit]:
        return between(name, getattr(site.family, element)(**given(site, values)), site.fixed, site.moving)

    register(Effect(kind, "across", quantities, edits, basis, **more))


def _periods(motion: Extent) -> list[dict[str, float]]:
    counts = np.geomspace(*criteria.RIPPLES_PER_TRAVEL, criteria.RIPPLE_PERIODS)
    return [{"period": 2 * motion.travel / count} for count in counts]


def _shape(values: Values) -> float:
    return next(iter(values.values()))


def _unstretched(site: Site, values: Values) -> dict[str, float]:
    """Return the parameters of a spring that is at rest where the site is."""
    return {f"{site.mechanics.across}_rel0": site.rest, **values}


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


_across("viscous_damping", "Damper", both(d=(("d", "N.s/m"), ("d", "N.m.s/rad"))), lambda m, _: [m.v])
_across(
    "quadratic_damping",
    "QuadraticDamper",
    both(c=(("c", "N.s2/m2"), ("k", "N.m.s2/rad2"))),
    lambda motion, _: [motion.v * np.abs(motion.v)],
)
_COULOMB = (("f_c", "N"), ("tau_c", "N.m"))
_across("coulomb_friction", "CoulombFriction", both(f=_COULOMB), lambda motion, _: [motion.direction])
_across(
    "stribeck_friction",
    "StribeckFriction",
    both(
        f_c=_COULOMB, f_s=(("f_s", "N"), ("tau_s", "N.m")), v_s=(("v_s", "m/s"), ("w_s", "rad/s"), 0.0, True)
    ),
    _stribeck,
    shapes=lambda motion: [{"v_s": r * motion.speed} for r in criteria.STRIBECK_SPEED_RATIOS],
    credible=_breaks_away,
    plain=("coulomb_friction", (1.0, 1.0)),
)
_across(
    "asymmetric_friction",
    "AsymmetricFriction",
    both(
        forward=(("f_forward", "N"), ("tau_forward", "N.m")),
        backward=(("f_backward", "N"), ("tau_backward", "N.m")),
    ),
    lambda motion, _: [np.maximum(motion.direction, 0), np.minimum(motion.direction, 0)],
    plain=("coulomb_friction", (1.0, 1.0)),
)
_across(
    "position_ripple",
    "Ripple",
    both(
        f_sin=(("f_sin", "N"), ("tau_sin", "N.m"), -inf),
        f_cos=(("f_cos", "N"), ("tau_cos", "N.m"), -inf),
        period=(("period", "m"), ("period", "rad"), 0.0, True),
    ),
    _ripple,
    shapes=_periods,
    absolute=True,
)
_STIFFNESS = (("k", "N/m"), ("c", "N.m/rad"))
_across("linear_stiffness", "Spring", both(k=_STIFFNESS), lambda motion, _: [motion.s], _unstretched)
_across(
    "cubic_stiffness",
    "CubicSpring",
    both(k3=(("k3", "N/m3"), ("c3", "N.m/rad3"), -inf)),
    lambda motion, _: [motion.s**3],
    lambda site, p: {site.mechanics.stiffness: 0.0, **_unstretched(site, p)},
)
_across(
    "bilinear_stiffness",
    "BilinearSpring",
    both(pull=(("k_pull", "N/m"), ("c_pull", "N.m/rad")), push=(("k_push", "N/m"), ("c_push", "N.m/rad"))),
    lambda motion, _: [np.maximum(motion.s, 0), np.minimum(motion.s, 0)],
    _unstretched,
    plain=("linear_stiffness", (1.0, 1.0)),
)


def _bouc_wen(site: Site, p: Values) -> dict[str, float]:
    """Return what is fitted of a Bouc-Wen element, its reach told by beta and gamma."""
    stiffness, reach = site.mechanics.stiffness, p[f"{site.mechanics.across}_y"]
    return {stiffness: p[stiffness], "beta": 0.5 / reach**2, "gamma": 0.5 / reach**2}


_across(
    "hysteresis",
    "BoucWen",
    both(k=_STIFFNESS, s_y=(("s_y", "m"), ("phi_y", "rad"), 0.0, True)),
    _hysteresis,
    lambda site, p: {**_bouc_wen(site, p), "alpha": 0.0, "n": 2.0},
    shapes=lambda motion: [{"s_y": r * motion.travel} for r in criteria.YIELD_TRAVEL_RATIOS],
    parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _bouc_wen(at, p).items()},
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
        AddPart(f"{name}_clock", signals.Clock()),
        Connect((f"{name}_clock.y", f"{name}.u")),
    ]


register(
    Effect(
        "load_dependent_friction",
        "loaded",
        both(mu=(("mu", "1"), ("mu", "1"))),
        _loaded,
        lambda motion, _: [np.abs(motion.f) * motion.direction],
    )
)
register(
    Effect(
        "friction_drift",
        "across",
        both(f_c=(*_COULOMB, -inf), f_u=(("f_u", "N/s"), ("tau_u", "N.m/s"), -inf)),
        _drifting,
        lambda motion, _: [motion.direction, motion.t * motion.direction],
        plain=("coulomb_friction", (1.0, 0.0)),
    )
)
