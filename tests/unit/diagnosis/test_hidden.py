"""Effects that parameters hide: they run far off, and from there nothing looks like what is missing."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from inertance import Damper, Fixed, Force, Mass, Network, Spring
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import Site
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.round import _held, _hides
from inertance.diagnosis.search.score_test import screen
from inertance.identification import Accuracy, Campaign, Record
from scipy.integrate import solve_ivp

M, K, D, OIL = 2.0, 900.0, 6.0, 400.0
TIME = np.arange(0.0, 6.0, 4e-3)


def oscillator() -> Network:
    """Return a mass on a spring, which is pushed."""
    net = Network("oscillator", wall=Fixed(), spring=Spring(k=850.0), oil=Damper(d=5.5), mass=Mass(m=M))
    net.add(push=Force()).connect(net.wall.flange, net.spring.flange_a, net.oil.flange_a)
    return net.connect(net.spring.flange_b, net.oil.flange_b, net.mass.flange, net.push.flange)


def campaign(quadratic: float) -> Campaign:
    """Return records of one in oil that resists by the square of speed, integrated apart."""
    records = []
    for seed in (1, 2):
        phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, 5)
        turns = 2 * np.pi * np.array([0.9, 1.7, 2.9, 3.6, 5.3])

        def pushed(t: float, turns: np.ndarray = turns, phase: np.ndarray = phase) -> float:
            return 12.0 * float(np.sin(turns * t + phase).sum()) * min(1.0, 2 * t)

        def rates(t: float, y: np.ndarray, force: Callable[[float], float] = pushed) -> list[float]:
            return [y[1], (force(t) - K * y[0] - D * y[1] - quadratic * abs(y[1]) * y[1]) / M]

        s = solve_ivp(rates, (0.0, TIME[-1]), [0.0, 0.0], "LSODA", TIME, rtol=1e-9, atol=1e-12).y[0]
        s += 0.01 * np.std(s) * np.random.default_rng(seed + 9).standard_normal(len(s))
        records.append({"record": Record(f"{seed}", TIME, {"u": np.array([*map(pushed, TIME)]), "s": s})})
    channels = {"u": {"input": "push.f", "unit": "N"}, "s": {"output": "mass.s", "unit": "m"}}
    priors = {"spring.k": {"rel": 0.1}, "oil.d": {"rel": 0.2}}
    return Campaign(oscillator(), channels, priors, records[:1], records[1:])


def test_parameters_that_ran_away_are_held_and_the_others_fitted_beside() -> None:
    study = Study(campaign(OIL), Accuracy())
    base = JointFit(study, study.campaign.start).fitted()
    assert base.parameters["oil.d"] > 3 * 5.5
    held = _held(study, base)
    assert held is not None
    assert held.parameters["oil.d"] == pytest.approx(5.5, rel=0.05)
    assert study.campaign.priors["spring.k"].moved(held.parameters["spring.k"]) < 3
    assert study.campaign.priors["oil.d"].sd == pytest.approx(1.1)
    found = {c.effect.kind: c for c in screen(study, held.parameters, near=held)}["quadratic_damping"]
    begun = [(found.parameters, found.values)]
    placed = Hypothesis(found.effect, found.site, "quadratic_damping_1", found.values)
    model = JointFit(study, base.parameters, [placed], base).fitted(begun)
    assert model.effects[0].values["c"] == pytest.approx(OIL, rel=0.05)


def test_where_nothing_is_missing_none_is_held_and_nothing_hidden() -> None:
    study = Study(campaign(0.0), Accuracy())
    base = JointFit(study, study.campaign.start).fitted()
    assert _held(study, base) is None
    assert not _hides(study.campaign, base, screen(study, base.parameters, near=base))


def test_friction_by_direction_is_begun_off_the_ridge() -> None:
    site = Site("joint", "translational", "joint.flange_b", "ground", frozenset({"across"}))
    richer, plain = effect_of("asymmetric_friction"), effect_of("coulomb_friction")
    begun = richer.widened("translational", site, plain, {"f_c": 10.0})
    pairs = [tuple(one.values()) for one in begun]
    assert pairs[0] == (10.0, 10.0)
    assert {np.sign(one - other) for one, other in pairs} == {-1.0, 0.0, 1.0}
