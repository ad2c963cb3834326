"""What isolators are made of: wire rope, springs that stand across, ropes."""

import casadi as ca

from ..hysteresis import wen_yielding
from ..language import Stated, der, dissipation, energy, parameter, variable
from ..limits import limited
from .compliances import Compliant, Dissipative


class WireRope(Dissipative):
    """Wire rope isolator: f = k_1 e + k_2 e^2 + k_3 e^3 + f_y z, the strands rubbing with at most f_y.

    s_y z' = v - share |v| |z|^(n-1) z - (1 - share) v |z|^n with e = s_rel - s_rel0, v = v_rel: a Bouc-Wen
    hysteresis of -1 <= z <= 1. k_2 tells pull from push, k_3 > 0 stiffens.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263; on wire rope, G. F. Demetriades,
    M. C. Constantinou, A. M. Reinhorn, Engineering Structures 15 (1993) 321-334.
    """

    k_1 = parameter("N/m", "stiffness once the strands slip", min=0)
    k_2 = parameter("N/m2", "how pull and push differ", default=0.0)
    k_3 = parameter("N/m3", "stiffening", default=0.0)
    f_y = parameter("N", "friction force of the strands", min=0)
    s_y = parameter("m", "displacement over which the strands begin to slip", above=0)
    n = parameter("1", "sharpness of slip", min=1, default=1.0)
    share = parameter("1", "of the loop's shape against the motion", min=0.5, max=1, default=0.5)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    z = variable("1", "share of the friction force that has built up")
    e = property(lambda self: self.s_rel - self.s_rel0)
    yielding = property(lambda self: wen_yielding(self.v_rel, self.z, self.share, 1 - self.share, self.n))
    stretched = property(
        lambda self: self.k_1 * self.e**2 / 2 + self.k_2 * self.e**3 / 3 + self.k_3 * self.e**4 / 4
    )
    potential = energy(lambda self: self.stretched + self.f_y * self.s_y * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.f_y * self.z * self.yielding)

    def equations(self) -> Stated:
        e = self.e
        yield self.s_y * der(self.z) == self.v_rel - self.yielding
        yield self.f == self.k_1 * e + self.k_2 * e**2 + self.k_3 * e**3 + self.f_y * self.z


class ObliqueSprings(Compliant):
    """Two springs across the motion, pressed between their supports: f = 2 k e (1 - l_0/sqrt(a^2 + e^2)).

    e = s_rel - s_rel0. Pressed, l_0 > a, they push out of the middle: a negative stiffness of 2 k (1 - l_0/a)
    there. A `Spring` of the opposite stiffness beside them makes a support of quasi-zero stiffness.

    Source: A. Carrella, M. J. Brennan, T. P. Waters, Static analysis of a passive vibration isolator with
    quasi-zero-stiffness characteristic, J. Sound Vib. 301 (2007) 678-689.
    """

    k = parameter("N/m", "stiffness of each spring", min=0)
    l_0 = parameter("m", "unstretched length of each", above=0)
    a = parameter("m", "from support to middle", above=0)
    s_rel0 = parameter("m", "distance at which they lie across", default=0.0)
    e = property(lambda self: self.s_rel - self.s_rel0)
    length = property(lambda self: ca.sqrt(self.a**2 + self.e**2))
    potential = energy(lambda self: self.k * (self.length - self.l_0) ** 2)

    def equations(self) -> Stated:
        yield self.f == 2 * self.k * self.e * (1 - self.l_0 / self.length)


class Rope(Dissipative):
    """Rope, chain or cable, which pulls and never pushes: taut above s_rel0, slack below.

    f = k e + min(max(d v_rel, -k e), k e) with e = max(s_rel - s_rel0, 0): continuous where it becomes taut.
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0, default=0.0)
    s_rel0 = parameter("m", "length at which it becomes taut", default=0.0)
    e = property(lambda self: ca.fmax(self.s_rel - self.s_rel0, 0))
    damping = property(lambda self: limited(self.d * self.v_rel, -self.k * self.e, self.k * self.e))
    potential = energy(lambda self: self.k * self.e**2 / 2)
    lossPower = dissipation(lambda self: self.damping * self.v_rel)

    def equations(self) -> Stated:
        yield self.f == self.k * self.e + self.damping
