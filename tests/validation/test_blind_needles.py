"""The needles of the blind benchmark: which cases there are, what acts in them, what counts as named."""

from __future__ import annotations

import importlib
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

BLIND = Path(__file__).parents[2] / "benchmarks" / "blind"


@pytest.fixture(scope="module")
def blind() -> Any:
    """The modules of the benchmark, which are no package."""
    sys.path.insert(0, str(BLIND))
    try:
        found = {name: importlib.import_module(f"needles.{name}") for name in ("case", "plan", "score")}
        yield SimpleNamespace(**found, measures=importlib.import_module("measures"))
    finally:
        sys.path.remove(str(BLIND))


def test_every_three_cases_are_one_of_each_kind(blind: Any) -> None:
    drafts = blind.plan.drafts(9, 3)
    for begin in range(0, 9, 3):
        assert Counter(d.kind for d in drafts[begin : begin + 3]) == Counter([*blind.plan.KINDS])
    assert drafts[:4] == blind.plan.drafts(4, 3)


def test_play_carries_beyond_its_gap_and_only_presses(blind: Any) -> None:
    torque = blind.case._contact({"coupling.c": 100.0, "coupling.d": 2.0}, 0.1)
    s, v = np.array([-0.2, -0.1, 0.05, 0.15, 0.15]), np.array([0.0, 0.0, 3.0, 0.0, -9.0])
    assert torque(0.0, s, v) == pytest.approx([-10.0, 0.0, 0.0, 5.0, 0.0])


def test_only_the_effect_at_its_site_is_named(blind: Any) -> None:
    label = {"kind": "valleys", "kinds": ["position_ripple", "harmonic_ripple"], "sites": ["rail", "block"]}

    def case(word: str, *named: tuple[str, str], **more: Any) -> Any:
        effects = [{"kind": kind, "site": site} for kind, site in named]
        return blind.measures.Scored(label, {"verdict": word, "effects": effects, **more})

    right = ("position_ripple", "block")
    assert blind.score.named(case("effect", right))
    assert blind.score.named(case("ambiguous", ("harmonic_ripple", "rail")))
    assert not blind.score.named(case("partial", right))
    assert not blind.score.named(case("effect", ("position_ripple", "other")))
    assert not blind.score.named(case("effect", right, ("backlash", "block")))
    assert blind.score.drawn(case("law", law={"site": "rail"}))
