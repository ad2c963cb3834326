"""Which fits are made, when, and from what; and which runs a fit makes."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from dataclasses import replace
from functools import partial
from math import inf
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.criteria import START_DROP_RATIO, TRIED_START_DROP_RATIO
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import Site
from inertance.diagnosis.models.study import Study, study_of
from inertance.diagnosis.search import crew as fitters
from inertance.diagnosis.search import joint_fit, record_start, score_test
from inertance.diagnosis.search import round as searched
from inertance.diagnosis.search.contenders import ready
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.needless import needless
from inertance.diagnosis.search.record_start import settled
from inertance.diagnosis.search.revision import plainer
from inertance.diagnosis.search.reweighed import is_slight, reweighed
from inertance.diagnosis.search.score_test import Candidate
from inertance.diagnosis.search.tried import Tried
from inertance.identification import Accuracy, Campaign, Record
from inertance.identification.fitting.campaign_model import RecordModel
from inertance.networks import Variations

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PRIORS: dict[str, Any] = {"spring.k": {"rel": 0.2}, "guide.d": {"rel": 0.3}}
NOISE = 1e-5


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(rate=200.0, duration=6.0, noise=NOISE)


def study(cart: Any, truth: ia.Network, model: ia.Network, priors: Any = PRIORS, cut: float = 0.0) -> Study:
    """Return a study of two records; `cut` [s] lets them begin in motion."""
    initial = "rest"
    records = [cart.measured(truth, seed) for seed in (1, 2)]
    if cut:
        records, initial = [begun(record, cut) for record in records], "fit"
    train, test = ([{"record": record, "initial": initial}] for record in records)
    campaign = Campaign(model, CHANNELS, priors, train, test, noise={"x": NOISE})
    return study_of(campaign, Accuracy(rtol=1e-7))


def begun(record: Record, cut: float) -> Record:
    late = record.time >= cut
    return replace(
        record, time=record.time[late], values={name: values[late] for name, values in record.values.items()}
    )


def rail(path: str, kind: str = "coulomb_friction", **values: float) -> Hypothesis:
    site = Site(path, "translational", "carriage.flange", "wall.flange", frozenset({"across"}), speed=0.1)
    return Hypothesis(effect_of(kind), site, f"{kind}_1", values)


def left(placed: Hypothesis, misfit: float) -> Refit:
    """Return a fitted model with an effect that leaves so many times the noise."""
    residual = [{"x": np.full(100, misfit)}]
    return Refit({}, (placed,), residual, [], 0.0, [2], 100.0)


class Crew(Executor):
    """An executor that works at once, or when it is asked for a result, and notes what comes when."""

    def __init__(self, late: bool) -> None:
        self.late, self.notes = late, list[str]()

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.notes.append(f"begin {args[-1]}")
        work, notes = partial(fn, *args, **kwargs), self.notes
        done = None if self.late else work()

        class Promised(Future[Any]):
            def result(self, timeout: float | None = None) -> Any:
                notes.append(f"take {args[-1]}")
                return done or work()

        return Promised()


@pytest.mark.parametrize("late", [True, False])
def test_fits_follow_each_other_alike_whenever_they_are_made(
    cart: Any, late: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    given, crew = study(cart, cart.rig(), cart.rig()), Crew(late)
    gains = {"a": 900.0, "b": 800.0, "c": 700.0, "d": 600.0, "e": 500.0}
    candidates = [
        Candidate(effect_of("linear_stiffness"), rail(path).site, {"k": 1.0}, gain, 1.0, {})
        for path, gain in gains.items()
    ]

    def made(payload: bytes, accuracy: Accuracy, deadline: float, path: str) -> Refit:
        return replace(left(rail(path, "linear_stiffness", k=1.0), 1.0), cost=10_000.0 - gains[path])

    def begin(self: Any, fit: Any) -> Any:
        return crew.submit(made, b"", given.accuracy, given.deadline, fit.placed.site.path).result

    monkeypatch.setattr(searched, "screen", lambda *given, **near: list(candidates))
    monkeypatch.setattr(fitters.Crew, "begin", begin)
    base = replace(left(rail("a"), 2.0), effects=(), cost=10_000.0)
    done = searched.run_round(given, base, [])
    assert [f.effects[-1].site.path for f in done.fitted] == list(gains)
    first, then = [f"begin {path}" for path in "abc"], ["take a", "begin d", "take b", "begin e"]
    assert crew.notes == [*first, *then, "take c", "take d", "take e"]


def test_a_general_case_waits_for_its_special_one_and_nothing_else_waits() -> None:
    names = ("coulomb_friction", "stribeck_friction", "viscous_damping")
    site = rail("rail").site
    plain, rich, other = (Candidate(effect_of(name), site, {}, 1.0, 1.0, {}) for name in names)
    assert ready([plain, rich, other], []) is plain
    assert ready([rich, other], [plain]) is other
    assert ready([rich], [plain]) is None
    assert ready([rich], []) is rich


def test_a_general_case_of_what_leaves_noise_only_is_not_fitted(cart: Any) -> None:
    given = study(cart, cart.rig(), cart.rig())
    rich = rail("guide", "stribeck_friction", f_c=1.0, f_s=1.0, v_s=0.1)
    base = Refit(given.campaign.start, (), [], [], 0.0)
    told = needless(given, rich, base, [left(rail("guide", f_c=1.0), 1.02)])
    assert told == "coulomb_friction at guide, a special case of it, leaves nothing but noise"
    count = sum(experiment.independent for experiment in given.campaign.training)
    by_chance = replace(left(rail("guide", f_c=1.0), 1.02), cost=count + 1.9 * np.sqrt(2 * count))
    assert needless(given, rich, base, [by_chance]) == told
    assert not needless(given, rich, base, [replace(by_chance, cost=count + 2.1 * np.sqrt(2 * count))])
    assert not needless(given, rich, base, [left(rail("guide", f_c=1.0), 1.2)])
    assert not needless(given, rich, base, [left(rail("spring", f_c=1.0), 1.0)])


def test_an_effect_that_the_model_has_as_a_fitted_parameter_is_not_fitted(cart: Any) -> None:
    known = {**PRIORS, "rail.f_c": {"rel": 0.5}}
    model = cart.rubbing()
    given = study(cart, model, model, known)
    base = Refit(given.campaign.start, (), [], [], 0.0)
    told = needless(given, rail("rail", f_c=0.1), base, [])
    assert told == "the model has it, and rail.f_c were fitted"
    assert needless(given, rail("guide", "viscous_damping", d=1.0), base, [])
    assert not needless(given, rail("rail", "viscous_damping", d=1.0), base, [])
    assert not needless(
        study(cart, model, model), rail("rail", f_c=0.1), base, []
    )  # its level is taken as exact
    stuck = Refit({**given.campaign.start, "rail.f_c": 0.0}, (), [], [], 0.0)
    assert not needless(given, rail("rail", f_c=0.1), stuck, [])


def test_what_would_only_bend_the_law_of_what_was_found_is_not_fitted(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = study(cart, cart.rig(), cart.rig())
    site = rail("guide").site
    kinds = "coulomb_friction", "presliding_friction", "cubic_damping"
    candidates = [Candidate(effect_of(kind), site, {}, 900.0, 1.0, {}) for kind in kinds]
    monkeypatch.setattr(searched, "screen", lambda *given, **near: list(candidates))
    monkeypatch.setattr(fitters.Crew, "begin", lambda *given: lambda: "tried")
    base = left(rail("guide", "hysteresis", k=1.0, s_y=1.0, n=2.0), 1.05)
    alone = searched.run_round(given, replace(base, effects=()), [])
    assert set(alone.failed.values()) == {"tried"}
    done = searched.run_round(given, base, [alone])
    assert done.failed["presliding_friction at guide"] == "it would only bend the law of hysteresis at guide"
    assert done.failed["cubic_damping at guide"] == "tried"


@pytest.mark.usefixtures("few_effects")
def test_a_model_that_cannot_be_screened_ends_the_search_and_nothing_else(
    carriage: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With what was found it runs; beside probes it may not."""
    cart = carriage(rate=100.0, duration=4.0, noise=NOISE)
    screened = score_test.screen

    def screen(study: Study, parameters: Any, effects: Any = (), near: Any = None) -> list[Candidate]:
        if effects:
            raise ia.SimulationError("'cart': integration failed at t = 2 s\nmore of it")
        return screened(study, parameters)

    monkeypatch.setattr(searched, "screen", screen)
    other = cart.rubbing()
    other.add(stop=ia.CubicSpring(k=0.0, k3=1e5))
    other.connect(other.wall.flange, other.stop.flange_a).connect(other.stop.flange_b, other.carriage.flange)
    records = [{"record": cart.measured(other, seed), "initial": "rest"} for seed in (1, 2, 3)]
    found = ia.diagnose(Campaign(cart.rig(), CHANNELS, PRIORS, records[:2], records[2:], noise={"x": NOISE}))
    assert any("nothing was looked for: 'cart': integration failed at t = 2 s" in n for n in found.notes)
    assert found.verdict in ("partial", "law", "unknown")


@pytest.mark.parametrize(
    ("misfit", "away", "more"), [(2.0, 0.0, False), (2.0, 5.0, True), (4.0, 0.0, True), (1.05, 5.0, False)]
)
def test_a_little_may_be_left_beside_parameters_as_they_were_assumed(
    cart: Any, misfit: float, away: float, more: bool
) -> None:
    """A likeness of play takes 98 % of its gap, beside a friction seven standard deviations off."""
    campaign = study(cart, cart.rig(), cart.rig()).campaign
    base = replace(left(rail("guide"), 10.0), effects=())
    found = replace(left(rail("guide"), misfit), parameters={"spring.k": 800.0 * (1 + 0.2 * away)})
    assert searched._much_is_left(campaign, [base, found], base) is more


def test_impacts_are_granted_more_steps(cart: Any) -> None:
    given = study(cart, cart.rig(), cart.rig())
    given = replace(given, accuracy=replace(given.accuracy, steps=50))
    play = replace(rail("guide"), effect=effect_of("backlash"))
    assert JointFit(given, given.campaign.start, [rail("guide", f_c=1.0)]).accuracy.steps == 50
    assert given.accuracy_with([rail("guide"), play]).steps == 2 * 50
    free = replace(given, accuracy=replace(given.accuracy, steps=None))
    assert free.accuracy_with([play]).steps is None


def test_the_best_start_goes_on_with_the_slopes_it_has(cart: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    given = study(cart, cart.rig(k=900.0, d=7.0), cart.rig(), {"spring.k": {"rel": 0.2}})
    placed = Hypothesis(effect_of("viscous_damping"), rail("guide").site, "viscous_damping_1", {"d": 0.5})
    joint, asked, stacked = JointFit(given, given.campaign.start, [placed]), list[bool](), JointFit.stacked

    def noted(self: JointFit, vector: Any, slopes: bool) -> Any:
        asked.append(slopes)
        return stacked(self, vector, slopes)

    monkeypatch.setattr(JointFit, "stacked", noted)
    found = joint.fitted([(given.campaign.start, {"d": d}) for d in (0.5, 2.0)])
    assert asked[:5] == [True, False, True, False, False]
    assert found.parameters["spring.k"] == pytest.approx(900.0, rel=2e-3)
    assert found.effects[-1].values["d"] == pytest.approx(1.0, rel=0.05)


class Line(np.ndarray):
    """A start that is itself what is seen of a run from there, beside a record at 0.5."""

    weighed = property(lambda self: (self.missed, np.array([[0.0], [1.0]])))
    missed = property(lambda self: np.array([2.0, 0.5 - self[0]]))


@pytest.mark.parametrize(("drop", "runs"), [(1e-3, 2), (1.0, 1)])
def test_a_record_begins_where_it_is_known_to_unless_another_start_promises_much(
    drop: float, runs: int
) -> None:
    made = []

    def run_from(start: np.ndarray) -> Any:
        made.append(start)
        return start.view(Line)

    found, _ = settled(np.zeros(1), run_from, np.array([[-9.0], [9.0]]), drop)
    assert len(made) == runs
    assert found[0] == (0.5 if runs == 2 else 0.0)


def test_a_trial_in_motion_takes_no_slopes_and_no_run_is_made_twice(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = study(cart, cart.rig(k=900.0, d=7.0), cart.rig(), cut=2.5)
    runs, run = list[tuple[Any, ...]](), RecordModel.run
    sloped, along = list[Any](), Variations.along

    def noted(self: RecordModel, parameters: Any, start: Any, accuracy: Any) -> Any:
        runs.append((self.record.name, *parameters.values(), *start))
        return run(self, parameters, start, accuracy)

    def followed(self: Variations, result: Any, start: Any = None) -> Any:
        sloped.append(result)
        return along(self, result, start)

    monkeypatch.setattr(RecordModel, "run", noted)
    monkeypatch.setattr(Variations, "along", followed)
    found = JointFit(given, given.campaign.start).fitted()
    assert len(sloped) <= len(runs) - 2
    assert len(set(runs)) == len(runs)
    assert found.parameters["spring.k"] == pytest.approx(900.0, rel=2e-3)
    assert found.parameters["guide.d"] == pytest.approx(7.0, rel=0.02)
    assert found.misfit == pytest.approx(1.0, abs=0.1)


def test_a_step_that_wins_next_to_nothing_of_what_was_asked_for_is_the_last() -> None:
    """Beside a record at 50 a start answers as if in a line, and hardly moves."""
    made = []

    class Stuck(Line):
        missed = property(lambda self: np.array([2.0, 50.0 - self[0] / 10]))

    def run_from(start: np.ndarray) -> Any:
        made.append(start)
        return start.view(Stuck)

    for drop, runs in ((1e-3, 9), (9.0, 2), (1e4, 1)):
        made.clear()
        settled(np.zeros(1), run_from, np.array([[-900.0], [900.0]]), drop)
        assert len(made) == runs


def test_a_model_without_an_effect_is_fitted_once(cart: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    given = study(cart, cart.rubbing(), cart.rubbing())
    found, fitted = list[Any](), JointFit.fitted
    both = JointFit(given, given.campaign.start, [rail("guide", f_c=0.4)])
    whole = both.seen(both.start)

    def noted(self: JointFit, *starts: Any) -> Refit:
        found.append(self.effects)
        return fitted(self, *starts)

    monkeypatch.setattr(JointFit, "fitted", noted)
    tried = Tried(given)
    tried.begin(whole, whole.effects)
    first = tried.without(whole.effects[0], whole)
    assert first is not None
    assert first.effects == ()
    assert tried.without(whole.effects[0], whole) is first
    assert found == [()]


@pytest.mark.parametrize(("ratio", "stays"), [(1.1, True), (2.0, False)])
def test_models_that_stay_are_weighed_with_other_noise(cart: Any, ratio: float, stays: bool) -> None:
    given = study(cart, cart.rig(k=900.0), cart.rig(), {"spring.k": {"rel": 0.2}})
    base = JointFit(given, given.campaign.start).fitted()
    both = JointFit(given, given.campaign.start, [rail("guide", f_c=0.1)])
    whole = both.seen(both.start)
    louder = [
        {name: replace(floor, sigma=ratio * floor.sigma) for name, floor in e.floors.items()}
        for e in given.campaign.experiments
    ]
    heard = replace(given, campaign=given.campaign.with_floors(louder))
    assert is_slight(given.campaign, heard.campaign) == stays
    rubbing = JointFit(given, given.campaign.start, [rail("guide", f_c=0.4)])
    rounds = [searched.Round(base, [], [whole, rubbing.seen(rubbing.start)])]
    again = reweighed(given, heard, base, base, whole, rounds)
    assert again is not None
    _, other, chosen, (done,) = again
    assert other.misfit == pytest.approx(base.misfit / ratio, rel=1e-6)
    assert other.parameters == base.parameters
    assert done.base is other
    assert done.fitted[0] is chosen
    assert chosen.cost <= whole.cost
    run = JointFit(heard, given.campaign.start, [rail("guide", f_c=0.4)]).seen(rubbing.start)
    assert done.fitted[1].misfit == pytest.approx(run.misfit, rel=1e-6)
    assert done.fitted[1].cost == pytest.approx(run.cost, rel=1e-6)


def leaning(cart: Any, forward: float, backward: float) -> ia.Network:
    """Return the carriage with friction that may differ by direction."""
    net: ia.Network = cart.rig()
    net.add(rail=ia.AsymmetricFriction(f_forward=forward, f_backward=backward))
    return net.connect(net.wall.flange, net.rail.flange_a).connect(net.rail.flange_b, net.carriage.flange)


@pytest.mark.parametrize(("forward", "kind"), [(0.8, "coulomb_friction"), (0.6, "asymmetric_friction")])
def test_an_effect_gives_way_to_its_special_case_that_does_as_well(
    cart: Any, forward: float, kind: str
) -> None:
    given = study(cart, leaning(cart, forward, 0.8), cart.rig(), {"spring.k": {"rel": 0.2}})
    begun = [rail("guide", "asymmetric_friction", f_forward=0.7, f_backward=0.8)]
    richer = JointFit(given, given.campaign.start, begun).fitted()
    best = plainer(richer, Tried(given))
    assert [(p.label, p.name) for p in best.effects] == [(f"{kind} at guide", f"{kind}_1")]
    assert best.misfit == pytest.approx(1.0, abs=0.05)
    assert (best is richer) == (kind == "asymmetric_friction")


def test_no_effect_gives_way_to_what_stands_there_already(cart: Any) -> None:
    given = study(cart, leaning(cart, 0.6, 0.9), cart.rig(), {"spring.k": {"rel": 0.2}})
    begun = [rail("guide", "asymmetric_friction", f_forward=0.5, f_backward=0.8), rail("guide", f_c=0.1)]
    fit = JointFit(given, given.campaign.start, begun)
    labels = [placed.label for placed in plainer(fit.seen(fit.start), Tried(given)).effects]
    assert len(set(labels)) == len(labels) == 2


def test_what_generalises_is_chosen_once_noise_is_known_beside_which_it_shows(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It had been left off far from the truth; if it cannot be run on, what was chosen stays."""
    truth = leaning(cart, 0.6, 0.9)
    given = study(cart, truth, cart.rig(), {"spring.k": {"rel": 0.2}})
    base = JointFit(given, given.campaign.start).fitted()
    plain = JointFit(given, base.parameters, [rail("guide", f_c=0.75)]).fitted()
    astray = [rail("guide", "asymmetric_friction", f_forward=0.7, f_backward=0.75)]
    richer = JointFit(given, base.parameters, astray)
    before = richer.seen(richer.start)
    floors = [
        {name: replace(floor, sigma=1.01 * floor.sigma) for name, floor in e.floors.items()}
        for e in given.campaign.experiments
    ]
    heard = replace(given, campaign=given.campaign.with_floors(floors))
    rounds = [searched.Round(base, [], [plain, before])]
    again = reweighed(given, heard, base, base, plain, rounds)
    assert again is not None
    _, _, chosen, (done,) = again
    assert chosen is done.fitted[1]
    assert chosen.effects[0].values == pytest.approx({"f_forward": 0.6, "f_backward": 0.9}, rel=1e-2)

    fitted = JointFit.fitted

    def failing(self: JointFit, *starts: Any) -> Refit:
        if self.effects[0].effect.kind == "asymmetric_friction":
            raise ia.SimulationError("too many steps")
        return fitted(self, *starts)

    monkeypatch.setattr(JointFit, "fitted", failing)
    again = reweighed(given, heard, base, base, plain, rounds)
    assert again is not None
    assert again[2].labels == plain.labels


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[float | None]:
    """How closely it was asked each time where a record begins."""
    drops, begin = list[float | None](), record_start.begun

    def begun(experiment: Any, rest: Any, run_from: Any, known: Any, drop: float | None, anew: bool) -> Any:
        drops.append(drop)
        return begin(experiment, rest, run_from, known, drop, anew)

    monkeypatch.setattr(joint_fit, "begun", begun)
    return drops


def test_a_fit_begins_where_the_records_of_another_model_do(cart: Any, asked: list[float | None]) -> None:
    shaken = study(cart, cart.rig(k=900.0), cart.rig(k=800.0), cut=1.13)
    base = JointFit(shaken, {"spring.k": 800.0, "guide.d": 4.0}).fitted()
    assert asked[0] == START_DROP_RATIO
    asked.clear()
    again = JointFit(shaken, base.parameters, [rail("guide", f_c=0.1)], base).fitted()
    assert asked[0] == TRIED_START_DROP_RATIO
    assert again.misfit == pytest.approx(base.misfit, rel=0.05)


@pytest.mark.parametrize(("known", "drop"), [(inf, START_DROP_RATIO), (0.3, TRIED_START_DROP_RATIO)])
def test_starts_of_a_model_that_is_far_behind_are_not_refined(
    cart: Any, asked: list[float | None], known: float, drop: float
) -> None:
    truth = cart.rig(k=900.0).add(rail=ia.CoulombFriction(f_c=3.0))
    truth.connect(truth.wall.flange, truth.rail.flange_a).connect(truth.rail.flange_b, truth.carriage.flange)
    shaken = study(cart, truth, cart.rig(k=800.0), cut=1.13)
    plain = JointFit(shaken, {"spring.k": 800.0, "guide.d": 4.0}).fitted()
    asked.clear()
    other = JointFit(shaken, {"spring.k": 800.0, "guide.d": 4.0}, near=plain).fitted(known=known * plain.cost)
    assert asked[-1] == drop
    assert other.misfit == pytest.approx(plain.misfit, rel=0.1)
