"""Sources: forces and prescribed motions, from a signal."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..base import Component, RealInput, TranslationalFlange, der, parameter, variable


class _Driven(Component):
    flange = TranslationalFlange("what is driven")
    support = TranslationalFlange("what reacts", optional=True)

    def equations(self) -> Iterable[Any]:
        yield self.support.f == -self.flange.f


class Force(_Driven):
    """A force that acts on a flange: flange.f = -f, so positive f accelerates it.

    Source: MSL Translational.Sources.Force.
    """

    f = RealInput("N", "driving force")

    def equations(self) -> Iterable[Any]:
        yield self.flange.f == -self.f


class Position(_Driven):
    """A prescribed position: flange.s - support.s = s_ref. Its velocity and acceleration follow.

    Source: MSL Translational.Sources.Position with exact=true.
    """

    s_ref = RealInput("m", "position")

    def equations(self) -> Iterable[Any]:
        yield self.flange.s - self.support.s == self.s_ref


class Speed(_Driven):
    """A prescribed velocity: der(s) = v_ref, from the start position s.

    Source: MSL Translational.Sources.Speed with exact=true.
    """

    v_ref = RealInput("m/s", "velocity")
    s = variable("m", "position against the support")

    def equations(self) -> Iterable[Any]:
        yield self.s == self.flange.s - self.support.s
        yield der(self.s) == self.v_ref


class Accelerate(_Driven):
    """A prescribed acceleration: der(v) = a_ref, from the start position s and velocity v.

    Source: MSL Translational.Sources.Accelerate.
    """

    a_ref = RealInput("m/s2", "acceleration")
    s = variable("m", "position against the support")
    v = variable("m/s", "velocity against the support")

    def equations(self) -> Iterable[Any]:
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield der(self.v) == self.a_ref


class ConstantForce(_Driven):
    """A constant force, such as weight: flange.f = -f_constant.

    Source: MSL Translational.Sources.ConstantForce.
    """

    f_constant = parameter("N", "driving force")

    def equations(self) -> Iterable[Any]:
        yield self.flange.f == -self.f_constant
