"""examples/verdicts.py: each case has the verdict it is there for."""

import importlib.util
import sys
from pathlib import Path
from typing import Any

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "verdicts.py"


def load_example() -> Any:
    spec = importlib.util.spec_from_file_location("verdicts", EXAMPLE)
    assert spec
    assert spec.loader
    module = sys.modules["verdicts"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


verdicts = load_example()


def test_there_is_a_case_for_each_verdict() -> None:
    assert set(verdicts.CASES) == {"none", "parameters", "effect", "ambiguous", "unknown"}


@pytest.mark.parametrize("case", ["none", "parameters", "unknown"])
def test_verdicts_without_an_effect(case: str) -> None:
    found = verdicts.CASES[case]()
    assert found.verdict == case
    assert case == "unknown" or found.effects == ()


def test_friction_is_named() -> None:
    found = verdicts.CASES["effect"]()
    assert found.verdict == "effect"
    assert [(p.effect.kind, p.site.path) for p in found.effects] == [("coulomb_friction", "guide")]
    assert found.effects[0].values["f_c"] == pytest.approx(0.8, rel=0.02)


def test_what_a_force_alone_cannot_tell_is_a_class() -> None:
    found = verdicts.CASES["ambiguous"]()
    assert found.verdict == "ambiguous"
    members = {(p.effect.kind, p.site.path) for p in found.effects} | set(found.equivalent)
    assert members == {("added_inertia", "carriage"), ("sensor_gain", "s")}
    assert "measure another quantity" in found.next_experiment
