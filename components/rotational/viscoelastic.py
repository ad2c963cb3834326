"""Rubber that is twisted."""

from ..language import Expression, Stated, parameter, variable
from ..relaxing import Relaxing
from .compliances import Compliant


class RelaxingSpring(Compliant, Relaxing):
    """Spring and damper in series by the time in which they relax: tau = c (e - z), T z' = e - z.

    e = phi_rel - phi_rel0.
    """

    c = parameter("N.m/rad", "stiffness when shaken fast", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    z = variable("rad", "twist that has relaxed")

    @property
    def stretch(self) -> Expression:
        return self.phi_rel - self.phi_rel0

    @property
    def stiffness(self) -> Expression:
        return self.c

    def equations(self) -> Stated:
        yield self.tau == self.c * self.elastic
