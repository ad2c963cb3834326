"""Springs, dampers, the inerter and backlash: torques between two flanges."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import casadi as ca

from ..base import der, parameter, variable
from .bases import Compliant, CompliantWithSpeed


class Spring(Compliant):
    """Linear spring: tau = c (phi_rel - phi_rel0).

    Source: MSL Rotational.Components.Spring.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Iterable[Any]:
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0)


class Damper(CompliantWithSpeed):
    """Linear damper: tau = d w_rel.

    Source: MSL Rotational.Components.Damper.
    """

    d = parameter("N.m.s/rad", "damping constant", min=0)

    def equations(self) -> Iterable[Any]:
        yield self.tau == self.d * self.w_rel


class SpringDamper(CompliantWithSpeed):
    """Linear spring and damper in parallel: tau = c (phi_rel - phi_rel0) + d w_rel.

    Source: MSL Rotational.Components.SpringDamper.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    d = parameter("N.m.s/rad", "damping constant", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Iterable[Any]:
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel


class QuadraticDamper(CompliantWithSpeed):
    """Damper with torque growing with the square of speed (a fan): tau = k w_rel |w_rel|."""

    k = parameter("N.m.s2/rad2", "quadratic damping constant", min=0)

    def equations(self) -> Iterable[Any]:
        yield self.tau == self.k * self.w_rel * ca.fabs(self.w_rel)


class Inerter(CompliantWithSpeed):
    """A flywheel between two shafts that feels their relative motion only: tau = J a_rel.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, section II.
    """

    J = parameter("kg.m2", "rotational inertance", min=0)
    a_rel = variable("rad/s2", "relative acceleration of the flanges")

    def equations(self) -> Iterable[Any]:
        yield self.a_rel == der(self.w_rel)
        yield self.tau == self.J * self.a_rel


class ElastoBacklash(CompliantWithSpeed):
    """Backlash b between elastic flanks that only ever press.

    With x = phi_rel - phi_rel0 and the spring torque tau_c = c max(|x| - b/2, 0) of the flank in
    contact, tau = sgn(x) max(tau_c + min(tau_c, sgn(x) d w_rel), 0): damping adds at most tau_c as
    the flank is pressed, and takes away at most tau_c as it is released, so tau is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, whose law with b = 0 is the plain spring and
    damper instead.
    """

    c = parameter("N.m/rad", "stiffness in contact", above=0)
    d = parameter("N.m.s/rad", "damping constant in contact", min=0)
    b = parameter("rad", "total backlash", min=0, default=0.0)
    phi_rel0 = parameter("rad", "angle in the middle of the backlash", default=0.0)

    def pressed(self, depth: Any, speed: Any) -> Any:
        """Torque of one flank, from how deep and how fast it is pressed."""
        spring = self.c * ca.fmax(depth, 0)
        return ca.fmax(spring + ca.fmin(spring, self.d * speed), 0)

    def equations(self) -> Iterable[Any]:
        x, w, half = self.phi_rel - self.phi_rel0, self.w_rel, self.b / 2
        yield self.tau == self.pressed(x - half, w) - self.pressed(-x - half, -w)
