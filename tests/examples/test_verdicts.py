"""examples/verdicts.py: each case has the verdict it is there for."""

from typing import Any

import pytest

EXAMPLE = "verdicts"


def test_there_is_a_case_for_each_verdict(example: Any) -> None:
    assert set(example.CASES) == {"none", "parameters", "effect", "ambiguous", "unknown"}


@pytest.mark.parametrize("case", ["none", "parameters", "unknown"])
def test_verdicts_without_an_effect(example: Any, case: str) -> None:
    found = example.CASES[case]()
    assert found.verdict == case
    assert case == "unknown" or found.effects == ()


def test_friction_is_named(example: Any) -> None:
    found = example.CASES["effect"]()
    assert found.verdict == "effect"
    assert [(p.effect.kind, p.site.path) for p in found.effects] == [("coulomb_friction", "guide")]
    assert found.effects[0].values["f_c"] == pytest.approx(0.8, rel=0.02)


def test_what_a_force_alone_cannot_tell_is_a_class(example: Any) -> None:
    found = example.CASES["ambiguous"]()
    assert found.verdict == "ambiguous"
    members = {(p.effect.kind, p.site.path) for p in found.effects} | set(found.equivalent)
    assert members == {("added_inertia", "carriage"), ("sensor_gain", "s")}
    assert "measure another quantity" in found.next_experiment
