"""Effects across a site: forces that depend on how its two flanges move against each other now."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import Any

import numpy as np

from ...base import Array
from ...components import Component, signals
from ..criteria import EDDY_CURRENT_SPEED_RATIOS, SHEAR_THINNING_SPEED_RATIOS
from .edits import AddPart, Connect, Edit, between
from .effect import Effect, Motion, Quantity, Values, both, register
from .sites import GROUND, Site

STIFFNESS = (("k", "N/m"), ("c", "N.m/rad"))
DAMPING = (("d", "N.s/m"), ("d", "N.m.s/rad"))


def across(
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


def unstretched(site: Site, values: Values) -> dict[str, float]:
    """Return the parameters of a spring that is at rest where the site is."""
    return {f"{site.mechanics.across}_rel0": site.rest, **values}


def clocked(edits: list[Edit], name: str) -> list[Edit]:
    """Return edits that also give an element the time that a run has lasted as its signal u."""
    clock = AddPart(f"{name}_clock", signals.Clock())
    return [*edits, clock, Connect((f"{name}_clock.y", f"{name}.u"))]


def _drifting(site: Site, name: str, values: Values) -> list[Edit]:
    return clocked(between(name, site.family.VariableDamper(**values), site.fixed, site.moving), name)


def _held(site: Site, name: str, element: Component) -> list[Edit]:
    """Return edits that join an element to what moves, by its support to what that moves against."""
    edits: list[Edit] = [AddPart(name, element), Connect((f"{name}.flange", site.moving))]
    return edits if site.fixed == GROUND else [*edits, Connect((f"{name}.support", site.fixed))]


def _pushed(site: Site, name: str, values: Values) -> list[Edit]:
    return _held(site, name, site.family.ConstantForce(**values))


def _brake(site: Site, values: Values) -> dict[str, float]:
    """Return the largest force of a brake, and the speed at which it has that."""
    damping, speed = values.values()
    largest = f"{site.mechanics.through}_nominal"
    return {largest: damping * speed / 2, next(name for name in values if name != "d"): speed}


def _braked(site: Site, name: str, values: Values) -> list[Edit]:
    return _held(site, name, site.family.EddyCurrentBrake(**_brake(site, values)))


def _fading(motion: Motion, shape: Values) -> list[Array]:
    (nominal,) = shape.values()
    return [motion.v / (1 + (motion.v / nominal) ** 2)]


def _thinning(motion: Motion, shape: Values) -> list[Array]:
    (v_e,) = shape.values()
    return [v_e * np.arcsinh(motion.v / v_e)]


across("viscous_damping", "Damper", both(d=DAMPING), lambda m, _: [m.v])
across(
    "quadratic_damping",
    "QuadraticDamper",
    both(c=(("c", "N.s2/m2"), ("k", "N.m.s2/rad2"))),
    lambda motion, _: [motion.v * np.abs(motion.v)],
)
across(
    "cubic_damping",
    "CubicDamper",
    both(d3=(("d3", "N.s3/m3"), ("d3", "N.m.s3/rad3"))),
    lambda motion, _: [motion.v**3],
)
across(
    "shear_thinning_damping",
    "ShearThinningDamper",
    both(d=DAMPING, v_e=(("v_e", "m/s"), ("w_e", "rad/s"), 0.0, True)),
    _thinning,
    shapes=lambda motion: [{"v_e": r * motion.speed} for r in SHEAR_THINNING_SPEED_RATIOS],
    plain={"viscous_damping": (1.0,)},
)
register(
    Effect(
        "eddy_current_damping",
        "across",
        both(d=DAMPING, v_nominal=(("v_nominal", "m/s"), ("w_nominal", "rad/s"), 0.0, True)),
        _braked,
        _fading,
        shapes=lambda motion: [{"v_nominal": r * motion.speed} for r in EDDY_CURRENT_SPEED_RATIOS],
        parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _brake(at, p).items()},
        plain={"viscous_damping": (1.0,)},
    )
)
register(
    Effect(
        "viscous_drift",
        "across",
        both(
            d=(*DAMPING, -inf),
            d_u=(("d_u", "N/m"), ("d_u", "N.m/rad"), -inf),
            d_uu=(("d_uu", "N/(m.s)"), ("d_uu", "N.m/(rad.s)"), -inf),
        ),
        _drifting,
        lambda motion, _: [motion.elapsed**n * motion.v for n in range(3)],
        ages=True,
        plain={"viscous_damping": (1.0, 0.0, 0.0)},
    )
)
across("linear_stiffness", "Spring", both(k=STIFFNESS), lambda motion, _: [motion.s], unstretched)
across(
    "cubic_stiffness",
    "CubicSpring",
    both(k3=(("k3", "N/m3"), ("c3", "N.m/rad3"), -inf)),
    lambda motion, _: [motion.s**3],
    lambda site, p: {site.mechanics.stiffness: 0.0, **unstretched(site, p)},
)
across(
    "quadratic_stiffness",
    "CubicSpring",
    both(k2=(("k2", "N/m2", -inf), ("c2", "N.m/rad2", -inf))),
    lambda motion, _: [motion.s**2],
    lambda site, p: {
        site.mechanics.stiffness: 0.0,
        f"{site.mechanics.stiffness}3": 0.0,
        **unstretched(site, p),
    },
)
across(
    "bilinear_stiffness",
    "BilinearSpring",
    both(pull=(("k_pull", "N/m"), ("c_pull", "N.m/rad")), push=(("k_push", "N/m"), ("c_push", "N.m/rad"))),
    lambda motion, _: [np.maximum(motion.s, 0), np.minimum(motion.s, 0)],
    unstretched,
    plain={"linear_stiffness": (1.0, 1.0)},
)
register(
    Effect(
        "constant_force",
        "across",
        both(f=(("f_constant", "N", -inf), ("tau_constant", "N.m", -inf))),
        _pushed,
        lambda motion, _: [-np.ones_like(motion.s)],
        displaces=True,
    )
)
across(
    "arm_gravity",
    "ArmGravity",
    {"rotational": (Quantity("tau_sin", "N.m", -inf), Quantity("tau_cos", "N.m", -inf))},
    lambda motion, _: [np.sin(motion.s), np.cos(motion.s)],
    origin=lambda site: 0.0,
    grounded=True,
    displaces=True,
)
