"""Records in pieces: what no free run follows is learnt there, and named; a machine held by valleys."""

from copy import copy
from dataclasses import replace
from itertools import pairwise
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import Verdict
from inertance.diagnosis.criteria import PIECE_SAMPLES
from inertance.diagnosis.law import missing_force, pieces
from inertance.diagnosis.law.in_pieces import InPieces
from inertance.diagnosis.law.missing_force import MissingForce, force_of
from inertance.diagnosis.law.pieces import Follower
from inertance.diagnosis.law.polish import placed
from inertance.diagnosis.law.search import Search
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.verdict.beyond import beyond_the_list
from inertance.diagnosis.verdict.decide import decided
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

from .test_law_verdict import campaign as of_carts

RATE, SECONDS = 250.0, 4.0
FORCE, PERIOD, NOISE = 22.0, 0.018, 1.5e-5


def slide(k: float = 900.0, held: bool = False) -> ia.Network:
    net = ia.Network("slide", wall=ia.Fixed(), spring=ia.SpringDamper(k=k, d=9.0), block=ia.Mass(m=1.6))
    net.add(push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.block.flange, net.push.flange)
    if held:
        net.add(thread=ia.Ripple(f_sin=FORCE, period=PERIOD))
        net.connect(net.wall.flange, net.thread.flange_a).connect(net.thread.flange_b, net.block.flange)
    return net


def records(true: ia.Network) -> list[dict[str, Any]]:
    """Return records of a block, begun in motion; the clock is late."""
    rng, found = np.random.default_rng(3), []
    for number in range(3):
        shape = Multisine(rms=14.0 - number, low=0.3, high=6.0, period=SECONDS + 1, seed=number)
        force = sampled(shape, stop=SECONDS + 1, rate=RATE, fade=0.3)
        t = np.asarray(force.time)
        pushed = {"push.f": force}
        run = true.simulate(SECONDS + 1, step=1 / RATE, inputs=pushed, rtol=1e-10, atol=1e-12)
        seen = np.interp(t, run.time, run["block.s"]) + NOISE * rng.standard_normal(len(t))
        kept = t >= 1.0
        values = {"F": np.asarray(force.values)[kept], "x": seen[kept]}
        found.append({"record": Record(f"run {number}", t[kept] + 40.0, values)})
    return found


def campaign(true: ia.Network) -> Campaign:
    """Return records of a block beside a model that says that it is held by nothing."""
    known = records(true)
    return Campaign(
        slide(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "block.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.1}, "spring.d": {"rel": 0.1}},
        train=known[:2],
        test=known[2:],
        noise={"x": NOISE},
    )


@pytest.fixture(scope="module")
def study() -> Study:
    """Return the study of a block that moves from valley to valley."""
    return Study(campaign(slide(950.0, held=True)), Accuracy(foreseen=10**6))


@pytest.fixture(scope="module")
def verdict(study: Study) -> Verdict:
    """Return the verdict where free runs with anything of the list came to nothing."""
    nominal = JointFit(study, study.campaign.start)
    start, base = nominal.seen(nominal.start), nominal.fitted()
    unknown = decided(study, start, base, base, [], [], {})
    assert unknown.verdict == "unknown"
    return beyond_the_list(study, unknown)


def test_what_no_free_run_follows_is_named_by_pieces(verdict: Verdict) -> None:
    (placed,) = verdict.effects
    assert verdict.verdict in ("effect", "ambiguous")
    assert placed.effect.kind == "position_ripple"
    assert placed.values["period"] == pytest.approx(PERIOD, rel=1e-2)
    assert np.hypot(placed.values["f_sin"], placed.values["f_cos"]) == pytest.approx(FORCE, rel=0.03)
    assert verdict.parameters["spring.k"] == pytest.approx(950.0, rel=0.05)
    assert verdict.closed > 0.97


def test_it_says_by_which_pieces_it_is_judged(verdict: Verdict) -> None:
    longest = verdict.evidence.study.pieces
    assert longest is not None
    count = len(verdict.evidence.campaign.experiments)
    assert f"judged by {count} pieces of 3 records, {longest:.3g} s long at most" in str(verdict)
    assert verdict.to_dict()["pieces"] == longest
    assert all(", " in record for gap in verdict.gap.values() for record in gap.records)


def test_pieces_are_whole_records_and_begin_where_the_machine_is(study: Study, verdict: Verdict) -> None:
    campaign = verdict.evidence.campaign
    assert len(campaign.experiments) > len(study.campaign.experiments)
    for whole in study.campaign.experiments:
        parts = [part for part in campaign.experiments if part.source == whole.source]
        assert parts[0].record.time[0] == whole.record.time[0]
        assert parts[-1].record.time[-1] == whole.record.time[-1]
        assert all(a.record.time[-1] == b.record.time[0] for a, b in pairwise(parts))
        assert all(len(part.compared.time) > PIECE_SAMPLES for part in parts)
        measured = [part.compared.values["x"][0] for part in parts]
        begun = [part.motion["block.s"] for part in parts]
        assert np.abs(np.subtract(measured, begun)).max() < 30 * NOISE


@pytest.fixture(scope="module")
def untested(study: Study) -> Study:
    """Return the study without its test record."""
    campaign = copy(study.campaign)
    campaign.testing = []
    return Study(campaign, study.accuracy)


@pytest.fixture(scope="module")
def base(untested: Study) -> Refit:
    return JointFit(untested, untested.campaign.start).fitted()


@pytest.fixture(scope="module")
def missing(untested: Study, base: Refit) -> MissingForce:
    return force_of(untested, base)


def test_records_without_a_test_among_them_are_cut_as_well(
    untested: Study, base: Refit, missing: MissingForce
) -> None:
    cut = InPieces(untested, base, missing, missing.by_position, {}).cut_by_law()
    assert cut is not None
    assert not cut.campaign.testing
    assert {part.source for part in cut.campaign.training} == {e.source for e in untested.campaign.training}


def test_parts_are_taken_of_a_record_that_would_fall_into_many_pieces(
    untested: Study, missing: MissingForce, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pieces, "PIECES", 0)
    monkeypatch.setattr(pieces, "PIECES_AT_FIRST", 0)
    law = missing.by_position
    follower = Follower.of(untested, missing, law, placed(law), law.given)
    cut = pieces.cut(untested, follower, missing.settled.runs)
    for whole in untested.campaign.training:
        parts = [part for part in cut.campaign.training if part.source == whole.source]
        assert parts
        assert all(a.record.time[-1] <= b.record.time[0] for a, b in pairwise(parts))
        assert all(len(part.compared.time) > PIECE_SAMPLES for part in parts)


def test_the_force_is_found_beside_parameters_far_from_where_they_were_given() -> None:
    """A block that stays in one valley seems to be on a far stiffer spring, neared step by step."""
    stiff = Study(campaign(slide(7900.0)), Accuracy(foreseen=10**6))
    given = JointFit(stiff, stiff.campaign.start)
    missing = force_of(stiff, given.seen(given.start))
    assert missing.misfit < 1.1 < 10 < missing.before


def test_the_force_is_found_where_a_fit_without_it_has_gone_astray(untested: Study, base: Refit) -> None:
    astray = replace(base, parameters={"spring.k": 0.0, "spring.d": 2500.0})
    found = force_of(untested, astray)
    assert found.misfit < 1.4 < 10 < found.before
    assert found.by_position.explained > 0.98


def test_a_force_that_was_found_stays_where_another_place_to_seek_it_from_fails(
    untested: Study, base: Refit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(missing_force, "FORCE_SUFFICES", 0.0)
    begun = []

    def fails_next(*given: Any) -> Search:
        begun.append(given)
        if len(begun) > 1:
            raise ia.SimulationError("the parameters that were given cannot be run")
        return Search(*given)

    monkeypatch.setattr(missing_force, "Search", fails_next)
    assert force_of(untested, base).misfit < 2.0
    assert len(begun) == 2


def test_windows_of_one_file_begin_each_where_it_does() -> None:
    whole = of_carts(lacks=True)
    windows = [
        {"record": experiment.record, "window": [begin, begin + 3.0]}
        for experiment in whole.training
        for begin in (31.0, 34.0)
    ]
    model, outputs = (
        whole.network,
        {name: {"output": f"{name}.s", "unit": "m"} for name in ("cart", "second")},
    )
    cut = Campaign(
        model,
        channels={"F": {"input": "push.f", "unit": "N"}, **outputs},
        parameters={"spring.k": {"rel": 0.1}, "link.d": {"rel": 0.2}},
        train=windows,
        test=[{"record": experiment.record} for experiment in whole.testing],
        noise={name: 5e-5 for name in outputs},
    )
    study = Study(cut, Accuracy(foreseen=10**6))
    law, misfit = force_of(study, JointFit(study, cut.start).fitted()).polished()
    assert (law.site.path, law.variables) == ("link", ("speed",))
    assert misfit < 2.0


def test_a_part_of_a_record_keeps_what_is_compared_and_what_is_not() -> None:
    (whole, *_) = of_carts(lacks=False).training
    part = whole.part(100, 300, {"cart.s": 1e-3})
    assert np.array_equal(part.compared.values["cart"], whole.compared.values["cart"][100:301])
    assert part.window == (whole.compared.time[100], whole.compared.time[300])
    assert (part.initial, part.motion) == ("fit", {"cart.s": 1e-3})
