"""Turning into sliding to and fro: crank and cam."""

from math import pi

import casadi as ca

from ..curves import curve_over_a_turn, periodic
from ..language import Stated, der, dissipation, parameter, variable
from .conversions import Transmission


class Crank(Transmission):
    """A shaft that drives a slider to and fro without loss, by its angle and speed."""

    w = variable("rad/s", "speed against the housing", state="prefer")
    lossPower = dissipation(lambda _: 0.0)

    def equations(self) -> Stated:
        yield self.w == der(self.phi)


class SliderCrank(Crank):
    """Crank and connecting rod at any angle: s = r cos(phi) + sqrt(l^2 - (r sin(phi) - e)^2), no loss.

    s is the distance of the slider from the crank's axis, largest at phi = 0 without offset e;
    tau + ds/dphi f = 0, so that power is kept.

    Limits: l must exceed r + |e|. In the dead centres the slider cannot turn the crank.
    """

    r = parameter("m", "radius of the crank", above=0)
    l = parameter("m", "length of the connecting rod", above=0)  # noqa: E741
    e = parameter("m", "offset of the slider's line from the crank's axis", default=0.0)

    def equations(self) -> Stated:
        height = self.r * ca.sin(self.phi) - self.e
        along = ca.sqrt(self.l**2 - height**2)
        slope = -self.r * ca.sin(self.phi) - height * self.r * ca.cos(self.phi) / along
        yield self.s == self.r * ca.cos(self.phi) + along
        yield self.flange_r.tau + slope * self.flange_t.f == 0


class Cam(Crank):
    """Grooved cam: s = h(phi) by points over one turn, no loss: tau + h'(phi) f = 0.

    Between the points h is a cubic curve whose second derivative is steady, also from turn to turn, so that
    accelerations do not jump. A follower that may lift off is an `ElastoGap` or `HardStop` behind it.
    """

    table = curve_over_a_turn()

    def equations(self) -> Stated:
        lift = periodic(self.table, self.phi, 2 * pi)
        yield self.s == lift
        yield self.flange_r.tau + ca.gradient(lift, self.phi) * self.flange_t.f == 0
