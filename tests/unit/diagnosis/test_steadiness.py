"""Whether an effect is as strong throughout each record, as a law is that does not change with time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import inertance as ia
import pytest
from casadi import tanh
from inertance import der
from inertance.diagnosis import Verdict
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import Study, study_of, thinned
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.round import Round
from inertance.diagnosis.verdict import decide
from inertance.diagnosis.verdict.steadiness import Unsteady, unsteady
from inertance.identification import Accuracy, Campaign

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PRIORS = {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}}
LASTING, K3 = 6.0, 2e5


class Aging(ia.Compliant):
    """A cubic spring whose strength changes evenly over a record, by a share of its mean."""

    clock = ia.RealInput("s", "time since the record began")
    change = ia.parameter("1", "share by which it changes")

    def equations(self) -> Any:
        yield self.f == K3 * (1 + self.change * (self.clock / LASTING - 0.5)) * self.s_rel**3


def aging(rig: ia.Network, change: float) -> ia.Network:
    rig.add(old=Aging(change=change), clock=ia.signals.Clock())
    rig.connect(rig.clock.y, rig.old.clock).connect(rig.wall.flange, rig.old.flange_a)
    return rig.connect(rig.old.flange_b, rig.carriage.flange)


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(rate=200.0, duration=LASTING, noise=1e-5)


def study_on(cart: Any, truth: ia.Network, later: float = 0.0) -> Study:
    """Return a study of records of a machine, the last of which is for tests."""
    taken = [cart.measured(truth, seed) for seed in (1, 2, 3)]
    *train, test = ({"record": replace(record, time=record.time + later)} for record in taken)
    return study_of(thinned(Campaign(cart.rig(), CHANNELS, PRIORS, train, [test])), Accuracy())


def fitted(study: Study, kind: str, **values: float) -> Refit:
    """Return the model with an effect at its guide."""
    (site,) = (site for site in study.sites if site.path == "guide")
    placed = Hypothesis(effect_of(kind), site, f"{kind}_1", values)
    return JointFit(study, study.campaign.start, [placed]).fitted()


def verdict_on(study: Study, best: Refit) -> Verdict:
    """Return the verdict where one round of a search came to a model."""
    base = JointFit(study, study.campaign.start).fitted()
    return decide.decided(study, base, base, best, [Round(base, [], [best])], [], {})


def found_in(cart: Any, change: float, later: float) -> list[Unsteady]:
    """Fit a cubic spring that does not age, and ask whether it is steady."""
    study = study_on(cart, aging(cart.rig(), change), later)
    return [*unsteady(study, fitted(study, "cubic_stiffness", k3=K3))]


@pytest.mark.parametrize(("change", "later"), [(0.3, 0.0), (-0.3, 40.0)])
def test_an_effect_that_ages_is_told_with_its_change(cart: Any, change: float, later: float) -> None:
    (found,) = found_in(cart, change, later)
    assert found.placed.label == "cubic_stiffness at guide"
    assert found.change == pytest.approx(change, rel=0.15)
    assert found.takes > 0.5
    way = "grow" if change > 0 else "fade"
    assert f"would have to {way} by {abs(found.change):.0%} from the beginning to the end" in str(found)


def test_an_effect_that_does_not_age_is_steady(cart: Any) -> None:
    assert found_in(cart, 0.0, 40.0) == []


class Wearing(ia.Compliant):
    """Friction that falls at last, to three tenths."""

    clock = ia.RealInput("s", "time since the record began")
    v_rel = ia.variable("m/s", "relative speed of the flanges")

    def equations(self) -> Any:
        yield self.v_rel == der(self.s_rel)
        yield self.f == 0.8 * (1 - 0.7 * (self.clock / 5.0) ** 5) * tanh(self.v_rel / 5e-3)


def test_an_effect_that_drifts_by_another_course_than_its_own_is_named(carriage: Callable[..., Any]) -> None:
    cart = carriage(rate=100.0, duration=5.0, noise=1e-5)
    truth = cart.rig()
    truth.add(pad=Wearing(), clock=ia.signals.Clock())
    truth.connect(truth.clock.y, truth.pad.clock).connect(truth.wall.flange, truth.pad.flange_a)
    truth.connect(truth.pad.flange_b, truth.carriage.flange)
    study = study_on(cart, truth)
    best = fitted(study, "friction_drift", f_c=0.8, f_u=-0.1, f_uu=0.0)
    (placed,) = best.effects
    other = replace(placed, effect=replace(placed.effect, ages=False))
    assert [*unsteady(study, replace(best, effects=(other,)))]
    found = verdict_on(study, best)
    assert [(p.effect.kind, p.site.path) for p in found.effects] == [("friction_drift", "guide")]


def test_what_ages_is_not_named_as_a_law_that_does_not(cart: Any) -> None:
    study = study_on(cart, aging(cart.rig(), -1.2))
    found = verdict_on(study, fitted(study, "cubic_stiffness", k3=K3))
    assert found.verdict in ("unknown", "partial")
    assert "cubic_stiffness" not in [placed.effect.kind for placed in found.effects]
    assert any("cubic_stiffness at guide would have to fade" in note for note in found.notes)
    assert "too little to be named" not in found.sentence


def test_a_model_that_cannot_be_run_beside_where_it_is_has_its_verdict_and_a_note(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Play in a stiff contact may be fitted at the edge of what the integrator is granted."""

    def cannot(*_: Any) -> Any:
        raise ia.SimulationError("train: 'carriage' moves far faster than the record\nmore of it")

    monkeypatch.setattr(decide, "unsteady", cannot)
    monkeypatch.setattr(decide, "unresolved", cannot)
    study = study_on(cart, aging(cart.rig(), 0.3))
    found = verdict_on(study, fitted(study, "cubic_stiffness", k3=K3))
    assert found.effects
    why = "is not known: train: 'carriage' moves far faster than the record"
    assert f"whether effects change with time {why}" in found.notes
    assert f"how well records tell the effects {why}" in found.notes
