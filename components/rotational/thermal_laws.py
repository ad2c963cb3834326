"""Laws that depend on temperature: a brake by eddy currents, and dry friction."""

from ..language import (
    Expression,
    RealInput,
    RotationalFlange,
    Stated,
    der,
    dissipation,
    option,
    parameter,
    variable,
)
from ..lossy import AtTemperature
from .friction import Friction

ZERO_ALPHA20 = 293.15  # [K], 20 degC, for which alpha20 is told


class EddyCurrentBrake(AtTemperature):
    """A brake by eddy currents: tau = 2 tau_nominal x/(1 + x^2), x = w/(w_nominal r(T)).

    r = 1 + alpha (T - TRef) is the disc's resistance over that at TRef, alpha = alpha20/(1 + alpha20 (TRef -
    293.15 K)): a hot disc brakes best at a higher speed. The support is the ground when left unconnected.

    Source: MSL Rotational.Sources.EddyCurrentTorque (the equation of Kloss).
    """

    flange = RotationalFlange("shaft")
    support = RotationalFlange("what reacts", optional=True)
    useTau_nominalInput = option(
        "whether the largest torque comes in as tau_input", default=False, choices=(False, True)
    )
    tau_input = RealInput("N.m", "largest torque", when="useTau_nominalInput")
    tau_nominal = parameter("N.m", "largest torque, at w_nominal", min=0, default=0.0)
    w_nominal = parameter("rad/s", "speed at which it brakes best at TRef", above=0)
    TRef = parameter("K", "temperature at which w_nominal holds", above=0, default=293.15)
    alpha20 = parameter("1/K", "temperature coefficient of the disc's resistance at 20 degC", default=0.0)
    phi = variable("rad", "angle against the support", state="avoid")
    w = variable("rad/s", "speed against the support", state="avoid")
    tau = variable("N.m", "braking torque, positive against positive speed")
    lossPower = dissipation(lambda self: self.tau * self.w)

    @property
    def resistance(self) -> Expression:
        """Resistance of the disc over that at TRef."""
        alpha = self.alpha20 / (1 + self.alpha20 * (self.TRef - ZERO_ALPHA20))
        return 1 + alpha * (self.temperature - self.TRef)

    def equations(self) -> Stated:
        largest = self.tau_input if self.useTau_nominalInput else self.tau_nominal
        normalized = self.w / (self.w_nominal * self.resistance)
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        yield self.tau == 2 * largest * normalized / (1 + normalized**2)
        yield self.flange.tau == self.tau
        yield self.support.tau == -self.tau


class TemperatureDependentFriction(Friction, AtTemperature):
    """Coulomb friction that changes with temperature: tau = tau_c (1 + alpha (T - TRef)) sgn(w_rel).

    T is that of `heatPort` with `useHeatPort`, which its losses may heat. While stuck, |tau| <= peak of it.
    Limits: alpha (T - TRef) must stay above -1.
    """

    tau_c = parameter("N.m", "Coulomb friction torque at TRef", min=0)
    alpha = parameter("1/K", "relative change of friction with temperature")
    TRef = parameter("K", "temperature at which it is tau_c", above=0, default=293.15)

    def sliding(self, speed: Expression) -> Expression:
        return self.tau_c * (1 + self.alpha * (self.temperature - self.TRef)) + 0 * speed
