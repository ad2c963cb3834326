"""Brake and levers against closed forms."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import signals
from scipy.special import ellipk


def braked(signal: ia.Component, mass: ia.Mass, **brake: Any) -> ia.Network:
    net = ia.Network("braked", signal=signal, brake=ia.Brake(**brake), mass=mass, load=ia.Force())
    net.connect(net.signal.y, net.brake.f_normalized)
    net.connect(net.brake.flange, net.mass.flange, net.load.flange)
    return net


def switches(run: ia.Result, mode: str) -> list[tuple[Any, str]]:
    return [(pytest.approx(e.time, abs=1e-6), e.target) for e in run.events if e.mode == mode]


def test_brake_stops_a_mass() -> None:
    """MSL Translational.Examples.Brake: 1 N from 0.1 s on a mass of 1 kg at 1 m/s."""
    net = braked(signals.Step(height=2.0, start_time=0.1), ia.Mass(m=1.0, s=0.0, v=1.0), fn_max=1.0, cgeo=1.0)
    run = net.simulate(2.0, inputs={"load.f": 0.0}, rtol=1e-9, atol=1e-11)
    assert switches(run, "brake.mode") == [(0.1, "forward"), (1.1, "stuck")]
    assert run["mass.s"][-1] == pytest.approx(0.6, abs=1e-8)
    assert abs(run["mass.v"][-1]) < 1e-12


def test_brake_force_follows_its_table_of_friction() -> None:
    """With mu = 0.5 + 0.2 v: m v' = -fn (0.5 + 0.2 v)."""
    table = ((0.0, 0.5), (1.0, 0.7))
    net = braked(signals.Constant(k=1.0), ia.Mass(m=2.0, s=0.0, v=3.0), fn_max=10.0, mu_pos=table)
    run = net.simulate(0.6, inputs={"load.f": 0.0}, rtol=1e-9, atol=1e-11)
    assert run["mass.v"][-1] == pytest.approx(5.5 * np.exp(-0.6) - 2.5, abs=1e-7)


def test_brake_holds_up_to_break_away_and_releases() -> None:
    """A load of 2 t N breaks away from peak mu fn = 6 N at 3 s and then slides against 5 N."""
    net = braked(signals.Constant(k=1.0), ia.Mass(m=1.0), fn_max=10.0, peak=1.2)
    run = net.simulate(4.0, inputs={"load.f": lambda t: 2 * t}, rtol=1e-9, atol=1e-11)
    assert switches(run, "brake.mode") == [(0.0, "stuck"), (3.0, "forward")]
    assert np.abs(run["mass.v"][run.time <= 2.99]).max() < 1e-12
    assert run["brake.f"][run.time <= 2.99] == pytest.approx(2 * run.time[run.time <= 2.99])
    assert run["mass.v"][-1] == pytest.approx(16 - 9 - 5, abs=1e-6)


def test_released_brake_lets_go() -> None:
    net = braked(signals.Step(height=-1.0, offset=1.0, start_time=1.0), ia.Mass(m=2.0), fn_max=10.0)
    run = net.simulate(2.0, inputs={"load.f": 4.0}, rtol=1e-9, atol=1e-11)
    assert switches(run, "brake.mode") == [(0.0, "stuck"), (1.0, "free")]
    assert run["mass.v"][-1] == pytest.approx(2.0, abs=1e-8)


def test_brake_reacts_on_its_support() -> None:
    net = braked(signals.Constant(k=1.0), ia.Mass(m=1.0, s=0.0, v=4.0), fn_max=2.0)
    net.add(carrier=ia.Mass(m=3.0, s=0.0, v=0.0))
    net.connect(net.brake.support, net.carrier.flange)
    run = net.simulate(4.0, inputs={"load.f": 0.0}, rtol=1e-9, atol=1e-11)
    momentum = run["mass.v"] + 3 * run["carrier.v"]
    assert momentum == pytest.approx(np.full(len(momentum), 4.0), abs=1e-8)
    assert run["mass.v"][-1] == pytest.approx(1.0, abs=1e-8)
    assert abs(run["brake.v"][-1]) < 1e-12
    assert switches(run, "brake.mode") == [(0.0, "forward"), (3.0, "stuck")]


def levered(lever: ia.Component, m_a: float, m_b: float, **start: float) -> ia.Network:
    net = ia.Network("levered", lever=lever, a=ia.Mass(m=m_a, **start), b=ia.Mass(m=m_b), load=ia.Force())
    net.connect(net.load.flange, net.lever.flange_a, net.a.flange)
    net.connect(net.lever.flange_b, net.b.flange)
    return net


@pytest.mark.parametrize("ratio", [3.0, -0.5])
def test_lever_reflects_mass_by_its_ratio_squared(ratio: float) -> None:
    net = levered(ia.Lever(ratio=ratio), m_a=2.0, m_b=5.0, s=0.0, v=0.0)
    run = net.simulate(2.0, inputs={"load.f": 7.0})
    a = 7.0 / (2.0 + 5.0 / ratio**2)
    assert run["a.a"] == pytest.approx(np.full(len(run.time), a))
    assert run["b.a"] == pytest.approx(np.full(len(run.time), a / ratio))
    assert run["lever.flange_b.f"] == pytest.approx(-5.0 * run["b.a"])
    total = run["lever.flange_a.f"] + run["lever.flange_b.f"] + run["lever.support.f"]
    assert total == pytest.approx(0, abs=1e-12)


def test_lever_on_a_moving_fulcrum_conserves_momentum() -> None:
    net = levered(ia.Lever(ratio=-2.0), m_a=1.0, m_b=2.0, v=0.0)
    net.add(carrier=ia.Mass(m=4.0, s=0.0, v=0.0), spring=ia.Spring(k=50.0, s_rel0=0.3))
    net.connect(net.lever.support, net.carrier.flange, net.spring.flange_a)
    net.connect(net.b.flange, net.spring.flange_b)
    run = net.simulate(3.0, inputs={"load.f": 0.0}, start={"a.s": 0.0}, rtol=1e-9, atol=1e-11)
    momentum = run["a.v"] + 2 * run["b.v"] + 4 * run["carrier.v"]
    assert np.abs(momentum).max() < 1e-9
    assert np.ptp(run["b.v"]) > 0.1
    energy = (run["a.v"] ** 2 + 2 * run["b.v"] ** 2 + 4 * run["carrier.v"] ** 2) / 2
    energy += 25.0 * (run["spring.s_rel"] - 0.3) ** 2
    assert np.ptp(energy) < 1e-6 * energy.max()


def test_straight_large_angle_lever_is_a_lever() -> None:
    """Both ends go with the sine of one angle, so their ratio is constant at any angle."""
    large = ia.LargeAngleLever(l_a=0.2, l_b=0.1)
    ends = []
    for lever in (large, ia.Lever(ratio=-2.0)):
        net = levered(lever, m_a=2.0, m_b=5.0, v=0.0)
        run = net.simulate(0.15, inputs={"load.f": 20.0}, start={"a.s": 0.1}, rtol=1e-9, atol=1e-11)
        ends.append([run["a.s"][-1], run["b.v"][-1], run["lever.support.f"][-1]])
    assert ends[0] == pytest.approx(ends[1], rel=1e-6)
    assert 0.1 < ends[0][0] < 0.2


def test_bent_lever_is_a_pendulum() -> None:
    """Equal arms at a right angle with equal masses move as a point on a circle: l phi'' = g cos phi.

    The swing from phi = 0 through a dead centre of arm a to phi = pi takes half of the period
    4 K(sin(45 deg)) / sqrt(g/l).
    """
    length, g = 0.5, 9.81
    lever = ia.LargeAngleLever(l_a=length, l_b=length, alpha=np.pi / 2)
    net = levered(lever, m_a=2.0, m_b=2.0)
    half = 2 * ellipk(0.5) * np.sqrt(length / g)
    start = {"lever.phi": 0.0, "lever.w": 0.0}
    run = net.simulate(half, inputs={"load.f": 2.0 * g}, start=start, rtol=1e-10, atol=1e-12)
    assert run["lever.phi"][-1] == pytest.approx(np.pi, abs=1e-4)
    assert run["lever.w"].max() == pytest.approx(np.sqrt(2 * g / length), rel=1e-5)
    circle = run["a.s"] ** 2 + run["b.s"] ** 2
    assert circle == pytest.approx(np.full(len(circle), length**2))


def test_lever_needs_its_ratio() -> None:
    net = levered(ia.Lever(), m_a=1.0, m_b=1.0)  # type: ignore[call-arg]
    with pytest.raises(ia.ModelError, match=r"Lever 'lever': ratio \[1\] .* must be given"):
        net.simulate(1.0, inputs={"load.f": 0.0})
