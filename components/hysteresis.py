"""Smooth hysteresis, after Bouc and Wen: the law, and the spring that yields by it, sliding or turning."""

import casadi as ca

from .language import Expression, Stated, der, dissipation, energy, parameter
from .lossy import Rubbing

LEAST_HYSTERESIS = 1e-300  # [unit of z]


def wen_yielding(
    v: Expression, z: Expression, beta: Expression, gamma: Expression, n: Expression
) -> Expression:
    """Return what z' falls short of A v by, as z yields: beta |v| |z|^(n-1) z + gamma v |z|^n.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263.
    """
    size = ca.fmax(ca.fabs(z), LEAST_HYSTERESIS)  # above 0, where x^n has a slope in n
    return beta * ca.fabs(v) * size ** (n - 1) * z + gamma * v * size**n


class HystereticSpring(Rubbing):
    """A spring of which all but a share alpha yields: alpha k x + (1 - alpha) k z, z' = A v - yielding.

    What it stores is k (alpha x^2 + (1 - alpha) z^2/A)/2. A subclass declares z, beta and gamma, states the
    force by `restoring`, and gives `stretch` x, `speed` v and `stiffness` k.
    """

    alpha = parameter("1", "share of stiffness after yield", min=0, max=1, default=0.1)
    A = parameter("1", "scale of z", above=0, default=1.0)
    n = parameter("1", "sharpness of yield", min=1, default=2.0)

    yielding = property(lambda self: wen_yielding(self.speed, self.z, self.beta, self.gamma, self.n))
    hysteretic = property(lambda self: (1 - self.alpha) * self.stiffness * self.z)
    elastic = property(lambda self: self.alpha * self.stiffness * self.stretch)
    restoring = property(lambda self: self.elastic + self.hysteretic)
    potential = energy(lambda self: (self.elastic * self.stretch + self.hysteretic * self.z / self.A) / 2)
    lossPower = dissipation(lambda self: self.hysteretic * self.yielding / self.A)

    @property
    def stretch(self) -> Expression:
        """How far it is stretched."""
        raise NotImplementedError

    @property
    def stiffness(self) -> Expression:
        """Its stiffness before it yields."""
        raise NotImplementedError

    def equations(self) -> Stated:
        yield der(self.z) == self.A * self.speed - self.yielding
