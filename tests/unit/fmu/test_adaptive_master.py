"""Co-simulation that keeps a tolerance: error asked for against error got, with events, and what it costs."""

from __future__ import annotations

import shutil
from pathlib import Path

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import FMUError
from inertance.fmu import SystemStructure, split
from scipy.interpolate import CubicSpline

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
STOP = 0.3


def car() -> ia.Network:
    """A quarter car with a guide that sticks and a bump stop, on a road that shakes both."""
    net = ia.Network(
        "quarter car",
        road=ia.Position(s_ref=lambda t: 0.02 * ca.sin(9 * t) + 0.004 * ca.sin(31 * t)),
        tyre=ia.Spring(k=150e3),
        wheel=ia.Mass(m=35.0),
        strut=ia.SpringDamper(k=20e3, d=1.5e3),
        guide=ia.CoulombFriction(f_c=150.0),
        bump=ia.ElastoGap(k=8e4, d=400.0, s_rel0=-0.01),
        body=ia.Mass(m=250.0),
    )
    net.connect(net.road.flange, net.tyre.flange_a)
    net.connect(
        net.tyre.flange_b, net.wheel.flange, net.strut.flange_a, net.guide.flange_a, net.bump.flange_a
    )
    return net.connect(net.strut.flange_b, net.body.flange, net.guide.flange_b, net.bump.flange_b)


@pytest.fixture(scope="module")
def truth() -> ia.Result:
    return car().simulate(STOP, step=1e-4, rtol=1e-11, atol=1e-13)


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def halves(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> SystemStructure:
    folder = tmp_path_factory.mktemp("halves")
    cut = split(car(), ["body"], names=("body", "wheel"))
    return cut.export(
        folder,
        fmi_version=request.param,
        outputs=["body.s", "wheel.s"],
        sources=False,
        tolerance=1e-9,
        stop=STOP,
    )


def error(run: ia.fmu.SystemRun, truth: ia.Result) -> float:
    """Return how far body and wheel are off, as a share of how far they go."""
    time, places = np.unique(truth.time, return_index=True)
    found = []
    for name in ("body.s", "wheel.s"):
        exact = CubicSpline(time, truth[name][places])(run.time)
        found.append(np.abs(run[f"{name.partition('.')[0]}.{name}"] - exact).max() / np.ptp(truth[name]))
    return float(max(found))


def test_the_error_got_is_below_the_error_asked_for_and_follows_it(
    halves: SystemStructure, truth: ia.Result
) -> None:
    assert len(truth.events) >= 4
    asked = [1e-2, 1e-3, 1e-4, 1e-5][: 4 if halves.components["body"].version == "3.0" else 3]
    runs = [halves.simulate(tolerance=tolerance) for tolerance in asked]
    got = [error(run, truth) for run in runs]
    assert all(error < tolerance for error, tolerance in zip(got, asked, strict=True)), got
    assert all(error > tolerance / 1000 for error, tolerance in zip(got, asked, strict=True)), got
    steps = [run.stats["communication steps"] for run in runs]
    assert steps == sorted(steps)
    # order 2 across events: a hundredth of the tolerance costs ten times the steps, not a hundred
    assert steps[-1] / steps[-3] < 15
    for run in runs:
        stats = run.stats
        assert stats["attempts"] > 1.5 * stats["communication steps"]
        assert 0 < stats["longest step"] <= STOP / 20 * (1 + 1e-9)
        assert run.time[-1] == STOP
        assert set(run.step_error) == {connection.start for connection in halves.connections}


def test_fewer_steps_than_equal_ones_for_the_same_error(halves: SystemStructure, truth: ia.Result) -> None:
    kept = halves.simulate(tolerance=1e-4)
    steps = kept.stats["communication steps"]
    equal = halves.simulate(communication_step=STOP / steps, halving=False, rtol=1e-9)
    assert error(kept, truth) < error(equal, truth)


def test_a_swing_that_nothing_damps_follows_its_closed_form(tmp_path: Path) -> None:
    net = ia.Network("swing", wall=ia.Fixed(s0=0.3), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    cut = split(net, ["mass"], names=("mass", "rest"))
    start = {"mass.s": 0.1, "mass.v": -0.5}
    system = cut.export(tmp_path, outputs=["mass.s"], start=start, sources=False, tolerance=1e-9, stop=1.5)
    run = system.simulate(tolerance=1e-4, communication_step=0.05)
    exact = 0.3 - 0.2 * np.cos(10 * run.time) - 0.05 * np.sin(10 * run.time)
    assert np.abs(run["mass.mass.s"] - exact).max() < 1e-4 * np.ptp(exact)
    assert (np.abs(run.time[:, None] - 0.05 * np.arange(31)).min(axis=0) < 1e-9).all()


def test_what_cannot_be_kept_is_refused(halves: SystemStructure) -> None:
    with pytest.raises(FMUError, match="needs a communication_step"):
        halves.simulate()
    with pytest.raises(FMUError, match=r"tolerance must lie between 1e-08 and 0\.1, got 0\.5"):
        halves.simulate(tolerance=0.5)
