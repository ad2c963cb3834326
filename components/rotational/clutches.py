"""Clutches and brakes: friction that a signal switches on."""

import casadi as ca

from ..language import (
    Expression,
    RotationalFlange,
    Shock,
    Stated,
    der,
    dissipation,
    impulse,
    mode,
    parameter,
    variable,
)
from ..lossy import Lossy
from ..pressed import Pressed, PressedStickSlip
from ..stickslip import REST_SPEED
from ..tables import interpolated
from .compliances import Compliant
from .friction import Friction


class _Discs(Pressed):
    cgeo = parameter("m", "mean friction radius times number of friction faces", above=0, default=1.0)


class Clutch(Friction, _Discs, PressedStickSlip):
    """Two shafts joined by friction: tau = mu(|w_rel|) cgeo fn against w_rel while sliding.

    fn = fn_max max(f_normalized, 0); |tau| <= peak mu(0) cgeo fn while stuck; free when fn = 0.

    Source: MSL Rotational.Components.Clutch.
    """


class Brake(_Discs, PressedStickSlip):
    """A shaft held by friction on a support: tau = mu(|w|) cgeo fn against w while sliding.

    fn = fn_max max(f_normalized, 0); |tau| <= peak mu(0) cgeo fn while stuck; free when fn = 0.
    The support, which takes -tau, is the ground when left unconnected.

    Source: MSL Rotational.Components.Brake.
    """

    flange = RotationalFlange("shaft")
    support = RotationalFlange("housing", optional=True)
    phi = variable("rad", "angle against the support", state="prefer")
    w = variable("rad/s", "speed against the support", state="prefer")
    a = variable("rad/s2", "acceleration against the support")
    tau = variable("N.m", "braking torque, positive against positive speed")

    quantities = "tau", "w", "a"

    def equations(self) -> Stated:
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.flange.tau == self.tau
        yield self.support.tau == -self.tau


class OneWayClutch(Compliant, _Discs, Lossy):
    """A freewheel and a clutch in parallel: flange_b may run ahead of flange_a, never fall behind.

    w_rel >= 0; tau = mu(w_rel) cgeo fn while b runs ahead, fn = fn_max max(f_normalized, 0). Stuck,
    tau is whatever keeps w_rel = 0: as negative as it takes, up to peak mu(0) cgeo fn above zero.
    Falling behind at once (a blow, a start value) is stopped by the impulse J.

    Limits: to be free of chatter, break-away takes 1e-4 of the fully pressed clutch's even when the
    signal is zero, and exceeds sliding by as much.

    Source: MSL Rotational.Components.OneWayClutch.
    """

    peak = parameter("1", "break-away torque over sliding torque at rest", default=1.0, min=1.0)
    mode = mode("stuck", "forward", doc="locked or running ahead", in_shock={"stuck": "forward"})
    J = impulse("N.m.s", "impulse of a shock, positive when it turns flange_b ahead")
    phi_rel = variable("rad", "angle between the flanges", state="prefer")
    w_rel = variable("rad/s", "relative speed of the flanges", state="prefer")
    a_rel = variable("rad/s2", "relative acceleration of the flanges")

    least = 1e-4
    lossPower = dissipation(lambda self: self.tau * self.w_rel)

    def equations(self) -> Stated:
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
        yield self.mode.choose(stuck=self.a_rel, forward=self.tau + self.J - self.sliding(self.w_rel)) == 0

    @property
    def breakaway(self) -> Expression:
        """Torque at which flange_b begins to run ahead."""
        share = ca.fmax(self.f_normalized * ca.fmax(self.peak, 1 + self.least), self.least)
        return interpolated(self.mu_pos, 0.0) * self.cgeo * self.fn_max * share

    def transitions(self) -> Stated:
        w = self.w_rel
        stop = {"w_rel": ca.if_else(ca.fabs(w) < REST_SPEED, 0.0, w)}
        yield self.mode.goes("stuck", "forward", when=self.tau > self.breakaway)
        yield self.mode.goes("stuck", "forward", when=w > 0)
        yield self.mode.goes("forward", "stuck", when=w < 0, reset=stop)
        yield self.mode.goes("stuck", "stuck", when=w < 0, shock=Shock(self.J, w, 0.0))
