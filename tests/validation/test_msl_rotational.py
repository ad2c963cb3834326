"""MSL's Rotational examples that have no reference results here: each against the mechanics of its own.

Source: Modelica Standard Library 4.1.0, Mechanics.Rotational.Examples. Closed forms, roots and linear systems
are written out beside each example; a time that is a bare number comes from an integration of the example's
regimes made apart from this library.
"""

from collections.abc import Callable
from math import atanh, cos, pi, sin, sqrt
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational, signals
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq

Array = NDArray[np.float64]
Switches = Callable[[ia.Result, str], list[tuple[Any, str]]]

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}


def integral(run: ia.Result, power: Array) -> float:
    return float(np.trapezoid(power, run["time"]))


def test_friction(switches: Switches) -> None:
    """A clutch that locks, slips and locks, a brake that stops one end, a spring that rings until it is quiet."""
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
    run = net.simulate(3.0, step=1e-4, **TIGHT)

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
    assert (run["inertia1.w"][run["time"] > 0.641] == 0).all()

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
    start, end = ([run["spring.phi_rel"][i], run["spring.w_rel"][i]] for i in (begin, -1))
    assert end == pytest.approx(ringing @ start, abs=1e-7)


def lossy_gear_demo(**bearing: ia.Component) -> Network:
    net = Network(
        "LossyGearDemo",
        fixed=rotational.Fixed(),
        DriveSine=signals.Sine(amplitude=10, f=1),
        torque1=rotational.Torque(),
        Inertia1=rotational.Inertia(J=1),
        gear=rotational.LossyGear(ratio=2, lossTable=((0, 0.5, 0.5, 0, 0),)),
        Inertia2=rotational.Inertia(J=1.5, phi=0, w=0),
        load=signals.Ramp(height=5, duration=2, offset=-10),
        torque2=rotational.Torque(),
        **bearing,
    )
    net.connect(net.DriveSine.y, net.torque1.tau).connect(net.load.y, net.torque2.tau)
    shaft, ground = [net.torque1.flange, net.Inertia1.flange, net.gear.flange_a], [net.torque1.support]
    if bearing:
        shaft.append(net.bearingFriction.flange)
        ground.append(net.bearingFriction.support)
    net.connect(*shaft).connect(net.gear.flange_b, net.Inertia2.flange, net.torque2.flange)
    return net.connect(net.fixed.flange, *ground, net.gear.support, net.torque2.support)


def test_lossy_gear_demo1(switches: Switches) -> None:
    """A gear of efficiency 1/2: its load drives it backward, it locks, drives the load, locks, and again."""
    run = lossy_gear_demo().simulate(0.5, step=1e-3, **TIGHT)

    def impulse(t: float, gain: float) -> float:
        return -gain * 10 / (2 * pi) * cos(2 * pi * t) - 10 * t + 1.25 * t**2

    def backward(t: float, since: float = 0.0) -> float:
        return (impulse(t, 4) - impulse(since, 4)) / 4.75

    def forward(t: float) -> float:
        return (impulse(t, 1) - impulse(driven, 1)) / 1.75

    stopped = brentq(backward, 0.05, 0.1, xtol=1e-13)
    driven = brentq(lambda t: 10 * sin(2 * pi * t) - 10 + 2.5 * t, 0.1, 0.2, xtol=1e-13)
    held = brentq(forward, 0.3, 0.4, xtol=1e-13)
    lost = brentq(lambda t: 40 * sin(2 * pi * t) - 10 + 2.5 * t, 0.4, 0.5, xtol=1e-13)
    assert switches(run, "gear.mode") == [
        (0.0, "backward"),
        (pytest.approx(stopped, abs=1e-8), "stuck"),
        (pytest.approx(driven, abs=1e-8), "forward"),
        (pytest.approx(held, abs=1e-8), "stuck"),
        (pytest.approx(lost, abs=1e-8), "backward"),
    ]
    t = run["time"]
    resting = ((t > stopped) & (t < driven)) | ((t > held) & (t < lost))
    ends = [stopped, driven, held, lost]
    laws = [
        np.vectorize(f)
        for f in (backward, lambda t: 0.0, forward, lambda t: 0.0, lambda t: backward(t, lost))
    ]
    exact = np.select([t < end for end in ends], [law(t) for law in laws[:-1]], laws[-1](t))
    assert np.abs(run["Inertia1.w"] - exact).max() < 1e-8
    assert (run["Inertia1.w"][resting] == 0).all()
    assert 2 * run["Inertia2.w"] == pytest.approx(run["Inertia1.w"], abs=1e-15)
    power_a, power_b = (run[f"gear.flange_{x}.tau"] * run[f"Inertia{i}.w"] for x, i in ("a1", "b2"))
    a_drives = (t > driven) & (t < held)
    b_drives = (t > 0) & ~resting & ~a_drives
    assert power_b[a_drives] == pytest.approx(-0.5 * power_a[a_drives])
    assert power_a[b_drives] == pytest.approx(-0.5 * power_b[b_drives])


def test_lossy_gear_demo2() -> None:
    """As before with a bearing: at rest the two share what holds the shaft, and the run says so."""
    friction = rotational.TabulatedFriction(tau_pos=((0, 0.5), (1, 1)))
    net = lossy_gear_demo(bearingFriction=rotational.BearingFriction(friction=friction))
    run = net.simulate(0.5, step=1e-3, **TIGHT)
    assert any("not unique" in note and "gear" in note and "bearingFriction" in note for note in run.notes)

    def torques(t: float, gain: float) -> float:
        return gain * 10 * sin(2 * pi * t) - 10 + 2.5 * t

    def moving(begin: float, direction: int, gain: float, inertia: float, end: float) -> tuple[Any, float]:
        def law(t: float, w: Array) -> Array:
            return (torques(t, gain) - direction * gain * (0.5 + 0.5 * abs(w))) / inertia

        def stop(t: float, w: Array) -> float:
            return float(direction * w[0]) + (1.0 if t < begin + 1e-3 else 0.0)

        stop.terminal = True  # type: ignore[attr-defined]
        found = solve_ivp(law, (begin, end), [0.0], rtol=1e-11, atol=1e-14, events=stop, dense_output=True)
        return found.sol, float(found.t[-1])

    first, stopped = moving(0.0, -1, 4, 4.75, 0.2)
    driven = brentq(lambda t: torques(t, 1) - 0.5, 0.2, 0.25, xtol=1e-13)
    second, held = moving(driven, 1, 1, 1.75, 0.4)
    lost = brentq(lambda t: torques(t, 4) + 2, 0.4, 0.5, xtol=1e-13)
    third, _ = moving(lost, -1, 4, 4.75, 0.5)
    t, w = run["time"], run["Inertia1.w"]
    for law, begin, end in ((first, 0.0, stopped), (second, driven, held), (third, lost, 0.5)):
        inside = (t > begin) & (t < end)
        assert w[inside] == pytest.approx(law(t[inside])[0], abs=1e-8)
    for begin, end in ((stopped, driven), (held, lost)):
        assert (w[(t > begin + 1e-7) & (t < end - 1e-7)] == 0).all()
    assert run["Inertia2.phi"][-1] == pytest.approx(-5.89181e-4, abs=1e-8)


def test_lossy_gear_demo3(switches: Switches) -> None:
    """Bearing loss stops the gear, w = 10 - 500 t, and then holds it against the torque of 1 N.m at 0.5 s."""
    net = Network(
        "LossyGearDemo3",
        torque1=rotational.Torque(tau=0),
        Inertia1=rotational.Inertia(J=0.001),
        gear=rotational.LossyGear(ratio=1, lossTable=((0, 0.25, 0.25, 0.625, 2.5),)),
        Inertia2=rotational.Inertia(J=0.001, phi=0, w=10),
        step1=signals.Step(start_time=0.5),
        torque2=rotational.Torque(),
    )
    net.connect(net.torque1.flange, net.Inertia1.flange, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.Inertia2.flange, net.torque2.flange)
    run = net.connect(net.step1.y, net.torque2.tau).simulate(1.0, step=1e-3, **TIGHT)
    assert switches(run, "gear.mode") == [(0.0, "forward"), (pytest.approx(0.02, abs=1e-9), "stuck")]
    t = run["time"]
    assert run["Inertia1.w"] == pytest.approx(np.maximum(10 - 500 * t, 0), abs=1e-8)
    assert (run["Inertia1.w"][t > 0.0201] == 0).all()
    assert run["Inertia1.phi"][-1] == pytest.approx(0.1, abs=1e-9)
    assert run["gear.tau_loss"] == pytest.approx(np.where(t < 0.02, 1, run["step1.y"]), abs=1e-9)
