"""A link with play that hammers: chaos in quiet records, which a free run foresees but for a while."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import diagnose
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.horizon import fitted_to_loudest, foreseen
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.recast import Recast
from inertance.diagnosis.search.round import Round
from inertance.diagnosis.search.score_test import screen
from inertance.diagnosis.verdict.decide import explains
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

RATE, SECONDS, EPS, NOISE, LATE = 1000.0, 4.0, 1e-4, 2.0, 40.0
QUIET, LOUD = (2.5e-3, 2.75e-3), (0.02, 0.018)
TRUE = {"link.k": 1.9e5, "link.d": 23.0, "brake.d": 20.0, "body.m": 1.0}


def stand(play: float = 0.0, k: float = 2e5, d: float = 20.0) -> ia.Network:
    """Return a body that is moved through a stiff link, beside which the force is measured."""
    link = ia.ElastoBacklash(k=k, d=d, b=2 * play) if play else ia.SpringDamper(k=k, d=d)
    net = ia.Network("stand", drive=ia.Position(), link=link, body=ia.Mass(m=1.0), gauge=ia.ForceSensor())
    net.add(wall=ia.Fixed(), brake=ia.Damper(d=20.0))
    net.connect(net.drive.flange, net.gauge.flange_a).connect(net.gauge.flange_b, net.link.flange_a)
    net.connect(net.link.flange_b, net.body.flange, net.brake.flange_a)
    return net.connect(net.wall.flange, net.brake.flange_b)


def record(name: str, rms: float, seed: int, play: float = EPS) -> dict[str, Any]:
    """Return a record of the stand by a clock that is late.

    One integrator makes it, whatever was compiled before: chaos makes another record of each.
    """
    true = stand(play, k=TRUE["link.k"], d=TRUE["link.d"])
    shape = Multisine(rms=rms, low=0.5, high=15.0, period=SECONDS, seed=seed)
    moved = sampled(shape, stop=SECONDS, rate=RATE, fade=0.3)
    t = np.asarray(moved.time)
    exact: dict[str, Any] = {"solver": "compiled", "rtol": 1e-9, "atol": 1e-12}
    run = true.simulate(SECONDS, step=1 / RATE, inputs={"drive.s_ref": moved}, **exact)
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(t))
    values = {"x": np.asarray(moved.values), "F": run.at("gauge.f", t) + noise}
    return {"record": Record(name, t + LATE, values)}


def campaign(train: list[dict[str, Any]], test: list[dict[str, Any]]) -> Campaign:
    channels = {
        "x": {"input": "drive.s_ref", "unit": "m"},
        "F": {"output": "gauge.f", "unit": "N"},
    }
    priors = {"link.k": {"rel": 0.2}, "link.d": {"rel": 0.3}, "brake.d": {"rel": 0.3}, "body.m": {"rel": 0.1}}
    return Campaign(stand(), channels, priors, train, test, noise={"F": NOISE})


@pytest.fixture(scope="module")
def known() -> Campaign:
    """Return records of which a quiet one comes first."""
    train = [record("quiet 1", QUIET[0], 1), record("loud 1", LOUD[0], 0)]
    return campaign(train, [record("quiet 2", QUIET[1], 3), record("loud 2", LOUD[1], 2)])


@pytest.fixture(scope="module")
def study(known: Campaign) -> Study:
    return Study(known, Accuracy(foreseen=10**6))


def first_round(study: Study) -> Round:
    """Return a first round in which play was fitted to all records."""
    base = JointFit(study, study.campaign.start).fitted()
    candidates = screen(study, base.parameters, near=base)
    play = next(c for c in candidates if c.label == "backlash at link")
    placed = Hypothesis(play.effect, play.site, "backlash_1", play.values)
    return Round(base, candidates, [JointFit(study, base.parameters, [placed], base).fitted()])


@pytest.fixture(scope="module")
def done(study: Study) -> Round:
    return first_round(study)


@pytest.fixture(scope="module")
def loudest(study: Study, done: Round) -> Refit:
    found = fitted_to_loudest(study, done)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def short(study: Study, done: Round, loudest: Refit) -> Recast:
    found = foreseen(study, done.base, done.base, loudest)
    assert found is not None
    return found


def test_a_fit_to_all_records_ends_on_the_way(done: Round) -> None:
    assert done.fitted[0].misfit > 2.0


def test_the_loudest_record_leads_to_the_play_that_is_there(loudest: Refit) -> None:
    assert loudest.effects[0].values["eps"] == pytest.approx(EPS, rel=0.01)
    for name, value in TRUE.items():
        assert loudest.parameters[name] == pytest.approx(value, rel=0.03), name


def test_quiet_records_are_compared_as_far_as_they_can_be_foreseen(study: Study, short: Recast) -> None:
    pairs = zip(study.campaign.experiments, short.study.campaign.experiments, strict=True)
    for whole, part in pairs:
        lasts = np.ptp(part.compared.time)
        if whole.name.startswith("loud"):
            assert part is whole
        else:
            assert 0.1 < lasts < 0.6 * SECONDS
            assert part.compared.time[0] == LATE
            assert part.initial == whole.initial
            assert f"{whole.name} {lasts:.3g} s" in short.told
    assert explains(short.model, short.base, short.study)
    assert short.model.misfit < 1.1


def test_what_is_left_out_hangs_on_what_nobody_knows(study: Study, loudest: Refit, short: Recast) -> None:
    """A hundredth of a percent more stiffness moves nothing that is compared, and a quiet record by a lot."""
    stiffer = {**loudest.parameters, "link.k": 1.0001 * loudest.parameters["link.k"]}
    joint, other = (JointFit(study, given, loudest.effects) for given in (loudest.parameters, stiffer))
    later = []
    for whole, part in zip(study.campaign.experiments, short.study.campaign.experiments, strict=True):
        one, two = (each.run_on(whole).seen["F"] for each in (joint, other))
        apart, count = np.abs(one - two), len(part.compared.time)
        assert apart[:count].max() < 0.1 * np.ptp(one), whole.name
        later.append(apart[count:].max(initial=0.0) / np.ptp(one))
    assert max(later) > 0.3


def test_what_can_be_foreseen_to_its_end_is_left_whole(study: Study, done: Round) -> None:
    assert foreseen(study, done.base, done.base, done.base) is None


def test_play_that_came_near_nothing_is_not_fitted_again(study: Study, done: Round) -> None:
    (play,) = done.fitted
    better = replace(
        play, effects=(replace(play.effects[0], effect=screened_across(done)),), cost=0.1 * play.cost
    )
    far = replace(play, cost=0.9 * done.base.cost)
    assert fitted_to_loudest(study, Round(done.base, done.candidates, [better, far])) is None
    assert fitted_to_loudest(study, Round(done.base, done.candidates, [])) is None


def screened_across(done: Round) -> Any:
    return next(c.effect for c in done.candidates if c.effect.place == "across")


def test_its_play_is_named_and_why_records_are_cut_is_told(known: Campaign) -> None:
    told: list[str] = []
    verdict = diagnose(known, report=told.append)
    assert verdict.verdict == "effect"
    assert [placed.label for placed in verdict.effects] == ["backlash at link"]
    assert verdict.effects[0].values["eps"] == pytest.approx(EPS, rel=0.02)
    assert verdict.closed > 0.95
    assert "fitting backlash at link to the loudest record alone" in told
    assert any("quiet 1" in note and "foresee" in note for note in verdict.notes)
    assert len({*told}) > 5
    assert all(one != other for one, other in pairwise(told))
