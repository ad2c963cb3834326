"""Springs and dampers given by points: curves over stretch or speed, and maps over both."""

from ..curves import area, between, curve, over_grid, smoothness, surface
from ..language import Stated, dissipation, energy, parameter
from ..point_laws import PointLaw, law, oddness, variable_of_law
from .compliances import Compliant, Dissipative


class TabulatedSpring(Compliant):
    """Spring given by points: f = F(s_rel - s_rel0), straight beyond the first and the last of them.

    `load_points` reads them from a file.

    Source: interpolation="smooth" by F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.

    Example:
        >>> from inertance import TabulatedSpring
        >>> mount = TabulatedSpring(table=((-0.01, -900.0), (0.0, 0.0), (0.01, 400.0)))
    """

    table = curve("stretch [m], force [N]")
    interpolation = smoothness()
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    e = property(lambda self: self.s_rel - self.s_rel0)
    potential = energy(lambda self: area(self.table, self.e, self.interpolation))

    def equations(self) -> Stated:
        yield self.f == between(self.table, self.e, self.interpolation)


class TabulatedDamper(Dissipative):
    """Damper given by points, as a dynamometer measures it: f = F(v_rel), straight beyond the ends.

    Source: as for `TabulatedSpring`.
    """

    table = curve("speed [m/s], force [N]")
    interpolation = smoothness()

    def equations(self) -> Stated:
        yield self.f == between(self.table, self.v_rel, self.interpolation)


class MapSpringDamper(Dissipative):
    """Force given over stretch and speed: f = F(s_rel - s_rel0, v_rel), bilinear or by cubic pieces.

    What it has at rest, F(s_rel - s_rel0, 0), is stored, the rest lost: below 0 where the points give power.

    Limits: beyond the grid it goes on straight in either direction. Smooth, it may overshoot its points.
    """

    table = surface("stretch [m], speed [m/s], force [N]")
    interpolation = smoothness()
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    e = property(lambda self: self.s_rel - self.s_rel0)
    map = property(lambda self: over_grid(self.table, self.interpolation))
    potential = energy(lambda self: self.map.area(self.e, 0.0))
    lossPower = dissipation(lambda self: (self.f - self.map.value(self.e, 0.0)) * self.v_rel)

    def equations(self) -> Stated:
        yield self.f == self.map.value(self.e, self.v_rel)


class TabulatedForce(Dissipative):
    """Force that is any law of position, speed or both: f = F(s_rel - s_rel0, v_rel), given by points.

    What it has at rest is stored, the rest lost: below 0 where the points give power. Of one variable
    interpolation="smooth" never overshoots its points, so that the law is monotone where they are.

    Limits: beyond the points it goes on straight. A step is a steep line: nothing sticks.
    """

    table = law("stretch [m]", "speed [m/s]", "force [N]")
    over = variable_of_law()
    interpolation = smoothness()
    odd = oddness()
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    e = property(lambda self: self.s_rel - self.s_rel0)
    points = property(lambda self: PointLaw(self.table, self.over, self.interpolation, self.odd))
    potential = energy(lambda self: self.points.stored(self.e))
    lossPower = dissipation(lambda self: (self.f - self.points.at_rest(self.e)) * self.v_rel)

    def equations(self) -> Stated:
        yield self.f == self.points.force(self.e, self.v_rel)
