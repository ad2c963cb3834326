"""Screws whose flanks slide."""

from math import pi

from ..flanks import SlidingFlanks
from ..language import Expression, Stated, der, parameter, variable
from .conversions import Transmission


class LeadScrew(SlidingFlanks, Transmission):
    """Screw whose flanks slide under load: phi = (2 pi/lead) s; self-locking where mu > lead/(pi d_m).

    f + (2 pi/lead) (tau - tau_loss) = 0. Screw driving, the efficiency is tan(lambda)/tan(lambda + rho) with
    tan(lambda) = lead/(pi d_m) and tan(rho) = mu. At rest the load is truly held. With a flank angle alpha,
    mu is the friction coefficient over cos(alpha).

    Limits: as for `SlidingFlanks`: mu tan(lambda) below 1, no locking by inertia alone.

    Source: mechanics of the inclined plane, J. E. Shigley, Mechanical Engineering Design.
    """

    lead = parameter("m", "travel of the nut for one turn of the screw", above=0)
    d_m = parameter("m", "mean diameter of the thread", above=0)
    w = variable("rad/s", "speed of the screw against the housing", state="prefer")
    a = variable("rad/s2", "acceleration of the screw against the housing")

    @property
    def load_torque(self) -> Expression:
        return -self.flange_t.f * self.lead / (2 * pi)

    @property
    def slope(self) -> Expression:
        return self.lead / (pi * self.d_m)

    def equations(self) -> Stated:
        turns = 2 * pi / self.lead
        yield self.phi == turns * self.s
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.flange_t.f + turns * (self.flange_r.tau - self.tau_loss) == 0
