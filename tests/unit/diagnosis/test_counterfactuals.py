"""The machine after a change: what the verdict's network predicts, and which effects that tells apart."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import pytest
from inertance.cli.diagnose import show
from inertance.diagnosis import Verdict, diagnose, write_report
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import sites_of
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.verdict.counterfactual import Foretold, parting, told_apart
from inertance.identification import Accuracy, Campaign

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
KNOWN = {"spring.k": {"rel": 0.2}, "guide.d": {"rel": 0.5}}
NOISE = 2e-5


class Case:
    """A carriage that rubs, its model, and records of it as it is and after changes."""

    def __init__(self, rig: Any) -> None:
        self.rig = rig
        truth = rig.rubbing()
        heavy = rig.measured(truth.with_values(carriage=ia.Mass(m=5.0)), 3)
        free = rig.measured(truth.without("guide"), 4)
        self.changed = [
            {"record": heavy, "set": {"carriage.m": 5.0}},
            {"record": free, "remove": ["guide"], "offset": ["x"]},
        ]
        self.runs = [{"record": rig.measured(truth, seed), "initial": "rest"} for seed in (1, 2)]

    def campaign(self, *changed: dict[str, Any]) -> Campaign:
        own: dict[str, Any] = {"train": self.runs[:1], "test": self.runs[1:], "noise": {"x": NOISE}}
        return Campaign(self.rig.rig(), CHANNELS, KNOWN, counterfactual=changed, **own)

    def model(self, study: Study, kind: str, **values: float) -> Refit:
        """Return the model with the true parameters and an effect at the guide."""
        site = next(site for site in sites_of(study.campaign.network) if site.path == "guide")
        placed = Hypothesis(effect_of(kind), site, f"{kind}_1", values)
        joint = JointFit(study, {"spring.k": 820.0, "guide.d": 6.0}, [placed])
        return joint.seen(joint.start)


@pytest.fixture(scope="module")
def case(carriage: Callable[..., Any]) -> Case:
    return Case(carriage(100.0, 6.0, NOISE))


@pytest.fixture(scope="module")
def verdict(case: Case) -> Verdict:
    return diagnose(case.campaign(*case.changed))


def test_the_verdict_predicts_the_machine_after_each_change(verdict: Verdict) -> None:
    assert [placed.label for placed in verdict.effects] == ["coulomb_friction at guide"]
    heavy, free = verdict.counterfactual
    assert (heavy.record, heavy.channel, heavy.change) == ("run 3", "x", "carriage.m = 5 kg")
    assert free.change == "without guide"
    for one in verdict.counterfactual:
        assert one.over_noise is not None
        assert one.refit is not None
        assert one.over_noise < 1.5
        assert one.refit > 5 * one.floor
        assert one.floor * one.size == pytest.approx(NOISE)


def test_all_faces_tell_how_it_predicts(
    verdict: Verdict, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    told = json.loads(json.dumps(verdict.to_dict()))["counterfactual"]
    assert told[0]["over_noise"] == pytest.approx(told[0]["after"] / told[0]["floor"])
    page = write_report(verdict, tmp_path / "report.html").read_text(encoding="utf-8")
    assert "The machine after a change" in page
    assert re.search(r"run 3, carriage\.m = 5 kg: the verdict.*s network predicts x to (0\.9|1)", page)
    show(verdict)
    assert "the machine after a change" in capsys.readouterr().out


def test_nothing_is_told_of_changes_where_there_are_none(case: Case) -> None:
    campaign = case.campaign()
    study = Study(campaign, Accuracy())
    model = case.model(study, "coulomb_friction", f_c=0.8)
    other = case.model(study, "viscous_damping", d=5.0)
    assert told_apart(Foretold(study), [model, other]) == (model, [other], {})


def test_models_are_told_apart_by_what_they_predict(case: Case) -> None:
    heavy = {**case.changed[0], "initial": "rest"}
    study = Study(case.campaign(heavy), Accuracy())
    right = case.model(study, "coulomb_friction", f_c=0.8)
    wrong = case.model(study, "viscous_damping", d=5.0)
    twin = case.model(study, "coulomb_friction", f_c=0.8 + 1e-6)
    foretold = Foretold(study)
    for models in ([right, wrong, twin], [wrong, right, twin]):
        best, alike, apart = told_apart(foretold, models)
        assert best is right
        assert alike == [twin]
        assert [*apart] == [id(wrong)]
    told = parting(foretold, best, wrong, wrong.effects[0], apart[id(wrong)])
    assert told.standard_errors > 3.0
    assert told.verdict_misses == pytest.approx(1.0, abs=0.2)
    assert told.misses > 10 * told.verdict_misses
    assert re.match(r"run 3 tells it from viscous damping at guide, which misses", told.told)


def test_an_effect_of_what_is_exchanged_is_not_predicted(case: Case) -> None:
    """Only the leaf lies between carriage and tool; a law in it may go with it or not."""
    net = case.rig.rig().add(leaf=ia.Spring(k=400.0), tool=ia.Mass(m=1.0))
    net.connect(net.carriage.flange, net.leaf.flange_a).connect(net.leaf.flange_b, net.tool.flange)
    other = {"record": case.changed[0]["record"], "exchange": {"leaf": ia.Spring(k=300.0)}}
    campaign = Campaign(
        net, CHANNELS, KNOWN, case.runs[:1], noise={"x": NOISE}, counterfactual=[other, case.changed[0]]
    )
    study = Study(campaign, Accuracy())
    site = next(site for site in sites_of(net) if site.path == "leaf")
    placed = Hypothesis(effect_of("cubic_stiffness"), site, "cubic_stiffness_1", {"k3": 10.0})
    model = Refit({"spring.k": 800.0, "guide.d": 6.0}, (placed,), [], [], 0.0)
    told, left = Foretold(study).of(model)
    assert told == (
        "whether cubic_stiffness at leaf goes with 'leaf', which the change takes away, no model tells"
    )
    assert isinstance(left, dict)
