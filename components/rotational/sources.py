"""Sources: torques and prescribed motions, from a signal."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..base import Component, RealInput, RotationalFlange, der, parameter, variable


class _Driven(Component):
    flange = RotationalFlange("what is driven")
    support = RotationalFlange("what reacts", optional=True)

    def equations(self) -> Iterable[Any]:
        yield self.support.tau == -self.flange.tau


class Torque(_Driven):
    """A torque that acts on a flange: flange.tau = -tau, so positive tau accelerates it.

    Source: MSL Rotational.Sources.Torque.
    """

    tau = RealInput("N.m", "driving torque")

    def equations(self) -> Iterable[Any]:
        yield self.flange.tau == -self.tau


class ConstantTorque(_Driven):
    """A constant torque: flange.tau = -tau_constant.

    Source: MSL Rotational.Sources.ConstantTorque.
    """

    tau_constant = parameter("N.m", "driving torque")

    def equations(self) -> Iterable[Any]:
        yield self.flange.tau == -self.tau_constant


class Position(_Driven):
    """A prescribed angle: flange.phi - support.phi = phi_ref. Its speed and acceleration follow.

    Source: MSL Rotational.Sources.Position with exact=true.
    """

    phi_ref = RealInput("rad", "angle")

    def equations(self) -> Iterable[Any]:
        yield self.flange.phi - self.support.phi == self.phi_ref


class Speed(_Driven):
    """A prescribed speed: der(phi) = w_ref, from the start angle phi.

    Source: MSL Rotational.Sources.Speed with exact=true.
    """

    w_ref = RealInput("rad/s", "speed")
    phi = variable("rad", "angle against the support")

    def equations(self) -> Iterable[Any]:
        yield self.phi == self.flange.phi - self.support.phi
        yield der(self.phi) == self.w_ref


class Accelerate(_Driven):
    """A prescribed acceleration: der(w) = a_ref, from the start angle phi and speed w.

    Source: MSL Rotational.Sources.Accelerate.
    """

    a_ref = RealInput("rad/s2", "acceleration")
    phi = variable("rad", "angle against the support")
    w = variable("rad/s", "speed against the support")

    def equations(self) -> Iterable[Any]:
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        yield der(self.w) == self.a_ref
