"""Closed forms of tuning: what the literature gives for absorbers and the quarter car."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from ...base import ModelError, above, between, demand

LARGEST_NUMBER = 1e60  # whose powers are numbers, too


@dataclass(frozen=True)
class Tuning:
    """How an absorber is tuned: frequency over that of the structure, and damping ratio of the absorber."""

    f: float
    zeta: float

    def stiffness(self, inertia: float, w: float) -> float:
        """Return k = inertia (f w)^2 [N/m], for an absorber of that mass or inertance [kg], w in rad/s."""
        _check_all(inertia=inertia, w=w)
        return inertia * (self.f * w) ** 2

    def damping(self, inertia: float, w: float) -> float:
        """Return d = 2 zeta inertia f w [N.s/m]."""
        _check_all(inertia=inertia, w=w)
        return 2 * self.zeta * inertia * self.f * w


def den_hartog(mu: float) -> Tuning:
    """Return the tuning of a TMD, or of a grounded TID with mu = b/m, for a force on the structure.

    f = 1/(1 + mu), zeta = sqrt(3 mu/(8 (1 + mu))): equal heights sqrt(1 + 2/mu) at the fixed points.

    Source: J. P. Den Hartog, Mechanical Vibrations, 4th ed. (1956), section 3.3.
    """
    _check_all(mu=mu)
    return Tuning(1 / (1 + mu), sqrt(3 * mu / (8 * (1 + mu))))


def tmdi_white_base(beta: float, mu: float) -> Tuning:
    """Return the tuning of a TMDI for white base acceleration of an undamped structure.

    f = 1/(1 + beta + mu) sqrt((beta (1 - mu) + (2 - mu)(1 + mu))/(2 (1 + mu))),
    zeta = 1/2 sqrt((beta + mu)(beta (3 - mu) + (4 - mu)(1 + mu))
           / (2 (1 + beta + mu)(beta (1 - mu) + (2 - mu)(1 + mu)))), of the inertia m + b.

    Args:
        beta: inertance over mass of the structure.
        mu: mass of the absorber over mass of the structure.

    Source: Marian & Giaralis, Probabilistic Engineering Mechanics 38 (2014) 156-164.
    """
    share = between(0, LARGEST_NUMBER)
    demand("tmdi_white_base()", beta=(beta, share), mu=(mu, share))
    _check_all(**{"beta + mu": beta + mu})
    inner = beta * (1 - mu) + (2 - mu) * (1 + mu)
    f = sqrt(inner / (2 * (1 + mu))) / (1 + beta + mu)
    above = (beta + mu) * (beta * (3 - mu) + (4 - mu) * (1 + mu))
    return Tuning(f, sqrt(above / (2 * (1 + beta + mu) * inner)) / 2)


def tvmd_fixed_points(mu: float) -> Tuning:
    """Return the tuning of a TVMD by fixed points, for the displacement relative to a moving ground.

    f = (1 - sqrt(1 - 4 mu))/(2 mu), zeta = sqrt(3 (1 - sqrt(1 - 4 mu)))/4, mu = b/m below 1/4.

    Source: Ikago, Saito & Inoue, Earthquake Eng. Struct. Dyn. 41 (2012) 453-474.
    """
    _check_all(mu=mu)
    if not mu < 0.25:
        raise ModelError(f"a TVMD has fixed points for mu between 0 and 0.25, got {mu:g}")
    root = sqrt(1 - 4 * mu)
    return Tuning((1 - root) / (2 * mu), sqrt(3 * (1 - root)) / 4)


def quarter_car_damping(k: float, m_s: float, m_u: float, k_t: float) -> float:
    """Return the damping constant that minimises J1 with a spring: d = k sqrt((m_s + m_u)/k_t) [N.s/m].

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257.
    """
    _check_all(k=k, m_s=m_s, m_u=m_u, k_t=k_t)
    return k * sqrt((m_s + m_u) / k_t)


def quarter_car_j1(
    k: float, m_s: float, m_u: float, k_t: float, V: float = 25.0, kappa: float = 5e-7
) -> float:
    """Return the least J1 of spring and damper: 2 pi sqrt(V kappa) sqrt(k) (k_t (m_s + m_u))^(1/4)/m_s."""
    _check_all(k=k, m_s=m_s, m_u=m_u, k_t=k_t, V=V, kappa=kappa)
    return 2 * pi * sqrt(V * kappa) * sqrt(k) * sqrt(sqrt(k_t * (m_s + m_u))) / m_s


def _check_all(**values: float) -> None:
    """Check that numbers are above 0, and such that their powers are numbers, too."""
    for check in (above(0), between(0, LARGEST_NUMBER)):
        demand("this formula", **{name: (value, check) for name, value in values.items()})
