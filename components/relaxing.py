"""What relaxes: a spring whose force fades while it is held, sliding or turning."""

from .language import Expression, Stated, der, dissipation, energy, parameter
from .lossy import Lossy


class Relaxing(Lossy):
    """A spring in series with a damper, by its stiffness k and the time T in which its force fades.

    A subclass declares z, the stretch of the damper, gives `stretch` and `stiffness`, and states its force.
    """

    T = parameter("s", "time in which the force fades to 37 %", above=0)
    potential = energy(lambda self: self.stiffness * self.elastic**2 / 2)
    lossPower = dissipation(lambda self: self.stiffness * self.elastic**2 / self.T)

    @property
    def elastic(self) -> Expression:
        """How far the spring is stretched."""
        return self.stretch - self.z

    @property
    def stretch(self) -> Expression:
        """How far spring and damper are stretched together."""
        raise NotImplementedError

    @property
    def stiffness(self) -> Expression:
        """Stiffness of the spring."""
        raise NotImplementedError

    def equations(self) -> Stated:
        yield self.T * der(self.z) == self.elastic
