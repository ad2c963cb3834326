"""Inerters of liquid in a coil, and with an inertance that a signal changes."""

from math import pi

import casadi as ca

from ..language import RealInput, Stated, der, dissipation, energy, parameter, supply, variable
from .compliances import CompliantWithSpeed, Dissipative

LEAST_REYNOLDS = 1e-6  # rounds |v| off at rest, far below any flow


class FluidInerter(Dissipative):
    """Liquid that a piston drives through a helical tube: f = b a_rel + A_p dp.

    b = rho A_p^2 L/A_t + rho A_p^2 L_p/A_p with the tube's area A_t = pi D^2/4: liquid in tube and cylinder.
    The tube resists by dp = rho u |u|/2 (lambda L/D + zeta), u = v_rel A_p/A_t, the larger lambda of 64/Re
    (laminar) and 0.304 Re^(-1/4) + 0.029 sqrt(D/D_h) (turbulent in a coil), Re = rho |u| D/mu.

    Limits: a liquid without compressibility (put a `Spring` in series), no leakage, a laminar flow as in a
    straight tube.

    Source: S. J. Swift, M. C. Smith, A. R. Glover, C. Papageorgiou, B. Gartner, N. E. Houghton, Design and
    modelling of a fluid inerter, Int. J. Control 86 (2013) 2035-2051, for b; H. Ito, Friction factors for
    turbulent flow in curved pipes, J. Basic Eng. 81 (1959) 123-134, for lambda.
    """

    A_p = parameter("m2", "area of the piston", above=0)
    L_p = parameter("m", "length of the cylinder", min=0, default=0.0)
    D = parameter("m", "inner diameter of the tube", above=0)
    L = parameter("m", "length of the tube", above=0)
    D_h = parameter("m", "diameter of the helix", above=0)
    rho = parameter("kg/m3", "density of the liquid", above=0, default=1000.0)
    mu = parameter("Pa.s", "viscosity of the liquid", above=0, default=1e-3)
    zeta = parameter("1", "losses at the ends of the tube", min=0, default=1.5)
    a_rel = variable("m/s2", "relative acceleration of the flanges")
    f_d = variable("N", "force of the tube's resistance")

    A_t = property(lambda self: pi * self.D**2 / 4)
    b = property(lambda self: self.rho * self.A_p**2 * self.L / self.A_t + self.rho * self.A_p * self.L_p)
    kinetic = energy(lambda self: self.b * self.v_rel**2 / 2)
    lossPower = dissipation(lambda self: self.f_d * self.v_rel)

    def equations(self) -> Stated:
        u = self.v_rel * self.A_p / self.A_t
        reynolds = ca.sqrt((self.rho * u * self.D / self.mu) ** 2 + LEAST_REYNOLDS**2)
        turbulent = (0.304 * reynolds**-0.25 + 0.029 * ca.sqrt(self.D / self.D_h)) * reynolds
        friction = self.mu / self.D * ca.fmax(64.0, turbulent) * self.L / self.D
        yield self.a_rel == der(self.v_rel)
        yield self.f_d == self.A_p * (friction + self.zeta * self.rho * ca.fabs(u)) * u / 2
        yield self.f == self.b * self.a_rel + self.f_d


class VariableInerter(CompliantWithSpeed):
    """Inerter whose inertance follows a signal: f = der(p), p = (b + b_u x) v_rel, with T x' = u - x.

    As of a flywheel whose masses an actuator, slow by T, moves in and out: the momentum p is kept where
    nothing pulls, and the actuator gives and takes the energy: supplyPower = -b_u x' v_rel^2/2.

    Limits: b + b_u x must stay above 0.
    """

    u = RealInput("1", "what the inertance follows")
    b = parameter("kg", "inertance at u = 0", min=0)
    b_u = parameter("kg", "change of the inertance with u")
    T = parameter("s", "time constant of the actuator", above=0)
    x = variable("1", "position of the actuator")
    a_rel = variable("m/s2", "relative acceleration of the flanges")
    inertance = property(lambda self: self.b + self.b_u * self.x)
    kinetic = energy(lambda self: self.inertance * self.v_rel**2 / 2)
    supplyPower = supply(lambda self: -self.b_u * der(self.x) * self.v_rel**2 / 2)

    def equations(self) -> Stated:
        yield self.T * der(self.x) == self.u - self.x
        yield self.a_rel == der(self.v_rel)
        yield self.f == self.inertance * self.a_rel + self.b_u * der(self.x) * self.v_rel
