"""MSL's Rotational LossyGearDemo1 to 3: a gear whose friction drives back, locks and lets go.

Source: Modelica Standard Library 4.1.0, Mechanics.Rotational.Examples. With both efficiencies 1/2 and a the
acceleration of Inertia1 (the torque at the mesh being positive throughout), turning forward
1.75 a = tau1 + tau2, backward 4.75 a = 4 tau1 + tau2; where tau1 is less the bearing's friction, if any.
"""

from collections.abc import Callable
from math import pi, sin
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational, signals
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import root_scalar

Array = NDArray[np.float64]
Switches = Callable[[ia.Result, str], list[tuple[Any, str]]]

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}
FORWARD, BACKWARD = 1, 4


def demo(**bearing: ia.Component) -> Network:
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


def driving(t: float, gain: float) -> float:
    """Return gain tau1 + tau2."""
    return gain * 10 * sin(2 * pi * t) - 10 + 2.5 * t


def driven(t: Any, since: float, gain: float) -> Any:
    """Return the integral of `driving`."""
    swing = np.cos(2 * pi * since) - np.cos(2 * pi * t)
    return gain * 10 / (2 * pi) * swing - 10 * (t - since) + 1.25 * (t**2 - since**2)


def test_demo1(switches: Switches) -> None:
    run = demo().simulate(0.5, step=1e-3, **TIGHT)
    stop1 = root_scalar(driven, args=(0.0, BACKWARD), bracket=(0.05, 0.1), xtol=1e-13).root
    start1 = root_scalar(driving, args=(FORWARD,), bracket=(0.1, 0.2), xtol=1e-13).root
    stop2 = root_scalar(driven, args=(start1, FORWARD), bracket=(0.3, 0.4), xtol=1e-13).root
    start2 = root_scalar(driving, args=(BACKWARD,), bracket=(0.4, 0.5), xtol=1e-13).root
    expected = [
        (0.0, "backward"),
        (stop1, "stuck"),
        (start1, "forward"),
        (stop2, "stuck"),
        (start2, "backward"),
    ]
    found = switches(run, "gear.mode")
    assert [target for _, target in found] == [target for _, target in expected]
    assert [t for t, _ in found] == pytest.approx([t for t, _ in expected], abs=1e-9)

    t, w = run["time"], run["Inertia1.w"]
    falls, rises, falls_again = t < stop1, (t > start1) & (t < stop2), t > start2
    assert w[falls] == pytest.approx(driven(t[falls], 0.0, BACKWARD) / 4.75, abs=1e-9)
    assert w[rises] == pytest.approx(driven(t[rises], start1, FORWARD) / 1.75, abs=1e-9)
    assert w[falls_again] == pytest.approx(driven(t[falls_again], start2, BACKWARD) / 4.75, abs=1e-9)
    rests = ((t > stop1 + 1e-8) & (t < start1)) | ((t > stop2 + 1e-8) & (t < start2 - 1e-8))
    assert (np.abs(w[rests]) < 1e-12).all()
    assert run["Inertia2.phi"][-1] == pytest.approx(1.6624e-5, abs=2e-9)


def test_demo1_loses_half_of_what_drives_it() -> None:
    run = demo().simulate(0.5, step=1e-3, **TIGHT)
    w = run["Inertia1.w"]
    power_a, power_b = run["gear.flange_a.tau"] * w, run["gear.flange_b.tau"] * run["Inertia2.w"]
    forward, backward = w > 1e-9, w < -1e-9
    assert forward.sum() > 100
    assert backward.sum() > 100
    assert power_b[forward] == pytest.approx(-0.5 * power_a[forward])
    assert power_a[backward] == pytest.approx(-0.5 * power_b[backward])
    assert run["gear.tau_loss"] * w == pytest.approx(power_a + power_b)


def test_demo2() -> None:
    """With a bearing of 0.5 + 0.5 |w| N.m before the gear: at rest the two share what holds the shaft."""
    friction = rotational.TabulatedFriction(tau_pos=((0, 0.5), (1, 1)))
    net = demo(bearingFriction=rotational.BearingFriction(friction=friction))
    run = net.simulate(0.5, step=1e-3, **TIGHT)
    assert any("not unique" in note and "gear" in note and "bearingFriction" in note for note in run.notes)

    def turning(begin: float, end: float, gain: float, inertia: float) -> Any:
        sense = 1 if gain == FORWARD else -1

        def law(t: float, w: Array) -> Array:
            return (driving(t, gain) - sense * gain * (0.5 + 0.5 * np.abs(w))) / inertia

        return solve_ivp(law, (begin, end), [0.0], rtol=1e-12, atol=1e-14, dense_output=True).sol

    falls = turning(0.0, 0.2, BACKWARD, 4.75)
    stop1 = root_scalar(lambda t: falls(t)[0], bracket=(0.04, 0.1), xtol=1e-13).root
    start1 = root_scalar(lambda t: driving(t, FORWARD) - 0.5, bracket=(0.2, 0.25), xtol=1e-13).root
    rises = turning(start1, 0.4, FORWARD, 1.75)
    stop2 = root_scalar(lambda t: rises(t)[0], bracket=(0.26, 0.4), xtol=1e-13).root
    start2 = root_scalar(lambda t: driving(t, BACKWARD) + 2, bracket=(0.4, 0.5), xtol=1e-13).root
    falls_again = turning(start2, 0.5, BACKWARD, 4.75)

    t, w = run["time"], run["Inertia1.w"]
    for law, begin, end in ((falls, 0.0, stop1), (rises, start1, stop2), (falls_again, start2, 0.5)):
        inside = (t > begin) & (t < end)
        assert w[inside] == pytest.approx(law(t[inside])[0], abs=1e-9)
    for begin, end in ((stop1, start1), (stop2, start2)):
        assert (np.abs(w[(t > begin + 1e-8) & (t < end - 1e-8)]) < 1e-12).all()
    assert run["Inertia2.phi"][-1] == pytest.approx(-5.89181e-4, abs=2e-9)


def test_demo3(switches: Switches) -> None:
    """Bearing loss of 1 N.m stops the gear, w = 10 - 500 t, then holds it against the torque at 0.5 s."""
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
    assert switches(run, "gear.mode") == [(0.0, "forward"), (pytest.approx(0.02, abs=1e-10), "stuck")]
    t, w = run["time"], run["Inertia1.w"]
    held = t > 0.0201
    assert w == pytest.approx(np.maximum(10 - 500 * t, 0), abs=1e-8)
    assert (w[held] == 0).all()
    assert run["Inertia1.phi"][-1] == pytest.approx(0.1, abs=1e-9)
    assert run["gear.tau_loss"][w > 0] == pytest.approx(1)
    assert run["gear.tau_loss"][held] == pytest.approx(run["step1.y"][held])
