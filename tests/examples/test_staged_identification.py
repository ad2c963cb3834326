"""examples/staged_identification.py: the paper's three stages find the machine that made the records."""

from typing import Any

import pytest

EXAMPLE = "staged_identification"


@pytest.fixture(scope="module")
def found(example: Any) -> Any:
    return example.study()


@pytest.mark.parametrize(
    ("stage", "name"),
    [
        (0, "inerter.screw.friction.tau_s"),
        (0, "inerter.screw.friction.d"),
        (1, "inerter.screw.k"),
        (1, "inerter.flywheel.m"),
        (2, "inerter.flywheel.T_pm"),
        (2, "inerter.flywheel.T_pv"),
    ],
)
def test_a_stage_finds_what_it_is_for(example: Any, found: Any, stage: int, name: str) -> None:
    group, key = example.EXPERIMENTS[stage].fitted[name]
    true, start = example.TRUTH[group][key], example.MODEL[group][key]
    value, error = found[stage].values[name], found[stage].errors[name]
    assert abs(value - true) < 3.5 * error
    assert abs(value - true) < 0.15 * abs(start - true)


@pytest.mark.parametrize("stage", [1, 2])
def test_the_force_is_met_down_to_its_noise(example: Any, found: Any, stage: int) -> None:
    record = found[stage].comparisons[0]
    assert record.rms("F", record.before) > 20 * example.NOISE
    assert record.rms("F", record.after) == pytest.approx(example.NOISE, rel=0.03)


@pytest.mark.parametrize(("stage", "name"), [(0, "screw.friction.tau_c"), (2, "flywheel.k_r")])
def test_what_an_experiment_cannot_tell_is_said(found: Any, stage: int, name: str) -> None:
    told = f"inerter.{name}: the records say next to nothing about it"
    assert any(warning.startswith(told) for warning in found[stage].warnings)


def test_what_moves_together_is_said(found: Any) -> None:
    told = "inerter.screw.k and inerter.flywheel.m move together"
    assert any(warning.startswith(told) for warning in found[1].warnings)
