"""What fits best only where parameters go far off: what is in series is held against it."""

from __future__ import annotations

import inertance as ia
import numpy as np
import pytest
from inertance import Mass, Network, Position, SpringDamper
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.identification import Accuracy, Campaign, Record
from scipy.integrate import solve_ivp

K, D, SERIES, M = 20_500.0, 850.0, 18_500.0, 40.0
TIME = np.arange(0.0, 3.0, 4e-3)


def strut() -> Network:
    """Return a mass on a strut that a shaker moves."""
    net = Network(
        "strut", shaker=Position(exact=True), strut=SpringDamper(k=22_000.0, d=900.0), mass=Mass(m=M)
    )
    return net.connect(net.shaker.flange, net.strut.flange_a).connect(net.strut.flange_b, net.mass.flange)


def measured(seed: int, noise: float = 0.01) -> Record:
    """Return a record of such a mass that a spring before the strut carries, too, integrated apart."""
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, 6)
    turns = 2 * np.pi * np.array([0.7, 1.6, 2.9, 4.3, 7.1, 11.0])

    def moved(t: float) -> float:
        return 2e-3 * float(np.sin(turns * t + phase).sum() - np.sin(phase).sum() * np.exp(-2 * t))

    def rates(t: float, y: np.ndarray) -> list[float]:
        joint, s, v = y
        force = SERIES * (moved(t) - joint)
        return [v + (force - K * (joint - s)) / D, v, force / M]

    found = solve_ivp(rates, (0.0, TIME[-1]), [0.0] * 3, "LSODA", TIME, rtol=1e-9, atol=1e-12).y
    x = np.array([moved(t) for t in TIME])
    a = SERIES * (x - found[0]) / M
    a += noise * np.std(a) * np.random.default_rng(seed + 100).standard_normal(len(a))
    return Record(f"{seed}", TIME, {"x": x, "a": a})


CHANNELS = {
    "x": {"input": "shaker.s_ref", "unit": "m"},
    "a": {"output": "mass.a", "unit": "m/s2"},
}
PRIORS = {"strut.k": {"rel": 0.1}, "strut.d": {"rel": 0.1}}


def test_what_lets_a_compliance_settle_does_not_show_beside_little_noise() -> None:
    campaign = Campaign(strut(), CHANNELS, PRIORS, [{"record": measured(1, noise=0.0)}], noise={"a": 1.0})
    study = Study(campaign, Accuracy(rtol=1e-8))
    site = next(site for site in study.sites if site.path == "strut")
    soft = Hypothesis(effect_of("compliance"), site, "soft", {"compliance": 1 / SERIES})
    (experiment,) = campaign.training
    seen = JointFit(study, {"strut.k": K, "strut.d": D}, [soft]).run_on(experiment).seen["a"]
    a = experiment.compared.values["a"]
    assert np.std(seen - a) < 1e-3 * np.std(a)


def test_a_spring_in_series_is_named_though_a_relaxing_one_fits_as_well() -> None:
    records = [{"record": measured(seed)} for seed in (1, 2, 3)]
    found = ia.diagnose(Campaign(strut(), CHANNELS, PRIORS, records[:-1], records[-1:]))
    (placed,) = found.effects
    assert placed.key == ("compliance", "strut")
    assert placed.values["compliance"] * SERIES == pytest.approx(1.0, rel=0.05)
    assert found.closed > 0.98
