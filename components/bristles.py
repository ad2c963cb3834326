"""Friction of bristles, which bend before they slip, for sliding and for turning."""

import casadi as ca

from .language import Expression, Stated, der, dissipation, energy
from .lossy import Rubbing


class Bristles(Rubbing):
    """Bristles that bend by z: sigma_0 z + sigma_1 z' + sigma_2 v with z' = v - sigma_0 |v| z/g.

    A subclass declares z, sigma_0, sigma_1 and sigma_2, gives `speed` v and `level` g, and states its force
    by `rubbing`.
    """

    rubbing = property(
        lambda self: self.sigma_0 * self.z + self.sigma_1 * der(self.z) + self.sigma_2 * self.speed
    )
    potential = energy(lambda self: self.sigma_0 * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.rubbing * self.speed - self.sigma_0 * self.z * der(self.z))

    @property
    def level(self) -> Expression:
        """What they resist with, bent fully, at a steady speed."""
        raise NotImplementedError

    def equations(self) -> Stated:
        yield der(self.z) == self.speed - self.sigma_0 * ca.fabs(self.speed) / self.level * self.z
