"""Sources of torque and of prescribed rotation, and what they do to their support."""

from math import pi

import casadi as ca
import numpy as np
import pytest
from inertance import Component, Network, rotational


def driven(source: Component) -> Network:
    net = Network("driven", source=source, body=rotational.Inertia(J=2.0))
    return net.connect(net.source.flange, net.body.flange)


def test_a_positive_torque_accelerates() -> None:
    run = driven(rotational.Torque(tau=lambda t: 6 * t)).simulate(2.0, rtol=1e-10, atol=1e-12)
    assert run["body.w"][-1] == pytest.approx(6.0)
    assert driven(rotational.ConstantTorque(tau_constant=-4.0)).simulate(1.0)["body.a"] == pytest.approx(-2)


def test_a_torque_between_two_shafts_acts_on_both() -> None:
    net = driven(rotational.Torque(tau=6.0))
    net.add(other=rotational.Inertia(J=3.0))
    net.connect(net.source.support, net.other.flange)
    run = net.simulate(1.0)
    assert run["body.a"] == pytest.approx(3.0)
    assert run["other.a"] == pytest.approx(-2.0)


def test_a_prescribed_angle_takes_the_torque_of_its_acceleration() -> None:
    run = driven(rotational.Position(phi_ref=lambda t: ca.sin(3 * t))).simulate(1.0)
    t = run["time"]
    assert run["body.phi"] == pytest.approx(np.sin(3 * t))
    assert run["body.w"] == pytest.approx(3 * np.cos(3 * t))
    assert run["source.flange.tau"] == pytest.approx(18 * np.sin(3 * t))


def test_a_prescribed_speed_goes_on_from_its_start_angle() -> None:
    run = driven(rotational.Speed(w_ref=lambda t: ca.cos(t), phi=0.5)).simulate(pi / 2, rtol=1e-10)
    assert run["body.phi"][-1] == pytest.approx(1.5)
    assert run["body.a"][-1] == pytest.approx(-1.0)


def test_a_constant_speed_takes_no_torque() -> None:
    run = driven(rotational.Speed(w_ref=2.0, phi=1)).simulate(1.0)
    assert run["body.phi"][-1] == pytest.approx(3.0)
    assert (run["source.flange.tau"] == 0).all()


def test_a_prescribed_acceleration_goes_on_from_its_start_speed() -> None:
    run = driven(rotational.Accelerate(a_ref=2.0, phi=1, w=3)).simulate(1.0)
    assert run["body.w"][-1] == pytest.approx(5.0)
    assert run["body.phi"][-1] == pytest.approx(5.0)
    assert run["source.support.tau"] == pytest.approx(4.0)


def test_a_motion_is_prescribed_against_a_turning_support() -> None:
    net = driven(rotational.Position(phi_ref=lambda t: t**2))
    net.add(table=rotational.Inertia(J=6.0, phi=0, w=0))
    net.connect(net.source.support, net.table.flange)
    run = net.simulate(1.0)
    # 2 a + 6 a_t = 0 and a - a_t = 2
    assert run["table.a"] == pytest.approx(-0.5)
    assert run["body.a"] == pytest.approx(1.5)
