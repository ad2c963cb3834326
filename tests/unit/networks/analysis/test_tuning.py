"""Tuning with limits, fronts and scatter; roads, bumps and records from files."""

from collections.abc import Mapping
from math import sqrt
from pathlib import Path

import inertance as ia
import numpy as np
import pytest

D, K = "strut.d", "strut.k"
BOUNDS = {D: (500.0, 10e3)}


def car() -> ia.DAE:
    return ia.quarter_car(ia.SpringDamper(k=60e3, d=2000.0)).dae()


def test_a_limit_is_kept_and_costs() -> None:
    dae = car()
    bound = ia.tune(dae, ia.ride_j1, {K: (20e3, 60e3), **BOUNDS}, starts=1)
    travel = ia.suspension_travel(dae, parameters=bound.parameters)
    kept = ia.tune(
        dae, ia.ride_j1, {K: (20e3, 60e3), **BOUNDS}, limits=[(ia.suspension_travel, 0.8 * travel)], starts=1
    )
    assert ia.suspension_travel(dae, parameters=kept.parameters) <= 0.8 * travel * (1 + 1e-6)
    assert kept.value > bound.value
    assert K in bound.at_bound


def test_a_front_goes_from_one_optimum_to_the_other() -> None:
    dae = car()
    designs = ia.front(dae, ia.ride_j1, ia.suspension_travel, {D: (1500.0, 6e3)}, points=4, starts=1)
    first, second = zip(*[d[:2] for d in designs], strict=True)
    assert len(designs) == 4
    assert list(first) == sorted(first)
    assert list(second) == sorted(second, reverse=True)
    assert first[0] == pytest.approx(1.759967, abs=1e-6)
    assert designs[-1][2][D] == pytest.approx(6e3, rel=1e-6)


def test_scatter_of_a_linear_measure_is_that_of_its_parameter() -> None:
    def stiffness(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
        return parameters.get(K, 60e3)

    spread = ia.scatter(car(), stiffness, {K: 0.05}, samples=400)
    assert spread.nominal == 60e3
    assert spread.mean == pytest.approx(60e3, rel=1e-3)
    assert spread.std == pytest.approx(0.05 * 60e3, rel=0.02)
    assert spread.quantile(0.975) == pytest.approx(60e3 * (1 + 0.05 * 1.95), rel=0.01)


def test_what_cannot_be_tuned_is_told() -> None:
    with pytest.raises(ia.ModelError, match=r"did you mean 'strut\.k'"):
        ia.tune(car(), ia.ride_j1, {"strut.e": (1.0, 2.0)})
    with pytest.raises(ia.ModelError, match="lower to a higher"):
        ia.tune(car(), ia.ride_j1, {D: (2.0, 1.0)})
    with pytest.raises(ia.ModelError, match=r"ride_j1 <= 0\.1"):
        ia.tune(car(), ia.tyre_j3, BOUNDS, limits=[(ia.ride_j1, 0.1)], starts=1)


def test_bump_lifts_a_car_and_lets_it_down() -> None:
    run = ia.quarter_car(ia.SpringDamper(k=60e3, d=2600.0)).simulate(
        3.0, inputs={"road.s_ref": ia.bump(0.05, 2.0, 10.0, begin=0.1)}
    )
    assert run["road.s_ref"].max() == pytest.approx(0.05, rel=1e-3)
    assert abs(run["body.s"][-1]) < 1e-4
    assert run["body.s"].max() > 0.02


def test_records_are_read_from_files(tmp_path: Path) -> None:
    table = tmp_path / "wind.csv"
    table.write_text("time,force\n0,1\n0.1,2\n0.2,4\n0.3,3\n", encoding="utf-8")
    assert ia.record(table, scale=1e3).values.tolist() == [1e3, 2e3, 4e3, 3e3]
    with pytest.raises(ia.ModelError, match="did you mean 'force'"):
        ia.record(table, "forse")
    table.write_text("time,force\n0,1\n0.1,x\n", encoding="utf-8")
    with pytest.raises(ia.ModelError, match="line 3"):
        ia.record(table)
    quake = tmp_path / "quake.at2"
    quake.write_text(
        "PEER\nsomewhere\nacceleration in g\nNPTS=   5, DT=   .0100 SEC\n 0 .1 .2\n .1 0\n", encoding="utf-8"
    )
    found = ia.record(quake)
    assert found.time[1] == 0.01
    assert found.values[2] == pytest.approx(0.2 * 9.80665)


def test_road_too_short_for_its_waves_is_told() -> None:
    with pytest.raises(ia.ModelError, match="holds no wave"):
        ia.road_profile("A", 10.0, 1.0)
    with pytest.raises(ia.ModelError, match="A to H"):
        ia.roughness("Z")


def test_base_shear_and_drift_of_one_storey() -> None:
    zeta, w = 0.05, 10.0
    frame = ia.shear_frame([1e3], [1e3 * w**2], [2 * zeta * 1e3 * w])
    peak = 1 / (2 * zeta * sqrt(1 - zeta**2) * w**2)
    assert ia.drift(frame) == pytest.approx(peak, rel=1e-9)
    assert ia.base_shear(frame) == pytest.approx(1e3 * sqrt(1 + 4 * zeta**2) * w**2 * peak, rel=2e-3)


def test_white_noise_by_the_spectrum_and_by_lyapunov() -> None:
    system = ia.linearise(car(), ["road.s_ref"], ["body.v"])
    rms = ia.response_rms(system, 2.0, 1e-3, 1e4)["body.v"]
    assert rms == pytest.approx(system.h2(), rel=1e-4)  # one-sided 2 is two-sided 1
    assert np.isscalar(rms)
