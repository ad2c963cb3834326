"""A table whose inerter has play between stiff flanks, which ring above what is compared."""

import pickle
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.base import Array
from inertance.diagnosis import diagnose
from inertance.diagnosis.criteria import LOW_PASS_RATE_SHARE
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.low_pass import behind_low_passes, low_passed
from inertance.diagnosis.models.study import Study, thinned
from inertance.diagnosis.search.crew import _received, _sent
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.score_test import screen
from inertance.identification import Accuracy, Campaign, Experiment, Multisine, Record, sampled
from scipy.signal import butter, firwin, lsim

RATE, FINE, SECONDS, NOISE, LATE = 1000, 10, 5.0, 0.03, 3.0
EPS, FLANK, LOSS = 4e-6, 5e7, 1e4  # m, N/m, N.s/m
TRUE = {"spring.k": 5.4e4, "guide.d": 800.0}
MODEL = """
import inertance as ia

def table():
    net = ia.Network("table", wall=ia.Fixed(), spring=ia.Spring(k=6e4), guide=ia.Damper(d=900.0))
    net.add(inerter=ia.Inerter(b=150.0), table=ia.Mass(m=25.0), shaker=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a, net.inerter.flange_a)
    net.connect(
        net.table.flange, net.spring.flange_b, net.guide.flange_b, net.inerter.flange_b, net.shaker.flange
    )
    return net
"""
CHANNELS = {
    "u": {"input": "shaker.f", "unit": "N"},
    "s": {"output": "table.s", "unit": "m"},
    "a": {"output": "table.a", "unit": "m/s2"},
}
PRIORS = {"spring.k": {"rel": 0.2}, "guide.d": {"rel": 0.2}}


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("table") / "table.py"
    path.write_text(MODEL)
    return path


def table(k: float = 6e4, d: float = 900.0) -> ia.Network:
    scope: dict[str, Any] = {}
    exec(MODEL, scope)
    net: ia.Network = scope["table"]()
    return net.with_values(spring=ia.Spring(k=k), guide=ia.Damper(d=d))


def record(name: str, rms: float, seed: int, skipped: float = 0.0) -> dict[str, Any]:
    """Return what a logger with a filter writes of a table with play, in motion where time is skipped."""
    true = table(*TRUE.values())
    true.insert(true.inerter.flange_b, play=ia.RelaxingBacklash(k=FLANK, d=LOSS, b=2 * EPS, d_0=1.0))
    shape = Multisine(rms=rms, low=0.5, high=25.0, period=SECONDS, seed=seed)
    push = sampled(shape, stop=SECONDS, rate=RATE, fade=0.3)
    fine = np.linspace(0.0, SECONDS, round(SECONDS * RATE * FINE) + 1)
    run = true.simulate(SECONDS, step=1 / RATE / FINE, inputs={"shaker.f": push}, rtol=1e-8, atol=1e-11)
    taps = np.asarray(firwin(161, 400.0, fs=RATE * FINE), dtype=float)
    draw = np.random.default_rng(seed)

    def logged(path: str) -> Array:
        clean = np.convolve(np.pad(run.at(path, fine), 80, mode="edge"), taps, "valid")[::FINE]
        noise: Array = clean + NOISE * clean.std() * draw.standard_normal(len(clean))
        return noise

    values = {"u": np.asarray(push.values), "s": logged("table.s"), "a": logged("table.a")}
    kept = np.asarray(push.time) >= skipped
    late = np.asarray(push.time)[kept] + LATE
    found = Record(name, late, {channel: column[kept] for channel, column in values.items()})
    return {"record": found, "initial": "fit" if skipped else "rest"}


@pytest.fixture(scope="module")
def known(model: Path) -> Campaign:
    train = [record("loud", 600.0, 1), record("begun in motion", 400.0, 2, skipped=1.0)]
    return thinned(Campaign(f"{model}:table", CHANNELS, PRIORS, train, [record("other", 500.0, 3)]))


@pytest.fixture(scope="module")
def slow(known: Campaign) -> Campaign:
    found = low_passed(known)
    assert found is not None
    return found


def test_a_low_pass_in_the_model_is_that_of_the_record() -> None:
    """What it makes of a run is what its equations make of the signal, sample by sample, from rest."""
    channels = Campaign(table(), CHANNELS, PRIORS, [record("short", 100.0, 4)]).measured
    cutoff = 40.0
    wired, paths = behind_low_passes(table(), channels | {"a": replace(channels["a"], cutoff=cutoff)})
    assert paths[0] == "table.s"
    run = wired.simulate(1.0, inputs={"shaker.f": lambda t: 100.0}, step=1e-4, rtol=1e-9)
    t = np.linspace(0.0, 1.0, 10001)
    low: Any = butter(4, 2 * np.pi * cutoff, analog=True)
    expected = np.asarray(lsim(low, run.at("table.a", t), t)[1])
    assert run.at(paths[1], t) == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())


def test_what_may_ring_goes_through_a_low_pass_and_the_rest_does_not(known: Campaign, slow: Campaign) -> None:
    assert slow.measured["s"].cutoff == inf
    assert slow.measured["a"].cutoff == pytest.approx(LOW_PASS_RATE_SHARE * 250.0)
    for before, after in zip(known.experiments, slow.experiments, strict=True):
        assert np.array_equal(before.record.values["s"], after.record.values["s"])
        assert np.array_equal(before.record.values["u"], after.record.values["u"])
        assert after.record.values["a"].std() < before.record.values["a"].std()
        assert after.initial == before.initial
    assert slow.network is known.network


def test_the_noise_behind_a_low_pass_is_known(known: Campaign) -> None:
    """White noise of the size that the floor tells has the size behind it that the other floor tells."""
    draw = np.random.default_rng(5)
    floor = replace(known.training[0].floors["a"], sigma=0.2, band=inf)

    def noisy(e: Experiment) -> Experiment:
        white = 0.2 * draw.normal(size=len(e.record.time))
        record = replace(e.record, values={**e.record.values, "a": white})
        return replace(e, record=record, floors={**e.floors, "a": floor})

    found = low_passed(known.with_each(noisy))
    assert found is not None
    for experiment in found.experiments:
        values, floor = experiment.compared.values["a"], experiment.floors["a"]
        assert values[50:].std() == pytest.approx(floor.sigma, rel=0.06)
        weighed = experiment.weights["a"](values)
        assert np.sum(weighed**2) == pytest.approx(len(values) * experiment.weights["a"].share, rel=0.12)


def test_a_record_as_fast_as_what_is_compared_has_nothing_to_lose(known: Campaign) -> None:
    thin = [replace(e, record=e.compared, every=1) for e in known.experiments]
    assert low_passed(known.with_records(thin[:2], thin[2:])) is None


def test_where_only_motion_is_measured_nothing_rings(model: Path) -> None:
    channels = {name: CHANNELS[name] for name in ("u", "s")}
    campaign = thinned(Campaign(f"{model}:table", channels, PRIORS, [record("still", 100.0, 6)]))
    assert low_passed(campaign) is None


def test_other_processes_compare_what_is_compared_here(slow: Campaign) -> None:
    """Records that were cut, or are behind a low pass, are so wherever effects are fitted."""
    short = slow.with_records([slow.training[0].until(200), slow.training[1]])
    there = _received(_sent(short))
    for one, other in zip(short.experiments, there.experiments, strict=True):
        assert np.array_equal(one.compared.time, other.compared.time)
        assert all(
            np.array_equal(one.compared.values[n], other.compared.values[n]) for n in one.compared.values
        )
        assert one.floors == other.floors
    assert there.measured == short.measured
    assert pickle.loads(pickle.dumps(there.measured)) == short.measured
    here, far = (JointFit(Study(c, Accuracy()), c.start) for c in (short, there))
    assert here.seen(here.start).cost == pytest.approx(far.seen(far.start).cost, rel=1e-9)


def test_the_flanks_of_a_play_are_told_by_what_is_slow(slow: Campaign) -> None:
    study = Study(slow, Accuracy(foreseen=10**6))
    base = JointFit(study, slow.start).fitted()
    candidates = screen(study, base.parameters, near=base)
    play = next(c for c in candidates if c.label == "elastic_backlash at inerter")
    placed = Hypothesis(play.effect, play.site, "elastic_backlash_1", play.values)
    found = JointFit(study, base.parameters, [placed], base).fitted()
    assert found.misfit < 1.1
    assert found.effects[0].values["eps"] == pytest.approx(EPS, rel=0.1)
    assert 1 / found.effects[0].values["compliance"] == pytest.approx(FLANK, rel=0.2)


def test_flanks_that_yield_are_those_of_a_spring_where_there_is_one(slow: Campaign) -> None:
    study = Study(slow, Accuracy(foreseen=10**6))
    base = JointFit(study, slow.start).fitted()
    sites = {c.site.path for c in screen(study, base.parameters, near=base) if c.effect.unsprung}
    assert "inerter" in sites
    assert "spring" not in sites


def test_play_between_stiff_flanks_is_named_behind_a_low_pass(known: Campaign) -> None:
    verdict = diagnose(known)
    assert verdict.verdict == "effect"
    assert [placed.label for placed in verdict.effects] == ["elastic_backlash at inerter"]
    assert any("low pass of 62.5 Hz" in note for note in verdict.notes)
    assert verdict.effects[0].values["eps"] == pytest.approx(EPS, rel=0.1)
    assert 1 / verdict.effects[0].values["compliance"] == pytest.approx(FLANK, rel=0.2)
