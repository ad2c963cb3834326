"""Effects across a site that remember how it moved: hysteresis, friction before it slips, relaxation."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise, product

import numpy as np

from ...base import Array
from ...components.iwan import CELL_SHARPNESS, CELLS, yields_of
from .. import criteria
from .across import DAMPING, STIFFNESS, across, unstretched
from .dry_friction import COULOMB, breaks_away
from .effect import Motion, Values, both
from .sites import Site

NEAREST_YIELD = 20.0  # ln of what a hysteretic force may miss of its limit, relative to it, as tabulated


def _along(s: Array, law: Callable[[Array, Array, float], Array], cells: int = 1) -> Array:
    """Return what a law makes of a motion, stroke by stroke, a row a point and a column a cell.

    Args:
        s: distance, which turns between strokes.
        law: (values at the turn, distance since then in a column, direction) -> values along the stroke.
        cells: how many there are.
    """
    z = np.zeros((len(s), cells))
    turns = np.flatnonzero(np.diff(np.sign(np.diff(s))) != 0) + 1
    for begin, end in pairwise([0, *turns.tolist(), len(s) - 1]):
        stroke = s[begin + 1 : end + 1] - s[begin]
        moves = len(stroke) > 0 and stroke[-1] != 0.0  # not at rest, nor at an event, which is two points
        way = np.sign(stroke[-1]) if moves else 0.0
        z[begin + 1 : end + 1] = law(z[begin], np.abs(stroke)[:, None], way) if moves else z[begin]
    return z


@lru_cache
def _loading(n: float) -> tuple[Array, Array]:
    """Return x and u of the curve u' = 1 - u^n from rest, by which a Bouc-Wen element is loaded."""
    w = np.linspace(0.0, NEAREST_YIELD, 801)
    u = -np.expm1(-w)
    rate = (1 - u) / (1 - u**n)
    x = np.concatenate([[0.0], np.cumsum(np.diff(w) * (rate[1:] + rate[:-1]) / 2)])
    return x, u


def _yielded(motion: Motion, yields: Array, n: float) -> Array:
    """Return the hysteretic displacements of Bouc-Wen elements, a column for each that yields at s_y.

    Along a stroke z falls to zero as far as s moves, and rises from zero with z' = 1 - (z/s_y)^n.
    """
    x, u = _loading(n)

    def stroke(start: Array, moved: Array, way: float) -> Array:
        first = way * start / yields
        at = moved / yields + np.where(first > 0, np.interp(first, u, x), first)
        return np.asarray(way * yields * np.where(at > 0, np.interp(at, x, u), at))

    return _along(motion.s, stroke, len(yields))


def _hysteresis(motion: Motion, shape: Values) -> list[Array]:
    """Return the hysteretic displacement of a Bouc-Wen element."""
    s_y, n = shape.values()
    return [_yielded(motion, np.array([s_y]), n)[:, 0]]


def _iwan(motion: Motion, shape: Values) -> list[Array]:
    """Return the mean of what its cells are stretched."""
    s_y, p = shape.values()
    return [_yielded(motion, np.array(yields_of(s_y, p, CELLS)), CELL_SHARPNESS).mean(axis=1)]


def _dahl(motion: Motion, shape: Values) -> list[Array]:
    """Return the share of friction that has built up: it nears its end as exp(-s/s_p)."""
    (s_p,) = shape.values()
    return [_along(motion.s, lambda start, moved, way: way - (way - start) * np.exp(-moved / s_p))[:, 0]]


def _bristles(motion: Motion, shape: Values) -> list[Array]:
    """Return what LuGre's bristles bear of either level: they build up, and give way as they slip faster."""
    speed, travel = shape.values()
    fading = np.exp(-((motion.v / speed) ** 2))
    (built,) = _dahl(motion, {"s_p": travel})
    return [built * (1 - fading), built * fading]


def _lugre(p: Values) -> dict[str, float]:
    """Return what is fitted of bristles: at break-away they have bent by the last of these."""
    sliding, static, speed, travel = p.items()
    return dict((sliding, static, speed)) | {"sigma_0": static[1] / travel[1]}


def _relaxing(motion: Motion, shape: Values) -> list[Array]:
    """Return the speed of a damper that a spring, in series with it, lets follow in a time T.

    It is exact where the distance is straight between points.
    """
    (T,) = shape.values()
    step = np.diff(motion.t)
    kept = np.exp(-step / T)
    gained = np.where(step > 0, T / np.where(step > 0, step, 1.0) * -np.expm1(-step / T), 1.0) * np.diff(
        motion.s
    )
    found = [float(motion.s[0])]
    for keep, gain in zip(kept.tolist(), gained.tolist(), strict=True):
        found.append(keep * found[-1] + gain)
    return [np.array(found) / T]


def _branch(site: Site, p: Values) -> dict[str, float]:
    """Return stiffness and time of a spring in series with a damper."""
    return {site.mechanics.stiffness: p["d"] / p["T"], "T": p["T"]}


def _bouc_wen(site: Site, p: Values) -> dict[str, float]:
    """Return what is fitted of a Bouc-Wen element, its reach told by beta and gamma."""
    stiffness, n = site.mechanics.stiffness, p["n"]
    loop = 0.5 / p[f"{site.mechanics.across}_y"] ** n
    return {stiffness: p[stiffness], "beta": loop, "gamma": loop, "n": n}


across(
    "presliding_friction",
    "DahlFriction",
    both(f_c=COULOMB, s_p=(("s_p", "m"), ("phi_p", "rad"), 0.0, True)),
    _dahl,
    shapes=lambda motion: [{"s_p": r * motion.travel} for r in criteria.PRESLIDING_TRAVEL_RATIOS],
    memory=True,
    plain={"coulomb_friction": (1.0,)},
)
across(
    "lugre_friction",
    "LuGreFriction",
    both(
        f_c=(*COULOMB, criteria.LEAST_FRICTION),
        f_s=(("f_s", "N"), ("tau_s", "N.m"), criteria.LEAST_FRICTION),
        v_s=(("v_s", "m/s"), ("w_s", "rad/s"), 0.0, True),
        s_p=(("s_p", "m"), ("phi_p", "rad"), 0.0, True),
    ),
    _bristles,
    lambda site, p: _lugre(p),
    shapes=lambda motion: [
        {"v_s": v * motion.speed, "s_p": s * motion.travel}
        for v, s in product(criteria.STRIBECK_SPEED_RATIOS, criteria.PRESLIDING_TRAVEL_RATIOS)
    ],
    parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _lugre(p).items()},
    memory=True,
    credible=breaks_away,
    plain={
        "presliding_friction": (1.0, 1.0),
        "stribeck_friction": ((1.0, 0.0), (0.0, 1.0)),
        "coulomb_friction": (1.0, 1.0),
    },
)
across(
    "hysteresis",
    "BoucWen",
    both(k=STIFFNESS, s_y=(("s_y", "m"), ("phi_y", "rad"), 0.0, True), n=(("n", "1"), ("n", "1"), 1.0, True)),
    _hysteresis,
    lambda site, p: {**_bouc_wen(site, p), "alpha": 0.0},
    shapes=lambda motion: [
        {"s_y": r * motion.travel, "n": n}
        for r, n in product(criteria.YIELD_TRAVEL_RATIOS, criteria.YIELD_EXPONENTS)
    ],
    parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _bouc_wen(at, p).items()},
    memory=True,
)
across(
    "iwan_hysteresis",
    "Iwan",
    both(k=STIFFNESS, s_y=(("s_y", "m"), ("phi_y", "rad"), 0.0, True), p=(("p", "1"), ("p", "1"), 0.0, True)),
    _iwan,
    shapes=lambda motion: [
        {"s_y": r * motion.travel, "p": p}
        for r, p in product(criteria.SLIP_TRAVEL_RATIOS, criteria.SLIP_SPREADS)
    ],
    memory=True,
)
across(
    "relaxation",
    "RelaxingSpring",
    both(d=DAMPING, T=(("T", "s"), ("T", "s"), 0.0, True)),
    _relaxing,
    lambda site, p: unstretched(site, _branch(site, p)),
    shapes=lambda motion: [
        {"T": r * motion.travel / motion.speed} for r in criteria.RELAXATION_PERIOD_RATIOS
    ],
    parameters=lambda at, name, p: {f"{name}.{key}": v for key, v in _branch(at, p).items()},
    memory=True,
    plain={"viscous_damping": (1.0,)},
)
