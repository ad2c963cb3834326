"""Turning springs and dampers given by points."""

from ..curves import between, curve, smoothness
from ..language import Stated, parameter, variable
from .compliances import Compliant, CompliantWithSpeed


class TabulatedSpring(Compliant):
    """Spring given by points: tau = T(phi_rel - phi_rel0), straight beyond the first and the last of them.

    `load_points` reads them from a file.

    Source: interpolation="smooth" by F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.
    """

    table = curve("twist [rad], torque [N.m]")
    interpolation = smoothness()
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Stated:
        yield self.tau == between(self.table, self.phi_rel - self.phi_rel0, self.interpolation)


class TabulatedDamper(CompliantWithSpeed):
    """Damper given by points: tau = T(w_rel), straight beyond the first and the last of them.

    Source: as for `TabulatedSpring`.
    """

    table = curve("speed [rad/s], torque [N.m]")
    interpolation = smoothness()
    lossPower = variable("W", "dissipated power")

    def equations(self) -> Stated:
        yield self.tau == between(self.table, self.w_rel, self.interpolation)
        yield self.lossPower == self.tau * self.w_rel
