"""Averages, peaks and shares of a run are over time, whatever its points are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pandas as pd
import pytest

MEASURES = ("mean", "rms", "std", "peak")


def oscillator(frequency: float, **parts: Any) -> ia.Network:
    w = 2 * np.pi * frequency
    net = ia.Network(
        "oscillator", wall=ia.Fixed(), spring=ia.Spring(k=w**2), mass=ia.Mass(m=1.0, s=1.0), **parts
    )
    return net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)


def ball() -> ia.Network:
    net = ia.Network(
        "ball",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
    )
    net.connect(net.floor.flange, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)


def belt(regularised: float | None = None) -> ia.Network:
    net = ia.Network(
        "belt",
        belt=ia.Speed(v_ref=0.1),
        rub=ia.StribeckFriction(f_c=5.0, f_s=8.0, v_s=0.05, regularised=regularised),
        block=ia.Mass(m=1.0),
        spring=ia.Spring(k=100.0),
        wall=ia.Fixed(),
    )
    net.connect(net.belt.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.block.flange, net.spring.flange_b)
    return net.connect(net.wall.flange, net.spring.flange_a)


def measured(run: ia.OverTime, name: str, **window: float) -> list[float]:
    return [getattr(run, measure)(name, **window) for measure in MEASURES]


def of_bounces(height: float, stop: float, restitution: float) -> list[float]:
    """Return mean, rms, std and peak of the height of a ball, flight by flight."""
    g, t, v, fall = 9.81, 0.0, 0.0, height
    area = square = 0.0
    flight = np.sqrt(2 * height / g)
    while t < stop and flight > 1e-9:
        lasting = min(flight, stop - t)
        parabola = np.polynomial.Polynomial([fall, v, -g / 2])
        area += float(parabola.integ()(lasting))
        square += float((parabola**2).integ()(lasting))
        t, v, fall = t + flight, restitution * (g * flight - v), 0.0
        flight = 2 * v / g
    mean, power = area / stop, square / stop
    return [mean, np.sqrt(power), np.sqrt(power - mean**2), height]


def test_averages_are_exact_on_lines_with_jumps() -> None:
    table = pd.DataFrame({"f": [0.0, 6.0, -3.0, -3.0, 1.0, 1.0]}, index=[1.0, 3.0, 3.0, 4.0, 4.0, 4.0])
    run = ia.Recorded(table)
    assert run.mean("f") == pytest.approx((6.0 - 3.0) / 3)
    assert run.rms("f") == pytest.approx(np.sqrt((24.0 + 9.0) / 3))
    assert run.std("f") == pytest.approx(np.sqrt(33.0 / 3 - 1.0))
    assert run.peak("f") == 6.0
    assert measured(run, "f", begin=2.0, end=2.5) == pytest.approx([3.75, 3.77492, 0.433013, 4.5], rel=1e-5)


def test_more_points_on_the_same_lines_change_nothing() -> None:
    """What an event loop does: many points in one place, two at one instant, few elsewhere."""
    rng = np.random.default_rng(1)
    for _ in range(20):
        t = np.sort(np.repeat(rng.uniform(-5.0, 5.0, 8), rng.integers(1, 3, 8)))
        y = rng.normal(size=len(t))
        plain = ia.Recorded(pd.DataFrame({"y": y}, index=t))
        more = np.r_[rng.uniform(t[0], t[-1], 50), t[0] + (t[-1] - t[0]) * rng.beta(0.02, 5, 200)]
        more = np.setdiff1d(more, t)
        crowded = pd.DataFrame({"y": np.r_[y, plain.at("y", more)]}, index=np.r_[t, more])
        crowded = crowded.iloc[np.argsort(crowded.index, kind="stable")]
        assert measured(ia.Recorded(crowded), "y") == pytest.approx(measured(plain, "y"), abs=1e-12)


@pytest.mark.parametrize("solver", ["auto", "rosenbrock", "compiled"])
@pytest.mark.parametrize("step", [1.0, 0.31, 0.02])
def test_of_a_bouncing_ball_they_are_those_of_its_parabolas(solver: str, step: float) -> None:
    run = ball().simulate(5.0, step=step, solver=solver)
    exact = of_bounces(1.0, 5.0, 0.7)
    assert measured(run, "ball.s") == pytest.approx(exact, rel=1e-4)
    assert abs(np.mean(run["ball.s"]) / exact[0] - 1) > 0.05


@pytest.mark.parametrize("step", [0.1, 0.02, 0.013, 0.0021])
@pytest.mark.parametrize("begin", [0.0, 1000.0])
def test_points_too_far_apart_to_show_an_oscillation_do_not_hide_it(step: float, begin: float) -> None:
    """50 Hz at a step of 20 ms shows the same value at every point."""
    run = oscillator(50.0).simulate(begin + 1.0, begin=begin, step=step, rtol=1e-9, atol=1e-11)
    assert run.rms("mass.s") == pytest.approx(np.sqrt(0.5), rel=1e-3)
    assert run.mean("mass.s", end=begin + 0.005) == pytest.approx(2 / np.pi, rel=1e-3)
    assert run.peak("mass.v") == pytest.approx(100 * np.pi, rel=1e-3)
    times = begin + np.array([0.1234, 0.5678])
    assert run.at("mass.s", times) == pytest.approx(np.cos(100 * np.pi * (times - begin)), abs=1e-3)


@pytest.mark.parametrize("samples", [False, True])
def test_inputs_that_move_between_points_are_followed(samples: bool) -> None:
    net = ia.Network("pushed", push=ia.Force(), mass=ia.Mass(m=2.0), wall=ia.Fixed(), oil=ia.Damper(d=1.0))
    net.connect(net.push.flange, net.mass.flange, net.oil.flange_b)
    net.connect(net.wall.flange, net.oil.flange_a)
    t = np.linspace(0.0, 4.0, 4001)
    force = (t, 3 * np.sin(10 * np.pi * t)) if samples else lambda t: 3 * ca.sin(10 * np.pi * t)
    run = net.simulate(4.0, step=1.0, inputs={"push.f": force})
    assert measured(run, "push.f") == pytest.approx([0.0, 3 / np.sqrt(2), 3 / np.sqrt(2), 3.0], abs=2e-3)


@pytest.mark.parametrize("solver", ["auto", "rosenbrock", "compiled"])
@pytest.mark.parametrize("width", [0.3, 0.01, 1e-4])
def test_a_pulse_between_two_points_counts(width: float, solver: str) -> None:
    net = ia.Network("hit", push=ia.Force(), mass=ia.Mass(m=2.0))
    net.connect(net.push.flange, net.mass.flange)

    def pulse(t: Any) -> Any:
        return 3.0 * ca.fmax(0.0, 1.0 - ca.fabs(t - 7.03) / width)

    run = net.simulate(10.0, inputs={"push.f": pulse}, solver=solver, step=0.1)
    assert run.mean("push.f") * 10.0 == pytest.approx(3.0 * width, rel=1e-3)
    assert run.rms("push.f") ** 2 * 10.0 == pytest.approx(6.0 * width, rel=2e-3)
    assert run.peak("push.f") == pytest.approx(3.0, rel=1e-2)


def test_an_input_that_is_at_rest_at_every_point_is_followed() -> None:
    net = ia.Network("shaken", push=ia.Force(f=lambda t: 1 - ca.cos(100 * np.pi * t)), mass=ia.Mass(m=1.0))
    run = net.connect(net.push.flange, net.mass.flange).simulate(2.0, step=0.02)
    assert (abs(run["push.f"]) < 1e-9).all()
    assert measured(run, "push.f") == pytest.approx([1.0, np.sqrt(1.5), np.sqrt(0.5), 2.0], rel=1e-4)


def test_a_rough_road_is_followed_between_coarse_points() -> None:
    """Of noise some pieces look like cubics by chance."""
    t, rng = np.linspace(0.0, 2.0, 2001), np.random.default_rng(0)
    road = (t, 3e-4 * np.cumsum(rng.standard_normal(len(t))))
    car = ia.machines.quarter_car(ia.machines.suspension("S1", 60e3, 2600.0)).dae()
    coarse, fine = (ia.simulate(car, 2.0, inputs={"road.s_ref": road}, step=step) for step in (0.04, 1e-3))
    assert coarse.rms("body.a") == pytest.approx(fine.rms("body.a"), rel=1e-5)
    times = np.linspace(0.3, 1.7, 7)
    assert [coarse.at("body.a", x) for x in times] == pytest.approx(fine.at("body.a", times), rel=1e-2)


def test_with_algebraic_unknowns_they_agree_with_a_fine_run() -> None:
    net = ia.Network(
        "chain", mass=ia.Mass(m=1.0, s=0.1), soft=ia.CubicSpring(k=100.0, k3=1e5), wall=ia.Fixed(),
        other=ia.CubicSpring(k=300.0, k3=1e4),
    )  # fmt: skip
    net.connect(net.wall.flange, net.soft.flange_a).connect(net.soft.flange_b, net.other.flange_a)
    net.connect(net.other.flange_b, net.mass.flange)
    coarse, fine = (net.simulate(5.0, step=step, rtol=1e-8, atol=1e-10) for step in (0.25, 1e-3))
    assert coarse.dae.z.numel()
    assert measured(coarse, "other.f") == pytest.approx(measured(fine, "other.f"), rel=2e-3)


def test_jumps_share_an_instant_and_count_for_nothing() -> None:
    net = ia.Network(
        "pulsed", push=ia.Force(), mass=ia.Mass(m=1.0), source=ia.signals.Pulse(amplitude=4.0, period=0.5)
    )
    net.connect(net.push.flange, net.mass.flange).connect(net.source.y, net.push.f)
    for step in (0.5, 0.07):
        run = net.simulate(2.0, step=step)
        assert measured(run, "push.f") == pytest.approx([2.0, np.sqrt(8.0), 2.0, 4.0])
        assert run.share("source.mode", "high") == pytest.approx(0.5)
        assert run.at("push.f", [0.2499, 0.25, 0.4999, 0.5]) == pytest.approx([4.0, 0.0, 0.0, 4.0])


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_shares_of_modes_are_the_time_between_their_events(solver: str) -> None:
    run = belt().simulate(10.0, start={"rub.v_rel": 0.0}, solver=solver, step=0.2)
    changes = [0.0, *(event.time for event in run.events), 10.0]
    lasting = np.diff(changes)
    assert run.events[0].source == "stuck"
    assert run.share("rub.mode", "stuck") == pytest.approx(lasting[::2].sum() / 10.0)
    assert run.share("rub.mode", 0) == run.share("rub.mode", "stuck")
    values = run.values_of("rub.mode")
    assert sum(run.share("rub.mode", value) for value in values) == pytest.approx(1.0)
    assert run.share("rub.mode", "stuck", end=0.5 * changes[1]) == 1.0
    assert abs((run["rub.mode"] == 0).mean() - run.share("rub.mode", "stuck")) > 0.01


def test_resampled_saved_and_loaded_signals_are_the_same(tmp_path: Path) -> None:
    run = belt().simulate(3.0, start={"rub.v_rel": 0.0}, begin=-1.0)
    table = run.resample(0.125, "block.s", "rub.f")
    assert np.diff(table.index) == pytest.approx(0.125)
    assert (table.index[0], table.index[-1]) == (-1.0, 3.0)
    assert table.attrs["units"] == {"block.s": "m", "rub.f": "N"}
    assert table["rub.f"].to_numpy() == pytest.approx(run.at("rub.f", table.index.to_numpy()))
    assert list(run.resample(0.5).columns) == run.dae.state_names
    assert run.resample(0.3).index[-1] == pytest.approx(2.9)
    for ending in ("csv", "npz"):
        saved = run.save(tmp_path / f"run.{ending}", "block.s", "rub.f", "rub.mode")
        loaded = ia.Recorded(ia.load_table(saved), "saved")
        assert measured(loaded, "rub.f") == pytest.approx(measured(run, "rub.f"), rel=5e-4)
        assert loaded.share("rub.mode", 0) == pytest.approx(run.share("rub.mode", "stuck"), rel=1e-9)
        assert loaded.unit("rub.f") == "N"


def test_at_takes_one_instant_or_an_array() -> None:
    run = oscillator(1.0).simulate(2.0, begin=1.0, step=0.5)
    assert isinstance(run.at("mass.s", 1.2), float)
    grid = np.array([[1.0, 1.2], [1.7, 2.0]])
    assert run.at("mass.s", grid) == pytest.approx(np.cos(2 * np.pi * (grid - 1.0)), abs=1e-4)
    assert run.at("mass.s", []).shape == (0,)
    for wrong in (0.9, [1.5, 2.1], np.nan):
        with pytest.raises(ia.ModelError, match=r"outside the run, 1 to 2 s"):
            run.at("mass.s", wrong)
    with pytest.raises(ia.ModelError, match="is asked for at instants"):
        run.at("mass.s", "noon")


def test_what_stands_still_is_not_integrated_again(monkeypatch: pytest.MonkeyPatch) -> None:
    run = oscillator(50.0).simulate(1.0, start={"mass.s": 0.0, "mass.v": 0.0}, step=0.1)
    monkeypatch.setattr("inertance.networks.simulation.dense_output.DenseOutput._again", None)
    assert measured(run, "mass.a") == pytest.approx([0.0] * 4, abs=1e-9)
    loaded = oscillator(1.0).simulate(1.0, start={"mass.s": 0.25})
    assert loaded.mean("wall.flange.s") == 0.0
    assert loaded.std("spring.k") == pytest.approx(0.0, abs=1e-12)
    assert loaded.mean("spring.k") == pytest.approx(4 * np.pi**2)


def test_of_one_point_they_are_its_value() -> None:
    one = ia.Recorded(pd.DataFrame({"y": [-2.0]}, index=[3.0]))
    assert measured(one, "y") == [-2.0, 2.0, 0.0, 2.0]
    assert one.at("y", 3.0) == -2.0
    assert one.resample(1.0)["y"].tolist() == [-2.0]
    assert one.share("y", -2) == 1.0


def test_what_cannot_be_followed_is_told() -> None:
    net = ia.Network("humming", push=ia.Force(f=lambda t: ca.sin(1e6 * t)), mass=ia.Mass(m=1e6))
    run = net.connect(net.push.flange, net.mass.flange).simulate(0.2, step=0.05)
    with pytest.warns(RuntimeWarning, match=r"'push.f' \[N\] of 'humming' moves faster .* smaller step="):
        run.rms("push.f")


@pytest.mark.parametrize(
    ("call", "error", "told"),
    [
        (lambda r: r.mean("block.x"), KeyError, "has no variable 'block.x'; did you mean 'block.v'"),
        (lambda r: r.mean("block.s", begin=-1.0), ia.ModelError, "t = -1 s is outside the run, 0 to 2 s"),
        (lambda r: r.rms("block.s", end=2.5), ia.ModelError, "t = 2.5 s is outside the run, 0 to 2 s"),
        (lambda r: r.std("block.s", begin=1.0, end=0.5), ia.ModelError, "begin = 1 s, end = 0.5 s"),
        (lambda r: r.peak("block.s", begin=1.0, end=1.0), ia.ModelError, "ends after it begins"),
        (lambda r: r.mean("rub.mode"), ia.ModelError, r"is a mode \(stuck, forward, backward\), .* no mean"),
        (lambda r: r.peak("rub.mode"), ia.ModelError, r"has no peak; ask share\('rub.mode', 'stuck'\)"),
        (lambda r: r.share("rub.mode"), ia.ModelError, r"say which: share\('rub.mode', 'stuck'\)"),
        (lambda r: r.share("rub.mode", "stick"), ia.ModelError, "never 'stick', .* did you mean 'stuck'"),
        (lambda r: r.share("rub.mode", 3), ia.ModelError, "never 3, only stuck, forward, backward"),
        (lambda r: r.share("block.s"), ia.ModelError, r"'block.s' .* goes from 0 to \S+ m; share\(\) is of"),
        (lambda r: r.share("block.s", "high"), ia.ModelError, "never 'high', but a number"),
        (lambda r: r.resample(0.0), ia.ModelError, r"step must be above 0 s, got 0\.0"),
        (lambda r: r.resample("fine"), ia.ModelError, r"step must be a number \[s\], got 'fine'"),
        (lambda r: r.resample(1e-12), ia.ModelError, "is 2e[+]12 rows"),
        (
            lambda r: ia.analysis.weighted_rms(r, "block.v"),
            ia.ModelError,
            "'block.v' of 'belt' is not an acceleration",
        ),
        (lambda r: ia.analysis.weighted_rms(r, [1.0]), ia.ModelError, "name the acceleration of 'belt'"),
    ],
)
def test_wrong_questions_are_told(call: Any, error: type[Exception], told: str) -> None:
    run = belt().simulate(2.0, start={"rub.v_rel": 0.0})
    with pytest.raises(error, match=told):
        call(run)


@pytest.mark.parametrize(
    ("index", "told"),
    [([], "at least one row"), ([0.0, 2.0, 1.0], "goes back after 2 s"), ([0.0, np.nan], "finite instants")],
)
def test_tables_without_a_time_are_told(index: list[float], told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        ia.Recorded(pd.DataFrame({"y": np.zeros(len(index))}, index=index))


def test_comfort_of_a_run_does_not_depend_on_its_points() -> None:
    felt = [ia.analysis.weighted_rms(belt().simulate(4.0, step=step), "block.a") for step in (0.05, 1e-3)]
    assert felt[0] == pytest.approx(felt[1], rel=2e-3)
    t = np.linspace(0.0, 4.0, 16001)
    run = oscillator(5.0).simulate(4.0, step=0.05, rtol=1e-8)
    plain = ia.analysis.weighted_rms(t, -((10 * np.pi) ** 2) * np.cos(10 * np.pi * t))
    assert ia.analysis.weighted_rms(run, "mass.a") == pytest.approx(plain, rel=1e-3)


def test_a_sweep_measures_over_time() -> None:
    def ride(dae: Any, values: dict[str, float]) -> dict[str, float]:
        run = ia.simulate(dae, 5.0, parameters=values, start={"rub.v_rel": 0.0}, step=0.5)
        return {"rms": run.rms("block.v"), "stuck": run.share("rub.mode", "stuck")}

    done = ia.sweeps.sweep(belt(), {"spring.k": [50.0, 100.0]}, ride, workers=0).table
    fine = belt().simulate(5.0, start={"rub.v_rel": 0.0}, step=1e-3)
    assert done["rms"].to_list()[1] == pytest.approx(fine.rms("block.v"), rel=1e-3)
    assert done["stuck"].to_list()[1] == pytest.approx(fine.share("rub.mode", "stuck"), rel=1e-3)


def test_friction_that_comes_to_rest_is_followed_to_its_last_instant() -> None:
    """Its slope over speed is that of the motion, not that of |v| at zero, by which it was 0.1 N off."""
    coarse, fine = (belt().simulate(2.0, step=step, rtol=1e-9, atol=1e-11) for step in (4e-3, 1e-5))
    sticks = next(event.time for event in fine.events if event.target == "stuck")
    times = np.linspace(sticks - 2e-3, sticks - 1e-6, 50)
    assert coarse.at("rub.f", times) == pytest.approx(fine.at("rub.f", times), abs=1e-2)
