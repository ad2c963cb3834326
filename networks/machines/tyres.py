"""Tyres of more than one body."""

from ...components import (
    Component,
    Mass,
    RotationalFlange,
    SpringDamper,
    TranslationalFlange,
    Tyre,
    rotational,
)
from ...components.language import Stated, parameter


class RigidRingTyre(Component):
    """Tyre whose belt is a rigid ring: side walls join it to rim and hub, and it slips as a `Tyre` does.

    Up to about 100 Hz the belt keeps its shape; it turns on the rim (c_phi, d_phi) and gives way to the hub
    (k_x, d_x). At rest the contact is a spring mu F_z B C/sigma, between the belt's R phi and its s.

    Limits: those of `Tyre`, and nothing vertical.

    Source: P. W. A. Zegelaar, The Dynamic Response of Tyres to Brake Torque Variations and Road
    Unevennesses, thesis, Delft University of Technology (1998).
    """

    flange_r = RotationalFlange("rim")
    flange_t = TranslationalFlange("hub")
    support_t = TranslationalFlange("road", optional=True)
    J_b = parameter("kg.m2", "inertia of the belt", above=0)
    m_b = parameter("kg", "mass of the belt", above=0)
    c_phi = parameter("N.m/rad", "stiffness of the side walls against turning", above=0)
    d_phi = parameter("N.m.s/rad", "damping constant of the side walls against turning", min=0, default=0.0)
    k_x = parameter("N/m", "stiffness of the side walls along the road", above=0)
    d_x = parameter("N.s/m", "damping constant of the side walls along the road", min=0, default=0.0)
    R = parameter("m", "effective rolling radius", above=0)
    F_z = parameter("N", "load on the tyre", min=0)
    mu = parameter("1", "largest f_x over F_z", min=0)
    B = parameter("1", "stiffness factor", above=0)
    C = parameter("1", "shape factor", above=0)
    E = parameter("1", "curvature factor", max=1, default=0.0)
    sigma = parameter("m", "relaxation length of the contact", above=0)

    ring = rotational.Inertia(J=J_b)
    belt = Mass(m=m_b)
    turning: Component = rotational.SpringDamper(c=c_phi, d=d_phi)
    sliding: Component = SpringDamper(k=k_x, d=d_x)
    contact: Component = Tyre(R=R, F_z=F_z, mu=mu, B=B, C=C, E=E, sigma=sigma)

    def connections(self) -> Stated:
        yield self.flange_r, self.turning.flange_a
        yield self.turning.flange_b, self.ring.flange, self.contact.flange_r
        yield self.flange_t, self.sliding.flange_a
        yield self.sliding.flange_b, self.belt.flange, self.contact.flange_t
        yield self.support_t, self.contact.support_t
