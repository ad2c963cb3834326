"""Sampled inputs: known throughout a run, held where that is asked for, and told where they mislead."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.fmu import FMU
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
SOLVERS = ["cvodes", "idas", "rosenbrock", "compiled"]
TIME = np.linspace(2.0, 3.0, 21)
FORCE = np.sign(np.sin(12 * TIME))
K, D = 100.0, 2.0


def oscillator(force: Any = None) -> ia.Network:
    push = ia.Force() if force is None else ia.Force(f=force)
    net = ia.Network("oscillator", push=push, mass=ia.Mass(m=1.0), wall=ia.Fixed())
    net.add(spring=ia.SpringDamper(k=K, d=D)).connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def reference(force: Callable[[float], float], begin: float, stop: float) -> float:
    """Return where the mass ends, by SciPy."""

    def rates(t: float, y: Array) -> list[float]:
        return [y[1], force(min(max(t, 2.0), 3.0)) - K * y[0] - D * y[1]]

    run = solve_ivp(rates, (begin, stop), [0.0, 0.0], rtol=1e-9, atol=1e-12, max_step=2e-3)
    return float(run.y[0, -1])


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize(("begin", "stop"), [(2.0, 4.0), (1.0, 3.0), (0.0, 10.0), (3.5, 4.0)])
def test_a_run_beyond_its_data_is_refused(solver: str, begin: float, stop: float) -> None:
    told = rf"input 'push.f': its data are from 2 to 3 s, wanted are {begin:g} to {stop:g} s; .*hold"
    with pytest.raises(ia.ModelError, match=told):
        oscillator().simulate(stop, begin=begin, inputs={"push.f": (TIME, FORCE)}, solver=solver)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("interpolation", ["cubic", "linear"])
def test_data_are_held_on_request(solver: str, interpolation: str) -> None:
    between = CubicSpline(TIME, FORCE) if interpolation == "cubic" else None
    force = ia.Sampled(TIME, FORCE, interpolation=interpolation, extrapolation="hold")
    run = oscillator().simulate(
        5.0, begin=1.0, inputs={"push.f": force}, solver=solver, rtol=1e-8, atol=1e-10
    )
    after = run["push.f"][run.time > 3.0]
    assert np.all(after == FORCE[-1])
    assert np.all(run["push.f"][run.time < 2.0] == FORCE[0])

    def known(t: float) -> float:
        return float(between(t) if between else np.interp(t, TIME, FORCE))

    assert run["mass.s"][-1] == pytest.approx(reference(known, 1.0, 5.0), abs=1e-7)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_position_that_is_held_stands_still(solver: str) -> None:
    net = ia.Network("driven", table=ia.Position(), mount=ia.SpringDamper(k=K, d=D), mass=ia.Mass(m=1.0))
    net.connect(net.table.flange, net.mount.flange_a).connect(net.mount.flange_b, net.mass.flange)
    place = ia.Sampled(TIME, 0.1 * np.sin(12 * TIME), extrapolation="hold")
    run = net.simulate(4.0, begin=1.0, inputs={"table.s_ref": place}, solver=solver)
    outside = (run.time < 2.0) | (run.time > 3.0)
    assert np.all(run["mount.v_rel"][outside] == pytest.approx(run["mass.v"][outside], abs=1e-12))


def test_rounding_of_instants_is_no_end_of_data() -> None:
    time = np.arange(0, 1.1, 0.1)  # ends at 1.0000000000000002
    run = oscillator().simulate(1.0, inputs={"push.f": (0.1 * np.arange(4) / 0.3, np.ones(4))})
    assert run["push.f"][-1] == pytest.approx(1.0)
    run = oscillator().simulate(float(time[-1]), inputs={"push.f": (np.linspace(0, 1, 11), np.ones(11))})
    assert run["push.f"][-1] == pytest.approx(1.0)


def test_signals_bound_to_components_must_last_too() -> None:
    with pytest.raises(ia.ModelError, match=r"data are from 2 to 3 s, wanted are 0 to 1 s"):
        oscillator(ia.Sampled(TIME, FORCE)).simulate(1.0)


def test_operating_points_and_stepwise_runs_keep_to_the_data() -> None:
    dae = oscillator(ia.Sampled(TIME, FORCE)).dae()
    with pytest.raises(ia.ModelError, match="data are from 2 to 3 s, wanted are t = 0 s"):
        ia.analysis.operating_point(dae)
    assert ia.analysis.operating_point(dae, time=2.5).values["mass.s"] == pytest.approx(-1 / K, rel=1e-6)
    from inertance.networks import Stepwise

    with pytest.raises(ia.ModelError, match=r"wanted are 2 to 3\.5 s"):
        Stepwise(dae, 2.0, 3.5, {}, {})
    going = Stepwise(dae, 2.0, 3.0, {}, {})
    going.advance(3.0)
    with pytest.raises(ia.ModelError, match=r"t must be from 3 to 3 s, got 3\.5"):
        going.advance(3.5)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_an_fmu_ends_where_its_data_end(tmp_path: Path, version: str, kind: str) -> None:
    time = TIME - 2.0
    path = tmp_path / "rig.fmu"
    ia.export_fmu(oscillator(ia.Sampled(time, FORCE)), path, fmi_version=version, outputs=["mass.s"])
    within = FMU(path).simulate(1.0, kind=kind)["mass.s"][-1]
    own = oscillator(ia.Sampled(time, FORCE)).simulate(1.0)["mass.s"][-1]
    assert within == pytest.approx(own, abs=1e-5)
    with pytest.raises(ia.InertanceError, match="the data of its inputs are from 0 to 1 s"):
        FMU(path).simulate(2.0, kind=kind)


@pytest.mark.parametrize("interpolation", ["cubic", "linear"])
def test_an_fmu_holds_data_on_request_and_is_held_to_those_it_is_given(
    tmp_path: Path, interpolation: str
) -> None:
    time = TIME - 2.0
    held = ia.Sampled(time, FORCE, interpolation=interpolation, extrapolation="hold")
    path = tmp_path / "rig.fmu"
    ia.export_fmu(oscillator(held), path, outputs=["mass.s"])
    own = oscillator(held).simulate(3.0)["mass.s"][-1]
    assert FMU(path).simulate(3.0, kind="ME")["mass.s"][-1] == pytest.approx(own, abs=1e-6)
    ia.export_fmu(oscillator(), path, outputs=["mass.s"])
    with pytest.raises(
        ia.ModelError, match=r"input 'push\.f': its data are from 0 to 1 s, wanted are 0 to 3"
    ):
        FMU(path).simulate(3.0, kind="ME", inputs={"push.f": (time, FORCE)})
    run = FMU(path).simulate(3.0, kind="ME", inputs={"push.f": held})
    assert run["mass.s"][-1] == pytest.approx(own, abs=1e-6)


def test_linear_data_drive_no_speed_and_no_acceleration() -> None:
    net = ia.Network("driven", table=ia.Position(), mass=ia.Mass(m=1.0))
    net.connect(net.table.flange, net.mass.flange)
    linear = ia.Sampled(TIME, FORCE, interpolation="linear")
    with pytest.raises(ia.ModelError, match="derivative of order 2 is needed, which linear data do not have"):
        net.simulate(3.0, begin=2.0, inputs={"table.s_ref": linear})
    damped = ia.Network("damped", table=ia.Position(), mass=ia.Mass(m=1.0), strut=ia.Damper(d=1.0))
    damped.connect(damped.table.flange, damped.strut.flange_a).connect(
        damped.strut.flange_b, damped.mass.flange
    )
    with pytest.raises(ia.ModelError, match="derivative of order 1 is needed, which linear data do not have"):
        damped.simulate(3.0, begin=2.0, inputs={"table.s_ref": linear})


def noisy(count: int, seed: int) -> ia.Sampled:
    return ia.Sampled(np.arange(count) * 1e-3, np.random.default_rng(seed).normal(size=count))


def test_a_jump_between_samples_is_told_with_what_the_spline_makes_of_it() -> None:
    time = np.linspace(0, 1, 1001)
    step = np.where(time > 0.5, 1.0, 0.0)
    run = oscillator().simulate(1.0, step=1e-4, inputs={"push.f": (time, step)})
    overshoot = run["push.f"].max() - 1.0
    assert overshoot > 0.1
    told = f"jumps within one sample at t = 0.5 s, which a cubic spline overshoots by {overshoot:.0%}"
    assert any(told in note and "interpolation='linear'" in note for note in run.notes)
    net = ia.Network("driven", table=ia.Position(), strut=ia.Damper(d=1.0), mass=ia.Mass(m=1.0))
    net.connect(net.table.flange, net.strut.flange_a).connect(net.strut.flange_b, net.mass.flange)
    notes = net.simulate(1.0, inputs={"table.s_ref": (time, step)}).notes
    assert any(told in note and "its derivative is needed" in note for note in notes)
    linear = ia.Sampled(time, step, interpolation="linear")
    run = oscillator().simulate(1.0, step=1e-4, inputs={"push.f": linear})
    assert run["push.f"].max() == 1.0
    assert not run.notes


def test_a_gap_and_instants_that_all_but_coincide_are_told() -> None:
    time, values = noisy(1001, 1).time, noisy(1001, 1).values
    gap = np.r_[0:300, 700:1001]
    doubled = np.sort(np.r_[time, 0.5 + 1e-9])
    for instants, numbers in ((time[gap], values[gap]), (doubled, noisy(1002, 2).values)):
        run = oscillator().simulate(1.0, inputs={"push.f": (instants, numbers)}, step=0.1)
        assert any("times their range beyond them" in note for note in run.notes)


def test_smooth_and_noisy_data_are_told_nothing_of() -> None:
    time = np.linspace(0, 1, 1001)
    waves = [np.sin(2 * np.pi * f * time + 0.3) for f in (1.0, 30.0, 100.3, 250.0)]
    steps = np.round(4 * np.sin(2 * np.pi * time)) / 4
    smooth = [*waves, np.exp(-(((time - 0.5) / 2e-3) ** 2)), steps, noisy(1001, 3).values]
    for values in smooth:
        run = oscillator().simulate(1.0, inputs={"push.f": (time, values)}, step=0.1)
        assert not run.notes


def test_a_time_column_in_milliseconds_is_asked_about() -> None:
    milliseconds = np.arange(0.0, 10001.0)
    run = oscillator().simulate(10.0, inputs={"push.f": (milliseconds, np.sin(milliseconds / 1e3))})
    assert any("uses 0.001 of its data" in note and "seconds?" in note for note in run.notes)


COUNT = np.arange(8)


@pytest.mark.parametrize(
    ("time", "values", "told"),
    [
        (COUNT > 3, COUNT, "time is bool"),
        (COUNT, COUNT > 3, "values is bool"),
        (COUNT * 1j, COUNT, "time is complex"),
        (COUNT, COUNT + 1j, "values is complex"),
        (COUNT.astype("M8[s]"), COUNT, r"time is datetime64.*timedelta64\(1, 's'\)"),
        (COUNT.astype("m8[ms]"), COUNT, "time is timedelta64"),
        ([str(n) for n in COUNT], COUNT, "time is text"),
        (COUNT, np.ma.masked_array(COUNT, COUNT == 3), "value nan at sample 3"),
        (COUNT.reshape(2, 4), COUNT.reshape(2, 4), r"one column, got an array of shape \(2, 4\)"),
        (COUNT[:1], COUNT[:1], "at least 4 samples"),
    ],
)
def test_what_is_no_column_of_numbers_is_refused(time: Any, values: Any, told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        ia.Sampled(time, values)


def test_words_that_are_no_choice_are_refused() -> None:
    with pytest.raises(ia.ModelError, match="extrapolation is 'none' or 'hold', got 'last'"):
        ia.Sampled(COUNT, COUNT, extrapolation="last")
    with pytest.raises(ia.ModelError, match="interpolation is 'cubic' or 'linear' or 'hold', got 'spline'"):
        ia.Sampled(COUNT, COUNT, interpolation="spline")
