"""FMUs of all elements of docs/catalogue.md, several to a machine: held against their networks."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import fmpy
import inertance as ia
import pytest
from inertance import machines, rotational

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
CURVE = ((-0.02, -300.0), (-0.005, -40.0), (0.0, 0.0), (0.01, 90.0), (0.02, 400.0))
GRID = tuple((s, v, 800 * s + 20 * v + 2e3 * s * v) for s in (-0.02, 0.0, 0.02) for v in (-1.0, 0.0, 1.0))


def beside(*elements: Any, **body: float) -> ia.Network:
    """A mass, or a wheel, that all elements hold."""
    turning = isinstance(elements[0], rotational.TwoFlanges)
    kind = rotational if turning else ia
    mass = rotational.Inertia(J=0.5, **body) if turning else ia.Mass(m=2.0, **body)
    named = {type(element).__name__.lower(): element for element in elements}
    net = ia.Network("beside", wall=kind.Fixed(), body=mass, **named)
    for name in named:
        net.connect(net.wall.flange, getattr(net, name).flange_a)
        net.connect(getattr(net, name).flange_b, net.body.flange)
    return net


def rubber() -> tuple[ia.Network, dict[str, float]]:
    return beside(
        ia.TabulatedSpring(table=CURVE, interpolation="smooth"),
        ia.TabulatedDamper(table=tuple((s * 50, f / 10) for s, f in CURVE), interpolation="smooth"),
        ia.MapSpringDamper(table=GRID, interpolation="smooth"),
        ia.TabulatedForce(table=GRID, odd=True),
        ia.TabulatedForce(table=CURVE, over="position", interpolation="smooth"),
        ia.Maxwell(k=500.0, d=10.0),
        ia.Zener(k_0=200.0, k=300.0, d=8.0),
        ia.FractionalDamper(c=100.0, alpha=0.4, w_low=0.1, decades=4.0, n=3),
        ia.Iwan(k=200.0, s_y=5e-3, p=1.0, cells=3),
        ia.AirSpring(A=1e-3, p_0=2e5, V_0=1e-4),
        ia.WireRope(k_1=100.0, k_2=1e3, f_y=2.0, s_y=2e-3, n=1.5),
        ia.ObliqueSprings(k=200.0, l_0=0.05, a=0.04),
        s=0.008,
        v=0.2,
    ), {}


def dampers() -> tuple[ia.Network, dict[str, float]]:
    hysteresis: Any = {
        "alpha_a": 900.0, "alpha_b": 2e3, "c_0a": 10.0, "c_0b": 15.0, "eta": 90.0, "A": 30.0, "beta": 4e3,
        "gamma": 3e3, "n": 1.0,
    }  # fmt: skip
    return beside(
        ia.Spring(k=4e3),
        ia.MonotubeDamper(A_p=1e-3, A_r=8e-4, A_e=4e-5, A_c=8e-5, V_r=1e-4, V_0=1e-4, p_0=2e6),
        ia.FluidInerter(A_p=1e-3, D=0.012, L=2.0, D_h=0.2),
        ia.BoucWenDamper(**hysteresis),
        ia.SpencerDamper(**hysteresis, c_1a=200.0, c_1b=50.0, k_0=100.0, k_1=50.0, s_rel0=0.001),
        ia.VariableInerter(b=2.0, b_u=-0.6, T=0.05),
        ia.VoiceCoil(Bl=8.0, R=3.0, L=2e-3),
        ia.LuGreFriction(f_c=2.0, f_s=3.0, v_s=0.05, sigma_0=2e3, sigma_1=3.0, sigma_2=0.4),
        ia.Rope(k=2e3, d=10.0, s_rel0=0.004),
        s=0.01,
        v=-0.1,
    ), {"boucwendamper.u": 0.4, "spencerdamper.u": 0.7, "variableinerter.u": 1.0, "voicecoil.u": 5.0}


def drive() -> tuple[ia.Network, dict[str, float]]:
    """A motor, from its current limit on, through all that gives way to two wheels."""
    net = ia.Network(
        "drive",
        motor=rotational.DCMotor(k=0.1, R=0.5, L=2e-3, u_max=24.0, i_max=20.0),
        rotor=rotational.Inertia(J=1e-3),
        drive=rotational.HarmonicDrive(ratio=5.0, c=400.0, c3=100.0, d=0.5, e_1=2e-3),
        hub=rotational.Inertia(J=0.02),
        joint=rotational.UniversalJoint(beta=0.3),
        shaft=rotational.ModalShaft(J=0.02, c=300.0, d=0.2, modes=2),
        belt=rotational.BeltDrive(r_a=0.05, r_b=0.08, k=2e4, d=30.0, e_0=2e-3),
        axle=rotational.Differential(ratio=1.5),
        left=rotational.LumpedShaft(J=0.01, c=200.0, d=0.1, segments=2),
        rub=rotational.LuGreFriction(  # settles slowly: once it has, its rate is rounding alone
            tau_c=0.5, w_s=0.1, sigma_0=1.0, sigma_1=0.2, sigma_2=0.01
        ),
        wheel=rotational.Inertia(J=0.05),
        shunt=rotational.ShuntedMotor(k=0.3, L=0.01, R=0.5, elastance=5.0),
        wall=rotational.Fixed(),
    )
    net.connect(net.motor.flange, net.rotor.flange, net.drive.flange_a)
    net.connect(net.drive.flange_b, net.hub.flange, net.joint.flange_a)
    net.connect(net.joint.flange_b, net.shaft.flange_a).connect(net.shaft.flange_b, net.belt.flange_a)
    net.connect(net.belt.flange_b, net.axle.flange).connect(net.axle.left, net.left.flange_a)
    net.connect(net.left.flange_b, net.rub.flange_b, net.shunt.flange_b)
    net.connect(net.axle.right, net.wheel.flange)
    return net.connect(net.wall.flange, net.rub.flange_a, net.shunt.flange_a), {"motor.u": 30.0}


def engine() -> tuple[ia.Network, dict[str, float]]:
    net = ia.Network(
        "engine",
        shaft=rotational.Inertia(J=0.05, phi=0.4, w=20.0),
        crank=ia.SliderCrank(r=0.04, l=0.12, e=0.01),
        piston=ia.Mass(m=0.8),
        cam=ia.Cam(table=((0.0, 0.0), (1.5, 0.004), (3.0, 0.01), (4.5, 0.003))),
        valve=ia.Mass(m=0.3),
        tyre=ia.Tyre(R=0.3, F_z=800.0, mu=0.9, B=10.0, C=1.6, E=0.3, sigma=0.3),
        car=ia.Mass(m=20.0, v=4.0),
        rod=ia.ModalRod(m=0.5, k=5e4, d=5.0, modes=2),
        bumper=ia.LumpedRod(m=0.4, k=4e4, d=5.0, segments=3),
        load=ia.Mass(m=1.0),
    )
    net.connect(net.shaft.flange, net.crank.flange_r, net.cam.flange_r, net.tyre.flange_r)
    net.connect(net.crank.flange_t, net.piston.flange).connect(net.cam.flange_t, net.valve.flange)
    net.connect(net.tyre.flange_t, net.car.flange, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.bumper.flange_a)
    return net.connect(net.bumper.flange_b, net.load.flange), {}


def hoists() -> tuple[ia.Network, dict[str, float]]:
    """A worm and a screw that coast, stop and hold their loads."""
    net = ia.Network(
        "hoists",
        rotor=rotational.Inertia(J=0.01, w=30.0),
        worm=rotational.WormGear(ratio=20.0, lead_angle=0.15, mu=0.2, tau_bf=0.02),
        drum=rotational.Inertia(J=0.5),
        weight=rotational.ConstantTorque(tau_constant=-40.0),
        hand=rotational.Inertia(J=1e-3, w=5.0),
        screw=ia.LeadScrew(lead=0.004, d_m=0.018, mu=0.12),
        load=ia.Mass(m=20.0),
        gravity=ia.ConstantForce(f_constant=-196.2),
    )
    net.connect(net.rotor.flange, net.worm.flange_a)
    net.connect(net.worm.flange_b, net.drum.flange, net.weight.flange)
    net.connect(net.hand.flange, net.screw.flange_r)
    return net.connect(net.screw.flange_t, net.load.flange, net.gravity.flange), {}


def servo() -> tuple[ia.Network, dict[str, float]]:
    made = machines.Servo(
        k_p=40.0, k_d=0.6, band=0.01, period=0.02, delay=5e-3, ratio=20.0, J=1e-5, k=0.01, R=4.0, L=1e-3,
        u_max=12.0, i_max=1.5,
    )  # fmt: skip
    net = ia.Network(
        "arm", servo=made, flywheel=machines.DualMassFlywheel(J_1=0.01, J_2=0.01, c=20.0, d=0.05)
    )
    net.add(damper=machines.TorsionalDamper(J_h=1e-3, J_r=5e-3, c=1.0, d=0.01))
    net.connect(net.servo.flange, net.flywheel.flange_a)
    return net.connect(net.flywheel.flange_b, net.damper.flange), {"servo.reference": 0.5}


def inerters() -> tuple[ia.Network, dict[str, float]]:
    crank = machines.CrankInerter(crank=ia.SliderCrank(r=0.1, l=0.3), flywheel=ia.DiskFlywheel(m=0.5, R=0.05))
    mechatronic = machines.MechatronicInerter(
        screw=ia.NutScrew(lead=0.02),
        flywheel=ia.DiskFlywheel(m=0.1, R=0.03),
        motor=rotational.ShuntedMotor(k=0.05, L=0.02, R=1.5, elastance=100.0),
    )
    net = ia.Network("inerters", wall=ia.Fixed(), spring=ia.Spring(k=2e3, s_rel0=-0.3), body=ia.Mass(m=3.0))
    net.add(
        crank=crank,
        mechatronic=mechatronic,
        shaker=machines.Shaker(m=0.3, k=4e3, d=8.0, Bl=15.0, R=2.0, L=1e-3),
    )
    net.add(sink=machines.NES(m=0.3, k3=1e4, d=1.0, k=200.0))
    net.connect(
        net.wall.flange, net.spring.flange_a, net.crank.flange_b, net.mechatronic.flange_a, net.sink.flange_a
    )
    net.connect(
        net.body.flange, net.spring.flange_b, net.crank.flange_a, net.mechatronic.flange_b,
        net.shaker.flange_a, net.sink.flange_b,
    )  # fmt: skip
    return net, {"shaker.u": 3.0}


STILL = {
    "crank.crank.phi": 1.4,
    "crank.flywheel.w": 0.0,
    "sink.spring.s_rel": 0.0,
    "shaker.suspension.s_rel": 0.0,
}
MACHINES: dict[str, tuple[Callable[[], tuple[ia.Network, dict[str, float]]], str, dict[str, float]]] = {
    "rubber": (rubber, "3.0", {}),
    "dampers": (dampers, "2.0", {}),
    "drive": (drive, "3.0", {}),
    "engine": (engine, "2.0", {}),
    "hoists": (hoists, "3.0", {}),
    "servo": (servo, "2.0", {}),
    "inerters": (inerters, "3.0", STILL),
}


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.usefixtures("few_instances")
def test_an_fmu_does_what_its_network_does(name: str) -> None:
    make, version, start = MACHINES[name]
    net, inputs = make()
    report = ia.fmu.check_fmu(net, 0.5, step=5e-3, versions=[version], inputs=inputs, start=start)
    assert report.passed, str(report)


def test_a_rate_that_is_a_state_itself_is_no_other_variable_of_its_name(tmp_path: Path) -> None:
    """Two cranks on one shaft: its speed, a state, is the rate of its angle, another one."""

    class Turning(ia.Transmission):
        def equations(self) -> Any:
            yield self.s == 0.1 * ca.sin(self.phi)
            yield self.flange_r.tau + 0.1 * ca.cos(self.phi) * self.flange_t.f == 0

    net = ia.Network("turning", shaft=rotational.Inertia(J=1.0), one=Turning(), two=Turning())
    net.add(first=ia.Mass(m=1.0), second=ia.Mass(m=2.0))
    net.connect(net.shaft.flange, net.one.flange_r, net.two.flange_r)
    net.connect(net.one.flange_t, net.first.flange).connect(net.two.flange_t, net.second.flange)
    path = ia.export_fmu(net, tmp_path / "turning.fmu", start={"shaft.phi": 0.2}, platforms=[])
    described = fmpy.read_model_description(str(path))
    names = [variable.name for variable in described.modelVariables]
    assert len(names) == len(set(names))
