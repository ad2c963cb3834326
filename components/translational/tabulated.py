"""Springs and dampers given by points: curves over stretch or speed, and maps over both."""

from ..curves import between, curve, over_grid, smoothness, surface
from ..language import Stated, parameter, variable
from .compliances import Compliant, CompliantWithSpeed


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

    def equations(self) -> Stated:
        yield self.f == between(self.table, self.s_rel - self.s_rel0, self.interpolation)


class TabulatedDamper(CompliantWithSpeed):
    """Damper given by points, as a dynamometer measures it: f = F(v_rel), straight beyond the ends.

    Source: as for `TabulatedSpring`.
    """

    table = curve("speed [m/s], force [N]")
    interpolation = smoothness()
    lossPower = variable("W", "dissipated power")

    def equations(self) -> Stated:
        yield self.f == between(self.table, self.v_rel, self.interpolation)
        yield self.lossPower == self.f * self.v_rel


class MapSpringDamper(CompliantWithSpeed):
    """Force given over stretch and speed: f = F(s_rel - s_rel0, v_rel), bilinear or by cubic pieces.

    Limits: beyond the grid it goes on straight in either direction. Smooth, it may overshoot its points.
    """

    table = surface("stretch [m], speed [m/s], force [N]")
    interpolation = smoothness()
    s_rel0 = parameter("m", "unstretched length", default=0.0)

    def equations(self) -> Stated:
        yield self.f == over_grid(self.table, self.s_rel - self.s_rel0, self.v_rel, self.interpolation)
