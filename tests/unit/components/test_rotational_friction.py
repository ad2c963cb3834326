"""Rotational friction, clutches, brakes and freewheels: stopping, true sticking, break-away, reactions."""

from itertools import pairwise
from math import pi
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}


def in_bearing(friction: rotational.Friction, torque: Any, **start: float) -> Network:
    net = Network(
        "shaft",
        torque=rotational.Torque(tau=torque),
        body=rotational.Inertia(J=2.0, **start),
        bearing=rotational.BearingFriction(friction=friction),
    )
    return net.connect(net.torque.flange, net.body.flange, net.bearing.flange)


def switches(run: ia.Result, mode: str) -> list[tuple[Any, str]]:
    return [(event.time, event.target) for event in run.events if event.mode == mode]


def test_coulomb_friction_stops_a_shaft_for_good() -> None:
    run = in_bearing(rotational.CoulombFriction(tau_c=4.0), 0.0, phi=0, w=3).simulate(5.0, **TIGHT)
    assert switches(run, "bearing.friction.mode")[-1] == (pytest.approx(1.5, abs=1e-9), "stuck")
    resting = run["time"] > 1.5
    assert (np.abs(run["body.w"][resting]) < 1e-12).all()
    assert run["body.phi"][-1] == pytest.approx(3 * 1.5 / 2)


def test_break_away_takes_peak_times_the_friction() -> None:
    friction = rotational.CoulombFriction(tau_c=4.0, peak=1.5)
    run = in_bearing(friction, lambda t: 3.0 * t).simulate(3.0, **TIGHT)
    assert switches(run, "bearing.friction.mode") == [(pytest.approx(2.0), "forward")]
    assert (run["body.w"][run["time"] < 2] == 0).all()
    # 2 w' = 3 t - 4 from t = 2
    assert run["body.w"][-1] == pytest.approx((1.5 * (9 - 4) - 4) / 2)


def test_stribeck_friction_follows_its_law() -> None:
    friction = rotational.StribeckFriction(tau_c=2.0, tau_s=5.0, w_s=0.5, d=0.3)
    run = in_bearing(friction, 0.0, w=-6).simulate(2.0)
    w, tau = run["body.w"], run["bearing.friction.tau"]
    moving = w < 0
    expected = -(2.0 + 3.0 * np.exp(w[moving] / 0.5)) + 0.3 * w[moving]
    assert tau[moving] == pytest.approx(expected)


def test_tabulated_friction_is_interpolated_and_goes_on_straight() -> None:
    friction = rotational.TabulatedFriction(tau_pos=((0, 3.0), (2, 1.0), (4, 5.0)))
    run = in_bearing(friction, 0.0, w=6).simulate(1.0)
    w, tau = run["body.w"], run["bearing.friction.tau"]
    moving = w > 0
    expected = np.where(w < 2, 3 - w, 1 + 2 * (w - 2))
    assert tau[moving] == pytest.approx(expected[moving])
    assert tau[0] == pytest.approx(9.0)


@pytest.mark.parametrize("table", [((1, 2),), ((0, 1), (2, 1), (1, 1)), ((0, 1), (1,))])
def test_a_bad_table_is_refused(table: object) -> None:
    net = in_bearing(rotational.TabulatedFriction(tau_pos=table), 0.0)
    with pytest.raises(ia.ModelError, match="speeds increasing from 0"):
        net.dae()


def test_bearing_friction_drags_its_housing_along() -> None:
    net = Network(
        "housing",
        shaft=rotational.Inertia(J=1.0, w=6),
        bearing=rotational.BearingFriction(friction=rotational.CoulombFriction(tau_c=2.0)),
        housing=rotational.Inertia(J=2.0, w=0),
    )
    net.connect(net.shaft.flange, net.bearing.flange)
    net.connect(net.housing.flange, net.bearing.support)
    run = net.simulate(4.0, **TIGHT)
    assert switches(run, "bearing.friction.mode")[-1] == (pytest.approx(2.0), "stuck")
    assert run["shaft.w"] + 2 * run["housing.w"] == pytest.approx(6.0)
    assert run["housing.w"][-1] == pytest.approx(2.0)
    assert (run["bearing.friction.w_rel"][run["time"] > 2] == 0).all()


def test_smoothed_friction_has_no_events_and_creeps() -> None:
    friction = rotational.CoulombFriction(tau_c=4.0, regularised=1e-3)
    run = in_bearing(friction, 2.0, w=0).simulate(5.0)
    assert not run.events
    assert run["body.w"][-1] == pytest.approx(1e-3 * np.arctanh(0.5), rel=1e-4)


def test_friction_on_a_prescribed_motion_only_resists() -> None:
    net = Network(
        "prescribed",
        drive=rotational.Position(phi_ref=lambda t: ca.sin(2 * pi * t)),
        bearing=rotational.BearingFriction(friction=rotational.CoulombFriction(tau_c=2.0)),
    )
    net.connect(net.drive.flange, net.bearing.flange)
    run = net.simulate(1.0)
    speed = np.cos(2 * pi * run["time"])
    clear = np.abs(speed) > 1e-3
    assert run["bearing.friction.tau"][clear] == pytest.approx(2 * np.sign(speed[clear]))


def test_a_rebound_keeps_its_speed_through_friction() -> None:
    net = Network(
        "rebound",
        rack=ia.Mass(m=1.0, s=0.5, v=-1),
        stop=ia.HardStop(e=0.8),
        pinion=ia.RackPinion(R=0.1),
        bearing=rotational.BearingFriction(friction=rotational.CoulombFriction(tau_c=1e-3)),
        ground=ia.Fixed(),
    )
    net.connect(net.rack.flange, net.stop.flange_b, net.pinion.flange_t)
    net.connect(net.ground.flange, net.stop.flange_a).connect(net.pinion.flange_r, net.bearing.flange)
    run = net.simulate(0.6)
    struck = next(event for event in run.events if event.mode == "stop.mode")
    before = 1 - 0.01 * struck.time
    assert struck.impulse == pytest.approx(1.8 * before)
    assert run["rack.v"][-1] == pytest.approx(0.8 * before - 0.01 * (0.6 - struck.time))


def coupled(**clutch: Any) -> Network:
    net = Network(
        "coupled",
        left=rotational.Inertia(J=1.0, w=9),
        clutch=rotational.Clutch(fn_max=10.0, mu_pos=((0, 0.4),), cgeo=0.5, **clutch),
        right=rotational.Inertia(J=2.0, w=0),
    )
    net.connect(net.left.flange, net.clutch.flange_a)
    return net.connect(net.clutch.flange_b, net.right.flange)


def test_a_clutch_brings_two_shafts_to_one_speed() -> None:
    run = coupled(f_normalized=lambda t: t > 1).simulate(8.0, **TIGHT)
    free = run["time"] < 1
    assert (run["clutch.tau"][free] == 0).all()
    # slips with 2 N.m from 1 s: w_rel' = 2 (1 + 1/2)
    assert switches(run, "clutch.mode") == [
        (pytest.approx(1.0), "backward"),
        (pytest.approx(4.0), "stuck"),
    ]
    assert run["left.w"][-1] == pytest.approx(3.0)
    assert (run["clutch.w_rel"][run["time"] > 4] == 0).all()


def test_a_half_pressed_clutch_slips_with_half_the_torque() -> None:
    run = coupled(f_normalized=0.5).simulate(1.0)
    assert run["clutch.tau"] == pytest.approx(-1.0)


def test_pulling_the_clutch_apart_presses_nothing() -> None:
    run = coupled(f_normalized=-3.0).simulate(1.0)
    assert (run["clutch.tau"] == 0).all()
    assert not run.events


def test_a_loaded_clutch_releases_without_slipping_first() -> None:
    net = coupled(f_normalized=lambda t: t < 1)
    net.add(torque=rotational.Torque(tau=0.5))
    net.connect(net.torque.flange, net.left.flange)
    run = net.simulate(2.0, start={"left.w": 0})
    assert [target for _, target in switches(run, "clutch.mode")] == ["stuck", "free"]
    assert run["left.w"][-1] - run["right.w"][-1] == pytest.approx(0.5)


def test_a_brake_holds_up_to_its_break_away_and_its_support_reacts() -> None:
    net = Network(
        "brake",
        torque=rotational.Torque(tau=lambda t: t),
        body=rotational.Inertia(J=1.0, w=0),
        brake=rotational.Brake(fn_max=4.0, peak=1.25, f_normalized=1.0),
        ground=rotational.Fixed(),
    )
    net.connect(net.torque.flange, net.body.flange, net.brake.flange)
    net.connect(net.brake.support, net.ground.flange)
    run = net.simulate(3.0, **TIGHT)
    assert switches(run, "brake.mode") == [(0, "stuck"), (pytest.approx(2.5), "forward")]
    assert run["brake.tau"] == pytest.approx(np.where(run["brake.mode"] == 1, run["time"], 2.0))
    assert run["ground.flange.tau"] == pytest.approx(run["brake.tau"])
    assert run["body.w"][-1] == pytest.approx((9 - 6.25) / 2 - 2 * 0.5)


def test_two_brakes_on_one_shaft_hold_it_together() -> None:
    net = Network("brakes", torque=rotational.Torque(tau=3.0), body=rotational.Inertia(J=1.0, w=0))
    for name in ("one", "two"):
        net.add(**{name: rotational.Brake(fn_max=4.0, f_normalized=1.0)})
        net.connect(getattr(net, name).flange, net.body.flange)
    net.connect(net.torque.flange, net.body.flange)
    run = net.simulate(1.0)
    assert (run["body.w"] == 0).all()
    assert run["one.tau"] == pytest.approx(1.5)
    assert any("one" in note and "two" in note for note in run.notes)


def freewheel(torque: Any, pressed: float = 0.0, **start: float) -> Network:
    net = Network(
        "freewheel",
        torque=rotational.Torque(tau=torque),
        inner=rotational.Inertia(J=1.0, **start),
        wheel=rotational.OneWayClutch(fn_max=4.0, f_normalized=pressed),
        outer=rotational.Inertia(J=1.0, w=0),
    )
    net.connect(net.torque.flange, net.inner.flange, net.wheel.flange_a)
    return net.connect(net.wheel.flange_b, net.outer.flange)


def test_a_freewheel_drives_forward_and_lets_go_backward() -> None:
    run = freewheel(lambda t: ca.sin(2 * pi * t), w=0).simulate(1.0, **TIGHT)
    half = run["time"] <= 0.5
    assert (run["wheel.w_rel"][half] == 0).all()
    assert run["outer.w"][-1] == pytest.approx(1 / (2 * pi), rel=1e-3)
    assert run["inner.w"][-1] == pytest.approx(-1 / (2 * pi), rel=1e-3)


def test_a_pressed_freewheel_brakes_what_runs_ahead() -> None:
    run = freewheel(0.0, pressed=0.5, w=-3).simulate(2.0, **TIGHT)
    assert switches(run, "wheel.mode") == [(0, "forward"), (pytest.approx(1.5), "stuck")]
    assert run["inner.w"][-1] == pytest.approx(-1.5)


def test_a_freewheel_that_falls_behind_is_caught_by_an_impulse() -> None:
    run = freewheel(0.0).simulate(1.0, start={"wheel.w_rel": -5, "outer.w": 0})
    caught = run.events[0]
    assert (caught.time, caught.target) == (0, "stuck")
    assert caught.impulse == pytest.approx(2.5)
    assert run["inner.w"][-1] == pytest.approx(2.5)
    assert run["outer.w"][-1] == pytest.approx(2.5)


def test_three_clutches_in_a_row_lock_and_slip_in_turn() -> None:
    def clutch(signal: Any) -> rotational.Clutch:
        return rotational.Clutch(peak=1.1, fn_max=20.0, f_normalized=signal)

    net = Network(
        "coupled clutches",
        torque=rotational.Torque(tau=lambda t: 10 * ca.sin(10 * pi * t)),
        J1=rotational.Inertia(J=1.0, w=10),
        clutch1=clutch(lambda t: ca.cos(0.4 * pi * t)),
        J2=rotational.Inertia(J=1.0, w=0),
        clutch2=clutch(lambda t: t >= 0.4),
        J3=rotational.Inertia(J=1.0, w=0),
        clutch3=clutch(lambda t: t >= 0.9),
        J4=rotational.Inertia(J=1.0, w=0),
    )
    net.connect(net.torque.flange, net.J1.flange)
    for left, right in pairwise((net.J1, net.clutch1, net.J2, net.clutch2, net.J3, net.clutch3, net.J4)):
        ports = [
            getattr(left, "flange_b", None) or left.flange,
            getattr(right, "flange_a", None) or right.flange,
        ]
        net.connect(*ports)
    run = net.simulate(1.5, rtol=1e-8)
    near: dict[str, Any] = {"abs": 1e-5}
    assert switches(run, "clutch2.mode") == [
        (pytest.approx(0.4), "backward"),
        (pytest.approx(0.70962146, **near), "stuck"),
    ]
    assert switches(run, "clutch3.mode")[-1] == (pytest.approx(1.14396963, **near), "stuck")
    assert [t for t, _ in switches(run, "clutch1.mode")] == pytest.approx(
        [0, 0.79165828, 0.83110851, 0.90684914, 1.00029586, 1.25], **near
    )
    assert run["J1.w"][-1] == pytest.approx(3.24703457, abs=1e-4)
