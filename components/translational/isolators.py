"""What isolators are made of: wire rope, springs that stand across, ropes."""

import casadi as ca

from ..hysteresis import wen_yielding
from ..language import Stated, der, parameter, variable
from .compliances import Compliant, CompliantWithSpeed


class WireRope(CompliantWithSpeed):
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
    lossPower = variable("W", "dissipated power")

    def equations(self) -> Stated:
        e, v = self.s_rel - self.s_rel0, self.v_rel
        yield self.s_y * der(self.z) == v - wen_yielding(v, self.z, self.share, 1 - self.share, self.n)
        yield self.f == self.k_1 * e + self.k_2 * e**2 + self.k_3 * e**3 + self.f_y * self.z
        yield self.lossPower == self.f_y * self.z * (v - self.s_y * der(self.z))


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

    def equations(self) -> Stated:
        e = self.s_rel - self.s_rel0
        yield self.f == 2 * self.k * e * (1 - self.l_0 / ca.sqrt(self.a**2 + e**2))


class Rope(CompliantWithSpeed):
    """Rope, chain or cable, which pulls and never pushes: taut above s_rel0, slack below.

    f = k e + min(max(d v_rel, -k e), k e) with e = max(s_rel - s_rel0, 0): continuous where it becomes taut.
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0, default=0.0)
    s_rel0 = parameter("m", "length at which it becomes taut", default=0.0)
    lossPower = variable("W", "dissipated power")

    def equations(self) -> Stated:
        spring = self.k * ca.fmax(self.s_rel - self.s_rel0, 0)
        damping = ca.fmin(ca.fmax(self.d * self.v_rel, -spring), spring)
        yield self.f == spring + damping
        yield self.lossPower == damping * self.v_rel
