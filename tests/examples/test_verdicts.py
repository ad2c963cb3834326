"""examples/verdicts.py: each case has the verdict it is there for."""

from typing import Any

import numpy as np
import pytest

EXAMPLE = "verdicts"


def test_there_is_a_case_for_each_verdict(example: Any) -> None:
    assert set(example.CASES) == {"none", "parameters", "effect", "ambiguous", "law", "unknown"}


@pytest.mark.parametrize("case", ["none", "parameters", "unknown"])
def test_verdicts_without_an_effect(example: Any, case: str) -> None:
    found = example.CASES[case]()
    assert found.verdict == case
    assert case == "unknown" or found.effects == ()


def test_a_stop_is_a_law_of_position(example: Any) -> None:
    found = example.CASES["law"]()
    assert found.verdict == "law"
    assert (found.law.site.path, found.law.variables) == ("guide", ("position",))
    pressed, free = found.law.grid.axes[0].basis(np.array([-0.014, 0.0])) @ found.law.values
    assert pressed == pytest.approx(-40.0, rel=0.15)  # 2 mm beyond where the stop begins
    assert abs(free) < 1.0


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
