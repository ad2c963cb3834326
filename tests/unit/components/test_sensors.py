"""Sensors show what is known in closed form, and disturb nothing."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational

W, F, M = 8 * np.pi, 10.0, 2.0


def driven_mass(**sensors: ia.Component) -> ia.Network:
    """A mass at rest at s = 0 under F sin(W t), its left end 0.5 m behind."""
    force = ia.Force(f=lambda t: F * np.sin(W * t))
    mass, rod = ia.Mass(m=M, s=0.0, v=0.0), ia.Rod(L=0.5)
    net = ia.Network("driven", force=force, mass=mass, rod=rod, **sensors)
    net.connect(net.mass.flange, net.rod.flange_b)
    net.connect(net.rod.flange_a, *(getattr(net, name).flange for name in sensors))
    return net


def test_absolute_sensors_of_a_mass_behind_a_force_sensor() -> None:
    net = driven_mass(s=ia.PositionSensor(), v=ia.SpeedSensor(), a=ia.AccelerationSensor())
    net.add(f=ia.ForceSensor())
    net.connect(net.force.flange, net.f.flange_a)
    net.connect(net.f.flange_b, net.rod.flange_a)
    run = net.simulate(1.0, rtol=1e-10, atol=1e-12)
    t, a = run.time, F / M
    assert run["f.f"] == pytest.approx(F * np.sin(W * t), abs=1e-9)
    assert run["a.a"] == pytest.approx(a * np.sin(W * t), abs=1e-9)
    assert run["v.v"] == pytest.approx(a / W * (1 - np.cos(W * t)), abs=1e-7)
    assert run["s.s"] == pytest.approx(a / W * (t - np.sin(W * t) / W) - 0.5, abs=1e-7)
    assert [run.unit(n) for n in ("s.s", "v.v", "a.a", "f.f")] == ["m", "m/s", "m/s2", "N"]


def test_accelerometer_on_a_prescribed_position() -> None:
    source = ia.Position(s_ref=lambda t: 0.01 * np.sin(W * t))
    net = ia.Network("shaker", table=source, sensor=ia.AccelerationSensor())
    net.connect(net.table.flange, net.sensor.flange)
    run = net.simulate(1.0)
    assert run["sensor.a"] == pytest.approx(-0.01 * W**2 * np.sin(W * run.time), abs=1e-9)


def two_masses(**sensors: Any) -> ia.Network:
    """Free masses of 1 and 3 kg, the second ahead, driven apart by 6 N."""
    back, front = ia.Mass(m=1.0, s=0.0, v=0.0), ia.Mass(m=3.0, s=1.0, v=0.0)
    net = ia.Network("pair", back=back, front=front, force=ia.Force(f=6.0))
    net.add(**sensors)
    joined = [getattr(net, name) for name in sensors]
    net.connect(net.back.flange, net.force.support, *(sensor.flange_a for sensor in joined))
    net.connect(net.front.flange, net.force.flange, *(sensor.flange_b for sensor in joined))
    return net


def test_relative_sensors() -> None:
    net = two_masses(
        s=ia.RelativePositionSensor(), v=ia.RelativeSpeedSensor(), a=ia.RelativeAccelerationSensor()
    )
    run = net.simulate(1.0)
    t, a_rel = run.time, 6.0 / 3.0 + 6.0 / 1.0
    assert run["s.s_rel"] == pytest.approx(1 + a_rel * t**2 / 2, rel=1e-5)
    assert run["v.v_rel"] == pytest.approx(a_rel * t, abs=1e-9)
    assert run["a.a_rel"] == pytest.approx(np.full(len(t), a_rel))
    assert run["v.s_rel"] == pytest.approx(run["s.s_rel"])


def test_sensors_disturb_nothing() -> None:
    bare = two_masses().simulate(1.0)
    seen = two_masses(a=ia.RelativeAccelerationSensor(), v=ia.RelativeSpeedSensor()).simulate(1.0)
    assert seen["front.s"] == pytest.approx(bare["front.s"], abs=1e-12)
    assert seen.dae.state_names == bare.dae.state_names


def test_rotational_sensors() -> None:
    net = ia.Network(
        "shafts",
        torque=rotational.Torque(tau=lambda t: F * np.sin(W * t)),
        tau=rotational.TorqueSensor(),
        near=rotational.Inertia(J=M, phi=0.0, w=0.0),
        far=rotational.Inertia(J=1.0, phi=1.0, w=-2.0),
        phi=rotational.AngleSensor(),
        w=rotational.SpeedSensor(),
        a=rotational.AccelerationSensor(),
        between=rotational.RelativeAccelerationSensor(),
    )
    net.connect(net.torque.flange, net.tau.flange_a)
    net.connect(
        net.tau.flange_b, net.near.flange, net.phi.flange, net.w.flange, net.a.flange,
        net.between.flange_a,
    )  # fmt: skip
    net.connect(net.far.flange, net.between.flange_b)
    run = net.simulate(1.0, rtol=1e-10, atol=1e-12)
    t, a = run.time, F / M
    assert run["tau.tau"] == pytest.approx(F * np.sin(W * t), abs=1e-9)
    assert run["a.a"] == pytest.approx(a * np.sin(W * t), abs=1e-9)
    assert run["w.w"] == pytest.approx(a / W * (1 - np.cos(W * t)), abs=1e-7)
    assert run["phi.phi"] == pytest.approx(a / W * (t - np.sin(W * t) / W), abs=1e-7)
    assert run["between.phi_rel"] == pytest.approx(1 - 2 * t - run["phi.phi"], abs=1e-7)
    assert run["between.w_rel"] == pytest.approx(-2 - run["w.w"], abs=1e-9)
    assert run["between.a_rel"] == pytest.approx(-run["a.a"], abs=1e-9)
