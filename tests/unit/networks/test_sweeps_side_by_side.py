"""Sweeps whose runs go side by side without being told: as if each had gone alone."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import scatter
from inertance.networks.lanes import kinds
from inertance.sweeps import Design, Sweep, sweep

SIDE_BY_SIDE = "side by side"


@pytest.fixture(autouse=True)
def compiled_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kinds, "WRITE_SECONDS", 0.0)
    monkeypatch.setattr(kinds, "LANES_SECONDS", 0.0)


def rubbing() -> ia.Network:
    """A block that sticks and slips behind a spring, in millimetres."""
    net = ia.Network(
        "rubbing",
        wall=ia.Fixed(),
        pull=ia.Position(),
        spring=ia.Spring(k=900.0),
        rub=ia.CoulombFriction(f_c=3.0),
        mass=ia.Mass(m=0.5),
    )
    net.connect(net.pull.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.rub.flange_b)
    return net.connect(net.wall.flange, net.rub.flange_a)


DRAG = ia.Sampled(np.linspace(1.9, 3.1, 400), 0.02 * np.sin(12 * np.linspace(1.9, 3.1, 400)))
POINTS = Design(
    ("rub.f_c", "spring.k"), tuple((f, k) for f in (1.0, 2.0, 4.0) for k in (300.0, 900.0, 1500.0))
)
CALLS: list[float] = []


def run_of(dae: ia.DAE, values: dict[str, Any], **more: Any) -> ia.Result:
    return ia.simulate(
        dae, 3.0, begin=2.0, parameters=values, inputs={"pull.s_ref": DRAG}, start={"mass.v": 0.01},
        solver="compiled", **more,
    )  # fmt: skip


def told(run: ia.Result) -> dict[str, float]:
    """Return what differs if anything of a run does."""
    stuck = run["rub.mode"]
    return {
        "peak": float(np.abs(run["mass.a"]).max()),
        "mean": run.rms("rub.f"),
        "points": float(len(run.time)),
        "events": float(len(run.events)),
        "first": run.events[-1].time,
        "by": float(run.stats["events by component"]["CoulombFriction 'rub'"]),
        "modes": float(np.abs(np.diff(stuck)).sum()),
        "start": run.initial[0].value,
        "energy": float(run.energy().closes),
        "stretch": float(run["spring.s_rel"][-1]),
    }


def measure(dae: ia.DAE, values: dict[str, Any]) -> dict[str, float]:
    return told(run_of(dae, values))


def reach(dae: ia.DAE, values: dict[str, Any]) -> float:
    CALLS.append(values["rub.f_c"])
    return float(np.abs(run_of(dae, values)["mass.s"]).max())


def until_compiled(go: Callable[[], Sweep]) -> Sweep:
    """Sweep until the compiler has ended beside it."""
    deadline, runs = time.monotonic() + 120, dict[str, int]()
    while time.monotonic() < deadline:
        done = go()
        runs = dict(done.runs)
        if done.runs.get(SIDE_BY_SIDE) and done.runs["too few for lanes so far"] <= 3:
            return done
        time.sleep(0.2)
    raise AssertionError(runs)


def test_rows_are_those_of_runs_alone() -> None:
    done = until_compiled(lambda: sweep(rubbing, POINTS, measure, workers=0))
    assert done.runs[SIDE_BY_SIDE] == len(POINTS) - 2
    assert sum(done.runs.values()) == len(POINTS)
    dae = rubbing().dae()
    rows = done.table.to_dict("records")
    for point, row in zip(POINTS.points, rows, strict=True):
        alone = told(run_of(dae, dict(zip(POINTS.names, point, strict=True))))
        for name, value in alone.items():
            assert row[name] == pytest.approx(value, rel=2e-4, abs=1e-6), (point, name)
    assert len({row["events"] for row in rows}) > 2


def test_a_measure_is_called_once_a_point() -> None:
    until_compiled(lambda: sweep(rubbing, POINTS, reach, workers=0))
    CALLS.clear()
    sweep(rubbing, POINTS, reach, workers=0)
    assert sorted(CALLS) == sorted(point[0] for point in POINTS.points)


def picky(dae: ia.DAE, values: dict[str, Any]) -> float:
    """Fail where friction is low; ask again for a shorter run where it is high."""
    run = run_of(dae, values)
    if values["rub.f_c"] < 1.5:
        raise ValueError("slides too far")
    if values["rub.f_c"] > 3:
        run = run_of(dae, values, step=1e-3)
    return float(np.abs(run["mass.s"]).max())


def test_failures_and_second_runs_stay_with_their_points() -> None:
    done = until_compiled(lambda: sweep(rubbing, POINTS, picky, workers=0))
    frictions = np.array([point[0] for point in POINTS.points])
    assert [text == "ValueError: slides too far" for text in done.table["error"]] == (
        frictions < 1.5
    ).tolist()
    dae = rubbing().dae()
    for place in np.flatnonzero(frictions > 1.5):
        values = dict(zip(POINTS.names, POINTS.points[place], strict=True))
        assert float(done.table["value"].iloc[place]) == pytest.approx(picky(dae, values), rel=1e-4)


def guessed(dae: ia.DAE, values: dict[str, Any]) -> float:
    return float(run_of(dae, values, guess={"mass.s": 0.0})["mass.s"][-1])


def test_what_goes_alone_is_told_with_its_reason() -> None:
    done = sweep(rubbing, POINTS, guessed, workers=0)
    assert done.runs == {"guess= is given": len(POINTS)}


def test_a_value_out_of_range_is_the_error_of_its_point() -> None:
    points = Design(POINTS.names, (*POINTS.points, (-1.0, 900.0)))
    done = until_compiled(lambda: sweep(rubbing, points, reach, workers=0))
    assert len(done.failed) == 1
    assert "rub.f_c" in done.table["error"].iloc[-1]


def test_scatter_is_that_of_runs_alone() -> None:
    dae = rubbing().dae()

    def peak(dae: ia.DAE, *, parameters: Any) -> float:
        return float(np.abs(run_of(dae, parameters)["mass.v"]).max())

    spread = {"rub.f_c": 0.2, "spring.k": 0.1}
    found = scatter(dae, peak, spread, samples=12, seed=3)
    again = scatter(
        dae, lambda dae, *, parameters: peak(dae, parameters=parameters), spread, samples=12, seed=3
    )
    assert found.values == pytest.approx(again.values, rel=1e-4)
    assert found.std > 0
