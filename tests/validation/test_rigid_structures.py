"""Constrained structures against their closed forms: what is rigidly joined moves as one."""

from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import rotational, signals


def test_rigidly_joined_masses_and_a_rod_are_one_mass() -> None:
    net = ia.Network(
        "joined",
        drive=ia.Force(f=6.0),
        left=ia.Mass(m=1.0),
        right=ia.Mass(m=2.0),
        rod=ia.Rod(L=0.5),
        far=ia.Mass(m=3.0),
    )
    net.connect(net.drive.flange, net.left.flange, net.right.flange, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.far.flange)
    run = net.simulate(2.0)
    assert len(net.dae().states) == 2
    assert run["far.a"] == pytest.approx(np.ones(len(run.time)))
    assert run["far.s"] - run["left.s"] == pytest.approx(np.full(len(run.time), 0.5))
    assert run["rod.flange_a.f"][-1] == pytest.approx(3.0)


def test_gear_and_screw_between_inertias() -> None:
    net = ia.Network(
        "geared",
        drive=rotational.Torque(tau=1.0),
        motor=rotational.Inertia(J=0.1),
        gear=rotational.IdealGear(ratio=10.0),
        load=rotational.Inertia(J=5.0),
    )
    net.connect(net.drive.flange, net.motor.flange, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.load.flange)
    run = net.simulate(1.0)
    assert run["motor.a"][-1] == pytest.approx(1.0 / (0.1 + 5.0 / 10.0**2))

    lead, J, m = 0.01, 1e-3, 2.0
    net = ia.Network(
        "screw",
        drive=ia.Force(f=100.0),
        mass=ia.Mass(m=m),
        screw=ia.NutScrew(lead=lead),
        flywheel=rotational.Inertia(J=J),
    )
    net.connect(net.drive.flange, net.mass.flange, net.screw.flange_t)
    net.connect(net.screw.flange_r, net.flywheel.flange)
    run = net.simulate(1.0)
    assert run["mass.a"][-1] == pytest.approx(100.0 / (m + (2 * np.pi / lead) ** 2 * J))


def test_position_driven_mass_from_function_data_and_signal() -> None:
    t = np.linspace(-0.5, 1.5, 4001)
    wanted: dict[str, dict[str, Any]] = {
        "function": {"s_ref": lambda t: 0.1 * ca.sin(7 * t)},
        "data": {"s_ref": ia.Sampled(t, 0.1 * np.sin(7 * t))},
        "signal": {},
    }
    for kind, bound in wanted.items():
        net = ia.Network("driven", drive=ia.Position(**bound), mass=ia.Mass(m=2.0))
        net.connect(net.drive.flange, net.mass.flange)
        if kind == "signal":
            net.add(sine=signals.Sine(amplitude=0.1, f=7 / (2 * np.pi)))
            net.connect(net.sine.y, net.drive.s_ref)
        run = net.simulate(1.0)
        assert run["mass.a"] == pytest.approx(-4.9 * np.sin(7 * run.time), abs=2e-4), kind
        assert run["drive.flange.f"] == pytest.approx(9.8 * np.sin(7 * run.time), abs=4e-4), kind


def test_closed_loop_through_a_planetary_gear() -> None:
    """Ring geared to the sun: (1 + r) w_c = w_s + r w_r with w_s = g w_r leaves one motion."""
    r, g = 2.0, 1.5
    net = ia.Network(
        "loop",
        drive=rotational.Torque(tau=1.0),
        planetary=rotational.IdealPlanetary(ratio=r),
        gear=rotational.IdealGear(ratio=g),
        sun=rotational.Inertia(J=1.0),
        carrier=rotational.Inertia(J=2.0),
    )
    net.connect(net.drive.flange, net.planetary.sun, net.gear.flange_a, net.sun.flange)
    net.connect(net.gear.flange_b, net.planetary.ring).connect(net.planetary.carrier, net.carrier.flange)
    run = net.simulate(1.0)
    share = (1 + r / g) / (1 + r)
    assert run["carrier.w"] == pytest.approx(share * run["sun.w"])
    assert run["sun.a"][-1] == pytest.approx(1.0 / (1.0 + 2.0 * share**2))


@pytest.mark.parametrize("rods", [False, True])
def test_a_thousand_masses_in_a_rigid_line(rods: bool) -> None:
    count = 1000
    net = ia.Network("line", drive=ia.Force(f=float(count)))
    masses = {f"m{i}": ia.Mass(m=1.0) for i in range(count)}
    net.add(**masses)
    if rods:
        joints = {f"r{i}": ia.Rod(L=0.1) for i in range(count - 1)}
        net.add(**joints)
        for i in range(count - 1):
            net.connect(masses[f"m{i}"].flange, joints[f"r{i}"].flange_a)
            net.connect(joints[f"r{i}"].flange_b, masses[f"m{i + 1}"].flange)
        net.connect(net.drive.flange, masses["m0"].flange)
    else:
        net.connect(net.drive.flange, *(mass.flange for mass in masses.values()))
    run = net.simulate(1.0, step=0.5, start={"m0.s": 0.0})
    assert len(run.dae.states) == 2
    assert run["m999.v"][-1] == pytest.approx(1.0)
    assert run["m999.s"][-1] == pytest.approx(0.5 + 0.1 * (count - 1) * rods, rel=1e-5)


def test_initial_values_fix_what_the_user_fixed_and_nothing_else() -> None:
    net = ia.Network(
        "start", wall=ia.Fixed(), spring=ia.Spring(k=100.0), rod=ia.Rod(L=1.0), near=ia.Mass(m=1.0),
        far=ia.Mass(m=1.0),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.near.flange, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.far.flange)
    run = net.simulate(0.1, start={"near.a": -5.0})
    assert run["near.s"][0] == pytest.approx(0.1)
    assert run["far.s"][0] == pytest.approx(1.1)
    assert any("fixed" in str(decision) or "solved" in str(decision) for decision in run.initial)
    with pytest.raises(ia.InitialConditionError, match=r"far\.s"):
        net.simulate(0.1, start={"near.s": 0.0, "far.s": 0.5})
