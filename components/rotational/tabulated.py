"""Turning springs and dampers given by points."""

from ..curves import area, between, curve, smoothness
from ..language import Stated, energy, parameter
from .compliances import Compliant, Dissipative


class TabulatedSpring(Compliant):
    """Spring given by points: tau = T(phi_rel - phi_rel0), straight beyond the first and the last of them.

    `load_points` reads them from a file.

    Source: interpolation="smooth" by F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.
    """

    table = curve("twist [rad], torque [N.m]")
    interpolation = smoothness()
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    e = property(lambda self: self.phi_rel - self.phi_rel0)
    potential = energy(lambda self: area(self.table, self.e, self.interpolation))

    def equations(self) -> Stated:
        yield self.tau == between(self.table, self.e, self.interpolation)


class TabulatedDamper(Dissipative):
    """Damper given by points: tau = T(w_rel), straight beyond the first and the last of them.

    Source: as for `TabulatedSpring`.
    """

    table = curve("speed [rad/s], torque [N.m]")
    interpolation = smoothness()

    def equations(self) -> Stated:
        yield self.tau == between(self.table, self.w_rel, self.interpolation)
