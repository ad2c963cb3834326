"""Gears: ratios, torques, reactions, losses and the elastic mesh, against hand-made reductions."""

from collections.abc import Callable
from math import pi
from typing import Any

import casadi as ca
import numpy as np
import pytest
from inertance import Component, ModelError, Network, Result, rotational

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}


def geared(gear: Component, torque: Any, load: Any = 0.0, **start: float) -> Network:
    net = Network(
        "geared",
        torque=rotational.Torque(tau=torque),
        a=rotational.Inertia(J=1.0),
        gear=gear,
        b=rotational.Inertia(J=1.5, **start),
        load=rotational.Torque(tau=load),
    )
    net.connect(net.torque.flange, net.a.flange, net.gear.flange_a)
    return net.connect(net.gear.flange_b, net.b.flange, net.load.flange)


def test_a_gear_reduces_speed_and_multiplies_torque() -> None:
    run = geared(rotational.IdealGear(ratio=-3.0), 6.0, phi=0, w=0).simulate(1.0)
    # (J_a ratio^2 + J_b) a_b = ratio tau
    assert run["b.a"] == pytest.approx(-18.0 / 10.5)
    assert run["a.w"] == pytest.approx(-3 * run["b.w"])
    assert run["gear.flange_b.tau"] == pytest.approx(3 * run["gear.flange_a.tau"])


def test_a_gear_turns_its_housing_by_the_difference_of_torques() -> None:
    net = geared(rotational.IdealGear(ratio=3.0), 6.0, phi=0, w=0)
    net.add(housing=rotational.Inertia(J=5.0, phi=0, w=0))
    net.connect(net.gear.support, net.housing.flange)
    run = net.simulate(2.0, **TIGHT)
    a, b, c = (run[f"{name}.phi"] for name in ("a", "b", "housing"))
    assert a - c == pytest.approx(3 * (b - c))
    momentum = run["a.w"] + 1.5 * run["b.w"] + 5.0 * run["housing.w"]
    assert momentum == pytest.approx(6.0 * run["time"])
    reaction = run["gear.flange_a.tau"] + run["gear.flange_b.tau"] + run["gear.support.tau"]
    assert reaction == pytest.approx(0 * a, abs=1e-12)


def planetary(**extra: rotational.Fixed) -> Network:
    net = Network(
        "planetary",
        drive=rotational.Torque(tau=2.0),
        sun=rotational.Inertia(J=1.0, phi=0, w=0),
        gear=rotational.IdealPlanetary(ratio=1.5),
        carrier=rotational.Inertia(J=10.0, phi=0, w=0),
        ring=rotational.Inertia(J=3.0),
        **extra,
    )
    net.connect(net.drive.flange, net.sun.flange, net.gear.sun)
    return net.connect(net.gear.carrier, net.carrier.flange).connect(net.gear.ring, net.ring.flange)


def test_a_planetary_gear_shares_speed_and_torque() -> None:
    run = planetary().simulate(1.0, **TIGHT)
    sun, carrier, ring = (run[f"{name}.w"] for name in ("sun", "carrier", "ring"))
    assert 2.5 * carrier == pytest.approx(sun + 1.5 * ring)
    assert run["gear.ring.tau"] == pytest.approx(1.5 * run["gear.sun.tau"])
    assert sun + 10 * carrier + 3 * ring == pytest.approx(2.0 * run["time"])
    energy = (sun**2 + 10 * carrier**2 + 3 * ring**2) / 2
    assert energy == pytest.approx(2.0 * run["sun.phi"])


def test_a_planetary_gear_with_its_ring_held_is_a_reduction() -> None:
    net = planetary(frame=rotational.Fixed())
    net.connect(net.frame.flange, net.ring.flange)
    run = net.simulate(1.0)
    assert run["sun.a"] == pytest.approx(2.0 / (1 + 10 / 2.5**2))


def test_a_planetary_gear_closes_a_kinematic_loop() -> None:
    net = planetary()
    net.add(belt=rotational.IdealGear(ratio=-2.0))
    net.connect(net.belt.flange_a, net.sun.flange).connect(net.belt.flange_b, net.ring.flange)
    run = net.simulate(1.0)
    # ring = -sun/2, carrier = (1 - 0.75)/2.5 sun = sun/10
    assert run["ring.w"] == pytest.approx(-0.5 * run["sun.w"])
    assert run["carrier.w"] == pytest.approx(0.1 * run["sun.w"])
    assert run["sun.a"] == pytest.approx(2.0 / (1 + 0.1 + 0.75))


@pytest.mark.parametrize(("internal", "side"), [(False, 1), (True, -1)])
def test_a_stiff_mesh_is_a_gear(internal: bool, side: int) -> None:
    mesh = rotational.GearMesh(r_a=0.02, r_b=0.06, k=1e10, d=1e6, internal=internal)
    run = geared(mesh, 6.0, w=0).simulate(1.0, start={"a.w": 0})
    assert run["a.w"][-1] == pytest.approx(6.0 / (1 + 1.5 / 9), rel=1e-4)
    assert run["b.w"][-1] == pytest.approx(-side * run["a.w"][-1] / 3, rel=1e-4)


@pytest.mark.parametrize("internal", [False, True])
def test_mesh_torques_balance_on_what_carries_the_axes(internal: bool) -> None:
    mesh = rotational.GearMesh(r_a=0.02, r_b=0.05, k=1e5, d=30.0, g=1e-4, internal=internal)
    net = geared(mesh, lambda t: 5 * ca.sin(9 * t), w=0)
    net.add(carrier=rotational.Inertia(J=2.0, w=0))
    net.connect(net.gear.support, net.carrier.flange)
    run = net.simulate(2.0, start={"a.w": 0}, **TIGHT)
    impulse = 5 / 9 * (1 - np.cos(9 * run["time"]))
    assert run["a.w"] + 1.5 * run["b.w"] + 2 * run["carrier.w"] == pytest.approx(impulse, abs=1e-7)
    power = sum(
        run[f"gear.{flange}.tau"] * run[f"{body}.w"]
        for flange, body in (("flange_a", "a"), ("flange_b", "b"), ("support", "carrier"))
    )
    assert power == pytest.approx(run["gear.f"] * run["gear.v_rel"], abs=1e-9)


def test_the_mesh_force_is_a_dead_zone_on_stiffness_and_damping() -> None:
    k, d, g = 1e5, 300.0, 2e-3
    mesh = rotational.GearMesh(r_a=0.1, r_b=0.2, k=k, d=d, g=g)
    net = Network(
        "mesh",
        drive=rotational.Position(phi_ref=lambda t: 0.1 * ca.sin(20 * t)),
        mesh=mesh,
        wall=rotational.Fixed(),
    )
    net.connect(net.drive.flange, net.mesh.flange_a).connect(net.wall.flange, net.mesh.flange_b)
    run = net.simulate(pi / 10)
    x, v = 0.01 * np.sin(20 * run["time"]), 0.2 * np.cos(20 * run["time"])
    contact = k * x + d * v
    beyond = np.where(contact > 0, k * (x - g) + d * v, k * (x + g) + d * v)
    expected = np.where(np.abs(contact) >= k * g, beyond, 0.0)
    assert run["mesh.f"] == pytest.approx(expected, abs=1e-6)
    assert run["mesh.flange_a.tau"] == pytest.approx(0.1 * expected, abs=1e-6)
    assert run["mesh.flange_b.tau"] == pytest.approx(0.2 * expected, abs=1e-6)
    assert (expected == 0).any()


def acceleration(table: object, torque: float, load: float, **start: float) -> float:
    run = geared(rotational.LossyGear(ratio=2.0, lossTable=table), torque, load, **start).simulate(0.01)
    return float(run["a.a"][0])


@pytest.mark.parametrize(
    ("torque", "load", "w", "expected"),
    [
        # tau_b = -2 (tau_a - loss), J_a = 1, J_b/4 = 0.375 seen at a
        (10.0, -1.0, 1.0, (0.8 * 10 - 0.5 - 0.3) / (0.8 + 0.375)),  # a drives forward
        (-10.0, 3.0, 1.0, (-10 + 0.7 * (1.5 - 0.4)) / (1 + 0.7 * 0.375)),  # b drives forward
        (-10.0, 1.0, -1.0, (-0.8 * 10 + 0.5 + 0.3) / (0.8 + 0.375)),  # a drives backward
        (10.0, -3.0, -1.0, (10 - 0.7 * (1.5 - 0.4)) / (1 + 0.7 * 0.375)),  # b drives backward
    ],
)
def test_losses_depend_on_the_side_that_drives(torque: float, load: float, w: float, expected: float) -> None:
    table = ((0, 0.8, 0.7, 0.3, 0.4),)
    found = acceleration(table, torque, load, w=w)
    assert found == pytest.approx(expected)


def demo(extra: Callable[[Network], None] | None = None) -> Result:
    gear = rotational.LossyGear(ratio=2.0, lossTable=((0, 0.5, 0.5, 0, 0),))
    net = geared(gear, lambda t: 10 * ca.sin(2 * pi * t), lambda t: -10 + 2.5 * t, phi=0, w=0)
    if extra:
        extra(net)
    return net.simulate(0.5, rtol=1e-9, atol=1e-12)


def test_a_lossy_gear_slides_sticks_and_turns_again() -> None:
    run = demo()
    events = [(e.time, e.target) for e in run.events if e.mode == "gear.mode"]
    assert [target for _, target in events] == ["backward", "stuck", "forward", "stuck", "backward"]
    times = [0, 0.08047713, 0.19951990, 0.37134278, 0.46453946]
    assert [time for time, _ in events] == pytest.approx(times, abs=1e-6)
    assert run["b.w"][-1] == pytest.approx(-0.016261929, abs=1e-7)
    rest = (run["time"] > 0.0805) & (run["time"] < 0.1995)
    assert (run["a.w"][rest] == 0).all()


def test_bearing_and_gear_stick_together() -> None:
    def add_bearing(net: Network) -> None:
        table = rotational.TabulatedFriction(tau_pos=((0, 0.5), (1, 1)))
        net.add(bearing=rotational.BearingFriction(friction=table))
        net.connect(net.bearing.flange, net.a.flange)

    run = demo(add_bearing)
    resting = np.abs(run["a.w"]) == 0
    for begin, end in ((0.063592, 0.230373), (0.308307, 0.472738)):
        inside = (run["time"] > begin) & (run["time"] < end)
        assert resting[inside].all()
        assert not resting[(run["time"] > begin - 0.02) & (run["time"] < begin - 0.001)].any()
    assert run["b.w"][-1] == pytest.approx(-0.009624279, abs=1e-7)
    assert any("bearing" in note for note in run.notes)


def test_a_lossy_gear_puts_the_rest_of_its_torques_on_the_housing() -> None:
    net = geared(rotational.LossyGear(ratio=2.0, lossTable=((0, 0.9, 0.8, 1, 1.2),)), 10.0, -2.0, w=3)
    net.add(housing=rotational.Fixed())
    net.connect(net.gear.support, net.housing.flange)
    run = net.simulate(1.0)
    total = run["gear.flange_a.tau"] + run["gear.flange_b.tau"]
    assert run["housing.flange.tau"] == pytest.approx(total)
    assert np.abs(total).min() > 1


def test_losses_vary_with_speed() -> None:
    table = ((0, 0.5, 0.5, 0, 0), (10, 0.9, 0.9, 1, 1))
    # at w_a = 5: eta 0.7, bearing 0.5, friction seen at a
    assert acceleration(table, 10.0, 0.0, w=2.5) == pytest.approx((0.7 * 10 - 0.5) / (0.7 + 0.375))


def test_impossible_efficiencies_are_refused() -> None:
    with pytest.raises(ModelError, match="efficiencies above 0 and at most 1"):
        geared(rotational.LossyGear(ratio=2.0, lossTable=((0, 1.1, 0.5, 0, 0),)), 1.0).dae()
