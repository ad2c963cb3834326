"""Friction makes steps, and the filter of a channel rounds them: no effect may be seen in that."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import Verdict, diagnose
from inertance.identification import (
    Campaign,
    Heard,
    Multisine,
    NoiseFloor,
    Record,
    floors_beside,
    passed_band,
    sampled,
    spectral_floor,
)
from numpy.typing import NDArray
from scipy.signal import bessel, butter, sosfilt, sosfiltfilt

Array = NDArray[np.float64]
Logger = Callable[[Array], Array]

RATE, FINE, DURATION, NOISE = 250.0, 4000.0, 6.0, 0.1
CHANNELS = {
    "x": {"input": "actuator.s_ref", "unit": "m"},
    "F": {"output": "load_cell.f", "unit": "N"},
}
BUTTERWORTH, STEEP, HIGH = (
    butter(n, f, fs=FINE, output="sos") for n, f in ((2, 40.0), (6, 50.0), (2, 100.0))
)
BESSEL = bessel(4, 30.0, fs=FINE, output="sos")
LOGGERS: dict[str, Logger] = {
    "none": lambda values: values,
    "zero-phase": lambda values: np.asarray(sosfiltfilt(BUTTERWORTH, values, axis=0)),
    "causal": lambda values: np.asarray(sosfilt(BESSEL, values, axis=0)),
    "high": lambda values: np.asarray(sosfiltfilt(HIGH, values, axis=0)),
    "steep": lambda values: np.asarray(sosfiltfilt(STEEP, values, axis=0)),
}
DROOP = {"causal": 0.05}  # of a Bessel filter at a third of its cutoff


def bench(rubbing: bool = False) -> ia.Network:
    """A specimen whose stroke is prescribed and whose force is measured; there are no states."""
    net = ia.Network(
        "bench",
        frame=ia.Fixed(),
        specimen=ia.SpringDamper(k=2.0e4, d=900.0),
        slider=ia.Mass(m=1.2),
        load_cell=ia.ForceSensor(),
        actuator=ia.Position(),
    )
    net.connect(net.actuator.flange, net.load_cell.flange_a)
    net.connect(net.load_cell.flange_b, net.slider.flange, net.specimen.flange_b)
    net.connect(net.frame.flange, net.specimen.flange_a)
    if rubbing:
        net.add(friction=ia.CoulombFriction(f_c=2.0))
        net.connect(net.frame.flange, net.friction.flange_a)
        net.connect(net.slider.flange, net.friction.flange_b)
    return net


def measured(net: ia.Network, logger: Logger, seed: int) -> Record:
    stroke = sampled(Multisine(rms=0.004, low=0.2, high=5.0, period=8.0, seed=seed), stop=8.0, rate=FINE)
    run = net.simulate(8.0, inputs={"actuator.s_ref": stroke}, step=1 / FINE)
    force = np.interp(stroke.time, run.time, run["load_cell.f"])
    noise = NOISE * np.sqrt(FINE / RATE) * np.random.default_rng(seed).standard_normal(len(force))
    seen = logger(np.column_stack([stroke.values, force + noise]))
    part = slice(int(FINE), int((1 + DURATION) * FINE), int(FINE / RATE))
    x, F = (np.round(column[part] / step) * step for column, step in zip(seen.T, (2e-7, 5e-3), strict=True))
    return Record(f"run {seed}", np.arange(len(x)) / RATE, {"x": x, "F": F})


def verdict_on(logger: str, rubbing: bool = True) -> Verdict:
    records = [measured(bench(rubbing), LOGGERS[logger], seed) for seed in (1, 2, 3)]
    priors = {"specimen.k": {"rel": 0.2}, "specimen.d": {"rel": 0.2}}
    train, test = [{"record": record} for record in records[:2]], [{"record": records[2]}]
    return diagnose(Campaign(bench(), CHANNELS, priors, train, test))


@pytest.mark.parametrize("logger", [*LOGGERS])
def test_friction_is_named_whatever_filter_has_rounded_its_steps(logger: str) -> None:
    found = verdict_on(logger)
    assert [placed.label for placed in found.effects] == ["coulomb_friction at specimen"]
    assert found.effects[0].values["f_c"] == pytest.approx(2.0, rel=DROOP.get(logger, 0.02))
    assert found.closed == pytest.approx(1.0, abs=0.01)
    if logger != "none":
        assert found.gap["F"].over_noise == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("logger", ["zero-phase", "causal"])
def test_nothing_is_named_where_a_filter_is_all_that_is_there(logger: str) -> None:
    assert verdict_on(logger, rubbing=False).verdict in ("none", "parameters")


def heard(told: Array, seen: Array, floor: NoiseFloor | None = None) -> Heard:
    return Heard(seen - told, seen, [], floor or spectral_floor(seen, RATE), RATE)


def stepping(count: int, seed: int) -> Array:
    """A slow signal with a step at each of its reversals."""
    rng, time = np.random.default_rng(seed), np.arange(count) / RATE
    angle = 2 * np.pi * np.outer((0.7, 1.9, 3.1), time) + rng.uniform(0, 6, (3, 1))
    speed = np.sin(angle).sum(axis=0)
    return np.asarray(speed + 0.3 * np.sign(speed))


def low_passed(values: Array, cutoff: float) -> Array:
    return np.asarray(sosfiltfilt(butter(2, cutoff, fs=RATE, output="sos"), values))


@pytest.mark.parametrize("cutoff", [15.0, 40.0, 60.0])
def test_the_band_of_a_filter_is_read_where_the_model_foresees_more(cutoff: float) -> None:
    told = stepping(5000, 1)
    assert passed_band([heard(told, low_passed(told, cutoff))]) == pytest.approx(cutoff, rel=0.3)


def test_what_is_wrong_otherwise_is_no_filter() -> None:
    """A gain takes away as much everywhere, noise hides what a filter takes, and other laws are smooth."""
    told, noise = stepping(5000, 2), 0.05 * np.random.default_rng(3).standard_normal(5000)
    for seen in (told, 0.2 * told, 0.2 * told + 0.01 * noise, told + noise, low_passed(told, 30.0) + noise):
        assert passed_band([heard(told, seen)]) == inf
    smooth = low_passed(told, 20.0)
    assert passed_band([heard(smooth, told)]) == inf


def test_noise_beside_a_better_model_takes_the_place_of_what_a_poorer_left() -> None:
    told, rng = stepping(5000, 4), np.random.default_rng(5)
    seen = low_passed(told + 0.01 * rng.standard_normal(5000), 40.0)
    poor = told + 0.1 * np.sin(30 * np.cumsum(told) / RATE)
    (first,) = floors_beside([heard(poor, seen)])
    assert first.passed < inf
    assert not first.is_sure
    (second,) = floors_beside([heard(told, seen, first)])
    assert second.white(RATE) == pytest.approx(0.01, rel=0.3)
    assert second.white(RATE) < first.white(RATE)
    assert floors_beside([heard(told, seen, second)]) == [second]
    assert floors_beside([heard(poor, seen, second)]) == [second]


def test_a_model_that_misses_motion_tells_of_no_filter() -> None:
    """What follows an input, or is more than any sensor's noise, is for an effect: it was called noise."""
    told, drive = stepping(5000, 8), 0.03 * np.random.default_rng(9).standard_normal(5000)
    seen = low_passed(told, 40.0)
    assert passed_band([heard(told, seen)]) < inf
    for missed, driving in (
        (drive, [drive]),
        (8 * drive, []),
        (0.3 * np.sin(30 * np.cumsum(told) / RATE), []),
    ):
        other = seen + low_passed(missed, 40.0)
        assert passed_band([Heard(other - told, other, driving, spectral_floor(other, RATE), RATE)]) == inf
    noisy = seen + low_passed(drive, 40.0)
    assert passed_band([heard(told, noisy)]) == pytest.approx(40.0, rel=0.3)


def test_stated_noise_stays_and_is_compared_in_the_band_that_passes() -> None:
    told = stepping(5000, 6)
    (floor,) = floors_beside([heard(told, low_passed(told, 40.0), NoiseFloor(0.01, "stated"))])
    assert (floor.sigma, floor.source) == (0.01, "stated")
    assert floor.passed == pytest.approx(40.0, rel=0.3)


def test_a_record_that_stands_still_and_one_without_noise_weigh_something() -> None:
    told = stepping(5000, 7)
    still, seen = np.zeros(5000), low_passed(told, 40.0)
    records = [heard(told, seen), heard(seen, seen), heard(still, still, NoiseFloor(0.01, "spectrum"))]
    moved, exact, nothing = floors_beside(records)
    assert moved.passed == exact.passed == nothing.passed < inf
    assert exact.sigma == pytest.approx(1e-6 * np.ptp(seen))
    assert nothing.sigma == 0.01
