"""Effects screened along the motion that the missing force makes, where a model by itself moves elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import inertance as ia
import pytest
from inertance.diagnosis.law.forced import screened_along
from inertance.diagnosis.models.study import study_of, thinned
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.score_test import screen
from inertance.identification import Accuracy, Campaign

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PRIORS = {"spring.k": {"rel": 0.2}, "guide.d": {"rel": 0.3}}
PERIOD, SINE = 0.019, 4.0


def test_ripple_that_holds_a_machine_in_its_valleys_is_seen_along_its_motion(
    carriage: Callable[..., Any],
) -> None:
    """Its stiffness is half again that of the spring: free runs of any model leave the machine at once."""
    cart = carriage(rate=250.0, duration=6.0, noise=1e-4)
    truth = cart.rig(k=860.0, d=7.0)
    truth.add(rail=ia.Ripple(f_sin=SINE, f_cos=0.0, period=PERIOD))
    truth.connect(truth.wall.flange, truth.rail.flange_a).connect(truth.rail.flange_b, truth.carriage.flange)
    records = [{"record": cart.measured(truth, seed).window(1.0, 6.0)} for seed in (1, 2)]
    study = study_of(thinned(Campaign(cart.rig(), CHANNELS, PRIORS, records, noise={"x": 1e-4})), Accuracy())
    base = JointFit(study, study.campaign.start).fitted()
    along, near = screened_along(study, base)
    alone = screen(study, base.parameters)
    best = next(candidate for candidate in along if candidate.effect.kind == "position_ripple")
    assert best in along[:2]
    assert best.values["period"] == pytest.approx(PERIOD, rel=0.05)
    assert best.parameters["spring.k"] == pytest.approx(860.0, rel=0.03)
    before = next(candidate for candidate in alone if candidate.effect.kind == "position_ripple")
    assert best.gain > 0.8 * base.cost > 2 * before.gain
    assert near.starts[0].keys() == base.starts[0].keys()
