"""A guide with ripple, in whose valleys a run parts from the machine for a while: the rest is fitted."""

from dataclasses import replace
from math import inf
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import diagnose
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.followed import fitted_to_followed
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.score_test import screen
from inertance.diagnosis.verdict.cautions import cautions
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

RATE, SECONDS, RMS, LATE = 500.0, 6.0, 12.0, 40.0
RIPPLE = {"f_sin": 6.0, "f_cos": 1.8, "period": 6e-3}
TRUE = {"spring.k": 2100.0, "spring.d": 18.0}
PRIORS = {"spring.k": {"rel": 0.1}, "spring.d": {"rel": 0.3}}


def stand(k: float = 2000.0, d: float = 20.0, **ripple: float) -> ia.Network:
    """Return a body on a spring that a force drives, its guide with ripple."""
    net = ia.Network("stand", drive=ia.Force(), body=ia.Mass(m=1.0), spring=ia.SpringDamper(k=k, d=d))
    net.add(wall=ia.Fixed())
    net.connect(net.drive.flange, net.body.flange, net.spring.flange_b)
    net.connect(net.wall.flange, net.spring.flange_a)
    if ripple:
        net.add(guide=ia.Ripple(**ripple))
        net.connect(net.wall.flange, net.guide.flange_a).connect(net.body.flange, net.guide.flange_b)
    return net


def record(
    name: str, seed: int, begin: float = 0.0, held: float = 0.0, load: float = 0.0, **given: Any
) -> dict[str, Any]:
    """Return a record of the stand by a clock that is late, from a time after its run began.

    The force stands still for the time `held` first, at the `load` on which it moves then.
    """
    true = stand(TRUE["spring.k"], TRUE["spring.d"], **RIPPLE)
    shape = Multisine(rms=RMS, low=0.5, high=10.0, period=SECONDS, seed=seed)
    push = sampled(shape, stop=SECONDS, rate=RATE, fade=0.3)
    u = load + np.concatenate([np.zeros(round(held * RATE)), push.values])
    t = np.arange(len(u)) / RATE
    driven = {"drive.f": ia.Sampled(t, u)}
    run = true.simulate(t[-1], step=1 / RATE, inputs=driven, rtol=1e-9, atol=1e-12)
    x, v = run.at("body.s", t), run.at("body.v", t)
    noise = np.random.default_rng(seed).standard_normal((2, len(t)))
    values = {"u": u, "x": x + 0.01 * x.std() * noise[0]}
    values["v"] = v + 0.01 * v.std() * noise[1]
    later = t >= begin
    return {"record": Record(name, t[later] + LATE, {n: c[later] for n, c in values.items()}), **given}


def campaign(train: list[dict[str, Any]], test: list[dict[str, Any]], *outputs: str) -> Campaign:
    units = {"x": {"output": "body.s", "unit": "m"}, "v": {"output": "body.v", "unit": "m/s"}}
    channels = {"u": {"input": "drive.f", "unit": "N"}, **{n: units[n] for n in outputs or ("x",)}}
    return Campaign(stand(), channels, PRIORS, train, test)


@pytest.fixture(scope="module")
def records() -> list[dict[str, Any]]:
    return [record(f"r{seed}", seed) for seed in range(10, 14)]


@pytest.fixture(scope="module")
def study(records: list[dict[str, Any]]) -> Study:
    return Study(campaign(records[:3], records[3:]), Accuracy(foreseen=10**6))


def begun(study: Study, share: float, stretch: float) -> Refit:
    """Return a model with ripple, fitted from values that are off."""
    base = JointFit(study, study.campaign.start).fitted()
    candidates = screen(study, base.parameters, near=base)
    ripple = next(c for c in candidates if c.label == "position_ripple at spring")
    values = RIPPLE | {"f_sin": share * RIPPLE["f_sin"], "period": stretch * RIPPLE["period"]}
    placed = Hypothesis(ripple.effect, ripple.site, "position_ripple_1", values)
    return JointFit(study, base.parameters, [placed], base).fitted()


@pytest.fixture(scope="module")
def lost(study: Study) -> Refit:
    return begun(study, 1.1, 0.98)


def assert_true(found: Refit) -> None:
    for name, value in RIPPLE.items():
        assert found.effects[0].values[name] == pytest.approx(value, rel=0.02), name
    for name, value in TRUE.items():
        assert found.parameters[name] == pytest.approx(value, rel=0.02), name


def test_a_model_that_is_lost_in_stretches_is_fitted_to_the_others(study: Study, lost: Refit) -> None:
    assert lost.misfit > 1.5
    found = fitted_to_followed(study, lost)
    assert found.misfit < 1.1
    assert_true(found)


def test_a_model_that_follows_all_or_for_which_no_time_is_left_stays(study: Study, lost: Refit) -> None:
    found = fitted_to_followed(study, lost)
    assert fitted_to_followed(study, found) is found
    assert fitted_to_followed(replace(study, deadline=-inf), lost) is lost


def test_records_begun_in_motion_with_two_outputs_are_followed() -> None:
    train = [record(f"r{seed}", seed, begin=1.3, initial="fit") for seed in (10, 11, 12)]
    test = [record("r13", 13, begin=0.7, initial="fit")]
    study = Study(campaign(train, test, "x", "v"), Accuracy(foreseen=10**6))
    found = fitted_to_followed(study, begun(study, 1.1, 0.98))
    assert found.misfit < 1.1
    assert_true(found)


def test_a_record_that_something_disturbed_is_told_and_pulls_nothing(records: list[dict[str, Any]]) -> None:
    struck = record("struck", 12)
    after = (struck["record"].time > LATE + 1.0) & (struck["record"].time < LATE + 2.5)
    struck["record"].values["x"][after] += 2e-3
    study = Study(campaign([*records[:2], struck], records[3:]), Accuracy(foreseen=10**6))
    found = fitted_to_followed(study, begun(study, 1.05, 1.0))
    assert_true(found)
    told = [caution for caution in cautions(study.campaign, found) if "follows other" in caution]
    assert len(told) == 1
    assert "struck (" in told[0]


def test_ripple_that_holds_a_body_in_its_valleys_is_named(study: Study) -> None:
    verdict = diagnose(study.campaign)
    assert verdict.verdict == "effect"
    assert [placed.label for placed in verdict.effects] == ["position_ripple at spring"]
    assert verdict.effects[0].values["period"] == pytest.approx(RIPPLE["period"], rel=0.01)
