"""Openings of records that grow lead to values that fits of whole records do not come to."""

from dataclasses import replace
from math import inf

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import FitStart, JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.openings import led_by_openings
from inertance.diagnosis.search.score_test import Candidate, screen
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

from .test_followed import RIPPLE, assert_true, campaign, record

RATE, SECONDS = 500.0, 6.0
PLAY, LINK = 3e-3, {"k": 4100.0, "d": 4.5}


def screened(study: Study, label: str) -> tuple[Refit, Candidate]:
    """Return the fit without the effect, and what screening tells of it."""
    base = JointFit(study, study.campaign.start).fitted()
    return base, next(c for c in screen(study, base.parameters, near=base) if c.label == label)


def fitted(study: Study, base: Refit, candidate: Candidate, starts: list[FitStart]) -> tuple[Refit, Refit]:
    """Return fits of an effect from starts alone, and from where openings lead as well."""
    placed = Hypothesis(candidate.effect, candidate.site, f"{candidate.effect.kind}_1", candidate.values)
    led = led_by_openings(study, [placed], base, starts)
    assert led is not None
    alone = JointFit(study, base.parameters, [placed], base).fitted(starts)
    return alone, JointFit(study, base.parameters, [placed], base).fitted([*starts, led.values])


@pytest.mark.parametrize(("share", "stretch"), [(0.1, 0.9), (1.0, 0.95), (0.3, 1.1)])
def test_ripple_is_found_from_values_that_are_far_off(share: float, stretch: float) -> None:
    records = [record(f"r{seed}", seed) for seed in range(10, 14)]
    study = Study(campaign(records[:3], records[3:]), Accuracy(foreseen=10**6))
    base, candidate = screened(study, "position_ripple at spring")
    begin = {name: share * value for name, value in RIPPLE.items()} | {"period": stretch * RIPPLE["period"]}
    alone, found = fitted(study, base, candidate, [(base.parameters, begin)])
    assert alone.misfit > 1.3
    assert found.misfit < 1.1
    assert_true(found)


def test_ripple_is_found_in_records_begun_in_motion_of_other_lengths_and_with_a_gap() -> None:
    train = [record(f"r{seed}", seed, begin=1.3 * (seed - 9), initial="fit") for seed in (10, 11, 12)]
    study = Study(campaign(train, [record("r13", 13, initial="fit")], "x", "v"), Accuracy(foreseen=10**6))
    first, *others = study.campaign.training
    gap = np.arange(len(first.compared.time)) % 97 < 20
    study = replace(study, campaign=study.campaign.with_records([first.omitting(gap), *others]))
    base, candidate = screened(study, "position_ripple at spring")
    begin = {name: 0.1 * value for name, value in RIPPLE.items()} | {"period": 1.05 * RIPPLE["period"]}
    _, found = fitted(study, base, candidate, [(base.parameters, begin)])
    assert found.misfit < 1.15
    assert_true(found)


@pytest.mark.parametrize(("load", "initial"), [(0.0, "rest"), (20.0, "fit")])
def test_ripple_is_found_in_records_whose_force_stands_still_at_first(load: float, initial: str) -> None:
    """Without a load the body rests; under one it swings to where it rests before the force moves."""
    times = ((10, 4.0), (11, 2.3), (12, 0.0), (13, 3.0))
    records = [record(f"r{s}", s, held=seconds, load=load, initial=initial) for s, seconds in times]
    study = Study(campaign(records[:3], records[3:]), Accuracy(foreseen=10**6))
    base, candidate = screened(study, "position_ripple at spring")
    begin = {name: 0.1 * value for name, value in RIPPLE.items()} | {"period": 0.9 * RIPPLE["period"]}
    alone, found = fitted(study, base, candidate, [(base.parameters, begin)])
    assert alone.misfit > 1.3
    assert found.misfit < 1.1
    assert_true(found)


def held(k: float = 4000.0, d: float = 5.0, play: float = 0.0) -> ia.Network:
    """Return a driven body on a spring, held by a second one beside it that may have play."""
    link = ia.RelaxingBacklash(k=k, d=d, b=play, d_0=0.02 * d) if play else ia.SpringDamper(k=k, d=d)
    net = ia.Network("held", drive=ia.Force(), body=ia.Mass(m=1.0), spring=ia.SpringDamper(k=1500.0, d=6.0))
    net.add(wall=ia.Fixed(), link=link)
    net.connect(net.drive.flange, net.body.flange, net.spring.flange_b, net.link.flange_b)
    net.connect(net.wall.flange, net.spring.flange_a, net.link.flange_a)
    return net


def held_record(name: str, seed: int) -> dict[str, Record]:
    """Return a record of the body whose link has play."""
    shape = Multisine(rms=30.0, low=0.5, high=12.0, period=SECONDS, seed=seed)
    push = sampled(shape, stop=SECONDS, rate=RATE, fade=0.3)
    t = np.asarray(push.time)
    run = held(**LINK, play=2 * PLAY).simulate(SECONDS, step=1 / RATE, inputs={"drive.f": push}, rtol=1e-9)
    x, noise = run.at("body.s", t), np.random.default_rng(seed).standard_normal(len(t))
    return {"record": Record(name, t, {"u": np.asarray(push.values), "x": x + 0.002 * x.std() * noise})}


def test_play_is_found_from_a_fortieth_of_it() -> None:
    channels = {"u": {"input": "drive.f", "unit": "N"}, "x": {"output": "body.s", "unit": "m"}}
    records = [held_record(f"r{seed}", seed) for seed in range(4)]
    priors = {"link.k": {"rel": 0.2}, "link.d": {"rel": 0.3}, "spring.k": {"rel": 0.2}}
    study = Study(Campaign(held(), channels, priors, records[:3], records[3:]), Accuracy(foreseen=10**6))
    base, candidate = screened(study, "backlash at link")
    placed = Hypothesis(candidate.effect, candidate.site, "backlash_1", candidate.values)
    led = led_by_openings(study, [placed], base, [(base.parameters, {"eps": PLAY / 40})])
    assert led is not None
    parameters, values = led.values
    assert values["eps"] == pytest.approx(PLAY, rel=0.05)
    assert parameters["link.k"] == pytest.approx(LINK["k"], rel=0.05)


def test_no_opening_is_fitted_where_the_model_without_the_effect_follows_or_no_time_is_left() -> None:
    records = [record(f"r{seed}", seed) for seed in range(10, 12)]
    study = Study(campaign(records[:1], records[1:]), Accuracy(foreseen=10**6))
    base, candidate = screened(study, "position_ripple at spring")
    placed = Hypothesis(candidate.effect, candidate.site, "position_ripple_1", RIPPLE)
    starts: list[FitStart] = [(base.parameters, RIPPLE)]
    led = led_by_openings(study, [placed], base, starts)
    assert led is not None
    right = JointFit(study, base.parameters, [placed], base).fitted([led.values])
    assert led_by_openings(study, [placed], replace(base, train=right.train), starts) is None
    assert led_by_openings(replace(study, deadline=-inf), [placed], base, starts) is None
