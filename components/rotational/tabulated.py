"""Turning springs and dampers given by points."""

from ..curves import area, between, curve, smoothness
from ..language import Stated, dissipation, energy, parameter
from ..point_laws import PointLaw, law, oddness, variable_of_law
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


class TabulatedForce(Dissipative):
    """Torque by any law of angle, speed or both: tau = F(phi_rel - phi_rel0, w_rel), given by points.

    What it has at rest is stored, the rest lost: below 0 where the points give power. Of one variable
    interpolation="smooth" never overshoots its points, so that the law is monotone where they are.

    Limits: beyond the points it goes on straight. A step is a steep line: nothing sticks.
    """

    table = law("twist [rad]", "speed [rad/s]", "torque [N.m]")
    over = variable_of_law()
    interpolation = smoothness()
    odd = oddness()
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    e = property(lambda self: self.phi_rel - self.phi_rel0)
    points = property(lambda self: PointLaw(self.table, self.over, self.interpolation, self.odd))
    potential = energy(lambda self: self.points.stored(self.e))
    lossPower = dissipation(lambda self: (self.tau - self.points.at_rest(self.e)) * self.w_rel)

    def equations(self) -> Stated:
        yield self.tau == self.points.force(self.e, self.w_rel)
