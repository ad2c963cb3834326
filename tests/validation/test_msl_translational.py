"""MSL's Translational examples that have no reference results here: each against the mechanics of its own.

Source: Modelica Standard Library 4.1.0, Mechanics.Translational.Examples. MSL's bodies with a length are
masses between rods here.
"""

from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import Network, signals
from scipy.linalg import expm

Switches = Callable[[ia.Result, str], list[tuple[Any, str]]]

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}


def test_brake(switches: Switches) -> None:
    """Two masses braked by 1 N from 0.1 s on, one against the ground, one against a Fixed: alike."""
    net = Network(
        "Brake",
        step=signals.Step(height=2, start_time=0.1),
        mass1=ia.Mass(m=1, s=0, v=1),
        brake1=ia.Brake(fn_max=1),
        mass2=ia.Mass(m=1, s=0, v=1),
        brake2=ia.Brake(fn_max=1),
        fixed=ia.Fixed(),
    )
    net.connect(net.step.y, net.brake1.f_normalized, net.brake2.f_normalized)
    net.connect(net.mass1.flange, net.brake1.flange).connect(net.mass2.flange, net.brake2.flange)
    run = net.connect(net.brake2.support, net.fixed.flange).simulate(2.0, step=1e-3, **TIGHT)
    t = run["time"]
    for i in (1, 2):
        assert switches(run, f"brake{i}.mode") == [
            (pytest.approx(0.1, abs=1e-12), "forward"),
            (pytest.approx(1.1, abs=1e-12), "stuck"),
        ]
        assert run[f"mass{i}.v"] == pytest.approx(np.clip(1.1 - t, 0, 1), abs=1e-10)
        assert (run[f"mass{i}.v"][t > 1.1] == 0).all()
        assert run[f"mass{i}.s"][-1] == pytest.approx(0.6, abs=1e-8)
        heat = np.trapezoid(run[f"brake{i}.f"] * run[f"brake{i}.v"], t)
        assert heat == pytest.approx(0.5, abs=1e-9)
    assert run["fixed.flange.f"] == pytest.approx(run["brake2.f"])


def preloaded_valve() -> Network:
    contact: dict[str, Any] = {"k": 1e6, "d": 250}
    plate = {"m": 0.010, "v": 0}
    net = Network(
        "PreLoad",
        fixedLe=ia.Fixed(s0=-0.0955),
        housing=ia.Rod(L=0.0305),
        spool=ia.Mass(m=0.150, s=0.01475, v=0),
        spool_half=ia.Rod(L=0.095),
        springPlateA=ia.Mass(s=-0.093, **plate),
        springPlateB=ia.Mass(s=-0.06925, **plate),
        **{f"half_{side}{end}": ia.Rod(L=0.001) for side in "AB" for end in "ab"},
        outerContactA=ia.ElastoGap(s_rel0=0.0015, **contact),
        outerContactB=ia.ElastoGap(s_rel0=0.0015, **contact),
        innerContactA=ia.ElastoGap(s_rel0=0.001, **contact),
        innerContactB=ia.ElastoGap(s_rel0=0.001, **contact),
        spring=ia.Spring(k=20e3, s_rel0=0.025),
        rod1=ia.Rod(L=0.007),
        rod2=ia.Rod(L=0.007),
        rod3=ia.Rod(L=0.00575),
        rod4=ia.Rod(L=0.00575),
        friction=ia.Damper(d=2500),
        sineForce=signals.Sine(amplitude=150, f=0.01),
        force=ia.Force(),
    )
    net.connect(net.sineForce.y, net.force.f)
    net.connect(net.half_Aa.flange_b, net.springPlateA.flange, net.half_Ab.flange_a)
    net.connect(net.half_Ba.flange_b, net.springPlateB.flange, net.half_Bb.flange_a)
    net.connect(
        net.fixedLe.flange, net.outerContactA.flange_a, net.housing.flange_a, net.friction.flange_a
    )  # fmt: skip
    net.connect(net.outerContactA.flange_b, net.half_Aa.flange_a)
    net.connect(net.half_Ab.flange_b, net.spring.flange_a, net.rod1.flange_a)
    net.connect(net.spring.flange_b, net.half_Ba.flange_a, net.rod2.flange_b)
    net.connect(net.half_Bb.flange_b, net.outerContactB.flange_a)
    net.connect(net.outerContactB.flange_b, net.housing.flange_b)
    net.connect(net.rod1.flange_b, net.innerContactA.flange_b)
    net.connect(net.innerContactA.flange_a, net.rod3.flange_a, net.friction.flange_b)
    net.connect(net.rod3.flange_b, net.rod4.flange_a, net.spool_half.flange_a, net.force.flange)
    net.connect(net.spool_half.flange_b, net.spool.flange)
    net.connect(net.rod4.flange_b, net.innerContactB.flange_b)
    return net.connect(net.innerContactB.flange_a, net.rod2.flange_a)


def test_preload() -> None:
    """A spool that a preloaded spring holds in the middle until the force exceeds the preload."""
    run = preloaded_valve().simulate(100.0, step=0.1, **TIGHT)
    t, spool, force = run["time"], run["spool.s"], run["force.f"]
    contacts = [run[f"{where}Contact{side}.f"] for where in ("inner", "outer") for side in "AB"]
    assert max(f.max() for f in contacts) <= 0
    # statics: while |load| < 29.4 N all contacts hold the spool; beyond, two and the spring yield in a row
    load = force - 2500 * run["spool.v"]
    yielded = np.sign(load) * ((np.abs(load) - 30) / 20e3 + 2e-6 * np.abs(load))
    exact = np.where(np.abs(load) < 30 / 1.02, load / 1e6, yielded)
    calm = t > 0.05  # plate B has shot to its stop
    assert np.abs(spool - 0.01475 - exact)[calm].max() < 4e-8
    assert np.ptp(spool[calm]) == pytest.approx(2 * (120 / 20e3 + 300e-6), rel=1e-4)
    for instant, s in {5.0: 0.01559958, 25.0: 0.02104948, 75.0: 0.00845052}.items():
        assert run.at("spool.s", instant) == pytest.approx(s, abs=1e-8)
    # without force the spring shares its 1.5 mm with the contacts: 20e3 (0.0015 - 2 x) = 2e6 x at a plate
    rest, x = int(np.searchsorted(t, 50.0)), 30 / 2.04e6
    plates = run["springPlateB.s"] - run["springPlateA.s"]
    assert plates[rest] == pytest.approx(0.0255 + 2 * x, abs=1e-10)


def test_initial_conditions() -> None:
    """Start values of springs determine those of masses; a linear system, so its exponential is exact."""
    net = Network("InitialConditions")
    bodies = {
        "m1": (ia.Mass(m=1, v=0), 0.5),
        "m2": (ia.Mass(m=1), 1.0),
        "m3": (ia.Mass(m=1, s=4.5, v=0), 1.5),
        "m4": (ia.Mass(m=1, s=12.5, v=0), 2.5),
    }
    for name, (mass, half) in bodies.items():
        left = ia.Rod(L=half)
        net.add(**{name: mass, f"{name}_left": left}).connect(left.flange_b, mass.flange)
    net.add(
        fixed1=ia.Fixed(s0=-1),
        s1=ia.Spring(k=1e3, s_rel0=1, s_rel=0.5),
        sd1=ia.SpringDamper(k=111, d=1, s_rel0=1, s_rel=1, v_rel=0),
        fixed2=ia.Fixed(s0=1),
        s2=ia.Spring(k=1e3, s_rel0=2),
        sd2=ia.SpringDamper(k=111, d=1, s_rel0=4),
        m1_right=ia.Rod(L=0.5),
        m3_right=ia.Rod(L=1.5),
    )
    net.connect(net.fixed1.flange, net.s1.flange_a).connect(net.s1.flange_b, net.m1_left.flange_a)
    net.connect(net.m1.flange, net.m1_right.flange_a).connect(net.m1_right.flange_b, net.sd1.flange_a)
    net.connect(net.sd1.flange_b, net.m2_left.flange_a)
    net.connect(net.fixed2.flange, net.s2.flange_a).connect(net.s2.flange_b, net.m3_left.flange_a)
    net.connect(net.m3.flange, net.m3_right.flange_a).connect(net.m3_right.flange_b, net.sd2.flange_a)
    net.connect(net.sd2.flange_b, net.m4_left.flange_a)
    run = net.simulate(5.0, step=1e-2, **TIGHT)

    states = np.array([run["m1.s"] - 0.5, run["m2.s"] - 3, run["m1.v"], run["m2.v"]])
    assert states[:, 0] == pytest.approx([-0.5, -0.5, 0, 0], abs=1e-12)
    motion = np.zeros((4, 4))
    motion[:2, 2:] = np.eye(2)
    motion[2:] = [[-1111, 111, -1, 1], [111, -111, 1, -1]]
    exact = np.array([expm(motion * t) @ states[:, 0] for t in run["time"][::50]]).T
    assert states[:, ::50] == pytest.approx(exact, abs=1.5e-6)
    for name, (s, v) in {"m3": (4.5, 0), "m4": (12.5, 0)}.items():
        assert np.abs(run[f"{name}.s"] - s).max() < 1e-12
        assert np.abs(run[f"{name}.v"] - v).max() < 1e-12
