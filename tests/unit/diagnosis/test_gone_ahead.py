"""Two effects of which neither does clearly better alone, found by what the fitted records tell."""

from collections.abc import Callable, Iterable
from types import SimpleNamespace
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import Verdict, diagnose
from inertance.diagnosis.search import ahead
from inertance.identification import Campaign, Multisine, Record, sampled

RATE, DURATION, NOISE, WIDTH = 125.0, 4.0, 2e-5, 1.5
LOUD, SOFT = {"rms": 5.0, "low": 0.5, "high": 8.0}, {"rms": 2.5, "low": 1.0, "high": 2.0}


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(RATE, DURATION, NOISE)


def recorded(truth: ia.Network, shape: dict[str, float], seed: int) -> Record:
    """Return a record of a machine whose drive does nothing with less than WIDTH."""
    drive = sampled(Multisine(**shape, period=DURATION, seed=seed), DURATION, RATE, fade=0.5)
    played = ia.Sampled(drive.time, drive.values - np.clip(drive.values, -WIDTH, WIDTH))
    run = truth.simulate(DURATION, inputs={"push.f": played}, step=1 / RATE, rtol=1e-8, atol=1e-11)
    x = run["carriage.s"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(x))
    return Record(f"run {seed}", drive.time, {"F": drive.values, "x": x + noise})


def verdict_on(cart: Any, told: list[str]) -> Verdict:
    truth = cart.rig(k=830.0, d=5.0)
    truth.add(rail=ia.CubicSpring(k=0.0, k3=4e6)).connect(truth.wall.flange, truth.rail.flange_a)
    truth.connect(truth.rail.flange_b, truth.carriage.flange)
    records = [recorded(truth, shape, seed) for seed, shape in enumerate((LOUD, LOUD, SOFT), start=1)]
    campaign = Campaign(
        cart.rig(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}},
        parameters={path: {"rel": 0.2} for path in ("spring.k", "guide.d")},
        train=[{"record": record, "initial": "rest"} for record in records[:2]],
        test=[{"record": records[2], "initial": "rest"}],
        noise={"x": NOISE},
    )
    return diagnose(campaign, report=told.append)


def test_both_are_named_though_either_alone_says_nothing_of_the_test_record(cart: Any) -> None:
    told: list[str] = []
    found = verdict_on(cart, told)
    assert any("going on from cubic_stiffness" in line for line in told)
    assert found.verdict == "effect"
    assert {effect.label for effect in found.effects} == {
        "cubic_stiffness at guide",
        "actuator_dead_zone at F",
    }
    assert found.closed is not None
    assert found.closed > 0.99


def model(cost: float, *effects: str) -> Any:
    return SimpleNamespace(cost=cost, effects=effects)


def names(begun: Iterable[Any]) -> list[str]:
    return [found.effects[0] for found in begun]


def test_the_nearest_to_the_fitted_records_come_first_and_likenesses_once() -> None:
    base = model(100.0)
    fitted = [model(79.0, "late"), model(90.0, "poor"), model(40.0, "near"), model(41.0, "alike")]
    first: Any = SimpleNamespace(base=base, fitted=fitted)
    assert names(ahead._beginnings(first, base)) == ["near", "late"]


def test_what_the_search_went_on_from_is_not_tried_again() -> None:
    best = model(40.0, "near")
    first: Any = SimpleNamespace(base=model(100.0), fitted=[best, model(41.0, "alike"), model(70.0, "other")])
    assert names(ahead._beginnings(first, best)) == ["other"]


def test_no_more_is_begun_than_is_granted() -> None:
    first: Any = SimpleNamespace(base=model(100.0), fitted=[model(cost, "x") for cost in (10.0, 20.0, 30.0)])
    assert len(list(ahead._beginnings(first, first.base))) == 2


@pytest.mark.parametrize(("suffices", "begun"), [("first", ["first"]), ("second", ["first", "second"])])
def test_the_second_beginning_is_tried_where_what_the_first_leads_to_does_not_suffice(
    suffices: str, begun: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    base, told = model(100.0), list[str]()
    first = SimpleNamespace(base=base, fitted=[model(10.0, "first"), model(50.0, "second")])
    for one in first.fitted:
        one.labels = one.effects

    def round_from(_: Any, at: Any, rounds: list[Any]) -> Any:
        told.append(at.effects[0])
        rounds.append(SimpleNamespace(candidates=[], fitted=[model(1.0, at.effects[0], "other")]))
        return rounds[-1]

    monkeypatch.setattr(ahead, "run_round", round_from)
    monkeypatch.setattr(ahead, "taken", lambda done, _: done.fitted[0])
    monkeypatch.setattr(ahead, "is_clear", lambda *_: True)
    study: Any = SimpleNamespace(late=lambda: False, tell=lambda _: None)
    rounds: list[Any] = [first]
    asked: Any = lambda chosen: chosen.effects[0] == suffices  # noqa: E731
    found: Any = ahead.gone_ahead(study, rounds, base, base, asked)
    assert names(found) == [suffices, suffices]
    assert told == begun
    assert len(rounds) == 2
