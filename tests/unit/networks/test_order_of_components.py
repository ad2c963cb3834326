"""The order in which components stand in a network changes nothing, also where a run begins with a sample."""

from itertools import permutations
from math import pi
from typing import Any

import inertance as ia
import numpy as np
import pytest
from elements import rig
from inertance import machines, rotational
from inertance.cli.catalogue import all_names

SERVO: dict[str, Any] = {
    "k_p": 40.0, "k_d": 0.6, "band": 0.01, "period": 5e-3, "delay": 2e-3, "ratio": 200.0, "J": 1e-7,
    "k": 0.01, "R": 4.0, "L": 1e-3, "u_max": 12.0, "i_max": 1.5,
}  # fmt: skip


def network(order: tuple[str, ...]) -> ia.Network:
    crank = machines.CrankInerter(
        crank=ia.SliderCrank(r=0.05, l=0.2), flywheel=ia.DiskFlywheel(m=1.0, R=0.05)
    )
    rub = rotational.CoulombFriction(tau_c=0.1)
    parts: dict[str, Any] = {
        "crank": [("crank", crank), ("frame", ia.Fixed()), ("push", ia.Force(f=-1.0))],
        "servo": [("servo", machines.Servo(**SERVO)), ("arm", rotational.Inertia(J=0.02))],
        "brake": [("wall", rotational.Fixed()), ("rub", rub), ("wheel", rotational.Inertia(J=0.1))],
    }
    net = ia.Network("three", **dict(pair for name in order for pair in parts[name]))
    net.connect(net.frame.flange, net.crank.flange_b).connect(net.crank.flange_a, net.push.flange)
    net.connect(net.servo.flange, net.arm.flange)
    return net.connect(net.wall.flange, net.rub.flange_a).connect(net.rub.flange_b, net.wheel.flange)


@pytest.mark.parametrize("order", list(permutations(("crank", "servo", "brake"))))
def test_a_start_that_fixes_no_state_goes_with_a_sample_at_once(order: tuple[str, ...]) -> None:
    start = {"crank.crank.phi": pi / 2, "crank.flywheel.w": 0.0}
    run = network(order).simulate(0.102, start=start, inputs={"servo.reference": lambda t: 0.5 + 0 * t})
    assert run["crank.crank.phi"][0] == pytest.approx(pi / 2, abs=1e-12)
    assert run["crank.flywheel.a"][0] == pytest.approx(0.05 / (1.0 * 0.05**2 / 2))
    assert run.at("servo.hold.sample", 0.001) == pytest.approx(40.0 * (0.5 - 0.01))
    assert run["servo.hold.count"][-1] == 21
    assert np.ptp(run["arm.phi"]) > 0.01


def test_no_equation_is_solved_for_what_its_parameters_take_out() -> None:
    """Beside these, in this order, a differential of ratio 1 was solved for its support, 1 - ratio over."""
    names = [
        "MassWithStopAndFriction", "Move", "Tyre", "VariableInerter", "machines.DigressiveDamper",
        "machines.MechatronicInerter", "machines.Servo", "machines.TMD", "machines.TorsionalDamper",
        "rotational.BearingFriction", "rotational.BilinearSpring", "rotational.Brake",
        "rotational.ConstantSpeed", "rotational.CoulombFriction", "rotational.CubicSpring",
        "rotational.DahlFriction", "rotational.Differential", "thermal.HeatCapacitor",
    ]  # fmt: skip
    parts = {}
    for name in names:
        warm = {"useHeatPort": True} if "useHeatPort" in all_names()[name].fields else {}
        parts[name.replace(".", "_").lower()] = rig(name, still=True, **warm)
    net = ia.Network("many", **parts)
    alone = rig("rotational.Differential", still=True).simulate(0.1)
    beside = net.simulate(0.1)
    for name in ("body0.w", "body1.w", "body3.w"):
        assert beside[f"rotational_differential.{name}"][-1] == pytest.approx(alone[name][-1], rel=1e-5)
