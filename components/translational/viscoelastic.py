"""Rubber: springs and dampers with memory, of whole and of fractional order."""

from ...base import between, counting, demand
from ..fractional import largest_error, oustaloup
from ..language import Component, Stated, der, option, parameter, variable
from .compliances import Compliant


class Maxwell(Compliant):
    """Spring and damper in series, without mass between them: f = k (s_rel - s_rel0 - z), d z' = f.

    Several in `parallel` with a `Spring` are the Prony series of a rubber, branch i relaxing in d_i/k_i.

    Source: J. C. Maxwell, Phil. Trans. R. Soc. 157 (1867) 49-88.
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", above=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    z = variable("m", "stretch of the damper")
    lossPower = variable("W", "dissipated power")

    def equations(self) -> Stated:
        yield self.f == self.k * (self.s_rel - self.s_rel0 - self.z)
        yield self.d * der(self.z) == self.f
        yield self.lossPower == self.f * der(self.z)


class Zener(Compliant):
    """Standard linear solid, a spring beside a Maxwell element: f = k_0 e + k (e - z), d z' = k (e - z).

    e = s_rel - s_rel0. Its stiffness grows from k_0, held slowly, to k_0 + k, shaken fast.

    Source: C. Zener, Elasticity and Anelasticity of Metals (1948).
    """

    k_0 = parameter("N/m", "static stiffness", min=0)
    k = parameter("N/m", "stiffness that relaxes", min=0)
    d = parameter("N.s/m", "damping constant", above=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    z = variable("m", "stretch of the damper")
    lossPower = variable("W", "dissipated power")

    def equations(self) -> Stated:
        e = self.s_rel - self.s_rel0
        yield self.f == self.k_0 * e + self.k * (e - self.z)
        yield self.d * der(self.z) == self.k * (e - self.z)
        yield self.lossPower == self.d * der(self.z) * der(self.z)


class FractionalBranch(Component):
    """One branch of a `FractionalDamper`: the stretch of its damper."""

    z = variable("m", "stretch of the damper")


class FractionalDamper(Compliant):
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
    lossPower = variable("W", "dissipated power")

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

    def equations(self) -> Stated:
        e = self.s_rel - self.s_rel0
        static, stiffnesses, rates = oustaloup(self.alpha, self.w_low, self.decades, self.n)
        force, loss = self.c * static * e, 0.0
        for i, (stiffness, rate) in enumerate(zip(stiffnesses, rates, strict=True), start=1):
            z = getattr(self, f"branch{i}").z
            yield der(z) == rate * (e - z)
            force = force + self.c * stiffness * (e - z)
            loss = loss + self.c * stiffness * rate * (e - z) ** 2
        yield self.f == force
        yield self.lossPower == loss
