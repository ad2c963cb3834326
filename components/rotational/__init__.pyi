"""Elements that turn."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any

from ..elastoplastic import ElastoPlastic
from ..filtered import Filtered
from ..language import Component, Number, ParameterValue, SignalValue
from ..pressed import Pressed, PressedStickSlip
from ..stickslip import StickSlip, Sticking

class BearingFriction(Component):
    """Friction of a shaft in its bearing, whose housing is the ground when left unconnected.

    Example:
        >>> from inertance import rotational
        >>> oiled = rotational.StribeckFriction(tau_c=0.2, tau_s=0.22, w_s=1.0, d=3e-3)
        >>> bearing = rotational.BearingFriction(friction=oiled)
        >>> table = rotational.TabulatedFriction(tau_pos=((0, 0.5), (1, 1)), peak=1.2)
        >>> bearing = rotational.BearingFriction(friction=table)

    Args:
        friction: CoulombFriction.
    """

    flange: Any
    """shaft"""
    support: Any
    """housing"""
    friction: Any
    """CoulombFriction"""
    def __init__(
        self,
        *,
        friction: Component = ...,
    ) -> None: ...

class Fixed(Component):
    """A flange held at a constant angle: phi = phi0.

    Source: MSL Rotational.Components.Fixed.

    Args:
        phi0: angle [rad].
    """

    flange: Any
    """held flange"""
    phi0: Any
    """angle [rad]"""
    def __init__(
        self,
        *,
        phi0: ParameterValue = 0.0,
    ) -> None: ...

class GearMesh(Component):
    """Two gears meshing with stiffness, damping and clearance along the line of action.

    s_rel = r_a (phi_a - phi_c) + r_b (phi_b - phi_c), with -r_b when gear b is a ring around gear a,
    and phi_c the angle of the support that carries the gears' axes. With p = k s_rel + d v_rel:
    f = p - k g when p >= k g, zero when |p| < k g, p + k g when p <= -k g.
    flange_a.tau = r_a f, flange_b.tau = r_b f (-r_b for a ring); the support takes the rest.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(20).

    Args:
        r_a: base radius of gear a [m], above 0.
        r_b: base radius of gear b [m], above 0.
        k: mesh stiffness [N/m], above 0.
        d: mesh damping [N.s/m], at least 0.
        g: half of the clearance [m], at least 0.
        internal: whether gear b is a ring around gear a.
        s_rel: approach of the flanks along the line of action [m], fixed start value.
        v_rel: speed of approach [m/s], fixed start value.
        f: force along the line of action, positive against positive angles of gear a [N], fixed start value.
    """

    flange_a: Any
    """gear a"""
    flange_b: Any
    """gear b"""
    support: Any
    """what carries the axes of the gears"""
    r_a: Any
    """base radius of gear a [m], above 0"""
    r_b: Any
    """base radius of gear b [m], above 0"""
    k: Any
    """mesh stiffness [N/m], above 0"""
    d: Any
    """mesh damping [N.s/m], at least 0"""
    g: Any
    """half of the clearance [m], at least 0"""
    internal: Any
    """whether gear b is a ring around gear a"""
    s_rel: Any
    """approach of the flanks along the line of action [m], fixed start value"""
    v_rel: Any
    """speed of approach [m/s], fixed start value"""
    f: Any
    """force along the line of action, positive against positive angles of gear a [N], fixed start value"""
    def __init__(
        self,
        *,
        r_a: ParameterValue,
        r_b: ParameterValue,
        k: ParameterValue,
        d: ParameterValue = 0.0,
        g: ParameterValue = 0.0,
        internal: bool = False,
        s_rel: Number = ...,
        v_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class IdealGear(Component):
    """A gearbox without inertia or loss, angles against its housing: phi_a = ratio phi_b.

    Torques: flange_b.tau = -ratio flange_a.tau; the support takes what is left of their sum.

    Source: MSL Rotational.Components.IdealGear.

    Args:
        ratio: turns of flange_a for one of flange_b, not 0.
    """

    flange_a: Any
    """left shaft"""
    flange_b: Any
    """right shaft"""
    support: Any
    """housing"""
    ratio: Any
    """turns of flange_a for one of flange_b, not 0"""
    def __init__(
        self,
        *,
        ratio: ParameterValue,
    ) -> None: ...

class IdealPlanetary(Component):
    """A planetary gear without inertia or loss: (1 + ratio) phi_carrier = phi_sun + ratio phi_ring.

    Torques: ring.tau = ratio sun.tau, carrier.tau = -(1 + ratio) sun.tau.

    Source: MSL Rotational.Components.IdealPlanetary.

    Args:
        ratio: teeth of the ring over teeth of the sun, above 0.
    """

    sun: Any
    """sun shaft"""
    carrier: Any
    """carrier shaft"""
    ring: Any
    """ring shaft"""
    ratio: Any
    """teeth of the ring over teeth of the sun, above 0"""
    def __init__(
        self,
        *,
        ratio: ParameterValue,
    ) -> None: ...

class Inertia(Component):
    """A turning body: J a = tau, w = der(phi), a = der(w).

    Source: MSL Rotational.Components.Inertia.

    Args:
        J: moment of inertia [kg.m2], above 0.
        phi: angle [rad], fixed start value.
        w: speed [rad/s], fixed start value.
        a: acceleration [rad/s2], fixed start value.
    """

    flange: Any
    """where it is joined"""
    J: Any
    """moment of inertia [kg.m2], above 0"""
    phi: Any
    """angle [rad], fixed start value"""
    w: Any
    """speed [rad/s], fixed start value"""
    a: Any
    """acceleration [rad/s2], fixed start value"""
    def __init__(
        self,
        *,
        J: ParameterValue,
        phi: Number = ...,
        w: Number = ...,
        a: Number = ...,
    ) -> None: ...

class TorqueSensor(Component):
    """Torque as a signal, between flanges that turn as one: tau = flange_a.tau.

    tau is positive where what is joined to flange_a turns flange_b forward.

    Source: MSL Rotational.Sensors.TorqueSensor.
    """

    flange_a: Any
    """left flange"""
    flange_b: Any
    """right flange"""
    tau: Any
    """torque from flange_a to flange_b [N.m]"""
    def __init__(self) -> None: ...

class TwoFlanges(Component):
    """Two flanges and the angle between them: phi_rel = flange_b.phi - flange_a.phi."""

    flange_a: Any
    """left flange"""
    flange_b: Any
    """right flange"""
    phi_rel: Any
    """angle between the flanges [rad], fixed start value"""
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

class Accelerate(_Driven):
    """A prescribed acceleration: der(w) = a_ref, from the start angle phi and speed w.

    Source: MSL Rotational.Sources.Accelerate.

    Args:
        a_ref: acceleration [rad/s2], a number, a function of time or Sampled data.
        phi: angle against the support [rad], fixed start value.
        w: speed against the support [rad/s], fixed start value.
    """

    a_ref: Any
    """acceleration [rad/s2], a number, a function of time or Sampled data"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    w: Any
    """speed against the support [rad/s], fixed start value"""
    def __init__(
        self,
        *,
        a_ref: SignalValue = ...,
        phi: Number = ...,
        w: Number = ...,
    ) -> None: ...

class AccelerationSensor(_Absolute):
    """Angular acceleration as a signal: a = der(w), w = der(flange.phi).

    Source: MSL Rotational.Sensors.AccSensor.

    Args:
        w: angular velocity [rad/s], fixed start value.
    """

    a: Any
    """angular acceleration [rad/s2]"""
    w: Any
    """angular velocity [rad/s], fixed start value"""
    def __init__(
        self,
        *,
        w: Number = ...,
    ) -> None: ...

class AngleSensor(_Absolute):
    """Angle as a signal: phi = flange.phi.

    Source: MSL Rotational.Sensors.AngleSensor.
    """

    phi: Any
    """angle [rad]"""
    def __init__(self) -> None: ...

class Compliant(TwoFlanges):
    """Two flanges without inertia between them: tau = flange_b.tau = -flange_a.tau."""

    tau: Any
    """torque between the flanges, positive when it turns b back towards a [N.m], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class ConstantTorque(_Driven):
    """A constant torque: flange.tau = -tau_constant.

    Source: MSL Rotational.Sources.ConstantTorque.

    Args:
        tau_constant: driving torque [N.m].
    """

    tau_constant: Any
    """driving torque [N.m]"""
    def __init__(
        self,
        *,
        tau_constant: ParameterValue,
    ) -> None: ...

class Disc(Inertia):
    """A homogeneous disc, solid or with a bore: J = pi rho l (r^4 - r_i^4) / 2.

    Example:
        >>> from inertance import rotational
        >>> disc = rotational.Disc(r=0.05, l=0.01, rho=7850.0)
        >>> round(disc.m, 4)
        0.6165

    Args:
        r: radius [m], above 0.
        l: thickness [m], above 0.
        rho: density [kg/m3], above 0.
        J: moment of inertia [kg.m2], above 0.
        r_i: radius of the bore [m], at least 0.
        phi: angle [rad], fixed start value.
        w: speed [rad/s], fixed start value.
        a: acceleration [rad/s2], fixed start value.
    """

    r: Any
    """radius [m], above 0"""
    r_i: Any
    """radius of the bore [m], at least 0"""
    l: Any
    """thickness [m], above 0"""
    rho: Any
    """density [kg/m3], above 0"""
    J: Any
    """moment of inertia [kg.m2], above 0"""
    @property
    def m(self) -> Any: ...
    def __init__(
        self,
        *,
        r: ParameterValue,
        l: ParameterValue,
        rho: ParameterValue,
        J: ParameterValue = ...,
        r_i: ParameterValue = 0.0,
        phi: Number = ...,
        w: Number = ...,
        a: Number = ...,
    ) -> None: ...

class LossyGear(Sticking):
    """A gearbox with mesh efficiency and bearing friction that truly sticks: phi_a = ratio phi_b.

    The mesh passes on tau_a - tau_loss: flange_b.tau = -ratio (flange_a.tau - tau_loss). Turning
    forward, tau_loss is the larger of
    (1 - eta1) tau_a + tau_bf1 (a drives b) and (1 - 1/eta2) tau_a + tau_bf2 (b drives a);
    turning backward, the same with both torques reversed. Stuck, it is whatever holds the gear,
    between these two at rest. Angles are taken against the support, which bears the rest of the torques.

    `lossTable` has rows (|w| [rad/s], eta1, eta2, tau_bf1 [N.m], tau_bf2 [N.m]) over the speed of
    flange_a: efficiencies above 0 up to 1, and bearing friction seen at flange_a, for either
    direction of power. In between it is interpolated, beyond its end it goes on straight.

    Source: C. Pelchen, C. Schweiger, M. Otter, Modeling and Simulating the Efficiency of Gearboxes
    and of Planetary Gearboxes, 2nd Modelica Conference (2002); MSL Rotational.Components.LossyGear.

    Args:
        ratio: turns of flange_a for one of flange_b, not 0.
        lossTable: rows (speed, eta1, eta2, tau_bf1, tau_bf2).
        phi: angle of flange_a against the support [rad], fixed start value.
        w: speed of flange_a against the support [rad/s], fixed start value.
        a: acceleration of flange_a against the support [rad/s2], fixed start value.
        tau_loss: torque lost, seen at flange_a [N.m], fixed start value.
    """

    flange_a: Any
    """left shaft"""
    flange_b: Any
    """right shaft"""
    support: Any
    """housing"""
    ratio: Any
    """turns of flange_a for one of flange_b, not 0"""
    lossTable: Any
    """rows (speed, eta1, eta2, tau_bf1, tau_bf2)"""
    driver: Any
    """the side that drives the mesh"""
    phi: Any
    """angle of flange_a against the support [rad], fixed start value"""
    w: Any
    """speed of flange_a against the support [rad/s], fixed start value"""
    a: Any
    """acceleration of flange_a against the support [rad/s2], fixed start value"""
    tau_loss: Any
    """torque lost, seen at flange_a [N.m], fixed start value"""
    quantities: Any
    def losses(self, torque: Any, speed: Any) -> Any: ...
    @property
    def limits(self) -> Any: ...
    def __init__(
        self,
        *,
        ratio: ParameterValue,
        lossTable: Any = ...,
        phi: Number = ...,
        w: Number = ...,
        a: Number = ...,
        tau_loss: Number = ...,
    ) -> None: ...

class RelativeAngleSensor(TwoFlanges):
    """Angle between two flanges as a signal: phi_rel = flange_b.phi - flange_a.phi.

    Source: MSL Rotational.Sensors.RelAngleSensor.
    """

    phi_rel: Any
    """angle between the flanges [rad]"""
    def __init__(self) -> None: ...

class SpeedSensor(_Absolute):
    """Angular velocity as a signal: w = der(flange.phi).

    Source: MSL Rotational.Sensors.SpeedSensor.
    """

    w: Any
    """angular velocity [rad/s]"""
    def __init__(self) -> None: ...

class Torque(_Driven):
    """A torque that acts on a flange: flange.tau = -tau, so positive tau accelerates it.

    Source: MSL Rotational.Sources.Torque.

    Args:
        tau: driving torque [N.m], a number, a function of time or Sampled data.
    """

    tau: Any
    """driving torque [N.m], a number, a function of time or Sampled data"""
    def __init__(
        self,
        *,
        tau: SignalValue = ...,
    ) -> None: ...

class _Discs(Pressed):
    cgeo: Any
    """mean friction radius times number of friction faces [m], above 0"""
    def __init__(self, **values: Any) -> None: ...

class ArmGravity(Compliant):
    """Gravity on an arm that turns against the ground: tau = tau_sin sin(phi_rel) + tau_cos cos(phi_rel).

    An arm of mass m whose centre is at the distance r from its axis, phi_rel counted from where it hangs, has
    tau_sin = m g r; counted from the horizontal, tau_cos = m g r.

    Args:
        tau_sin: torque a quarter of a turn from phi_rel = 0 [N.m].
        tau_cos: torque at phi_rel = 0 [N.m].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    tau_sin: Any
    """torque a quarter of a turn from phi_rel = 0 [N.m]"""
    tau_cos: Any
    """torque at phi_rel = 0 [N.m]"""
    def __init__(
        self,
        *,
        tau_sin: ParameterValue = 0.0,
        tau_cos: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class BilinearSpring(Compliant):
    """Spring that is stiffer one way: tau = c_pull e for e > 0 and c_push e for e < 0.

    e = phi_rel - phi_rel0.

    Args:
        c_pull: stiffness when pulled [N.m/rad], at least 0.
        c_push: stiffness when pushed [N.m/rad], at least 0.
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    c_pull: Any
    """stiffness when pulled [N.m/rad], at least 0"""
    c_push: Any
    """stiffness when pushed [N.m/rad], at least 0"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    def __init__(
        self,
        *,
        c_pull: ParameterValue,
        c_push: ParameterValue,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class CompliantWithSpeed(Compliant):
    """A compliant element whose law uses the relative speed w_rel = der(phi_rel)."""

    w_rel: Any
    """relative speed of the flanges [rad/s], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class CubicSpring(Compliant):
    """Spring with a cubic term: tau = c e + c3 e^3 with e = phi_rel - phi_rel0.

    Args:
        c: linear stiffness [N.m/rad], at least 0.
        c3: cubic stiffness; negative softens [N.m/rad3].
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    c: Any
    """linear stiffness [N.m/rad], at least 0"""
    c3: Any
    """cubic stiffness; negative softens [N.m/rad3]"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        c3: ParameterValue,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class HarmonicRipple(Compliant):
    """Torque that comes back with every period, as a sum of three harmonics.

    tau = sum over h = 1, 2, 3 of tau_sin_h sin(h x) + tau_cos_h cos(h x), x = 2 pi phi_rel/period; `tau_sin`
    and `tau_cos` are those of h = 1.

    Source: E. Favre, L. Cardoletti, M. Jufer, IEEE Trans. Ind. Appl. 29 (1993) 1141, on motors.

    Args:
        tau_sin: amplitude of the sine [N.m].
        period: angle after which the torque comes back [rad], above 0.
        tau_cos: amplitude of the cosine [N.m].
        tau_sin_2: amplitude of the sine of half the period [N.m].
        tau_cos_2: amplitude of the cosine of half the period [N.m].
        tau_sin_3: amplitude of the sine of a third of the period [N.m].
        tau_cos_3: amplitude of the cosine of a third of the period [N.m].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    tau_sin: Any
    """amplitude of the sine [N.m]"""
    tau_cos: Any
    """amplitude of the cosine [N.m]"""
    tau_sin_2: Any
    """amplitude of the sine of half the period [N.m]"""
    tau_cos_2: Any
    """amplitude of the cosine of half the period [N.m]"""
    tau_sin_3: Any
    """amplitude of the sine of a third of the period [N.m]"""
    tau_cos_3: Any
    """amplitude of the cosine of a third of the period [N.m]"""
    period: Any
    """angle after which the torque comes back [rad], above 0"""
    def __init__(
        self,
        *,
        tau_sin: ParameterValue,
        period: ParameterValue,
        tau_cos: ParameterValue = 0.0,
        tau_sin_2: ParameterValue = 0.0,
        tau_cos_2: ParameterValue = 0.0,
        tau_sin_3: ParameterValue = 0.0,
        tau_cos_3: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class Position(Filtered, _Driven):
    """A prescribed angle: flange.phi - support.phi = phi_ref. Its speed and acceleration follow.

    Where phi_ref bends or jumps, what that takes acts as a shock, whose impulse is an event of the run; a
    jump that takes infinite forces is refused. With `exact=False` a Bessel filter of order 2 follows
    phi_ref: der(w) = ((phi_ref - phi) o - 1.3617 w) o/0.6180 with w = der(phi), o = 2 pi f_crit, from
    phi = phi_ref at rest; lead = phi + w/o.

    Source: MSL Rotational.Sources.Position.

    Args:
        exact: whether the reference is followed exactly; else by a filter, which knows no shocks.
        f_crit: critical frequency of the filter with exact=False [Hz], above 0.
        phi_ref: angle [rad], a number, a function of time or Sampled data.
        phi: angle against the support [rad], fixed start value.
        lead: angle ahead, by which the filter moves [rad], fixed start value.
    """

    phi_ref: Any
    """angle [rad], a number, a function of time or Sampled data"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    lead: Any
    """angle ahead, by which the filter moves [rad], fixed start value"""
    def __init__(
        self,
        *,
        exact: bool = True,
        f_crit: ParameterValue = 50.0,
        phi_ref: SignalValue = ...,
        phi: Number = ...,
        lead: Number = ...,
    ) -> None: ...

class RelativeSpeedSensor(RelativeAngleSensor):
    """Relative angular velocity as a signal: w_rel = der(phi_rel).

    Source: MSL Rotational.Sensors.RelSpeedSensor.
    """

    w_rel: Any
    """relative angular velocity [rad/s]"""
    def __init__(self) -> None: ...

class Ripple(Compliant):
    """Torque that comes back with every period: tau = tau_sin sin(2 pi phi_rel/period) + tau_cos cos(...).

    Args:
        tau_sin: amplitude of the sine [N.m].
        period: angle after which the torque comes back [rad], above 0.
        tau_cos: amplitude of the cosine [N.m].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    tau_sin: Any
    """amplitude of the sine [N.m]"""
    tau_cos: Any
    """amplitude of the cosine [N.m]"""
    period: Any
    """angle after which the torque comes back [rad], above 0"""
    def __init__(
        self,
        *,
        tau_sin: ParameterValue,
        period: ParameterValue,
        tau_cos: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class Speed(Filtered, _Driven):
    """A prescribed speed: der(phi) = w_ref, from the start angle phi.

    Where w_ref jumps, what that takes acts as a shock, whose impulse is an event of the run. With
    `exact=False` a filter of order 1 follows w_ref: der(w) = 2 pi f_crit (w_ref - w), from w = w_ref.

    Source: MSL Rotational.Sources.Speed.

    Args:
        exact: whether the reference is followed exactly; else by a filter, which knows no shocks.
        f_crit: critical frequency of the filter with exact=False [Hz], above 0.
        w_ref: speed [rad/s], a number, a function of time or Sampled data.
        phi: angle against the support [rad], fixed start value.
        w: speed against the support [rad/s], fixed start value.
    """

    w_ref: Any
    """speed [rad/s], a number, a function of time or Sampled data"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    w: Any
    """speed against the support [rad/s], fixed start value"""
    def __init__(
        self,
        *,
        exact: bool = True,
        f_crit: ParameterValue = 50.0,
        w_ref: SignalValue = ...,
        phi: Number = ...,
        w: Number = ...,
    ) -> None: ...

class Spring(Compliant):
    """Linear spring: tau = c (phi_rel - phi_rel0).

    Source: MSL Rotational.Components.Spring.

    Args:
        c: stiffness [N.m/rad], at least 0.
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    c: Any
    """stiffness [N.m/rad], at least 0"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class BoucWen(CompliantWithSpeed):
    """Hysteretic spring: tau = alpha c phi_rel + (1 - alpha) c z.

    z' = A w_rel - beta |w_rel| |z|^(n-1) z - gamma w_rel |z|^n, with z [rad] the hysteretic angle.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263, written for turning.

    Args:
        c: initial stiffness [N.m/rad], at least 0.
        beta: loop shape against the motion [1/rad^n], at least 0.
        gamma: loop shape along the motion [1/rad^n].
        alpha: share of stiffness after yield, at least 0, at most 1.
        A: scale of the hysteretic angle, above 0.
        n: sharpness of yield, at least 1.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        z: hysteretic angle [rad], fixed start value.
    """

    c: Any
    """initial stiffness [N.m/rad], at least 0"""
    alpha: Any
    """share of stiffness after yield, at least 0, at most 1"""
    A: Any
    """scale of the hysteretic angle, above 0"""
    beta: Any
    """loop shape against the motion [1/rad^n], at least 0"""
    gamma: Any
    """loop shape along the motion [1/rad^n]"""
    n: Any
    """sharpness of yield, at least 1"""
    z: Any
    """hysteretic angle [rad], fixed start value"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        beta: ParameterValue,
        gamma: ParameterValue,
        alpha: ParameterValue = 0.1,
        A: ParameterValue = 1.0,
        n: ParameterValue = 2.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class CubicDamper(CompliantWithSpeed):
    """Damper with torque growing with the cube of speed: tau = d3 w_rel^3.

    Args:
        d3: cubic damping constant [N.m.s3/rad3], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    d3: Any
    """cubic damping constant [N.m.s3/rad3], at least 0"""
    def __init__(
        self,
        *,
        d3: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class DahlFriction(CompliantWithSpeed):
    """Dry friction that builds up elastically before it slips: tau = tau_c z.

    phi_p z' = w_rel - |w_rel| z: the share z of tau_c grows by angle/phi_p at first, and comes within
    1/e of its end over phi_p. It knows no events, and creeps under a load that changes.

    Source: P. R. Dahl, AIAA Journal 14 (1976) 1675-1682, with the exponent 1.

    Args:
        tau_c: friction torque once it slips [N.m], at least 0.
        phi_p: presliding angle [rad], above 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        z: share of the friction torque that has built up, fixed start value.
    """

    tau_c: Any
    """friction torque once it slips [N.m], at least 0"""
    phi_p: Any
    """presliding angle [rad], above 0"""
    z: Any
    """share of the friction torque that has built up, fixed start value"""
    def __init__(
        self,
        *,
        tau_c: ParameterValue,
        phi_p: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Damper(CompliantWithSpeed):
    """Linear damper: tau = d w_rel.

    Source: MSL Rotational.Components.Damper.

    Args:
        d: damping constant [N.m.s/rad], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    d: Any
    """damping constant [N.m.s/rad], at least 0"""
    def __init__(
        self,
        *,
        d: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class ElastoBacklash(CompliantWithSpeed):
    """Backlash b between elastic flanks that only ever press.

    With x = phi_rel - phi_rel0 and the spring torque tau_c = c max(|x| - b/2, 0) of the flank in
    contact, tau = sgn(x) max(tau_c + min(tau_c, sgn(x) d w_rel), 0): damping adds at most tau_c as
    the flank is pressed, and takes away at most tau_c as it is released, so tau is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, whose law with b = 0 is the plain spring and
    damper instead.

    Args:
        c: stiffness in contact [N.m/rad], above 0.
        d: damping constant in contact [N.m.s/rad], at least 0.
        b: total backlash [rad], at least 0.
        phi_rel0: angle in the middle of the backlash [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    c: Any
    """stiffness in contact [N.m/rad], above 0"""
    d: Any
    """damping constant in contact [N.m.s/rad], at least 0"""
    b: Any
    """total backlash [rad], at least 0"""
    phi_rel0: Any
    """angle in the middle of the backlash [rad]"""
    def pressed(self, depth: Any, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        d: ParameterValue,
        b: ParameterValue = 0.0,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class Inerter(CompliantWithSpeed):
    """A flywheel between two shafts that feels their relative motion only: tau = J a_rel.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, section II.

    Args:
        J: rotational inertance [kg.m2], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    J: Any
    """rotational inertance [kg.m2], at least 0"""
    a_rel: Any
    """relative acceleration of the flanges [rad/s2], fixed start value"""
    def __init__(
        self,
        *,
        J: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class QuadraticDamper(CompliantWithSpeed):
    """Damper with torque growing with the square of speed (a fan): tau = k w_rel |w_rel|.

    Args:
        k: quadratic damping constant [N.m.s2/rad2], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    k: Any
    """quadratic damping constant [N.m.s2/rad2], at least 0"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class RelativeAccelerationSensor(RelativeSpeedSensor):
    """Relative angular acceleration as a signal: a_rel = der(w_rel).

    Source: MSL Rotational.Sensors.RelAccSensor.
    """

    a_rel: Any
    """relative angular acceleration [rad/s2]"""
    def __init__(self) -> None: ...

class ShearThinningDamper(CompliantWithSpeed):
    """Damper whose oil thins where it is sheared fast: tau = d w_e asinh(w_rel/w_e).

    Viscous at speeds far below w_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.

    Args:
        d: damping constant at rest [N.m.s/rad], at least 0.
        w_e: speed above which the oil thins [rad/s], above 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    d: Any
    """damping constant at rest [N.m.s/rad], at least 0"""
    w_e: Any
    """speed above which the oil thins [rad/s], above 0"""
    def __init__(
        self,
        *,
        d: ParameterValue,
        w_e: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class SpringDamper(CompliantWithSpeed):
    """Linear spring and damper in parallel: tau = c (phi_rel - phi_rel0) + d w_rel.

    Source: MSL Rotational.Components.SpringDamper.

    Args:
        c: stiffness [N.m/rad], at least 0.
        d: damping constant [N.m.s/rad], at least 0.
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    c: Any
    """stiffness [N.m/rad], at least 0"""
    d: Any
    """damping constant [N.m.s/rad], at least 0"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        d: ParameterValue,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class VariableDamper(CompliantWithSpeed):
    """Damper whose constant follows a signal: tau = (d + d_u u) w_rel.

    Args:
        d_u: change of the damping constant with u [N.m.s/rad].
        u: what the damping follows, a number, a function of time or Sampled data.
        d: damping constant at u = 0 [N.m.s/rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    u: Any
    """what the damping follows, a number, a function of time or Sampled data"""
    d: Any
    """damping constant at u = 0 [N.m.s/rad]"""
    d_u: Any
    """change of the damping constant with u [N.m.s/rad]"""
    def __init__(
        self,
        *,
        d_u: ParameterValue,
        u: SignalValue = ...,
        d: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class Friction(Compliant, StickSlip):
    """Two shafts that rub on each other; subclasses say how much in `sliding(speed)`."""

    phi_rel: Any
    """angle between the flanges [rad], fixed start value"""
    w_rel: Any
    """relative speed of the flanges [rad/s], fixed start value"""
    a_rel: Any
    """relative acceleration of the flanges [rad/s2], fixed start value"""
    quantities: Any
    def __init__(self, **values: Any) -> None: ...

class Jenkins(CompliantWithSpeed, ElastoPlastic):
    """A spring in series with dry friction, without inertia between them: tau = c z, |tau| <= tau_c.

    z' = w_rel while it sticks, z' = 0 while it slips at |tau| = tau_c.

    Source: G. M. Jenkins, Analysis of the stress-strain relationships in reactor grade graphite, British
    Journal of Applied Physics 13 (1962) 30-32, written for turning.

    Args:
        c: stiffness of the spring [N.m/rad], above 0.
        tau_c: Coulomb friction torque [N.m], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        z: twist of the spring [rad], fixed start value.
    """

    c: Any
    """stiffness of the spring [N.m/rad], above 0"""
    tau_c: Any
    """Coulomb friction torque [N.m], at least 0"""
    z: Any
    """twist of the spring [rad], fixed start value"""
    @property
    def speed(self) -> Any: ...
    @property
    def slip_stretch(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        tau_c: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class OneWayClutch(Compliant, _Discs):
    """A freewheel and a clutch in parallel: flange_b may run ahead of flange_a, never fall behind.

    w_rel >= 0; tau = mu(w_rel) cgeo fn while b runs ahead, fn = fn_max max(f_normalized, 0). Stuck,
    tau is whatever keeps w_rel = 0: as negative as it takes, up to peak mu(0) cgeo fn above zero.
    Falling behind at once (a blow, a start value) is stopped by the impulse J.

    Limits: to be free of chatter, break-away takes 1e-4 of the fully pressed clutch's even when the
    signal is zero, and exceeds sliding by as much.

    Source: MSL Rotational.Components.OneWayClutch.

    Args:
        fn_max: largest normal force [N], at least 0.
        f_normalized: normal force over its largest value, a number, a function of time or Sampled data.
        mu_pos: rows (speed, friction coefficient), speeds increasing from 0.
        cgeo: mean friction radius times number of friction faces [m], above 0.
        peak: break-away torque over sliding torque at rest, at least 1.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    peak: Any
    """break-away torque over sliding torque at rest, at least 1"""
    mode: Any
    """locked or running ahead"""
    J: Any
    """impulse of a shock, positive when it turns flange_b ahead [N.m.s]"""
    phi_rel: Any
    """angle between the flanges [rad], fixed start value"""
    w_rel: Any
    """relative speed of the flanges [rad/s], fixed start value"""
    a_rel: Any
    """relative acceleration of the flanges [rad/s2], fixed start value"""
    least: Any
    @property
    def breakaway(self) -> Any: ...
    def __init__(
        self,
        *,
        fn_max: ParameterValue,
        f_normalized: SignalValue = ...,
        mu_pos: Any = ...,
        cgeo: ParameterValue = 1.0,
        peak: ParameterValue = 1.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    tau = tau_forward for w_rel > 0 and -tau_backward for w_rel < 0.
    While stuck, -peak tau_backward <= tau <= peak tau_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.

    Args:
        tau_forward: friction torque while the angle grows [N.m], at least 0.
        tau_backward: friction torque while it shrinks [N.m], at least 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_forward: Any
    """friction torque while the angle grows [N.m], at least 0"""
    tau_backward: Any
    """friction torque while it shrinks [N.m], at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def sliding_back(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_forward: ParameterValue,
        tau_backward: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class Brake(_Discs, PressedStickSlip):
    """A shaft held by friction on a support: tau = mu(|w|) cgeo fn against w while sliding.

    fn = fn_max max(f_normalized, 0); |tau| <= peak mu(0) cgeo fn while stuck; free when fn = 0.
    The support, which takes -tau, is the ground when left unconnected.

    Source: MSL Rotational.Components.Brake.

    Args:
        fn_max: largest normal force [N], at least 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        f_normalized: normal force over its largest value, a number, a function of time or Sampled data.
        mu_pos: rows (speed, friction coefficient), speeds increasing from 0.
        cgeo: mean friction radius times number of friction faces [m], above 0.
        phi: angle against the support [rad], fixed start value.
        w: speed against the support [rad/s], fixed start value.
        a: acceleration against the support [rad/s2], fixed start value.
        tau: braking torque, positive against positive speed [N.m], fixed start value.
    """

    flange: Any
    """shaft"""
    support: Any
    """housing"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    w: Any
    """speed against the support [rad/s], fixed start value"""
    a: Any
    """acceleration against the support [rad/s2], fixed start value"""
    tau: Any
    """braking torque, positive against positive speed [N.m], fixed start value"""
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
        phi: Number = ...,
        w: Number = ...,
        a: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class CoulombFriction(Friction):
    """Coulomb friction: tau = tau_c sgn(w_rel) while sliding, |tau| <= peak tau_c while stuck.

    Source: C. A. Coulomb, Theorie des machines simples (1785).

    Args:
        tau_c: Coulomb friction torque [N.m], at least 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_c: Any
    """Coulomb friction torque [N.m], at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_c: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class DriftingFriction(Friction):
    """Friction whose level follows a signal: tau = (tau_c + tau_u u) sgn(w_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. With `regularised` the level may
    be negative, so that it stands for what a drift adds to, or takes from, friction that is there.

    Args:
        tau_u: change of friction torque with u [N.m].
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        u: what the level follows, a number, a function of time or Sampled data.
        tau_c: friction torque at u = 0 [N.m].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    u: Any
    """what the level follows, a number, a function of time or Sampled data"""
    tau_c: Any
    """friction torque at u = 0 [N.m]"""
    tau_u: Any
    """change of friction torque with u [N.m]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_u: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        u: SignalValue = ...,
        tau_c: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class LoadedFriction(Friction):
    """Friction in proportion to a load: tau = mu |load| sgn(w_rel) while sliding.

    While stuck, |tau| <= peak mu |load|.

    Example:
        >>> from inertance import rotational
        >>> seal = rotational.LoadedFriction(mu=0.02)  # connect a TorqueSensor's torque to seal.load

    Args:
        mu: friction torque over load, at least 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        load: torque that presses the surfaces together [N.m], a number, a function of time or Sampled data.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    load: Any
    """torque that presses the surfaces together [N.m], a number, a function of time or Sampled data"""
    mu: Any
    """friction torque over load, at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        mu: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        load: SignalValue = ...,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class PositionDependentFriction(Friction):
    """Dry friction whose level depends on where it slides: tau = (tau_c + tau_1 e + tau_2 e^2) sgn(w_rel).

    e = phi_rel - phi_rel0. With `regularised` the level may be negative, so that it stands for what is added
    to, or taken from, friction that is there.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991).

    Args:
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        tau_c: friction torque at phi_rel0 [N.m].
        tau_1: slope of the friction torque at phi_rel0 [N.m/rad].
        tau_2: half of its curvature [N.m/rad2].
        phi_rel0: angle at which the level is tau_c [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_c: Any
    """friction torque at phi_rel0 [N.m]"""
    tau_1: Any
    """slope of the friction torque at phi_rel0 [N.m/rad]"""
    tau_2: Any
    """half of its curvature [N.m/rad2]"""
    phi_rel0: Any
    """angle at which the level is tau_c [rad]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        tau_c: ParameterValue = 0.0,
        tau_1: ParameterValue = 0.0,
        tau_2: ParameterValue = 0.0,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class StribeckFriction(Friction):
    """Coulomb, Stribeck and viscous friction.

    tau = [tau_c + (tau_s - tau_c) exp(-|w_rel|/w_s)] sgn(w_rel) + d w_rel while sliding;
    |tau| <= peak tau_s while stuck.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (26).

    Args:
        tau_c: Coulomb friction torque [N.m], at least 0.
        tau_s: static friction torque [N.m], at least 0.
        w_s: Stribeck speed [rad/s], above 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        d: viscous friction [N.m.s/rad], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_c: Any
    """Coulomb friction torque [N.m], at least 0"""
    tau_s: Any
    """static friction torque [N.m], at least 0"""
    w_s: Any
    """Stribeck speed [rad/s], above 0"""
    d: Any
    """viscous friction [N.m.s/rad], at least 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_c: ParameterValue,
        tau_s: ParameterValue,
        w_s: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        d: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class TabulatedFriction(Friction):
    """Friction torque interpolated linearly over speed: |tau| = tau_pos(|w_rel|) while sliding.

    |tau| <= peak tau_pos(0) while stuck; beyond its end the table goes on straight.

    Source: MSL Rotational.Components.BearingFriction.

    Args:
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        tau_pos: rows (speed [rad/s], torque [N.m]), speeds increasing from 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_pos: Any
    """rows (speed [rad/s], torque [N.m]), speeds increasing from 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        tau_pos: Any = ...,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class Clutch(Friction, _Discs, PressedStickSlip):
    """Two shafts joined by friction: tau = mu(|w_rel|) cgeo fn against w_rel while sliding.

    fn = fn_max max(f_normalized, 0); |tau| <= peak mu(0) cgeo fn while stuck; free when fn = 0.

    Source: MSL Rotational.Components.Clutch.

    Args:
        fn_max: largest normal force [N], at least 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        f_normalized: normal force over its largest value, a number, a function of time or Sampled data.
        mu_pos: rows (speed, friction coefficient), speeds increasing from 0.
        cgeo: mean friction radius times number of friction faces [m], above 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    def __init__(
        self,
        *,
        fn_max: ParameterValue,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        f_normalized: SignalValue = ...,
        mu_pos: Any = ...,
        cgeo: ParameterValue = 1.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...
