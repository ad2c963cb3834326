"""The components among the machines, in one place: what type checkers know of them stands in its stub."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any

from ...components import rotational
from ...components.language import Component, Number, ParameterValue, SignalValue
from ...components.lossy import Lossy
from ...components.translational import Compliant, Dissipative, TwoFlanges

class RigidRingTyre(Component):
    """Tyre whose belt is a rigid ring: side walls join it to rim and hub, and it slips as a `Tyre` does.

    Up to about 100 Hz the belt keeps its shape; it turns on the rim (c_phi, d_phi) and gives way to the hub
    (k_x, d_x). At rest the contact is a spring mu F_z B C/sigma, between the belt's R phi and its s.

    Limits: those of `Tyre`, and nothing vertical.

    Source: P. W. A. Zegelaar, The Dynamic Response of Tyres to Brake Torque Variations and Road
    Unevennesses, thesis, Delft University of Technology (1998).

    Args:
        J_b: inertia of the belt [kg.m2], above 0.
        m_b: mass of the belt [kg], above 0.
        c_phi: stiffness of the side walls against turning [N.m/rad], above 0.
        k_x: stiffness of the side walls along the road [N/m], above 0.
        R: effective rolling radius [m], above 0.
        F_z: load on the tyre [N], at least 0.
        mu: largest f_x over F_z, at least 0.
        B: stiffness factor, above 0.
        C: shape factor, above 0.
        sigma: relaxation length of the contact [m], above 0.
        d_phi: damping constant of the side walls against turning [N.m.s/rad], at least 0.
        d_x: damping constant of the side walls along the road [N.s/m], at least 0.
        E: curvature factor, at most 1.
        ring: Inertia.
        belt: Mass.
        turning: SpringDamper.
        sliding: SpringDamper.
        contact: Tyre.
    """

    flange_r: Any
    """rim"""
    flange_t: Any
    """hub"""
    support_t: Any
    """road"""
    J_b: Any
    """inertia of the belt [kg.m2], above 0"""
    m_b: Any
    """mass of the belt [kg], above 0"""
    c_phi: Any
    """stiffness of the side walls against turning [N.m/rad], above 0"""
    d_phi: Any
    """damping constant of the side walls against turning [N.m.s/rad], at least 0"""
    k_x: Any
    """stiffness of the side walls along the road [N/m], above 0"""
    d_x: Any
    """damping constant of the side walls along the road [N.s/m], at least 0"""
    R: Any
    """effective rolling radius [m], above 0"""
    F_z: Any
    """load on the tyre [N], at least 0"""
    mu: Any
    """largest f_x over F_z, at least 0"""
    B: Any
    """stiffness factor, above 0"""
    C: Any
    """shape factor, above 0"""
    E: Any
    """curvature factor, at most 1"""
    sigma: Any
    """relaxation length of the contact [m], above 0"""
    ring: Any
    """Inertia"""
    belt: Any
    """Mass"""
    turning: Any
    """SpringDamper"""
    sliding: Any
    """SpringDamper"""
    contact: Any
    """Tyre"""
    def __init__(
        self,
        *,
        J_b: ParameterValue,
        m_b: ParameterValue,
        c_phi: ParameterValue,
        k_x: ParameterValue,
        R: ParameterValue,
        F_z: ParameterValue,
        mu: ParameterValue,
        B: ParameterValue,
        C: ParameterValue,
        sigma: ParameterValue,
        d_phi: ParameterValue = 0.0,
        d_x: ParameterValue = 0.0,
        E: ParameterValue = 0.0,
        ring: Component = ...,
        belt: Component = ...,
        turning: Component = ...,
        sliding: Component = ...,
        contact: Component = ...,
    ) -> None: ...

class Servo(Component):
    """Servo as it is sold: a sampled PD controller with dead band and delay on a motor with a gear.

    Each `period` the angle of the horn is read, and u = k_p dead(reference - phi) - k_d w put out `delay`
    later, in V at the motor. What the motor can is that of `rotational.DCMotor`.

    Args:
        k_p: gain [V/rad], at least 0.
        period: period of sampling [s], above 0.
        ratio: turns of the motor for one of the horn, not 0.
        J: inertia of the rotor [kg.m2], above 0.
        k: torque constant of the motor [N.m/A], not 0.
        R: resistance of the motor [V/A], above 0.
        L: inductance of the motor [V.s/A], above 0.
        u_max: largest voltage [V], above 0.
        i_max: largest current [A], above 0.
        reference: angle wanted [rad], a number, a function of time or Sampled data.
        k_d: damping gain [V.s/rad], at least 0.
        band: half of the dead band [rad], at least 0.
        delay: from sample to voltage, shorter than the period [s], at least 0.
        motor: DCMotor.
        rotor: Inertia.
        gear: IdealGear.
        angle: RelativeAngleSensor.
        speed: RelativeSpeedSensor.
        error: Add.
        dead: DeadZone.
        law: Add.
        hold: SampleHold.
        phi: angle of the horn against the case [rad], fixed start value.
    """

    flange: Any
    """horn"""
    support: Any
    """case"""
    reference: Any
    """angle wanted [rad], a number, a function of time or Sampled data"""
    k_p: Any
    """gain [V/rad], at least 0"""
    k_d: Any
    """damping gain [V.s/rad], at least 0"""
    band: Any
    """half of the dead band [rad], at least 0"""
    period: Any
    """period of sampling [s], above 0"""
    delay: Any
    """from sample to voltage, shorter than the period [s], at least 0"""
    ratio: Any
    """turns of the motor for one of the horn, not 0"""
    J: Any
    """inertia of the rotor [kg.m2], above 0"""
    k: Any
    """torque constant of the motor [N.m/A], not 0"""
    R: Any
    """resistance of the motor [V/A], above 0"""
    L: Any
    """inductance of the motor [V.s/A], above 0"""
    u_max: Any
    """largest voltage [V], above 0"""
    i_max: Any
    """largest current [A], above 0"""
    phi: Any
    """angle of the horn against the case [rad], fixed start value"""
    motor: Any
    """DCMotor"""
    rotor: Any
    """Inertia"""
    gear: Any
    """IdealGear"""
    angle: Any
    """RelativeAngleSensor"""
    speed: Any
    """RelativeSpeedSensor"""
    error: Any
    """Add"""
    dead: Any
    """DeadZone"""
    law: Any
    """Add"""
    hold: Any
    """SampleHold"""
    def __init__(
        self,
        *,
        k_p: ParameterValue,
        period: ParameterValue,
        ratio: ParameterValue,
        J: ParameterValue,
        k: ParameterValue,
        R: ParameterValue,
        L: ParameterValue,
        u_max: ParameterValue,
        i_max: ParameterValue,
        reference: SignalValue = ...,
        k_d: ParameterValue = 0.0,
        band: ParameterValue = 0.0,
        delay: ParameterValue = 0.0,
        motor: Component = ...,
        rotor: Component = ...,
        gear: Component = ...,
        angle: Component = ...,
        speed: Component = ...,
        error: Component = ...,
        dead: Component = ...,
        law: Component = ...,
        hold: Component = ...,
        phi: Number = ...,
    ) -> None: ...

class TorsionalDamper(Component):
    """Damper at the end of a crankshaft: a ring in a housing, joined by silicone oil (d) or rubber (c, d).

    With c = 0, on a shaft that swings at w in a mode of inertia J, the ring damps best with
    d = 2 J_r w/sqrt(2 (1 + mu) (2 + mu)), mu = J_r/J.

    Source: J. P. Den Hartog, Mechanical Vibrations, 4th ed. (1956), chapter 5 for the viscous one.

    Args:
        J_h: inertia of the housing [kg.m2], above 0.
        J_r: inertia of the ring [kg.m2], above 0.
        d: damping constant of oil or rubber [N.m.s/rad], at least 0.
        c: stiffness of the rubber [N.m/rad], at least 0.
        housing: Inertia.
        ring: Inertia.
        link: SpringDamper.
    """

    flange: Any
    """where the housing is joined"""
    J_h: Any
    """inertia of the housing [kg.m2], above 0"""
    J_r: Any
    """inertia of the ring [kg.m2], above 0"""
    c: Any
    """stiffness of the rubber [N.m/rad], at least 0"""
    d: Any
    """damping constant of oil or rubber [N.m.s/rad], at least 0"""
    housing: Any
    """Inertia"""
    ring: Any
    """Inertia"""
    link: Any
    """SpringDamper"""
    def __init__(
        self,
        *,
        J_h: ParameterValue,
        J_r: ParameterValue,
        d: ParameterValue,
        c: ParameterValue = 0.0,
        housing: Component = ...,
        ring: Component = ...,
        link: Component = ...,
    ) -> None: ...

class Unbalance(Component):
    """A rotor whose mass lies off its axis, in a housing that slides: a pair that turns oppositely as one.

        f = m (a + e (alpha cos phi - w^2 sin phi)),   tau = m e (a cos phi + e alpha)

    phi = 0 is across the motion. m e^2 is its inertia about the axis; power is conserved, so that the drive
    feels the vibration.

    Limits: gravity is left out.

    Args:
        m: mass off the axis [kg], above 0.
        e: its distance from the axis [m], at least 0.
        v: velocity of the housing [m/s], fixed start value.
        a: acceleration of the housing [m/s2], fixed start value.
        phi: angle of the rotor [rad], fixed start value.
        w: speed of the rotor [rad/s], fixed start value.
        alpha: angular acceleration of the rotor [rad/s2], fixed start value.
    """

    flange: Any
    """housing"""
    shaft: Any
    """rotor"""
    m: Any
    """mass off the axis [kg], above 0"""
    e: Any
    """its distance from the axis [m], at least 0"""
    v: Any
    """velocity of the housing [m/s], fixed start value"""
    a: Any
    """acceleration of the housing [m/s2], fixed start value"""
    phi: Any
    """angle of the rotor [rad], fixed start value"""
    w: Any
    """speed of the rotor [rad/s], fixed start value"""
    alpha: Any
    """angular acceleration of the rotor [rad/s2], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    @property
    def turning(self) -> Any: ...
    @property
    def sliding(self) -> Any: ...
    def __init__(
        self,
        *,
        m: ParameterValue,
        e: ParameterValue,
        v: Number = ...,
        a: Number = ...,
        phi: Number = ...,
        w: Number = ...,
        alpha: Number = ...,
    ) -> None: ...

class _HeavingBody(Component):
    m: Any
    """mass [kg], above 0"""
    l_f: Any
    """from the centre of mass to the front axle [m], above 0"""
    l_r: Any
    """from the centre of mass to the rear axle [m], above 0"""
    s: Any
    """height of the centre of mass [m], fixed start value"""
    v: Any
    """velocity of the centre of mass [m/s], fixed start value"""
    a: Any
    """acceleration of the centre of mass [m/s2], fixed start value"""
    theta: Any
    """pitch [rad], fixed start value"""
    q: Any
    """pitch rate [rad/s], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class DualMassFlywheel(rotational.TwoFlanges):
    """Dual-mass flywheel: J_1 on flange_a, J_2 on flange_b, between them arc springs and their friction.

    The springs are linear, of stiffness c and damping d, or any turning element given as `springs`, such as a
    `rotational.TabulatedSpring` of two stages. They rub on their guide with tau_c, built up over phi_p.

    Source: W. Reik, R. Seebacher, A. Kooy, Dual mass flywheel, 6th LuK Symposium (1998).

    Args:
        J_1: inertia on the engine's side [kg.m2], above 0.
        J_2: inertia on the gearbox's side [kg.m2], above 0.
        c: stiffness of the springs [N.m/rad], at least 0.
        d: damping constant of the springs [N.m.s/rad], at least 0.
        tau_c: friction torque [N.m], at least 0.
        phi_p: angle over which friction builds up [rad], above 0.
        primary: Inertia.
        secondary: Inertia.
        springs: SpringDamper.
        friction: DahlFriction.
        phi_rel: angle between the flanges [rad], fixed start value.
    """

    flange_a: Any
    """engine"""
    flange_b: Any
    """gearbox"""
    J_1: Any
    """inertia on the engine's side [kg.m2], above 0"""
    J_2: Any
    """inertia on the gearbox's side [kg.m2], above 0"""
    c: Any
    """stiffness of the springs [N.m/rad], at least 0"""
    d: Any
    """damping constant of the springs [N.m.s/rad], at least 0"""
    tau_c: Any
    """friction torque [N.m], at least 0"""
    phi_p: Any
    """angle over which friction builds up [rad], above 0"""
    primary: Any
    """Inertia"""
    secondary: Any
    """Inertia"""
    springs: Any
    """SpringDamper"""
    friction: Any
    """DahlFriction"""
    def __init__(
        self,
        *,
        J_1: ParameterValue,
        J_2: ParameterValue,
        c: ParameterValue = 0.0,
        d: ParameterValue = 0.0,
        tau_c: ParameterValue = 0.0,
        phi_p: ParameterValue = 0.01,
        primary: Component = ...,
        secondary: Component = ...,
        springs: Component = ...,
        friction: Component = ...,
        phi_rel: Number = ...,
    ) -> None: ...

class FlywheelInerter(TwoFlanges):
    """A rod that turns a flywheel through a transmission, both in one housing."""

    support: Any
    """what keeps the housing from turning"""
    f: Any
    """force of the housing, positive when it pulls the flanges together [N], fixed start value"""
    def joined(self, transmission: Any) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

class InterconnectedStruts(Lossy):
    """Two double-acting cylinders joined crosswise by two lines, each with a gas accumulator behind a valve.

        V_1 = A_r e_right - A_b e_left,   p_1 = p_0 (V_0/(V_0 - V_1))^n + R der(V_1),   line 2 the other way
        about, f_left = A_r (p_2 - p_0) - A_b (p_1 - p_0),   e = s_b - s_a - s_rel0 of a strut

    V is what has been pressed into an accumulator. Both struts compressed by e displace (A_b - A_r) e a
    line, in roll (A_b + A_r) e: so stiffness and damping in roll are ((A_b + A_r)/(A_b - A_r))^2 those in
    heave. Forces count from rest, where the struts carry (A_b - A_r) p_0 each.

    Limits: fluid without inertia or compressibility, lines without loss but that of the valves.

    Source: the arrangement of N. Zhang, W. A. Smith et al., Hydraulically interconnected vehicle suspension:
    background and modelling, Vehicle System Dynamics 48 (2010), without the fluid's inertia.

    Args:
        A_b: area of the piston on the bore side [m2], above 0.
        A_r: area of the piston on the rod side [m2], above 0.
        p_0: gas pressure at rest [Pa], above 0.
        V_0: gas volume of an accumulator at rest [m3], above 0.
        R: resistance of a valve [Pa.s/m3], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        n: polytropic exponent of the gas, at least 1.
        s_rel0: length of a strut at rest [m].
        V_1: fluid in the accumulator of line 1 [m3], fixed start value.
        V_2: fluid in the accumulator of line 2 [m3], fixed start value.
        q_1: flow into it [m3/s], fixed start value.
        q_2: flow into it [m3/s], fixed start value.
        p_1: pressure in line 1: left bore and right rod side [Pa], fixed start value.
        p_2: pressure in line 2: right bore and left rod side [Pa], fixed start value.
    """

    left_a: Any
    """left cylinder, on the wheel"""
    left_b: Any
    """left rod, on the body"""
    right_a: Any
    """right cylinder, on the wheel"""
    right_b: Any
    """right rod, on the body"""
    A_b: Any
    """area of the piston on the bore side [m2], above 0"""
    A_r: Any
    """area of the piston on the rod side [m2], above 0"""
    p_0: Any
    """gas pressure at rest [Pa], above 0"""
    V_0: Any
    """gas volume of an accumulator at rest [m3], above 0"""
    n: Any
    """polytropic exponent of the gas, at least 1"""
    R: Any
    """resistance of a valve [Pa.s/m3], at least 0"""
    s_rel0: Any
    """length of a strut at rest [m]"""
    V_1: Any
    """fluid in the accumulator of line 1 [m3], fixed start value"""
    V_2: Any
    """fluid in the accumulator of line 2 [m3], fixed start value"""
    q_1: Any
    """flow into it [m3/s], fixed start value"""
    q_2: Any
    """flow into it [m3/s], fixed start value"""
    p_1: Any
    """pressure in line 1: left bore and right rod side [Pa], fixed start value"""
    p_2: Any
    """pressure in line 2: right bore and left rod side [Pa], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def stored(self, pressed: Any) -> Any: ...
    def pressure(self, pressed: Any) -> Any: ...
    def __init__(
        self,
        *,
        A_b: ParameterValue,
        A_r: ParameterValue,
        p_0: ParameterValue,
        V_0: ParameterValue,
        R: ParameterValue,
        useHeatPort: bool = False,
        n: ParameterValue = 1.4,
        s_rel0: ParameterValue = 0.0,
        V_1: Number = ...,
        V_2: Number = ...,
        q_1: Number = ...,
        q_2: Number = ...,
        p_1: Number = ...,
        p_2: Number = ...,
    ) -> None: ...

class NES(TwoFlanges):
    """Nonlinear energy sink: a mass at flange_b on a damper and a cubic spring; nothing acts on flange_a.

    Without a frequency of its own it resonates with any, once the motion is large enough, and takes the
    energy.

    Source: A. F. Vakakis, O. V. Gendelman, Energy pumping in nonlinear mechanical oscillators: Part II,
    J. Appl. Mech. 68 (2001) 42-48.

    Args:
        m: mass [kg], above 0.
        k3: cubic stiffness [N/m3], above 0.
        d: damping constant [N.s/m], at least 0.
        k: linear stiffness [N/m], at least 0.
        mass: Mass.
        spring: CubicSpring.
        damper: Damper.
        s_rel: distance of the flanges [m], fixed start value.
        f: force on the structure [N], fixed start value.
    """

    m: Any
    """mass [kg], above 0"""
    k3: Any
    """cubic stiffness [N/m3], above 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    k: Any
    """linear stiffness [N/m], at least 0"""
    f: Any
    """force on the structure [N], fixed start value"""
    mass: Any
    """Mass"""
    spring: Any
    """CubicSpring"""
    damper: Any
    """Damper"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        k3: ParameterValue,
        d: ParameterValue,
        k: ParameterValue = 0.0,
        mass: Component = ...,
        spring: Component = ...,
        damper: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class PitchingBody(_HeavingBody):
    """A rigid body that heaves and pitches: m a = f_f + f_r + f_c, J alpha = l_r f_r - l_f f_f; small angles.

    Seen from the side with the nose at the front flange, theta > 0 lifts the tail. f_c acts on its centre.

    Args:
        m: mass [kg], above 0.
        l_f: from the centre of mass to the front axle [m], above 0.
        l_r: from the centre of mass to the rear axle [m], above 0.
        J: moment of inertia in pitch [kg.m2], above 0.
        s: height of the centre of mass [m], fixed start value.
        v: velocity of the centre of mass [m/s], fixed start value.
        a: acceleration of the centre of mass [m/s2], fixed start value.
        theta: pitch [rad], fixed start value.
        q: pitch rate [rad/s], fixed start value.
    """

    front: Any
    """front axle"""
    rear: Any
    """rear axle"""
    centre: Any
    """centre of mass"""
    J: Any
    """moment of inertia in pitch [kg.m2], above 0"""
    kinetic: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        l_f: ParameterValue,
        l_r: ParameterValue,
        J: ParameterValue,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
        theta: Number = ...,
        q: Number = ...,
    ) -> None: ...

class RigidBody(_HeavingBody):
    """A rigid body on four corners that heaves, pitches and rolls; small angles.

        m a = sum f,   J_y alpha = sum of -x f,   J_x beta = sum of y f,   s_corner = s - x theta + y phi

    x is forward, y to the left: corners at (l_f, w/2), (l_f, -w/2), (-l_r, w/2), (-l_r, -w/2).

    Args:
        m: mass [kg], above 0.
        l_f: from the centre of mass to the front axle [m], above 0.
        l_r: from the centre of mass to the rear axle [m], above 0.
        J_x: moment of inertia in roll [kg.m2], above 0.
        J_y: moment of inertia in pitch [kg.m2], above 0.
        w: track [m], above 0.
        s: height of the centre of mass [m], fixed start value.
        v: velocity of the centre of mass [m/s], fixed start value.
        a: acceleration of the centre of mass [m/s2], fixed start value.
        theta: pitch [rad], fixed start value.
        q: pitch rate [rad/s], fixed start value.
        phi: roll [rad], fixed start value.
        p: roll rate [rad/s], fixed start value.
    """

    front_left: Any
    """front left corner"""
    front_right: Any
    """front right corner"""
    rear_left: Any
    """rear left corner"""
    rear_right: Any
    """rear right corner"""
    J_x: Any
    """moment of inertia in roll [kg.m2], above 0"""
    J_y: Any
    """moment of inertia in pitch [kg.m2], above 0"""
    w: Any
    """track [m], above 0"""
    phi: Any
    """roll [rad], fixed start value"""
    p: Any
    """roll rate [rad/s], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        l_f: ParameterValue,
        l_r: ParameterValue,
        J_x: ParameterValue,
        J_y: ParameterValue,
        w: ParameterValue,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
        theta: Number = ...,
        q: Number = ...,
        phi: Number = ...,
        p: Number = ...,
    ) -> None: ...

class Shaker(TwoFlanges):
    """Electrodynamic shaker: a coil drives its armature, flange_b, on a suspension in the frame, flange_a.

    Bl i pushes armature and frame apart, L i' = u - R i - Bl v. Fed by a voltage `u`.

    Args:
        m: mass of the armature [kg], above 0.
        k: stiffness of the suspension [N/m], at least 0.
        d: damping constant of the suspension [N.s/m], at least 0.
        Bl: force constant, magnetic field times length of wire [N/A], not 0.
        R: resistance [V/A], above 0.
        L: inductance [V.s/A], above 0.
        u: voltage [V], a number, a function of time or Sampled data.
        armature: Mass.
        suspension: SpringDamper.
        coil: VoiceCoil.
        s_rel: distance of the flanges [m], fixed start value.
        i: current [A], fixed start value.
    """

    flange_b: Any
    """armature"""
    u: Any
    """voltage [V], a number, a function of time or Sampled data"""
    m: Any
    """mass of the armature [kg], above 0"""
    k: Any
    """stiffness of the suspension [N/m], at least 0"""
    d: Any
    """damping constant of the suspension [N.s/m], at least 0"""
    Bl: Any
    """force constant, magnetic field times length of wire [N/A], not 0"""
    R: Any
    """resistance [V/A], above 0"""
    L: Any
    """inductance [V.s/A], above 0"""
    i: Any
    """current [A], fixed start value"""
    armature: Any
    """Mass"""
    suspension: Any
    """SpringDamper"""
    coil: Any
    """VoiceCoil"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        k: ParameterValue,
        d: ParameterValue,
        Bl: ParameterValue,
        R: ParameterValue,
        L: ParameterValue,
        u: SignalValue = ...,
        armature: Component = ...,
        suspension: Component = ...,
        coil: Component = ...,
        s_rel: Number = ...,
        i: Number = ...,
    ) -> None: ...

class _TunedMass(TwoFlanges):
    m: Any
    """mass [kg], above 0"""
    k: Any
    """stiffness [N/m], at least 0"""
    d: Any
    """damping constant [N.s/m], at least 0"""
    f: Any
    """force on the structure [N], fixed start value"""
    mass: Any
    """Mass"""
    link: Any
    """SpringDamper"""
    def __init__(self, **values: Any) -> None: ...

class BallScrewInerter(FlywheelInerter):
    """A ball screw that turns a flywheel: f = b a_rel with b = (2 pi/lead)^2 J if both are ideal.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (1), (2).

    Example:
        >>> from inertance import DiskFlywheel, NutScrew
        >>> from inertance.machines import BallScrewInerter
        >>> inerter = BallScrewInerter(screw=NutScrew(lead=0.01), flywheel=DiskFlywheel(m=0.78, R=0.05))

    Args:
        screw: NutScrew.
        flywheel: DiskFlywheel.
        s_rel: distance of the flanges [m], fixed start value.
        f: force of the housing, positive when it pulls the flanges together [N], fixed start value.
    """

    screw: Any
    """NutScrew"""
    flywheel: Any
    """DiskFlywheel"""
    def __init__(
        self,
        *,
        screw: Component = ...,
        flywheel: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class BumpStop(Compliant):
    """Elastic stops at both ends of a travel: f = k e + k3 e^3, e how far s_rel is past s_min or s_max.

    It is zero between them, and smooth where it begins but for its slope.

    Args:
        k: stiffness at touch [N/m], at least 0.
        s_min: distance at which it is compressed [m].
        s_max: distance at which it is drawn out [m].
        k3: stiffening [N/m3], at least 0.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
    """

    k: Any
    """stiffness at touch [N/m], at least 0"""
    k3: Any
    """stiffening [N/m3], at least 0"""
    s_min: Any
    """distance at which it is compressed [m]"""
    s_max: Any
    """distance at which it is drawn out [m]"""
    potential: Any
    """stored energy [J]"""
    @property
    def e(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        s_min: ParameterValue,
        s_max: ParameterValue,
        k3: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class CrankInerter(FlywheelInerter):
    """A rod that turns a flywheel by a crank: an inertance that grows towards the dead centres.

    f = b a_rel + b' v_rel^2/2 with b = J/(ds/dphi)^2, which is J/r^2 where the crank stands across, phi =
    pi/2, and the rod is long. Start it there: `start={"...crank.phi": pi/2}`.

    Limits: between the dead centres, which stop the rod.

    Args:
        crank: SliderCrank.
        flywheel: DiskFlywheel.
        s_rel: distance of the flanges [m], fixed start value.
        f: force of the housing, positive when it pulls the flanges together [N], fixed start value.
    """

    crank: Any
    """SliderCrank"""
    flywheel: Any
    """DiskFlywheel"""
    def __init__(
        self,
        *,
        crank: Component = ...,
        flywheel: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class MechatronicInerter(FlywheelInerter):
    """A ball screw that turns a flywheel and a motor, whose terminals a circuit joins.

    b = (2 pi/lead)^2 (J + k^2 C) at low frequencies: the capacitor acts as an inertia, resistance and
    inductance in series with it.

    Source: F.-C. Wang, H.-A. Chan, Vehicle suspensions with a mechatronic network strut, Vehicle System
    Dynamics 49 (2011) 811-830.

    Args:
        screw: NutScrew.
        flywheel: DiskFlywheel.
        motor: ShuntedMotor.
        s_rel: distance of the flanges [m], fixed start value.
        f: force of the housing, positive when it pulls the flanges together [N], fixed start value.
    """

    screw: Any
    """NutScrew"""
    flywheel: Any
    """DiskFlywheel"""
    motor: Any
    """ShuntedMotor"""
    def __init__(
        self,
        *,
        screw: Component = ...,
        flywheel: Component = ...,
        motor: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class RackPinionInerter(FlywheelInerter):
    """A rack that turns a flywheel through its pinion: f = b a_rel with b = J/R^2.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, section III.

    Args:
        pinion: RackPinion.
        flywheel: DiskFlywheel.
        s_rel: distance of the flanges [m], fixed start value.
        f: force of the housing, positive when it pulls the flanges together [N], fixed start value.
    """

    pinion: Any
    """RackPinion"""
    flywheel: Any
    """DiskFlywheel"""
    def __init__(
        self,
        *,
        pinion: Component = ...,
        flywheel: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class TMD(_TunedMass):
    """Tuned mass damper: a mass on spring and damper at flange_b; nothing acts on flange_a.

    Source: J. P. Den Hartog, Mechanical Vibrations, 4th ed. (1956), section 3.3.

    Args:
        m: mass [kg], above 0.
        k: stiffness [N/m], at least 0.
        d: damping constant [N.s/m], at least 0.
        mass: Mass.
        link: SpringDamper.
        s_rel: distance of the flanges [m], fixed start value.
        f: force on the structure [N], fixed start value.
    """

    def __init__(
        self,
        *,
        m: ParameterValue,
        k: ParameterValue,
        d: ParameterValue,
        mass: Component = ...,
        link: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class TMDI(_TunedMass):
    """Tuned mass damper inerter: a mass on spring and damper at flange_b, and an inerter from it to flange_a.

    Source: Marian & Giaralis, Probabilistic Engineering Mechanics 38 (2014) 156-164.

    Args:
        m: mass [kg], above 0.
        k: stiffness [N/m], at least 0.
        d: damping constant [N.s/m], at least 0.
        mass: Mass.
        link: SpringDamper.
        b: inertance [kg], at least 0.
        inerter: Inerter.
        s_rel: distance of the flanges [m], fixed start value.
        f: force on the structure [N], fixed start value.
    """

    b: Any
    """inertance [kg], at least 0"""
    inerter: Any
    """Inerter"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        k: ParameterValue,
        d: ParameterValue,
        mass: Component = ...,
        link: Component = ...,
        b: ParameterValue = 0.0,
        inerter: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class GyroInerter(RackPinionInerter):
    """A rack that turns a gyroscope: b = (H^2/c + J_g + J_t)/R^2 while it precesses slowly and little.

    The precession's damper is a damper in series with that inertance, its inertia one more spring.

    Args:
        pinion: RackPinion.
        flywheel: Gyroscope.
        s_rel: distance of the flanges [m], fixed start value.
        f: force of the housing, positive when it pulls the flanges together [N], fixed start value.
    """

    flywheel: Any
    """Gyroscope"""
    def __init__(
        self,
        *,
        pinion: Component = ...,
        flywheel: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class PlanetaryFlywheelInerter(BallScrewInerter):
    """A ball screw that turns planets revolving in a ring: f = b a_rel, plus what real parts add.

    The prototype of the source is `ge_wang.planetary_inerter()`.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(27).

    Args:
        screw: CompliantNutScrew.
        flywheel: PlanetaryFlywheel.
        s_rel: distance of the flanges [m], fixed start value.
        f: force of the housing, positive when it pulls the flanges together [N], fixed start value.
    """

    screw: Any
    """CompliantNutScrew"""
    flywheel: Any
    """PlanetaryFlywheel"""
    def __init__(
        self,
        *,
        screw: Component = ...,
        flywheel: Component = ...,
        s_rel: Number = ...,
        f: Number = ...,
    ) -> None: ...

class BilinearDamper(Dissipative):
    """Damper with different slopes in bump and rebound: f = d_r v_rel apart, d_c v_rel together.

    Source: J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007), section 7.6.

    Args:
        d_c: damping constant in compression [N.s/m], at least 0.
        d_r: damping constant in rebound [N.s/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    d_c: Any
    """damping constant in compression [N.s/m], at least 0"""
    d_r: Any
    """damping constant in rebound [N.s/m], at least 0"""
    def __init__(
        self,
        *,
        d_c: ParameterValue,
        d_r: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class DigressiveDamper(Dissipative):
    """Damper whose slope falls from d to d_h as its valves open: f = d_h v + (d - d_h) v/(1 + |v|/v_k).

    Limits: alike in bump and rebound.

    Source: the shape of measured dampers, J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007), ch. 7.

    Args:
        d: damping constant at rest [N.s/m], at least 0.
        d_h: damping constant at high speed [N.s/m], at least 0.
        v_k: speed of the knee [m/s], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    d: Any
    """damping constant at rest [N.s/m], at least 0"""
    d_h: Any
    """damping constant at high speed [N.s/m], at least 0"""
    v_k: Any
    """speed of the knee [m/s], above 0"""
    def __init__(
        self,
        *,
        d: ParameterValue,
        d_h: ParameterValue,
        v_k: ParameterValue,
        useHeatPort: bool = False,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...

class OleoStrut(Dissipative):
    """Oleo-pneumatic shock strut: a gas spring, and oil pressed through an orifice.

        f = -p_0 A_a (V_0/(V_0 - A_a s))^n - rho A_h^3/(2 (C_d A_o)^2) der(s) |der(s)|,   s = s_rel0 - s_rel

    `flange_a` is the wheel's end. What keeps it from drawing out beyond s_rel0 is a stop beside it.

    Limits: no bearing friction, no cavitation; the orifice alike both ways. s stays below V_0/A_a.

    Source: Milwitzky & Cook, Analysis of landing-gear behavior, NACA Report 1154 (1953).

    Args:
        A_a: pneumatic area [m2], above 0.
        A_h: hydraulic area [m2], above 0.
        A_o: area of the orifice [m2], above 0.
        p_0: gas pressure when fully drawn out [Pa], above 0.
        V_0: gas volume when fully drawn out [m3], above 0.
        n: polytropic exponent of the gas, at least 1.
        C_d: coefficient of discharge, above 0.
        rho: density of the oil [kg/m3], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        s_rel0: length when fully drawn out [m].
        s_rel: distance of the flanges [m], fixed start value.
        f: force between the flanges, positive when it pulls them together [N], fixed start value.
        v_rel: relative velocity of the flanges [m/s], fixed start value.
    """

    A_a: Any
    """pneumatic area [m2], above 0"""
    A_h: Any
    """hydraulic area [m2], above 0"""
    A_o: Any
    """area of the orifice [m2], above 0"""
    p_0: Any
    """gas pressure when fully drawn out [Pa], above 0"""
    V_0: Any
    """gas volume when fully drawn out [m3], above 0"""
    n: Any
    """polytropic exponent of the gas, at least 1"""
    C_d: Any
    """coefficient of discharge, above 0"""
    rho: Any
    """density of the oil [kg/m3], above 0"""
    s_rel0: Any
    """length when fully drawn out [m]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def V(self) -> Any: ...
    @property
    def resistance(self) -> Any: ...
    @property
    def oil(self) -> Any: ...
    def __init__(
        self,
        *,
        A_a: ParameterValue,
        A_h: ParameterValue,
        A_o: ParameterValue,
        p_0: ParameterValue,
        V_0: ParameterValue,
        n: ParameterValue,
        C_d: ParameterValue,
        rho: ParameterValue,
        useHeatPort: bool = False,
        s_rel0: ParameterValue = 0.0,
        s_rel: Number = ...,
        f: Number = ...,
        v_rel: Number = ...,
    ) -> None: ...
