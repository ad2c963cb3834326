"""What unbalance shakes: a vibrating sieve, a machine on its foundation."""

from __future__ import annotations

from math import sqrt

import casadi as ca

from ...base import above, between, demand
from ...components import Component, Fixed, Mass, SpringDamper, rotational
from ...components.language import (
    RotationalFlange,
    Stated,
    TranslationalFlange,
    der,
    energy,
    parameter,
    variable,
)
from ..network import Network

MOST = 1e60  # of what is squared


class Unbalance(Component):
    """A rotor whose mass lies off its axis, in a housing that slides: a pair that turns oppositely as one.

        f = m (a + e (alpha cos phi - w^2 sin phi)),   tau = m e (a cos phi + e alpha)

    phi = 0 is across the motion. m e^2 is its inertia about the axis; power is conserved, so that the drive
    feels the vibration.

    Limits: gravity is left out.
    """

    flange = TranslationalFlange("housing")
    shaft = RotationalFlange("rotor")
    m = parameter("kg", "mass off the axis", above=0)
    e = parameter("m", "its distance from the axis", min=0)
    v = variable("m/s", "velocity of the housing")
    a = variable("m/s2", "acceleration of the housing")
    phi = variable("rad", "angle of the rotor")
    w = variable("rad/s", "speed of the rotor")
    alpha = variable("rad/s2", "angular acceleration of the rotor")
    turning = property(lambda self: self.e * self.w)
    sliding = property(lambda self: self.v + self.turning * ca.cos(self.phi))
    kinetic = energy(lambda self: self.m * (self.sliding**2 + (self.turning * ca.sin(self.phi)) ** 2) / 2)

    def equations(self) -> Stated:
        across, along = ca.cos(self.phi), ca.sin(self.phi)
        yield self.v == der(self.flange.s)
        yield self.a == der(self.v)
        yield self.phi == self.shaft.phi
        yield self.w == der(self.phi)
        yield self.alpha == der(self.w)
        yield self.flange.f == self.m * (self.a + self.e * (self.alpha * across - self.w**2 * along))
        yield self.shaft.tau == self.m * self.e * (self.a * across + self.e * self.alpha)


def sieve(
    drive: Component | None = None,
    *,
    m: float = 2500.0,
    m_f: float = 1500.0,
    m_e: float = 150.0,
    e: float = 0.1,
    k: float = 600e3,
    d: float = 2.5e3,
    k_f: float = 6e6,
    d_f: float = 10e3,
) -> Network:
    """Return a vibrating sieve on a frame: `drive`, `exciter`, `box`, `springs`, `frame`, `pads`, `ground`.

    Above resonance the box swings by m_e e/(m + m_e), against the unbalance.

    Args:
        drive: what turns the unbalance, with a `flange`; a `rotational.Speed`, `drive.w_ref`, if None.
        m: mass of the box with what is on it, without the unbalance [kg].
        m_f: mass of the frame [kg].
        m_e: mass of the unbalance [kg].
        e: its distance from the axis [m].
        k: stiffness of the box's springs [N/m].
        d: their damping constant [N.s/m].
        k_f: stiffness of the pads below the frame [N/m].
        d_f: their damping constant [N.s/m].
    """
    net = Network(
        "sieve",
        drive=rotational.Speed() if drive is None else drive,
        exciter=Unbalance(m=m_e, e=e),
        box=Mass(m=m),
        springs=SpringDamper(k=k, d=d),
        frame=Mass(m=m_f),
        pads=SpringDamper(k=k_f, d=d_f),
        ground=Fixed(),
    )
    net.connect(net.drive.flange, net.exciter.shaft)
    net.connect(net.ground.flange, net.pads.flange_a).connect(net.pads.flange_b, net.frame.flange)
    net.connect(net.frame.flange, net.springs.flange_a)
    return net.connect(net.springs.flange_b, net.box.flange, net.exciter.flange)


def machine_foundation(
    drive: Component | None = None,
    *,
    m: float = 60e3,
    r: float = 2.0,
    G: float = 40e6,
    rho: float = 1800.0,
    nu: float = 0.33,
    m_e: float = 100.0,
    e: float = 0.05,
) -> Network:
    """Return a machine on a block on the ground: `drive`, `exciter`, `block`, `soil`, `ground`.

    The soil is a half-space, k = 4 G r/(1 - nu), d = 3.4 r^2 sqrt(rho G)/(1 - nu): it takes energy away in
    waves, with a damping ratio of 0.425/sqrt(B), B = (1 - nu) m/(4 rho r^3).

    Args:
        drive: what turns the unbalance, with a `flange`; a `rotational.Speed`, `drive.w_ref`, if None.
        m: mass of block and machine, without the unbalance [kg].
        r: radius of the block's base, or of a disk of its area [m].
        G: shear modulus of the soil [Pa].
        rho: density of the soil [kg/m3].
        nu: Poisson's ratio of the soil.
        m_e: mass of the unbalance [kg].
        e: its distance from the axis [m].

    Limits: vertical motion alone, soil without layers.

    Source: the analog of J. Lysmer, Vertical motion of rigid footings, Contract Report 3-115 (1965).
    """
    demand(
        "machine_foundation()",
        r=(r, lambda value: above(0, "m")(value) or between(0, MOST)(value)),
        G=(G, above(0, "Pa")),
        rho=(rho, above(0, "kg/m3")),
        nu=(nu, between(0, 0.5)),
    )
    net = Network(
        "machine foundation",
        drive=rotational.Speed() if drive is None else drive,
        exciter=Unbalance(m=m_e, e=e),
        block=Mass(m=m),
        soil=SpringDamper(k=4 * G * r / (1 - nu), d=3.4 * r**2 * sqrt(rho) * sqrt(G) / (1 - nu)),
        ground=Fixed(),
    )
    net.connect(net.drive.flange, net.exciter.shaft)
    net.connect(net.ground.flange, net.soil.flange_a)
    return net.connect(net.soil.flange_b, net.block.flange, net.exciter.flange)
