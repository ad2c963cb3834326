"""Whole diagnoses of records that differ by known and unknown values, of a model with a shared parameter."""

from functools import cache
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import study_of
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.identification import Accuracy, Campaign, Record
from scipy.integrate import solve_ivp

MASS, STIFFNESS, DAMPING, NOISE = 2.0, 410.0, 6.0, 2e-5
CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PARAMETERS: dict[str, Any] = {
    "left.k": {"rel": 0.1},
    "right.k": {"share": "left.k"},
    "guide.d": {"rel": 0.3},
    "left.s_rel0": {"min": -0.05, "max": 0.05, "per": "record"},
}
RUNS = [(0.01, MASS), (-0.012, MASS), (0.004, 2.9)]  # rest length of the left spring, mass


def model(**more: ia.Component) -> ia.Network:
    net = ia.Network("rig", wall=ia.Fixed(), left=ia.Spring(k=380.0), right=ia.Spring(k=380.0))
    net.add(guide=ia.Damper(d=5.0), carriage=ia.Mass(m=MASS), push=ia.Force(), **more)
    across = [net.left, net.right, net.guide]
    net.connect(net.wall.flange, *(one.flange_a for one in across))
    return net.connect(net.carriage.flange, net.push.flange, *(one.flange_b for one in across))


@cache
def measured(run: int, c: float) -> Record:
    """Return a record cut from the middle of a motion, of a machine with quadratic damping."""
    rest, mass = RUNS[run]
    rng = np.random.default_rng(run)
    lines, phases = rng.uniform(0.5, 6.0, 10), rng.uniform(0, 2 * np.pi, 10)

    def force(t: Any) -> Any:
        return 3.5 * np.sin(2 * np.pi * np.multiply.outer(t, lines) + phases).sum(axis=-1)

    def rates(t: float, state: Any) -> list[float]:
        x, v = state
        spring = STIFFNESS * (x - rest) + STIFFNESS * x
        return [v, (float(force(t)) - spring - DAMPING * v - c * v * abs(v)) / mass]

    t = np.arange(1.0, 5.0, 0.01)
    x = solve_ivp(rates, (0.0, 5.0), [rest, 0.05], t_eval=t, rtol=1e-9, atol=1e-12, max_step=0.02).y[0]
    return Record(f"run {run}", t, {"F": force(t), "x": x + rng.normal(0, NOISE, len(t))})


def entry(run: int, c: float) -> dict[str, Any]:
    known = {} if RUNS[run][1] == MASS else {"values": {"carriage.m": RUNS[run][1]}}
    return {"record": measured(run, c), **known}


def diagnosed(c: float) -> ia.diagnosis.Verdict:
    train, test = [entry(run, c) for run in (0, 2)], [entry(1, c)]
    return ia.diagnose(Campaign(model(), CHANNELS, PARAMETERS, train, test, noise={"x": NOISE}))


def test_a_filter_is_heard_in_a_run_with_the_values_that_a_record_has_of_its_own() -> None:
    """It was heard in one with those that had been assumed, which misses far more than steps."""
    train = [entry(run, 15.0) for run in (0, 2)]
    study = study_of(Campaign(model(), CHANNELS, PARAMETERS, train, noise={"x": NOISE}), Accuracy())
    site = next(site for site in study.sites if "guide" in (site.path, *site.same))
    damping = [Hypothesis(effect_of("quadratic_damping"), site, "quadratic_damping_1", {"c": 15.0})]
    found = JointFit(study, study.campaign.start, damping).fitted()
    again = JointFit(study, found.parameters, found.effects, found)
    for experiment, own in zip(study.campaign.training, found.own, strict=True):
        run = again.run_on(experiment)
        assert run.given["left.s_rel0"] == pytest.approx(own["left.s_rel0"], abs=1e-5)
        assert float(np.sqrt(np.mean(run.missed**2))) < 1.2


def test_an_effect_is_found_beside_values_that_differ_by_record() -> None:
    verdict = diagnosed(c=15.0)
    assert verdict.verdict == "effect"
    (effect,) = verdict.effects
    assert effect.effect.kind == "quadratic_damping"
    assert effect.values["c"] == pytest.approx(15.0, rel=0.01)
    assert sorted(verdict.parameters) == ["guide.d", "left.k"]
    assert verdict.parameters["left.k"] == pytest.approx(STIFFNESS, rel=1e-3)
    rows = verdict.to_dict()["record_values"]
    assert [row["record"] for row in rows] == ["run 0", "run 2", "run 1"]
    assert [row["value"] for row in rows] == pytest.approx([0.01, 0.004, -0.012], abs=2e-5)
    corrected = verdict.corrected().dae().parameter_values
    assert corrected["left.s_rel0"] == 0.0
    assert "right.k" not in corrected


def test_values_that_differ_by_record_are_no_effect() -> None:
    verdict = diagnosed(c=0.0)
    assert verdict.verdict == "parameters", verdict.sentence
    assert verdict.parameters["left.k"] == pytest.approx(STIFFNESS, rel=1e-3)
    assert not verdict.notes
