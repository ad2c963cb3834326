"""Play behind a stiff screw: a machine that rattles, which no free run follows for long."""

from itertools import pairwise
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.diagnosis import Verdict
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.law.in_pieces import InPieces
from inertance.diagnosis.law.likened import likened_in_series
from inertance.diagnosis.law.missing_force import force_of
from inertance.diagnosis.law.pieces import Follower
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.verdict.beyond import beyond_the_list
from inertance.diagnosis.verdict.decide import decided
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

RATE, SECONDS, EPS = 500.0, 4.0, 0.009
NOISE = {"w": 0.004, "angle": 0.001}


def screw(play: float = 0.0, bearing: float = 0.12) -> ia.Network:
    """Return a motor that turns a load through a stiff screw; with play its flanks press at once."""
    stiff = rotational.SpringDamper(c=6000.0, d=0.6)
    coupling = rotational.ElastoBacklash2(c=6000.0, d=0.6, b=2 * play) if play else stiff
    net = ia.Network("screw", frame=rotational.Fixed(), motor=rotational.Inertia(J=0.02), coupling=coupling)
    net.add(bearing=rotational.Damper(d=bearing), brake=rotational.Damper(d=0.1))
    net.add(load=rotational.Inertia(J=0.03), drive=rotational.Torque())
    net.connect(net.frame.flange, net.bearing.flange_a, net.brake.flange_a)
    net.connect(net.bearing.flange_b, net.motor.flange, net.coupling.flange_a, net.drive.flange)
    return net.connect(net.coupling.flange_b, net.load.flange, net.brake.flange_b)


def records() -> list[dict[str, Any]]:
    """Return records of the screw with play, begun in motion, by a clock that is late."""
    true, rng, found = screw(EPS, bearing=0.13), np.random.default_rng(5), []
    for number in range(4):
        shape = Multisine(rms=1.3 - 0.1 * number, low=0.4, high=7.0, period=SECONDS + 1, seed=number)
        torque = sampled(shape, stop=SECONDS + 1, rate=RATE, fade=0.3)
        t = np.asarray(torque.time)
        pushed = {"drive.tau": torque}
        run = true.simulate(SECONDS + 1, step=1 / RATE, inputs=pushed, rtol=1e-9, atol=1e-12)
        kept, seen = t >= 1.0, {"w": run.at("motor.w", t), "angle": run.at("load.phi", t)}
        noisy = {name: y + NOISE[name] * rng.standard_normal(len(t)) for name, y in seen.items()}
        values = {"u": np.asarray(torque.values), **noisy}
        found.append(
            {"record": Record(f"run {number}", t[kept] + 40.0, {n: v[kept] for n, v in values.items()})}
        )
    return found


@pytest.fixture(scope="module")
def study() -> Study:
    """Return the records, whose noise nobody states, beside a model without play."""
    known = records()
    channels = {
        "u": {"input": "drive.tau", "unit": "N.m"},
        "w": {"output": "motor.w", "unit": "rad/s"},
        "angle": {"output": "load.phi", "unit": "rad"},
    }
    priors = {"bearing.d": {"rel": 0.2}, "brake.d": {"rel": 0.2}}
    return Study(Campaign(screw(), channels, priors, known[:2], known[2:]), Accuracy(foreseen=10**6))


@pytest.fixture(scope="module")
def base(study: Study) -> Refit:
    return JointFit(study, study.campaign.start).fitted()


@pytest.fixture(scope="module")
def verdict(study: Study, base: Refit) -> Verdict:
    """Return the verdict where free runs with anything of the list came to nothing."""
    start = JointFit(study, study.campaign.start)
    unknown = decided(study, start.seen(start.start), base, base, [], [], {})
    assert unknown.verdict == "unknown"
    return beyond_the_list(study, unknown)


def test_its_noise_is_read_beside_its_impacts(study: Study) -> None:
    """They fill the spectrum to the top, with ten times as much."""
    told = study.campaign.sigma
    assert NOISE["w"] < told["w"] < 1.6 * NOISE["w"]
    assert told["angle"] == pytest.approx(NOISE["angle"], rel=0.1)


def test_the_missing_force_takes_off_the_screw_what_it_bears(study: Study, base: Refit) -> None:
    missing = force_of(study, base)
    assert missing.site.path == "coupling"
    assert missing.misfit < 2.0 < missing.before
    (play,) = (one for one in likened_in_series(missing, base) if one.effect.kind == "backlash")
    assert play.values["eps"] == pytest.approx(EPS, rel=0.3)


def test_play_is_told_at_the_screw_where_the_force_is_sought_at_the_damper_beside_it(
    study: Study, base: Refit
) -> None:
    drawn: Any = None
    found = InPieces(study, base, force_of(study, base, "brake"), drawn, {})
    assert found.in_series == []
    screw = found.at_spring()
    assert screw is not None
    assert screw.missing.site.path == "coupling"
    assert screw.at_spring() is None
    (play,) = (one for one in likened_in_series(screw.missing, base) if one.effect.kind == "backlash")
    assert play.values["eps"] == pytest.approx(EPS, rel=0.3)


def test_what_is_in_series_may_have_states_that_the_model_without_it_has_not(
    study: Study, base: Refit
) -> None:
    missing = force_of(study, base)
    values = {"compliance": 1e-4}
    soft = Hypothesis(effect_of("compliance"), missing.site, "compliance_1", values)
    follower = Follower.of(study, missing, missing.by_position, soft, base.parameters)
    _, part = next(follower.spread(missing.settled.runs[0], 4, 60))
    run = follower.bench.run(part, base.parameters, follower.bench.begin(part, base.parameters, {}))
    assert run.begin.start is not None
    assert len(run.begin.start) > len(follower.states)
    assert 0.1 < follower._bare(run) < 1e4


def test_pieces_in_which_a_run_follows_share_no_instant(verdict: Verdict) -> None:
    pieces = verdict.evidence.campaign.experiments
    assert len(pieces) > 8
    for one, after in pairwise(sorted(pieces, key=lambda e: (e.source, e.compared.time[0]))):
        assert one.source != after.source or one.compared.time[-1] <= after.compared.time[0]


def test_play_is_named_by_pieces_of_the_records(verdict: Verdict) -> None:
    (placed,) = verdict.effects
    assert verdict.verdict in ("effect", "ambiguous")
    assert (placed.effect.kind, placed.site.path) == ("backlash", "coupling")
    assert placed.values["eps"] == pytest.approx(EPS, rel=0.05)
    assert verdict.closed > 0.9
    assert "pieces of 4 records" in str(verdict)


def test_parts_of_a_record_share_no_instant(study: Study, base: Refit) -> None:
    """However many are asked for, none is judged by what another one is."""
    missing = force_of(study, base)
    (play,) = (one for one in likened_in_series(missing, base) if one.effect.kind == "backlash")
    placed = Hypothesis(play.effect, play.site, "backlash_1", play.values)
    follower = Follower.of(study, missing, missing.by_position, placed, play.parameters)
    along = missing.settled.runs[0]
    for count, most in ((24, 500), (1000, 500), (1000, 10**6), (1, 10**6)):
        parts = [(begin, len(part.compared.time)) for begin, part in follower.spread(along, count, most)]
        assert all(begin + length - 1 <= later for (begin, length), (later, _) in pairwise(parts))
        assert 0 < len(parts) <= count


def axis(play: float = 0.0, guide: float = 9.0) -> ia.Network:
    """Return a nut that pushes a table by a stiff rod, which is 120 mm long at rest."""
    made: dict[str, Any] = {"k": 2e5, "d": 20.0, "s_rel0": 0.12}
    rod = ia.ElastoBacklash(b=2 * play, **made) if play else ia.SpringDamper(**made)
    net = ia.Network("axis", frame=ia.Fixed(), nut=ia.Mass(m=0.9), rod=rod, table=ia.Mass(m=1.4))
    net.add(guide=ia.Damper(d=guide), way=ia.Damper(d=7.0), push=ia.Force())
    net.connect(net.frame.flange, net.guide.flange_a, net.way.flange_a)
    net.connect(net.guide.flange_b, net.nut.flange, net.rod.flange_a, net.push.flange)
    return net.connect(net.rod.flange_b, net.table.flange, net.way.flange_b)


def test_play_of_a_rod_is_seen_through_its_length_an_offset_and_another_clock() -> None:
    rng, seconds, play = np.random.default_rng(2), 6.0, 4e-4
    shape = Multisine(rms=30.0, low=0.4, high=7.0, period=seconds + 1, seed=0)
    force = sampled(shape, stop=seconds + 1, rate=RATE, fade=0.3)
    t = np.asarray(force.time)
    run = axis(play, 9.8).simulate(
        seconds + 1, step=1 / RATE, inputs={"push.f": force}, start={"nut.s": 0.0, "table.s": 0.12},
        rtol=1e-9, atol=1e-12,
    )  # fmt: skip
    speed = run.at("nut.v", t) + 3e-4 * rng.standard_normal(len(t))
    place = run.at("table.s", t) + 7e-3 + 3e-5 * rng.standard_normal(len(t))
    values = {"F": np.asarray(force.values), "v": speed, "x": place}
    record = Record("run", t[t >= 1.0] - 3.0, {name: value[t >= 1.0] for name, value in values.items()})
    channels = {
        "F": {"input": "push.f", "unit": "N"},
        "v": {"output": "nut.v", "unit": "m/s"},
        "x": {"output": "table.s", "unit": "m"},
    }
    priors = {"guide.d": {"rel": 0.2}, "way.d": {"rel": 0.2}}
    measured = Campaign(axis(), channels, priors, [{"record": record, "offset": ["x"]}], [])
    study = Study(measured, Accuracy())
    base = JointFit(study, measured.start).fitted()
    missing = force_of(study, base)
    assert missing.site.path == "rod"
    assert missing.misfit < 1.0 < missing.before
    likest = likened_in_series(missing, base)[0]
    assert likest.effect.kind == "backlash"
    assert likest.values["eps"] == pytest.approx(play, rel=0.05)
