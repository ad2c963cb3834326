"""What drivetrains carry against torsional vibration: a dual-mass flywheel and a damper on the crankshaft."""

from ...components import rotational
from ...components.language import Component, RotationalFlange, Stated, parameter


class DualMassFlywheel(rotational.TwoFlanges):
    """Dual-mass flywheel: J_1 on flange_a, J_2 on flange_b, between them arc springs and their friction.

    The springs are linear, of stiffness c and damping d, or any turning element given as `springs`, such as a
    `rotational.TabulatedSpring` of two stages. They rub on their guide with tau_c, built up over phi_p.

    Source: W. Reik, R. Seebacher, A. Kooy, Dual mass flywheel, 6th LuK Symposium (1998).
    """

    flange_a = RotationalFlange("engine", free=True)
    flange_b = RotationalFlange("gearbox", free=True)
    J_1 = parameter("kg.m2", "inertia on the engine's side", above=0)
    J_2 = parameter("kg.m2", "inertia on the gearbox's side", above=0)
    c = parameter("N.m/rad", "stiffness of the springs", min=0, default=0.0)
    d = parameter("N.m.s/rad", "damping constant of the springs", min=0, default=0.0)
    tau_c = parameter("N.m", "friction torque", min=0, default=0.0)
    phi_p = parameter("rad", "angle over which friction builds up", above=0, default=0.01)

    primary = rotational.Inertia(J=J_1)
    secondary = rotational.Inertia(J=J_2)
    springs: Component = rotational.SpringDamper(c=c, d=d)
    friction: Component = rotational.DahlFriction(tau_c=tau_c, phi_p=phi_p)

    def connections(self) -> Stated:
        yield self.flange_a, self.primary.flange, self.springs.flange_a, self.friction.flange_a
        yield self.flange_b, self.secondary.flange, self.springs.flange_b, self.friction.flange_b


class TorsionalDamper(Component):
    """Damper at the end of a crankshaft: a ring in a housing, joined by silicone oil (d) or rubber (c, d).

    With c = 0, on a shaft that swings at w in a mode of inertia J, the ring damps best with
    d = 2 J_r w/sqrt(2 (1 + mu) (2 + mu)), mu = J_r/J.

    Source: J. P. Den Hartog, Mechanical Vibrations, 4th ed. (1956), chapter 5 for the viscous one.
    """

    flange = RotationalFlange("where the housing is joined", free=True)
    J_h = parameter("kg.m2", "inertia of the housing", above=0)
    J_r = parameter("kg.m2", "inertia of the ring", above=0)
    c = parameter("N.m/rad", "stiffness of the rubber", min=0, default=0.0)
    d = parameter("N.m.s/rad", "damping constant of oil or rubber", min=0)

    housing = rotational.Inertia(J=J_h)
    ring = rotational.Inertia(J=J_r)
    link: Component = rotational.SpringDamper(c=c, d=d)

    def connections(self) -> Stated:
        yield self.flange, self.housing.flange, self.link.flange_a
        yield self.link.flange_b, self.ring.flange
