"""True stick, shared forces, shocks and their ends, against closed forms."""

import casadi as ca
import inertance as ia
import numpy as np
import pytest


def rubbing(count: int, amplitude: float) -> ia.Network:
    net = ia.Network(
        "rubbing", drive=ia.Force(f=lambda t: amplitude * ca.sin(np.pi / 2 * t)), mass=ia.Mass(m=1.0)
    )
    guides = {f"guide_{i}": ia.SupportFriction(friction=ia.CoulombFriction(f_c=10.0)) for i in range(count)}
    net.add(**guides)
    return net.connect(net.drive.flange, net.mass.flange, *(guide.flange for guide in guides.values()))


def test_breaks_away_when_the_load_exceeds_friction() -> None:
    run = rubbing(1, 25.0).simulate(2.0)
    first = run.events[0]
    assert (first.source, first.target) == ("stuck", "forward")
    assert first.time == pytest.approx(np.arcsin(0.4) / (np.pi / 2), abs=1e-9)
    assert abs(run["mass.v"][run.time <= first.time]).max() < 1e-12


def test_stuck_does_not_creep() -> None:
    run = rubbing(1, 9.999).simulate(1000.0, step=1.0)
    assert abs(run["mass.v"]).max() < 1e-12
    assert abs(run["mass.s"]).max() < 1e-9
    assert not run.events


def test_two_frictions_on_one_motion_share_the_load_and_it_is_told() -> None:
    run = rubbing(2, 15.0).simulate(1.0)
    assert run["guide_0.friction.f"] == pytest.approx(run["guide_1.friction.f"])
    assert 2 * run["guide_0.friction.f"][-1] == pytest.approx(15.0)
    assert any("guide_0" in note and "guide_1" in note for note in run.notes)


def test_friction_between_two_moving_masses_conserves_momentum() -> None:
    net = ia.Network(
        "sled", lower=ia.Mass(m=3.0), upper=ia.Mass(m=1.0, v=4.0), rub=ia.CoulombFriction(f_c=3.0)
    )
    net.connect(net.lower.flange, net.rub.flange_a).connect(net.rub.flange_b, net.upper.flange)
    run = net.simulate(2.0)
    assert 3 * run["lower.v"] + run["upper.v"] == pytest.approx(np.full(len(run.time), 4.0))
    stick = next(event for event in run.events if event.target == "stuck")
    assert stick.time == pytest.approx(1.0, abs=1e-7)
    assert abs(run["rub.v_rel"][run.time > stick.time]).max() < 1e-12


def test_friction_on_a_prescribed_motion() -> None:
    net = ia.Network(
        "prescribed",
        drive=ia.Position(s_ref=lambda t: 0.01 * ca.sin(20 * t)),
        guide=ia.SupportFriction(friction=ia.CoulombFriction(f_c=5.0)),
    )
    net.connect(net.drive.flange, net.guide.flange)
    run = net.simulate(1.0)
    moving = abs(np.cos(20 * run.time)) > 1e-3
    expected = 5.0 * np.sign(np.cos(20 * run.time))
    assert run["guide.friction.f"][moving] == pytest.approx(expected[moving])


def ball(*stops: ia.HardStop) -> ia.Network:
    net = ia.Network(
        "ball", floor=ia.Fixed(), ball=ia.Mass(m=2.0, s=1.0), weight=ia.ConstantForce(f_constant=-19.62)
    )
    named = {f"stop_{i}": stop for i, stop in enumerate(stops)}
    net.add(**named)
    net.connect(net.floor.flange, *(stop.flange_a for stop in stops))
    return net.connect(net.ball.flange, net.weight.flange, *(stop.flange_b for stop in stops))


def test_a_bouncing_ball_comes_to_rest_where_its_series_of_bounces_ends() -> None:
    run = ball(ia.HardStop(e=0.8)).simulate(6.0, rtol=1e-9, atol=1e-12)
    fall, speed = np.sqrt(2 / 9.81), np.sqrt(2 * 9.81)
    assert run.events[0].time == pytest.approx(fall, abs=1e-6)
    assert run.events[0].impulse == pytest.approx(2.0 * 1.8 * speed, rel=1e-5)
    assert run.events[-1].target == "contact"
    assert run.events[-1].time == pytest.approx(fall * (1 + 2 * 0.8 / 0.2), abs=1e-4)
    assert run["ball.v"][-1] == 0.0
    assert abs(run["ball.s"][-1]) < 1e-9
    assert run["stop_0.f"][-1] == pytest.approx(-19.62)


def test_two_identical_stops_strike_together() -> None:
    run = ball(ia.HardStop(e=0.5), ia.HardStop(e=0.5)).simulate(2.0)
    first, second = run.events[:2]
    assert first.time == second.time
    assert first.impulse == pytest.approx(second.impulse)
    single = ball(ia.HardStop(e=0.5)).simulate(2.0).events[0].impulse
    assert first.impulse is not None
    assert single is not None
    assert 2 * first.impulse == pytest.approx(single, rel=1e-6)


@pytest.mark.parametrize("ratio", [0.1, 1.0, 30.0])
def test_a_stop_between_free_masses_keeps_momentum_and_restitution(ratio: float) -> None:
    net = ia.Network(
        "collision",
        left=ia.Mass(m=1.0, v=3.0),
        right=ia.Mass(m=ratio, s=0.5, v=-1.0),
        stop=ia.HardStop(e=0.6),
    )
    net.connect(net.left.flange, net.stop.flange_a).connect(net.stop.flange_b, net.right.flange)
    run = net.simulate(1.0)
    momentum = run["left.v"] + ratio * run["right.v"]
    assert momentum == pytest.approx(np.full(len(run.time), 3.0 - ratio), abs=1e-9)
    assert run["stop.v_rel"][-1] == pytest.approx(0.6 * 4.0)
    assert [event.time for event in run.events] == [pytest.approx(0.125, abs=1e-9)]
