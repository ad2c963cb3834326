"""Absorbers: tuned masses and inerters that take a structure's motion."""

from __future__ import annotations

from typing import Any

from ...components import CubicSpring, Damper, Inerter, Mass, Spring, SpringDamper, TwoFlanges
from ...components.language import Component, Stated, parameter, variable
from ..two_terminal import parallel, series


class _TunedMass(TwoFlanges):
    m = parameter("kg", "mass", above=0)
    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    f = variable("N", "force on the structure")

    mass = Mass(m=m)
    link = SpringDamper(k=k, d=d)

    def equations(self) -> Stated:
        yield self.f == self.flange_b.f

    def connections(self) -> Stated:
        yield self.flange_b, self.link.flange_a
        yield self.link.flange_b, self.mass.flange


class TMD(_TunedMass):
    """Tuned mass damper: a mass on spring and damper at flange_b; nothing acts on flange_a.

    Args:
        m: mass [kg]; k: stiffness [N/m]; d: damping constant [N.s/m].

    Source: J. P. Den Hartog, Mechanical Vibrations, 4th ed. (1956), section 3.3.
    """

    def equations(self) -> Stated:
        yield self.flange_a.f == 0.0


class TMDI(_TunedMass):
    """Tuned mass damper inerter: a mass on spring and damper at flange_b, and an inerter from it to flange_a.

    Args:
        m: mass [kg]; k: stiffness [N/m]; d: damping constant [N.s/m].
        b: inertance [kg], above 0; without inerter it is a `TMD`.
        inerter: instead of the ideal one.

    Source: Marian & Giaralis, Probabilistic Engineering Mechanics 38 (2014) 156-164.
    """

    b = parameter("kg", "inertance", min=0, default=0.0)

    inerter: Component = Inerter(b=b)

    def connections(self) -> Stated:
        yield from super().connections()
        yield self.mass.flange, self.inerter.flange_b
        yield self.inerter.flange_a, self.flange_a


class NES(TwoFlanges):
    """Nonlinear energy sink: a mass at flange_b on a damper and a cubic spring; nothing acts on flange_a.

    Without a frequency of its own it resonates with any, once the motion is large enough, and takes the
    energy.

    Args:
        m: mass [kg].
        k3: cubic stiffness [N/m3].
        d: damping constant [N.s/m].
        k: linear stiffness [N/m], small.

    Source: A. F. Vakakis, O. V. Gendelman, Energy pumping in nonlinear mechanical oscillators: Part II,
    J. Appl. Mech. 68 (2001) 42-48.
    """

    m = parameter("kg", "mass", above=0)
    k3 = parameter("N/m3", "cubic stiffness", above=0)
    d = parameter("N.s/m", "damping constant", min=0)
    k = parameter("N/m", "linear stiffness", min=0, default=0.0)
    f = variable("N", "force on the structure")

    mass = Mass(m=m)
    spring = CubicSpring(k=k, k3=k3)
    damper = Damper(d=d)

    def equations(self) -> Stated:
        yield self.f == self.flange_b.f
        yield self.flange_a.f == 0.0

    def connections(self) -> Stated:
        yield self.flange_b, self.spring.flange_a, self.damper.flange_a
        yield self.spring.flange_b, self.damper.flange_b, self.mass.flange


def tid(k: float, d: float, b: float | Component) -> Any:
    """Return a tuned inerter damper: `link` of spring and damper in series with `inerter`.

    Args:
        k: stiffness [N/m].
        d: damping constant [N.s/m].
        b: inertance [kg], or an inerter of your own, such as `ge_wang.planetary_inerter()`.

    Source: Lazar, Neild & Wagg, Earthquake Eng. Struct. Dyn. 43 (2014) 1129-1147.
    """
    return series(link=SpringDamper(k=k, d=d), inerter=_inerter(b))


def tvmd(k: float, d: float, b: float | Component) -> Any:
    """Return a tuned viscous mass damper: `spring` in series with `inerter` and `damper` in parallel.

    Args:
        k: stiffness [N/m].
        d: damping constant [N.s/m].
        b: inertance [kg], or an inerter of your own.

    Source: Ikago, Saito & Inoue, Earthquake Eng. Struct. Dyn. 41 (2012) 453-474.
    """
    return series(spring=Spring(k=k), pair=parallel(inerter=_inerter(b), damper=Damper(d=d)))


def _inerter(b: float | Component) -> Component:
    return b if isinstance(b, Component) else Inerter(b=b)
