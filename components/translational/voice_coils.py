"""Electrodynamic actuators that slide."""

from ..language import RealInput, Stated, der, dissipation, energy, parameter, supply, variable
from .compliances import Dissipative


class VoiceCoil(Dissipative):
    """Coil in a magnet, fed by a voltage: pushes its flanges apart with Bl i, L i' = u - R i - Bl v_rel.

    `machines.Shaker` adds armature and suspension.
    """

    u = RealInput("V", "voltage")
    Bl = parameter("N/A", "force constant, magnetic field times length of wire", nonzero=True)
    R = parameter("V/A", "resistance", above=0)
    L = parameter("V.s/A", "inductance", above=0)
    i = variable("A", "current")
    potential = energy(lambda self: self.L * self.i**2 / 2)
    lossPower = dissipation(lambda self: self.R * self.i**2)
    supplyPower = supply(lambda self: self.u * self.i)

    def equations(self) -> Stated:
        yield self.L * der(self.i) == self.u - self.R * self.i - self.Bl * self.v_rel
        yield self.f == -self.Bl * self.i
