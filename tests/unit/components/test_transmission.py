"""Screws, pinions, wheels and flywheels against closed forms and other formulations."""

from math import cos, pi
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}
GEARS: dict[str, Any] = {"R": 0.05, "r": 0.017, "J_p": 1.66e-5, "J_r": 1.02e-4}
MESH: dict[str, Any] = {"k_r": 1e8, "c_r": 4e3}


def driven(transmission: ia.Component, force: float) -> ia.Result:
    """A mass of 2 kg that turns an inertia of 0.003 kg.m2, from rest."""
    net = ia.Network(
        "driven",
        force=ia.Force(f=force),
        mass=ia.Mass(m=2.0, s=0.0, v=0.0),
        transmission=transmission,
        inertia=rotational.Inertia(J=0.003),
    )
    net.connect(net.force.flange, net.mass.flange, net.transmission.flange_t)
    net.connect(net.transmission.flange_r, net.inertia.flange)
    return net.simulate(1.0, **TIGHT)


@pytest.mark.parametrize(
    ("transmission", "turns"),
    [
        (ia.NutScrew(lead=0.02), 2 * pi / 0.02),
        (ia.RackPinion(R=0.03), 1 / 0.03),
        (ia.RollingWheel(R=0.3), 1 / 0.3),
    ],
)
def test_inertia_weighs_with_the_square_of_the_transmission(transmission: ia.Component, turns: float) -> None:
    run = driven(transmission, 5.0)
    assert run["mass.v"][-1] == pytest.approx(5.0 / (2.0 + 0.003 * turns**2), rel=1e-9)
    assert run["inertia.w"] == pytest.approx(turns * run["mass.v"], abs=1e-12)


@pytest.mark.parametrize("transmission", [ia.NutScrew(lead=0.02), ia.RackPinion(R=0.03)])
def test_housing_takes_force_and_torque(transmission: ia.Component) -> None:
    """Inside a free housing both momenta stay what they are."""
    net = ia.Network(
        "free",
        force=ia.Force(f=lambda t: 5.0 * np.sin(3 * t)),
        nut=ia.Mass(m=2.0, s=0.0, v=0.0),
        housing=ia.Mass(m=7.0, s=0.0, v=0.3),
        transmission=transmission,
        screw=rotational.Inertia(J=0.003, phi=0.0),
        shell=rotational.Inertia(J=0.4, phi=0.0, w=0.1),
    )
    net.connect(net.force.flange, net.nut.flange, net.transmission.flange_t)
    net.connect(net.force.support, net.housing.flange, net.transmission.support_t)
    net.connect(net.transmission.flange_r, net.screw.flange)
    net.connect(net.transmission.support_r, net.shell.flange)
    run = net.simulate(2.0, **TIGHT)
    linear = 2.0 * run["nut.v"] + 7.0 * run["housing.v"]
    angular = 0.003 * run["screw.w"] + 0.4 * run["shell.w"]
    assert linear == pytest.approx(linear[0] * np.ones_like(linear), abs=1e-7)
    assert angular == pytest.approx(angular[0] * np.ones_like(angular), abs=1e-7)
    assert np.ptp(run["nut.v"]) > 5e-3


def test_locked_compliant_screw_is_a_spring_behind_its_clearance() -> None:
    screw = ia.CompliantNutScrew(lead=0.01, m_r=0.5, k=1e6, d=200.0, eps=1e-5)
    net = ia.Network(
        "locked",
        motion=ia.Position(s_ref=lambda t: 1e-4 * np.sin(10 * t)),
        screw=screw,
        lock=rotational.Fixed(),
    )
    net.connect(net.motion.flange, net.screw.flange_t)
    net.connect(net.screw.flange_r, net.lock.flange)
    run = net.simulate(1.0)
    s, v, a = (1e-4 * 10**n * np.sin(10 * run.time + n * pi / 2) for n in range(3))
    push = 1e6 * s + 200.0 * v
    contact = np.where(abs(push) > 10, push - 10 * np.sign(push), 0)
    assert run["screw.flange_t.f"] == pytest.approx(contact + 0.5 * a, abs=1e-9)
    assert run["screw.flange_r.tau"] == pytest.approx(-contact * 0.01 / (2 * pi), abs=1e-9)


def test_screw_friction_holds_the_nut() -> None:
    """Friction of 0.2 N.m at a lead of 10 mm holds 40 pi N, and no more."""
    friction = rotational.CoulombFriction(tau_c=0.2)
    screw = ia.CompliantNutScrew(lead=0.01, m_r=0.5, k=1e6, d=2e3, friction=friction)
    net = ia.Network(
        "held", force=ia.Force(f=lambda t: 50 * t), screw=screw, wheel=rotational.Inertia(J=1e-3)
    )
    net.connect(net.force.flange, net.screw.flange_t)
    net.connect(net.screw.flange_r, net.wheel.flange)
    run = net.simulate(3.0, **TIGHT)
    (slip,) = [e for e in run.events if e.target == "forward"]
    assert slip.time == pytest.approx(40 * pi / 50, abs=1e-4)
    assert np.abs(run["wheel.w"][run.time < slip.time]).max() < 1e-12


def turned(flywheel: ia.Component, torque: Any, stop: float = 0.5, **options: Any) -> ia.Result:
    net = ia.Network("turned", torque=rotational.Torque(tau=torque), flywheel=flywheel)
    net.connect(net.torque.flange, net.flywheel.flange)
    return net.simulate(stop, **TIGHT, **options)


def test_disk_flywheel() -> None:
    run = turned(ia.DiskFlywheel(m=2.0, R=0.1, J_s=0.005), 0.03)
    assert run["flywheel.w"][-1] == pytest.approx(0.03 / 0.015 * 0.5, rel=1e-9)


def test_ideal_planetary_flywheel_has_the_equivalent_inertia() -> None:
    run = turned(ia.IdealPlanetaryFlywheel(N=3, J_s=3e-4, **GEARS), 0.1)
    J_e = 3e-4 + 3 * (1.66e-5 * (33 / 17) ** 2 + 1.02e-4)
    assert run["flywheel.w"][-1] == pytest.approx(0.1 / J_e * 0.5, rel=1e-9)


@pytest.mark.parametrize("lumped", [True, False])
def test_stiff_meshes_make_the_flywheel_ideal(lumped: bool) -> None:
    run = turned(ia.PlanetaryFlywheel(N=3, J_s=3e-4, lumped=lumped, **GEARS, **MESH), 0.1)
    ideal = turned(ia.IdealPlanetaryFlywheel(N=3, J_s=3e-4, **GEARS), 0.1)
    assert run["flywheel.bracket.w"][-1] == pytest.approx(ideal["flywheel.w"][-1], rel=1e-6)
    assert run["flywheel.support.tau"][-1] == pytest.approx(ideal["flywheel.support.tau"][-1], rel=1e-6)


def test_planets_may_differ() -> None:
    """One heavier planet: eq. (7) with a sum over planets."""
    heavy = ia.Planet(**(GEARS | {"J_p": 5e-5, "J_r": 3e-4}), **MESH)
    run = turned(ia.PlanetaryFlywheel(N=3, J_s=3e-4, lumped=False, planet_2=heavy, **GEARS, **MESH), 0.1)
    J_e = 3e-4 + (2 * 1.66e-5 + 5e-5) * (33 / 17) ** 2 + 2 * 1.02e-4 + 3e-4
    assert run["flywheel.bracket.w"][-1] == pytest.approx(0.1 / J_e * 0.5, rel=1e-6)
    forces = [run[f"flywheel.planet_{i}.F_p"][-1] for i in (1, 2, 3)]
    assert forces[1] / forces[0] == pytest.approx(5e-5 / 1.66e-5, rel=1e-6)
    assert forces[2] == pytest.approx(forces[0])


def test_stuck_planets_hold_the_bracket() -> None:
    """They let go at N T_pm (R - r)/r."""
    flywheel = ia.PlanetaryFlywheel(N=4, J_s=3e-4, T_pm=0.01, **GEARS, **dict(MESH, c_r=4e4))
    run = turned(flywheel, lambda t: 0.2 * t, 1.0)
    (slip,) = [e for e in run.events if e.target == "forward"]
    assert slip.time == pytest.approx(4 * 0.01 * 33 / 17 / 0.2, abs=1e-4)
    assert np.abs(run["flywheel.planet.w_p"][run.time < slip.time]).max() < 1e-12


def meshed(planet: bool) -> ia.Network:
    """A bracket, a planet and a ring, all free to turn; the planet from its equations or from parts."""
    net = ia.Network(
        "meshed",
        torque=rotational.Torque(tau=lambda t: 0.3 * np.sin(20 * t)),
        bracket=rotational.Inertia(J=3e-4, phi=0.0, w=0.0),
        ring=rotational.Inertia(J=2e-3, phi=0.0, w=0.0),
    )
    net.connect(net.torque.flange, net.bracket.flange)
    if planet:
        gear = ia.Planet(**GEARS, **MESH, g_r=1e-6, T_pm=0.01, T_pv=1e-4, regularised=0.1)
        net.add(planet=gear.with_values(theta_p=0.0, w_p=0.0))
        net.connect(net.planet.bracket, net.bracket.flange)
        net.connect(net.planet.ring, net.ring.flange)
        return net
    alpha = cos(pi / 9)
    net.add(
        mesh=rotational.GearMesh(r_a=0.017 * alpha, r_b=0.05 * alpha, k=1e8, d=4e3, g=1e-6, internal=True),
        spin=rotational.Inertia(J=1.66e-5, phi=0.0, w=0.0),
        revolution=rotational.Inertia(J=1.02e-4),
        friction=rotational.StribeckFriction(tau_c=0.01, tau_s=0.01, w_s=1.0, d=1e-4, regularised=0.1),
    )
    net.connect(net.bracket.flange, net.mesh.support, net.revolution.flange)
    net.connect(net.spin.flange, net.mesh.flange_a, net.friction.flange_b)
    net.connect(net.ring.flange, net.mesh.flange_b, net.friction.flange_a)
    return net


def test_planet_is_its_parts() -> None:
    """The planet's equations against mesh, inertias and friction joined as a network."""
    equations, parts = (meshed(planet).simulate(0.5, rtol=1e-8, atol=1e-10) for planet in (True, False))
    for name in ("bracket.w", "ring.w"):
        assert equations[name] == pytest.approx(parts[name], abs=1e-4 * np.ptp(parts[name]))
    assert equations["planet.w_p"] == pytest.approx(
        parts["ring.w"] - parts["spin.w"], abs=1e-4 * np.ptp(parts["spin.w"])
    )
