"""What screening cannot tell apart: one motion of two sites is fitted once, each channel for itself."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import BETWEEN, Site
from inertance.diagnosis.search.contenders import leading, reserve, same_motion
from inertance.diagnosis.search.fit import Fit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.round import Round, _fit_elsewhere, _richer
from inertance.diagnosis.search.score_test import Candidate
from inertance.diagnosis.verdict.all_records import are_one_delay
from inertance.diagnosis.verdict.decide import _class


def across(path: str, rank: int, gain: float) -> Candidate:
    site = Site(path, "translational", f"{path}.flange_b", f"{path}.flange_a", BETWEEN, rank)
    return Candidate(effect_of("linear_stiffness"), site, {"k": 1.0}, gain, 1.0, {})


def fitted(candidate: Candidate) -> Refit:
    return Refit(
        {}, (Hypothesis(candidate.effect, candidate.site, "added_1", candidate.values),), [], [], 0.0
    )


def test_sites_of_one_motion_are_fitted_once_and_stand_in_the_class() -> None:
    candidates = [across("screw", 1, 900.0), across("thread", 2, 900.0), across("rail", 2, 800.0)]
    base = Refit({}, (), [], [], 0.0)
    assert [c.site.path for c in leading(candidates, set())] == ["thread", "rail"]
    own, other = fitted(candidates[1]), fitted(candidates[2])
    members = _class(own, Round(base, candidates, [own, other]), [other])
    assert members == (("linear_stiffness", "rail"), ("linear_stiffness", "screw"))


def test_what_is_in_series_is_fitted_once_in_a_line() -> None:
    """Its gains differ, as screening thinks of a spring's play otherwise."""
    stiff = [
        replace(c, site=replace(c.site, line=(other,)))
        for c, other in ((across("inerter", 1, 900.0), "strut"), (across("strut", 2, 880.0), "inerter"))
    ]
    play = [replace(c, effect=effect_of("backlash")) for c in stiff]
    assert [c.site.path for c in leading(play, set())] == ["strut"]
    assert leading(stiff, set()) == stiff


def test_each_channel_is_fitted() -> None:
    sites = [Site(name, "channel", f"carriage.{name}", "", frozenset({"channel"})) for name in ("s", "a")]
    candidates = [Candidate(effect_of("sensor_gain"), site, {"gain": 0.1}, 900.0, 1.0, {}) for site in sites]
    assert leading(candidates, set()) == candidates


def test_what_leads_where_parameters_were_given_is_tried_if_much_is_left() -> None:
    tried = [across("screw", 1, 900.0)]
    early = [across("rail", 1, 5000.0), across("screw", 1, 4000.0), across("thread", 1, 10.0)]
    assert [c.site.path for c in reserve(tried, early, tried, False)] == ["rail"]
    assert [c.site.path for c in reserve(tried, early, tried, True)] == ["rail", "screw"]


def rubbing(kind: str, path: str = "rail", cost: float = 0.0, misfit: float = 1.0) -> tuple[Candidate, Refit]:
    """Return a friction as it is screened, and a fit of it."""
    effect, site = effect_of(kind), across(path, 2, 900.0).site
    values = {quantity.name: 1.0 for quantity in effect.quantities["translational"]}
    candidate = Candidate(effect, site, values, 900.0, 1.0, {})
    made = replace(fitted(candidate), cost=cost, test=[{"x": np.full(100, misfit)}], stretches=[2])
    return candidate, replace(made, independent=100.0)


def test_what_generalises_the_nearest_or_its_special_case_is_fitted_though_it_promises_less() -> None:
    coulomb, dry = rubbing("coulomb_friction", cost=60.0)
    creeping, nearest = rubbing("presliding_friction", cost=50.0, misfit=1.04)
    leaning, _ = rubbing("asymmetric_friction")
    elsewhere, _ = rubbing("asymmetric_friction", "screw")
    candidates = [creeping, coulomb, elsewhere, leaning]
    records = [SimpleNamespace(independent=25.0), SimpleNamespace(independent=15.0)]
    study: Any = SimpleNamespace(campaign=SimpleNamespace(training=records))
    done = Round(Refit({}, (), [], [], 0.0), candidates, [dry, nearest])
    assert _richer(study, done, candidates) == [leaning]
    done.failed[leaning.label] = "it cannot be run"
    assert _richer(study, done, candidates) == []
    for cost, richer in ((57.0, []), (59.0, [leaning])):
        _, noise = rubbing("presliding_friction", cost=cost, misfit=1.02)
        assert _richer(study, Round(done.base, candidates, [dry, noise]), candidates) == richer


def test_an_effect_is_fitted_elsewhere_from_where_the_nearest_led_if_parameters_ran_away(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    kept, gone = {"shaft.c": 1.0}, {"shaft.c": 9.0}
    candidates = [across("motor", 2, 900.0), across("load", 2, 800.0), across("rail", 2, 700.0)]
    costs, led = (50.0, 90.0, 80.0), (kept, gone, kept)
    models = [
        replace(fitted(c), cost=cost, parameters=parameters)
        for c, cost, parameters in zip(candidates, costs, led, strict=True)
    ]
    made: list[Fit] = []

    class Here:
        def __init__(self, study: Any) -> None:
            pass

        def begin(self, fit: Fit) -> Any:
            made.append(fit)
            return lambda: replace(models[1], cost=40.0, parameters=kept)

    monkeypatch.setattr("inertance.diagnosis.search.round.Crew", Here)
    priors = {"shaft.c": SimpleNamespace(moved=lambda value: value - 1.0)}
    campaign = SimpleNamespace(priors=priors)
    study: Any = SimpleNamespace(late=lambda: False, tell=lambda line: None, campaign=campaign)
    stayed = Round(Refit(kept, (), [], [], 0.0), candidates, [*models])
    _fit_elsewhere(study, stayed)
    assert made == []
    astray = Round(Refit(gone, (), [], [], 0.0), candidates, [*models])
    _fit_elsewhere(study, astray)
    assert [fit.placed.label for fit in made] == ["linear_stiffness at load"]
    assert all(parameters == kept for parameters, _ in made[0].starts)
    assert [model.cost for model in astray.fitted] == [50.0, 40.0, 80.0]


def test_a_part_gives_way_to_the_whole_that_moves_alike() -> None:
    candidates = [across("screw.thread", 2, 900.0), across("screw", 1, 900.0), across("rail", 2, 800.0)]
    assert [c.site.path for c in leading(candidates, set())] == ["screw", "rail"]


def test_what_explains_nothing_is_no_motion_of_its_own() -> None:
    assert not same_motion(across("screw", 1, 0.0), across("rail", 1, 0.0))


def late(*keys: tuple[str, str]) -> Refit:
    """Return a model with effects on channels."""
    channels = {name: Site(name, "channel", name, "", frozenset({"channel"})) for _, name in keys}
    effects = tuple(Hypothesis(effect_of(kind), channels[name], kind, {}) for kind, name in keys)
    return Refit({}, effects, [], [], 0.0)


@pytest.mark.parametrize(
    ("inputs", "outputs", "one"),
    [(["x"], ["F"], True), (["x"], ["F", "a"], False), (["x", "u"], ["F"], False)],
)
def test_a_late_command_is_a_late_sensor_where_there_is_one_of_each(
    inputs: list[str], outputs: list[str], one: bool
) -> None:
    campaign: Any = SimpleNamespace(inputs=inputs, outputs=outputs)
    command, sensor = late(("actuator_delay", "x")), late(("sensor_delay", "F"))
    assert are_one_delay(campaign, command, sensor) is are_one_delay(campaign, sensor, command) is one
    assert not are_one_delay(campaign, command, late(("sensor_bias", "F")))
    assert not are_one_delay(campaign, command, late(("actuator_delay", "x"), ("sensor_delay", "F")))
