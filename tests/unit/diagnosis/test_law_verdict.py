"""A verdict beyond the list: a law of its own where one acts, none where none does, and what is told."""

import re
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from fmpy import simulate_fmu
from inertance.analysis import linearise
from inertance.cli.diagnose import show
from inertance.diagnosis import Verdict, write_report
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.investigation import Investigation
from inertance.diagnosis.law.in_pieces import InPieces, refitted
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.report.text import advice
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.tried import Tried
from inertance.diagnosis.verdict.beyond import beyond_the_list
from inertance.diagnosis.verdict.decide import decided
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

NOISE, RATE, SECONDS, BEGINS = 5e-5, 200.0, 6.0, 31.0


class Odd(ia.CompliantWithSpeed):
    """A law that no list has: f = 4 tanh((v - 0.1)/0.05) + 4 tanh(2) + 2 tanh((v + 0.3)/0.1) - 2 tanh(3)."""

    def equations(self) -> Any:
        v = self.v_rel
        steps = 4 * (ca.tanh((v - 0.1) / 0.05) + np.tanh(2)) + 2 * (ca.tanh((v + 0.3) / 0.1) - np.tanh(3))
        yield self.f == steps


def odd(v: Any) -> Any:
    return 4 * (np.tanh((v - 0.1) / 0.05) + np.tanh(2)) + 2 * (np.tanh((v + 0.3) / 0.1) - np.tanh(3))


def carts(k: float = 400.0, lacks: bool = False) -> ia.Network:
    net = ia.Network("carts", wall=ia.Fixed(), spring=ia.SpringDamper(k=k, d=6.0), push=ia.Force())
    net.add(cart=ia.Mass(m=1.0), link=ia.SpringDamper(k=900.0, d=3.0), second=ia.Mass(m=0.7))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.cart.flange, net.push.flange, net.link.flange_a)
    net.connect(net.link.flange_b, net.second.flange)
    if lacks:
        net.add(extra=Odd())
        net.connect(net.cart.flange, net.extra.flange_a).connect(net.second.flange, net.extra.flange_b)
    return net


def campaign(lacks: bool, knocked: float = 0.0) -> Campaign:
    """Return records that begin in motion, late by the clock; a knock is not measured."""
    true, rng, records = carts(430.0, lacks), np.random.default_rng(5), []
    for number in range(3):
        size = 9.0 - number
        shape = Multisine(rms=size, low=0.4, high=5.0, period=3.0, seed=number)
        force = sampled(shape, stop=SECONDS + 1, rate=RATE, fade=0.3)
        t = np.asarray(force.time)
        knock = knocked * np.exp(-(((t - 3 - number / 2) / 0.15) ** 2)) * np.sin(20 * t)
        pushed = {"push.f": ia.Sampled(t, np.asarray(force.values) + knock)}
        run = true.simulate(SECONDS + 1, step=1 / RATE, inputs=pushed)
        kept = t >= 1.0
        noise = NOISE * rng.standard_normal((2, len(t)))
        seen = {
            name: (np.interp(t, run.time, run[f"{name}.s"]) + own)[kept]
            for name, own in zip(("cart", "second"), noise, strict=True)
        }
        values = {"F": np.asarray(force.values)[kept], **seen}
        records.append({"record": Record(f"run {number}", t[kept] + BEGINS, values)})
    outputs = {name: {"output": f"{name}.s", "unit": "m"} for name in ("cart", "second")}
    return Campaign(
        carts(),
        channels={"F": {"input": "push.f", "unit": "N"}, **outputs},
        parameters={"spring.k": {"rel": 0.1}, "link.d": {"rel": 0.2}},
        train=records[:2],
        test=records[2:],
        noise=dict.fromkeys(outputs, NOISE),
    )


def verdict_on(records: Campaign) -> Verdict:
    """Return the verdict where nothing of the list was worth a fit."""
    study = Study(records, Accuracy())
    nominal = JointFit(study, records.start)
    start, base = nominal.seen(nominal.start), nominal.fitted()
    plain = decided(study, start, base, base, [], [], {})
    assert plain.verdict == "unknown"
    assert plain.to_dict()["law"] is None
    return beyond_the_list(study, plain)


@pytest.fixture(scope="module")
def lawful() -> Verdict:
    """Return the verdict on two carts with a law of speed between them."""
    return verdict_on(campaign(lacks=True))


@pytest.fixture(scope="module")
def knocked() -> Verdict:
    """Return the verdict on carts that were knocked once in each record."""
    return verdict_on(campaign(lacks=False, knocked=40.0))


def test_a_law_that_no_list_has_is_the_verdict(lawful: Verdict) -> None:
    law = lawful.law
    assert lawful.verdict == "law"
    assert law is not None
    assert (law.site.path, law.variables) == ("link", ("speed",))
    assert lawful.closed > 0.95
    assert lawful.effects == ()
    speed = np.concatenate([motion.v for motion in law.motions])
    v = np.linspace(float(np.quantile(speed, 0.05)), float(np.quantile(speed, 0.95)), 60)
    true = odd(v) + (3.0 - lawful.parameters["link.d"]) * v
    found = law.grid.axes[0].basis(v) @ law.values
    assert np.abs(found - true).max() < 0.02 * np.ptp(true)
    told = lawful.to_dict()["law"]
    assert (told["site"], told["variables"], told["units"]) == ("link", ["speed"], ["m/s", "N"])
    assert told["closed"] == lawful.closed
    assert len(told["standard_error"]) == len(told["table"])
    assert "a law of speed at link" in lawful.sentence
    assert lawful.to_dict()["no_law"] is None
    assert lawful.to_dict()["remainder"] is None
    assert not lawful.standard_errors
    assert not lawful.intervals()
    assert lawful.to_dict()["standard_errors"] == {}


def with_effects(word: str, **values: dict[str, float]) -> tuple[Study, Verdict]:
    """Return a verdict that names effects at the link, fitted from values of their own."""
    records = campaign(lacks=True)
    study = Study(records, Accuracy())
    nominal = JointFit(study, records.start)
    start, base = nominal.seen(nominal.start), nominal.fitted()
    (site,) = (site for site in study.sites if site.path == "link")
    there = [
        Hypothesis(effect_of(kind), site, f"{kind}_{k}", own) for k, (kind, own) in enumerate(values.items())
    ]
    best = JointFit(study, base.parameters, there).fitted()
    plain = decided(study, start, base, base, [], [], {})
    return study, replace(
        plain,
        verdict=word,
        effects=best.effects,
        confidence=(0.9,) * len(there),
        equivalent=(("cubic_damping", "link"),),
        evidence=replace(plain.evidence, after=best),
    )


@pytest.mark.parametrize(
    ("word", "effects"),
    [
        ("partial", {"quadratic_damping": {"c": 5.0}}),
        ("effect", {"quadratic_damping": {"c": 5.0}, "cubic_stiffness": {"k3": 100.0}}),
    ],
)
def test_a_law_takes_the_place_of_effects_that_are_laws_like_it(word: str, effects: Any) -> None:
    """Damping was called certain: the force that is left beside it has a law, and so has their sum."""
    found = beyond_the_list(*with_effects(word, **effects))
    assert found.verdict == "law"
    assert found.law is not None
    assert found.law.site.path == "link"
    assert (found.effects, found.confidence, found.equivalent) == ((), (), ())
    assert found.closed > 0.95


def test_a_law_alone_ends_the_search_before_a_third_effect() -> None:
    study, named = with_effects("partial", quadratic_damping={"c": 5.0}, cubic_stiffness={"k3": 100.0})
    told, evidence = list[str](), named.evidence
    study = replace(study, report=told.append)
    given = study, evidence.nominal, evidence.refit, evidence.after, Tried(study)
    found = Investigation(*given)
    found.run()
    assert found.rounds == []
    verdict = found.decided()
    assert (verdict.verdict, verdict.effects) == ("law", ())
    assert verdict.law is not None
    assert verdict.law.site.path == "link"
    assert told.count("looking for a law of its own") == 1


def test_a_law_that_follows_training_records_is_judged_as_it_is_in_pieces(lawful: Verdict) -> None:
    assert lawful.sought is not None
    study, refit = lawful.evidence.study, lawful.evidence.refit
    inside = InPieces.of(study, refit, lawful.sought)
    assert inside is not None
    assert inside.follows
    assert (inside.in_series, inside.across, inside.at_spring()) == ([], [], None)
    assert inside.law is not None
    pieces = inside.cut_by_law()
    assert pieces is not None
    found = inside.sought(pieces, refitted(pieces, refit)[1])
    assert found is not None
    assert found.law is not None, found.refused
    assert (found.law.values == inside.law.values).all()


@pytest.mark.parametrize(
    ("listed", "closed", "named"),
    [
        ("effect", 0.9, "listed"),
        ("partial", 0.8, "law"),
        ("partial", 0.93, "listed"),
        ("", 0.0, "law"),
    ],
)
def test_a_law_in_pieces_is_named_before_a_part_of_it(
    monkeypatch: pytest.MonkeyPatch, lawful: Verdict, listed: str, closed: float, named: str
) -> None:
    beyond = import_module("inertance.diagnosis.verdict.beyond")
    law, part = replace(lawful, closed=0.95), replace(lawful, verdict=listed, closed=closed)
    monkeypatch.setattr(beyond, "_listed_in_pieces", lambda *_: part if listed else None)
    monkeypatch.setattr(beyond, "_law_in_pieces", lambda *_: law)
    found = beyond._in_pieces(lawful.evidence.study, lawful)
    assert found is {"law": law, "listed": part}[named]


def test_one_effect_that_is_named_stays() -> None:
    study, named = with_effects("effect", quadratic_damping={"c": 5.0})
    assert beyond_the_list(study, named) is named


def test_the_network_with_the_law_runs_linearises_and_is_an_fmu(lawful: Verdict, tmp_path: Path) -> None:
    network = lawful.corrected()
    true = carts(430.0, lacks=True)
    shape = Multisine(rms=8.0, low=0.4, high=5.0, period=3.0, seed=9)
    push = {"push.f": sampled(shape, stop=3.0, rate=RATE, fade=0.3)}
    runs = [
        net.simulate(3.0, step=0.01, inputs=push, parameters=values)
        for net, values in ((network, lawful.parameters), (true, {}), (carts(), lawful.parameters))
    ]
    missed = [float(np.std(run["second.s"] - runs[1]["second.s"])) for run in runs]
    assert missed[2] > 10 * NOISE
    assert missed[0] < 0.1 * missed[2]
    linear = linearise(network, ["push.f"], ["cart.s"])
    usual = linearise(true, ["push.f"], ["cart.s"])  # at rest the law has a corner, so damping has two values
    found, expected = (np.sort(np.abs(np.linalg.eigvals(one.A))) for one in (linear, usual))
    assert np.allclose(found, expected, rtol=0.1)
    net = carts()
    exec("from inertance import TabulatedForce\n" + "\n".join(lawful.lines), {"net": net})
    again = net.simulate(3.0, step=0.01, inputs=push, parameters=lawful.parameters)
    assert np.allclose(again["second.s"], runs[0]["second.s"], atol=1e-9)
    path = ia.export_fmu(network, tmp_path / "carts.fmu", outputs=["second.s"])
    found = simulate_fmu(str(path), stop_time=1.0, output_interval=0.01, start_values={"push.f": 5.0})
    own = network.simulate(1.0, step=0.01, inputs={"push.f": lambda t: 5.0})
    assert found["second.s"][-1] == pytest.approx(own["second.s"][-1], rel=1e-4)


def test_a_knock_is_no_law(knocked: Verdict) -> None:
    assert knocked.verdict == "unknown"
    assert knocked.law is None
    told = knocked.to_dict()
    assert told["law"] is None
    assert max(told["no_law"]["foreseen"].values()) < 0.5
    windows = told["no_law"]["force"]["windows"]
    assert {window["record"] for window in windows} == {"run 0", "run 1"}
    for window in windows:
        middle = BEGINS + 3 + int(window["record"][-1]) / 2
        assert middle - 0.8 < window["from"] < window["to"] < middle + 0.8
    assert "No static law of position and speed" in knocked.sentence
    assert knocked.sought is not None
    assert "of its square in run 0" in knocked.sought.active


def test_no_law_is_sought_when_time_is_over(knocked: Verdict) -> None:
    plain = replace(knocked, sought=None)
    study = replace(knocked.evidence.study, deadline=-np.inf)
    assert beyond_the_list(study, plain) is plain


def test_both_are_shown(lawful: Verdict, knocked: Verdict, tmp_path: Path, capsys: Any) -> None:
    for verdict, drawn in ((lawful, ["law"]), (knocked, ["force-time", "force-position", "force-speed"])):
        page = write_report(verdict, tmp_path / f"{verdict.verdict}.html").read_text(encoding="utf-8")
        sections = re.findall(r'<section id="([a-z-]+)"', page)
        assert sections[:2] == ["verdict", "force"]
        figures = re.findall(r'data-figure="([a-z0-9-]+)"', page)
        assert figures[: len(drawn)] == drawn
    show(lawful)
    told = capsys.readouterr().out
    assert told.startswith("law: ")
    assert "TabulatedForce" in told
    assert max(map(len, told.splitlines())) < 600
    assert "straight guess" in advice(lawful)
