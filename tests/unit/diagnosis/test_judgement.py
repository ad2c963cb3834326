"""How a verdict is judged: over noise, over the signal, over repeats; what came closest, and why not."""

import json
import re
from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from inertance.cli import app
from inertance.cli.diagnose import show
from inertance.diagnosis import Gap, Ranked, Verdict, write_report
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.report.text import conclusion, ruled_out
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.revision import _is_needed, revised
from inertance.diagnosis.search.round import Round
from inertance.diagnosis.search.score_test import Candidate, screen
from inertance.diagnosis.search.tried import Tried
from inertance.diagnosis.verdict import beyond
from inertance.diagnosis.verdict.all_records import alike_by_all
from inertance.diagnosis.verdict.cautions import cautions, led_astray
from inertance.diagnosis.verdict.decide import certain_part, decided
from inertance.diagnosis.verdict.gap import gaps
from inertance.identification import Accuracy, Campaign, Record
from numpy.typing import NDArray
from typer.testing import CliRunner

RIG = """
import inertance as ia


def rig():
    net = ia.Network("rig", spring=ia.Spring(k=800.0), wall=ia.Fixed())
    net.add(carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.push.flange)
"""
TOML = """
model = "rig.py:rig"
train = [{ file = "1.csv", initial = "rest" }]
test = [{ file = "2.csv", initial = "rest" }]
channels = { F = { input = "push.f", unit = "N" }, x = { output = "carriage.s", unit = "m" } }
parameters = { "spring.k" = { rel = 0.2 } }
"""
CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
NOISE, LIFT = 2e-5, 0.5
BEGUN = {"initial": "rest", "offset": ["x"]}


class Case:
    """A carriage that rubs, its model, and fits of it; the position has an offset, as most have."""

    def __init__(self, rig: Any) -> None:
        records = []
        for seed in (1, 2, 3):
            run = rig.measured(rig.rubbing(), seed)
            lifted = {**run.values, "x": run.values["x"] + LIFT}
            records.append(Record(f"run {seed}", run.time, lifted))
        self.campaign = Campaign(
            rig.rig(),
            CHANNELS,
            {"spring.k": {"rel": 0.2}},
            [{"record": records[0], **BEGUN}],
            [{"record": record, **BEGUN} for record in records[1:]],
            noise={"x": NOISE},
        )
        self.study = Study(self.campaign, Accuracy())
        nominal = JointFit(self.study, self.campaign.start)
        self.start, self.base = nominal.seen(nominal.start), nominal.fitted()
        self.candidates = screen(self.study, self.base.parameters)
        self.friction = self.fitted("coulomb_friction")
        self.weak = self.fitted("sensor_gain")

    def fitted(self, *kinds: str) -> Refit:
        placed = []
        for kind in kinds:
            found = next(c for c in self.candidates if c.effect.kind == kind)
            placed.append(Hypothesis(found.effect, found.site, f"{kind}_1", found.values))
        return JointFit(self.study, self.base.parameters, placed).fitted()

    def verdict(self, best: Refit, *rounds: Round) -> Verdict:
        return decided(self.study, self.start, self.base, best, rounds, [], {})

    def round(self, base: Refit, *fitted: Refit) -> Round:
        return Round(base, list[Candidate](self.candidates), list(fitted))


def with_more(model: Refit, size: float) -> Refit:
    """Return a model that misses a sine besides, of a size in noise."""

    def more(records: list[dict[str, Any]]) -> list[dict[str, Any]]:
        return [{n: r + size * np.sin(0.7 * np.arange(len(r))) for n, r in one.items()} for one in records]

    return replace(model, train=more(model.train), test=more(model.test))


def test_a_special_case_is_needed_beside_its_generalisation_if_its_like_leaves_much_more(case: Case) -> None:
    plain = case.friction.effects[0]
    rich = replace(plain, effect=effect_of("stribeck_friction"))
    other = replace(plain, effect=effect_of("viscous_damping"))
    little, much = with_more(case.friction, 0.7), with_more(case.friction, 3.0)
    assert not _is_needed(plain, rich, case.friction, little)
    assert _is_needed(plain, other, case.friction, little)
    assert _is_needed(plain, rich, case.friction, much)
    assert not _is_needed(plain, other, case.friction, case.friction)


@pytest.fixture(scope="module")
def case(carriage: Callable[..., Any]) -> Case:
    return Case(carriage(rate=100.0, duration=4.0, noise=NOISE))


@pytest.fixture(scope="module")
def effect(case: Case) -> Verdict:
    return case.verdict(case.friction, case.round(case.base, case.friction))


@pytest.fixture(scope="module")
def partial(case: Case) -> Verdict:
    """Return the verdict where friction takes much, and something that was not found is left."""
    friction = with_more(case.friction, 30.0)
    weak = replace(
        case.weak, test=with_more(friction, -0.3).test, effects=(*friction.effects, *case.weak.effects)
    )
    return case.verdict(friction, case.round(case.base, friction), case.round(friction, weak))


@pytest.fixture(scope="module")
def unknown(case: Case) -> Verdict:
    return case.verdict(case.base, case.round(case.base, case.weak))


@pytest.mark.parametrize(("left", "asked"), [(3.0, False), (30.0, True)])
def test_nothing_is_sought_in_pieces_of_records_that_free_runs_follow(
    case: Case, partial: Verdict, monkeypatch: pytest.MonkeyPatch, left: float, asked: bool
) -> None:
    pieces = list[Verdict]()

    def noted(_: Study, verdict: Verdict) -> Verdict:
        pieces.append(verdict)
        return verdict

    monkeypatch.setattr(beyond, "_in_whole", lambda _, verdict, known: verdict)
    monkeypatch.setattr(beyond, "_in_pieces", noted)
    after = with_more(case.friction, left)
    found = replace(partial, evidence=replace(partial.evidence, after=after))
    assert beyond.beyond_the_list(case.study, found).effects == partial.effects
    assert bool(pieces) == asked


def test_shares_are_of_the_signal_about_its_mean(case: Case, effect: Verdict) -> None:
    """An angle far from 0 is not known better than one near 0; a share of its size would say so."""
    gap = effect.gap["x"]
    size = float(np.sqrt(np.mean([np.var(e.record.values["x"]) for e in case.campaign.testing])))
    assert size < 0.1 * LIFT
    assert gap.floor == pytest.approx(NOISE / size, rel=1e-3)
    assert gap.over_noise == pytest.approx(1.0, abs=0.1)
    assert list(gap.records) == ["run 2", "run 3"]
    assert gap.repeatable is None


def test_what_is_left_is_told_over_the_signal_and_over_the_noise() -> None:
    gap = Gap(0.16, 0.1, 0.005, 0.000625, "m", 0.02, {"a": 0.004, "b": 0.006}, 0.9)
    told = "0.5% of the signal (0.4 to 0.6% by record), 8 times the noise"
    assert gap.left == f"{told}; 90% of its square comes back in a repeat"
    assert gap.to_dict()["over_noise"] == pytest.approx(8.0)
    assert Gap(0.16, 0.1, 0.005, 0.000625, "m", 0.02).left == "0.5% of the signal, 8 times the noise"


@pytest.mark.parametrize(("common", "own", "share"), [(3.0, 0.0, 1.0), (0.0, 3.0, 0.0), (3.0, 3.0, 0.5)])
def test_what_comes_back_in_a_repeat_is_told_from_what_does_not(
    case: Case, tmp_path: Any, common: float, own: float, share: float
) -> None:
    rng = np.random.default_rng(5)
    header, files = "t,F,x", []
    for number, experiment in enumerate((case.campaign.training[0],) * 2):
        record = experiment.record
        files.append(tmp_path / f"{number}.csv")
        x = record.values["x"] + NOISE * rng.standard_normal(len(record.time))
        table = np.column_stack([record.time, record.values["F"], x])
        np.savetxt(files[-1], table, delimiter=",", header=header, comments="")
    one, other = ({"file": str(file), **BEGUN} for file in files)
    noise = {"x": NOISE}
    twice = Campaign(
        case.campaign.network,
        CHANNELS,
        {"spring.k": {"rel": 0.2}},
        [one, {**other, "repeat_of": one["file"]}],
        noise=noise,
    )
    count = len(case.base.train[0]["x"])
    same = rng.standard_normal(count)
    missed = [{"x": common * same + own * rng.standard_normal(count)} for _ in range(2)]
    model = replace(case.base, train=missed, test=[])
    found = gaps(replace(case.study, campaign=twice), model, model, model)["x"].repeatable
    assert found == pytest.approx(share, abs=0.08)


def test_what_is_left_is_partial_however_little_of_the_signal(case: Case, effect: Verdict) -> None:
    """0.8 % of the signal are many times the noise of a good sensor: told, and not passed over."""
    for share in (0.008, 0.05):
        size = np.sqrt(2) * share / effect.gap["x"].floor
        friction, base = with_more(case.friction, size), with_more(case.friction, 5 * size)
        found = decided(case.study, case.start, base, friction, [case.round(base, friction)], [], {})
        assert found.gap["x"].over_noise > 3
        assert found.closed < 0.93
        assert found.verdict == "partial"


def test_a_partial_verdict_tells_what_is_certain_and_what_came_closest(partial: Verdict) -> None:
    assert partial.verdict == "partial"
    assert partial.sentence.startswith("Part of what is missing is coulomb friction at guide, which closes ")
    assert "none of the known effects" not in partial.sentence
    assert partial.closest is partial.further[0]
    assert "Closest comes sensor gain at x: it takes " in partial.sentence
    assert "off the square of what is left on the test runs" in partial.sentence
    assert ("sensor_gain", "x") in [(kind, site) for kind, site, *_ in ruled_out(partial)]


def test_an_unknown_verdict_tells_what_came_closest_and_why_that_is_not_it(
    case: Case, unknown: Verdict
) -> None:
    assert unknown.verdict == "unknown"
    assert unknown.closest is not None
    assert unknown.closest.told == "sensor gain at x"
    assert unknown.closest.refused in unknown.sentence
    nothing = case.verdict(case.base, case.round(case.base))
    assert nothing.sentence == "Something is missing that no known effect explains."


@pytest.mark.parametrize("word", ["partial", "unknown"])
def test_the_remainder_is_told_wherever_something_is_left(
    word: str, request: pytest.FixtureRequest, tmp_path: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    verdict: Verdict = request.getfixturevalue(word)
    left = json.loads(verdict.save(tmp_path / "gap.json").read_text())["remainder"]
    assert {"share", "windows", "band", "regime"} <= left.keys()
    assert left["share"] == pytest.approx(1 - verdict.closed)
    page = write_report(verdict, tmp_path / "gap.html").read_text(encoding="utf-8")
    show(verdict)
    printed = " ".join(capsys.readouterr().out.split())
    for text in (verdict.remainder, verdict.gap["x"].left):
        assert text in page
        assert text in printed


def test_an_effect_has_no_remainder(effect: Verdict) -> None:
    assert effect.verdict == "effect"
    assert effect.to_dict()["remainder"] is None
    assert "from " in effect.sentence
    assert next(line for line in conclusion(effect) if line.startswith("Left: x: "))


def test_effects_in_the_ranking_carry_their_values(
    effect: Verdict, capsys: pytest.CaptureFixture[str]
) -> None:
    first = effect.to_dict()["ranking"][0]
    assert first["parameters"] == effect.effects[0].values
    show(effect)
    printed = capsys.readouterr().out
    assert f"f_c = {effect.effects[0].values['f_c']:.4g} N" in printed
    assert max(map(len, printed.splitlines())) <= 100


@pytest.mark.parametrize(
    ("gain", "p", "why"),
    [
        (-0.1, 0.9, "makes the test runs worse"),
        (0.2, 0.03, "1.9 standard errors"),
        (0.2, 1e-9, "is clear, but too little to be named"),
        (0.2, 0.9, "most of these runs would be worse for"),
    ],
)
def test_a_candidate_says_why_it_is_not_the_verdict(gain: float, p: float, why: str) -> None:
    assert why in Ranked("backlash", "guide", gain, p).refused


def test_what_is_clear_comes_before_what_is_large(unknown: Verdict) -> None:
    ranking = (Ranked("position_ripple", "guide", 0.09, 0.04), Ranked("friction_drift", "guide", 0.08, 1e-10))
    closest = replace(unknown, ranking=ranking).closest
    assert closest is not None
    assert closest.kind == "friction_drift"


def test_a_refit_that_runs_away_is_told(case: Case) -> None:
    away = replace(case.base, parameters={"spring.k": 800.0 * 6})
    told = list(led_astray(case.campaign, away))
    assert len(told) == 1
    assert "moves spring.k by 25 standard deviations" in told[0]
    assert not list(led_astray(case.campaign, case.base))
    found = decided(case.study, case.start, away, case.friction, [case.round(away, case.friction)], [], {})
    assert told[0] in found.notes


def test_many_stretches_are_told_by_record(unknown: Verdict) -> None:
    """Twenty stretches of 1 % each say nothing one by one."""
    short = [{"record": f"run {n % 2}", "from": n, "to": n + 0.5, "share": 0.05} for n in range(20)]
    many = replace(unknown, windows={**unknown.windows, "windows": short}).remainder
    assert "10 stretches of run 0 (50%), 10 stretches of run 1 (50%)" in many
    nothing = {**short[2], "share": 0.004}
    few = replace(unknown, windows={**unknown.windows, "windows": [*short[:2], nothing]}).remainder
    assert "run 0 0 to 0.5 s (5%), run 1 1 to 1.5 s (5%);" in few


def test_a_parameter_that_an_effect_replaces_is_no_wrong_bound(case: Case) -> None:
    campaign = replace(case.campaign, parameters={"guide.d": {"min": 0.0, "max": 60.0}})
    ended = replace(case.friction, parameters={"guide.d": 0.0})
    assert any("coulomb friction at guide takes the place" in line for line in cautions(campaign, ended))
    assert any(
        "the bound or the model is wrong" in line for line in cautions(campaign, replace(ended, effects=()))
    )


def test_progress_tells_how_long_it_took_and_what_is_left(
    carriage: Callable[..., Any], tmp_path: Any
) -> None:
    rig = carriage(rate=100.0, duration=2.0, noise=NOISE)
    for seed in (1, 2):
        record = rig.measured(rig.rubbing(), seed)
        table = np.column_stack([record.time, record.values["F"], record.values["x"]])
        np.savetxt(tmp_path / f"{seed}.csv", table, delimiter=",", header="t,F,x", comments="")
    (tmp_path / "rig.py").write_text(RIG)
    (tmp_path / "campaign.toml").write_text(TOML)
    command = f"diagnose {tmp_path / 'campaign.toml'} --jobs 1 --budget 0.1"
    told = CliRunner().invoke(app, command.split())
    assert re.search(r"refitting the parameters \(\d+ s, \d+ s left\)", told.stderr)


@dataclass
class Held:
    """A model beside test records, by what it misses of them."""

    misfit: float
    effects: Sequence[Any] = ()

    @property
    def blocks(self) -> NDArray[np.float64]:
        return np.full(10, self.misfit**2)

    @property
    def labels(self) -> list[str]:
        return [placed.label for placed in self.effects]

    def is_noise(self, _: Any) -> bool:
        return False


@pytest.mark.parametrize(
    ("misfits", "named"),
    [
        ((10.0, 1.05), 1),
        ((10.0, 3.0), 1),
        ((10.0, 5.0), 0),
        ((10.0, 3.0, 2.5), 1),
        ((10.0, 5.0, 4.0), 0),
        ((10.0, 5.0, 3.0), 2),
    ],
)
def test_each_effect_of_a_partial_verdict_takes_most_of_what_was_left(
    misfits: Sequence[float], named: int
) -> None:
    effects = [SimpleNamespace(label=str(number)) for number in range(len(misfits))]
    base, *further = (Held(misfit, effects[:n]) for n, misfit in enumerate(misfits))
    pruned = Held(9.0, [SimpleNamespace(label="pruned")])
    rounds: Any = [SimpleNamespace(base=model) for model in (base, pruned, *further)]
    best: Any = ([base, *further])[-1]
    study: Any = SimpleNamespace(judged=[], pieces=None)
    assert len(certain_part(best, cast(Any, base), rounds, study).effects) == named


def test_what_was_found_first_is_held_against_its_rivals_beside_what_was_found_since(case: Case) -> None:
    """Damping was taken for friction first; beside a gain it is exchanged, and the gain stays second."""
    damping = case.fitted("viscous_damping")
    both = case.fitted("viscous_damping", "sensor_gain")
    rounds = [case.round(case.base, damping, case.friction), case.round(damping, both)]
    better, _ = revised(both, rounds, Tried(case.study))
    assert [placed.effect.kind for placed in better.effects] == ["coulomb_friction", "sensor_gain"]
    assert len({placed.name for placed in better.effects}) == 2
    assert better.misfit < 1.1 < both.misfit
    kept, rivals = revised(better, [case.round(case.base, damping, case.friction)], Tried(case.study))
    assert kept is better
    alone = [case.round(case.base, damping), case.round(damping, both)]
    other, _ = revised(both, alone, Tried(case.study), anew=True)
    assert _kinds(other) == ["coulomb_friction", "sensor_gain"]
    named = {label: [_kinds(model) for model in models] for label, models in rivals.items()}
    assert [*named] == [better.effects[0].label]
    assert ["viscous_damping", "sensor_gain"] in named[better.effects[0].label]
    assert all(kinds[1:] == ["sensor_gain"] for kinds in named[better.effects[0].label])


def _kinds(model: Refit) -> list[str]:
    return [placed.effect.kind for placed in model.effects]


def test_what_parameters_owe_to_noise_of_the_training_tells_no_models_apart(case: Case) -> None:
    """Two names of one thing part on test records by more than stretches scatter, and on all by nothing."""
    friction, study = case.friction, case.study
    twin = replace(friction, test=with_more(friction, 0.05).test)
    assert 0 < abs(twin.blocks.sum() / friction.blocks.sum() - 1) < 0.01
    assert [*alike_by_all(study, friction, [twin, case.weak])] == [twin]
    alone = copy(study.campaign)
    alone.testing = []
    assert [*alike_by_all(replace(study, campaign=alone), friction, [twin])] == []


def test_a_class_holds_what_is_as_good_in_the_place_of_either_effect(case: Case) -> None:
    both = case.fitted("coulomb_friction", "sensor_gain")
    rival = replace(case.fitted("viscous_damping", "sensor_gain"), train=both.train, test=both.test)
    rounds = [case.round(case.base, case.friction), case.round(case.friction, both)]
    label = both.effects[0].label
    told = decided(case.study, case.start, case.base, both, rounds, [], {label: [rival]})
    assert told.verdict == "ambiguous"
    assert told.equivalent[0][0] == "viscous_damping"
    worse = with_more(rival, 3.0)
    told = decided(case.study, case.start, case.base, both, rounds, [], {label: [worse]})
    assert told.verdict == "effect"
    assert told.equivalent == ()


def test_a_law_that_no_run_follows_takes_no_effects_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside another law it was taken all the same, which ended the diagnosis in an error without words."""
    placed: Any = SimpleNamespace(label="position_ripple at guide")
    model: Any = SimpleNamespace(effects=[placed])
    study: Any = SimpleNamespace(tell=lambda line: None)
    monkeypatch.setattr(beyond, "without", lambda study, placed, model: model)
    monkeypatch.setattr(beyond, "in_place", lambda *given: SimpleNamespace(law=object(), model=None))
    assert beyond._sought_without(study, model, [placed]) is None
