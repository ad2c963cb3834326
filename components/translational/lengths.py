"""Bodies that have a length."""

from ..language import Component, Stated, TranslationalFlange, parameter, variable
from .masses import Mass, Rod


class MassWithLength(Component):
    """A sliding mass of length L: m a = f_a + f_b, flange_a.s = s - L/2, flange_b.s = s + L/2.

    s is the position of its middle. Either end may stay free.

    Source: MSL Translational.Components.Mass.

    Example:
        >>> from inertance import Fixed, HardStop, MassWithLength, Network
        >>> net = Network("car and buffer", wall=Fixed(), stop=HardStop(e=1.0))
        >>> net = net.add(car=MassWithLength(m=2.0, L=0.5, s=1.0, v=-1.0))
        >>> net = net.connect(net.wall.flange, net.stop.flange_a).connect(net.stop.flange_b, net.car.flange_a)
        >>> round(net.simulate(2.0).events[-1].time, 9)  # 0.75 m before the end at the stop meets it
        0.75
    """

    flange_a = TranslationalFlange("left end", free=True)
    flange_b = TranslationalFlange("right end", free=True)
    m = parameter("kg", "mass", above=0)
    L = parameter("m", "length from flange_a to flange_b", min=0, default=0.0)
    s = variable("m", "position of the middle")
    v = variable("m/s", "velocity")
    a = variable("m/s2", "acceleration")

    left = Rod(L=lambda self: self.L / 2)
    mass = Mass(m=m)
    right = Rod(L=lambda self: self.L / 2)

    def equations(self) -> Stated:
        yield self.s == self.mass.s
        yield self.v == self.mass.v
        yield self.a == self.mass.a

    def connections(self) -> Stated:
        yield self.flange_a, self.left.flange_a
        yield self.left.flange_b, self.mass.flange, self.right.flange_a
        yield self.right.flange_b, self.flange_b
