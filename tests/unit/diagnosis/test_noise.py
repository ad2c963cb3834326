"""Noise that a filter has left little of, that differs by record, that is larger than was thought."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import (
    Campaign,
    Filter,
    Heard,
    NoiseFloor,
    Record,
    filtered_floors,
    is_noise,
    residual_floor,
    spectral_floor,
    uncovered_floors,
)
from scipy.signal import lfilter

CHANNELS = {
    "F": {"input": "push.f", "unit": "N"},
    "x": {"output": "carriage.s", "unit": "m"},
}
PRIORS = {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}}
RATE, NOISE = 1000.0, 1e-5


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(rate=RATE, duration=6.0, noise=NOISE)


def filtered(record: Record, cutoff: float) -> Record:
    """Return a record all of whose channels went through one low-pass, written with seven digits."""
    low = Filter(cutoff=cutoff, order=4)
    values = {name: low.apply(v, record.rate) for name, v in record.values.items()}
    return replace(record, values={n: np.array([float(f"{x:.7g}") for x in v]) for n, v in values.items()})


def noisier(record: Record, times: float, seed: int) -> Record:
    rng = np.random.default_rng(seed)
    more = NOISE * np.sqrt(times**2 - 1) * rng.standard_normal(len(record.time))
    return replace(record, values=record.values | {"x": record.values["x"] + more})


def verdict_on(cart: Any, records: list[Record], **more: Any) -> ia.diagnosis.Verdict:
    train, test = [{"record": r} for r in records[:-1]], [{"record": records[-1]}]
    return ia.diagnose(Campaign(cart.rig(), CHANNELS, PRIORS, train, test, **more))


def test_the_band_of_a_low_passed_channel_is_told(cart: Any) -> None:
    record = cart.measured(cart.rig(k=820.0), 1)
    assert spectral_floor(record.values["x"], RATE).band == np.inf
    floor = spectral_floor(filtered(record, 60.0).values["x"], RATE)
    assert 60 < floor.band < 200
    assert floor.sigma < 0.1 * NOISE
    rng = np.random.default_rng(3)
    noise = Filter(cutoff=60.0).apply(NOISE * rng.standard_normal(8000), RATE)
    left = residual_floor(noise, RATE, floor)
    assert left.band == pytest.approx(60.0, rel=0.15)
    assert left.share(250.0) == pytest.approx(2 * left.band / 250)
    assert left.white(RATE) == pytest.approx(NOISE, rel=0.1)


def grid(values: Any, bits: int) -> Any:
    step = float(np.ptp(values)) / 2**bits
    return step * np.round(values / step)


def uncovered(
    model: Any, measured: Any, rate: float, *drives: Any, parts: int = 1
) -> list[NoiseFloor] | None:
    """Look at a channel in records that are parts of one."""
    pieces = zip(*(np.array_split(x, parts) for x in (measured - model, measured, *drives)), strict=True)
    heard = [Heard(left, seen, driving, spectral_floor(seen, rate), rate) for left, seen, *driving in pieces]
    return uncovered_floors(heard)


@pytest.mark.parametrize("cutoff", [60.0, 200.0])
def test_noise_that_a_filter_let_through_is_seen_above_the_steps_of_a_sensor(cutoff: float) -> None:
    """The steps of 16 bits fill the top of the spectrum, where the filter has left nothing."""
    rng, time = np.random.default_rng(5), np.arange(12000) / RATE
    signal, low = np.sin(11 * time), Filter(cutoff=cutoff)
    measured = grid(signal + low.apply(0.02 * rng.standard_normal(len(time)), RATE), 16)
    assert spectral_floor(measured, RATE).sigma < 1e-4
    alone = uncovered(signal, measured, RATE)
    assert alone is not None
    (found,) = alone
    assert not found.is_sure
    assert found.white(RATE) == pytest.approx(0.02, rel=0.15)
    missed = np.array_split((measured - signal)[::3], 6)
    thinned = uncovered(signal[::3], measured[::3], RATE / 3, parts=6)
    if cutoff < RATE / 6:
        scatter = [float(np.std(part)) for part in missed]
        assert [f.sigma for f in thinned or []] == pytest.approx(scatter, rel=0.2)
    else:
        assert thinned is None


@pytest.mark.parametrize(("bits", "order"), [(9, 1), (9, 2), (10, 2), (12, 4)])
@pytest.mark.parametrize("parts", [1, 8])
def test_noise_that_is_hardly_above_the_steps_of_a_sensor(bits: int, order: int, parts: int) -> None:
    """What a filter lets through lies on the even noise of rounding, a little above it or a hundred times."""
    rng, time = np.random.default_rng(8), np.arange(8 * 2500) / RATE
    signal = np.sin(11 * time) + 0.3 * np.sin(31 * time)
    passed = Filter(cutoff=80.0, order=order).apply(0.004 * rng.standard_normal(len(time)), RATE)
    measured = grid(signal + passed, bits)
    found = uncovered(signal, measured, RATE, parts=parts)
    assert found is not None
    missed = np.array_split(measured - signal, parts)
    assert [f.sigma for f in found] == pytest.approx([float(np.std(part)) for part in missed], rel=0.15)


def test_noise_is_seen_beyond_a_motion_that_a_model_misses_wholly() -> None:
    """What a ripple makes of a motion falls with frequency; the noise is level where that is below it."""
    rng, time = np.random.default_rng(4), np.arange(40000) / RATE
    rattle = rng.standard_normal(len(time))
    for _ in range(3):
        rattle = np.asarray(lfilter([0.02], [1.0, -0.98], rattle))
    signal = np.sin(11 * time)
    noise = Filter(cutoff=100.0, order=2).apply(0.02 * rng.standard_normal(len(time)), RATE)
    measured = grid(signal + 0.6 * rattle / rattle.std() + noise, 16)
    found = uncovered(signal, measured, RATE, parts=4)
    assert found is not None
    assert [floor.white(RATE) for floor in found] == pytest.approx([0.02] * 4, rel=0.2)


def test_records_that_were_sampled_at_other_rates_are_looked_at_together() -> None:
    rng, heard = np.random.default_rng(10), []
    for rate in (1000.0, 250.0, 500.0):
        time = np.arange(6000) / RATE
        signal = np.sin(11 * time) + 0.3 * np.sin(31 * time)
        measured = grid(signal + Filter(cutoff=80.0).apply(0.004 * rng.standard_normal(len(time)), RATE), 10)
        some = slice(None, None, round(RATE / rate))
        missed = (measured - signal)[some]
        heard.append(Heard(missed, measured[some], [], spectral_floor(measured[some], rate), rate))
    found = uncovered_floors(heard)
    assert found is not None
    assert [f.sigma for f in found] == pytest.approx(
        [float(np.std(each.residual)) for each in heard], rel=0.15
    )
    assert len({floor.band for floor in found}) == 1


def test_white_noise_is_what_the_top_of_the_spectrum_tells() -> None:
    rng, time = np.random.default_rng(9), np.arange(12000) / RATE
    signal = np.sin(11 * time)
    assert uncovered(signal, signal + 0.01 * rng.standard_normal(len(time)), RATE, parts=3) is None
    assert uncovered(signal[:60], signal[:60] + 0.01 * rng.standard_normal(60), RATE) is None


def test_a_record_that_is_too_short_has_the_noise_of_the_others() -> None:
    rng, time = np.random.default_rng(5), np.arange(12000) / RATE
    signal = np.sin(11 * time)
    measured = grid(signal + Filter(cutoff=60.0).apply(0.02 * rng.standard_normal(len(time)), RATE), 16)
    heard = [
        Heard(measured[part] - signal[part], measured[part], [], spectral_floor(measured[part], RATE), RATE)
        for part in (slice(0, 6000), slice(6000, 6040), slice(6040, None))
    ]
    found = uncovered_floors(heard)
    assert found is not None
    assert found[0].sigma != found[2].sigma
    assert found[1].sigma == pytest.approx(np.hypot(found[0].sigma, found[2].sigma) / np.sqrt(2))


@pytest.mark.parametrize("left", [0.0, 0.3])
def test_records_of_which_nothing_is_missed_have_the_noise_of_the_others(left: float) -> None:
    """A prescribed motion is met to the last digit; one that is off by a constant tells of no noise."""
    rng, time = np.random.default_rng(5), np.arange(12000) / RATE
    signal = np.sin(11 * time)
    measured = grid(signal + Filter(cutoff=60.0).apply(0.02 * rng.standard_normal(len(time)), RATE), 16)
    floor = spectral_floor(measured, RATE)
    met = Heard(np.full(len(time), left), measured, [signal], floor, RATE)
    missed = Heard(measured - signal, measured, [signal], floor, RATE)
    assert uncovered_floors([met, met]) is None
    alone, found = uncovered_floors([missed]), uncovered_floors([met, missed])
    assert alone is not None
    assert found is not None
    assert [one.sigma for one in found] == pytest.approx([alone[0].sigma] * 2)


def test_what_a_model_misses_of_a_motion_is_no_noise_of_a_filter() -> None:
    rng, time = np.random.default_rng(6), np.arange(12000) / RATE
    sweep = np.sin(2 * np.pi * 5 * time**2)
    friction, noise = np.sign(np.cos(40 * time)), 1e-4 * rng.standard_normal(len(time))
    struck = rng.standard_normal(len(time)) * (time % 1.0 < 0.05)
    for missed in (0.1 * sweep, 0.1 * friction, Filter(cutoff=90.0).apply(struck, RATE)):
        measured = grid(sweep + missed + noise, 16)
        for parts in (1, 5):
            assert uncovered(sweep, measured, RATE, parts=parts) is None


@pytest.mark.parametrize("share", [1.0, 0.2])
def test_what_differs_by_record_beside_the_same_noise_is_a_motion(share: float) -> None:
    """Where a machine is driven more it rattles more, level up to the top of what is compared as well."""
    rng, heard = np.random.default_rng(11), []
    rattle = Filter(cutoff=60.0).apply(rng.standard_normal(24000), RATE)
    for strength, missed in zip((1.0, share), np.array_split(0.05 * rattle, 2), strict=True):
        signal = np.sin(11 * np.arange(12000) / RATE)
        measured = signal + strength * missed + 1e-3 * rng.standard_normal(12000)
        heard.append(Heard(measured - signal, measured, [], spectral_floor(measured, RATE), RATE))
    assert heard[0].floor.sigma == pytest.approx(heard[1].floor.sigma, rel=0.1)
    found = uncovered_floors(heard)
    assert (found is not None) == (share == 1.0)


@pytest.mark.parametrize("share", [0.02, 0.2])
def test_what_follows_a_random_drive_is_no_noise_of_a_filter(share: float) -> None:
    """Its answer is even and steady, and a model may say nothing of it; noise is also both."""
    rng, low = np.random.default_rng(7), Filter(cutoff=90.0)
    drive, noise = (low.apply(rng.standard_normal(12000), RATE) for _ in range(2))
    slow = 20 * Filter(cutoff=3.0).apply(drive, RATE)
    for missed, noisy in ((share * drive, False), (share * noise, True)):
        measured = grid(slow + missed, 16)
        for parts in (1, 3):
            found = uncovered(slow, measured, RATE, np.zeros(len(drive)), drive, parts=parts)
            assert (found is not None) == noisy


def test_low_passed_records_of_a_sound_machine_miss_nothing(cart: Any) -> None:
    """The top of such a spectrum is empty: beside that, all that was measured was a gap."""
    found = verdict_on(cart, [filtered(cart.measured(cart.rig(k=820.0), n), 60.0) for n in (1, 2, 3)])
    assert found.verdict in ("none", "parameters")
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=2e-3)
    floor = found.evidence.campaign.floors["x"]
    assert not floor.is_sure
    assert floor.sigma == pytest.approx(NOISE * np.sqrt(2 * 60.0 / RATE), rel=0.3)


def test_friction_is_found_in_low_passed_records(carriage: Callable[..., Any]) -> None:
    cart = carriage(rate=RATE, duration=4.0, noise=NOISE)
    found = verdict_on(cart, [filtered(cart.measured(cart.rubbing(), n), 60.0) for n in (1, 2, 3)])
    assert [placed.label for placed in found.effects] == ["coulomb_friction at guide"]
    assert found.effects[0].values["f_c"] == pytest.approx(0.8, rel=0.05)


def test_noise_may_differ_by_record(cart: Any) -> None:
    """By one figure for all, the noisiest record is missed by six times its noise."""
    records = [noisier(cart.measured(cart.rig(k=820.0), n), times, n) for n, times in enumerate((1, 2, 6))]
    found = verdict_on(cart, records)
    assert found.verdict in ("none", "parameters")
    assert found.gap["x"].after == pytest.approx(found.gap["x"].floor, rel=0.05)


def test_steps_of_a_command_are_no_noise() -> None:
    rng = np.random.default_rng(4)
    time = np.arange(20000) / RATE
    command = np.sin(3 * time) + 5.0 * (time % 0.5 < 0.02) + 0.003 * rng.standard_normal(len(time))
    assert spectral_floor(command).sigma == pytest.approx(0.003, rel=0.05)
    noise = 0.003 * rng.standard_normal(len(time))
    assert spectral_floor(np.sin(3 * time) + noise).sigma == pytest.approx(0.003, rel=0.05)


def test_impacts_are_no_noise_however_often_and_evenly_they_come() -> None:
    """A speed that jumps at one in 30 samples, and rings for some of them, faster than they resolve."""
    rng, count = np.random.default_rng(4), 20000
    jumps = np.where(rng.uniform(size=count) < 0.03, rng.standard_normal(count), 0.0)
    rattle = lfilter([1.0], [1.0, -0.98], jumps) + lfilter([0.3], [1.0, 0.9, 0.3], jumps)
    noise = 0.003 * rng.standard_normal(count)
    assert 0.003 < spectral_floor(rattle + noise).sigma < 0.005
    drive = np.sin(3 * np.arange(count) / RATE)
    assert is_noise(noise, drive, RATE, 8)
    assert not is_noise(jumps + noise, drive, RATE, 8)


@pytest.mark.parametrize("share", [0.0, 0.4, 0.8])
def test_a_coarse_encoder_that_is_read_between_its_clock_is_no_quieter_at_rest(share: float) -> None:
    """It creeps by steps, and stands still for a share of the time; the logger interpolates."""
    rng, step = np.random.default_rng(4), 1.5e-3
    t = np.arange(0.0, 15.0, 0.02) + 2e-4 * rng.standard_normal(750)
    moved = np.where(np.sin(2 * np.pi * t / 3.0) > np.cos(np.pi * (1 - share)), 0.012, 0.0) * np.gradient(t)
    place = np.round(np.cumsum(moved) / step) * step + 1e-6 * rng.integers(-1, 2, len(t))
    even = np.arange(0.0, 14.9, 0.02006)
    assert spectral_floor(np.interp(even, t, place)).sigma > 0.2 * step / np.sqrt(12)


def test_white_noise_is_no_effect_however_little_was_stated(cart: Any) -> None:
    records = [noisier(cart.measured(cart.rig(k=820.0), n), 3.0, n) for n in (1, 2, 3)]
    found = verdict_on(cart, records, noise={"x": NOISE})
    assert found.verdict in ("none", "parameters")
    assert any("3 times" in note and "correct [noise]" in note for note in found.notes)


def test_what_repeats_tell_of_filtered_records_stays(cart: Any, tmp_path: Path) -> None:
    """And the fit's file is JSON, though a channel that no filter has cut has no band."""
    first = cart.measured(cart.rig(k=820.0), 1)
    again = noisier(first, np.sqrt(2.0), 9)
    for name, record in (("first", filtered(first, 60.0)), ("again", filtered(again, 60.0))):
        columns = np.column_stack([record.time, record.values["F"], record.values["x"]])
        np.savetxt(tmp_path / f"{name}.csv", columns, delimiter=",", header="t,F,x", comments="", fmt="%.9g")
    train = [{"file": "first.csv"}, {"file": "again.csv", "repeat_of": "first.csv"}]
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, train, base=tmp_path)
    found = ia.diagnose(campaign)
    assert campaign.floors["x"].source == found.evidence.campaign.floors["x"].source == "repeats"
    assert found.evidence.campaign.floors["x"].sigma == campaign.floors["x"].sigma
    sharp = Campaign(cart.rig(), CHANNELS, PRIORS, [{"record": first}])
    for each, band in ((sharp, None), (campaign, campaign.floors["x"].band)):
        ia.fit(each).to_json(tmp_path / "fit.json")
        told = json.loads((tmp_path / "fit.json").read_text(), parse_constant=pytest.fail)
        assert told["noise"]["x"]["band"] == band


@pytest.mark.parametrize("steps", [2e-6, 1e-4])
def test_a_filter_that_shows_in_one_record_is_that_of_the_channel(steps: float) -> None:
    """Steps of the sensor hide it where a machine moves little, and noise was thought 100 times too small."""
    rng, heard = np.random.default_rng(5), list[Heard]()
    for size in (1.0, 0.02):
        noise = Filter(cutoff=50.0).apply(100 * NOISE * rng.standard_normal(8000), RATE)
        time = np.arange(8000) / RATE
        measured = steps * np.round((size * np.sin(2 * np.pi * 3.0 * time) + noise) / steps)
        heard.append(Heard(noise, measured, [], spectral_floor(measured, RATE), RATE))
    assert [one.floor.is_filtered for one in heard] == [steps < 1e-5, False]
    floors = filtered_floors(heard)
    if steps < 1e-5:
        told = [floor.sigma / one.residual.std() for floor, one in zip(floors, heard, strict=True)]
        assert told == pytest.approx([1.0, 1.0], rel=0.15)
        assert not any(floor.is_sure for floor in floors)
        assert all(one.floor.sigma < 0.05 * one.residual.std() for one in heard)
    else:
        assert floors == [one.floor for one in heard]
