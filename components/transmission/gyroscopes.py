"""A gyroscope whose precession answers to turning."""

import casadi as ca

from ..language import Stated, der, dissipation, energy, parameter, variable
from ..lossy import Lossy
from .flywheels import Flywheel


class Gyroscope(Lossy, Flywheel):
    """A spinning rotor in two gimbals: turned about one, it precesses about the other against a spring.

    With the angle alpha and speed w_p of precession, and the momentum of spin H = J_s w_s, which its bearings
    let it keep:

        tau = (J_g + J_t cos(alpha)^2) a - J_t sin(2 alpha) w_p w + H cos(alpha) w_p
        (J_t + J_i) w_p' + J_t sin(2 alpha)/2 w^2 + d w_p + c alpha = H cos(alpha) w

    A gyrator: while alpha is small the spring c is an inertia of H^2/c, the damper d a damper of H^2/d, and
    the inertia J_t + J_i a stiffness of H^2/(J_t + J_i).

    Limits: no friction but d; the housing takes torques about the other two axes, which a second rotor that
    spins the other way would cancel.

    Source: Lagrange's equations of the two gimbals, the cyclic angle of spin eliminated (Routh).
    """

    J_s = parameter("kg.m2", "inertia of the rotor about its axis of spin", above=0)
    w_s = parameter("rad/s", "speed of spin, with the gimbals at rest")
    J_t = parameter("kg.m2", "inertia of the rotor across its axis of spin", above=0)
    J_g = parameter("kg.m2", "inertia of both gimbals about the flange's axis", min=0, default=0.0)
    J_i = parameter("kg.m2", "inertia of the inner gimbal about the axis of precession", min=0, default=0.0)
    c = parameter("N.m/rad", "stiffness against precession", min=0)
    d = parameter("N.m.s/rad", "damping of precession", min=0, default=0.0)
    alpha = variable("rad", "angle of precession", state="prefer")
    w_p = variable("rad/s", "speed of precession", state="prefer")
    H = property(lambda self: self.J_s * self.w_s)
    J = property(lambda self: self.J_g + self.J_t * ca.cos(self.alpha) ** 2)
    kinetic = energy(lambda self: (self.J * self.w**2 + (self.J_t + self.J_i) * self.w_p**2) / 2)
    potential = energy(lambda self: self.c * self.alpha**2 / 2)
    lossPower = dissipation(lambda self: self.d * self.w_p**2)

    def equations(self) -> Stated:
        tilt, coupled = self.J_t * ca.sin(2 * self.alpha), self.H * ca.cos(self.alpha)
        resists = self.d * self.w_p + self.c * self.alpha
        yield self.w_p == der(self.alpha)
        yield self.flange.tau == self.J * self.a - tilt * self.w_p * self.w + coupled * self.w_p
        yield (self.J_t + self.J_i) * der(self.w_p) + tilt / 2 * self.w**2 + resists == coupled * self.w
        yield self.support.tau == 0
