"""Laws that depend on temperature: a brake by eddy currents, and dry friction."""

from ..language import (
    Expression,
    RealInput,
    Stated,
    TranslationalFlange,
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
    """A brake by eddy currents: f = 2 f_nominal x/(1 + x^2), x = v/(v_nominal r(T)).

    r = 1 + alpha (T - TRef) is the disc's resistance over that at TRef, alpha = alpha20/(1 + alpha20 (TRef -
    293.15 K)): a hot disc brakes best at a higher speed. The support is the ground when left unconnected.

    Source: MSL Translational.Sources.EddyCurrentForce (the equation of Kloss).
    """

    flange = TranslationalFlange("what slides")
    support = TranslationalFlange("what reacts", optional=True)
    useF_nominalInput = option(
        "whether the largest force comes in as f_input", default=False, choices=(False, True)
    )
    f_input = RealInput("N", "largest force", when="useF_nominalInput")
    f_nominal = parameter("N", "largest force, at v_nominal", min=0, default=0.0)
    v_nominal = parameter("m/s", "speed at which it brakes best at TRef", above=0)
    TRef = parameter("K", "temperature at which v_nominal holds", above=0, default=293.15)
    alpha20 = parameter("1/K", "temperature coefficient of the disc's resistance at 20 degC", default=0.0)
    s = variable("m", "position against the support", state="avoid")
    v = variable("m/s", "speed against the support", state="avoid")
    f = variable("N", "braking force, positive against positive speed")
    lossPower = dissipation(lambda self: self.f * self.v)

    @property
    def resistance(self) -> Expression:
        """Resistance of the disc over that at TRef."""
        alpha = self.alpha20 / (1 + self.alpha20 * (self.TRef - ZERO_ALPHA20))
        return 1 + alpha * (self.temperature - self.TRef)

    def equations(self) -> Stated:
        largest = self.f_input if self.useF_nominalInput else self.f_nominal
        normalized = self.v / (self.v_nominal * self.resistance)
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield self.f == 2 * largest * normalized / (1 + normalized**2)
        yield self.flange.f == self.f
        yield self.support.f == -self.f


class TemperatureDependentFriction(Friction, AtTemperature):
    """Coulomb friction that changes with temperature: f = f_c (1 + alpha (T - TRef)) sgn(v_rel).

    T is that of `heatPort` with `useHeatPort`, which its losses may heat. While stuck, |f| <= peak of it.
    Limits: alpha (T - TRef) must stay above -1.
    """

    f_c = parameter("N", "Coulomb friction force at TRef", min=0)
    alpha = parameter("1/K", "relative change of friction with temperature")
    TRef = parameter("K", "temperature at which it is f_c", above=0, default=293.15)

    def sliding(self, speed: Expression) -> Expression:
        return self.f_c * (1 + self.alpha * (self.temperature - self.TRef)) + 0 * speed
