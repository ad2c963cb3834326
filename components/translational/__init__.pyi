"""Elements that slide."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any

from ..elastoplastic import ElastoPlastic
from ..filtered import Filtered
from ..language import Component, Number, ParameterValue, SignalValue
from ..pressed import PressedStickSlip
from ..stickslip import StickSlip

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

class _Driven(Component):
    flange: Any
    """what is driven"""
    support: Any
    """what reacts"""
    def __init__(self, **values: Any) -> None: ...

class _Levered(Component):
    flange_a: Any
    """end of arm a"""
    flange_b: Any
    """end of arm b"""
    support: Any
    """fulcrum"""
    def __init__(self, **values: Any) -> None: ...

class Accelerate(_Driven):
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

class ConstantForce(_Driven):
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

class Force(_Driven):
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

class PositionSensor(_Absolute):
    """Position as a signal: s = flange.s.

    Source: MSL Translational.Sensors.PositionSensor.
    """

    s: Any
    """position [m]"""
    def __init__(self) -> None: ...

class RelativePositionSensor(TwoFlanges):
    """Distance as a signal: s_rel = flange_b.s - flange_a.s.

    Source: MSL Translational.Sensors.RelPositionSensor.
    """

    s_rel: Any
    """distance of the flanges [m]"""
    def __init__(self) -> None: ...

class SpeedSensor(_Absolute):
    """Velocity as a signal: v = der(flange.s).

    Source: MSL Translational.Sensors.SpeedSensor.
    """

    v: Any
    """velocity [m/s]"""
    def __init__(self) -> None: ...

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
    """Spring with a cubic term: f = k e + k3 e^3 with e = s_rel - s_rel0.

    Source: G. Duffing, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz (1918).

    Args:
        k: linear stiffness [N/m], at least 0.
        k3: cubic stiffness; negative softens [N/m3].
        s_rel0: unstretched length [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    k: Any
    """linear stiffness [N/m], at least 0"""
    k3: Any
    """cubic stiffness; negative softens [N/m3]"""
    s_rel0: Any
    """unstretched length [m]"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        k3: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class HardStop(Compliant):
    """Two flanges that cannot come closer than s_rel = s_min.

    A shock reverses the relative velocity, v_rel+ = -e v_rel-, by the impulse J that this takes.
    Slower than `v_rest` afterwards, or too slow for a rebound of 1e-12 m against what presses them
    together, they stay in contact until they are pulled apart.

    Source: I. Newton's law of restitution.

    Args:
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
    def __init__(
        self,
        *,
        s_min: ParameterValue = 0.0,
        e: ParameterValue = 0.0,
        v_rest: ParameterValue = 1e-05,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

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

class Position(Filtered, _Driven):
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
    def __init__(
        self,
        *,
        f_sin: ParameterValue,
        period: ParameterValue,
        f_cos: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class Speed(Filtered, _Driven):
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
    def __init__(
        self,
        *,
        k: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class Backlash(CompliantWithSpeed):
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
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        eps: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class BoucWen(CompliantWithSpeed):
    """Hysteretic spring: f = alpha k s_rel + (1 - alpha) k z.

    z' = A v_rel - beta |v_rel| |z|^(n-1) z - gamma v_rel |z|^n, with z [m] the hysteretic displacement.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263.

    Args:
        k: initial stiffness [N/m], at least 0.
        beta: loop shape against the motion [1/m^n], at least 0.
        gamma: loop shape along the motion [1/m^n].
        alpha: share of stiffness after yield, at least 0, at most 1.
        A: scale of the hysteretic displacement, above 0.
        n: sharpness of yield, at least 1.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        z: hysteretic displacement [m], fixed start value.
    """

    k: Any
    """initial stiffness [N/m], at least 0"""
    alpha: Any
    """share of stiffness after yield, at least 0, at most 1"""
    A: Any
    """scale of the hysteretic displacement, above 0"""
    beta: Any
    """loop shape against the motion [1/m^n], at least 0"""
    gamma: Any
    """loop shape along the motion [1/m^n]"""
    n: Any
    """sharpness of yield, at least 1"""
    z: Any
    """hysteretic displacement [m], fixed start value"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        beta: ParameterValue,
        gamma: ParameterValue,
        alpha: ParameterValue = 0.1,
        A: ParameterValue = 1.0,
        n: ParameterValue = 2.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class CubicDamper(CompliantWithSpeed):
    """Damper with force growing with the cube of speed: f = d3 v_rel^3.

    Source: A. H. Nayfeh, D. T. Mook, Nonlinear Oscillations (1979).

    Args:
        d3: cubic damping constant [N.s3/m3], at least 0.
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
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class DahlFriction(CompliantWithSpeed):
    """Dry friction that builds up elastically before it slips: f = f_c z.

    s_p z' = v_rel - |v_rel| z: the share z of f_c grows by displacement/s_p at first, and comes within
    1/e of its end over s_p. It knows no events, and creeps under a load that changes.

    Source: P. R. Dahl, AIAA Journal 14 (1976) 1675-1682, with the exponent 1.

    Args:
        f_c: friction force once it slips [N], at least 0.
        s_p: presliding displacement [m], above 0.
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
    def __init__(
        self,
        *,
        f_c: ParameterValue,
        s_p: ParameterValue,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Damper(CompliantWithSpeed):
    """Linear damper: f = d v_rel.

    Source: MSL Translational.Components.Damper.

    Args:
        d: damping constant [N.s/m], at least 0.
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
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class ElastoGap(CompliantWithSpeed):
    """Spring and damper that touch only while s_rel < s_rel0.

    f = f_c + f_d with f_c = -k (s_rel0 - s_rel)^n and f_d = min(max(d v_rel, f_c), -f_c); f = 0 apart.
    So 2 f_c <= f <= 0: the contact never pulls, and f is continuous at touch and release.

    Source: MSL Translational.Components.ElastoGap.

    Args:
        k: stiffness [N/m^n], at least 0.
        d: damping constant [N.s/m], at least 0.
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
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        n: ParameterValue = 1.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
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
    def __init__(
        self,
        *,
        b: ParameterValue,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class QuadraticDamper(CompliantWithSpeed):
    """Damper with force growing with the square of speed: f = c v_rel |v_rel|.

    Args:
        c: quadratic damping constant [N.s2/m2], at least 0.
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
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class RelativeAccelerationSensor(RelativeSpeedSensor):
    """Relative acceleration as a signal: a_rel = der(v_rel).

    Source: MSL Translational.Sensors.RelAccSensor.
    """

    a_rel: Any
    """relative acceleration [m/s2]"""
    def __init__(self) -> None: ...

class ShearThinningDamper(CompliantWithSpeed):
    """Damper whose oil thins where it is sheared fast: f = d v_e asinh(v_rel/v_e).

    Viscous at speeds far below v_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.

    Args:
        d: damping constant at rest [N.s/m], at least 0.
        v_e: speed above which the oil thins [m/s], above 0.
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
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class SpringDamper(CompliantWithSpeed):
    """Linear spring and damper in parallel: f = k (s_rel - s_rel0) + d v_rel.

    Source: MSL Translational.Components.SpringDamper.

    Args:
        k: stiffness [N/m], at least 0.
        d: damping constant [N.s/m], at least 0.
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
    def __init__(
        self,
        *,
        k: ParameterValue,
        d: ParameterValue,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class VariableDamper(CompliantWithSpeed):
    """Damper whose constant follows a signal: f = (d + d_u u) v_rel.

    u is what it depends on: the current of a valve or a coil, a temperature, time. A constant below 0 stands
    for what is taken from damping that is there.

    Args:
        d_u: change of the damping constant with u [N.s/m].
        u: what the damping follows, a number, a function of time or Sampled data.
        d: damping constant at u = 0 [N.s/m].
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
    def __init__(
        self,
        *,
        d_u: ParameterValue,
        u: SignalValue = ...,
        d: ParameterValue = 0.0,
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

class Friction(Compliant, StickSlip):
    """Two flanges that rub on each other; subclasses say how much in `sliding(speed)`."""

    s_rel: Any
    """distance of the flanges [m], fixed start value"""
    v_rel: Any
    """relative velocity of the flanges [m/s], fixed start value"""
    a_rel: Any
    """relative acceleration of the flanges [m/s2], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

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
    def slip_stretch(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        f_c: ParameterValue,
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
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class CoulombFriction(Friction):
    """Coulomb friction: f = f_c sgn(v_rel) while sliding, |f| <= peak f_c while stuck.

    Source: C. A. Coulomb, Theorie des machines simples (1785).

    Args:
        f_c: Coulomb friction force [N], at least 0.
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
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class DriftingFriction(Friction):
    """Friction whose level follows a signal: f = (f_c + f_u u) sgn(v_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. With `regularised` the level may
    be negative, so that it stands for what a drift adds to, or takes from, friction that is there.

    Args:
        f_u: change of friction force with u [N].
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        u: what the level follows, a number, a function of time or Sampled data.
        f_c: friction force at u = 0 [N].
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
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        f_u: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        u: SignalValue = ...,
        f_c: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class LoadedFriction(Friction):
    """Friction in proportion to a load: f = mu |load| sgn(v_rel) while sliding.

    While stuck, |f| <= peak mu |load|.

    Example:
        >>> from inertance import ForceSensor, LoadedFriction
        >>> seal = LoadedFriction(mu=0.02)  # connect the force of a ForceSensor to seal.load

    Args:
        mu: friction force over load, at least 0.
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
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        load: SignalValue = ...,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class PositionDependentFriction(Friction):
    """Dry friction whose level depends on where it slides: f = (f_c + f_1 e + f_2 e^2) sgn(v_rel).

    e = s_rel - s_rel0. With `regularised` the level may be negative, so that it stands for what is added
    to, or taken from, friction that is there.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991).

    Args:
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        f_c: friction force at s_rel0 [N].
        f_1: slope of the friction force at s_rel0 [N/m].
        f_2: half of its curvature [N/m2].
        s_rel0: distance at which the level is f_c [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
        a_rel: relative acceleration of the flanges [m/s2], fixed start value.
    """

    f_c: Any
    """friction force at s_rel0 [N]"""
    f_1: Any
    """slope of the friction force at s_rel0 [N/m]"""
    f_2: Any
    """half of its curvature [N/m2]"""
    s_rel0: Any
    """distance at which the level is f_c [m]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        f_c: ParameterValue = 0.0,
        f_1: ParameterValue = 0.0,
        f_2: ParameterValue = 0.0,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
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
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        table: Any = ...,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...
