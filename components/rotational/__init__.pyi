"""Elements that turn."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any, Literal

import numpy as np

from ..bars import Bar, LumpedBar, ModalBar
from ..bristles import Bristles
from ..elastoplastic import ElastoPlastic
from ..filtered import Filtered
from ..flanks import SlidingFlanks
from ..hysteresis import HystereticSpring
from ..iwan import IwanCells
from ..language import Component, Number, ParameterValue, SignalValue
from ..lossy import AtTemperature, Lossy
from ..pressed import Pressed, PressedStickSlip
from ..relaxing import Relaxing
from ..relaxing_flanks import RelaxingFlanks
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

class Differential(Component):
    """Open differential: phi = ratio (phi_left + phi_right)/2, both shafts under the same torque.

    left.tau = right.tau = -ratio flange.tau/2; the support takes what is left of their sum. A friction
    element between left and right makes it one of limited slip.

    Args:
        ratio: turns of the pinion for one of the cage, not 0.
    """

    flange: Any
    """pinion"""
    left: Any
    """left shaft"""
    right: Any
    """right shaft"""
    support: Any
    """housing"""
    ratio: Any
    """turns of the pinion for one of the cage, not 0"""
    def __init__(
        self,
        *,
        ratio: ParameterValue = 1.0,
    ) -> None: ...

class DrivenFlange(Component):
    """A flange that is driven, and the support that takes the reaction."""

    flange: Any
    """what is driven"""
    support: Any
    """what reacts"""
    def __init__(self, **values: Any) -> None: ...

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

class Gearbox(Component):
    """A `LossyGear` whose output shaft is elastic and has backlash: an `ElastoBacklash` after it.

    phi_rel is the angle of flange_b ahead of the gear's own output. There is no inertia in it.

    Source: MSL Rotational.Components.Gearbox.

    Args:
        ratio: turns of flange_a for one of flange_b, not 0.
        c: stiffness [N.m/rad], above 0.
        d: damping constant [N.m.s/rad], at least 0.
        lossTable: rows (speed, eta1, eta2, tau_bf1, tau_bf2).
        b: total backlash [rad], at least 0.
        elastoBacklash: ElastoBacklash.
        phi_rel: angle over the elastic shaft [rad], fixed start value.
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
    c: Any
    """stiffness [N.m/rad], above 0"""
    d: Any
    """damping constant [N.m.s/rad], at least 0"""
    b: Any
    """total backlash [rad], at least 0"""
    phi_rel: Any
    """angle over the elastic shaft [rad], fixed start value"""
    elastoBacklash: Any
    """ElastoBacklash"""
    def __init__(
        self,
        *,
        ratio: ParameterValue,
        c: ParameterValue,
        d: ParameterValue,
        lossTable: Any = ...,
        b: ParameterValue = 0.0,
        elastoBacklash: Component = ...,
        phi_rel: Number = ...,
        **parts: Component,
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
    kinetic: Any
    """stored energy [J]"""
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

class UniversalJoint(Component):
    """Joint of Cardan and Hooke between shafts at an angle: tan(phi_a) = cos(beta) tan(phi_b), no loss.

    phi_a is taken from where the fork of shaft a lies in the plane of both shafts. Power is kept, so that
    tau_b = -tau_a/(dphi_b/dphi_a); what their difference takes, the bearings bear.

    Source: R. Willis, Principles of Mechanism (1841).

    Args:
        beta: angle between the shafts [rad], at least -1.5, at most 1.5.
    """

    flange_a: Any
    """driving shaft"""
    flange_b: Any
    """driven shaft"""
    beta: Any
    """angle between the shafts [rad], at least -1.5, at most 1.5"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        beta: ParameterValue,
    ) -> None: ...

class _Absolute(Component):
    flange: Any
    """where it is measured"""
    def __init__(self, **values: Any) -> None: ...

class Accelerate(DrivenFlange):
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

class BeltDrive(Lossy):
    """Belt or chain over two pulleys, whose strands pull and never push.

    A strand stretched by e + e_0 pulls with k (e + e_0), and damps with d e', never more than it pulls; one
    with e + e_0 < 0 is slack. e = r_a phi_a - r_b phi_b in one strand and -e in the other. e_0 > 0 is a belt
    put up with tension, e_0 < 0 a chain that hangs slack. flange_a.tau = r_a (f_1 - f_2), flange_b.tau =
    -r_b (f_1 - f_2).

    Limits: no slip on the pulleys, no mass.

    Args:
        r_a: radius of pulley a [m], above 0.
        r_b: radius of pulley b [m], above 0.
        k: stiffness of a strand [N/m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        d: damping constant of a strand [N.s/m], at least 0.
        e_0: stretch of the strands at rest; negative: slack [m].
        e: stretch that turning adds to a strand [m], fixed start value.
        v: its rate [m/s], fixed start value.
        f_1: force of the strand that pulls as a drives forward [N], fixed start value.
        f_2: force of the other strand [N], fixed start value.
    """

    flange_a: Any
    """pulley a"""
    flange_b: Any
    """pulley b"""
    support: Any
    """what carries the pulleys"""
    r_a: Any
    """radius of pulley a [m], above 0"""
    r_b: Any
    """radius of pulley b [m], above 0"""
    k: Any
    """stiffness of a strand [N/m], above 0"""
    d: Any
    """damping constant of a strand [N.s/m], at least 0"""
    e_0: Any
    """stretch of the strands at rest; negative: slack [m]"""
    e: Any
    """stretch that turning adds to a strand [m], fixed start value"""
    v: Any
    """its rate [m/s], fixed start value"""
    f_1: Any
    """force of the strand that pulls as a drives forward [N], fixed start value"""
    f_2: Any
    """force of the other strand [N], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def springs(self) -> Any: ...
    @property
    def damping(self) -> Any: ...
    def __init__(
        self,
        *,
        r_a: ParameterValue,
        r_b: ParameterValue,
        k: ParameterValue,
        useHeatPort: bool = False,
        d: ParameterValue = 0.0,
        e_0: ParameterValue = 0.0,
        e: Number = ...,
        v: Number = ...,
        f_1: Number = ...,
        f_2: Number = ...,
    ) -> None: ...

class Compliant(TwoFlanges):
    """Two flanges without inertia between them: tau = flange_b.tau = -flange_a.tau."""

    tau: Any
    """torque between the flanges, positive when it turns b back towards a [N.m], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class ConstantSpeed(DrivenFlange):
    """A constant speed, exactly: der(phi) = w_fixed, from the start angle phi.

    Source: MSL Rotational.Sources.ConstantSpeed.

    Args:
        w_fixed: speed [rad/s].
        phi: angle against the support [rad], fixed start value.
    """

    w_fixed: Any
    """speed [rad/s]"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    def __init__(
        self,
        *,
        w_fixed: ParameterValue,
        phi: Number = ...,
    ) -> None: ...

class ConstantTorque(DrivenFlange):
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

class DCMotor(Lossy):
    """Motor with permanent magnets behind an amplifier: L i' = v - R i - k w, torque k i on the shaft.

    v is u between -u_max and u_max. At |i| = i_max the amplifier chops the voltage, so that the current stays
    there until it would fall by itself.

    Limits: the amplifier takes back what the motor generates; no friction, no inertia, no cogging.

    Args:
        k: torque constant, and that of the induced voltage [N.m/A], not 0.
        R: resistance [V/A], above 0.
        L: inductance [V.s/A], above 0.
        u_max: largest voltage [V], above 0.
        i_max: largest current [A], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        u: voltage wanted [V], a number, a function of time or Sampled data.
        i: current [A], fixed start value.
        w: speed of the shaft against the housing [rad/s], fixed start value.
        phi: angle of the shaft against the housing [rad], fixed start value.
        excess: voltage that would change the current [V], fixed start value.
    """

    flange: Any
    """shaft"""
    support: Any
    """housing"""
    u: Any
    """voltage wanted [V], a number, a function of time or Sampled data"""
    k: Any
    """torque constant, and that of the induced voltage [N.m/A], not 0"""
    R: Any
    """resistance [V/A], above 0"""
    L: Any
    """inductance [V.s/A], above 0"""
    u_max: Any
    """largest voltage [V], above 0"""
    i_max: Any
    """largest current [A], above 0"""
    limit: Any
    """whether the current is limited, and which way"""
    i: Any
    """current [A], fixed start value"""
    w: Any
    """speed of the shaft against the housing [rad/s], fixed start value"""
    phi: Any
    """angle of the shaft against the housing [rad], fixed start value"""
    excess: Any
    """voltage that would change the current [V], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    supplyPower: Any
    """power that comes in otherwise than through flanges [W]"""
    @property
    def induced(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        R: ParameterValue,
        L: ParameterValue,
        u_max: ParameterValue,
        i_max: ParameterValue,
        useHeatPort: bool = False,
        u: SignalValue = ...,
        i: Number = ...,
        w: Number = ...,
        phi: Number = ...,
        excess: Number = ...,
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

class GearMesh(Lossy):
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
        useHeatPort: whether its losses leave as heat through heatPort.
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
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def elastic(self) -> Any: ...
    def __init__(
        self,
        *,
        r_a: ParameterValue,
        r_b: ParameterValue,
        k: ParameterValue,
        useHeatPort: bool = False,
        d: ParameterValue = 0.0,
        g: ParameterValue = 0.0,
        internal: bool = False,
        s_rel: Number = ...,
        v_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class HarmonicDrive(Lossy):
    """Harmonic drive: its flexspline turns back once for `ratio` turns of the wave generator, and winds up.

    tau = c x + c3 x^3 + d x' with the twist x = -phi_a/ratio + e(phi_a) - phi_b, angles against the circular
    spline, and a kinematic error e = e_1 sin(2 phi_a + phase), two waves a turn. flange_b.tau = -tau and
    flange_a.tau = tau dx/dphi_a. Put friction beside it, on the wave generator.

    Source: T. D. Tuttle, W. P. Seering, A nonlinear model of a harmonic drive gear transmission, IEEE Trans.
    Robot. Autom. 12 (1996) 368-374.

    Args:
        ratio: turns of the wave generator for one of the flexspline, above 0.
        c: stiffness of the flexspline [N.m/rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        c3: its stiffening [N.m/rad3], at least 0.
        d: damping constant [N.m.s/rad], at least 0.
        e_1: amplitude of the kinematic error, at the flexspline [rad], at least 0.
        phase: phase of the kinematic error [rad].
        x: twist of the flexspline [rad], fixed start value.
        w_rel: its rate [rad/s], fixed start value.
    """

    flange_a: Any
    """wave generator"""
    flange_b: Any
    """flexspline"""
    support: Any
    """circular spline"""
    ratio: Any
    """turns of the wave generator for one of the flexspline, above 0"""
    c: Any
    """stiffness of the flexspline [N.m/rad], above 0"""
    c3: Any
    """its stiffening [N.m/rad3], at least 0"""
    d: Any
    """damping constant [N.m.s/rad], at least 0"""
    e_1: Any
    """amplitude of the kinematic error, at the flexspline [rad], at least 0"""
    phase: Any
    """phase of the kinematic error [rad]"""
    x: Any
    """twist of the flexspline [rad], fixed start value"""
    w_rel: Any
    """its rate [rad/s], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        ratio: ParameterValue,
        c: ParameterValue,
        useHeatPort: bool = False,
        c3: ParameterValue = 0.0,
        d: ParameterValue = 0.0,
        e_1: ParameterValue = 0.0,
        phase: ParameterValue = 0.0,
        x: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class Move(DrivenFlange):
    """A motion that is given with its rates: phi_ref, w_ref and a_ref, which must fit each other.

    der(w) = a_ref + 2 o (w_ref - w) + o^2 (phi_ref - phi) with w = der(phi), o = 2 pi f_crit, from
    phi_ref and w_ref. No derivative of a signal is needed; where they fit each other, it follows exactly.

    Source: MSL Rotational.Sources.Move, which takes one vector u.

    Args:
        phi_ref: angle [rad], a number, a function of time or Sampled data.
        w_ref: speed, the rate of phi_ref [rad/s], a number, a function of time or Sampled data.
        a_ref: acceleration, the rate of w_ref [rad/s2], a number, a function of time or Sampled data.
        f_crit: frequency with which it is held on phi_ref [Hz], above 0.
        phi: angle against the support [rad], fixed start value.
        w: speed against the support [rad/s], fixed start value.
    """

    phi_ref: Any
    """angle [rad], a number, a function of time or Sampled data"""
    w_ref: Any
    """speed, the rate of phi_ref [rad/s], a number, a function of time or Sampled data"""
    a_ref: Any
    """acceleration, the rate of w_ref [rad/s2], a number, a function of time or Sampled data"""
    f_crit: Any
    """frequency with which it is held on phi_ref [Hz], above 0"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    w: Any
    """speed against the support [rad/s], fixed start value"""
    def __init__(
        self,
        *,
        phi_ref: SignalValue = ...,
        w_ref: SignalValue = ...,
        a_ref: SignalValue = ...,
        f_crit: ParameterValue = 50.0,
        phi: Number = ...,
        w: Number = ...,
    ) -> None: ...

class PowerSensor(TorqueSensor):
    """Power as a signal, between flanges that move as one: power = tau der(flange_a.phi).

    It is positive where what is joined to flange_a drives what is joined to flange_b.

    Source: MSL Rotational.Sensors.PowerSensor.

    Args:
        w: angular velocity of the flanges [rad/s], fixed start value.
    """

    power: Any
    """power from flange_a to flange_b [W]"""
    w: Any
    """angular velocity of the flanges [rad/s], fixed start value"""
    def __init__(
        self,
        *,
        w: Number = ...,
    ) -> None: ...

class RelativeAngleSensor(TwoFlanges):
    """Angle between two flanges as a signal: phi_rel = flange_b.phi - flange_a.phi.

    Source: MSL Rotational.Sensors.RelAngleSensor.
    """

    phi_rel: Any
    """angle between the flanges [rad]"""
    def __init__(self) -> None: ...

class SpeedDependentTorque(DrivenFlange):
    """A torque that depends on the speed of the flange: flange.tau = -tau.

    With `TorqueDirection` it has one direction whichever way it moves, tau(-w) = tau(w); else it turns round,
    tau(-w) = -tau(w): a load if tau_nominal is negative. A subclass gives `turning(x)`,
    tau/tau_nominal over x = w/w_nominal where it turns round.
    """

    tau_nominal: Any
    """torque at w_nominal; negative is a load for w > 0 [N.m]"""
    w_nominal: Any
    """speed at which the torque is tau_nominal [rad/s], above 0"""
    TorqueDirection: Any
    """whether the torque has the same direction for both directions of motion"""
    w: Any
    """speed against the support [rad/s], fixed start value"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    tau: Any
    """driving torque [N.m], fixed start value"""
    def lasting(self, x: Any) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

class SpeedSensor(_Absolute):
    """Angular velocity as a signal: w = der(flange.phi).

    Source: MSL Rotational.Sensors.SpeedSensor.
    """

    w: Any
    """angular velocity [rad/s]"""
    def __init__(self) -> None: ...

class Torque(DrivenFlange):
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
    potential: Any
    """stored energy [J]"""
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
    potential: Any
    """stored energy [J]"""
    @property
    def pull(self) -> Any: ...
    @property
    def push(self) -> Any: ...
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
    """Spring with a cubic and a quadratic term: tau = c e + c2 e^2 + c3 e^3 with e = phi_rel - phi_rel0.

    Args:
        c: linear stiffness [N.m/rad], at least 0.
        c3: cubic stiffness; negative softens [N.m/rad3].
        phi_rel0: unstretched angle [rad].
        c2: quadratic stiffness: stiffer when pulled, softer when pushed [N.m/rad2].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    c: Any
    """linear stiffness [N.m/rad], at least 0"""
    c3: Any
    """cubic stiffness; negative softens [N.m/rad3]"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    c2: Any
    """quadratic stiffness: stiffer when pulled, softer when pushed [N.m/rad2]"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        c3: ParameterValue,
        phi_rel0: ParameterValue = 0.0,
        c2: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class EddyCurrentBrake(AtTemperature):
    """A brake by eddy currents: tau = 2 tau_nominal x/(1 + x^2), x = w/(w_nominal r(T)).

    r = 1 + alpha (T - TRef) is the disc's resistance over that at TRef, alpha = alpha20/(1 + alpha20 (TRef -
    293.15 K)): a hot disc brakes best at a higher speed. The support is the ground when left unconnected.

    Source: MSL Rotational.Sources.EddyCurrentTorque (the equation of Kloss).

    Args:
        w_nominal: speed at which it brakes best at TRef [rad/s], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        T: temperature if heatPort is not used [K], above 0.
        useTau_nominalInput: whether the largest torque comes in as tau_input.
        tau_input: largest torque [N.m], a number, a function of time or Sampled data.
        tau_nominal: largest torque, at w_nominal [N.m], at least 0.
        TRef: temperature at which w_nominal holds [K], above 0.
        alpha20: temperature coefficient of the disc's resistance at 20 degC [1/K].
        phi: angle against the support [rad], fixed start value.
        w: speed against the support [rad/s], fixed start value.
        tau: braking torque, positive against positive speed [N.m], fixed start value.
    """

    flange: Any
    """shaft"""
    support: Any
    """what reacts"""
    useTau_nominalInput: Any
    """whether the largest torque comes in as tau_input"""
    tau_input: Any
    """largest torque [N.m], a number, a function of time or Sampled data"""
    tau_nominal: Any
    """largest torque, at w_nominal [N.m], at least 0"""
    w_nominal: Any
    """speed at which it brakes best at TRef [rad/s], above 0"""
    TRef: Any
    """temperature at which w_nominal holds [K], above 0"""
    alpha20: Any
    """temperature coefficient of the disc's resistance at 20 degC [1/K]"""
    phi: Any
    """angle against the support [rad], fixed start value"""
    w: Any
    """speed against the support [rad/s], fixed start value"""
    tau: Any
    """braking torque, positive against positive speed [N.m], fixed start value"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def resistance(self) -> Any: ...
    def __init__(
        self,
        *,
        w_nominal: ParameterValue,
        useHeatPort: bool = False,
        T: ParameterValue = 293.15,
        useTau_nominalInput: bool = False,
        tau_input: SignalValue = ...,
        tau_nominal: ParameterValue = 0.0,
        TRef: ParameterValue = 293.15,
        alpha20: ParameterValue = 0.0,
        phi: Number = ...,
        w: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class ElasticShaft(Bar):
    """Elastic shaft: inertia J = rho I_p L, stiffness c = G I_p/L and damping d over all of it."""

    flange_a: Any
    """left end"""
    flange_b: Any
    """right end"""
    J: Any
    """inertia [kg.m2], above 0"""
    c: Any
    """stiffness [N.m/rad], above 0"""
    d: Any
    """damping constant [N.m.s/rad], at least 0"""
    w_a: Any
    """speed of the left end [rad/s], fixed start value"""
    w_b: Any
    """speed of the right end [rad/s], fixed start value"""
    a_a: Any
    """acceleration of the left end [rad/s2], fixed start value"""
    a_b: Any
    """acceleration of the right end [rad/s2], fixed start value"""
    shape: Any
    @property
    def solid(self) -> Any: ...
    @property
    def ends(self) -> Any: ...
    @property
    def inner(self) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

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
    potential: Any
    """stored energy [J]"""
    @property
    def harmonics(self) -> Any: ...
    @property
    def store(self) -> Any: ...
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

class InverseSpeedDependentTorque(SpeedDependentTorque):
    """A torque of constant power: tau = tau_nominal w_nominal/|w| above w0.

    Below w0 it is what it is at w0; or goes straight to zero with speed, if it turns round.

    Source: MSL Rotational.Sources.InverseSpeedDependentTorque.

    Args:
        tau_nominal: torque at w_nominal; negative is a load for w > 0 [N.m].
        w_nominal: speed at which the torque is tau_nominal [rad/s], above 0.
        TorqueDirection: whether the torque has the same direction for both directions of motion.
        w0: speed below which it is regularised [rad/s], above 0.
        w: speed against the support [rad/s], fixed start value.
        phi: angle against the support [rad], fixed start value.
        tau: driving torque [N.m], fixed start value.
    """

    w0: Any
    """speed below which it is regularised [rad/s], above 0"""
    @property
    def least(self) -> Any: ...
    def turning(self, x: Any) -> Any: ...
    def lasting(self, x: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_nominal: ParameterValue,
        w_nominal: ParameterValue,
        TorqueDirection: bool = True,
        w0: ParameterValue = 0.1,
        w: Number = ...,
        phi: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class LinearSpeedDependentTorque(SpeedDependentTorque):
    """A torque in proportion to speed: tau = tau_nominal |w|/w_nominal, or tau_nominal w/w_nominal.

    Source: MSL Rotational.Sources.LinearSpeedDependentTorque.

    Args:
        tau_nominal: torque at w_nominal; negative is a load for w > 0 [N.m].
        w_nominal: speed at which the torque is tau_nominal [rad/s], above 0.
        TorqueDirection: whether the torque has the same direction for both directions of motion.
        w: speed against the support [rad/s], fixed start value.
        phi: angle against the support [rad], fixed start value.
        tau: driving torque [N.m], fixed start value.
    """

    def turning(self, x: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_nominal: ParameterValue,
        w_nominal: ParameterValue,
        TorqueDirection: bool = True,
        w: Number = ...,
        phi: Number = ...,
        tau: Number = ...,
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
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        lossTable: Any = ...,
        phi: Number = ...,
        w: Number = ...,
        a: Number = ...,
        tau_loss: Number = ...,
    ) -> None: ...

class MultiSensor(PowerSensor):
    """Angular velocity, torque and power as signals: w, tau and power = tau w.

    Source: MSL Rotational.Sensors.MultiSensor.
    """

    w: Any
    """angular velocity of the flanges [rad/s]"""
    def __init__(self) -> None: ...

class Position(Filtered, DrivenFlange):
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

class QuadraticSpeedDependentTorque(SpeedDependentTorque):
    """A torque in proportion to the square of speed: tau = tau_nominal (w/w_nominal)^2, or with its sign.

    Source: MSL Rotational.Sources.QuadraticSpeedDependentTorque.

    Args:
        tau_nominal: torque at w_nominal; negative is a load for w > 0 [N.m].
        w_nominal: speed at which the torque is tau_nominal [rad/s], above 0.
        TorqueDirection: whether the torque has the same direction for both directions of motion.
        w: speed against the support [rad/s], fixed start value.
        phi: angle against the support [rad], fixed start value.
        tau: driving torque [N.m], fixed start value.
    """

    def turning(self, x: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_nominal: ParameterValue,
        w_nominal: ParameterValue,
        TorqueDirection: bool = True,
        w: Number = ...,
        phi: Number = ...,
        tau: Number = ...,
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
        tau_sin: ParameterValue,
        period: ParameterValue,
        tau_cos: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class Speed(Filtered, DrivenFlange):
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
    potential: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
    ) -> None: ...

class TabulatedSpring(Compliant):
    """Spring given by points: tau = T(phi_rel - phi_rel0), straight beyond the first and the last of them.

    `load_points` reads them from a file.

    Source: interpolation="smooth" by F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.

    Args:
        table: rows (twist [rad], torque [N.m]), the first increasing.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
    """

    table: Any
    """rows (twist [rad], torque [N.m]), the first increasing"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    def __init__(
        self,
        *,
        table: Any = ...,
        interpolation: Literal['linear', 'smooth'] = 'linear',
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
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
    kinetic: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        J: ParameterValue,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class RelativeAccelerationSensor(RelativeSpeedSensor):
    """Relative angular acceleration as a signal: a_rel = der(w_rel).

    Source: MSL Rotational.Sensors.RelAccSensor.
    """

    a_rel: Any
    """relative angular acceleration [rad/s2]"""
    def __init__(self) -> None: ...

class WormGear(SlidingFlanks):
    """Worm and wheel, whose flanks slide under load: phi_a = ratio phi_b; self-locking if mu > tan(lambda).

    flange_b.tau = -ratio (flange_a.tau - tau_loss). Worm driving, the efficiency is tan(lambda)/tan(lambda +
    rho) with tan(rho) = mu; wheel driving, tan(lambda - rho)/tan(lambda), and none where it locks itself. At
    rest the load is truly held. With a pressure angle alpha, mu is the friction coefficient over cos(alpha).

    Limits: as for `SlidingFlanks`: mu tan(lambda) below 1, no locking by inertia alone.

    Source: mechanics of the inclined plane, J. E. Shigley, Mechanical Engineering Design.

    Args:
        mu: friction coefficient of the flanks, at least 0.
        ratio: turns of the worm for one of the wheel, not 0.
        lead_angle: lead angle of the worm [rad], above 0, at most 1.5.
        useHeatPort: whether its losses leave as heat through heatPort.
        tau_bf: friction torque of the bearings [N.m], at least 0.
        tau_loss: torque lost, seen where it is driven [N.m], fixed start value.
        phi: angle of the worm against the housing [rad], fixed start value.
        w: speed of the worm against the housing [rad/s], fixed start value.
        a: acceleration of the worm against the housing [rad/s2], fixed start value.
    """

    flange_a: Any
    """worm"""
    flange_b: Any
    """wheel"""
    support: Any
    """housing"""
    ratio: Any
    """turns of the worm for one of the wheel, not 0"""
    lead_angle: Any
    """lead angle of the worm [rad], above 0, at most 1.5"""
    phi: Any
    """angle of the worm against the housing [rad], fixed start value"""
    w: Any
    """speed of the worm against the housing [rad/s], fixed start value"""
    a: Any
    """acceleration of the worm against the housing [rad/s2], fixed start value"""
    @property
    def load_torque(self) -> Any: ...
    @property
    def slope(self) -> Any: ...
    def __init__(
        self,
        *,
        mu: ParameterValue,
        ratio: ParameterValue,
        lead_angle: ParameterValue,
        useHeatPort: bool = False,
        tau_bf: ParameterValue = 0.0,
        tau_loss: Number = ...,
        phi: Number = ...,
        w: Number = ...,
        a: Number = ...,
    ) -> None: ...

class Dissipative(CompliantWithSpeed, Lossy):
    """A compliant element that turns all its work into heat, unless it states otherwise."""

    lossPower: Any
    """dissipated power [W]"""
    def __init__(self, **values: Any) -> None: ...

class LumpedShaft(ElasticShaft, LumpedBar):
    """Flexible shaft of uniform section in lumps: springs in a row, inertias between, halves at the ends.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(c/J), both ends free, is too low:
    the first by 2.6 % with four segments, and a quarter of that with twice as many.

    Args:
        J: inertia [kg.m2], above 0.
        c: stiffness [N.m/rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        segments: number of springs.
        d: damping constant [N.m.s/rad], at least 0.
        w_a: speed of the left end [rad/s], fixed start value.
        w_b: speed of the right end [rad/s], fixed start value.
        a_a: acceleration of the left end [rad/s2], fixed start value.
        a_b: acceleration of the right end [rad/s2], fixed start value.
    """

    def __init__(
        self,
        *,
        J: ParameterValue,
        c: ParameterValue,
        useHeatPort: bool = False,
        segments: int | np.integer[Any] = 8,
        d: ParameterValue = 0.0,
        w_a: Number = ...,
        w_b: Number = ...,
        a_a: Number = ...,
        a_b: Number = ...,
        **parts: Component,
    ) -> None: ...

class ModalShaft(ElasticShaft, ModalBar):
    """Flexible shaft of uniform section by its modes: a straight line between its ends and half waves on it.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(c/J), both ends free, is too
    high: the first by 10 % with one mode, 0.4 % with two, 0.1 % with four.

    Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319.

    Example:
        >>> from inertance import rotational
        >>> shaft = rotational.ModalShaft(J=1.2e-4, c=1240.0, modes=4)  # a metre of steel, 10 mm in radius
        >>> 0 < shaft.frequency_error(1) < 2e-3
        True

    Args:
        J: inertia [kg.m2], above 0.
        c: stiffness [N.m/rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        modes: number of modes.
        d: damping constant [N.m.s/rad], at least 0.
        w_a: speed of the left end [rad/s], fixed start value.
        w_b: speed of the right end [rad/s], fixed start value.
        a_a: acceleration of the left end [rad/s2], fixed start value.
        a_b: acceleration of the right end [rad/s2], fixed start value.
    """

    def __init__(
        self,
        *,
        J: ParameterValue,
        c: ParameterValue,
        useHeatPort: bool = False,
        modes: int | np.integer[Any] = 4,
        d: ParameterValue = 0.0,
        w_a: Number = ...,
        w_b: Number = ...,
        a_a: Number = ...,
        a_b: Number = ...,
        **parts: Component,
    ) -> None: ...

class RelaxingSpring(Compliant, Relaxing):
    """Spring and damper in series by the time in which they relax: tau = c (e - z), T z' = e - z.

    e = phi_rel - phi_rel0.

    Args:
        T: time in which the force fades to 37 % [s], above 0.
        c: stiffness when shaken fast [N.m/rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        z: twist that has relaxed [rad], fixed start value.
    """

    c: Any
    """stiffness when shaken fast [N.m/rad], at least 0"""
    phi_rel0: Any
    """unstretched angle [rad]"""
    z: Any
    """twist that has relaxed [rad], fixed start value"""
    @property
    def stretch(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    def __init__(
        self,
        *,
        T: ParameterValue,
        c: ParameterValue,
        useHeatPort: bool = False,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Backlash(Dissipative):
    """Spring and damper with clearance: a dead zone of half-width c eps on P + D.

    tau = u - c eps where u = P + D >= c eps, u + c eps where u <= -c eps, else 0, with
    P = c (phi_rel - phi_rel0) and D = d w_rel. So tau is continuous and never opposes u.

    Limits: the damper counts inside the clearance too, as in the translational `Backlash`.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (20) and (24), written
    for turning.

    Args:
        c: stiffness [N.m/rad], at least 0.
        d: damping constant [N.m.s/rad], at least 0.
        eps: half of the clearance [rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        phi_rel0: angle at the middle of the clearance [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    c: Any
    """stiffness [N.m/rad], at least 0"""
    d: Any
    """damping constant [N.m.s/rad], at least 0"""
    eps: Any
    """half of the clearance [rad], at least 0"""
    phi_rel0: Any
    """angle at the middle of the clearance [rad]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def elastic(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        d: ParameterValue,
        eps: ParameterValue,
        useHeatPort: bool = False,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class CubicDamper(Dissipative):
    """Damper with torque growing with the cube of speed: tau = d3 w_rel^3.

    Args:
        d3: cubic damping constant [N.m.s3/rad3], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class DahlFriction(Dissipative):
    """Dry friction that builds up elastically before it slips: tau = tau_c z.

    phi_p z' = w_rel - |w_rel| z: the share z of tau_c grows by angle/phi_p at first, and comes within
    1/e of its end over phi_p. It knows no events, and creeps under a load that changes.

    Source: P. R. Dahl, AIAA Journal 14 (1976) 1675-1682, with the exponent 1.

    Args:
        tau_c: friction torque once it slips [N.m], at least 0.
        phi_p: presliding angle [rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        tau_c: ParameterValue,
        phi_p: ParameterValue,
        useHeatPort: bool = False,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Damper(Dissipative):
    """Linear damper: tau = d w_rel.

    Source: MSL Rotational.Components.Damper.

    Args:
        d: damping constant [N.m.s/rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class ElasticFlanks(Dissipative):
    """What elements with elastic flanks and a backlash b between them have in common.

    Within x = phi_rel - phi_rel0 from -b/2 to b/2 they touch nowhere. `elastic` is the torque of the springs.
    """

    c: Any
    """stiffness in contact [N.m/rad], above 0"""
    d: Any
    """damping constant in contact [N.m.s/rad], at least 0"""
    b: Any
    """total backlash [rad], at least 0"""
    phi_rel0: Any
    """angle in the middle of the backlash [rad]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def x(self) -> Any: ...
    @property
    def elastic(self) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

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

class OneWayClutch(Compliant, _Discs, Lossy):
    """A freewheel and a clutch in parallel: flange_b may run ahead of flange_a, never fall behind.

    w_rel >= 0; tau = mu(w_rel) cgeo fn while b runs ahead, fn = fn_max max(f_normalized, 0). Stuck,
    tau is whatever keeps w_rel = 0: as negative as it takes, up to peak mu(0) cgeo fn above zero.
    Falling behind at once (a blow, a start value) is stopped by the impulse J.

    Limits: to be free of chatter, break-away takes 1e-4 of the fully pressed clutch's even when the
    signal is zero, and exceeds sliding by as much.

    Source: MSL Rotational.Components.OneWayClutch.

    Args:
        fn_max: largest normal force [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
    lossPower: Any
    """dissipated power [W]"""
    least: Any
    @property
    def breakaway(self) -> Any: ...
    def __init__(
        self,
        *,
        fn_max: ParameterValue,
        useHeatPort: bool = False,
        f_normalized: SignalValue = ...,
        mu_pos: Any = ...,
        cgeo: ParameterValue = 1.0,
        peak: ParameterValue = 1.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class QuadraticDamper(Dissipative):
    """Damper with torque growing with the square of speed (a fan): tau = k w_rel |w_rel|.

    Args:
        k: quadratic damping constant [N.m.s2/rad2], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class RelaxingBacklash(CompliantWithSpeed, RelaxingFlanks):
    """Backlash b in series with a spring and damper without inertia, which relax while they touch nothing.

    With x = phi_rel - phi_rel0 and their stretch z, d z' + c z = p: they press by p = c (x -+ b/2) + d w_rel
    from where x -+ b/2 meets z until they would pull, and by p = 0 between. tau = p + d_0 w_rel, which jumps
    as they meet, since the damper is struck. `ElastoBacklash2` knows no z: what a flank gives comes back at
    once.

    Without backlash it is a `SpringDamper`, without stiffness a damper with play. Where a spring follows it
    without inertia between them, something must fill the backlash (d_0 > 0), or nothing tells where that
    stays.

    Args:
        c: stiffness in contact [N.m/rad], at least 0.
        d: damping constant in contact [N.m.s/rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        b: total backlash [rad], at least 0.
        phi_rel0: angle in the middle of the backlash [rad].
        d_0: damping constant of what fills the backlash [N.m.s/rad], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        z: stretch of spring and damper [rad], fixed start value.
    """

    c: Any
    """stiffness in contact [N.m/rad], at least 0"""
    d: Any
    """damping constant in contact [N.m.s/rad], above 0"""
    b: Any
    """total backlash [rad], at least 0"""
    phi_rel0: Any
    """angle in the middle of the backlash [rad]"""
    d_0: Any
    """damping constant of what fills the backlash [N.m.s/rad], at least 0"""
    z: Any
    """stretch of spring and damper [rad], fixed start value"""
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
        c: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        b: ParameterValue = 0.0,
        phi_rel0: ParameterValue = 0.0,
        d_0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class ShearThinningDamper(Dissipative):
    """Damper whose oil thins where it is sheared fast: tau = d w_e asinh(w_rel/w_e).

    Viscous at speeds far below w_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.

    Args:
        d: damping constant at rest [N.m.s/rad], at least 0.
        w_e: speed above which the oil thins [rad/s], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class ShuntedMotor(Dissipative):
    """Motor whose terminals a coil, a resistance and a capacitor join in series: tau = k i.

    L i' + R i + q/C = k w_rel with q' = i: its torque resists. With a capacitor alone it is an inertia of
    k^2 C; R and L stand in series with that. L and R include the winding's.

    Source: F.-C. Wang, H.-A. Chan, Vehicle suspensions with a mechatronic network strut, Vehicle System
    Dynamics 49 (2011) 811-830.

    Args:
        k: torque constant, and that of the induced voltage [N.m/A], not 0.
        L: inductance of the circuit [V.s/A], above 0.
        R: resistance of the circuit [V/A], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        elastance: 1/C of the capacitor, 0 without one [V/(A.s)], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        i: current [A], fixed start value.
        q: charge of the capacitor [A.s], fixed start value.
    """

    k: Any
    """torque constant, and that of the induced voltage [N.m/A], not 0"""
    L: Any
    """inductance of the circuit [V.s/A], above 0"""
    R: Any
    """resistance of the circuit [V/A], above 0"""
    elastance: Any
    """1/C of the capacitor, 0 without one [V/(A.s)], at least 0"""
    i: Any
    """current [A], fixed start value"""
    q: Any
    """charge of the capacitor [A.s], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        k: ParameterValue,
        L: ParameterValue,
        R: ParameterValue,
        useHeatPort: bool = False,
        elastance: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        i: Number = ...,
        q: Number = ...,
    ) -> None: ...

class SpringDamper(Dissipative):
    """Linear spring and damper in parallel: tau = c (phi_rel - phi_rel0) + d w_rel.

    Source: MSL Rotational.Components.SpringDamper.

    Args:
        c: stiffness [N.m/rad], at least 0.
        d: damping constant [N.m.s/rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(
        self,
        *,
        c: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class TabulatedDamper(Dissipative):
    """Damper given by points: tau = T(w_rel), straight beyond the first and the last of them.

    Source: as for `TabulatedSpring`.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        table: rows (speed [rad/s], torque [N.m]), the first increasing.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    table: Any
    """rows (speed [rad/s], torque [N.m]), the first increasing"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        table: Any = ...,
        interpolation: Literal['linear', 'smooth'] = 'linear',
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class TabulatedForce(Dissipative):
    """Torque by any law of angle, speed or both: tau = F(phi_rel - phi_rel0, w_rel), given by points.

    What it has at rest is stored, the rest lost: below 0 where the points give power. Of one variable
    interpolation="smooth" never overshoots its points, so that the law is monotone where they are.

    Limits: beyond the points it goes on straight. A step is a steep line: nothing sticks.

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        table: rows (twist [rad], torque [N.m]), (speed [rad/s], torque [N.m]) or (twist [rad], speed [rad/s],
            torque [N.m]).
        over: what rows of two numbers are over.
        interpolation: whether it is straight (linear) or smooth, with a steady slope, between the points.
        odd: whether the points are one half, and F(-x) = -F(x) the other.
        phi_rel0: unstretched angle [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    table: Any
    """rows (twist [rad], torque [N.m]), (speed [rad/s], torque [N.m]) or (twist [rad], speed [rad/s], torque [N.m])"""
    over: Any
    """what rows of two numbers are over"""
    interpolation: Any
    """whether it is straight (linear) or smooth, with a steady slope, between the points"""
    odd: Any
    """whether the points are one half, and F(-x) = -F(x) the other"""
    phi_rel0: Any
    """unstretched angle [rad]"""
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
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class VariableDamper(Dissipative):
    """Damper whose constant follows a signal: tau = (d + d_u u + d_uu u^2) w_rel.

    Args:
        d_u: change of the damping constant with u [N.m.s/rad].
        useHeatPort: whether its losses leave as heat through heatPort.
        u: what the damping follows, a number, a function of time or Sampled data.
        d: damping constant at u = 0 [N.m.s/rad].
        d_uu: change of it with the square of u [N.m.s/rad].
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
    d_uu: Any
    """change of it with the square of u [N.m.s/rad]"""
    def __init__(
        self,
        *,
        d_u: ParameterValue,
        useHeatPort: bool = False,
        u: SignalValue = ...,
        d: ParameterValue = 0.0,
        d_uu: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    tau = tau_forward for w_rel > 0 and -tau_backward for w_rel < 0.
    While stuck, -peak tau_backward <= tau <= peak tau_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.

    Args:
        tau_forward: friction torque while the angle grows [N.m], at least 0.
        tau_backward: friction torque while it shrinks [N.m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class BoucWen(CompliantWithSpeed, HystereticSpring):
    """Hysteretic spring: tau = alpha c phi_rel + (1 - alpha) c z.

    z' = A w_rel - beta |w_rel| |z|^(n-1) z - gamma w_rel |z|^n, with z [rad] the hysteretic angle.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263, written for turning.

    Args:
        c: initial stiffness [N.m/rad], at least 0.
        beta: loop shape against the motion [1/rad^n], at least 0.
        gamma: loop shape along the motion [1/rad^n].
        useHeatPort: whether its losses leave as heat through heatPort.
        alpha: share of stiffness after yield, at least 0, at most 1.
        A: scale of z, above 0.
        n: sharpness of yield, at least 1.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        z: hysteretic angle [rad], fixed start value.
    """

    c: Any
    """initial stiffness [N.m/rad], at least 0"""
    beta: Any
    """loop shape against the motion [1/rad^n], at least 0"""
    gamma: Any
    """loop shape along the motion [1/rad^n]"""
    z: Any
    """hysteretic angle [rad], fixed start value"""
    @property
    def stretch(self) -> Any: ...
    @property
    def speed(self) -> Any: ...
    @property
    def stiffness(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        beta: ParameterValue,
        gamma: ParameterValue,
        useHeatPort: bool = False,
        alpha: ParameterValue = 0.1,
        A: ParameterValue = 1.0,
        n: ParameterValue = 2.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class Brake(_Discs, PressedStickSlip):
    """A shaft held by friction on a support: tau = mu(|w|) cgeo fn against w while sliding.

    fn = fn_max max(f_normalized, 0); |tau| <= peak mu(0) cgeo fn while stuck; free when fn = 0.
    The support, which takes -tau, is the ground when left unconnected.

    Source: MSL Rotational.Components.Brake.

    Args:
        fn_max: largest normal force [N], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
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
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class DriftingFriction(Friction):
    """Friction whose level follows a signal: tau = (tau_c + tau_u u + tau_uu u^2) sgn(w_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. A level below zero counts as none; with
    `regularised` it may be negative, so that it stands for what a drift adds to, or takes from, friction that
    is there.

    Args:
        tau_u: change of friction torque with u [N.m].
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        u: what the level follows, a number, a function of time or Sampled data.
        tau_c: friction torque at u = 0 [N.m].
        tau_uu: change of it with the square of u [N.m].
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
    tau_uu: Any
    """change of it with the square of u [N.m]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_u: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        u: SignalValue = ...,
        tau_c: ParameterValue = 0.0,
        tau_uu: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class ElastoBacklash(ElasticFlanks):
    """Backlash b between elastic flanks that only ever press.

    With x = phi_rel - phi_rel0 and the spring torque tau_c = c max(|x| - b/2, 0) of the flank in
    contact, tau = sgn(x) max(tau_c + min(tau_c, sgn(x) d w_rel), 0): damping adds at most tau_c as
    the flank is pressed, and takes away at most tau_c as it is released, so tau is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, whose law with b = 0 is the plain spring and
    damper instead.

    Args:
        c: stiffness in contact [N.m/rad], above 0.
        d: damping constant in contact [N.m.s/rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        b: total backlash [rad], at least 0.
        phi_rel0: angle in the middle of the backlash [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    def pressed(self, depth: Any, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        b: ParameterValue = 0.0,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class ElastoBacklash2(ElasticFlanks):
    """Backlash b between elastic flanks whose damping acts at once: tau = c (x -+ b/2) + d w_rel in contact.

    x = phi_rel - phi_rel0. A flank is in contact beyond -b/2 or b/2 while its torque presses; it touches and
    lets go at events, and tau jumps as it touches. `ElastoBacklash` limits the damping instead.

    Source: MSL Rotational.Components.ElastoBacklash2, whose law with b = 0 is the plain spring and damper.

    Args:
        c: stiffness in contact [N.m/rad], above 0.
        d: damping constant in contact [N.m.s/rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        b: total backlash [rad], at least 0.
        phi_rel0: angle in the middle of the backlash [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    mode: Any
    """apart, or in contact for x > 0 or x < 0"""
    @property
    def forward(self) -> Any: ...
    @property
    def backward(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        d: ParameterValue,
        useHeatPort: bool = False,
        b: ParameterValue = 0.0,
        phi_rel0: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
    ) -> None: ...

class Iwan(CompliantWithSpeed, IwanCells):
    """A joint that slips bit by bit: tau = c mean(z_i), cells that yield one after the other, up to phi_y.

    Cell i of n yields at y_i = phi_y ((i - 1/2)/n)^p, rounded by Bouc and Wen's law: z_i' = w_rel if w_rel
    z_i <= 0, else w_rel (1 - |z_i/y_i|^8). Twisted on, it slides at c phi_y/(1 + p).

    How many cells it takes, as of the translational one.

    Source: as the translational `Iwan`, written for turning.

    Example:
        >>> from inertance import rotational
        >>> hub = rotational.Iwan(c=1e5, phi_y=1e-4, p=2.0)

    Args:
        p: how the yields spread: 0 all at once, 1 evenly, above 1 more of them early, at least 0.
        c: stiffness before it slips [N.m/rad], at least 0.
        phi_y: twist at which the last cell yields [rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        cells: number of cells.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
    """

    c: Any
    """stiffness before it slips [N.m/rad], at least 0"""
    phi_y: Any
    """twist at which the last cell yields [rad], above 0"""
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
        c: ParameterValue,
        phi_y: ParameterValue,
        useHeatPort: bool = False,
        cells: int | np.integer[Any] = 6,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        **parts: Component,
    ) -> None: ...

class Jenkins(CompliantWithSpeed, ElastoPlastic):
    """A spring in series with dry friction, without inertia between them: tau = c z, |tau| <= tau_c.

    z' = w_rel while it sticks, z' = 0 while it slips at |tau| = tau_c.

    Source: G. M. Jenkins, Analysis of the stress-strain relationships in reactor grade graphite, British
    Journal of Applied Physics 13 (1962) 30-32, written for turning.

    Args:
        c: stiffness of the spring [N.m/rad], above 0.
        tau_c: Coulomb friction torque [N.m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
    def stiffness(self) -> Any: ...
    @property
    def slip_stretch(self) -> Any: ...
    def __init__(
        self,
        *,
        c: ParameterValue,
        tau_c: ParameterValue,
        useHeatPort: bool = False,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class LoadedFriction(Friction):
    """Friction in proportion to a load: tau = mu |load| sgn(w_rel) while sliding.

    While stuck, |tau| <= peak mu |load|.

    Example:
        >>> from inertance import rotational
        >>> seal = rotational.LoadedFriction(mu=0.02)  # connect a TorqueSensor's torque to seal.load

    Args:
        mu: friction torque over load, at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        load: SignalValue = ...,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class LuGreFriction(CompliantWithSpeed, Bristles):
    """Friction of bristles that bend by z: tau = sigma_0 z + sigma_1 z' + sigma_2 w_rel.

    z' = w_rel - sigma_0 |w_rel| z/g with g = tau_c + (tau_s - tau_c) exp(-(w_rel/w_s)^2), so that tau comes
    to g sgn(w_rel) + sigma_2 w_rel at a steady speed. It knows no events.

    Limits: with a large sigma_1 it may give power back for an instant, and under a load that vibrates below
    break-away it drifts.

    Source: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems
    with friction, IEEE Trans. Automat. Contr. 40 (1995) 419-425.

    Args:
        tau_c: Coulomb friction torque [N.m], above 0.
        w_s: Stribeck speed [rad/s], above 0.
        sigma_0: stiffness of the bristles [N.m/rad], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        tau_s: static friction torque [N.m], above 0.
        sigma_1: damping of the bristles [N.m.s/rad], at least 0.
        sigma_2: viscous friction [N.m.s/rad], at least 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        z: mean bend of the bristles [rad], fixed start value.
    """

    tau_c: Any
    """Coulomb friction torque [N.m], above 0"""
    tau_s: Any
    """static friction torque [N.m], above 0"""
    w_s: Any
    """Stribeck speed [rad/s], above 0"""
    sigma_0: Any
    """stiffness of the bristles [N.m/rad], above 0"""
    sigma_1: Any
    """damping of the bristles [N.m.s/rad], at least 0"""
    sigma_2: Any
    """viscous friction [N.m.s/rad], at least 0"""
    z: Any
    """mean bend of the bristles [rad], fixed start value"""
    @property
    def speed(self) -> Any: ...
    @property
    def level(self) -> Any: ...
    def __init__(
        self,
        *,
        tau_c: ParameterValue,
        w_s: ParameterValue,
        sigma_0: ParameterValue,
        useHeatPort: bool = False,
        tau_s: ParameterValue = ...,
        sigma_1: ParameterValue = 0.0,
        sigma_2: ParameterValue = 0.0,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        z: Number = ...,
    ) -> None: ...

class PositionDependentFriction(Friction):
    """Dry friction whose level depends on where it slides: tau = level sgn(w_rel).

    level = tau_c + tau_1 e + tau_2 e^2 + tau_cos cos(2 pi e/period) + tau_sin sin(2 pi e/period),
    e = phi_rel - phi_rel0, the waves as of a bearing that is tight at places.

    A level below zero counts as none; with `regularised` it may be negative, so that it stands for what is
    added to, or taken from, friction that is there.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991).

    Args:
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        tau_c: friction torque at phi_rel0, but for the waves [N.m].
        tau_1: slope of the friction torque at phi_rel0 [N.m/rad].
        tau_2: half of its curvature [N.m/rad2].
        tau_cos: share of a wave that is greatest at phi_rel0 [N.m].
        tau_sin: share of a wave that rises there [N.m].
        period: angle from wave to wave [rad], above 0.
        phi_rel0: angle from which e counts [rad].
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_c: Any
    """friction torque at phi_rel0, but for the waves [N.m]"""
    tau_1: Any
    """slope of the friction torque at phi_rel0 [N.m/rad]"""
    tau_2: Any
    """half of its curvature [N.m/rad2]"""
    tau_cos: Any
    """share of a wave that is greatest at phi_rel0 [N.m]"""
    tau_sin: Any
    """share of a wave that rises there [N.m]"""
    period: Any
    """angle from wave to wave [rad], above 0"""
    phi_rel0: Any
    """angle from which e counts [rad]"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        tau_c: ParameterValue = 0.0,
        tau_1: ParameterValue = 0.0,
        tau_2: ParameterValue = 0.0,
        tau_cos: ParameterValue = 0.0,
        tau_sin: ParameterValue = 0.0,
        period: ParameterValue = 6.283185307179586,
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
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
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
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        tau_pos: Any = ...,
        phi_rel: Number = ...,
        tau: Number = ...,
        w_rel: Number = ...,
        a_rel: Number = ...,
    ) -> None: ...

class TemperatureDependentFriction(Friction, AtTemperature):
    """Coulomb friction that changes with temperature: tau = tau_c (1 + alpha (T - TRef)) sgn(w_rel).

    T is that of `heatPort` with `useHeatPort`, which its losses may heat. While stuck, |tau| <= peak of it.
    Limits: alpha (T - TRef) must stay above -1.

    Args:
        tau_c: Coulomb friction torque at TRef [N.m], at least 0.
        alpha: relative change of friction with temperature [1/K].
        useHeatPort: whether its losses leave as heat through heatPort.
        T: temperature if heatPort is not used [K], above 0.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        TRef: temperature at which it is tau_c [K], above 0.
        phi_rel: angle between the flanges [rad], fixed start value.
        tau: torque between the flanges, positive when it turns b back towards a [N.m], fixed start value.
        w_rel: relative speed of the flanges [rad/s], fixed start value.
        a_rel: relative acceleration of the flanges [rad/s2], fixed start value.
    """

    tau_c: Any
    """Coulomb friction torque at TRef [N.m], at least 0"""
    alpha: Any
    """relative change of friction with temperature [1/K]"""
    TRef: Any
    """temperature at which it is tau_c [K], above 0"""
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        tau_c: ParameterValue,
        alpha: ParameterValue,
        useHeatPort: bool = False,
        T: ParameterValue = 293.15,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        TRef: ParameterValue = 293.15,
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
        useHeatPort: whether its losses leave as heat through heatPort.
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
        useHeatPort: bool = False,
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
