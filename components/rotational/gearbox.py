"""A gearbox as it is built: losses, and an elastic output with backlash."""

from ..language import Component, RotationalFlange, Stated, option, parameter, variable
from ..tables import over_speed_with_losses
from .backlash import ElastoBacklash
from .gears import LossyGear


class Gearbox(Component):
    """A `LossyGear` whose output shaft is elastic and has backlash: an `ElastoBacklash` after it.

    phi_rel is the angle of flange_b ahead of the gear's own output. There is no inertia in it.

    Source: MSL Rotational.Components.Gearbox.
    """

    flange_a = RotationalFlange("left shaft")
    flange_b = RotationalFlange("right shaft")
    support = RotationalFlange("housing", optional=True)
    ratio = parameter("1", "turns of flange_a for one of flange_b", nonzero=True)
    lossTable = option(
        "rows (speed, eta1, eta2, tau_bf1, tau_bf2)",
        default=((0.0, 1.0, 1.0, 0.0, 0.0),),
        check=over_speed_with_losses,
    )
    c = parameter("N.m/rad", "stiffness", above=0)
    d = parameter("N.m.s/rad", "damping constant", min=0)
    b = parameter("rad", "total backlash", min=0, default=0.0)
    phi_rel = variable("rad", "angle over the elastic shaft")

    elastoBacklash = ElastoBacklash(c=c, d=d, b=b)

    def parts(self) -> dict[str, Component]:
        """Return the gear, which its table shapes."""
        return {"lossyGear": LossyGear(ratio=type(self).ratio, lossTable=self.lossTable)}

    def equations(self) -> Stated:
        yield self.phi_rel == self.elastoBacklash.phi_rel

    def connections(self) -> Stated:
        yield self.flange_a, self.lossyGear.flange_a
        yield self.lossyGear.flange_b, self.elastoBacklash.flange_a
        yield self.elastoBacklash.flange_b, self.flange_b
        yield self.support, self.lossyGear.support
