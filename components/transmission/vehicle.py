"""A vehicle as one body on a driven wheel, with what resists it."""

import casadi as ca

from ..language import (
    Component,
    Expression,
    RealInput,
    RotationalFlange,
    Stated,
    TranslationalFlange,
    option,
    parameter,
    variable,
)
from ..rotational import Inertia
from ..translational import ConstantSpeed, Mass, QuadraticDamper, RollingResistance, Speed
from .conversions import RollingWheel

STANDARD_GRAVITY = 9.80665  # [m/s2]


class Slope(Component):
    """Weight along a road that rises: flange.f = m g sin(alpha), tan(alpha) the inclination."""

    has_law = False
    flange = TranslationalFlange("what is on the road")
    useInclinationInput = option("whether the slope comes in", default=False, choices=(False, True))
    inclination = RealInput("1", "tangent of the slope", when="useInclinationInput")
    inclinationConstant = parameter("1", "tangent of the slope", default=0.0)
    weight = parameter("N", "weight", min=0)

    def equations(self) -> Stated:
        slope = self.inclination if self.useInclinationInput else self.inclinationConstant
        yield self.flange.f == self.weight * slope / ca.sqrt(1 + slope**2)


class Vehicle(Component):
    """A vehicle on a road: (m + J/R^2) a = tau/R + f - air - rolling - m g sin(alpha), s = R phi.

    air = Cd A rho/2 (v - vWind) |v - vWind|, rolling = Cr m g cos(alpha) with the sign of v, which goes
    through zero in a straight line between -vReg and vReg; tan(alpha) is the inclination. It is driven at
    flangeR, and may be coupled at flangeT; each may stay free.

    Source: MSL Translational.Components.Vehicle.

    Example:
        >>> from inertance import Vehicle
        >>> car = Vehicle(m=1200.0, J=2.0, R=0.3, A=2.0, Cd=0.3)
    """

    flangeR = RotationalFlange("the wheel", free=True)
    flangeT = TranslationalFlange("the vehicle", free=True)
    m = parameter("kg", "mass", above=0)
    g = parameter("m/s2", "gravity", min=0, default=STANDARD_GRAVITY)
    J = parameter("kg.m2", "inertia of what turns with the wheels", above=0)
    R = parameter("m", "rolling radius", above=0)
    A = parameter("m2", "cross-section", min=0, default=1.0)
    Cd = parameter("1", "drag coefficient", min=0, default=0.5)
    rho = parameter("kg/m3", "density of the air", min=0, default=1.2)
    useWindInput = option("whether the wind comes in as vWind", default=False, choices=(False, True))
    vWind = RealInput("m/s", "speed of the wind", when="useWindInput")
    vWindConstant = parameter("m/s", "speed of the wind", default=0.0)
    useCrInput = option("whether Cr comes in as cr", default=False, choices=(False, True))
    cr = RealInput("1", "rolling resistance coefficient", when="useCrInput")
    CrConstant = parameter("1", "rolling resistance coefficient", min=0, default=0.015)
    vReg = parameter("m/s", "speed below which rolling resistance is rounded", above=0, default=1e-3)
    useInclinationInput = option(
        "whether the slope comes in as inclination", default=False, choices=(False, True)
    )
    inclination = RealInput("1", "tangent of the slope", when="useInclinationInput")
    inclinationConstant = parameter("1", "tangent of the slope", default=0.0)
    s = variable("m", "position")
    v = variable("m/s", "speed")
    a = variable("m/s2", "acceleration")

    mass = Mass(m=m)
    inertia = Inertia(J=J)
    wheel = RollingWheel(R=R)
    drag = QuadraticDamper(c=lambda self: self.Cd * self.A * self.rho / 2)

    def parts(self) -> dict[str, Component]:
        """Return what options shape: wind, rolling resistance and slope."""
        own = type(self)
        sloped = {
            "useInclinationInput": self.useInclinationInput,
            "inclinationConstant": own.inclinationConstant,
        }
        roll = RollingResistance(
            fWeight=_weight, useCrInput=self.useCrInput, CrConstant=own.CrConstant, reg="Linear", v0=own.vReg,
            **sloped,
        )  # fmt: skip
        wind = Speed() if self.useWindInput else ConstantSpeed(v_fixed=own.vWindConstant)
        return {"wind": wind, "roll": roll, "slope": Slope(weight=_weight, **sloped)}

    def equations(self) -> Stated:
        yield self.s == self.mass.s
        yield self.v == self.mass.v
        yield self.a == self.mass.a

    def connections(self) -> Stated:
        yield self.flangeR, self.inertia.flange, self.wheel.flange_r
        yield (
            self.flangeT,
            self.mass.flange,
            self.wheel.flange_t,
            self.drag.flange_b,
            self.roll.flange,
            self.slope.flange,
        )
        yield self.wind.flange, self.drag.flange_a
        if self.useWindInput:
            yield self.vWind, self.wind.v_ref
        if self.useCrInput:
            yield self.cr, self.roll.cr
        if self.useInclinationInput:
            yield self.inclination, self.roll.inclination, self.slope.inclination


def _weight(vehicle: Vehicle) -> Expression:
    return vehicle.m * vehicle.g
