"""MSL's Rotational examples that have no reference results here: each against the mechanics of its own.

Source: Modelica Standard Library 4.1.0, Mechanics.Rotational.Examples. Closed forms, roots and linear systems
are written out beside each example; a time that is a bare number comes from an integration of the example's
regimes made apart from this library.
"""

from collections.abc import Callable
from math import atanh, pi, sqrt
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational, signals
from numpy.typing import NDArray
from scipy.linalg import expm
from scipy.optimize import brentq

Array = NDArray[np.float64]
Switches = Callable[[ia.Result, str], list[tuple[Any, str]]]

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-14}


def integral(run: ia.Result, power: Array) -> float:
    return float(np.trapezoid(power, run["time"]))


def test_friction(switches: Switches) -> None:
    """A clutch locks, slips and locks; a brake stops one end; what is left rings on the spring."""
    net = Network(
        "Friction",
        fixed=rotational.Fixed(),
        sine=signals.Sine(amplitude=200, f=50 / pi),
        step2=signals.Step(height=-1, offset=1, start_time=0.5),
        product=signals.Product(),
        torque=rotational.Torque(),
        inertia3=rotational.Inertia(J=1, phi=0, w=100),
        clutch=rotational.Clutch(fn_max=160, f_normalized=1),
        inertia2=rotational.Inertia(J=0.05, phi=0, w=90),
        spring=rotational.SpringDamper(c=160, d=1),
        step=signals.Step(start_time=0.5),
        brake=rotational.Brake(fn_max=1600),
        inertia1=rotational.Inertia(J=1, phi=0, w=90),
    )
    net.connect(net.sine.y, net.product.u1).connect(net.step2.y, net.product.u2)
    net.connect(net.product.y, net.torque.tau).connect(net.step.y, net.brake.f_normalized)
    net.connect(net.torque.flange, net.inertia3.flange, net.clutch.flange_a)
    net.connect(net.clutch.flange_b, net.inertia2.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.brake.flange, net.inertia1.flange)
    net.connect(net.fixed.flange, net.brake.support, net.torque.support)
    run = net.simulate(3.0, step=2e-4, **TIGHT)

    assert switches(run, "clutch.mode") == [
        (0.0, "backward"),
        (pytest.approx(0.00677971, abs=1e-7), "stuck"),
        (pytest.approx(0.05933928, abs=1e-7), "backward"),
        (pytest.approx(0.10928983, abs=1e-7), "stuck"),
        (pytest.approx(0.53424834, abs=1e-7), "backward"),
        (pytest.approx(1.66364144, abs=3e-7), "stuck"),
    ]
    assert switches(run, "brake.mode") == [
        (pytest.approx(0.5), "forward"),
        (pytest.approx(0.64061394, abs=3e-7), "stuck"),
    ]
    assert (np.abs(run["inertia1.w"][run["time"] > 0.641]) < 1e-12).all()

    clutch, brake = run["clutch.tau"] * run["clutch.w_rel"], run["brake.tau"] * run["brake.w"]
    damper = run["spring.d"] * run["spring.w_rel"] ** 2
    assert min(clutch.min(), brake.min()) > -1e-9
    energy = run["inertia3.w"] ** 2 + 0.05 * run["inertia2.w"] ** 2 + run["inertia1.w"] ** 2
    energy = (energy + 160 * run["spring.phi_rel"] ** 2) / 2
    work = integral(run, run["torque.tau"] * run["inertia3.w"] - clutch - brake - damper)
    assert work == pytest.approx(energy[-1] - energy[0], rel=1e-6)

    # all locked but the spring: 1.05 w' = -160 phi - w
    begin = int(np.searchsorted(run["time"], 1.7))
    ringing = expm(np.array([[0, 1], [-160 / 1.05, -1 / 1.05]]) * (run["time"][-1] - run["time"][begin]))
    spring = np.array([run["spring.phi_rel"], run["spring.w_rel"]])
    assert spring[:, -1] == pytest.approx(ringing @ spring[:, begin], abs=1.5e-6)


def test_one_way_clutch(switches: Switches) -> None:
    """A freewheel that locks, lets go, is pressed (1.5 N.m while it slips), locks, is released, and again."""
    net = Network(
        "OneWayClutch",
        sine=signals.Sine(amplitude=10, f=3),
        torque=rotational.Torque(),
        inertiaIn=rotational.Inertia(J=1, phi=0, w=-0.5),
        oneWayClutch=rotational.OneWayClutch(peak=25, fn_max=3),
        pulse=signals.Pulse(period=1.3, start_time=0.3),
        inertiaOut=rotational.Inertia(J=1, phi=0, w=0),
    )
    net.connect(net.sine.y, net.torque.tau).connect(net.pulse.y, net.oneWayClutch.f_normalized)
    net.connect(net.torque.flange, net.inertiaIn.flange, net.oneWayClutch.flange_a)
    net.connect(net.oneWayClutch.flange_b, net.inertiaOut.flange)
    run = net.simulate(2.0, step=2e-4, **TIGHT)

    def given(t: Any, since: float = 0.0) -> Any:
        return 10 / (6 * pi) * (np.cos(6 * pi * since) - np.cos(6 * pi * t))

    def ahead(t: float, released: float, pressed: float) -> float:
        return float(-given(t, released) - 2 * 1.5 * (t - pressed))

    # it carries half of the drive's torque and lets go, unpressed, at 1e-4 of 1.5 N.m
    late = np.arcsin(2 * 1.5e-4 / 10) / (6 * pi)
    # at 1.5 s it comes to rest a moment before the drive turns, and lets go as long after
    lets_go = 1 / 6 + late, 0.95, 7 / 6 + late, 3 / 2 + late
    locks = [
        pytest.approx(brentq(lambda t: given(t) - 0.5, 0.0, 1 / 6, xtol=1e-13), abs=3e-8),
        pytest.approx(brentq(ahead, 0.31, 0.5, (lets_go[0], 0.3), xtol=1e-13), abs=3e-8),
        pytest.approx(1.05, abs=3e-8),
        pytest.approx(3 / 2 - late, abs=1e-7),
        pytest.approx(brentq(ahead, 1.61, 1.8, (lets_go[3], 1.6), xtol=1e-13), abs=3e-8),
    ]
    found = switches(run, "oneWayClutch.mode")
    assert [t for t, mode in found if mode == "forward"] == pytest.approx([0.0, *lets_go], abs=1e-8)
    assert [t for t, mode in found if mode == "stuck"] == locks

    t, slip = run["time"], run["oneWayClutch.w_rel"]
    assert run["inertiaIn.w"] + run["inertiaOut.w"] == pytest.approx(given(t) - 0.5, abs=1e-7)
    assert slip.min() > -1e-9
    assert run["inertiaIn.phi"][-1] == pytest.approx(-0.21234999, abs=5e-8)
    assert run["oneWayClutch.phi_rel"][-1] == pytest.approx(0.48573293, abs=5e-8)
    energy = (run["inertiaIn.w"] ** 2 + run["inertiaOut.w"] ** 2) / 2
    heat = np.where(run["pulse.y"] > 0, 1.5, 0.0) * slip
    work = integral(run, run["torque.tau"] * run["inertiaIn.w"] - heat)
    assert work == pytest.approx(energy[-1] - energy[0], abs=2e-6)


def test_elastic_bearing() -> None:
    """A gear in an elastic housing: linear, so exponentials of its matrix are exact, before and after 5 s."""
    net = Network(
        "ElasticBearing",
        fixed=rotational.Fixed(),
        ramp=signals.Ramp(height=100, duration=5),
        torque=rotational.Torque(),
        shaft=rotational.Inertia(J=1, phi=0, w=0),
        idealGear=rotational.IdealGear(ratio=3),
        spring=rotational.Spring(c=1e3, phi_rel=0),
        load=rotational.Inertia(J=50, w=0),
        housing=rotational.Inertia(J=5),
        springDamper=rotational.SpringDamper(c=1e5, d=5, phi_rel=0, w_rel=0),
    )
    net.connect(net.ramp.y, net.torque.tau)
    net.connect(net.torque.flange, net.shaft.flange, net.idealGear.flange_a)
    net.connect(net.idealGear.flange_b, net.spring.flange_a).connect(net.spring.flange_b, net.load.flange)
    net.connect(net.idealGear.support, net.housing.flange, net.springDamper.flange_b)
    net.connect(net.fixed.flange, net.springDamper.flange_a, net.torque.support)
    run = net.simulate(10.0, step=1e-2, **TIGHT)

    names = ["shaft.phi", "load.phi", "housing.phi", "shaft.w", "load.w", "housing.w"]
    spring = 1e3 * np.array([-1 / 3, 1, -2 / 3])  # its torque, from the angles of shaft, load and housing
    motion = np.zeros((8, 8))  # angles, speeds, torque of the drive, its rate
    motion[:3, 3:6] = np.eye(3)
    motion[3:6, :3] = np.outer([1 / 3, -1 / 50, 2 / 3 / 5], spring)
    motion[5, [2, 5]] += -1e5 / 5, -5 / 5
    motion[3, 6] = motion[6, 7] = 1
    rising = expm(5 * motion)[:, 7] * 20
    at_end = expm(5 * motion) @ [*rising[:7], 0]
    for exact, i in ((rising, int(np.searchsorted(run["time"], 5.0))), (at_end, -1)):
        found = np.array([run[name][i] for name in names])
        assert found == pytest.approx(exact[:6], rel=1e-7, abs=1e-8)
    # the housing takes 2/3 of the spring's torque; shaft and load share what the drive gives
    given = np.where(run["time"] < 5, 10 * run["time"] ** 2, 100 * run["time"] - 250)
    assert run["shaft.w"] + 50 / 3 * run["load.w"] == pytest.approx(given, abs=1e-5)


def test_simple_gear_shift(switches: Switches) -> None:
    """First gear against a braked ring, the shift, then the planetary locked by its clutch: direct drive."""
    fan = 20 / 10.471975511966**2
    net = Network(
        "SimpleGearShift",
        fixed=rotational.Fixed(),
        torqueStep=signals.Step(height=20, start_time=0.5),
        torque=rotational.Torque(),
        engine=rotational.Inertia(J=1),
        idealPlanetary=rotational.IdealPlanetary(ratio=1.5),
        clutch=rotational.Clutch(cgeo=2, fn_max=100, phi_rel=0, w_rel=0),
        brake=rotational.Brake(cgeo=2, fn_max=100),
        load=rotational.Inertia(J=10, phi=0, w=0),
        loadTorque=rotational.QuadraticDamper(k=fan),
        shift=signals.Ramp(duration=0.1, start_time=2),
        one=signals.Constant(k=1),
        feedback=signals.Add(k2=-1),
    )
    net.connect(net.torqueStep.y, net.torque.tau).connect(net.one.y, net.feedback.u1)
    net.connect(net.shift.y, net.clutch.f_normalized, net.feedback.u2)
    net.connect(net.feedback.y, net.brake.f_normalized)
    net.connect(net.torque.flange, net.engine.flange, net.idealPlanetary.sun, net.clutch.flange_a)
    net.connect(net.clutch.flange_b, net.idealPlanetary.ring, net.brake.flange)
    net.connect(net.idealPlanetary.carrier, net.load.flange, net.loadTorque.flange_b)
    net.connect(net.fixed.flange, net.loadTorque.flange_a, net.torque.support, net.brake.support)
    run = net.simulate(5.0, step=5e-4, **TIGHT)

    assert switches(run, "clutch.mode") == [
        (pytest.approx(2.0, abs=1e-8), "backward"),
        (pytest.approx(2.11079036, abs=1e-7), "stuck"),
    ]
    assert switches(run, "brake.mode") == [
        (0.0, "stuck"),
        (pytest.approx(2.04081627, abs=1e-7), "forward"),
        (pytest.approx(2.1, abs=1e-8), "free"),
    ]
    t, engine, load = run["time"], run["engine.w"], run["load.w"]
    assert 2.5 * load == pytest.approx(engine + 1.5 * run["brake.w"], abs=1e-9)
    # (10 + 2.5^2) w' = 2.5 20 - fan w^2, then (10 + 1) w' = 20 - fan w^2
    first, direct = t <= 2, t > 2.1108
    speeding = sqrt(50 / fan) * np.tanh(sqrt(50 * fan) / 16.25 * np.maximum(t - 0.5, 0))
    assert load[first] == pytest.approx(speeding[first], abs=2e-7)
    assert (np.abs(run["brake.w"][first]) < 1e-12).all()
    top, begin = sqrt(20 / fan), int(np.argmax(direct))
    since = sqrt(20 * fan) / 11 * (t - t[begin]) + atanh(load[begin] / top)
    assert load[direct] == pytest.approx(top * np.tanh(since[direct]), abs=1e-7)
    assert engine[direct] == pytest.approx(load[direct], abs=1e-12)
    assert load[-1] == pytest.approx(8.090035, abs=1e-6)
    clutch, brake = run["clutch.tau"] * run["clutch.w_rel"], run["brake.tau"] * run["brake.w"]
    assert min(clutch.min(), brake.min()) > -1e-9
    work = integral(run, run["torque.tau"] * engine - fan * load**3 - clutch - brake)
    assert work == pytest.approx((engine[-1] ** 2 + 10 * load[-1] ** 2) / 2, rel=3e-6)


def test_rolling_wheel() -> None:
    """Torque through a wheel against drag: 2 v' = 10 - 10 (v/5)^2 from 0.1 s on."""
    net = Network(
        "RollingWheel",
        torqueStep=signals.Step(height=10, start_time=0.1),
        torque=rotational.Torque(),
        inertia=rotational.Inertia(J=1, phi=0, w=0),
        idealRollingWheel=ia.RollingWheel(R=1),
        mass=ia.Mass(m=1),
        quadraticSpeedDependentForce=ia.QuadraticDamper(c=10 / 5**2),
        fixed=ia.Fixed(),
    )
    net.connect(net.torqueStep.y, net.torque.tau)
    net.connect(net.torque.flange, net.inertia.flange, net.idealRollingWheel.flange_r)
    drag = net.quadraticSpeedDependentForce
    net.connect(net.idealRollingWheel.flange_t, net.mass.flange, drag.flange_b)
    run = net.connect(net.fixed.flange, drag.flange_a).simulate(5.0, step=1e-3, **TIGHT)
    since = np.maximum(run["time"] - 0.1, 0)
    assert run["inertia.w"] == pytest.approx(5 * np.tanh(since), abs=1e-7)
    assert run["inertia.phi"] == pytest.approx(5 * np.log(np.cosh(since)), abs=1e-7)
    assert run["mass.s"] == pytest.approx(run["inertia.phi"], abs=1e-12)
    work = integral(run, run["torque.tau"] * run["inertia.w"] - 0.4 * run["mass.v"] ** 3)
    assert work == pytest.approx(run["mass.v"][-1] ** 2, rel=1e-6)
