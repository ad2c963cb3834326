"""Controllers alone and in closed loops with a mass."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import signals
from scipy.linalg import expm

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}


def test_pi_answers_a_step_with_a_ramp() -> None:
    net = ia.Network("alone", pi=signals.PI(k=3.0, T=0.5))
    run = net.simulate(1.0, inputs={"pi.u": 2.0})
    assert run["pi.y"] == pytest.approx(6 + 12 * run.time)


def test_pid_answers_a_step() -> None:
    """y = k (1 + t/Ti + Nd exp(-Nd t/Td)) for a unit step."""
    net = ia.Network("alone", pid=signals.PID(k=2.0, Ti=0.5, Td=0.1, Nd=5.0))
    run = net.simulate(1.0, inputs={"pid.u": 1.0}, **TIGHT)
    expected = 2 * (1 + run.time / 0.5 + 5 * np.exp(-50 * run.time))
    assert run["pid.y"] == pytest.approx(expected, abs=1e-6)


def servo(control: ia.Component, m: float = 10.0, friction: float = 0.0, delay: float = 0.0) -> ia.Network:
    """A mass that a controller with setpoint and measurement moves by a force."""
    net = ia.Network(
        "servo", control=control, drive=ia.Force(), sensor=ia.PositionSensor(),
        mass=ia.Mass(m=m, s=0.0, v=0.0),
    )  # fmt: skip
    net.connect(net.control.y, net.drive.f)
    net.connect(net.drive.flange, net.mass.flange, net.sensor.flange)
    if friction:
        net.add(guide=ia.SupportFriction(friction=ia.CoulombFriction(f_c=friction)))
        net.connect(net.guide.flange, net.mass.flange)
    if not delay:
        net.connect(net.sensor.s, net.control.u_m)
    else:
        net.add(delay=signals.Delay(T=delay, n=4))
        net.connect(net.sensor.s, net.delay.u)
        net.connect(net.delay.y, net.control.u_m)
    return net


def test_servo_far_from_its_limits_is_a_linear_system() -> None:
    """LimPID with all weights 1 on m s'' = f, against the matrix exponential."""
    m, k, Ti, Td, Nd = 10.0, 2000.0, 0.2, 0.05, 20.0
    net = servo(signals.LimPID(k=k, Ti=Ti, Td=Td, Nd=Nd, wd=1.0, y_max=1e9), m)
    run = net.simulate(1.0, inputs={"control.u_s": 0.01}, **TIGHT)
    A = np.zeros((5, 5))  # s, v, x, x_d and the setpoint
    error = np.array([-1.0, 0, 0, 0, 1])
    A[0, 1] = 1
    A[3] = Nd / Td * (error - np.eye(5)[3])
    A[1] = k / m * (error + np.eye(5)[2] + Nd * (error - np.eye(5)[3]))
    A[2] = error / Ti
    for t in (0.05, 0.3, 1.0):
        expected = (expm(A * t) @ [0, 0, 0, 0, 0.01])[0]
        assert run.at("mass.s", t) == pytest.approx(expected, abs=1e-8)


def test_limited_servo_drives_at_its_limit() -> None:
    net = servo(signals.LimPID(k=2000.0, Ti=0.2, Td=0.1, Nd=20.0, y_max=20.0))
    run = net.simulate(8.0, inputs={"control.u_s": 0.5}, step=1e-2, **TIGHT)
    full = run.time <= 0.2
    assert run["control.y"][full] == pytest.approx(np.full(full.sum(), 20.0))
    assert run["mass.s"][full] == pytest.approx(run.time[full] ** 2, abs=1e-7)
    assert run["control.y"].min() == pytest.approx(-20.0)
    assert run["mass.s"][-1] == pytest.approx(0.5, abs=1e-4)


def test_anti_windup_holds_the_integral_while_limited() -> None:
    """With e constant and y at its limit, x settles where Ti x' = e + (y_max - v)/(k Ni) = 0."""
    net = ia.Network("alone", control=signals.LimPI(k=2.0, Ti=0.1, Ni=0.5, y_max=3.0))
    run = net.simulate(2.0, inputs={"control.u_s": 5.0, "control.u_m": 0.0}, **TIGHT)
    assert run["control.y"] == pytest.approx(np.full(len(run.time), 3.0))
    excess = 2.0 * 0.5 * 5.0
    assert run["control.v"][-1] == pytest.approx(3.0 + excess, abs=1e-6)
    assert run["control.x"][-1] == pytest.approx((3.0 + excess) / 2.0 - 5.0, abs=1e-6)


def test_setpoint_weight_acts_on_the_proportional_part_only() -> None:
    net = ia.Network("alone", control=signals.LimPI(k=2.0, Ti=0.5, wp=0.25, y_max=1e3))
    run = net.simulate(1.0, inputs={"control.u_s": 4.0, "control.u_m": 1.0})
    assert run["control.y"] == pytest.approx(2.0 * (0.25 * 4.0 - 1.0 + 3.0 * run.time / 0.5))


def test_servo_follows_sampled_data() -> None:
    """A double integrator under PID follows 5 (1 - cos(2 pi t)) cm, known at 1 kHz, within 2 mm."""
    t = np.linspace(0, 2, 2001)
    path = ia.Sampled(t, 0.05 * (1 - np.cos(2 * np.pi * t)))
    net = servo(signals.LimPID(k=2e5, Ti=0.1, Td=0.05, Nd=50.0, wd=1.0, y_max=1e3))
    run = net.simulate(2.0, inputs={"control.u_s": path})
    assert run["control.u_s"] == pytest.approx(0.05 * (1 - np.cos(2 * np.pi * run.time)), abs=1e-9)
    assert np.abs(run["control.u_s"] - run["mass.s"]).max() < 2e-3
    assert not run.stats["events"]


def test_servo_with_friction_sticks_where_the_controller_is_too_weak() -> None:
    """Without integral (Ti huge) the mass rests in |k e| <= f_c, and truly rests."""
    net = servo(signals.LimPID(k=400.0, Ti=1e9, Td=0.1, y_max=50.0), friction=6.0)
    run = net.simulate(5.0, inputs={"control.u_s": 0.1}, rtol=1e-8, atol=1e-10)
    assert run.events[-1].target == "stuck"
    rest = run.time > run.events[-1].time
    assert np.abs(run["mass.v"][rest]).max() < 1e-12
    assert np.ptp(run["mass.s"][rest]) < 1e-12
    assert 0.0 < abs(0.1 - run["mass.s"][-1]) <= 6.0 / 400.0


@pytest.mark.parametrize(("share", "grows"), [(0.9, False), (1.1, True)])
def test_delay_margin_of_a_servo(share: float, grows: bool) -> None:
    """A PD servo bears a delay of its phase margin over its crossover frequency, and no more."""
    m, k, Td, Nd = 10.0, 4000.0, 0.05, 100.0
    w = np.linspace(1.0, 100.0, 100_001)
    s = 1j * w
    loop = k * (1 + Td * s / (1 + Td * s / Nd)) / (m * s**2)
    crossover = int(np.argmax(np.abs(loop) < 1))
    margin = (np.angle(-loop[crossover])) / w[crossover]
    control = signals.LimPID(k=k, Ti=1e9, Td=Td, Nd=Nd, y_max=1e9)
    net = servo(control, m, delay=share * margin)
    run = net.simulate(5.0, inputs={"control.u_s": 0.01})
    early, late = ((run.time > a) & (run.time < a + 1) for a in (1.0, 4.0))
    swings = [np.ptp(run["mass.s"][part]) for part in (early, late)]
    assert bool(swings[1] > swings[0]) is grows
