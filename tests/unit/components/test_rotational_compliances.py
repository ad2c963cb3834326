"""Rotational inertias, springs, dampers, inerter and backlash against closed forms and written-out laws."""

from math import exp, pi, sqrt
from typing import Any

import casadi as ca
import numpy as np
import pytest
from inertance import ModelError, Network, rotational

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}


def on_ground(element: rotational.Compliant, **start: float) -> Network:
    net = Network("swing", wall=rotational.Fixed(), element=element, body=rotational.Inertia(J=2.0, **start))
    net.connect(net.wall.flange, net.element.flange_a)
    return net.connect(net.element.flange_b, net.body.flange)


def driven(element: rotational.Compliant, angle: Any) -> Network:
    net = Network(
        "driven", wall=rotational.Fixed(), element=element, drive=rotational.Position(phi_ref=angle)
    )
    net.connect(net.wall.flange, net.element.flange_a)
    return net.connect(net.drive.flange, net.element.flange_b)


def test_a_spring_makes_an_inertia_swing() -> None:
    run = on_ground(rotational.Spring(c=8.0, phi_rel0=0.5), phi=0.7, w=0).simulate(3.0, **TIGHT)
    assert run["body.phi"] == pytest.approx(0.5 + 0.2 * np.cos(2 * run["time"]), abs=1e-8)
    assert run["element.tau"] == pytest.approx(8.0 * (run["body.phi"] - 0.5))


def test_a_damper_stops_an_inertia() -> None:
    run = on_ground(rotational.Damper(d=3.0), w=10).simulate(2.0, **TIGHT)
    assert run["body.w"][-1] == pytest.approx(10 * exp(-1.5 * 2), rel=1e-8)


def test_spring_and_damper_in_one_element() -> None:
    run = on_ground(rotational.SpringDamper(c=8.0, d=2.0, phi_rel0=0.5), phi=0.5, w=1).simulate(1.0, **TIGHT)
    decay, frequency = 0.5, sqrt(4 - 0.25)
    expected = 0.5 + exp(-decay) * np.sin(frequency) / frequency
    assert run["body.phi"][-1] == pytest.approx(expected, rel=1e-8)


def test_a_fan_slows_down_hyperbolically() -> None:
    run = on_ground(rotational.QuadraticDamper(k=0.4), w=-5).simulate(3.0, **TIGHT)
    assert run["body.w"][-1] == pytest.approx(-5 / (1 + 0.4 / 2 * 5 * 3), rel=1e-8)


def test_an_inerter_feels_only_the_difference_of_two_shafts() -> None:
    net = Network(
        "two shafts",
        torque=rotational.Torque(tau=6.0),
        one=rotational.Inertia(J=1.0),
        flywheel=rotational.Inerter(J=2.0),
        two=rotational.Inertia(J=4.0),
    )
    net.connect(net.torque.flange, net.one.flange, net.flywheel.flange_a)
    net.connect(net.flywheel.flange_b, net.two.flange)
    run = net.simulate(0.1)
    # [1 + 2, -2; -2, 4 + 2] a = [6, 0]
    assert run["one.a"][-1] == pytest.approx(36 / 14)
    assert run["two.a"][-1] == pytest.approx(12 / 14)
    assert run["flywheel.tau"][-1] == pytest.approx(2.0 * (12 - 36) / 14)


def test_a_disc_takes_its_inertia_from_geometry_and_density() -> None:
    disc = rotational.Disc(r=0.05, r_i=0.01, l=0.02, rho=7850.0)
    assert disc.m == pytest.approx(7850 * 0.02 * pi * (0.05**2 - 0.01**2))
    inertia = disc.m * (0.05**2 + 0.01**2) / 2
    assert pytest.approx(inertia) == disc.J
    net = Network("disc", torque=rotational.Torque(tau=0.3), disc=disc)
    net.connect(net.torque.flange, net.disc.flange)
    assert net.simulate(1.0)["disc.w"][-1] == pytest.approx(0.3 / disc.J)


def test_a_bore_wider_than_its_disc_is_refused() -> None:
    net = Network(
        "disc", torque=rotational.Torque(tau=0.3), disc=rotational.Disc(r=0.05, r_i=0.06, l=1, rho=1)
    )
    net.connect(net.torque.flange, net.disc.flange)
    with pytest.raises(ModelError, match=r"Disc .disc.: J must be above 0 kg\.m2"):
        net.dae()


def backlash_torque(x: float, w: float, c: float, d: float, b: float) -> float:
    """The law of the Modelica Standard Library, case by case."""
    if x > b / 2:
        spring = c * (x - b / 2)
        return 0.0 if spring + d * w <= 0 else spring + min(spring, d * w)
    if x < -b / 2:
        spring = c * (x + b / 2)
        return 0.0 if spring + d * w >= 0 else spring + max(spring, d * w)
    return 0.0


@pytest.mark.parametrize("frequency", [0.3, 3.0, 30.0])
def test_backlash_follows_its_law_at_any_speed(frequency: float) -> None:
    element = rotational.ElastoBacklash(c=50.0, d=2.0, b=0.4, phi_rel0=0.1)
    run = driven(element, lambda t: 0.1 + 0.5 * ca.sin(2 * pi * frequency * t)).simulate(1 / frequency)
    points = zip(run["element.phi_rel"] - 0.1, run["element.w_rel"], strict=True)
    expected = [backlash_torque(x, w, 50.0, 2.0, 0.4) for x, w in points]
    assert run["element.tau"] == pytest.approx(expected, abs=1e-9)
    assert min(expected) < -1
    assert max(expected) > 1


def test_backlash_flies_freely_and_only_loses_energy() -> None:
    net = on_ground(rotational.ElastoBacklash(c=2e4, d=50.0, b=pi / 4), phi=pi / 2, w=0)
    run = net.simulate(1.0, **TIGHT)
    x, w, tau = run["element.phi_rel"], run["body.w"], run["element.tau"]
    inside = np.abs(x) < pi / 8
    assert inside.any()
    assert (tau[inside] == 0).all()
    assert (tau * x >= 0).all()
    energy = w**2 + 1e4 * np.maximum(np.abs(x) - pi / 8, 0) ** 2
    assert (np.diff(energy) <= 1e-6 * energy[0]).all()
    assert energy[-1] < 0.1 * energy[0]


def test_the_flight_between_the_flanks_takes_backlash_over_speed() -> None:
    net = on_ground(rotational.ElastoBacklash(c=1e6, d=0.0, b=0.2), phi=0.0, w=1.0)
    contact = pi / sqrt(1e6 / 2)
    run = net.simulate(0.1 + contact + 0.2, **TIGHT)
    assert run["body.phi"][-1] == pytest.approx(-0.1, abs=1e-7)
    assert run["body.w"][-1] == pytest.approx(-1.0, abs=1e-7)


def test_a_fixed_angle_offset_loads_a_spring() -> None:
    net = Network(
        "twist", wall=rotational.Fixed(phi0=0.25), spring=rotational.Spring(c=4.0), end=rotational.Fixed()
    )
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.end.flange, net.spring.flange_b)
    run = net.simulate(1.0)
    assert run["spring.tau"][-1] == pytest.approx(-1.0)
    assert run["wall.flange.tau"][-1] == pytest.approx(-1.0)
