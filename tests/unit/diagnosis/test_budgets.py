"""A budget that ends in the midst of a diagnosis: less is known, and nothing that is not so is told."""

from collections.abc import Callable
from functools import cache
from itertools import count
from typing import Any

import inertance as ia
import pytest
from inertance.diagnosis import Verdict
from inertance.diagnosis.models.study import Study
from inertance.identification import Campaign

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PRIORS = {"spring.k": {"rel": 0.2}, "guide.d": {"rel": 0.3}}
NOISE = 1e-5
LOOKS = (0, 1, 3, 8, 16)  # at the clock, before the time has passed
TRUTHS: dict[str, Callable[[Any], ia.Network]] = {
    "null": lambda cart: cart.rig(),
    "friction": lambda cart: cart.rubbing(),
    "parameters": lambda cart: cart.rig(k=1040.0, d=7.8),
}
TRUE_WORDS = {
    "null": ("none", "parameters"),
    "friction": ("effect", "ambiguous", "partial"),
    "parameters": ("parameters",),
}


@pytest.fixture(scope="module")
def campaign(carriage: Callable[..., Any]) -> Callable[[str], Campaign]:
    cart = carriage(rate=200.0, duration=6.0, noise=NOISE)

    @cache
    def of(truth: str) -> Campaign:
        *train, test = [
            {"record": cart.measured(TRUTHS[truth](cart), seed), "initial": "rest"} for seed in (1, 2, 3)
        ]
        return Campaign(cart.rig(), CHANNELS, PRIORS, train, [test], noise={"x": NOISE})

    return of


def told(found: Verdict) -> str:
    effects = ", ".join(placed.label for placed in found.effects)
    return f"{found.verdict}: {effects or found.sentence} ({'; '.join(found.notes)})"


@pytest.mark.parametrize("truth", TRUTHS)
@pytest.mark.parametrize("looks", LOOKS)
def test_a_short_time_makes_no_wrong_verdict(
    campaign: Callable[[str], Campaign], truth: str, looks: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    left = count(looks, -1)
    monkeypatch.setattr(Study, "late", lambda study: next(left) <= 0)
    found = ia.diagnose(campaign(truth), budget=600.0)
    late = any("budget of" in note for note in found.notes)
    assert found.verdict in (*TRUE_WORDS[truth], *["interrupted"] * late), told(found)
    assert "none of the known effects" not in found.sentence
    kinds = [placed.effect.kind for placed in found.effects]
    assert all(truth == "friction" and kind.endswith("friction") for kind in kinds), told(found)
