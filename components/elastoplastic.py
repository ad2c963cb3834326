"""Elastic–plastic cells: a spring in series with dry friction, for sliding and for turning."""

from .language import Expression, Stated, der, dissipation, energy, mode
from .lossy import Rubbing
from .stickslip import BREAKAWAY_MARGIN


class ElastoPlastic(Rubbing):
    """A spring in series with a slider without mass: its stretch z follows the motion until it slips.

    z' = v while stuck, |z| <= z_s; z' = 0 while it slips, until the motion turns. A subclass declares z,
    states the force, and gives `speed`, `stiffness` and `slip_stretch`, the stretch z_s at which it slips.
    """

    mode = mode("stuck", "forward", "backward", doc="stretching or slipping")
    slip = property(lambda self: self.mode.choose(stuck=0.0, forward=self.speed, backward=self.speed))
    potential = energy(lambda self: self.stiffness * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.stiffness * self.z * self.slip)

    @property
    def stiffness(self) -> Expression:
        """Stiffness of the spring."""
        raise NotImplementedError

    @property
    def slip_stretch(self) -> Expression:
        """The stretch of the spring at which the slider slips."""
        raise NotImplementedError

    def equations(self) -> Stated:
        yield der(self.z) == self.mode.choose(stuck=self.speed, forward=0.0, backward=0.0)

    def transitions(self) -> Stated:
        slip = self.slip_stretch
        most = (1 + BREAKAWAY_MARGIN) * slip
        yield self.mode.goes("stuck", "forward", when=self.z > most, reset={"z": slip})
        yield self.mode.goes("stuck", "backward", when=-self.z > most, reset={"z": -slip})
        yield self.mode.goes("forward", "stuck", when=self.speed < 0)
        yield self.mode.goes("backward", "stuck", when=self.speed > 0)
