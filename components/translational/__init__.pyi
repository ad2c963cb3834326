"""Elements that slide."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any, Literal

import numpy as np

from ..bars import Bar, LumpedBar, ModalBar
from ..bristles import Bristles
from ..elastoplastic import ElastoPlastic
from ..filtered import Filtered
from ..hysteresis import HystereticSpring
from ..iwan import IwanCells
from ..language import Component, Number, ParameterValue, SignalValue
from ..lossy import AtTemperature, Lossy
from ..pressed import PressedStickSlip
from ..relaxing import Relaxing
from ..relaxing_flanks import RelaxingFlanks
from ..stickslip import StickSlip

class DrivenFlange(Component):
    """A flange that is driven, and the support that takes the reaction."""

    flange: Any
    """what is driven"""
    support: Any
    """what reacts"""
    def __init__(self, **values: Any) -> None: ...

class Fixed(Component):
    """A flange held at a constant position: s = s0.

    Source: MSL Translational.Components.Fixed.

    Args:
        s0: position [m].
    """

    flange: Any
    """held flange"""
    s0: Any
    """position [m]"""
    def __init__(
        self,
        *,
        s0: ParameterValue = 0.0,
    ) -> None: ...

class ForceSensor(Component):
    """Force as a signal, between flanges that move as one: f = flange_a.f.

    f is positive where what is joined to flange_a pushes flange_b forward.

    Source: MSL Translational.Sensors.ForceSensor.
    """

    flange_a: Any
    """left flange"""
    flange_b: Any
    """right flange"""
    f: Any
    """force from flange_a to flange_b [N]"""
    def __init__(self) -> None: ...

class Mass(Component):
    """A sliding mass: m a = f, v = der(s), a = der(v).

    Source: MSL Translational.Components.Mass; a body with length is a `MassWithLength`.

    Args:
        m: mass [kg], above 0.
        s: position [m], fixed start value.
        v: velocity [m/s], fixed start value.
        a: acceleration [m/s2], fixed start value.
    """

    flange: Any
    """where it is joined"""
    m: Any
    """mass [kg], above 0"""
    s: Any
    """position [m], fixed start value"""
    v: Any
    """velocity [m/s], fixed start value"""
    a: Any
    """acceleration [m/s2], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
    ) -> None: ...

class MassWithLength(Component):
    """A sliding mass of length L: m a = f_a + f_b, flange_a.s = s - L/2, flange_b.s = s + L/2.

    s is the position of its middle. Either end may stay free.

    Source: MSL Translational.Components.Mass.

    Example:
        >>> from inertance import Fixed, HardStop, MassWithLength, Network
        >>> net = Network("car and buffer", wall=Fixed(), stop=HardStop(e=1.0))
        >>> net = net.add(car=MassWithLength(m=2.0, L=0.5, s=1.0, v=-1.0))
        >>> net = net.connect(net.wall.flange, net.stop.flange_a).connect(net.stop.flange_b, net.car.flange_a)
        >>> round(net.simulate(2.0).events[-1].time, 9)  # 0.75 m before the end at the stop meets it
        0.75

    Args:
        m: mass [kg], above 0.
        L: length from flange_a to flange_b [m], at least 0.
        left: Rod.
        mass: Mass.
        right: Rod.
        s: position of the middle [m], fixed start value.
        v: velocity [m/s], fixed start value.
        a: acceleration [m/s2], fixed start value.
    """

    flange_a: Any
    """left end"""
    flange_b: Any
    """right end"""
    m: Any
    """mass [kg], above 0"""
    L: Any
    """length from flange_a to flange_b [m], at least 0"""
    s: Any
    """position of the middle [m], fixed start value"""
    v: Any
    """velocity [m/s], fixed start value"""
    a: Any
    """acceleration [m/s2], fixed start value"""
    left: Any
    """Rod"""
    mass: Any
    """Mass"""
    right: Any
    """Rod"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        L: ParameterValue = 0.0,
        left: Component = ...,
        mass: Component = ...,
        right: Component = ...,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
    ) -> None: ...

class MassWithStopAndFriction(Component):
    """A mass that rubs on a support between two rigid stops (plastic unless `lower.e`, `upper.e`).

    Source: MSL Translational.Components.MassWithStopAndFriction.

    Args:
        m: mass [kg], above 0.
        s_min: lower stop [m].
        s_max: upper stop [m].
        d: viscous friction [N.s/m], at least 0.
        f_c: Coulomb friction force [N], at least 0.
        f_s: static friction force [N], at least 0.
        v_s: Stribeck velocity [m/s], above 0.
        peak: break-away force over f_s, at least 1.
        mass: Mass.
        friction: StribeckFriction.
        lower: HardStop.
        upper: HardStop.
        s: position [m], fixed start value.
        v: velocity [m/s], fixed start value.
        a: acceleration [m/s2], fixed start value.
    """

    flange: Any
    """where the mass is joined"""
    support: Any
    """what it slides on"""
    m: Any
    """mass [kg], above 0"""
    s_min: Any
    """lower stop [m]"""
    s_max: Any
    """upper stop [m]"""
    d: Any
    """viscous friction [N.s/m], at least 0"""
    f_c: Any
    """Coulomb friction force [N], at least 0"""
    f_s: Any
    """static friction force [N], at least 0"""
    v_s: Any
    """Stribeck velocity [m/s], above 0"""
    peak: Any
    """break-away force over f_s, at least 1"""
    s: Any
    """position [m], fixed start value"""
    v: Any
    """velocity [m/s], fixed start value"""
    a: Any
    """acceleration [m/s2], fixed start value"""
    mass: Any
    """Mass"""
    friction: Any
    """StribeckFriction"""
    lower: Any
    """HardStop"""
    upper: Any
    """HardStop"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        s_min: ParameterValue,
        s_max: ParameterValue,
        d: ParameterValue = 0.0,
        f_c: ParameterValue = 0.0,
        f_s: ParameterValue = ...,
        v_s: ParameterValue = 1.0,
        peak: ParameterValue = 1.0,
        mass: Component = ...,
        friction: Component = ...,
        lower: Component = ...,
        upper: Component = ...,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
    ) -> None: ...

class Rod(Component):
    """A rigid rod without mass: flange_b.s = flange_a.s + L.

    Source: MSL Translational.Components.Rod.

    Args:
        L: length from flange_a to flange_b [m].
    """

    flange_a: Any
    """left flange"""
    flange_b: Any
    """right flange"""
    L: Any
    """length from flange_a to flange_b [m]"""
    def __init__(
        self,
        *,
        L: ParameterValue = 0.0,
    ) -> None: ...

class SupportFriction(Component):
    """Friction of a sliding flange on a support, which is the ground when left unconnected.

    Example:
        >>> from inertance import CoulombFriction, SupportFriction
        >>> guide = SupportFriction(friction=CoulombFriction(f_c=10.0))

    Args:
        friction: CoulombFriction.
    """

    flange: Any
    """what slides"""
    support: Any
    """what it slides on"""
    friction: Any
    """CoulombFriction"""
    def __init__(
        self,
        *,
        friction: Component = ...,
    ) -> None: ...

class TwoFlanges(Component):
    """Two flanges and the distance between them: s_rel = flange_b.s - flange_a.s."""

    flange_a: Any
    """left flange"""
    flange_b: Any
    """right flange"""
    s_rel: Any
    """distance of the flanges [m], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class _Absolute(Component):
    flange: Any
    """where it is measured"""
    def __init__(self, **values: Any) -> None: ...

class _Levered(Component):
    flange_a: Any
    """end of arm a"""
    flange_b: Any
    """end of arm b"""
    support: Any
    """fulcrum"""
    def __init__(self, **values: Any) -> None: ...

class Accelerate(DrivenFlange):
    """A prescribed acceleration: der(v) = a_ref, from the start position s and velocity v.

    Source: MSL Translational.Sources.Accelerate.

    Args:
        a_ref: acceleration [m/s2], a number, a function of time or Sampled data.
        s: position against the support [m], fixed start value.
        v: velocity against the support [m/s], fixed start value.
    """

    a_ref: Any
    """acceleration [m/s2], a number, a function of time or Sampled data"""
    s: Any
    """position against the support [m], fixed start value"""
    v: Any
    """velocity against the support [m/s], fixed start value"""
    def __init__(
        self,
        *,
        a_ref: SignalValue = ...,
        s: Number = ...,
        v: Number = ...,
    ) -> None: ...

class AccelerationSensor(_Absolute):
    """Acceleration as a signal: a = der(v), v = der(flange.s).

    Source: MSL Translational.Sensors.AccSensor.

    Args:
        v: velocity [m/s], fixed start value.
    """

    a: Any
    """acceleration [m/s2]"""
    v: Any
    """velocity [m/s], fixed start value"""
    def __init__(
        self,
        *,
        v: Number = ...,
    ) -> None: ...

class Compliant(TwoFlanges):
    """Two flanges without mass between them: f = flange_b.f = -flange_a.f, tension positive."""

    f: Any
    """force between the flanges, positive when it pulls them together [N], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class ConstantForce(DrivenFlange):
    """A constant force, such as weight: flange.f = -f_constant.

    Source: MSL Translational.Sources.ConstantForce.

    Args:
        f_constant: driving force [N].
    """

    f_constant: Any
    """driving force [N]"""
    def __init__(
        self,
        *,
        f_constant: ParameterValue,
    ) -> None: ...

class ConstantSpeed(DrivenFlange):
    """A constant speed, exactly: der(s) = v_fixed, from the start position s.

    Source: MSL Translational.Sources.ConstantSpeed.

    Args:
        v_fixed: speed [m/s].
        s: position against the support [m], fixed start value.
    """

    v_fixed: Any
    """speed [m/s]"""
    s: Any
    """position against the support [m], fixed start value"""
    def __init__(
        self,
        *,
        v_fixed: ParameterValue,
        s: Number = ...,
    ) -> None: ...

class Force(DrivenFlange):
    """A force that acts on a flange: flange.f = -f, so positive f accelerates it.

    Source: MSL Translational.Sources.Force.

    Args:
        f: driving force [N], a number, a function of time or Sampled data.
    """

    f: Any
    """driving force [N], a number, a function of time or Sampled data"""
    def __init__(
        self,
        *,
        f: SignalValue = ...,
    ) -> None: ...

class LargeAngleLever(_Levered):
    """Lever at any angle: s_a = l_a sin(phi), s_b = l_b sin(phi + alpha), both from the fulcrum.

    l_a cos(phi) f_a + l_b cos(phi + alpha) f_b = 0: power is conserved. The ends slide on parallel
    guides; alpha = pi is a straight lever with the fulcrum between, alpha = 0 one with both arms on
    one side, anything else a bent one.

    Limits: where an arm lies along its guide, phi or phi + alpha = pi/2, is a dead centre: its flange
    moves no more whatever the lever does.

    Args:
        l_a: length of arm a [m], above 0.
        l_b: length of arm b [m], above 0.
        alpha: angle from arm a to arm b [rad].
        phi: angle of arm a [rad], fixed start value.
        w: angular velocity [rad/s], fixed start value.
    """

    l_a: Any
    """length of arm a [m], above 0"""
    l_b: Any
    """length of arm b [m], above 0"""
    alpha: Any
    """angle from arm a to arm b [rad]"""
    phi: Any
    """angle of arm a [rad], fixed start value"""
    w: Any
    """angular velocity [rad/s], fixed start value"""
    def __init__(
        self,
        *,
        l_a: ParameterValue,
        l_b: ParameterValue,
        alpha: ParameterValue = 3.141592653589793,
        phi: Number = ...,
        w: Number = ...,
    ) -> None: ...

class Lever(_Levered):
    """Lever at small angles: s_a = ratio s_b, ratio f_a + f_b = 0, s_a and s_b from the fulcrum.

    The ratio is arm a over arm b, negative when the fulcrum lies between the flanges.

    Args:
        ratio: motion of flange_a over motion of flange_b.
    """

    ratio: Any
    """motion of flange_a over motion of flange_b"""
    def __init__(
        self,
        *,
        ratio: ParameterValue,
    ) -> None: ...

class Move(DrivenFlange):
    """A motion that is given with its rates: s_ref, v_ref and a_ref, which must fit each other.

    der(v) = a_ref + 2 o (v_ref - v) + o^2 (s_ref - s) with v = der(s), o = 2 pi f_crit, from
    s_ref and v_ref. No derivative of a signal is needed; where they fit each other, it follows exactly.

    Source: MSL Translational.Sources.Move, which takes one vector u.

    Args:
        s_ref: position [m], a number, a function of time or Sampled data.
        v_ref: speed, the rate of s_ref [m/s], a number, a function of time or Sampled data.
        a_ref: acceleration, the rate of v_ref [m/s2], a number, a function of time or Sampled data.
        f_crit: frequency with which it is held on s_ref [Hz], above 0.
        s: position against the support [m], fixed start value.
        v: speed against the support [m/s], fixed start value.
    """

    s_ref: Any
    """position [m], a number, a function of time or Sampled data"""
    v_ref: Any
    """speed, the rate of s_ref [m/s], a number, a function of time or Sampled data"""
    a_ref: Any
    """acceleration, the rate of v_ref [m/s2], a number, a function of time or Sampled data"""
    f_crit: Any
    """frequency with which it is held on s_ref [Hz], above 0"""
    s: Any
    """position against the support [m], fixed start value"""
    v: Any
    """speed against the support [m/s], fixed start value"""
    def __init__(
        self,
        *,
        s_ref: SignalValue = ...,
        v_ref: SignalValue = ...,
        a_ref: SignalValue = ...,
        f_crit: ParameterValue = 50.0,
        s: Number = ...,
        v: Number = ...,
    ) -> None: ...

class PositionSensor(_Absolute):
    """Position as a signal: s = flange.s.

    Source: MSL Translational.Sensors.PositionSensor.
    """

    s: Any
    """position [m]"""
    def __init__(self) -> None: ...

class PowerSensor(ForceSensor):
    """Power as a signal, between flanges that move as one: power = f der(flange_a.s).

    It is positive where what is joined to flange_a drives what is joined to flange_b.

    Source: MSL Translational.Sensors.PowerSensor.

    Args:
        v: velocity of the flanges [m/s], fixed start value.
    """

    power: Any
    """power from flange_a to flange_b [W]"""
    v: Any
    """velocity of the flanges [m/s], fixed start value"""
    def __init__(
        self,
        *,
        v: Number = ...,
    ) -> None: ...

class RelativePositionSensor(TwoFlanges):
    """Distance as a signal: s_rel = flange_b.s - flange_a.s.

    Source: MSL Translational.Sensors.RelPositionSensor.
    """

    s_rel: Any
    """distance of the flanges [m]"""
    def __init__(self) -> None: ...

class RollingResistance(Lossy):
    """Resistance of a rolling wheel: f = Cr fWeight cos(alpha) r(v), against the motion.

    alpha is the slope of the road, inclination = tan(alpha). r is the sign of the speed v, rounded below v0:
    `reg` "Exp" (tanh(50 v/v0)), "Sine" (sin(pi v/(2 v0))), "Linear" (v/v0)
    or "CoSine" (sgn(v) (1 - cos(pi v/(2 v0)))). So it does not hold a wheel at rest.

    Source: MSL Translational.Components.RollingResistance.

    Args:
        fWeight: load on the wheel by gravity [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        useCrInput: whether Cr comes in as cr.
        cr: rolling resistance coefficient, a number, a function of time or Sampled data.
        CrConstant: rolling resistance coefficient, at least 0.
        useInclinationInput: whether the slope comes in as inclination.
        inclination: tangent of the slope, a number, a function of time or Sampled data.
        inclinationConstant: tangent of the slope.
        reg: how the sign is rounded.
        v0: speed below which the sign is rounded [m/s], above 0.
        s: position against the road [m], fixed start value.
        v: speed against the road [m/s], fixed start value.
        f: resistance, positive against positive speed [N], fixed start value.
    """

    flange: Any
    """hub of the wheel"""
    support: Any
    """road"""
    fWeight: Any
    """load on the wheel by gravity [N], at least 0"""
    useCrInput: Any
    """whether Cr comes in as cr"""
    cr: Any
    """rolling resistance coefficient, a number, a function of time or Sampled data"""
    CrConstant: Any
    """rolling resistance coefficient, at least 0"""
    useInclinationInput: Any
    """whether the slope comes in as inclination"""
    inclination: Any
    """tangent of the slope, a number, a function of time or Sampled data"""
    inclinationConstant: Any
    """tangent of the slope"""
    reg: Any
    """how the sign is rounded"""
    v0: Any
    """speed below which the sign is rounded [m/s], above 0"""
    s: Any
    """position against the road [m], fixed start value"""
    v: Any
    """speed against the road [m/s], fixed start value"""
    f: Any
    """resistance, positive against positive speed [N], fixed start value"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def direction(self) -> Any: ...
    def __init__(
        self,
        *,
        fWeight: ParameterValue,
        useHeatPort: bool = False,
        useCrInput: bool = False,
        cr: SignalValue = ...,
        CrConstant: ParameterValue = 0.01,
        useInclinationInput: bool = False,
        inclination: SignalValue = ...,
        inclinationConstant: ParameterValue = 0.0,
        reg: Literal['Exp', 'Sine', 'Linear', 'CoSine'] = 'Exp',
        v0: ParameterValue = 0.1,
        s: Number = ...,
        v: Number = ...,
        f: Number = ...,
    ) -> None: ...

class SpeedDependentForce(DrivenFlange):
    """A force that depends on the speed of the flange: flange.f = -f.

    With `ForceDirection` it has one direction whichever way it moves, f(-v) = f(v); else it turns round,
    f(-v) = -f(v): a load if f_nominal is negative. A subclass gives `turning(x)`,
    f/f_nominal over x = v/v_nominal where it turns round.
    """

    f_nominal: Any
    """force at v_nominal; negative is a load for v > 0 [N]"""
    v_nominal: Any
    """speed at which the force is f_nominal [m/s], above 0"""
    ForceDirection: Any
    """whether the force has the same direction for both directions of motion"""
    v: Any
    """speed against the support [m/s], fixed start value"""
    s: Any
    """position against the support [m], fixed start value"""
    f: Any
    """driving force [N], fixed start value"""
    def lasting(self, x: Any) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

class SpeedSensor(_Absolute):
    """Velocity as a signal: v = der(flange.s).

    Source: MSL Translational.Sensors.SpeedSensor.
    """

    v: Any
    """velocity [m/s]"""
    def __init__(self) -> None: ...

class AirSpring(Compliant):
    """Closed volume of gas behind a piston or bellows: f = -A (p - p_amb), p = p_0 (V_0/V)^n.

    V = V_0 + A (s_rel - s_rel0). n is 1 for slow motion, 1.4 for air that exchanges no heat.

    Limits: the area is constant, and the motion must leave a volume.

    Source: J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007).

    Args:
        A: effective area [m2], above 0.
        p_0: pressure at s_rel0, absolute [Pa], above 0.
        V_0: volume at s_rel0 [m3], above 0.
        n: polytropic exponent, at least 1.
        p_amb: pressure outside [Pa], at least 0.
        s_rel0: distance at which the pressure is p_0 [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        p: pressure, absolute [Pa], fixed start value.
    """

    A: Any
    """effective area [m2], above 0"""
    p_0: Any
    """pressure at s_rel0, absolute [Pa], above 0"""
    V_0: Any
    """volume at s_rel0 [m3], above 0"""
    n: Any
    """polytropic exponent, at least 1"""
    p_amb: Any
    """pressure outside [Pa], at least 0"""
    s_rel0: Any
    """distance at which the pressure is p_0 [m]"""
    p: Any
    """pressure, absolute [Pa], fixed start value"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    @property
    def V(self) -> Any: ...
    @property
    def gas(self) -> Any: ...
    def __init__(
        self,
        *,
        A: ParameterValue,
        p_0: ParameterValue,
        V_0: ParameterValue,
        n: ParameterValue = 1.4,
        p_amb: ParameterValue = 101325.0,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        p: Number = ...,
    ) -> None: ...

class BilinearSpring(Compliant):
    """Spring that is stiffer one way: f = k_pull e for e > 0 and k_push e for e < 0.

    e = s_rel - s_rel0.

    Args:
        k_pull: stiffness when pulled [N/m], at least 0.
        k_push: stiffness when pushed [N/m], at least 0.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    k_pull: Any
    """stiffness when pulled [N/m], at least 0"""
    k_push: Any
    """stiffness when pushed [N/m], at least 0"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    @property
    def pull(self) -> Any: ...
    @property
    def push(self) -> Any: ...
    def __init__(
        self,
        *,
        k_pull: ParameterValue,
        k_push: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class CompliantWithSpeed(Compliant):
    """A compliant element whose law uses the relative velocity v_rel = der(s_rel)."""

    v_rel: Any
    """relative velocity of the flanges [m/s], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class CubicSpring(Compliant):
    """Spring with a cubic and a quadratic term: f = k e + k2 e^2 + k3 e^3 with e = s_rel - s_rel0.

    The quadratic term makes pull and push differ, as where a spring that hardens is preloaded.

    Source: G. Duffing, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz (1918).

    Args:
        k: linear stiffness [N/m], at least 0.
        k3: cubic stiffness; negative softens [N/m3].
        s_rel0: unstretched length [m].
        k2: quadratic stiffness: stiffer when pulled, softer when pushed [N/m2].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    k: Any
    """linear stiffness [N/m], at least 0"""
    k3: Any
    """cubic stiffness; negative softens [N/m3]"""
    s_rel0: Any
    """unstretched length [m]"""
    k2: Any
    """quadratic stiffness: stiffer when pulled, softer when pushed [N/m2]"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        k3: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        k2: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class EddyCurrentBrake(AtTemperature):
    """A brake by eddy currents: f = 2 f_nominal x/(1 + x^2), x = v/(v_nominal r(T)).

    r = 1 + alpha (T - TRef) is the disc's resistance over that at TRef, alpha = alpha20/(1 + alpha20 (TRef -
    293.15 K)): a hot disc brakes best at a higher speed. The support is the ground when left unconnected.

    Source: MSL Translational.Sources.EddyCurrentForce (the equation of Kloss).

    Args:
        v_nominal: speed at which it brakes best at TRef [m/s], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        T: temperature if heatPort is not used [K], above 0.
        useF_nominalInput: whether the largest force comes in as f_input.
        f_input: largest force [N], a number, a function of time or Sampled data.
        f_nominal: largest force, at v_nominal [N], at least 0.
        TRef: temperature at which v_nominal holds [K], above 0.
        alpha20: temperature coefficient of the disc's resistance at 20 degC [1/K].
        s: position against the support [m], fixed start value.
        v: speed against the support [m/s], fixed start value.
        f: braking force, positive against positive speed [N], fixed start value.
    """

    flange: Any
    """what slides"""
    support: Any
    """what reacts"""
    useF_nominalInput: Any
    """whether the largest force comes in as f_input"""
    f_input: Any
    """largest force [N], a number, a function of time or Sampled data"""
    f_nominal: Any
    """largest force, at v_nominal [N], at least 0"""
    v_nominal: Any
    """speed at which it brakes best at TRef [m/s], above 0"""
    TRef: Any
    """temperature at which v_nominal holds [K], above 0"""
    alpha20: Any
    """temperature coefficient of the disc's resistance at 20 degC [1/K]"""
    s: Any
    """position against the support [m], fixed start value"""
    v: Any
    """speed against the support [m/s], fixed start value"""
    f: Any
    """braking force, positive against positive speed [N], fixed start value"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def resistance(self) -> Any: ...
    def __init__(
        self,
        *,
        v_nominal: ParameterValue,
        useHeatPort: bool = False,
        T: ParameterValue = 293.15,
        useF_nominalInput: bool = False,
        f_input: SignalValue = ...,
        f_nominal: ParameterValue = 0.0,
        TRef: ParameterValue = 293.15,
        alpha20: ParameterValue = 0.0,
        s: Number = ...,
        v: Number = ...,
        f: Number = ...,
    ) -> None: ...

class ElasticRod(Bar):
    """Elastic rod: mass m = rho A L, stiffness k = E A/L and damping d over all of it."""

    flange_a: Any
    """left end"""
    flange_b: Any
    """right end"""
    m: Any
    """mass [kg], above 0"""
    k: Any
    """stiffness [N/m], above 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    L: Any
    """length [m]"""
    v_a: Any
    """velocity of the left end [m/s], fixed start value"""
    v_b: Any
    """velocity of the right end [m/s], fixed start value"""
    a_a: Any
    """acceleration of the left end [m/s2], fixed start value"""
    a_b: Any
    """acceleration of the right end [m/s2], fixed start value"""
    shape: Any
    @property
    def solid(self) -> Any: ...
    @property
    def ends(self) -> Any: ...
    @property
    def inner(self) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

class HarmonicRipple(Compliant):
    """Force that comes back with every period, as a sum of three harmonics.

    f = sum over h = 1, 2, 3 of f_sin_h sin(h x) + f_cos_h cos(h x), x = 2 pi s_rel/period; `f_sin` and
    `f_cos` are those of h = 1.

    Source: E. Favre, L. Cardoletti, M. Jufer, IEEE Trans. Ind. Appl. 29 (1993) 1141, on motors.

    Args:
        f_sin: amplitude of the sine [N].
        period: travel after which the force comes back [m], above 0.
        f_cos: amplitude of the cosine [N].
        f_sin_2: amplitude of the sine of half the period [N].
        f_cos_2: amplitude of the cosine of half the period [N].
        f_sin_3: amplitude of the sine of a third of the period [N].
        f_cos_3: amplitude of the cosine of a third of the period [N].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    f_sin: Any
    """amplitude of the sine [N]"""
    f_cos: Any
    """amplitude of the cosine [N]"""
    f_sin_2: Any
    """amplitude of the sine of half the period [N]"""
    f_cos_2: Any
    """amplitude of the cosine of half the period [N]"""
    f_sin_3: Any
    """amplitude of the sine of a third of the period [N]"""
    f_cos_3: Any
    """amplitude of the cosine of a third of the period [N]"""
    period: Any
    """travel after which the force comes back [m], above 0"""
    potential: Any
    """stored energy [J]"""
    @property
    def harmonics(self) -> Any: ...
    @property
    def store(self) -> Any: ...
    def __init__(
        self,
        *,
        f_sin: ParameterValue,
        period: ParameterValue,
        f_cos: ParameterValue = 0.0,
        f_sin_2: ParameterValue = 0.0,
        f_cos_2: ParameterValue = 0.0,
        f_sin_3: ParameterValue = 0.0,
        f_cos_3: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class InverseSpeedDependentForce(SpeedDependentForce):
    """A force of constant power: f = f_nominal v_nominal/|v| above v0.

    Below v0 it is what it is at v0; or goes straight to zero with speed, if it turns round.

    Source: MSL Translational.Sources.InverseSpeedDependentForce.

    Args:
        f_nominal: force at v_nominal; negative is a load for v > 0 [N].
        v_nominal: speed at which the force is f_nominal [m/s], above 0.
        ForceDirection: whether the force has the same direction for both directions of motion.
        v0: speed below which it is regularised [m/s], above 0.
        v: speed against the support [m/s], fixed start value.
        s: position against the support [m], fixed start value.
        f: driving force [N], fixed start value.
    """

    v0: Any
    """speed below which it is regularised [m/s], above 0"""
    @property
    def least(self) -> Any: ...
    def turning(self, x: Any) -> Any: ...
    def lasting(self, x: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_nominal: ParameterValue,
        v_nominal: ParameterValue,
        ForceDirection: bool = True,
        v0: ParameterValue = 0.1,
        v: Number = ...,
        s: Number = ...,
        f: Number = ...,
    ) -> None: ...

class LinearSpeedDependentForce(SpeedDependentForce):
    """A force in proportion to speed: f = f_nominal |v|/v_nominal, or f_nominal v/v_nominal.

    Source: MSL Translational.Sources.LinearSpeedDependentForce.

    Args:
        f_nominal: force at v_nominal; negative is a load for v > 0 [N].
        v_nominal: speed at which the force is f_nominal [m/s], above 0.
        ForceDirection: whether the force has the same direction for both directions of motion.
        v: speed against the support [m/s], fixed start value.
        s: position against the support [m], fixed start value.
        f: driving force [N], fixed start value.
    """

    def turning(self, x: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_nominal: ParameterValue,
        v_nominal: ParameterValue,
        ForceDirection: bool = True,
        v: Number = ...,
        s: Number = ...,
        f: Number = ...,
    ) -> None: ...

class MultiSensor(PowerSensor):
    """Velocity, force and power as signals: v, f and power = f v.

    Source: MSL Translational.Sensors.MultiSensor.
    """

    v: Any
    """velocity of the flanges [m/s]"""
    def __init__(self) -> None: ...

class ObliqueSprings(Compliant):
    """Two springs across the motion, pressed between their supports: f = 2 k e (1 - l_0/sqrt(a^2 + e^2)).

    e = s_rel - s_rel0. Pressed, l_0 > a, they push out of the middle: a negative stiffness of 2 k (1 - l_0/a)
    there. A `Spring` of the opposite stiffness beside them makes a support of quasi-zero stiffness.

    Source: A. Carrella, M. J. Brennan, T. P. Waters, Static analysis of a passive vibration isolator with
    quasi-zero-stiffness characteristic, J. Sound Vib. 301 (2007) 678-689.

    Args:
        k: stiffness of each spring [N/m], at least 0.
        l_0: unstretched length of each [m], above 0.
        a: from support to middle [m], above 0.
        s_rel0: distance at which they lie across [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    k: Any
    """stiffness of each spring [N/m], at least 0"""
    l_0: Any
    """unstretched length of each [m], above 0"""
    a: Any
    """from support to middle [m], above 0"""
    s_rel0: Any
    """distance at which they lie across [m]"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    @property
    def length(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        l_0: ParameterValue,
        a: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class Position(Filtered, DrivenFlange):
    """A prescribed position: flange.s - support.s = s_ref. Its velocity and acceleration follow.

    Where s_ref bends or jumps, what that takes acts as a shock, whose impulse is an event of the run; a
    jump that takes infinite forces is refused. With `exact=False` a Bessel filter of order 2 follows
    s_ref: der(v) = ((s_ref - s) o - 1.3617 v) o/0.6180 with v = der(s), o = 2 pi f_crit, from
    s = s_ref at rest; lead = s + v/o.

    Source: MSL Translational.Sources.Position.

    Args:
        exact: whether the reference is followed exactly; else by a filter, which knows no shocks.
        f_crit: critical frequency of the filter with exact=False [Hz], above 0.
        s_ref: position [m], a number, a function of time or Sampled data.
        s: position against the support [m], fixed start value.
        lead: position ahead, by which the filter moves [m], fixed start value.
    """

    s_ref: Any
    """position [m], a number, a function of time or Sampled data"""
    s: Any
    """position against the support [m], fixed start value"""
    lead: Any
    """position ahead, by which the filter moves [m], fixed start value"""
    def __init__(
        self,
        *,
        exact: bool = True,
        f_crit: ParameterValue = 50.0,
        s_ref: SignalValue = ...,
        s: Number = ...,
        lead: Number = ...,
    ) -> None: ...

class QuadraticSpeedDependentForce(SpeedDependentForce):
    """A force in proportion to the square of speed: f = f_nominal (v/v_nominal)^2, or with its sign.

    Source: MSL Translational.Sources.QuadraticSpeedDependentForce.

    Args:
        f_nominal: force at v_nominal; negative is a load for v > 0 [N].
        v_nominal: speed at which the force is f_nominal [m/s], above 0.
        ForceDirection: whether the force has the same direction for both directions of motion.
        v: speed against the support [m/s], fixed start value.
        s: position against the support [m], fixed start value.
        f: driving force [N], fixed start value.
    """

    def turning(self, x: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_nominal: ParameterValue,
        v_nominal: ParameterValue,
        ForceDirection: bool = True,
        v: Number = ...,
        s: Number = ...,
        f: Number = ...,
    ) -> None: ...

class RelativeSpeedSensor(RelativePositionSensor):
    """Relative velocity as a signal: v_rel = der(s_rel).

    Source: MSL Translational.Sensors.RelSpeedSensor.
    """

    v_rel: Any
    """relative velocity [m/s]"""
    def __init__(self) -> None: ...

class Ripple(Compliant):
    """Force that comes back with every period of travel: f = f_sin sin(2 pi s_rel/period) + f_cos cos(...).

    The thread of a screw, the poles of a motor, the teeth of a rack.

    Args:
        f_sin: amplitude of the sine [N].
        period: travel after which the force comes back [m], above 0.
        f_cos: amplitude of the cosine [N].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    f_sin: Any
    """amplitude of the sine [N]"""
    f_cos: Any
    """amplitude of the cosine [N]"""
    period: Any
    """travel after which the force comes back [m], above 0"""
    potential: Any
    """stored energy [J]"""
    @property
    def waves(self) -> Any: ...
    @property
    def angle(self) -> Any: ...
    @property
    def wave(self) -> Any: ...
    def __init__(
        self,
        *,
        f_sin: ParameterValue,
        period: ParameterValue,
        f_cos: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class Speed(Filtered, DrivenFlange):
    """A prescribed velocity: der(s) = v_ref, from the start position s.

    Where v_ref jumps, what that takes acts as a shock, whose impulse is an event of the run. With
    `exact=False` a filter of order 1 follows v_ref: der(v) = 2 pi f_crit (v_ref - v), from v = v_ref.

    Source: MSL Translational.Sources.Speed.

    Args:
        exact: whether the reference is followed exactly; else by a filter, which knows no shocks.
        f_crit: critical frequency of the filter with exact=False [Hz], above 0.
        v_ref: velocity [m/s], a number, a function of time or Sampled data.
        s: position against the support [m], fixed start value.
        v: velocity against the support [m/s], fixed start value.
    """

    v_ref: Any
    """velocity [m/s], a number, a function of time or Sampled data"""
    s: Any
    """position against the support [m], fixed start value"""
    v: Any
    """velocity against the support [m/s], fixed start value"""
    def __init__(
        self,
        *,
        exact: bool = True,
        f_crit: ParameterValue = 50.0,
        v_ref: SignalValue = ...,
        s: Number = ...,
        v: Number = ...,
    ) -> None: ...

class Spring(Compliant):
    """Linear spring: f = k (s_rel - s_rel0).

    Source: MSL Translational.Components.Spring.

    Args:
        k: stiffness [N/m], at least 0.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    k: Any
    """stiffness [N/m], at least 0"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class TabulatedSpring(Compliant):
    """Spring given by points: f = F(s_rel - s_rel0), straight beyond the first and the last of them.

    `load_points` reads them from a file.

    Source: interpolation="smooth" by F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.

    Example:
        >>> from inertance import TabulatedSpring
        >>> mount = TabulatedSpring(table=((-0.01, -900.0), (0.0, 0.0), (0.01, 400.0)))

    Args:
        table: rows (stretch [m], force [N]), the first increasing.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    table: Any
    """rows (stretch [m], force [N]), the first increasing"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    def __init__(
        self,
        *,
        table: Any = ...,
        interpolation: Literal['linear', 'smooth'] = 'linear',
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

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

    Args:
        c: dynamic stiffness at 1 rad/s [N.s^alpha/m], at least 0.
        alpha: order of the derivative, below 1, above 0, at most 1.
        w_low: lower end of the band [rad/s], above 0.
        decades: width of the band in decades, above 0, at most 30.
        useHeatPort: whether its losses leave as heat through heatPort.
        n: number of branches in the band.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    c: Any
    """dynamic stiffness at 1 rad/s [N.s^alpha/m], at least 0"""
    alpha: Any
    """order of the derivative, below 1, above 0, at most 1"""
    w_low: Any
    """lower end of the band [rad/s], above 0"""
    decades: Any
    """width of the band in decades, above 0, at most 30"""
    n: Any
    """number of branches in the band"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    def error(self, share: Any = ...) -> Any: ...
    @property
    def branches(self) -> Any: ...
    @property
    def static(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        alpha: ParameterValue,
        w_low: ParameterValue,
        decades: ParameterValue,
        useHeatPort: bool = False,
        n: int | np.integer[Any] = 8,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        **parts: Component,
    ) -> None: ...

class HardStop(Compliant, Lossy):
    """Two flanges that cannot come closer than s_rel = s_min.

    A shock reverses the relative velocity, v_rel+ = -e v_rel-, by the impulse J that this takes.
    Slower than `v_rest` afterwards, or too slow for a rebound of 1e-12 m against what presses them
    together, they stay in contact until they are pulled apart. `lossPower` is zero: shocks take no time, and
    what they lose is told by `run.energy()`.

    Source: I. Newton's law of restitution.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        s_min: least distance of the flanges [m].
        e: coefficient of restitution, at least 0, at most 1.
        v_rest: rebound speed below which contact is kept [m/s], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    s_min: Any
    """least distance of the flanges [m]"""
    e: Any
    """coefficient of restitution, at least 0, at most 1"""
    v_rest: Any
    """rebound speed below which contact is kept [m/s], at least 0"""
    mode: Any
    """apart or in contact"""
    J: Any
    """impulse of a shock, positive when it pushes the flanges apart [N.s]"""
    s_rel: Any
    """distance of the flanges [m], fixed start value"""
    v_rel: Any
    """relative velocity of the flanges [m/s], fixed start value"""
    a_rel: Any
    """relative acceleration of the flanges [m/s2], fixed start value"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        s_min: ParameterValue = 0.0,
        e: ParameterValue = 0.0,
        v_rest: ParameterValue = 1e-05,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class Inerter(CompliantWithSpeed):
    """Ideal inerter: f = b a_rel, force proportional to relative acceleration.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, eq. (4).

    Args:
        b: inertance [kg], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    b: Any
    """inertance [kg], at least 0"""
    a_rel: Any
    """relative acceleration of the flanges [m/s2], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        b: ParameterValue,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class Maxwell(Compliant, Lossy):
    """Spring and damper in series, without mass between them: f = k (s_rel - s_rel0 - z), d z' = f.

    Several in `parallel` with a `Spring` are the Prony series of a rubber, branch i relaxing in d_i/k_i.

    Source: J. C. Maxwell, Phil. Trans. R. Soc. 157 (1867) 49-88.

    Args:
        k: stiffness [N/m], at least 0.
        d: damping constant [N.s/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        z: stretch of the damper [m], fixed start value.
    """

    k: Any
    """stiffness [N/m], at least 0"""
    d: Any
    """damping constant [N.s/m], above 0"""
    s_rel0: Any
    """unstretched length [m]"""
    z: Any
    """stretch of the damper [m], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        z: Number = ...,
    ) -> None: ...

class RelativeAccelerationSensor(RelativeSpeedSensor):
    """Relative acceleration as a signal: a_rel = der(v_rel).

    Source: MSL Translational.Sensors.RelAccSensor.
    """

    a_rel: Any
    """relative acceleration [m/s2]"""
    def __init__(self) -> None: ...

class VariableInerter(CompliantWithSpeed):
    """Inerter whose inertance follows a signal: f = der(p), p = (b + b_u x) v_rel, with T x' = u - x.

    As of a flywheel whose masses an actuator, slow by T, moves in and out: the momentum p is kept where
    nothing pulls, and the actuator gives and takes the energy: supplyPower = -b_u x' v_rel^2/2.

    Limits: b + b_u x must stay above 0.

    Args:
        b: inertance at u = 0 [kg], at least 0.
        b_u: change of the inertance with u [kg].
        T: time constant of the actuator [s], above 0.
        u: what the inertance follows, a number, a function of time or Sampled data.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        x: position of the actuator, fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    u: Any
    """what the inertance follows, a number, a function of time or Sampled data"""
    b: Any
    """inertance at u = 0 [kg], at least 0"""
    b_u: Any
    """change of the inertance with u [kg]"""
    T: Any
    """time constant of the actuator [s], above 0"""
    x: Any
    """position of the actuator, fixed start value"""
    a_rel: Any
    """relative acceleration of the flanges [m/s2], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    supplyPower: Any
    """power that comes in otherwise than through flanges [W]"""
    @property
    def inertance(self) -> Any: ...
    def __init__(
        self,
        *,
        b: ParameterValue,
        b_u: ParameterValue,
        T: ParameterValue,
        u: SignalValue = ...,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        x: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class Zener(Compliant, Lossy):
    """Standard linear solid, a spring beside a Maxwell element: f = k_0 e + k (e - z), d z' = k (e - z).

    e = s_rel - s_rel0. Its stiffness grows from k_0, held slowly, to k_0 + k, shaken fast.

    Source: C. Zener, Elasticity and Anelasticity of Metals (1948).

    Args:
        k_0: static stiffness [N/m], at least 0.
        k: stiffness that relaxes [N/m], at least 0.
        d: damping constant [N.s/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        z: stretch of the damper [m], fixed start value.
    """

    k_0: Any
    """static stiffness [N/m], at least 0"""
    k: Any
    """stiffness that relaxes [N/m], at least 0"""
    d: Any
    """damping constant [N.s/m], above 0"""
    s_rel0: Any
    """unstretched length [m]"""
    z: Any
    """stretch of the damper [m], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    def __init__(
        self,
        *,
        k_0: ParameterValue,
        k: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Dissipative(CompliantWithSpeed, Lossy):
    """A compliant element that turns all its work into heat, unless it states otherwise."""

    lossPower: Any
    """dissipated power [W]"""
    def __init__(self, **values: Any) -> None: ...

class LumpedRod(ElasticRod, LumpedBar):
    """Flexible rod of uniform section in lumps: springs in a row, masses between, halves at the ends.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(k/m), both ends free, is too low:
    the first by 2.6 % with four segments, and a quarter of that with twice as many.

    Args:
        m: mass [kg], above 0.
        k: stiffness [N/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        segments: number of springs.
        d: damping constant [N.s/m], at least 0.
        L: length [m].
        v_a: velocity of the left end [m/s], fixed start value.
        v_b: velocity of the right end [m/s], fixed start value.
        a_a: acceleration of the left end [m/s2], fixed start value.
        a_b: acceleration of the right end [m/s2], fixed start value.
    """

    def __init__(
        self,
        *,
        m: ParameterValue,
        k: ParameterValue,
        useHeatPort: bool = False,
        segments: int | np.integer[Any] = 8,
        d: ParameterValue = 0.0,
        L: ParameterValue = 0.0,
        v_a: Number = ...,
        v_b: Number = ...,
        a_a: Number = ...,
        a_b: Number = ...,
        **parts: Component,
    ) -> None: ...

class ModalRod(ElasticRod, ModalBar):
    """Flexible rod of uniform section by its modes: a straight line between its ends and half waves on it.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(k/m), both ends free, is too
    high: the first by 10 % with one mode, 0.4 % with two, 0.1 % with four.

    Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319.

    Example:
        >>> from inertance import ModalRod
        >>> rod = ModalRod(m=7.85, k=2.1e8, modes=4)  # a metre of steel, 1000 mm2
        >>> 0 < rod.frequency_error(1) < 2e-3
        True

    Args:
        m: mass [kg], above 0.
        k: stiffness [N/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        modes: number of modes.
        d: damping constant [N.s/m], at least 0.
        L: length [m].
        v_a: velocity of the left end [m/s], fixed start value.
        v_b: velocity of the right end [m/s], fixed start value.
        a_a: acceleration of the left end [m/s2], fixed start value.
        a_b: acceleration of the right end [m/s2], fixed start value.
    """

    def __init__(
        self,
        *,
        m: ParameterValue,
        k: ParameterValue,
        useHeatPort: bool = False,
        modes: int | np.integer[Any] = 4,
        d: ParameterValue = 0.0,
        L: ParameterValue = 0.0,
        v_a: Number = ...,
        v_b: Number = ...,
        a_a: Number = ...,
        a_b: Number = ...,
        **parts: Component,
    ) -> None: ...

class RelaxingSpring(Compliant, Relaxing):
    """A `Maxwell` element by its time: f = k (e - z), T z' = e - z with e = s_rel - s_rel0.

    Also without stiffness it is one, unlike spring and damper: f = 0.

    Args:
        T: time in which the force fades to 37 % [s], above 0.
        k: stiffness when shaken fast [N/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        z: stretch that has relaxed [m], fixed start value.
    """

    k: Any
    """stiffness when shaken fast [N/m], at least 0"""
    s_rel0: Any
    """unstretched length [m]"""
    z: Any
    """stretch that has relaxed [m], fixed start value"""
    @property
    def stretch(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    def __init__(
        self,
        *,
        T: ParameterValue,
        k: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Backlash(Dissipative):
    """Spring and damper with clearance: a dead zone of half-width k eps on P + D.

    f = u - k eps where u = P + D >= k eps, u + k eps where u <= -k eps, else 0, with
    P = k (s_rel - s_rel0) and D = d v_rel. So f is continuous and never opposes u.

    Limits: the damper counts inside the clearance too. Where d |v_rel| > k (eps - |s_rel - s_rel0|),
    f acts before contact, and on fast separation it may pull; `ElastoGap` limits the damping instead.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (20) and (24).

    Args:
        k: stiffness [N/m], at least 0.
        d: damping constant [N.s/m], at least 0.
        eps: half of the clearance [m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: distance at the middle of the clearance [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    k: Any
    """stiffness [N/m], at least 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    eps: Any
    """half of the clearance [m], at least 0"""
    s_rel0: Any
    """distance at the middle of the clearance [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def elastic(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        eps: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class Brake(PressedStickSlip):
    """A sliding part held by friction on a support: f = mu(|v|) cgeo fn against v while sliding.

    fn = fn_max max(f_normalized, 0); |f| <= peak mu(0) cgeo fn while stuck; free when fn = 0.
    The support, which takes -f, is the ground when left unconnected.

    Source: MSL Translational.Components.Brake.

    Args:
        fn_max: largest normal force [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        f_normalized: normal force over its largest value, a number, a function of time or Sampled data.
        mu_pos: rows (speed, friction coefficient), speeds increasing from 0.
        cgeo: friction faces, weighted by the distribution of pressure, above 0.
        s: position against the support [m], fixed start value.
        v: velocity against the support [m/s], fixed start value.
        a: acceleration against the support [m/s2], fixed start value.
        f: braking force, positive against positive velocity [N], fixed start value.
    """

    flange: Any
    """what slides"""
    support: Any
    """what it slides on"""
    cgeo: Any
    """friction faces, weighted by the distribution of pressure, above 0"""
    s: Any
    """position against the support [m], fixed start value"""
    v: Any
    """velocity against the support [m/s], fixed start value"""
    a: Any
    """acceleration against the support [m/s2], fixed start value"""
    f: Any
    """braking force, positive against positive velocity [N], fixed start value"""
    quantities: Any
    def __init__(
        self,
        *,
        fn_max: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        f_normalized: SignalValue = ...,
        mu_pos: Any = ...,
        cgeo: ParameterValue = 1.0,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
        f: Number = ...,
    ) -> None: ...

class CubicDamper(Dissipative):
    """Damper with force growing with the cube of speed: f = d3 v_rel^3.

    Source: A. H. Nayfeh, D. T. Mook, Nonlinear Oscillations (1979).

    Args:
        d3: cubic damping constant [N.s3/m3], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    d3: Any
    """cubic damping constant [N.s3/m3], at least 0"""
    def __init__(
        self,
        *,
        d3: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class DahlFriction(Dissipative):
    """Dry friction that builds up elastically before it slips: f = f_c z.

    s_p z' = v_rel - |v_rel| z: the share z of f_c grows by displacement/s_p at first, and comes within
    1/e of its end over s_p. It knows no events, and creeps under a load that changes.

    Source: P. R. Dahl, AIAA Journal 14 (1976) 1675-1682, with the exponent 1.

    Args:
        f_c: friction force once it slips [N], at least 0.
        s_p: presliding displacement [m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: share of the friction force that has built up, fixed start value.
    """

    f_c: Any
    """friction force once it slips [N], at least 0"""
    s_p: Any
    """presliding displacement [m], above 0"""
    z: Any
    """share of the friction force that has built up, fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        f_c: ParameterValue,
        s_p: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Damper(Dissipative):
    """Linear damper: f = d v_rel.

    Source: MSL Translational.Components.Damper.

    Args:
        d: damping constant [N.s/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    d: Any
    """damping constant [N.s/m], at least 0"""
    def __init__(
        self,
        *,
        d: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class ElastoBacklash(Dissipative):
    """Backlash b between elastic flanks that only ever press, as `rotational.ElastoBacklash`.

    With x = s_rel - s_rel0 and the spring force f_c = k max(|x| - b/2, 0) of the flank in contact,
    f = sgn(x) max(f_c + min(f_c, sgn(x) d v_rel), 0): damping adds at most f_c as the flank is pressed,
    and takes away at most f_c as it is released, so f is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, written for sliding.

    Args:
        k: stiffness in contact [N/m], above 0.
        d: damping constant in contact [N.s/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        b: total backlash [m], at least 0.
        s_rel0: distance in the middle of the backlash [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    k: Any
    """stiffness in contact [N/m], above 0"""
    d: Any
    """damping constant in contact [N.s/m], at least 0"""
    b: Any
    """total backlash [m], at least 0"""
    s_rel0: Any
    """distance in the middle of the backlash [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def x(self) -> Any: ...
    @property
    def elastic(self) -> Any: ...
    def pressed(self, depth: Any, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        b: ParameterValue = 0.0,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class ElastoGap(Dissipative):
    """Spring and damper that touch only while s_rel < s_rel0.

    f = f_c + f_d with f_c = -k (s_rel0 - s_rel)^n and f_d = min(max(d v_rel, f_c), -f_c); f = 0 apart.
    So 2 f_c <= f <= 0: the contact never pulls, and f is continuous at touch and release.

    Source: MSL Translational.Components.ElastoGap.

    Args:
        k: stiffness [N/m^n], at least 0.
        d: damping constant [N.s/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: distance at which the contact begins [m].
        n: exponent of the spring, at least 1.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    k: Any
    """stiffness [N/m^n], at least 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    s_rel0: Any
    """distance at which the contact begins [m]"""
    n: Any
    """exponent of the spring, at least 1"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def depth(self) -> Any: ...
    @property
    def spring(self) -> Any: ...
    @property
    def damping(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        n: ParameterValue = 1.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class FluidInerter(Dissipative):
    """Liquid that a piston drives through a helical tube: f = b a_rel + A_p dp.

    b = rho A_p^2 L/A_t + rho A_p^2 L_p/A_p with the tube's area A_t = pi D^2/4: liquid in tube and cylinder.
    The tube resists by dp = rho u |u|/2 (lambda L/D + zeta), u = v_rel A_p/A_t, the larger lambda of 64/Re
    (laminar) and 0.304 Re^(-1/4) + 0.029 sqrt(D/D_h) (turbulent in a coil), Re = rho |u| D/mu.

    Limits: a liquid without compressibility (put a `Spring` in series), no leakage, a laminar flow as in a
    straight tube.

    Source: S. J. Swift, M. C. Smith, A. R. Glover, C. Papageorgiou, B. Gartner, N. E. Houghton, Design and
    modelling of a fluid inerter, Int. J. Control 86 (2013) 2035-2051, for b; H. Ito, Friction factors for
    turbulent flow in curved pipes, J. Basic Eng. 81 (1959) 123-134, for lambda.

    Args:
        A_p: area of the piston [m2], above 0.
        D: inner diameter of the tube [m], above 0.
        L: length of the tube [m], above 0.
        D_h: diameter of the helix [m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        L_p: length of the cylinder [m], at least 0.
        rho: density of the liquid [kg/m3], above 0.
        mu: viscosity of the liquid [Pa.s], above 0.
        zeta: losses at the ends of the tube, at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
        f_d: force of the tube's resistance [N], fixed start value.
    """

    A_p: Any
    """area of the piston [m2], above 0"""
    L_p: Any
    """length of the cylinder [m], at least 0"""
    D: Any
    """inner diameter of the tube [m], above 0"""
    L: Any
    """length of the tube [m], above 0"""
    D_h: Any
    """diameter of the helix [m], above 0"""
    rho: Any
    """density of the liquid [kg/m3], above 0"""
    mu: Any
    """viscosity of the liquid [Pa.s], above 0"""
    zeta: Any
    """losses at the ends of the tube, at least 0"""
    a_rel: Any
    """relative acceleration of the flanges [m/s2], fixed start value"""
    f_d: Any
    """force of the tube's resistance [N], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def A_t(self) -> Any: ...
    @property
    def b(self) -> Any: ...
    def __init__(
        self,
        *,
        A_p: ParameterValue,
        D: ParameterValue,
        L: ParameterValue,
        D_h: ParameterValue,
        useHeatPort: bool = False,
        L_p: ParameterValue = 0.0,
        rho: ParameterValue = 1000.0,
        mu: ParameterValue = 0.001,
        zeta: ParameterValue = 1.5,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
        f_d: Number = ...,
    ) -> None: ...

class Friction(Compliant, StickSlip):
    """Two flanges that rub on each other; subclasses say how much in `sliding(speed)`."""

    s_rel: Any
    """distance of the flanges [m], fixed start value"""
    v_rel: Any
    """relative velocity of the flanges [m/s], fixed start value"""
    a_rel: Any
    """relative acceleration of the flanges [m/s2], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class Magnetorheological(Dissipative):
    """What magnetorheological dampers share: a coil that lags, i' = eta (u - i), and the hysteresis z.

    alpha = alpha_a + alpha_b i, c_0 = c_0a + c_0b i. The hysteresis stores alpha z^2/(2 A); as the coil makes
    it stiffer, that puts in supplyPower = alpha' z^2/(2 A).
    """

    u: Any
    """current [A] or voltage [V] of the coil, a number, a function of time or Sampled data"""
    alpha_a: Any
    """force over z without current [N/m]"""
    alpha_b: Any
    """its growth with u [N/m]"""
    c_0a: Any
    """damping constant without current [N.s/m], at least 0"""
    c_0b: Any
    """its growth with u [N.s/m]"""
    k_0: Any
    """stiffness [N/m], at least 0"""
    s_rel0: Any
    """distance without spring force [m]"""
    eta: Any
    """rate at which coil and fluid follow [1/s], above 0"""
    A: Any
    """scale of the hysteretic displacement, above 0"""
    beta: Any
    """loop shape against the motion [1/m^n], at least 0"""
    gamma: Any
    """loop shape along the motion [1/m^n]"""
    n: Any
    """sharpness of yield, at least 1"""
    i: Any
    """what the fluid follows, fixed start value"""
    z: Any
    """hysteretic displacement [m], fixed start value"""
    supplyPower: Any
    """power that comes in otherwise than through flanges [W]"""
    @property
    def alpha(self) -> Any: ...
    @property
    def c_0(self) -> Any: ...
    @property
    def bent(self) -> Any: ...
    def yielding(self, v: Any) -> Any: ...
    def rubbed(self, v: Any) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

class MapSpringDamper(Dissipative):
    """Force given over stretch and speed: f = F(s_rel - s_rel0, v_rel), bilinear or by cubic pieces.

    What it has at rest, F(s_rel - s_rel0, 0), is stored, the rest lost: below 0 where the points give power.

    Limits: beyond the grid it goes on straight in either direction. Smooth, it may overshoot its points.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        table: rows (stretch [m], speed [m/s], force [N]) that fill a grid.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    table: Any
    """rows (stretch [m], speed [m/s], force [N]) that fill a grid"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    @property
    def map(self) -> Any: ...
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        table: Any = ...,
        interpolation: Literal['linear', 'smooth'] = 'linear',
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class MonotubeDamper(Dissipative):
    """Gas-charged hydraulic damper: oil is pressed through a piston, and a gas takes up the rod's volume.

    f = A_r p_r - A_p p_g + (A_p - A_r) p_amb, with e = s_rel - s_rel0 and the oil's compression q:

        q' = A_r v_rel - Q,   p_r = p_0 + beta q/V_r,   p_g = p_0 (V_0/(V_0 + (A_p - A_r) e + q))^n
        Q = C_d A sqrt(2 dp/rho), dp = p_r - p_g; A is A_e in extension, A_c in compression

    Below dp of about p_t the flow through the piston is in proportion to dp.

    Limits: no cavitation (the pressures must stay above 0), no mass of oil or floating piston, V_r constant.

    Source: the flows and pressures of J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007).

    Args:
        A_p: area of the piston [m2], above 0.
        A_r: area of the piston less the rod's [m2], above 0.
        A_e: opening of the valves in extension [m2], above 0.
        A_c: opening of the valves in compression [m2], above 0.
        V_r: volume of oil on the rod's side [m3], above 0.
        V_0: volume of gas at s_rel0 [m3], above 0.
        p_0: pressure at s_rel0, absolute [Pa], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        n: polytropic exponent of the gas, at least 1.
        C_d: discharge coefficient, above 0.
        rho: density of the oil [kg/m3], above 0.
        beta: bulk modulus of the oil [Pa], above 0.
        p_t: pressure difference below which the flow is laminar [Pa], above 0.
        p_amb: pressure outside [Pa], at least 0.
        s_rel0: distance at which the pressure is p_0 [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        q: compression of the oil [m3], fixed start value.
        p_r: pressure on the rod's side, absolute [Pa], fixed start value.
        p_g: pressure of the gas, absolute [Pa], fixed start value.
        Q: flow through the piston, positive in extension [m3/s], fixed start value.
    """

    A_p: Any
    """area of the piston [m2], above 0"""
    A_r: Any
    """area of the piston less the rod's [m2], above 0"""
    A_e: Any
    """opening of the valves in extension [m2], above 0"""
    A_c: Any
    """opening of the valves in compression [m2], above 0"""
    V_r: Any
    """volume of oil on the rod's side [m3], above 0"""
    V_0: Any
    """volume of gas at s_rel0 [m3], above 0"""
    p_0: Any
    """pressure at s_rel0, absolute [Pa], above 0"""
    n: Any
    """polytropic exponent of the gas, at least 1"""
    C_d: Any
    """discharge coefficient, above 0"""
    rho: Any
    """density of the oil [kg/m3], above 0"""
    beta: Any
    """bulk modulus of the oil [Pa], above 0"""
    p_t: Any
    """pressure difference below which the flow is laminar [Pa], above 0"""
    p_amb: Any
    """pressure outside [Pa], at least 0"""
    s_rel0: Any
    """distance at which the pressure is p_0 [m]"""
    q: Any
    """compression of the oil [m3], fixed start value"""
    p_r: Any
    """pressure on the rod's side, absolute [Pa], fixed start value"""
    p_g: Any
    """pressure of the gas, absolute [Pa], fixed start value"""
    Q: Any
    """flow through the piston, positive in extension [m3/s], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    @property
    def rod(self) -> Any: ...
    @property
    def V(self) -> Any: ...
    @property
    def gas(self) -> Any: ...
    @property
    def oil(self) -> Any: ...
    def __init__(
        self,
        *,
        A_p: ParameterValue,
        A_r: ParameterValue,
        A_e: ParameterValue,
        A_c: ParameterValue,
        V_r: ParameterValue,
        V_0: ParameterValue,
        p_0: ParameterValue,
        useHeatPort: bool = False,
        n: ParameterValue = 1.4,
        C_d: ParameterValue = 0.7,
        rho: ParameterValue = 860.0,
        beta: ParameterValue = 1400000000.0,
        p_t: ParameterValue = 1000.0,
        p_amb: ParameterValue = 101325.0,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        q: Number = ...,
        p_r: Number = ...,
        p_g: Number = ...,
        Q: Number = ...,
    ) -> None: ...

class QuadraticDamper(Dissipative):
    """Damper with force growing with the square of speed: f = c v_rel |v_rel|.

    Args:
        c: quadratic damping constant [N.s2/m2], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    c: Any
    """quadratic damping constant [N.s2/m2], at least 0"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class RelaxingBacklash(CompliantWithSpeed, RelaxingFlanks):
    """Backlash b in series with a spring and damper without mass, which relax while they touch nothing.

    With x = s_rel - s_rel0 and their stretch z, d z' + k z = p: they press by p = k (x -+ b/2) + d v_rel from
    where x -+ b/2 meets z until they would pull, and by p = 0 between. f = p + d_0 v_rel, which jumps as they
    meet, since the damper is struck. `ElastoBacklash` knows no z: what a flank gives comes back at once.

    Without backlash it is a `SpringDamper`, without stiffness a damper with play. Where a spring follows it
    without mass between them, something must fill the backlash (d_0 > 0), or nothing tells where that stays.

    Args:
        k: stiffness in contact [N/m], at least 0.
        d: damping constant in contact [N.s/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        b: total backlash [m], at least 0.
        s_rel0: distance in the middle of the backlash [m].
        d_0: damping constant of what fills the backlash [N.s/m], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: stretch of spring and damper [m], fixed start value.
    """

    k: Any
    """stiffness in contact [N/m], at least 0"""
    d: Any
    """damping constant in contact [N.s/m], above 0"""
    b: Any
    """total backlash [m], at least 0"""
    s_rel0: Any
    """distance in the middle of the backlash [m]"""
    d_0: Any
    """damping constant of what fills the backlash [N.s/m], at least 0"""
    z: Any
    """stretch of spring and damper [m], fixed start value"""
    @property
    def offset(self) -> Any: ...
    @property
    def speed(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    @property
    def width(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        b: ParameterValue = 0.0,
        s_rel0: ParameterValue = 0.0,
        d_0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Rope(Dissipative):
    """Rope, chain or cable, which pulls and never pushes: taut above s_rel0, slack below.

    f = k e + min(max(d v_rel, -k e), k e) with e = max(s_rel - s_rel0, 0): continuous where it becomes taut.

    Args:
        k: stiffness [N/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        d: damping constant [N.s/m], at least 0.
        s_rel0: length at which it becomes taut [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    k: Any
    """stiffness [N/m], at least 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    s_rel0: Any
    """length at which it becomes taut [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    @property
    def damping(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        useHeatPort: bool = False,
        d: ParameterValue = 0.0,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class ShearThinningDamper(Dissipative):
    """Damper whose oil thins where it is sheared fast: f = d v_e asinh(v_rel/v_e).

    Viscous at speeds far below v_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.

    Args:
        d: damping constant at rest [N.s/m], at least 0.
        v_e: speed above which the oil thins [m/s], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    d: Any
    """damping constant at rest [N.s/m], at least 0"""
    v_e: Any
    """speed above which the oil thins [m/s], above 0"""
    def __init__(
        self,
        *,
        d: ParameterValue,
        v_e: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class SpringDamper(Dissipative):
    """Linear spring and damper in parallel: f = k (s_rel - s_rel0) + d v_rel.

    Source: MSL Translational.Components.SpringDamper.

    Args:
        k: stiffness [N/m], at least 0.
        d: damping constant [N.s/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    k: Any
    """stiffness [N/m], at least 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class TabulatedDamper(Dissipative):
    """Damper given by points, as a dynamometer measures it: f = F(v_rel), straight beyond the ends.

    Source: as for `TabulatedSpring`.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        table: rows (speed [m/s], force [N]), the first increasing.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    table: Any
    """rows (speed [m/s], force [N]), the first increasing"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        table: Any = ...,
        interpolation: Literal['linear', 'smooth'] = 'linear',
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class TabulatedForce(Dissipative):
    """Force that is any law of position, speed or both: f = F(s_rel - s_rel0, v_rel), given by points.

    What it has at rest is stored, the rest lost: below 0 where the points give power. Of one variable
    interpolation="smooth" never overshoots its points, so that the law is monotone where they are.

    Limits: beyond the points it goes on straight. A step is a steep line: nothing sticks.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        table: rows (stretch [m], force [N]), (speed [m/s], force [N]) or (stretch [m], speed [m/s], force
            [N]).
        over: what rows of two numbers are over.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        odd: whether the points are one half, and F(-x) = -F(x) the other.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    table: Any
    """rows (stretch [m], force [N]), (speed [m/s], force [N]) or (stretch [m], speed [m/s], force [N])"""
    over: Any
    """what rows of two numbers are over"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    odd: Any
    """whether the points are one half, and F(-x) = -F(x) the other"""
    s_rel0: Any
    """unstretched length [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    @property
    def points(self) -> Any: ...
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        table: Any = ...,
        over: Literal['position', 'speed'] = 'speed',
        interpolation: Literal['linear', 'smooth'] = 'linear',
        odd: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class VariableDamper(Dissipative):
    """Damper whose constant follows a signal: f = (d + d_u u + d_uu u^2) v_rel.

    u is what it depends on: the current of a valve or a coil, a temperature, time. A constant below 0 stands
    for what is taken from damping that is there.

    Args:
        d_u: change of the damping constant with u [N.s/m].
        useHeatPort: whether its losses leave as heat through heatPort.
        u: what the damping follows, a number, a function of time or Sampled data.
        d: damping constant at u = 0 [N.s/m].
        d_uu: change of it with the square of u [N.s/m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    u: Any
    """what the damping follows, a number, a function of time or Sampled data"""
    d: Any
    """damping constant at u = 0 [N.s/m]"""
    d_u: Any
    """change of the damping constant with u [N.s/m]"""
    d_uu: Any
    """change of it with the square of u [N.s/m]"""
    def __init__(
        self,
        *,
        d_u: ParameterValue,
        useHeatPort: bool = False,
        u: SignalValue = ...,
        d: ParameterValue = 0.0,
        d_uu: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class VoiceCoil(Dissipative):
    """Coil in a magnet, fed by a voltage: pushes its flanges apart with Bl i, L i' = u - R i - Bl v_rel.

    `machines.Shaker` adds armature and suspension.

    Args:
        Bl: force constant, magnetic field times length of wire [N/A], not 0.
        R: resistance [V/A], above 0.
        L: inductance [V.s/A], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        u: voltage [V], a number, a function of time or Sampled data.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        i: current [A], fixed start value.
    """

    u: Any
    """voltage [V], a number, a function of time or Sampled data"""
    Bl: Any
    """force constant, magnetic field times length of wire [N/A], not 0"""
    R: Any
    """resistance [V/A], above 0"""
    L: Any
    """inductance [V.s/A], above 0"""
    i: Any
    """current [A], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    supplyPower: Any
    """power that comes in otherwise than through flanges [W]"""
    def __init__(
        self,
        *,
        Bl: ParameterValue,
        R: ParameterValue,
        L: ParameterValue,
        useHeatPort: bool = False,
        u: SignalValue = ...,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        i: Number = ...,
    ) -> None: ...

class WireRope(Dissipative):
    """Wire rope isolator: f = k_1 e + k_2 e^2 + k_3 e^3 + f_y z, the strands rubbing with at most f_y.

    s_y z' = v - share |v| |z|^(n-1) z - (1 - share) v |z|^n with e = s_rel - s_rel0, v = v_rel: a Bouc-Wen
    hysteresis of -1 <= z <= 1. k_2 tells pull from push, k_3 > 0 stiffens.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263; on wire rope, G. F. Demetriades,
    M. C. Constantinou, A. M. Reinhorn, Engineering Structures 15 (1993) 321-334.

    Args:
        k_1: stiffness once the strands slip [N/m], at least 0.
        f_y: friction force of the strands [N], at least 0.
        s_y: displacement over which the strands begin to slip [m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        k_2: how pull and push differ [N/m2].
        k_3: stiffening [N/m3].
        n: sharpness of slip, at least 1.
        share: of the loop's shape against the motion, at least 0.5, at most 1.
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: share of the friction force that has built up, fixed start value.
    """

    k_1: Any
    """stiffness once the strands slip [N/m], at least 0"""
    k_2: Any
    """how pull and push differ [N/m2]"""
    k_3: Any
    """stiffening [N/m3]"""
    f_y: Any
    """friction force of the strands [N], at least 0"""
    s_y: Any
    """displacement over which the strands begin to slip [m], above 0"""
    n: Any
    """sharpness of slip, at least 1"""
    share: Any
    """of the loop's shape against the motion, at least 0.5, at most 1"""
    s_rel0: Any
    """unstretched length [m]"""
    z: Any
    """share of the friction force that has built up, fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def e(self) -> Any: ...
    @property
    def yielding(self) -> Any: ...
    @property
    def stretched(self) -> Any: ...
    def __init__(
        self,
        *,
        k_1: ParameterValue,
        f_y: ParameterValue,
        s_y: ParameterValue,
        useHeatPort: bool = False,
        k_2: ParameterValue = 0.0,
        k_3: ParameterValue = 0.0,
        n: ParameterValue = 1.0,
        share: ParameterValue = 0.5,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    f = f_forward for v_rel > 0 and -f_backward for v_rel < 0.
    While stuck, -peak f_backward <= f <= peak f_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.

    Args:
        f_forward: friction force while the flanges part [N], at least 0.
        f_backward: friction force while they approach [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    f_forward: Any
    """friction force while the flanges part [N], at least 0"""
    f_backward: Any
    """friction force while they approach [N], at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def sliding_back(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_forward: ParameterValue,
        f_backward: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class BoucWen(CompliantWithSpeed, HystereticSpring):
    """Hysteretic spring: f = alpha k s_rel + (1 - alpha) k z.

    z' = A v_rel - beta |v_rel| |z|^(n-1) z - gamma v_rel |z|^n, with z [m] the hysteretic displacement.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263.

    Args:
        k: initial stiffness [N/m], at least 0.
        beta: loop shape against the motion [1/m^n], at least 0.
        gamma: loop shape along the motion [1/m^n].
        useHeatPort: whether its losses leave as heat through heatPort.
        alpha: share of stiffness after yield, at least 0, at most 1.
        A: scale of z, above 0.
        n: sharpness of yield, at least 1.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: hysteretic displacement [m], fixed start value.
    """

    k: Any
    """initial stiffness [N/m], at least 0"""
    beta: Any
    """loop shape against the motion [1/m^n], at least 0"""
    gamma: Any
    """loop shape along the motion [1/m^n]"""
    z: Any
    """hysteretic displacement [m], fixed start value"""
    @property
    def stretch(self) -> Any: ...
    @property
    def speed(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        beta: ParameterValue,
        gamma: ParameterValue,
        useHeatPort: bool = False,
        alpha: ParameterValue = 0.1,
        A: ParameterValue = 1.0,
        n: ParameterValue = 2.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class BoucWenDamper(Magnetorheological):
    """Magnetorheological damper, simple: f = alpha z + c_0 v_rel + k_0 (s_rel - s_rel0).

    z' = A v - beta |v| |z|^(n-1) z - gamma v |z|^n with v = v_rel. alpha = alpha_a + alpha_b i and
    c_0 = c_0a + c_0b i follow the coil's signal u by i' = eta (u - i).

    Source: B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson, Phenomenological model of a
    magnetorheological damper, J. Eng. Mech. 123 (1997) 230-238.

    Args:
        alpha_a: force over z without current [N/m].
        alpha_b: its growth with u [N/m].
        c_0a: damping constant without current [N.s/m], at least 0.
        c_0b: its growth with u [N.s/m].
        eta: rate at which coil and fluid follow [1/s], above 0.
        A: scale of the hysteretic displacement, above 0.
        beta: loop shape against the motion [1/m^n], at least 0.
        gamma: loop shape along the motion [1/m^n].
        useHeatPort: whether its losses leave as heat through heatPort.
        u: current [A] or voltage [V] of the coil, a number, a function of time or Sampled data.
        k_0: stiffness [N/m], at least 0.
        s_rel0: distance without spring force [m].
        n: sharpness of yield, at least 1.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        i: what the fluid follows, fixed start value.
        z: hysteretic displacement [m], fixed start value.
    """

    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        alpha_a: ParameterValue,
        alpha_b: ParameterValue,
        c_0a: ParameterValue,
        c_0b: ParameterValue,
        eta: ParameterValue,
        A: ParameterValue,
        beta: ParameterValue,
        gamma: ParameterValue,
        useHeatPort: bool = False,
        u: SignalValue = ...,
        k_0: ParameterValue = 0.0,
        s_rel0: ParameterValue = 0.0,
        n: ParameterValue = 2.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        i: Number = ...,
        z: Number = ...,
    ) -> None: ...

class CoulombFriction(Friction):
    """Coulomb friction: f = f_c sgn(v_rel) while sliding, |f| <= peak f_c while stuck.

    Source: C. A. Coulomb, Theorie des machines simples (1785).

    Args:
        f_c: Coulomb friction force [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    f_c: Any
    """Coulomb friction force [N], at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_c: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class DriftingFriction(Friction):
    """Friction whose level follows a signal: f = (f_c + f_u u + f_uu u^2) sgn(v_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. A level below zero counts as none; with
    `regularised` it may be negative, so that it stands for what a drift adds to, or takes from, friction that
    is there.

    Args:
        f_u: change of friction force with u [N].
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        u: what the level follows, a number, a function of time or Sampled data.
        f_c: friction force at u = 0 [N].
        f_uu: change of it with the square of u [N].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    u: Any
    """what the level follows, a number, a function of time or Sampled data"""
    f_c: Any
    """friction force at u = 0 [N]"""
    f_u: Any
    """change of friction force with u [N]"""
    f_uu: Any
    """change of it with the square of u [N]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_u: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        u: SignalValue = ...,
        f_c: ParameterValue = 0.0,
        f_uu: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class Iwan(CompliantWithSpeed, IwanCells):
    """A joint that slips bit by bit: f = k mean(z_i), cells that yield one after the other, the last at s_y.

    Cell i of n yields at y_i = s_y ((i - 1/2)/n)^p, rounded by Bouc and Wen's law: z_i' = v_rel if v_rel z_i
    <= 0, else v_rel (1 - |z_i/y_i|^8). Pulled on, it slides at k s_y/(1 + p). With many cells the loops are
    those of Masing, and before it slides a loop of the amplitude a loses a^(2 + 1/p): p = 1/(1 + chi) of the
    four-parameter Iwan joint, whose chi is between -1 and 0.

    Six cells are within 2 % of the force of many sharp ones where it moves by s_y and more, and within 4 %
    where it moves by a tenth; but what it loses there may be half too much, and is nothing below the first
    yield. Twenty cells are within 11 %, 40 within 6 %, with p of 1 and more.

    Source: W. D. Iwan, A distributed-element model for hysteresis and its steady-state dynamic response, J.
    Appl. Mech. 33 (1966) 893-900; D. J. Segalman, A four-parameter Iwan model for lap-type joints, J. Appl.
    Mech. 72 (2005) 752-760.

    Example:
        >>> from inertance import Iwan
        >>> lap = Iwan(k=1e7, s_y=1e-5, p=2.0)

    Args:
        p: how the yields spread: 0 all at once, 1 evenly, above 1 more of them early, at least 0.
        k: stiffness before it slips [N/m], at least 0.
        s_y: stretch at which the last cell yields [m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        cells: number of cells.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    k: Any
    """stiffness before it slips [N/m], at least 0"""
    s_y: Any
    """stretch at which the last cell yields [m], above 0"""
    @property
    def speed(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    @property
    def slip_stretch(self) -> Any: ...
    def cell(self) -> Any: ...
    def __init__(
        self,
        *,
        p: ParameterValue,
        k: ParameterValue,
        s_y: ParameterValue,
        useHeatPort: bool = False,
        cells: int | np.integer[Any] = 6,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        **parts: Component,
    ) -> None: ...

class Jenkins(CompliantWithSpeed, ElastoPlastic):
    """A spring in series with dry friction, without mass between them: f = k z, |f| <= f_c.

    z' = v_rel while it sticks, z' = 0 while it slips at |f| = f_c. Several side by side, which slip one
    after the other, are friction with presliding (Maxwell-slip, Iwan).

    Source: G. M. Jenkins, Analysis of the stress-strain relationships in reactor grade graphite, British
    Journal of Applied Physics 13 (1962) 30-32.

    Example:
        >>> from inertance import Jenkins
        >>> joint = Jenkins(k=1e6, f_c=200.0)

    Args:
        k: stiffness of the spring [N/m], above 0.
        f_c: Coulomb friction force [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: stretch of the spring [m], fixed start value.
    """

    k: Any
    """stiffness of the spring [N/m], above 0"""
    f_c: Any
    """Coulomb friction force [N], at least 0"""
    z: Any
    """stretch of the spring [m], fixed start value"""
    @property
    def speed(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    @property
    def slip_stretch(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        f_c: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class LoadedFriction(Friction):
    """Friction in proportion to a load: f = mu |load| sgn(v_rel) while sliding.

    While stuck, |f| <= peak mu |load|.

    Example:
        >>> from inertance import ForceSensor, LoadedFriction
        >>> seal = LoadedFriction(mu=0.02)  # connect the force of a ForceSensor to seal.load

    Args:
        mu: friction force over load, at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        load: force that presses the surfaces together [N], a number, a function of time or Sampled data.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    load: Any
    """force that presses the surfaces together [N], a number, a function of time or Sampled data"""
    mu: Any
    """friction force over load, at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        mu: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        load: SignalValue = ...,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class LuGreFriction(CompliantWithSpeed, Bristles):
    """Friction of bristles that bend by z: f = sigma_0 z + sigma_1 z' + sigma_2 v_rel.

    z' = v_rel - sigma_0 |v_rel| z/g with g = f_c + (f_s - f_c) exp(-(v_rel/v_s)^2), so that f comes to
    g sgn(v_rel) + sigma_2 v_rel at a steady speed. It knows no events.

    Limits: with a large sigma_1 it may give power back for an instant, and under a load that vibrates below
    break-away it drifts.

    Source: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems
    with friction, IEEE Trans. Automat. Contr. 40 (1995) 419-425.

    Args:
        f_c: Coulomb friction force [N], above 0.
        v_s: Stribeck velocity [m/s], above 0.
        sigma_0: stiffness of the bristles [N/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        f_s: static friction force [N], above 0.
        sigma_1: damping of the bristles [N.s/m], at least 0.
        sigma_2: viscous friction [N.s/m], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: mean bend of the bristles [m], fixed start value.
    """

    f_c: Any
    """Coulomb friction force [N], above 0"""
    f_s: Any
    """static friction force [N], above 0"""
    v_s: Any
    """Stribeck velocity [m/s], above 0"""
    sigma_0: Any
    """stiffness of the bristles [N/m], above 0"""
    sigma_1: Any
    """damping of the bristles [N.s/m], at least 0"""
    sigma_2: Any
    """viscous friction [N.s/m], at least 0"""
    z: Any
    """mean bend of the bristles [m], fixed start value"""
    @property
    def speed(self) -> Any: ...
    @property
    def level(self) -> Any: ...
    def __init__(
        self,
        *,
        f_c: ParameterValue,
        v_s: ParameterValue,
        sigma_0: ParameterValue,
        useHeatPort: bool = False,
        f_s: ParameterValue = ...,
        sigma_1: ParameterValue = 0.0,
        sigma_2: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class PositionDependentFriction(Friction):
    """Dry friction whose level depends on where it slides: f = level sgn(v_rel).

    level = f_c + f_1 e + f_2 e^2 + f_cos cos(2 pi e/period) + f_sin sin(2 pi e/period), e = s_rel - s_rel0,
    the waves as of a screw or a rail that is tight at places.

    A level below zero counts as none; with `regularised` it may be negative, so that it stands for what is
    added to, or taken from, friction that is there.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991).

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        f_c: friction force at s_rel0, but for the waves [N].
        f_1: slope of the friction force there [N/m].
        f_2: half of its curvature [N/m2].
        f_cos: share of a wave that is greatest at s_rel0 [N].
        f_sin: share of a wave that rises there [N].
        period: distance from wave to wave [m], above 0.
        s_rel0: distance from which e counts [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    f_c: Any
    """friction force at s_rel0, but for the waves [N]"""
    f_1: Any
    """slope of the friction force there [N/m]"""
    f_2: Any
    """half of its curvature [N/m2]"""
    f_cos: Any
    """share of a wave that is greatest at s_rel0 [N]"""
    f_sin: Any
    """share of a wave that rises there [N]"""
    period: Any
    """distance from wave to wave [m], above 0"""
    s_rel0: Any
    """distance from which e counts [m]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        f_c: ParameterValue = 0.0,
        f_1: ParameterValue = 0.0,
        f_2: ParameterValue = 0.0,
        f_cos: ParameterValue = 0.0,
        f_sin: ParameterValue = 0.0,
        period: ParameterValue = 1.0,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class SpencerDamper(Magnetorheological):
    """Magnetorheological damper whose force rolls off at low speeds: f = c_1 y' + k_1 (s_rel - s_rel0).

    c_1 y' = alpha z + c_0 v + k_0 (s_rel - y) with v = v_rel - y', and z' = A v - beta |v| |z|^(n-1) z -
    gamma v |z|^n. alpha, c_0 and c_1 = c_1a + c_1b i follow the coil's signal u by i' = eta (u - i). The gas
    charge is k_1.

    Source: B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson, Phenomenological model of a
    magnetorheological damper, J. Eng. Mech. 123 (1997) 230-238.

    Args:
        alpha_a: force over z without current [N/m].
        alpha_b: its growth with u [N/m].
        c_0a: damping constant without current [N.s/m], at least 0.
        c_0b: its growth with u [N.s/m].
        eta: rate at which coil and fluid follow [1/s], above 0.
        A: scale of the hysteretic displacement, above 0.
        beta: loop shape against the motion [1/m^n], at least 0.
        gamma: loop shape along the motion [1/m^n].
        c_1a: damping in series without current [N.s/m], above 0.
        c_1b: its growth with u [N.s/m].
        useHeatPort: whether its losses leave as heat through heatPort.
        u: current [A] or voltage [V] of the coil, a number, a function of time or Sampled data.
        k_0: stiffness [N/m], at least 0.
        s_rel0: distance without spring force [m].
        n: sharpness of yield, at least 1.
        k_1: stiffness of the gas charge [N/m], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        i: what the fluid follows, fixed start value.
        z: hysteretic displacement [m], fixed start value.
        y: stretch of the damping in series [m], fixed start value.
        v: speed of the hysteresis [m/s], fixed start value.
    """

    c_1a: Any
    """damping in series without current [N.s/m], above 0"""
    c_1b: Any
    """its growth with u [N.s/m]"""
    k_1: Any
    """stiffness of the gas charge [N/m], at least 0"""
    y: Any
    """stretch of the damping in series [m], fixed start value"""
    v: Any
    """speed of the hysteresis [m/s], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def c_1(self) -> Any: ...
    @property
    def springs(self) -> Any: ...
    def __init__(
        self,
        *,
        alpha_a: ParameterValue,
        alpha_b: ParameterValue,
        c_0a: ParameterValue,
        c_0b: ParameterValue,
        eta: ParameterValue,
        A: ParameterValue,
        beta: ParameterValue,
        gamma: ParameterValue,
        c_1a: ParameterValue,
        c_1b: ParameterValue,
        useHeatPort: bool = False,
        u: SignalValue = ...,
        k_0: ParameterValue = 0.0,
        s_rel0: ParameterValue = 0.0,
        n: ParameterValue = 2.0,
        k_1: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        i: Number = ...,
        z: Number = ...,
        y: Number = ...,
        v: Number = ...,
    ) -> None: ...

class StribeckFriction(Friction):
    """Coulomb, Stribeck and viscous friction.

    f = [f_c + (f_s - f_c) exp(-|v_rel|/v_s)] sgn(v_rel) + d v_rel while sliding;
    |f| <= peak f_s while stuck.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (26) for translation.

    Args:
        f_c: Coulomb friction force [N], at least 0.
        f_s: static friction force [N], at least 0.
        v_s: Stribeck velocity [m/s], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        d: viscous friction [N.s/m], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    f_c: Any
    """Coulomb friction force [N], at least 0"""
    f_s: Any
    """static friction force [N], at least 0"""
    v_s: Any
    """Stribeck velocity [m/s], above 0"""
    d: Any
    """viscous friction [N.s/m], at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_c: ParameterValue,
        f_s: ParameterValue,
        v_s: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        d: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class TabulatedFriction(Friction):
    """Friction force interpolated linearly in a table of (speed, force), speeds from 0 upwards.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        table: rows (speed [m/s], force [N]), speeds increasing from 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    table: Any
    """rows (speed [m/s], force [N]), speeds increasing from 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        table: Any = ...,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class TemperatureDependentFriction(Friction, AtTemperature):
    """Coulomb friction that changes with temperature: f = f_c (1 + alpha (T - TRef)) sgn(v_rel).

    T is that of `heatPort` with `useHeatPort`, which its losses may heat. While stuck, |f| <= peak of it.
    Limits: alpha (T - TRef) must stay above -1.

    Args:
        f_c: Coulomb friction force at TRef [N], at least 0.
        alpha: relative change of friction with temperature [1/K].
        useHeatPort: whether its losses leave as heat through heatPort.
        T: temperature if heatPort is not used [K], above 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        TRef: temperature at which it is f_c [K], above 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    f_c: Any
    """Coulomb friction force at TRef [N], at least 0"""
    alpha: Any
    """relative change of friction with temperature [1/K]"""
    TRef: Any
    """temperature at which it is f_c [K], above 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_c: ParameterValue,
        alpha: ParameterValue,
        useHeatPort: bool = False,
        T: ParameterValue = 293.15,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        TRef: ParameterValue = 293.15,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...
