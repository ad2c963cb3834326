"""Stops: restitution, momentum, contact, and many of them at one instant."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}
G = 9.81


def ball(*stops: ia.HardStop, height: float = 1.0) -> ia.Network:
    net = ia.Network(
        "ball", mass=ia.Mass(m=2.0, s=height), weight=ia.ConstantForce(f_constant=-2 * G), floor=ia.Fixed()
    )
    net.connect(net.mass.flange, net.weight.flange)
    for number, stop in enumerate(stops):
        net.add(**{f"stop{number}": stop})
        net.connect(stop.flange_b, net.mass.flange).connect(stop.flange_a, net.floor.flange)
    return net


def row(masses: list[float], gaps: list[float], e: float, **start: float) -> ia.Network:
    """Masses in a row; the i-th stop lets neighbours come as close as 1 m, from 1 m + gap."""
    places = np.cumsum([0.0, *(1.0 + gap for gap in gaps)])
    bodies = {
        f"m{i}": ia.Mass(m=m, s=s, v=start.get(f"v{i}", 0.0))
        for i, (m, s) in enumerate(zip(masses, places, strict=True))
    }
    stops = {f"c{i}": ia.HardStop(e=e, s_min=1.0) for i in range(len(gaps))}
    net = ia.Network("row", **bodies, **stops)
    for i in range(len(gaps)):
        net.connect(bodies[f"m{i}"].flange, stops[f"c{i}"].flange_a)
        net.connect(stops[f"c{i}"].flange_b, bodies[f"m{i + 1}"].flange)
    return net


def switches(run: ia.Result) -> list[tuple[Any, str]]:
    return [(event.time, event.target) for event in run.events]


def speeds(run: ia.Result, count: int) -> list[float]:
    return [float(run[f"m{i}.v"][-1]) for i in range(count)]


def test_bounces_at_the_instants_of_free_fall() -> None:
    run = ball(ia.HardStop(e=0.5)).simulate(1.3, **TIGHT)
    fall = np.sqrt(2 / G)
    expected = [fall, 2 * fall, 2.5 * fall, 2.75 * fall, 2.875 * fall]
    assert [event.time for event in run.events] == pytest.approx(expected, abs=1e-8)
    impulses = [event.impulse for event in run.events]
    assert impulses == pytest.approx([2 * 1.5 * np.sqrt(2 * G) * 0.5**i for i in range(5)], rel=1e-6)


@pytest.mark.parametrize("e", [0.0, 0.5, 0.9])
def test_comes_to_rest_where_the_series_of_bounces_ends(e: float) -> None:
    end = np.sqrt(2 / G) * (1 + 2 * e / (1 - e))
    run = ball(ia.HardStop(e=e)).simulate(end + 1.0, **TIGHT)
    assert run.events[-1].target == "contact"
    unresolved = 1e-4  # m/s: a bounce as low as the absolute tolerance
    assert run.events[-1].time == pytest.approx(end, abs=2 * unresolved / G / (1 - e))
    resting = run.time > end + 1e-3
    assert (run["mass.v"][resting] == 0).all()
    assert abs(run["mass.s"]).min() <= 1e-12
    assert run["mass.s"].min() >= -1e-12
    assert run["stop0.f"][resting] == pytest.approx(-2 * G)


def test_an_elastic_ball_keeps_its_energy() -> None:
    run = ball(ia.HardStop(e=1.0)).simulate(10.0, **TIGHT)
    energy = G * run["mass.s"] + run["mass.v"] ** 2 / 2
    assert energy == pytest.approx(G, rel=1e-7)
    assert len(run.events) == 11


def test_resting_contact_is_left_when_pulled_and_never_pulls() -> None:
    net = ball(ia.HardStop(e=0.3), height=0.0)
    net.add(pull=ia.Force(f=lambda t: 10 * t)).connect(net.pull.flange, net.mass.flange)
    run = net.simulate(3.0)
    assert switches(run) == [
        (pytest.approx(0.0, abs=1e-6), "contact"),
        (pytest.approx(2 * G / 10), "free"),
    ]
    assert run["mass.s"].min() > -1e-12
    assert run["stop0.f"].max() <= 1e-12


@pytest.mark.parametrize("count", [2, 3])
def test_identical_stops_strike_at_once_and_share(count: int) -> None:
    run = ball(*(ia.HardStop(e=0.5) for _ in range(count))).simulate(2.0)
    single = ball(ia.HardStop(e=0.5)).simulate(2.0)
    assert len(run.events) == count * len(single.events)
    first = run.events[:count]
    assert {event.time for event in first} == {first[0].time}
    total = sum(event.impulse or 0.0 for event in first)
    assert total == pytest.approx(single.events[0].impulse, rel=1e-6)
    assert run["mass.s"][-1] == pytest.approx(0.0, abs=1e-12)
    assert sum(run[f"stop{i}.f"][-1] for i in range(count)) == pytest.approx(-2 * G)
    assert "least norm" in run.notes[0]


@pytest.mark.parametrize(
    ("left", "right", "e"), [(1, 1, 1.0), (1, 3, 0.7), (5, 0.01, 0.3), (1, 1e4, 1.0), (2, 3, 0.0)]
)
def test_two_free_masses_keep_momentum_and_restitution(left: float, right: float, e: float) -> None:
    run = row([left, right], [0.5], e, v0=2.0, v1=-1.0).simulate(1.0)
    assert run["m1.v"][-1] - run["m0.v"][-1] == pytest.approx(3.0 * e, abs=1e-12)
    momentum = left * run["m0.v"] + right * run["m1.v"]
    assert momentum == pytest.approx(2 * left - right, abs=1e-9)
    (event,) = run.events
    assert event.time == pytest.approx(1 / 6)
    assert event.impulse == pytest.approx((1 + e) * 3.0 * left * right / (left + right))


def test_momentum_is_kept_through_a_screw() -> None:
    lead, J = 0.1, 0.02
    net = ia.Network(
        "geared",
        nut=ia.Mass(m=2.0, v=1.0),
        screw=ia.NutScrew(lead=lead),
        flywheel=rotational.Inertia(J=J),
        target=ia.Mass(m=3.0, s=0.5),
        stop=ia.HardStop(e=0.4),
    )
    net.connect(net.nut.flange, net.screw.flange_t, net.stop.flange_a)
    net.connect(net.screw.flange_r, net.flywheel.flange).connect(net.stop.flange_b, net.target.flange)
    run = net.simulate(1.0)
    turns = 2 * np.pi / lead
    effective = 2.0 + J * turns**2
    assert run.events[0].impulse == pytest.approx(1.4 * effective * 3.0 / (effective + 3.0))
    assert effective * run["nut.v"] + 3.0 * run["target.v"] == pytest.approx(effective)
    assert run["flywheel.w"] == pytest.approx(turns * run["nut.v"])


@pytest.mark.parametrize("gap", [0.0, 0.1])
def test_a_row_of_equal_balls_passes_the_blow_on(gap: float) -> None:
    run = row([1.0] * 5, [0.5] + [gap] * 3, 1.0, v0=1.0).simulate(3.0)
    assert speeds(run, 5) == pytest.approx([0, 0, 0, 0, 1.0], abs=1e-12)
    assert [event.impulse for event in run.events] == pytest.approx([1.0] * 4)


@pytest.mark.parametrize("count", [3, 6, 12])
def test_a_plastic_row_ends_as_one_body(count: int) -> None:
    masses = [1.0 + i for i in range(count)]
    run = row(masses, [0.1] * (count - 1), 0.0, v0=1.0).simulate(150.0)
    assert speeds(run, count) == pytest.approx([1 / sum(masses)] * count)
    assert len(run.events) == count * (count - 1) // 2
    assert all(event.impulse > 0 for event in run.events if event.impulse is not None)


def test_a_pile_falls_and_rests_on_itself() -> None:
    """Four balls on one another: many blows at one instant, then each floor carries what is above."""
    parts: dict[str, Any] = {"ground": ia.Fixed()}
    for i in range(4):
        parts |= {
            f"m{i}": ia.Mass(m=1.0 + i, s=1.0 + 1.1 * i),
            f"w{i}": ia.ConstantForce(f_constant=-G * (1 + i)),
            f"c{i}": ia.HardStop(e=0.3),
        }
    net = ia.Network("pile", **parts)
    below = net.ground.flange
    for i in range(4):
        net.connect(below, parts[f"c{i}"].flange_a)
        below = parts[f"m{i}"].flange
        net.connect(below, parts[f"w{i}"].flange, parts[f"c{i}"].flange_b)
    run = net.simulate(6.0)
    for i in range(4):
        assert run[f"c{i}.s_rel"].min() >= -1e-10
        assert run[f"c{i}.f"][-1] == pytest.approx(-G * sum(range(1 + i, 5)))
        assert run[f"m{i}.v"][-1] == 0.0


def test_a_blow_loosens_friction_that_sticks() -> None:
    net = row([1.0, 1.0], [0.5], 0.5, v0=2.0)
    net.add(rub=ia.CoulombFriction(f_c=5.0), floor=ia.Fixed())
    net.connect(net.m1.flange, net.rub.flange_b).connect(net.rub.flange_a, net.floor.flange)
    run = net.simulate(0.65, **TIGHT)
    assert switches(run) == [
        (pytest.approx(0.25), "free"),
        (pytest.approx(0.25), "forward"),
        (pytest.approx(0.55), "stuck"),
    ]
    assert run.events[0].impulse == pytest.approx(1.5)
    assert run["m1.s"][-1] == pytest.approx(1.5 + 1.5**2 / 10)


def test_a_mass_with_stop_and_friction_stays_between_its_stops() -> None:
    net = ia.Network(
        "guided",
        body=ia.MassWithStopAndFriction(m=1.0, s_min=-0.3, s_max=0.3, f_c=1.0, f_s=2.0, d=1.0, v_s=0.1),
        push=ia.Force(f=lambda t: 20 * np.sin(5 * t)),
    )
    run = net.connect(net.body.flange, net.push.flange).simulate(5.0)
    assert (run["body.s"].min(), run["body.s"].max()) == pytest.approx((-0.3, 0.3), abs=1e-10)
    assert run.events[0].time == pytest.approx(np.arcsin(0.1) / 5)
    wedged = net.with_values(body=ia.MassWithStopAndFriction(m=1.0, s_min=0.0, s_max=0.0)).simulate(2.0)
    assert abs(wedged["body.s"]).max() < 1e-12


def test_a_prescribed_motion_may_strike_a_free_mass_but_not_a_wall() -> None:
    net = ia.Network(
        "ram",
        ram=ia.Position(s_ref=lambda t: -np.sin(t)),
        mass=ia.Mass(m=1.0, s=-0.5),
        stop=ia.HardStop(e=0.5),
    )
    net.connect(net.mass.flange, net.stop.flange_a).connect(net.stop.flange_b, net.ram.flange)
    run = net.simulate(2.0, **TIGHT)
    hit = np.pi / 6
    assert run.events[0].time == pytest.approx(hit, abs=1e-8)
    assert run["mass.v"][-1] == pytest.approx(-1.5 * np.cos(hit), abs=1e-7)
    net = ia.Network("crash", ram=ia.Position(s_ref=lambda t: 0.5 - t), wall=ia.Fixed(), stop=ia.HardStop())
    net.connect(net.wall.flange, net.stop.flange_a).connect(net.stop.flange_b, net.ram.flange)
    with pytest.raises(
        ia.SimulationError, match=r"HardStop 'stop': a shock meets a motion that is prescribed"
    ) as caught:
        net.simulate(1.0)
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert kept.time[-1] == pytest.approx(0.5)


def free_row(
    masses: list[float], gaps: list[float], v: list[float], e: float, rubbing: list[float]
) -> ia.Result:
    speeds = {f"v{i}": speed for i, speed in enumerate(v)}
    net = row(masses, gaps, e, **speeds)
    for i, f_c in enumerate(rubbing):
        net.add(**{f"r{i}": ia.CoulombFriction(f_c=f_c)})
        rub, left, right = (getattr(net, name) for name in (f"r{i}", f"m{i}", f"m{i + 1}"))
        net.connect(rub.flange_a, left.flange).connect(rub.flange_b, right.flange)
    return net.simulate(1.0, rtol=1e-8, atol=1e-10)


def test_a_shock_at_the_instant_at_which_friction_stops_keeps_momentum() -> None:
    """The speed that friction leaves is that after the shock, not that before."""
    masses, speeds = [1.0, 1.0, 1.0, 1.0, 3.0], [-2.0, -2.0, -2.0, -1.0, -2.0]
    run = free_row(masses, [0.0, 0.0, 0.0, 0.05], speeds, 0.5, [0.0] * 4)
    assert sum(m * run[f"m{i}.v"] for i, m in enumerate(masses)) == pytest.approx(-13.0)


def test_bounces_too_low_to_resolve_end_in_contact_and_never_inside_the_stop() -> None:
    run = free_row([1.0, 1.0, 0.25, 1.0], [0.0, 0.05, 0.05], [0.0, 1.0, -1.0, 0.0], 0.5, [0.3, 2.0, 0.0])
    assert all(run[f"c{i}.s_rel"].min() > 1.0 - 1e-9 for i in range(3))
    assert all(event.impulse > 0 for event in run.events if event.impulse is not None)


@pytest.mark.parametrize(("v", "end"), [(-1.0, 0.4), (0.0, -0.1), (1.0, 0.9)])
def test_a_start_inside_a_stop_is_told(v: float, end: float) -> None:
    net = ia.Network("inside", wall=ia.Fixed(), stop=ia.HardStop(e=0.5), mass=ia.Mass(m=1.0, s=-0.1, v=v))
    net.connect(net.wall.flange, net.stop.flange_a).connect(net.stop.flange_b, net.mass.flange)
    run = net.simulate(1.0)
    assert run["mass.s"][-1] == pytest.approx(end)
    (note,) = run.notes
    assert note.startswith("HardStop 'stop' begins 0.1 beyond where it strikes")


def test_what_lies_on_a_stop_is_in_contact_from_the_first_instant() -> None:
    run = ball(ia.HardStop(e=0.5), height=0.0).simulate(1.0)
    assert switches(run) == [(0.0, "contact")]
    assert (run["mass.s"] == 0).all()


@pytest.mark.parametrize(("e", "height", "g"), [(0.9, 1.0, G), (0.7, 100.0, G), (0.7, 1e-3, 1e6)])
def test_bounces_without_a_resting_speed_end_where_their_series_does(
    e: float, height: float, g: float
) -> None:
    net = ball(ia.HardStop(e=e, v_rest=0.0), height=height).with_values(
        weight=ia.ConstantForce(f_constant=-2 * g)
    )
    end = (2 * height / g) ** 0.5 * (1 + e) / (1 - e)
    run = net.simulate(1.2 * end, rtol=1e-10, atol=1e-14)
    assert run.events[-1].target == "contact"
    assert run.events[-1].time == pytest.approx(end, rel=1e-4)
    assert run["mass.v"][-1] == 0.0


def test_a_point_before_an_event_stays_as_it_was() -> None:
    """What a transition resets afterwards must not reach back."""
    net = row([1.0, 1.0], [0.5], 0.0, v1=-1.0)
    net.add(rub=ia.CoulombFriction(f_c=0.1))
    run = net.connect(net.m0.flange, net.rub.flange_a).connect(net.rub.flange_b, net.m1.flange).simulate(1.0)
    struck = next(event.time for event in run.events if event.impulse is not None)
    before, *_, after = run["rub.v_rel"][run.time == struck]
    assert before == pytest.approx(-((1 - 4 * 0.1 * 0.5) ** 0.5), rel=1e-5)
    assert after == 0.0


def test_without_a_resting_speed_a_ball_comes_to_rest_all_the_same_and_not_below() -> None:
    run = ball(ia.HardStop(e=0.3, v_rest=0.0)).simulate(2.0, rtol=1e-10, atol=1e-12)
    assert run.events[-1].target == "contact"
    assert run["mass.s"].min() > -1e-9
    assert run["mass.v"][-1] == 0.0
