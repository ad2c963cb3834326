"""What a delay needs from before a record or from after it is not compared: it would be a guess."""

from __future__ import annotations

from dataclasses import replace

import inertance as ia
import numpy as np
import pytest
from inertance.base import Array
from inertance.diagnosis.models.study import at_ends, thinned
from inertance.identification import Campaign, Record

from .test_standstills import TIME, strut

NOISE = 0.02


def stroke(seed: int, delay: float) -> Record:
    """Return a stroke that moves where it begins and ends, and a force that is late, or early."""
    rng = np.random.default_rng(seed)
    waves = rng.uniform(2.0, 40.0, 6), rng.uniform(0.0, 2 * np.pi, 6)

    def moved(t: Array, order: int) -> Array:
        w, phase = waves
        courses = w**order * np.sin(np.outer(t, w) + phase + order * np.pi / 2)
        return np.asarray(0.01 * courses.sum(axis=1))

    late = TIME - delay
    force = 2.1e3 * moved(late, 0) + 52.0 * moved(late, 1) + NOISE * rng.standard_normal(len(TIME))
    return Record(f"stroke {seed}", TIME, {"s": moved(TIME, 0), "F": -force})


def campaign(delay: float) -> Campaign:
    records = [{"record": stroke(seed, delay)} for seed in range(3)]
    channels = {"s": {"input": "drive.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}}
    priors = {"spring.k": {"rel": 0.1}, "damper.d": {"rel": 0.3}}
    return Campaign(strut(), channels, priors, records[:2], records[2:], noise={"F": NOISE})


@pytest.mark.parametrize("delay", [0.010, -0.010])
def test_a_late_sensor_and_a_late_drive_are_one_where_nothing_has_states(delay: float) -> None:
    found = ia.diagnose(campaign(delay))
    assert found.verdict == "ambiguous"
    first = found.effects[0]
    assert {first.key, *found.equivalent} == {("sensor_delay", "F"), ("actuator_delay", "s")}
    assert first.values["delay"] == pytest.approx(delay, rel=0.01)
    assert found.evidence.after.misfit == pytest.approx(1.0, abs=0.05)


def test_what_was_before_a_start_at_rest_is_known() -> None:
    moving = thinned(campaign(0.0)).training[0]
    assert moving.omitted is not None
    assert np.flatnonzero(moving.omitted).tolist() == [*range(10), *range(1990, 2000)]
    assert np.flatnonzero(at_ends(replace(moving, initial="rest"))).tolist() == [*range(1990, 2000)]


def test_what_is_let_go_is_compared_from_its_first_sample_on() -> None:
    """A struck part may come to rest within a two-hundredth of its record."""
    decay = np.exp(-TIME / 0.02) * np.cos(200 * TIME)
    record = Record("let go", TIME, {"s": np.sin(TIME), "F": 5.0 * decay})
    moving = replace(campaign(0.0).training[0], record=record)
    assert np.flatnonzero(at_ends(moving)).tolist() == [*range(1990, 2000)]
    steady = replace(record, values={**record.values, "F": np.cos(20 * TIME)})
    assert np.flatnonzero(at_ends(replace(moving, record=steady)))[0] == 0
