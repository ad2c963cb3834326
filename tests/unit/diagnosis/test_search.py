"""The verdict on a small rig whose cause is known: friction, wrong parameters, nothing, a slow sensor."""

import json
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import DiagnosisInterruptedError, Verdict, diagnose, investigation
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search import hearing
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit, best_of, clearness, is_clear
from inertance.diagnosis.search.round import run_round
from inertance.identification import Campaign
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
Sensor = Callable[[Array, Array], Array]

RATE, DURATION, NOISE = 125.0, 4.0, 2e-5


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    """Return the carriage whose records these are."""
    return carriage(RATE, DURATION, NOISE)


def verdict_on(cart: Any, truth: ia.Network, sensor: Sensor | None = None, **more: Any) -> Verdict:
    """Return the verdict on records of a truth, held against the nominal rig."""
    records = [cart.measured(truth, seed, sensor) for seed in (1, 2, 3)]
    campaign = Campaign(
        cart.rig(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}},
        parameters={path: {"rel": 0.1} for path in ("spring.k", "guide.d")},
        train=[{"record": record, "initial": "rest"} for record in records[:2]],
        test=[{"record": records[2], "initial": "rest"}],
        noise={"x": NOISE},
    )
    return diagnose(campaign, **more)


def test_a_fit_of_parameters_that_ended_early_makes_no_effect(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(JointFit, "fitted", _unfitted)
    told: list[str] = []
    found = verdict_on(cart, cart.rig(k=840.0, d=6.5), report=told.append)
    assert any("ended early" in line for line in told)
    assert (found.verdict, found.effects) == ("parameters", ())
    assert found.parameters["spring.k"] == pytest.approx(840.0, rel=1e-3)


def _unfitted(joint: JointFit, *given: Any, fitted: Any = JointFit.fitted) -> Any:
    """Return a fit that ends where it begins, unless the network has been fitted with an effect."""
    begun = joint.start if not joint.effects and (joint.start == 0).all() else None
    return joint.seen(begun) if begun is not None else fitted(joint, *given)


@pytest.mark.usefixtures("few_effects")
@pytest.mark.parametrize("line", ["screening", "fitted"])
def test_an_interrupted_diagnosis_states_no_verdict(cart: Any, tmp_path: Path, line: str) -> None:
    def interrupt(told: str) -> None:
        if told.startswith(line):
            raise KeyboardInterrupt

    with pytest.raises(DiagnosisInterruptedError) as interrupted:
        verdict_on(cart, cart.rubbing(), report=interrupt)
    found = interrupted.value.verdict
    assert found.verdict == "interrupted"
    assert found.effects == ()
    assert "stopped before its end" in found.sentence
    assert json.loads(found.save(tmp_path / "v.json").read_text())["verdict"] == "interrupted"
    page = ia.diagnosis.write_report(found, tmp_path / "v.html").read_text(encoding="utf-8")
    assert "Nothing yet: the diagnosis was stopped before its end" in page


@pytest.mark.usefixtures("few_effects")
@pytest.mark.parametrize("stopped", [True, False])
def test_an_effect_found_before_noise_was_heard_again_is_kept(
    cart: Any, monkeypatch: pytest.MonkeyPatch, stopped: bool
) -> None:
    """The search begins once more with other noise; broken off there, it tells what it had found."""
    hear = hearing.heard_beside

    def other_noise(study: Study, model: Refit) -> Study:
        campaign = study.campaign
        if not model.effects:
            return hear(study, model)
        if stopped:
            raise KeyboardInterrupt
        louder = [
            {name: replace(floor, sigma=2 * floor.sigma) for name, floor in experiment.floors.items()}
            for experiment in campaign.experiments
        ]
        return replace(study, campaign=campaign.with_floors(louder))

    def rounds(study: Any, best: Refit, done: Any, before: Any) -> Any:
        found = search_round(study, best, done, before)
        monkeypatch.setattr(type(study), "late", lambda _: len(begun) > 1)
        begun.append(best)
        return replace(found, fitted=[]) if len(begun) > 1 else found

    begun: list[Refit] = []
    search_round = run_round
    monkeypatch.setattr(investigation, "heard_beside", other_noise)
    monkeypatch.setattr(investigation, "run_round", rounds)
    if stopped:
        with pytest.raises(DiagnosisInterruptedError) as interrupted:
            verdict_on(cart, cart.rubbing())
        found = interrupted.value.verdict
    else:
        found = verdict_on(cart, cart.rubbing(), budget=600.0)
        assert len(begun) == 2
    assert [(p.effect.kind, p.site.path) for p in found.effects] == [("coulomb_friction", "guide")]


@pytest.mark.usefixtures("few_effects")
def test_a_search_begins_once_more_however_often_noise_turns_out_other(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def less_noise(study: Study, model: Refit) -> Study:
        if not model.effects:
            return study
        floors = [
            {name: replace(floor, sigma=0.7 * floor.sigma) for name, floor in experiment.floors.items()}
            for experiment in study.campaign.experiments
        ]
        return replace(study, campaign=study.campaign.with_floors(floors))

    def noted(study: Any, best: Refit, done: Any, before: Any) -> Any:
        beside.append(best.labels)
        return search_round(study, best, done, before)

    beside: list[list[str]] = []
    search_round = run_round
    monkeypatch.setattr(investigation, "heard_beside", less_noise)
    monkeypatch.setattr(investigation, "run_round", noted)
    found = verdict_on(cart, cart.rubbing())
    assert beside.count([]) == 2
    assert ("coulomb_friction", "guide") in [(p.effect.kind, p.site.path) for p in found.effects]


def test_missing_friction_is_named_and_corrected(cart: Any, tmp_path: Path) -> None:
    told: list[str] = []
    found = verdict_on(cart, cart.rubbing(), report=told.append)
    assert found.verdict == "effect"
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("coulomb_friction", "guide")
    assert placed.values["f_c"] == pytest.approx(0.8, rel=0.02)
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=5e-3)
    assert found.closed > 0.95
    assert found.confidence[0] > 0.9
    assert any("screening" in line for line in told)
    scope = {"net": cart.rig()}
    exec("from inertance import *", scope)
    exec("\n".join(found.lines), scope)
    push = {"push.f": lambda t: 5 * np.sin(9 * t)}
    same = scope["net"].simulate(1.0, inputs=push)
    assert found.corrected().simulate(1.0, inputs=push)["carriage.s"] == pytest.approx(same["carriage.s"])
    saved = json.loads(found.save(tmp_path / "gap.json").read_text())
    assert saved["effects"][0]["kind"] == "coulomb_friction"
    assert {"verdict", "equivalent", "next_experiment", "where", "ranking", "gap", "closed"} <= saved.keys()


MODEL = """
import inertance as ia

def build():
    net = ia.Network("rig", wall=ia.Fixed(), spring=ia.Spring(k=800.0), guide=ia.Damper(d=6.0),
                     carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)
"""
CAMPAIGN = """
model = "rig.py:build"
channels = { F = { input = "push.f", unit = "N" }, x = { output = "carriage.s", unit = "m" } }
parameters = { "spring.k" = { rel = 0.1 }, "guide.d" = { rel = 0.1 } }
train = [{ file = "run_1.npz", initial = "rest" }]
test = [{ file = "run_2.npz", initial = "rest" }]
noise = { x = 2e-5 }
"""


def test_other_processes_see_the_same_records(cart: Any, tmp_path: Path) -> None:
    for seed in (1, 2):
        record = cart.measured(cart.rubbing(), seed)
        time = np.arange(4 * len(record.time) - 3) / (4 * RATE)
        F, x = (np.interp(time, record.time, record.values[name]) for name in ("F", "x"))
        np.savez(tmp_path / f"run_{seed}.npz", time=time, F=F, x=x)
    (tmp_path / "rig.py").write_text(MODEL)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    alone = diagnose(Campaign.load(tmp_path / "campaign.toml"))
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        together = diagnose(Campaign.load(tmp_path / "campaign.toml"), executor=pool)
    assert together.gap["x"].after == pytest.approx(alone.gap["x"].after)
    assert [r.test_gain for r in together.ranking] == pytest.approx([r.test_gain for r in alone.ranking])


def test_wrong_parameters_are_no_effect(cart: Any) -> None:
    found = verdict_on(cart, cart.rig(k=980.0, d=9.0))
    assert found.verdict == "parameters"
    assert found.effects == ()
    assert found.parameters["spring.k"] == pytest.approx(980.0, rel=5e-3)


def test_nothing_is_missing(cart: Any) -> None:
    assert verdict_on(cart, cart.rig()).verdict == "none"


@pytest.mark.parametrize("delay", [0.006, -0.006])
def test_a_sensor_that_is_late_or_early(cart: Any, delay: float) -> None:
    """With one input and one output the same is an input that acts late."""
    found = verdict_on(cart, cart.rig(), lambda t, x: np.asarray(CubicSpline(t, x)(t - delay)))
    (placed,) = found.effects
    assert found.verdict == "ambiguous"
    assert {placed.key, *found.equivalent} == {("sensor_delay", "x"), ("actuator_delay", "F")}
    assert placed.values["delay"] == pytest.approx(delay, rel=0.05)
    assert found.closed > 0.95


def test_what_parameters_must_be_for_it_counts_against_a_model() -> None:
    """A gain that a stiffness far from what was assumed makes up for is as good on test records."""
    rng = np.random.default_rng(3)
    left, test = ([{"F": rng.standard_normal(4000)}] for _ in range(2))
    chi = float(left[0]["F"] @ left[0]["F"])

    def model(strain: float, missed: float) -> Refit:
        return Refit({}, (), left, [{"F": missed * test[0]["F"]}], chi + strain, [8], 4000.0)

    gain, delay = model(57.0, 1.0), model(0.5, 1.0005)
    assert gain.strain == pytest.approx(57.0)
    assert best_of([gain, delay]) is delay
    assert best_of([gain, model(0.5, 1.05)]) is gain


def test_what_leaves_less_than_half_need_not_do_better_on_most_stretches() -> None:
    """Of two effects, one alone mends where it acts, and parameters that follow spoil a little elsewhere."""
    rng = np.random.default_rng(1)

    def model(*parts: NDArray[np.float64]) -> Refit:
        return Refit({}, (), [], [{"x": np.sqrt(np.concatenate(parts))}], 0.0, [40], 40.0)

    quiet = 1.0 + 0.1 * rng.random(20)
    base, most = model(quiet, np.full(20, 9.0)), model(1.5 * quiet, np.full(20, 3.0))
    assert 2.0 < clearness(base, most) < 3.0
    assert is_clear(base, most)
    assert not is_clear(most, base)
    assert not is_clear(base, model(2.0 * quiet, np.full(20, 3.0)))
    assert not is_clear(base, model(1.5 * quiet, np.full(20, 8.5)))
