"""Elements with MSL's names go into FMUs, several in each machine, and agree with the native run."""

import shutil

import inertance as ia
import numpy as np
import pytest
from inertance import rotational, signals, thermal

pytestmark = [
    pytest.mark.skipif(
        not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
    ),
    pytest.mark.usefixtures("few_instances"),
]


def drivetrain() -> ia.Network:
    """A motor drives a vehicle through a gearbox; a brake and friction heat what they are on."""
    net = ia.Network(
        "drivetrain",
        chirp=signals.Chirp(f_min=0.2, f_max=1.0, duration=2.0, amplitude=60.0, start_time=0.1),
        level=signals.Hysteresis(uLow=-20.0, uHigh=20.0),
        pick=signals.Switch(),
        base=signals.Constant(k=15.0),
        lag=signals.TransferFunction(b=(1.0,), a=(0.01, 0.2, 1.0)),
        motor=rotational.Torque(),
        meter=rotational.MultiSensor(),
        rotor=rotational.Inertia(J=0.2, w=8.0),
        fan=rotational.QuadraticSpeedDependentTorque(tau_nominal=-1.0, w_nominal=20.0, TorqueDirection=False),
        seal=rotational.TemperatureDependentFriction(tau_c=2.0, alpha=-0.001, useHeatPort=True),
        housing=rotational.Fixed(),
        box=rotational.Gearbox(ratio=4.0, lossTable=((0.0, 0.95, 0.9, 0.5, 0.5),), c=5000.0, d=20.0, b=0.002),
        car=ia.Vehicle(m=60.0, J=0.2, R=0.3, A=0.5, vReg=0.1, inclinationConstant=0.01, v=0.6),
        retarder=rotational.EddyCurrentBrake(tau_nominal=2.0, w_nominal=5.0, alpha20=0.004, useHeatPort=True),
        disc=thermal.HeatCapacitor(C=20.0),
        path=thermal.ThermalConductor(G=2.0),
        air=thermal.FixedTemperature(T=300.0),
    )
    net.connect(net.chirp.y, net.level.u, net.pick.u1).connect(net.level.y, net.pick.u2)
    net.connect(net.base.y, net.pick.u3).connect(net.pick.y, net.lag.u).connect(net.lag.y, net.motor.tau)
    net.connect(net.motor.flange, net.meter.flange_a)
    net.connect(net.meter.flange_b, net.rotor.flange, net.fan.flange, net.box.flange_a)
    net.connect(net.housing.flange, net.seal.flange_a)
    net.connect(net.box.flange_b, net.car.flangeR, net.retarder.flange, net.seal.flange_b)
    net.connect(net.seal.heatPort, net.retarder.heatPort, net.disc.port, net.path.port_a)
    return net.connect(net.path.port_b, net.air.port)


def striking() -> ia.Network:
    """A shaft between flanks is moved; blocks look up and choose what pushes a block over a rolling wheel."""
    net = ia.Network(
        "striking",
        given=rotational.Move(),
        way=signals.Sine(amplitude=0.2, f=5 / (2 * np.pi)),
        pace=signals.Sine(amplitude=1.0, f=5 / (2 * np.pi), phase=np.pi / 2),
        change=signals.Sine(amplitude=-5.0, f=5 / (2 * np.pi)),
        flanks=rotational.ElastoBacklash2(c=500.0, d=2.0, b=0.1),
        shaft=rotational.Inertia(J=0.5, phi=0.01),
        power=rotational.PowerSensor(),
        drag=rotational.LinearSpeedDependentTorque(tau_nominal=-0.5, w_nominal=2.0, TorqueDirection=False),
        gap=rotational.Backlash(c=200.0, d=1.0, eps=0.02),
        tail=rotational.Inertia(J=0.1),
        angle=rotational.AngleSensor(),
        sign=signals.Sign(),
        table=signals.CombiTable1D(table=((-0.1, 1.0), (0.07, 0.5), (0.2, 2.0))),
        field=signals.CombiTable2D(table=((0, -1, 1), (0, 1, 2), (2, 3, 5))),
        ring=signals.SecondOrder(w=20.0, D=0.3),
        larger=signals.Max(),
        push=ia.Force(),
        block=ia.Mass(m=2.0),
        wheel=ia.RollingResistance(fWeight=20.0, CrConstant=0.05, v0=0.5),
        tow=ia.InverseSpeedDependentForce(f_nominal=0.5, v_nominal=1.0, v0=0.3, ForceDirection=False),
        play=ia.ElastoBacklash(k=300.0, d=2.0, b=0.01),
        sledge=ia.Mass(m=1.0),
        data=signals.CombiTimeTable(table=((0.0, 0.0, 1.0), (0.5, 1.0, -1.0), (1.5, 0.0, 0.0))),
        pull=ia.Force(),
        size=signals.Abs(),
        least=signals.Min(),
        less=signals.Feedback(),
    )
    net.connect(net.way.y, net.given.phi_ref).connect(net.pace.y, net.given.w_ref)
    net.connect(net.change.y, net.given.a_ref)
    net.connect(net.given.flange, net.flanks.flange_a).connect(net.flanks.flange_b, net.power.flange_a)
    net.connect(net.power.flange_b, net.shaft.flange, net.drag.flange, net.gap.flange_a, net.angle.flange)
    net.connect(net.gap.flange_b, net.tail.flange)
    net.connect(net.angle.phi, net.sign.u, net.table.u, net.size.u)
    net.connect(net.table.y, net.field.u1).connect(net.sign.y, net.field.u2).connect(net.field.y, net.ring.u)
    net.connect(net.ring.y, net.larger.u1).connect(net.size.y, net.larger.u2).connect(
        net.larger.y, net.push.f
    )
    net.connect(net.push.flange, net.block.flange, net.wheel.flange, net.tow.flange, net.play.flange_a)
    net.connect(net.data.column1.y, net.least.u1).connect(net.data.column2.y, net.least.u2, net.less.u1)
    net.connect(net.least.y, net.less.u2).connect(net.less.y, net.pull.f)
    return net.connect(net.play.flange_b, net.sledge.flange, net.pull.flange)


def test_a_drivetrain_with_heat_passes_the_check() -> None:
    report = ia.fmu.check_fmu(
        drivetrain(),
        3.0,
        outputs=["car.v", "disc.T", "meter.power", "lossPower"],
        versions=["2.0"],
    )
    assert report.passed, str(report)


def test_flanks_blocks_and_wheels_pass_the_check() -> None:
    outputs = ["shaft.phi", "block.v", "sledge.v", "power.power"]
    report = ia.fmu.check_fmu(striking(), 2.0, outputs=outputs, versions=["3.0"])
    assert report.passed, str(report)
