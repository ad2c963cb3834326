"""Friction that truly sticks: breaking away, holding, reversing, alone and together."""

from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}


def sled(force: Any, friction: ia.Component | None = None, **start: float) -> ia.Network:
    net = ia.Network(
        "sled",
        wall=ia.Fixed(),
        mass=ia.Mass(m=2.0, **start),
        rub=friction or ia.CoulombFriction(f_c=10.0),
        push=ia.Force(f=force),
    )
    net.connect(net.mass.flange, net.rub.flange_b, net.push.flange)
    return net.connect(net.rub.flange_a, net.wall.flange)


def switches(run: ia.Result) -> list[tuple[Any, str]]:
    return [(event.time, event.target) for event in run.events]


@pytest.mark.parametrize(
    ("friction", "limit"),
    [
        (ia.CoulombFriction(f_c=10.0), 10.0),
        (ia.CoulombFriction(f_c=10.0, peak=1.5), 15.0),
        (ia.StribeckFriction(f_c=10.0, f_s=16.0, v_s=0.01, d=3.0), 16.0),
        (ia.StribeckFriction(f_c=10.0, f_s=16.0, v_s=0.01, peak=1.25), 20.0),
        (ia.TabulatedFriction(table=((0.0, 12.0), (1.0, 8.0))), 12.0),
    ],
)
def test_breaks_away_exactly_at_its_limit(friction: ia.Component, limit: float) -> None:
    for sign, direction in ((1.0, "forward"), (-1.0, "backward")):
        run = sled(lambda t, sign=sign: sign * 4 * t, friction.clone()).simulate(6.0)
        assert switches(run)[0] == (pytest.approx(limit / 4, abs=1e-9), direction)
        before = run.time < limit / 4
        assert (run["mass.v"][before] == 0).all()
        assert run["rub.f"][before] == pytest.approx(sign * 4 * run.time[before])
        assert sign * run["mass.v"][-1] > 0.01


def test_a_load_of_just_the_limit_holds() -> None:
    run = sled(10.0).simulate(5.0)
    assert not run.events
    assert (run["mass.s"] == 0).all()


@pytest.mark.parametrize(("force", "v", "target"), [(12.0, 1.0, "forward"), (-12.0, -1.0, "backward")])
def test_a_load_beyond_the_limit_slides_from_the_first_instant(force: float, v: float, target: str) -> None:
    run = sled(force).simulate(1.0)
    assert switches(run) == [(0.0, target)]
    assert run["mass.v"][-1] == pytest.approx(v)


def test_braking_to_rest_takes_the_time_it_takes_and_ends_at_rest() -> None:
    run = sled(0.0, v=1.0).simulate(1.0, **TIGHT)
    assert switches(run) == [(0.0, "forward"), (pytest.approx(0.2), "stuck")]
    assert run["mass.s"][-1] == pytest.approx(0.1)
    assert (run["mass.v"][run.time > 0.2001] == 0).all()


def test_reversal_under_a_strong_load_does_not_stick() -> None:
    run = sled(lambda t: 50 * ca.cos(t)).simulate(10.0, **TIGHT)
    assert len(run.events) > 4
    for before, after in zip(run.events[1::2], run.events[2::2], strict=False):
        assert after.time == before.time
        assert (before.target, after.source) == ("stuck", "stuck")
        assert after.target != before.source


def test_stick_and_slip_in_a_steady_cycle() -> None:
    """m v' = F cos(w t) - f_c from break-away until the speed is used up."""
    run = sled(lambda t: 15 * ca.cos(10 * t)).simulate(5.0, **TIGHT)
    slip = np.arccos(-10 / 15)
    assert switches(run)[2][0] == pytest.approx(slip / 10, abs=1e-8)
    period = [event.time for event in run.events if event.target == "backward"]
    assert np.diff(period) == pytest.approx(2 * np.pi / 10, abs=1e-7)
    stuck = run["rub.mode"] == 0
    assert stuck.any()
    assert (run["mass.v"][stuck] == 0).all()


@pytest.mark.parametrize("amplitude", [9.99, 10.01])
def test_a_load_faster_than_the_outputs_is_watched_all_the_same(amplitude: float) -> None:
    """16 cycles between two outputs; nothing moves that would make the integrator step."""
    run = sled(lambda t: amplitude * ca.sin(50 * t)).simulate(8.0, step=2.0)
    cycles = 8.0 * 50 / (2 * np.pi)
    if amplitude < 10:
        assert not run.events
        assert (run["mass.s"] == 0).all()
    else:
        assert len([e for e in run.events if e.target == "forward"]) == round(cycles)
        assert len([e for e in run.events if e.target == "backward"]) == int(cycles)
        assert abs(run["mass.s"]).max() < 1e-6


def test_a_jump_of_the_load_breaks_away_when_it_comes() -> None:
    run = sled(lambda t: ca.if_else(t > 0.3337, 20.0, 0.0)).simulate(1.0, step=0.25)
    assert switches(run) == [(pytest.approx(0.3337, abs=1e-9), "forward")]
    assert run["mass.v"][-1] == pytest.approx(5.0 * (1 - 0.3337))


def test_measured_loads_break_away_too() -> None:
    t = np.linspace(0.0, 1.0, 201)
    run = sled(ia.Sampled(t, 20 * np.sin(np.pi * t))).simulate(1.0)
    assert run.events[0].time == pytest.approx(1 / 6, abs=1e-6)


def test_sliding_is_relative_and_momentum_stays() -> None:
    net = ia.Network(
        "pair",
        a=ia.Mass(m=1.0),
        b=ia.Mass(m=2.0),
        rub=ia.CoulombFriction(f_c=3.0),
        push=ia.Force(f=lambda t: t),
    )
    net.connect(net.a.flange, net.rub.flange_a, net.push.flange).connect(net.rub.flange_b, net.b.flange)
    run = net.simulate(10.0, **TIGHT)
    assert switches(run) == [(pytest.approx(4.5), "backward")]
    assert (run["rub.v_rel"][run.time < 4.5] == 0).all()
    assert run["a.v"] + 2 * run["b.v"] == pytest.approx(run.time**2 / 2, abs=1e-6)
    assert run["b.v"][-1] == pytest.approx(4.5**2 / 6 + 1.5 * 5.5)


def test_two_frictions_on_one_motion_share_until_the_weaker_slides() -> None:
    net = sled(lambda t: t, ia.CoulombFriction(f_c=3.0))
    net.add(more=ia.CoulombFriction(f_c=5.0))
    net.connect(net.wall.flange, net.more.flange_a).connect(net.more.flange_b, net.mass.flange)
    run = net.simulate(10.0)
    assert switches(run) == [(pytest.approx(6.0), "forward"), (pytest.approx(8.0), "forward")]
    shared = run.time < 6
    assert run["rub.f"][shared] == pytest.approx(run["more.f"][shared])
    between = (run.time > 6) & (run.time < 8)
    assert run["more.f"][between] == pytest.approx(run.time[between] - 3.0)
    assert (run["mass.v"][run.time < 8] == 0).all()
    (note,) = run.notes
    assert "CoulombFriction 'more', CoulombFriction 'rub'" in note
    assert "least norm" in note


def test_frictions_in_series_without_mass_between_slide_at_the_weaker() -> None:
    net = ia.Network(
        "series",
        wall=ia.Fixed(),
        mass=ia.Mass(m=1.0),
        rubs=ia.series(ia.CoulombFriction(f_c=3.0), ia.CoulombFriction(f_c=5.0)),
        push=ia.Force(f=lambda t: t),
    )
    net.connect(net.wall.flange, net.rubs.flange_a).connect(
        net.rubs.flange_b, net.mass.flange, net.push.flange
    )
    run = net.simulate(6.0, **TIGHT)
    assert switches(run) == [(pytest.approx(3.0), "forward")]
    assert run["mass.v"][-1] == pytest.approx(18.0 - 3.0 * 3.0 - 4.5)


@pytest.mark.parametrize(
    "drive", [ia.Position(s_ref=lambda t: 0.1 * ca.sin(t)), ia.Speed(v_ref=lambda t: 0.1 * ca.cos(t))]
)
def test_on_a_prescribed_motion_friction_only_resists(drive: ia.Component) -> None:
    net = ia.Network("driven", drive=drive.clone(), rub=ia.CoulombFriction(f_c=3.0), wall=ia.Fixed())
    net.connect(net.wall.flange, net.rub.flange_a).connect(net.rub.flange_b, net.drive.flange)
    run = net.simulate(10.0)
    turns = [event.time for event in run.events if event.source == "stuck"]
    assert turns == pytest.approx([0.0, np.pi / 2, 3 * np.pi / 2, 5 * np.pi / 2], abs=1e-7)
    away = abs(np.cos(run.time)) > 1e-6
    assert run["rub.f"][away] == pytest.approx(3.0 * np.sign(np.cos(run.time[away])))


def test_a_belt_makes_a_held_mass_stick_and_slip() -> None:
    net = ia.Network(
        "belt",
        belt=ia.Speed(v_ref=0.1),
        mass=ia.Mass(m=1.0),
        spring=ia.Spring(k=100.0),
        rub=ia.CoulombFriction(f_c=5.0, peak=2.0),
        wall=ia.Fixed(),
    )
    net.connect(net.belt.flange, net.rub.flange_a).connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.mass.flange, net.rub.flange_b, net.spring.flange_b)
    run = net.simulate(6.0, **TIGHT)
    slips = [event.time for event in run.events if event.source == "stuck"][1:]
    a = 0.05
    swing = 2 * (np.pi - np.arctan2(a * 10.0, 0.1)) / 10.0
    period = 2 * a / 0.1 + swing
    assert np.diff(slips) == pytest.approx(period, abs=1e-6)
    carried = (run["rub.mode"] == 0) & (run.time > 0.5)
    assert run["mass.v"][carried] == pytest.approx(0.1, abs=1e-12)


def test_smoothed_friction_creeps_and_has_no_events() -> None:
    held = sled(5.0, ia.CoulombFriction(f_c=10.0, regularised=1e-3)).simulate(2.0)
    assert not held.events
    assert held["mass.v"][-1] == pytest.approx(1e-3 * np.arctanh(0.5), rel=1e-5)


@pytest.mark.parametrize("solver", ["cvodes", "idas", "rosenbrock"])
def test_solvers_agree_on_when_it_sticks(solver: str) -> None:
    net = sled(lambda t: 14 * ca.sin(3 * t), ia.StribeckFriction(f_c=8.0, f_s=10.0, v_s=0.1, d=1.0))
    run = net.simulate(4.0, solver=solver, **TIGHT)
    reference = net.simulate(4.0, rtol=1e-11, atol=1e-13)
    assert switches(run) == [(pytest.approx(t, abs=1e-6), mode) for t, mode in switches(reference)]
    assert run["mass.s"][-1] == pytest.approx(reference["mass.s"][-1], abs=1e-7)


def test_equations_that_are_not_finite_end_the_run_with_their_names() -> None:
    net = ia.Network("two", wall=ia.Fixed(), mass=ia.Mass(m=1.0), push=ia.Force())
    net.add(one=ia.CoulombFriction(f_c=1.0), two=ia.CoulombFriction(f_c=1.0), lever=ia.Inerter(b=1.0))
    net.connect(net.wall.flange, net.one.flange_a, net.two.flange_a)
    net.connect(net.one.flange_b, net.two.flange_b, net.lever.flange_a)
    net.connect(net.lever.flange_b, net.mass.flange, net.push.flange)
    with pytest.raises(ia.SimulationError, match=r"CoulombFriction 'one'.* not finite"):
        net.simulate(1.0, inputs={"push.f": 2.0}, parameters={"mass.m": 1e-320})
