"""Flanks that give slowly and come back slowly: spring and damper behind a backlash, sliding or turning."""

import casadi as ca

from .language import Expression, Stated, der, dissipation, energy, mode
from .lossy import Lossy


class RelaxingFlanks(Lossy):
    """A spring k beside a damper d, without mass, behind a backlash b that oil fills: d z' + k z = pressing.

    A subclass declares d, d_0 and z, the stretch of spring and damper, states its force, that which presses
    and that of the oil, and gives `offset`, `speed`, `stiffness` and `width`.
    """

    mode = mode("free", "forward", "backward", doc="apart, or in contact when pulled or pushed")
    forward = property(lambda self: self.stiffness * (self.offset - self.width / 2) + self.d * self.speed)
    backward = property(lambda self: self.stiffness * (self.offset + self.width / 2) + self.d * self.speed)
    pressing = property(lambda self: self.mode.choose(free=0.0, forward=self.forward, backward=self.backward))
    potential = energy(lambda self: self.stiffness * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.d * der(self.z) ** 2 + self.d_0 * self.speed**2)

    @property
    def offset(self) -> Expression:
        """Distance from the middle of the backlash."""
        raise NotImplementedError

    @property
    def stiffness(self) -> Expression:
        """Stiffness in contact."""
        raise NotImplementedError

    @property
    def width(self) -> Expression:
        """Total backlash."""
        raise NotImplementedError

    def equations(self) -> Stated:
        yield self.d * der(self.z) == self.pressing - self.stiffness * self.z

    def transitions(self) -> Stated:
        pulled, pushed = self.offset - self.width / 2, self.offset + self.width / 2  # stretch in contact
        ahead, behind = pulled - self.z, self.z - pushed
        yield self.mode.goes("free", "forward", when=ca.fmin(ahead, self.forward) > 0)
        yield self.mode.goes("forward", "free", when=self.forward < 0, reset={"z": pulled})
        yield self.mode.goes("free", "backward", when=ca.fmin(behind, -self.backward) > 0)
        yield self.mode.goes("backward", "free", when=self.backward > 0, reset={"z": pushed})
