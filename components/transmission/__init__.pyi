"""Elements between turning and sliding, and the flywheels they drive."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any

import numpy as np

from ..flanks import SlidingFlanks
from ..language import Component, Number, ParameterValue, SignalValue
from ..lossy import Lossy
from ..stickslip import StickSlip

class CompliantNutScrew(Component):
    """A ball screw with nut mass, axial compliance, clearance and friction.

    Nut, axial contact and an ideal screw stand in a row; the screw rubs on the housing. With nut
    at x1, housing at x2 and screw at x3:

        F = F_d + m_r x1''
        F_d = P + D behind the clearance eps,  P = k (x1 - x3),  D = d (x1' - x3')
        theta = (2 pi/lead)(x3 - x2),  T = (lead/2 pi) F_d - friction

    `friction` is any rotational friction element; without one the screw turns freely.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (22)-(27).

    Args:
        lead: travel of the nut for one turn of the screw [m], above 0.
        m_r: mass of nut and rod [kg], above 0.
        k: axial stiffness [N/m], at least 0.
        d: axial damping [N.s/m], at least 0.
        eps: half the axial clearance of nut and bearings [m], at least 0.
        nut: Mass.
        contact: Backlash.
        thread: NutScrew.
        friction: Damper.
    """

    flange_r: Any
    """the screw"""
    flange_t: Any
    """the nut"""
    support_r: Any
    """housing, against turning"""
    support_t: Any
    """housing, against sliding"""
    lead: Any
    """travel of the nut for one turn of the screw [m], above 0"""
    m_r: Any
    """mass of nut and rod [kg], above 0"""
    k: Any
    """axial stiffness [N/m], at least 0"""
    d: Any
    """axial damping [N.s/m], at least 0"""
    eps: Any
    """half the axial clearance of nut and bearings [m], at least 0"""
    nut: Any
    """Mass"""
    contact: Any
    """Backlash"""
    thread: Any
    """NutScrew"""
    friction: Any
    """Damper"""
    def __init__(
        self,
        *,
        lead: ParameterValue,
        m_r: ParameterValue,
        k: ParameterValue,
        d: ParameterValue,
        eps: ParameterValue = 0.0,
        nut: Component = ...,
        contact: Component = ...,
        thread: Component = ...,
        friction: Component = ...,
    ) -> None: ...

class Flywheel(Component):
    """What turns with a screw inside a housing; angle and speed are those of `flange`."""

    flange: Any
    """where the screw is joined"""
    support: Any
    """housing"""
    w: Any
    """angular velocity [rad/s], fixed start value"""
    a: Any
    """angular acceleration [rad/s2], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class PlanetGear(Component):
    """The parameters of a planet on its pin and in its ring.

    Args:
        R: pitch radius of the ring [m], above 0.
        r: pitch radius of the planet [m], above 0.
        J_p: inertia of the planet in spin [kg.m2], above 0.
        J_r: inertia of the planet in revolution [kg.m2], at least 0.
        k_r: mesh stiffness [N/m], at least 0.
        c_r: mesh damping [N.s/m], at least 0.
        alpha: pressure angle [rad], at least 0.
        g_r: half the mesh clearance [m], at least 0.
        T_pm: Coulomb friction of the planet [N.m], at least 0.
        T_pv: viscous friction of the planet [N.m.s/rad], at least 0.
    """

    R: Any
    """pitch radius of the ring [m], above 0"""
    r: Any
    """pitch radius of the planet [m], above 0"""
    alpha: Any
    """pressure angle [rad], at least 0"""
    J_p: Any
    """inertia of the planet in spin [kg.m2], above 0"""
    J_r: Any
    """inertia of the planet in revolution [kg.m2], at least 0"""
    k_r: Any
    """mesh stiffness [N/m], at least 0"""
    c_r: Any
    """mesh damping [N.s/m], at least 0"""
    g_r: Any
    """half the mesh clearance [m], at least 0"""
    T_pm: Any
    """Coulomb friction of the planet [N.m], at least 0"""
    T_pv: Any
    """viscous friction of the planet [N.m.s/rad], at least 0"""
    def __init__(
        self,
        *,
        R: ParameterValue,
        r: ParameterValue,
        J_p: ParameterValue,
        J_r: ParameterValue,
        k_r: ParameterValue,
        c_r: ParameterValue,
        alpha: ParameterValue = 0.3490658503988659,
        g_r: ParameterValue = 0.0,
        T_pm: ParameterValue = 0.0,
        T_pv: ParameterValue = 0.0,
    ) -> None: ...

class Transmission(Component):
    """A turning flange and a sliding one, each with a housing that takes the reaction."""

    flange_r: Any
    """what turns"""
    flange_t: Any
    """what slides"""
    support_r: Any
    """housing, against turning"""
    support_t: Any
    """housing, against sliding"""
    phi: Any
    """angle against the housing [rad], fixed start value"""
    w: Any
    """speed of turning against the housing [rad/s], fixed start value"""
    s: Any
    """travel against the housing [m], fixed start value"""
    def __init__(self, **values: Any) -> None: ...

class Vehicle(Component):
    """A vehicle on a road: (m + J/R^2) a = tau/R + f - air - rolling - m g sin(alpha), s = R phi.

    air = Cd A rho/2 (v - vWind) |v - vWind|, rolling = Cr m g cos(alpha) with the sign of v, which goes
    through zero in a straight line between -vReg and vReg; tan(alpha) is the inclination. It is driven at
    flangeR, and may be coupled at flangeT; each may stay free.

    Source: MSL Translational.Components.Vehicle.

    Example:
        >>> from inertance import Vehicle
        >>> car = Vehicle(m=1200.0, J=2.0, R=0.3, A=2.0, Cd=0.3)

    Args:
        m: mass [kg], above 0.
        J: inertia of what turns with the wheels [kg.m2], above 0.
        R: rolling radius [m], above 0.
        g: gravity [m/s2], at least 0.
        A: cross-section [m2], at least 0.
        Cd: drag coefficient, at least 0.
        rho: density of the air [kg/m3], at least 0.
        useWindInput: whether the wind comes in as vWind.
        vWind: speed of the wind [m/s], a number, a function of time or Sampled data.
        vWindConstant: speed of the wind [m/s].
        useCrInput: whether Cr comes in as cr.
        cr: rolling resistance coefficient, a number, a function of time or Sampled data.
        CrConstant: rolling resistance coefficient, at least 0.
        vReg: speed below which rolling resistance is rounded [m/s], above 0.
        useInclinationInput: whether the slope comes in as inclination.
        inclination: tangent of the slope, a number, a function of time or Sampled data.
        inclinationConstant: tangent of the slope.
        mass: Mass.
        inertia: Inertia.
        wheel: RollingWheel.
        drag: QuadraticDamper.
        s: position [m], fixed start value.
        v: speed [m/s], fixed start value.
        a: acceleration [m/s2], fixed start value.
    """

    flangeR: Any
    """the wheel"""
    flangeT: Any
    """the vehicle"""
    m: Any
    """mass [kg], above 0"""
    g: Any
    """gravity [m/s2], at least 0"""
    J: Any
    """inertia of what turns with the wheels [kg.m2], above 0"""
    R: Any
    """rolling radius [m], above 0"""
    A: Any
    """cross-section [m2], at least 0"""
    Cd: Any
    """drag coefficient, at least 0"""
    rho: Any
    """density of the air [kg/m3], at least 0"""
    useWindInput: Any
    """whether the wind comes in as vWind"""
    vWind: Any
    """speed of the wind [m/s], a number, a function of time or Sampled data"""
    vWindConstant: Any
    """speed of the wind [m/s]"""
    useCrInput: Any
    """whether Cr comes in as cr"""
    cr: Any
    """rolling resistance coefficient, a number, a function of time or Sampled data"""
    CrConstant: Any
    """rolling resistance coefficient, at least 0"""
    vReg: Any
    """speed below which rolling resistance is rounded [m/s], above 0"""
    useInclinationInput: Any
    """whether the slope comes in as inclination"""
    inclination: Any
    """tangent of the slope, a number, a function of time or Sampled data"""
    inclinationConstant: Any
    """tangent of the slope"""
    s: Any
    """position [m], fixed start value"""
    v: Any
    """speed [m/s], fixed start value"""
    a: Any
    """acceleration [m/s2], fixed start value"""
    mass: Any
    """Mass"""
    inertia: Any
    """Inertia"""
    wheel: Any
    """RollingWheel"""
    drag: Any
    """QuadraticDamper"""
    def __init__(
        self,
        *,
        m: ParameterValue,
        J: ParameterValue,
        R: ParameterValue,
        g: ParameterValue = 9.80665,
        A: ParameterValue = 1.0,
        Cd: ParameterValue = 0.5,
        rho: ParameterValue = 1.2,
        useWindInput: bool = False,
        vWind: SignalValue = ...,
        vWindConstant: ParameterValue = 0.0,
        useCrInput: bool = False,
        cr: SignalValue = ...,
        CrConstant: ParameterValue = 0.015,
        vReg: ParameterValue = 0.001,
        useInclinationInput: bool = False,
        inclination: SignalValue = ...,
        inclinationConstant: ParameterValue = 0.0,
        mass: Component = ...,
        inertia: Component = ...,
        wheel: Component = ...,
        drag: Component = ...,
        s: Number = ...,
        v: Number = ...,
        a: Number = ...,
        **parts: Component,
    ) -> None: ...

class Crank(Transmission):
    """A shaft that drives a slider to and fro without loss, by its angle and speed."""

    w: Any
    """speed against the housing [rad/s], fixed start value"""
    lossPower: Any
    """dissipated power [W]"""
    def __init__(self, **values: Any) -> None: ...

class DiskFlywheel(Flywheel):
    """A homogeneous disk: (m R^2/2 + J_s) a = tau; its housing feels nothing.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (14).

    Args:
        m: mass [kg], above 0.
        R: radius [m], above 0.
        J_s: inertia of the screw that turns with it [kg.m2], at least 0.
        w: angular velocity [rad/s], fixed start value.
        a: angular acceleration [rad/s2], fixed start value.
    """

    m: Any
    """mass [kg], above 0"""
    R: Any
    """radius [m], above 0"""
    J_s: Any
    """inertia of the screw that turns with it [kg.m2], at least 0"""
    kinetic: Any
    """stored energy [J]"""
    @property
    def J_e(self) -> Any: ...
    def __init__(
        self,
        *,
        m: ParameterValue,
        R: ParameterValue,
        J_s: ParameterValue = 0.0,
        w: Number = ...,
        a: Number = ...,
    ) -> None: ...

class IdealPlanetaryFlywheel(Flywheel):
    """N planets that roll in a ring without compliance, clearance or friction: J_e a = tau.

    J_e = J_s + N (J_p ((R - r)/r)^2 + J_r). The ring, fixed to the housing, turns planets by
    J_p ((R - r)/r) (R/r) a each.

    Limits: the housing may move but must not accelerate in turning; `kinetic` holds where it does not turn.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (5), (7).

    Args:
        R: pitch radius of the ring [m], above 0.
        r: pitch radius of a planet [m], above 0.
        J_s: inertia of bracket and screw [kg.m2], at least 0.
        J_p: inertia of a planet in spin [kg.m2], at least 0.
        J_r: inertia of a planet in revolution [kg.m2], at least 0.
        N: number of planets.
        w: angular velocity [rad/s], fixed start value.
        a: angular acceleration [rad/s2], fixed start value.
    """

    N: Any
    """number of planets"""
    R: Any
    """pitch radius of the ring [m], above 0"""
    r: Any
    """pitch radius of a planet [m], above 0"""
    J_s: Any
    """inertia of bracket and screw [kg.m2], at least 0"""
    J_p: Any
    """inertia of a planet in spin [kg.m2], at least 0"""
    J_r: Any
    """inertia of a planet in revolution [kg.m2], at least 0"""
    kinetic: Any
    """stored energy [J]"""
    @property
    def spin(self) -> Any: ...
    @property
    def J_e(self) -> Any: ...
    def __init__(
        self,
        *,
        R: ParameterValue,
        r: ParameterValue,
        J_s: ParameterValue,
        J_p: ParameterValue,
        J_r: ParameterValue,
        N: int | np.integer[Any] = 4,
        w: Number = ...,
        a: Number = ...,
    ) -> None: ...

class NutScrew(Transmission):
    """Ideal ball screw: phi = (2 pi/lead) s and f + (2 pi/lead) tau = 0.

    `flange_t` is the nut if the nut slides and the screw turns in the housing's bearing.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (2), (27).

    Args:
        lead: travel of the nut for one turn of the screw [m], above 0.
        phi: angle against the housing [rad], fixed start value.
        w: speed of turning against the housing [rad/s], fixed start value.
        s: travel against the housing [m], fixed start value.
    """

    lead: Any
    """travel of the nut for one turn of the screw [m], above 0"""
    def __init__(
        self,
        *,
        lead: ParameterValue,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
    ) -> None: ...

class PlanetaryFlywheel(PlanetGear):
    """A bracket with N planets that revolve and spin in a ring gear.

    Lumped, one coordinate stands for all planets, which are equal. With `lumped=False` each has its
    own mesh and coordinate, is named `planet_1` to `planet_N`, and may be replaced by one with other
    parameters.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(21).

    Args:
        R: pitch radius of the ring [m], above 0.
        r: pitch radius of the planet [m], above 0.
        J_p: inertia of the planet in spin [kg.m2], above 0.
        J_r: inertia of the planet in revolution [kg.m2], at least 0.
        k_r: mesh stiffness [N/m], at least 0.
        c_r: mesh damping [N.s/m], at least 0.
        J_s: inertia of bracket and screw [kg.m2], above 0.
        alpha: pressure angle [rad], at least 0.
        g_r: half the mesh clearance [m], at least 0.
        T_pm: Coulomb friction of the planet [N.m], at least 0.
        T_pv: viscous friction of the planet [N.m.s/rad], at least 0.
        N: number of planets.
        lumped: whether one coordinate stands for all planets.
        regularised: speed of spin [rad/s] over which planet friction is smoothed.
        bracket: Inertia.
    """

    flange: Any
    """where the screw is joined"""
    support: Any
    """housing that holds the ring"""
    N: Any
    """number of planets"""
    lumped: Any
    """whether one coordinate stands for all planets"""
    regularised: Any
    """speed of spin [rad/s] over which planet friction is smoothed"""
    J_s: Any
    """inertia of bracket and screw [kg.m2], above 0"""
    bracket: Any
    """Inertia"""
    def __init__(
        self,
        *,
        R: ParameterValue,
        r: ParameterValue,
        J_p: ParameterValue,
        J_r: ParameterValue,
        k_r: ParameterValue,
        c_r: ParameterValue,
        J_s: ParameterValue,
        alpha: ParameterValue = 0.3490658503988659,
        g_r: ParameterValue = 0.0,
        T_pm: ParameterValue = 0.0,
        T_pv: ParameterValue = 0.0,
        N: int | np.integer[Any] = 4,
        lumped: bool = True,
        regularised: Any = None,
        bracket: Component = ...,
        **parts: Component,
    ) -> None: ...

class RollingWheel(Transmission):
    """A wheel that rolls without slip: s = R phi and R f + tau = 0.

    `flange_t` is its hub, `support_r` the body that carries the torque's reaction, `support_t` the road.

    Source: MSL Rotational.Components.IdealRollingWheel.

    Args:
        R: rolling radius [m], above 0.
        phi: angle against the housing [rad], fixed start value.
        w: speed of turning against the housing [rad/s], fixed start value.
        s: travel against the housing [m], fixed start value.
    """

    R: Any
    """rolling radius [m], above 0"""
    def __init__(
        self,
        *,
        R: ParameterValue,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
    ) -> None: ...

class Cam(Crank):
    """Grooved cam: s = h(phi) by points over one turn, no loss: tau + h'(phi) f = 0.

    Between the points h is a cubic curve whose second derivative is steady, also from turn to turn, so that
    accelerations do not jump. A follower that may lift off is an `ElastoGap` or `HardStop` behind it.

    Args:
        table: rows (angle [rad], lift [m]) over one turn.
        phi: angle against the housing [rad], fixed start value.
        w: speed against the housing [rad/s], fixed start value.
        s: travel against the housing [m], fixed start value.
    """

    table: Any
    """rows (angle [rad], lift [m]) over one turn"""
    def __init__(
        self,
        *,
        table: Any = ...,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
    ) -> None: ...

class Gyroscope(Lossy, Flywheel):
    """A spinning rotor in two gimbals: turned about one, it precesses about the other against a spring.

    With the angle alpha and speed w_p of precession, and the momentum of spin H = J_s w_s, which its bearings
    let it keep:

        tau = (J_g + J_t cos(alpha)^2) a - J_t sin(2 alpha) w_p w + H cos(alpha) w_p
        (J_t + J_i) w_p' + J_t sin(2 alpha)/2 w^2 + d w_p + c alpha = H cos(alpha) w

    A gyrator: while alpha is small the spring c is an inertia of H^2/c, the damper d a damper of H^2/d, and
    the inertia J_t + J_i a stiffness of H^2/(J_t + J_i).

    Limits: no friction but d; the housing takes torques about the other two axes, which a second rotor that
    spins the other way would cancel.

    Source: Lagrange's equations of the two gimbals, the cyclic angle of spin eliminated (Routh).

    Args:
        J_s: inertia of the rotor about its axis of spin [kg.m2], above 0.
        w_s: speed of spin, with the gimbals at rest [rad/s].
        J_t: inertia of the rotor across its axis of spin [kg.m2], above 0.
        c: stiffness against precession [N.m/rad], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        J_g: inertia of both gimbals about the flange's axis [kg.m2], at least 0.
        J_i: inertia of the inner gimbal about the axis of precession [kg.m2], at least 0.
        d: damping of precession [N.m.s/rad], at least 0.
        w: angular velocity [rad/s], fixed start value.
        a: angular acceleration [rad/s2], fixed start value.
        alpha: angle of precession [rad], fixed start value.
        w_p: speed of precession [rad/s], fixed start value.
    """

    J_s: Any
    """inertia of the rotor about its axis of spin [kg.m2], above 0"""
    w_s: Any
    """speed of spin, with the gimbals at rest [rad/s]"""
    J_t: Any
    """inertia of the rotor across its axis of spin [kg.m2], above 0"""
    J_g: Any
    """inertia of both gimbals about the flange's axis [kg.m2], at least 0"""
    J_i: Any
    """inertia of the inner gimbal about the axis of precession [kg.m2], at least 0"""
    c: Any
    """stiffness against precession [N.m/rad], at least 0"""
    d: Any
    """damping of precession [N.m.s/rad], at least 0"""
    alpha: Any
    """angle of precession [rad], fixed start value"""
    w_p: Any
    """speed of precession [rad/s], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    @property
    def H(self) -> Any: ...
    @property
    def J(self) -> Any: ...
    def __init__(
        self,
        *,
        J_s: ParameterValue,
        w_s: ParameterValue,
        J_t: ParameterValue,
        c: ParameterValue,
        useHeatPort: bool = False,
        J_g: ParameterValue = 0.0,
        J_i: ParameterValue = 0.0,
        d: ParameterValue = 0.0,
        w: Number = ...,
        a: Number = ...,
        alpha: Number = ...,
        w_p: Number = ...,
    ) -> None: ...

class RackPinion(RollingWheel):
    """A pinion of pitch radius R that rolls on a rack: s = R phi and R f + tau = 0.

    Source: MSL Rotational.Components.IdealGearR2T with ratio 1/R.

    Args:
        R: rolling radius [m], above 0.
        phi: angle against the housing [rad], fixed start value.
        w: speed of turning against the housing [rad/s], fixed start value.
        s: travel against the housing [m], fixed start value.
    """

    def __init__(
        self,
        *,
        R: ParameterValue,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
    ) -> None: ...

class SliderCrank(Crank):
    """Crank and connecting rod at any angle: s = r cos(phi) + sqrt(l^2 - (r sin(phi) - e)^2), no loss.

    s is the distance of the slider from the crank's axis, largest at phi = 0 without offset e;
    tau + ds/dphi f = 0, so that power is kept.

    Limits: l must exceed r + |e|. In the dead centres the slider cannot turn the crank.

    Args:
        r: radius of the crank [m], above 0.
        l: length of the connecting rod [m], above 0.
        e: offset of the slider's line from the crank's axis [m].
        phi: angle against the housing [rad], fixed start value.
        w: speed against the housing [rad/s], fixed start value.
        s: travel against the housing [m], fixed start value.
    """

    r: Any
    """radius of the crank [m], above 0"""
    l: Any
    """length of the connecting rod [m], above 0"""
    e: Any
    """offset of the slider's line from the crank's axis [m]"""
    def __init__(
        self,
        *,
        r: ParameterValue,
        l: ParameterValue,
        e: ParameterValue = 0.0,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
    ) -> None: ...

class Tyre(Transmission, Lossy):
    """Tyre that slips along the road: f_x = D sin(C atan(B kappa - E (B kappa - atan(B kappa)))), D = mu F_z.

    The slip kappa builds up over the relaxation length: sigma kappa' = R w - v - |v| kappa, also at rest.
    f_x drives `flange_t`, the hub, forward and brakes `flange_r`, the rim, with R f_x. With a belt of its own
    it is a `machines.RigidRingTyre`.

    The carcass stores sigma times the integral of f_x over kappa; what is lost is f_x |v| kappa.

    Limits: no camber, no side slip, no rolling resistance; F_z is constant.

    Source: H. B. Pacejka, Tyre and Vehicle Dynamics, 3rd ed. (2012), the magic formula and transient slip.

    Args:
        R: effective rolling radius [m], above 0.
        F_z: load on the tyre [N], at least 0.
        mu: largest f_x over F_z, at least 0.
        B: stiffness factor, above 0.
        C: shape factor, above 0.
        sigma: relaxation length [m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        E: curvature factor, at most 1.
        phi: angle against the housing [rad], fixed start value.
        w: speed of the rim [rad/s], fixed start value.
        s: travel over the road [m], fixed start value.
        v: speed over the road [m/s], fixed start value.
        kappa: slip, fixed start value.
        f_x: driving force [N], fixed start value.
    """

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
    """relaxation length [m], above 0"""
    w: Any
    """speed of the rim [rad/s], fixed start value"""
    v: Any
    """speed over the road [m/s], fixed start value"""
    s: Any
    """travel over the road [m], fixed start value"""
    kappa: Any
    """slip, fixed start value"""
    f_x: Any
    """driving force [N], fixed start value"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    def force(self, kappa: Any) -> Any: ...
    @property
    def area(self) -> Any: ...
    def __init__(
        self,
        *,
        R: ParameterValue,
        F_z: ParameterValue,
        mu: ParameterValue,
        B: ParameterValue,
        C: ParameterValue,
        sigma: ParameterValue,
        useHeatPort: bool = False,
        E: ParameterValue = 0.0,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
        v: Number = ...,
        kappa: Number = ...,
        f_x: Number = ...,
    ) -> None: ...

class LeadScrew(SlidingFlanks, Transmission):
    """Screw whose flanks slide under load: phi = (2 pi/lead) s; self-locking where mu > lead/(pi d_m).

    f + (2 pi/lead) (tau - tau_loss) = 0. Screw driving, the efficiency is tan(lambda)/tan(lambda + rho) with
    tan(lambda) = lead/(pi d_m) and tan(rho) = mu. At rest the load is truly held. With a flank angle alpha,
    mu is the friction coefficient over cos(alpha).

    Limits: as for `SlidingFlanks`: mu tan(lambda) below 1, no locking by inertia alone.

    Source: mechanics of the inclined plane, J. E. Shigley, Mechanical Engineering Design.

    Args:
        mu: friction coefficient of the flanks, at least 0.
        lead: travel of the nut for one turn of the screw [m], above 0.
        d_m: mean diameter of the thread [m], above 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        tau_bf: friction torque of the bearings [N.m], at least 0.
        phi: angle against the housing [rad], fixed start value.
        w: speed of the screw against the housing [rad/s], fixed start value.
        s: travel against the housing [m], fixed start value.
        tau_loss: torque lost, seen where it is driven [N.m], fixed start value.
        a: acceleration of the screw against the housing [rad/s2], fixed start value.
    """

    lead: Any
    """travel of the nut for one turn of the screw [m], above 0"""
    d_m: Any
    """mean diameter of the thread [m], above 0"""
    w: Any
    """speed of the screw against the housing [rad/s], fixed start value"""
    a: Any
    """acceleration of the screw against the housing [rad/s2], fixed start value"""
    @property
    def load_torque(self) -> Any: ...
    @property
    def slope(self) -> Any: ...
    def __init__(
        self,
        *,
        mu: ParameterValue,
        lead: ParameterValue,
        d_m: ParameterValue,
        useHeatPort: bool = False,
        tau_bf: ParameterValue = 0.0,
        phi: Number = ...,
        w: Number = ...,
        s: Number = ...,
        tau_loss: Number = ...,
        a: Number = ...,
    ) -> None: ...

class Planet(PlanetGear, StickSlip):
    """Planets on a bracket that mesh with a ring; one coordinate stands for `count` equal ones.

    Along the line of action, with r_c = R - r and r_b = r cos(alpha):

        s_rel = x_s - x_p,   x_s = r_c cos(alpha) theta_s,   x_p = r_b theta_p
        P = k_r s_rel,   D = c_r v_rel
        F_p = P + D behind the clearance g_r
        J_p theta_p'' = F_p r_b - T_fp,   T_fp = T_pm sgn(theta_p') + T_pv theta_p'

    theta_s is the bracket's angle and theta_p the planet's spin, both against the ring and counted
    in opposite senses. At rest T_pm truly sticks; see `StickSlip` for `regularised` [rad/s].

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(21).

    Args:
        R: pitch radius of the ring [m], above 0.
        r: pitch radius of the planet [m], above 0.
        J_p: inertia of the planet in spin [kg.m2], above 0.
        J_r: inertia of the planet in revolution [kg.m2], at least 0.
        k_r: mesh stiffness [N/m], at least 0.
        c_r: mesh damping [N.s/m], at least 0.
        useHeatPort: whether its losses leave as heat through heatPort.
        peak: break-away resistance over sliding resistance at rest, at least 1.
        regularised: speed over which the sign of the motion is smoothed (no events, but creeps when it should
            stick).
        alpha: pressure angle [rad], at least 0.
        g_r: half the mesh clearance [m], at least 0.
        T_pm: Coulomb friction of the planet [N.m], at least 0.
        T_pv: viscous friction of the planet [N.m.s/rad], at least 0.
        count: number of equal planets, above 0.
        theta_s: angle of the bracket against the ring [rad], fixed start value.
        theta_p: spin of the planet against the ring [rad], fixed start value.
        w_s: speed of the bracket against the ring [rad/s], fixed start value.
        w_p: speed of spin against the ring [rad/s], fixed start value.
        w_ring: speed of the ring [rad/s], fixed start value.
        a_s: acceleration of the bracket against the ring [rad/s2], fixed start value.
        a_p: acceleration of spin against the ring [rad/s2], fixed start value.
        a_ring: acceleration of the ring [rad/s2], fixed start value.
        s_rel: approach of the flanks along the line of action [m], fixed start value.
        v_rel: speed of approach [m/s], fixed start value.
        F_p: mesh force along the line of action [N], fixed start value.
        T_fp: friction torque on the planet [N.m], fixed start value.
    """

    bracket: Any
    """bracket that carries the pin"""
    ring: Any
    """ring gear, fixed to the housing"""
    count: Any
    """number of equal planets, above 0"""
    theta_s: Any
    """angle of the bracket against the ring [rad], fixed start value"""
    theta_p: Any
    """spin of the planet against the ring [rad], fixed start value"""
    w_s: Any
    """speed of the bracket against the ring [rad/s], fixed start value"""
    w_p: Any
    """speed of spin against the ring [rad/s], fixed start value"""
    w_ring: Any
    """speed of the ring [rad/s], fixed start value"""
    a_s: Any
    """acceleration of the bracket against the ring [rad/s2], fixed start value"""
    a_p: Any
    """acceleration of spin against the ring [rad/s2], fixed start value"""
    a_ring: Any
    """acceleration of the ring [rad/s2], fixed start value"""
    s_rel: Any
    """approach of the flanks along the line of action [m], fixed start value"""
    v_rel: Any
    """speed of approach [m/s], fixed start value"""
    F_p: Any
    """mesh force along the line of action [N], fixed start value"""
    T_fp: Any
    """friction torque on the planet [N.m], fixed start value"""
    kinetic: Any
    """stored energy [J]"""
    potential: Any
    """stored energy [J]"""
    lossPower: Any
    """dissipated power [W]"""
    quantities: Any
    @property
    def elastic(self) -> Any: ...
    def sliding(self, speed: Any) -> Any: ...
    def __init__(
        self,
        *,
        R: ParameterValue,
        r: ParameterValue,
        J_p: ParameterValue,
        J_r: ParameterValue,
        k_r: ParameterValue,
        c_r: ParameterValue,
        useHeatPort: bool = False,
        peak: ParameterValue = 1.0,
        regularised: Any = None,
        alpha: ParameterValue = 0.3490658503988659,
        g_r: ParameterValue = 0.0,
        T_pm: ParameterValue = 0.0,
        T_pv: ParameterValue = 0.0,
        count: ParameterValue = 1.0,
        theta_s: Number = ...,
        theta_p: Number = ...,
        w_s: Number = ...,
        w_p: Number = ...,
        w_ring: Number = ...,
        a_s: Number = ...,
        a_p: Number = ...,
        a_ring: Number = ...,
        s_rel: Number = ...,
        v_rel: Number = ...,
        F_p: Number = ...,
        T_fp: Number = ...,
    ) -> None: ...
