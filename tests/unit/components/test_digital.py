"""Samplers and dead zones, and the servo that is made of them."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational, signals


def sampled(block: ia.Component, u: Any) -> ia.Network:
    net = ia.Network("sampled", block=block, follower=signals.FirstOrder(T=0.1))
    net.connect(net.block.y, net.follower.u)
    net.block.u = u
    return net


@pytest.mark.parametrize("solver", ["auto", "rosenbrock", "compiled"])
@pytest.mark.parametrize("delay", [0.0, 0.03])
def test_samples_are_taken_held_and_delayed(delay: float, solver: str) -> None:
    hold = signals.SampleHold(period=0.1, delay=delay, start_time=-0.05, y_0=0.7)
    run = sampled(hold, lambda t: np.sin(3 * t)).simulate(2.0, begin=0.12, step=0.01, solver=solver)
    t = run.time[run.time > 0.16]
    last = np.floor((t - delay + 0.05 + 1e-9) / 0.1)
    expected = np.where(last * 0.1 - 0.05 < 0.12, np.nan, np.sin(3 * (last * 0.1 - 0.05)))
    near = np.abs((t - delay + 0.05) / 0.1 - np.round((t - delay + 0.05) / 0.1)) < 1e-6
    known = ~np.isnan(expected) & ~near
    assert known.sum() > 100
    assert run["block.y"][run.time > 0.16][known] == pytest.approx(expected[known], abs=1e-6)


def test_a_sampled_loop_against_its_difference_equation() -> None:
    """An integrator under a sampled, delayed gain: x jumps in slope only, k + 1 from k and k - 1."""
    net = ia.Network("loop", hold=signals.SampleHold(period=0.1, delay=0.04), plant=signals.Integrator())
    net.add(gain=signals.Gain(k=-6.0))
    net.connect(net.plant.y, net.hold.u).connect(net.hold.y, net.gain.u).connect(net.gain.y, net.plant.u)
    run = net.simulate(2.0, step=0.1, start={"plant.x": 1.0}, rtol=1e-9)
    x, held, course = 1.0, 0.0, [1.0]
    for _ in range(20):
        x, held = x - 6 * (0.04 * held + 0.06 * x), x
        course.append(x)
    found = np.array([run.at("plant.x", 0.1 * k) for k in range(21)])
    assert found == pytest.approx(np.array(course), abs=1e-6)


def test_a_dead_zone() -> None:
    zone = signals.DeadZone(u_max=0.4, u_min=-0.1)
    run = sampled(zone, lambda t: np.sin(3 * t)).simulate(3.0, begin=1.0)
    u = np.sin(3 * run.time)
    expected = np.where(u > 0.4, u - 0.4, np.where(u < -0.1, u + 0.1, 0.0))
    assert run["block.y"] == pytest.approx(expected, abs=1e-12)
    assert not run.events


SERVO: dict[str, Any] = {
    "k_p": 40.0, "k_d": 0.6, "band": 0.01, "period": 5e-3, "delay": 2e-3, "ratio": 200.0, "J": 1e-7,
    "k": 0.01, "R": 4.0, "L": 1e-3, "u_max": 12.0, "i_max": 1.5,
}  # fmt: skip


def test_a_servo_against_a_loop_written_apart() -> None:
    net = ia.Network("arm", servo=ia.machines.Servo(**SERVO), arm=rotational.Inertia(J=0.02))
    net.connect(net.servo.flange, net.arm.flange)
    net.servo.reference = lambda t: 0.8 * np.sin(4 * t)
    run = net.simulate(1.0, step=5e-3, rtol=1e-8)
    phi = w = i = voltage = pending = 0.0
    step, inertia, course = 1e-5, 0.02 + 1e-7 * 200**2, []
    for n in range(100_000):
        if n % 500 == 0:
            error = 0.8 * np.sin(4 * n * step) - phi
            pending = 40 * (np.sign(error) * max(abs(error) - 0.01, 0)) - 0.6 * w
            course.append(phi)
        if n % 500 == 200:
            voltage = float(np.clip(pending, -12, 12))
        excess = voltage - 4 * i - 0.01 * 200 * w
        i = float(np.clip(i + step * excess / 1e-3, -1.5, 1.5))
        w += step * 0.01 * 200 * i / inertia
        phi += step * w
    found = np.array([run.at("arm.phi", 5e-3 * k) for k in range(200)])
    assert found == pytest.approx(np.array(course), abs=2e-3)
    assert np.ptp(found) > 0.6
    assert abs(run["servo.motor.i"]).max() <= 1.5 + 1e-9
