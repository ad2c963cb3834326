"""Effects of dry friction across a site."""

from __future__ import annotations

from math import inf

import numpy as np

from ...base import Array
from .. import criteria
from .across import across, clocked
from .edits import Connect, Edit, Insert, between
from .effect import Effect, Motion, Values, both, register
from .sites import Site

COULOMB = (("f_c", "N"), ("tau_c", "N.m"))


def _stribeck(motion: Motion, shape: Values) -> list[Array]:
    fading = np.exp(-np.abs(motion.v) / next(iter(shape.values())))
    return [motion.direction * (1 - fading), motion.direction * fading]


def _waves(motion: Motion, shape: Values) -> list[Array]:
    at = 2 * np.pi * motion.s / next(iter(shape.values()))
    return [motion.direction * level for level in (1.0, np.cos(at), np.sin(at))]


def breaks_away(values: Values) -> bool:
    """Tell whether friction falls with speed; what rises from rest is no Stribeck effect."""
    sliding, static, *_ = values.values()
    return static >= sliding


def _leaning(values: Values) -> list[dict[str, float]]:
    """Return friction that differs a little by direction, both ways: where it does not, runs are a ridge."""
    (one, forward), (other, backward) = values.items()
    leans = criteria.LEAN_OF_START, -criteria.LEAN_OF_START
    return [{one: (1 + lean) * forward, other: (1 - lean) * backward} for lean in leans]


def _smooth(site: Site) -> dict[str, float]:
    """Return what keeps friction from sticking."""
    return {"regularised": criteria.REVERSAL_SPEED_RATIO * site.speed}


def _beside(site: Site) -> dict[str, float]:
    """Return what lets a level of friction be negative, where it stands beside friction that is there."""
    return _smooth(site) if site.rubs else {}


def _loaded(site: Site, name: str, values: Values) -> list[Edit]:
    """Return friction by a force that arrives at a site, not by what friction leaves of it.

    It arrives from what is joined to the site, or through `load`, which may be the site's own flange.
    """
    friction = site.family.LoadedFriction(**_smooth(site), **values)
    beside = {"": f"{name}_load.flange_a", site.moving: f"{name}_load.flange_b"}
    moving = beside.get(site.load, site.moving)
    return [
        Insert(site.load or site.moving, f"{name}_load", site.family.ForceSensor()),
        *between(name, friction, site.fixed, moving),
        Connect((f"{name}_load.{site.mechanics.through}", f"{name}.load")),
    ]


def _drifting(site: Site, name: str, values: Values) -> list[Edit]:
    friction = site.family.DriftingFriction(**_beside(site), **values)
    return clocked(between(name, friction, site.fixed, site.moving), name)


across("coulomb_friction", "CoulombFriction", both(f=COULOMB), lambda motion, _: [motion.direction])
across(
    "stribeck_friction",
    "StribeckFriction",
    both(
        f_c=COULOMB, f_s=(("f_s", "N"), ("tau_s", "N.m")), v_s=(("v_s", "m/s"), ("w_s", "rad/s"), 0.0, True)
    ),
    _stribeck,
    shapes=lambda motion: [{"v_s": r * motion.speed} for r in criteria.STRIBECK_SPEED_RATIOS],
    credible=breaks_away,
    plain={"coulomb_friction": (1.0, 1.0)},
)
across(
    "asymmetric_friction",
    "AsymmetricFriction",
    both(
        forward=(("f_forward", "N"), ("tau_forward", "N.m")),
        backward=(("f_backward", "N"), ("tau_backward", "N.m")),
    ),
    lambda motion, _: [np.maximum(motion.direction, 0), np.minimum(motion.direction, 0)],
    plain={"coulomb_friction": (1.0, 1.0)},
    likewise=_leaning,
)
across(
    "position_dependent_friction",
    "PositionDependentFriction",
    both(
        f_c=(*COULOMB, -inf),
        f_cos=(("f_cos", "N"), ("tau_cos", "N.m"), -inf),
        f_sin=(("f_sin", "N"), ("tau_sin", "N.m"), -inf),
        period=(("period", "m"), ("period", "rad"), 0.0, True),
    ),
    _waves,
    lambda site, p: {f"{site.mechanics.across}_rel0": site.middle, **_beside(site), **p},
    shapes=lambda motion: [{"period": r * motion.travel} for r in criteria.FRICTION_PERIOD_RATIOS],
    origin=lambda site: site.middle,
    plain={"coulomb_friction": (1.0, 0.0, 0.0)},
)
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
        both(
            f_c=(*COULOMB, -inf),
            f_u=(("f_u", "N/s"), ("tau_u", "N.m/s"), -inf),
            f_uu=(("f_uu", "N/s2"), ("tau_uu", "N.m/s2"), -inf),
        ),
        _drifting,
        lambda motion, _: [motion.elapsed**n * motion.direction for n in range(3)],
        ages=True,
        plain={"coulomb_friction": (1.0, 0.0, 0.0)},
    )
)
