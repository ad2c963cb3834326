"""Rubber: springs and dampers with memory, of whole and of fractional order."""

from ...base import between, counting, demand
from ..fractional import largest_error, oustaloup
from ..language import Component, Expression, Stated, der, dissipation, energy, option, parameter, variable
from ..lossy import Lossy
from ..relaxing import Relaxing
from .compliances import Compliant


class Maxwell(Compliant, Lossy):
    """Spring and damper in series, without mass between them: f = k (s_rel - s_rel0 - z), d z' = f.

    Several in `parallel` with a `Spring` are the Prony series of a rubber, branch i relaxing in d_i/k_i.

    Source: J. C. Maxwell, Phil. Trans. R. Soc. 157 (1867) 49-88.
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", above=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    z = variable("m", "stretch of the damper")
    potential = energy(lambda self: self.f * (self.s_rel - self.s_rel0 - self.z) / 2)
    lossPower = dissipation(lambda self: self.d * der(self.z) ** 2)

    def equations(self) -> Stated:
        yield self.f == self.k * (self.s_rel - self.s_rel0 - self.z)
        yield self.d * der(self.z) == self.f


class RelaxingSpring(Compliant, Relaxing):
    """A `Maxwell` element by its time: f = k (e - z), T z' = e - z with e = s_rel - s_rel0.

    Also without stiffness it is one, unlike spring and damper: f = 0.
    """

    k = parameter("N/m", "stiffness when shaken fast", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    z = variable("m", "stretch that has relaxed")

    @property
    def stretch(self) -> Expression:
        return self.s_rel - self.s_rel0

    @property
    def stiffness(self) -> Expression:
        return self.k

    def equations(self) -> Stated:
        yield self.f == self.k * self.elastic


class Zener(Compliant, Lossy):
    """Standard linear solid, a spring beside a Maxwell element: f = k_0 e + k (e - z), d z' = k (e - z).

    e = s_rel - s_rel0. Its stiffness grows from k_0, held slowly, to k_0 + k, shaken fast.

    Source: C. Zener, Elasticity and Anelasticity of Metals (1948).
    """

    k_0 = parameter("N/m", "static stiffness", min=0)
    k = parameter("N/m", "stiffness that relaxes", min=0)
    d = parameter("N.s/m", "damping constant", above=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    z = variable("m", "stretch of the damper")
    e = property(lambda self: self.s_rel - self.s_rel0)
    potential = energy(lambda self: (self.k_0 * self.e**2 + self.k * (self.e - self.z) ** 2) / 2)
    lossPower = dissipation(lambda self: self.d * der(self.z) ** 2)

    def equations(self) -> Stated:
        yield self.f == self.k_0 * self.e + self.k * (self.e - self.z)
        yield self.d * der(self.z) == self.k * (self.e - self.z)


class FractionalBranch(Component):
    """One branch of a `FractionalDamper`: the stretch of its damper."""

    z = variable("m", "stretch of the damper")


class FractionalDamper(Compliant, Lossy):
    """Between a spring and a damper, as rubber is: f = c D^alpha (s_rel - s_rel0), by n Maxwell branches.

    The dynamic stiffness c (j w)^alpha is met between w_low and w_high; below, it stays at c w_low^alpha,
    above, at c w_high^alpha, w_high being w_low 10^decades. `error()` tells how well: with two branches a
    decade, a decade inside the ends, within 2 % for alpha = 0.2, 5 % for 0.5 and 9 % for 0.9; two decades
    inside, within 1 %.

    Source: A. Oustaloup et al., IEEE Trans. Circuits Syst. I 47 (2000) 25-39; on rubber, R. L. Bagley,
    P. J. Torvik, J. Rheology 27 (1983) 201-210.

    Example:
        >>> from inertance import FractionalDamper
        >>> mount = FractionalDamper(c=1e4, alpha=0.3, w_low=1.0, decades=4.0, n=12)
        >>> mount.error() < 0.03  # from 10 rad/s to 1000 rad/s
        True
    """

    c = parameter("N.s^alpha/m", "dynamic stiffness at 1 rad/s", min=0)
    alpha = parameter("1", "order of the derivative, below 1", above=0, max=1)
    w_low = parameter("rad/s", "lower end of the band", above=0)
    decades = parameter("1", "width of the band in decades", above=0, max=30)
    n = option("number of branches in the band", default=8, check=counting)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    e = property(lambda self: self.s_rel - self.s_rel0)
    potential = energy(
        lambda self: (self.static * self.e**2 + sum(k * (self.e - z) ** 2 for k, _, z in self.branches)) / 2
    )
    lossPower = dissipation(lambda self: sum(k * rate * (self.e - z) ** 2 for k, rate, z in self.branches))

    def error(self, share: float = 0.5) -> float:
        """Return the largest relative error of the dynamic stiffness in the middle share of the band.

        Args:
            share: of the logarithm of the band, 1 for all of it.

        Raises:
            ModelError: for a share that is not above 0 and at most 1.
        """
        demand("error()", share=(share, between(1e-3, 1.0)))
        return largest_error(self.alpha, self.w_low, self.decades, self.n, share)

    def parts(self) -> dict[str, Component]:
        """Return the branches."""
        return {f"branch{i}": FractionalBranch() for i in range(1, self.n + 1)}

    @property
    def branches(self) -> list[tuple[Expression, Expression, Expression]]:
        """Stiffness, rate and stretch of the damper of each branch."""
        _, stiffnesses, rates = oustaloup(self.alpha, self.w_low, self.decades, self.n)
        stretches = [getattr(self, f"branch{i}").z for i in range(1, self.n + 1)]
        return [(self.c * k, *rest) for k, *rest in zip(stiffnesses, rates, stretches, strict=True)]

    @property
    def static(self) -> Expression:
        """Stiffness below the band."""
        return self.c * self.w_low**self.alpha

    def equations(self) -> Stated:
        for _, rate, z in self.branches:
            yield der(z) == rate * (self.e - z)
        yield self.f == self.static * self.e + sum(k * (self.e - z) for k, _, z in self.branches)
