"""Vehicles on a road: a quarter, a half and a full car, a seat in a cab."""

from __future__ import annotations

from typing import Any

from ...components import Force, Mass, Position, Spring, SpringDamper
from ...components.language import Component, Stated, TranslationalFlange, der, energy, parameter, variable
from ..given import element_of
from ..network import Network


def quarter_car(strut: Component, *, m_s: float = 250.0, m_u: float = 35.0, k_t: float = 150e3) -> Network:
    """Return a body on a strut on a wheel on a tyre: `road`, `tyre`, `wheel`, `strut`, `body`, `load`.

    Args:
        strut: with two flanges, such as `suspension("S4", ...)`.
        m_s: mass of the body, sprung [kg].
        m_u: mass of the wheel, unsprung [kg].
        k_t: stiffness of the tyre [N/m].

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257, section 3.
    """
    car, body, load = Network("quarter car"), Mass(m=m_s), Force(f=0.0)
    add_corner(car, "", strut, body.flange, m_u, k_t)
    return car.add(body=body, load=load).connect(body.flange, load.flange)


class _HeavingBody(Component):
    m = parameter("kg", "mass", above=0)
    l_f = parameter("m", "from the centre of mass to the front axle", above=0)
    l_r = parameter("m", "from the centre of mass to the rear axle", above=0)
    s = variable("m", "height of the centre of mass", state="prefer")
    v = variable("m/s", "velocity of the centre of mass", state="prefer")
    a = variable("m/s2", "acceleration of the centre of mass")
    theta = variable("rad", "pitch", state="prefer")
    q = variable("rad/s", "pitch rate", state="prefer")

    def equations(self) -> Stated:
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.q == der(self.theta)


class PitchingBody(_HeavingBody):
    """A rigid body that heaves and pitches: m a = f_f + f_r + f_c, J alpha = l_r f_r - l_f f_f; small angles.

    Seen from the side with the nose at the front flange, theta > 0 lifts the tail. f_c acts on its centre.
    """

    front = TranslationalFlange("front axle", free=True)
    rear = TranslationalFlange("rear axle", free=True)
    centre = TranslationalFlange("centre of mass", free=True)
    J = parameter("kg.m2", "moment of inertia in pitch", above=0)
    kinetic = energy(lambda self: (self.m * self.v**2 + self.J * self.q**2) / 2)

    def equations(self) -> Stated:
        yield self.front.s == self.s - self.l_f * self.theta
        yield self.rear.s == self.s + self.l_r * self.theta
        yield self.centre.s == self.s
        yield self.m * self.a == self.front.f + self.rear.f + self.centre.f
        yield self.J * der(self.q) == self.l_r * self.rear.f - self.l_f * self.front.f


def half_car(
    front: Component,
    rear: Component,
    *,
    m: float = 500.0,
    J: float = 750.0,
    l_f: float = 1.2,
    l_r: float = 1.5,
    m_u: float = 35.0,
    k_t: float = 150e3,
) -> Network:
    """Return a body that pitches on two axles: `body`, `front_road`, `front_tyre`, `front_wheel`, `front` ...

    Args:
        front: strut with two flanges.
        rear: strut with two flanges.
        m: mass of the body [kg].
        J: its moment of inertia in pitch [kg.m2].
        l_f: from its centre of mass to the front axle [m].
        l_r: from its centre of mass to the rear axle [m].
        m_u: mass of each wheel [kg].
        k_t: stiffness of each tyre [N/m].
    """
    car = Network("half car", body=PitchingBody(m=m, J=J, l_f=l_f, l_r=l_r))
    for axle, strut in (("front", front), ("rear", rear)):
        add_corner(car, axle, strut, getattr(car.body, axle), m_u, k_t)
    return car


class RigidBody(_HeavingBody):
    """A rigid body on four corners that heaves, pitches and rolls; small angles.

        m a = sum f,   J_y alpha = sum of -x f,   J_x beta = sum of y f,   s_corner = s - x theta + y phi

    x is forward, y to the left: corners at (l_f, w/2), (l_f, -w/2), (-l_r, w/2), (-l_r, -w/2).
    """

    front_left = TranslationalFlange("front left corner", free=True)
    front_right = TranslationalFlange("front right corner", free=True)
    rear_left = TranslationalFlange("rear left corner", free=True)
    rear_right = TranslationalFlange("rear right corner", free=True)
    J_x = parameter("kg.m2", "moment of inertia in roll", above=0)
    J_y = parameter("kg.m2", "moment of inertia in pitch", above=0)
    w = parameter("m", "track", above=0)
    phi = variable("rad", "roll", state="prefer")
    p = variable("rad/s", "roll rate", state="prefer")
    kinetic = energy(lambda self: (self.m * self.v**2 + self.J_y * self.q**2 + self.J_x * self.p**2) / 2)

    def equations(self) -> Stated:
        half = self.w / 2
        corners = (
            (self.front_left, self.l_f, half),
            (self.front_right, self.l_f, -half),
            (self.rear_left, -self.l_r, half),
            (self.rear_right, -self.l_r, -half),
        )
        yield self.p == der(self.phi)
        for corner, x, y in corners:
            yield corner.s == self.s - x * self.theta + y * self.phi
        yield self.m * self.a == sum(corner.f for corner, _, _ in corners)
        yield self.J_y * der(self.q) == -sum(x * corner.f for corner, x, _ in corners)
        yield self.J_x * der(self.p) == sum(y * corner.f for corner, _, y in corners)


def full_car(
    front: Component,
    rear: Component,
    *,
    m: float = 1600.0,
    J_x: float = 450.0,
    J_y: float = 1000.0,
    l_f: float = 1.15,
    l_r: float = 1.35,
    w: float = 1.4,
    m_uf: float = 50.0,
    m_ur: float = 50.0,
    k_t: float = 250e3,
) -> Network:
    """Return a body on four wheels, seven degrees of freedom: `front_left_road`, ..., `rear_right`, `body`.

    Args:
        front: strut of the front left wheel; the right one is a copy.
        rear: strut of the rear left wheel; the right one is a copy.
        m: mass of the body [kg].
        J_x: its moment of inertia in roll [kg.m2].
        J_y: its moment of inertia in pitch [kg.m2].
        l_f: from its centre of mass to the front axle [m].
        l_r: from its centre of mass to the rear axle [m].
        w: track [m].
        m_uf: mass of a front wheel [kg].
        m_ur: mass of a rear wheel [kg].
        k_t: stiffness of each tyre [N/m].
    """
    car = Network("full car", body=RigidBody(m=m, J_x=J_x, J_y=J_y, l_f=l_f, l_r=l_r, w=w))
    for axle, strut, m_u in (("front", front, m_uf), ("rear", rear, m_ur)):
        for side in ("left", "right"):
            corner = f"{axle}_{side}"
            add_corner(car, corner, element_of(strut).clone(), getattr(car.body, corner), m_u, k_t)
    return car


def add_corner(car: Network, name: str, strut: Component, corner: Any, m_u: float, k_t: float) -> None:
    """Add road, tyre, wheel and strut below a corner of a body."""
    road, tyre, wheel = Position(s_ref=0.0), Spring(k=k_t), Mass(m=m_u)
    prefix = f"{name}_" if name else ""
    car.add(**{f"{prefix}road": road, f"{prefix}tyre": tyre, f"{prefix}wheel": wheel, name or "strut": strut})
    car.connect(road.flange, tyre.flange_a)
    car.connect(tyre.flange_b, wheel.flange, strut.flange_a)
    car.connect(strut.flange_b, corner)


def seat_in_cab(
    seat: Component,
    mount: Component,
    *,
    m_cab: float = 600.0,
    m_seat: float = 25.0,
    m_driver: float = 60.0,
    cushion: Component | None = None,
) -> Network:
    """Return a driver on a cushion on a suspended seat in a suspended cab: `frame` ... `driver`.

    Args:
        seat: suspension of the seat, with two flanges.
        mount: suspension of the cab, with two flanges.
        m_cab: mass of the cab [kg].
        m_seat: mass of the seat [kg].
        m_driver: mass of the driver on it [kg].
        cushion: between seat and driver; 80 kN/m and 1.5 kN.s/m if None.
    """
    cushion = SpringDamper(k=80e3, d=1500.0) if cushion is None else element_of(cushion)
    cab = Network(
        "seat in cab", frame=Position(s_ref=0.0), mount=mount, cab=Mass(m=m_cab), seat=seat,
        pan=Mass(m=m_seat), cushion=cushion, driver=Mass(m=m_driver),
    )  # fmt: skip
    cab.connect(cab.frame.flange, cab.mount.flange_a)
    cab.connect(cab.mount.flange_b, cab.cab.flange, cab.seat.flange_a)
    cab.connect(cab.seat.flange_b, cab.pan.flange, cab.cushion.flange_a)
    return cab.connect(cab.cushion.flange_b, cab.driver.flange)
