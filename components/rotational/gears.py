"""Gears: without loss, elastic, and with the losses of mesh and bearings."""

import casadi as ca

from ..contact import clearance_energy, past_clearance
from ..language import (
    Component,
    Expression,
    RotationalFlange,
    Stated,
    der,
    dissipation,
    energy,
    mode,
    option,
    parameter,
    variable,
)
from ..lossy import Lossy
from ..stickslip import Sticking
from ..tables import interpolated, over_speed_with_losses


class IdealGear(Component):
    """A gearbox without inertia or loss, angles against its housing: phi_a = ratio phi_b.

    Torques: flange_b.tau = -ratio flange_a.tau; the support takes what is left of their sum.

    Source: MSL Rotational.Components.IdealGear.
    """

    flange_a = RotationalFlange("left shaft")
    flange_b = RotationalFlange("right shaft")
    support = RotationalFlange("housing", optional=True)
    ratio = parameter("1", "turns of flange_a for one of flange_b", nonzero=True)

    def equations(self) -> Stated:
        a, b, housing = self.flange_a, self.flange_b, self.support
        yield a.phi - housing.phi == self.ratio * (b.phi - housing.phi)
        yield b.tau == -self.ratio * a.tau
        yield housing.tau == -(a.tau + b.tau)


class IdealPlanetary(Component):
    """A planetary gear without inertia or loss: (1 + ratio) phi_carrier = phi_sun + ratio phi_ring.

    Torques: ring.tau = ratio sun.tau, carrier.tau = -(1 + ratio) sun.tau.

    Source: MSL Rotational.Components.IdealPlanetary.
    """

    sun = RotationalFlange("sun shaft")
    carrier = RotationalFlange("carrier shaft")
    ring = RotationalFlange("ring shaft")
    ratio = parameter("1", "teeth of the ring over teeth of the sun", above=0)

    def equations(self) -> Stated:
        sun, carrier, ring = self.sun, self.carrier, self.ring
        yield (1 + self.ratio) * carrier.phi == sun.phi + self.ratio * ring.phi
        yield ring.tau == self.ratio * sun.tau
        yield carrier.tau == -(1 + self.ratio) * sun.tau


class GearMesh(Lossy):
    """Two gears meshing with stiffness, damping and clearance along the line of action.

    s_rel = r_a (phi_a - phi_c) + r_b (phi_b - phi_c), with -r_b when gear b is a ring around gear a,
    and phi_c the angle of the support that carries the gears' axes. With p = k s_rel + d v_rel:
    f = p - k g when p >= k g, zero when |p| < k g, p + k g when p <= -k g.
    flange_a.tau = r_a f, flange_b.tau = r_b f (-r_b for a ring); the support takes the rest.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(20).
    """

    flange_a = RotationalFlange("gear a")
    flange_b = RotationalFlange("gear b")
    support = RotationalFlange("what carries the axes of the gears", optional=True)
    r_a = parameter("m", "base radius of gear a", above=0)
    r_b = parameter("m", "base radius of gear b", above=0)
    k = parameter("N/m", "mesh stiffness", above=0)
    d = parameter("N.s/m", "mesh damping", min=0, default=0.0)
    g = parameter("m", "half of the clearance", min=0, default=0.0)
    internal = option("whether gear b is a ring around gear a", default=False, choices=(False, True))
    s_rel = variable("m", "approach of the flanks along the line of action", state="avoid")
    v_rel = variable("m/s", "speed of approach", state="avoid")
    f = variable("N", "force along the line of action, positive against positive angles of gear a")
    elastic = property(lambda self: past_clearance(self.k * self.s_rel, self.k * self.g))
    potential = energy(lambda self: clearance_energy(self.s_rel, self.k, self.g))
    lossPower = dissipation(lambda self: (self.f - self.elastic) * self.v_rel)

    def equations(self) -> Stated:
        a, b, axes = self.flange_a, self.flange_b, self.support
        r_b = -self.r_b if self.internal else self.r_b
        contact = self.k * self.s_rel + self.d * self.v_rel
        yield self.s_rel == self.r_a * (a.phi - axes.phi) + r_b * (b.phi - axes.phi)
        yield self.v_rel == der(self.s_rel)
        yield self.f == past_clearance(contact, self.k * self.g)
        yield a.tau == self.r_a * self.f
        yield b.tau == r_b * self.f
        yield axes.tau == -(a.tau + b.tau)


class LossyGear(Sticking):
    """A gearbox with mesh efficiency and bearing friction that truly sticks: phi_a = ratio phi_b.

    The mesh passes on tau_a - tau_loss: flange_b.tau = -ratio (flange_a.tau - tau_loss). Turning
    forward, tau_loss is the larger of
    (1 - eta1) tau_a + tau_bf1 (a drives b) and (1 - 1/eta2) tau_a + tau_bf2 (b drives a);
    turning backward, the same with both torques reversed. Stuck, it is whatever holds the gear,
    between these two at rest. Angles are taken against the support, which bears the rest of the torques.

    `lossTable` has rows (|w| [rad/s], eta1, eta2, tau_bf1 [N.m], tau_bf2 [N.m]) over the speed of
    flange_a: efficiencies above 0 up to 1, and bearing friction seen at flange_a, for either
    direction of power. In between it is interpolated, beyond its end it goes on straight.

    Source: C. Pelchen, C. Schweiger, M. Otter, Modeling and Simulating the Efficiency of Gearboxes
    and of Planetary Gearboxes, 2nd Modelica Conference (2002); MSL Rotational.Components.LossyGear.
    """

    flange_a = RotationalFlange("left shaft")
    flange_b = RotationalFlange("right shaft")
    support = RotationalFlange("housing", optional=True)
    ratio = parameter("1", "turns of flange_a for one of flange_b", nonzero=True)
    lossTable = option(
        "rows (speed, eta1, eta2, tau_bf1, tau_bf2)",
        default=((0.0, 1.0, 1.0, 0.0, 0.0),),
        check=over_speed_with_losses,
    )
    driver = mode("a", "b", doc="the side that drives the mesh")
    phi = variable("rad", "angle of flange_a against the support", state="prefer")
    w = variable("rad/s", "speed of flange_a against the support", state="prefer")
    a = variable("rad/s2", "acceleration of flange_a against the support")
    tau_loss = variable("N.m", "torque lost, seen at flange_a")

    quantities = "tau_loss", "w", "a"

    def losses(self, torque: Expression, speed: Expression) -> tuple[Expression, Expression]:
        """Loss torque when a drives and when b drives, for turning forward."""
        eta1, eta2, tau_bf1, tau_bf2 = (interpolated(self.lossTable, ca.fabs(speed), i) for i in (1, 2, 3, 4))
        return (1 - eta1) * torque + tau_bf1, (1 - 1 / eta2) * torque + tau_bf2

    @property
    def limits(self) -> tuple[Expression, ...]:
        """Loss torques at which turning begins, forward and backward."""
        return tuple(ca.fmax(*self.losses(sign * self.flange_a.tau, 0.0)) for sign in (1, -1))

    def equations(self) -> Stated:
        a, b, housing, loss = self.flange_a, self.flange_b, self.support, self.tau_loss
        yield self.phi == a.phi - housing.phi
        yield self.phi == self.ratio * (b.phi - housing.phi)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield b.tau == -self.ratio * (a.tau - loss)
        yield housing.tau == -(a.tau + b.tau)
        forward, backward = (
            self.driver.choose(**dict(zip("ab", self.losses(sign * a.tau, sign * self.w), strict=True)))
            for sign in (1, -1)
        )
        yield self.mode.choose(stuck=self.a, forward=loss - forward, backward=loss + backward) == 0

    def transitions(self) -> Stated:
        (forward_a, forward_b), (backward_a, backward_b) = (
            self.losses(sign * self.flange_a.tau, sign * self.w) for sign in (1, -1)
        )
        lead = self.mode.choose(stuck=0.0, forward=forward_a - forward_b, backward=backward_a - backward_b)
        yield self.driver.goes("a", "b", when=lead < 0)
        yield self.driver.goes("b", "a", when=lead > 0)
