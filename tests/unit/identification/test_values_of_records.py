"""Parameters of which each record has an unknown value of its own, against equations of motion in SciPy."""

from collections.abc import Mapping, Sequence
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.models.study import study_of
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.identification import Accuracy, Campaign, Fit, Record
from scipy.integrate import solve_ivp

M1, M2, K1, K2, D1, D2 = 2.0, 0.7, 900.0, 400.0, 6.0, 2.0
NOISE = {"x": 2e-5, "y": 3e-5}
CHANNELS = {
    "F": {"input": "push.f", "unit": "N"},
    "x": {"output": "slide.s", "unit": "mm"},
    "y": {"output": "tip.s", "unit": "m"},
}
SHARED = {"near.k": {"rel": 0.2}, "far.k": {"rel": 0.2}}
OWN: dict[str, Any] = {
    "near.s_rel0": {"min": -0.05, "max": 0.05, "per": "record"},
    "far.s_rel0": {"rel": 0.3, "per": "record"},
}


def model(settled: bool = False) -> ia.Network:
    free: dict[str, Any] = {"f": 0.0} if settled else {}
    net = ia.Network("rig", wall=ia.Fixed(), near=ia.SpringDamper(k=1000.0, d=D1, **free))
    net.add(slide=ia.Mass(m=M1), tip=ia.Mass(m=M2), push=ia.Force())
    net.add(far=ia.SpringDamper(k=430.0, d=D2, s_rel0=0.1, **free))
    net.connect(net.wall.flange, net.near.flange_a)
    net.connect(net.near.flange_b, net.slide.flange, net.push.flange, net.far.flange_a)
    return net.connect(net.far.flange_b, net.tip.flange)


def measured(
    seed: int, near: float, far: float, k2: float = K2, settled: bool = False, begin: float = 1.5
) -> Record:
    """Return a record with these rest lengths, cut from a motion or begun where forces balance."""
    rng = np.random.default_rng(seed)
    lines, phases = rng.uniform(0.5, 6.0, 8), rng.uniform(0, 2 * np.pi, 8)

    def force(t: Any) -> Any:
        fade = np.clip(np.asarray(t) / 0.5, 0, 1) ** 3
        return 4.0 * fade * np.sin(2 * np.pi * np.multiply.outer(t, lines) + phases).sum(axis=-1)

    def rates(t: float, state: Any) -> list[float]:
        x, y, v, w = state
        inner = k2 * (y - x - far) + D2 * (w - v)
        return [v, w, (-K1 * (x - near) - D1 * v + inner + float(force(t))) / M1, -inner / M2]

    t = np.arange(0.0 if settled else begin, 5.0, 0.01)
    state = [near, near + far, 0.0, 0.0] if settled else [near + 0.01, near + far, 0.3, -0.2]
    found = solve_ivp(rates, (0.0, 5.0), state, t_eval=t, rtol=1e-10, atol=1e-13, max_step=0.02).y
    noisy = {name: found[n] + rng.normal(0, NOISE[name], len(t)) for n, name in enumerate(NOISE)}
    return Record(f"run {seed}", t, {"F": force(t), **noisy})


def campaign(
    parameters: Mapping[str, Any], train: Sequence[Any], test: Sequence[Any] = (), settled: bool = False
) -> Campaign:
    noise = {"x": 1e3 * NOISE["x"], "y": NOISE["y"]}  # in the channels' units
    return Campaign(model(settled), CHANNELS, parameters, train, test, noise=noise)


KINDS = [(0, "train"), (1, "train"), (2, "test")]
LENGTHS = [(0.012, 0.11), (-0.007, 0.085), (0.003, 0.12)]


@pytest.fixture(scope="module")
def records() -> list[dict[str, Any]]:
    return [{"record": measured(n, *lengths)} for n, lengths in enumerate(LENGTHS)]


@pytest.fixture(scope="module")
def found(records: list[Any]) -> Fit:
    return ia.fit(campaign({**SHARED, **OWN}, records[:2], records[2:]))


def refitted(given: Campaign) -> Refit:
    """Return the fit as a diagnosis makes it."""
    return JointFit(study_of(given, Accuracy(rtol=1e-7)), given.start).fitted()


def test_each_record_gets_its_own_rest_lengths(found: Fit) -> None:
    assert sorted(found.values) == ["far.k", "near.k"]
    for name, true in {"near.k": K1, "far.k": K2}.items():
        assert abs(found.values[name] - true) < 4 * found.errors[name]
        assert found.errors[name] < 1e-3 * true
    for comparison, lengths in zip(found.comparisons, LENGTHS, strict=True):
        for name, true in zip(OWN, lengths, strict=True):
            assert abs(comparison.own[name] - true) < 4 * comparison.own_errors[name]
            assert comparison.own_errors[name] < 2e-5
        for channel, sigma in NOISE.items():
            assert comparison.rms(channel, comparison.after) < 1.1 * sigma
    assert not found.warnings


def test_own_values_are_told_by_record(found: Fit) -> None:
    lines = [line for line in found.table().splitlines() if "s_rel0" in line]
    assert [line.split()[:3] for line in lines[::2]] == [["run", str(n), kind] for n, kind in KINDS]
    told = found.to_dict()["record_values"]
    assert [(row["record"], row["tested"]) for row in told[::2]] == [(f"run {n}", n == 2) for n in range(3)]
    assert {row["parameter"] for row in told} == set(OWN)
    assert all(row["unit"] == "m" and row["error"] > 0 for row in told)


def test_a_diagnosis_fits_what_a_fit_does(records: list[Any], found: Fit) -> None:
    refit = refitted(campaign({**SHARED, **OWN}, records[:2], records[2:]))
    assert refit.misfit < 1.05
    assert refit.parameters == pytest.approx(found.values, rel=1e-4)
    for own, comparison in zip(refit.own, found.comparisons, strict=True):
        assert own == pytest.approx(comparison.own, abs=2e-6)


def test_one_value_for_all_records_does_not_do(records: list[Any]) -> None:
    common = {name: {key: v for key, v in entry.items() if key != "per"} for name, entry in OWN.items()}
    assert refitted(campaign({**SHARED, **common}, records[:2], records[2:])).misfit > 50


def test_priors_and_bounds_hold_own_values_as_they_hold_parameters(records: list[Any]) -> None:
    """With one record, a value of its own is a parameter, but for what its start may be."""
    narrow = {**SHARED, "far.s_rel0": {"rel": 1e-4}, "near.s_rel0": {"min": -0.01, "max": 0.01}}
    plain = campaign(narrow, records[:1])
    own = campaign({name: {**entry, "per": "record"} for name, entry in narrow.items()}, records[:1])
    fit, refit = ia.fit(own), refitted(own)
    assert (fit.values, refit.parameters) == ({}, {})
    wanted = refitted(plain)
    assert wanted.parameters["near.s_rel0"] == 0.01
    assert abs(wanted.parameters["far.s_rel0"] - 0.1) > 1e-4
    assert refit.cost == pytest.approx(wanted.cost, rel=1e-4)  # that much less is not worth a run
    assert refit.own[0] == pytest.approx(wanted.parameters, rel=3e-3)
    assert fit.comparisons[0].own == pytest.approx(refit.own[0], rel=1e-3)
    assert any("near.s_rel0 of run 0: ends at its bound 0.01" in line for line in fit.warnings)


def test_what_is_known_of_a_record_is_not_fitted(records: list[Any]) -> None:
    known = {**records[1], "values": {"far.s_rel0": 0.085}}
    given = campaign({**SHARED, **OWN}, [records[0], known], records[2:])
    for own in ([c.own for c in ia.fit(given).comparisons], refitted(given).own):
        assert [sorted(one) for one in own] == [["far.s_rel0", "near.s_rel0"], ["near.s_rel0"], sorted(OWN)]
        assert own[1]["near.s_rel0"] == pytest.approx(-0.007, abs=1e-5)


def test_own_values_hold_beside_pieces_offsets_and_starts(records: list[Any]) -> None:
    """A stiffness by record, whose effect is far from linear; a record in pieces, one with an offset."""
    stiff = [350.0, 480.0]
    moved = [measured(n, *LENGTHS[n], k2=k) for n, k in enumerate(stiff)]
    off = Record(moved[1].name, moved[1].time, {**moved[1].values, "y": moved[1].values["y"] + 0.004})
    own = {"near.s_rel0": OWN["near.s_rel0"], "far.k": {"rel": 0.3, "per": "record"}}
    parameters = {"near.k": SHARED["near.k"], **own}
    lengths = {"far.s_rel0": 0.11}, {"far.s_rel0": 0.085}
    train = [
        {"record": moved[0], "values": lengths[0], "shooting": 0.7},
        {"record": off, "values": lengths[1], "offset": ["y"]},
    ]
    found = ia.fit(campaign(parameters, train))
    for n, comparison in enumerate(found.comparisons):
        assert comparison.own["far.k"] == pytest.approx(stiff[n], abs=0.2)
        assert comparison.own["near.s_rel0"] == pytest.approx(LENGTHS[n][0], abs=1e-5)
    del train[0]["shooting"]
    for values, k in zip(refitted(campaign(parameters, train)).own, stiff, strict=True):
        assert values["far.k"] == pytest.approx(k, abs=0.2)


def test_a_record_that_begins_at_rest_starts_with_its_own_value() -> None:
    """The start follows the value: here forces balance in it."""
    train = [{"record": measured(n, *LENGTHS[n], settled=True), "initial": "rest"} for n in range(2)]
    given = campaign({**SHARED, **OWN}, train, settled=True)
    fit, refit = ia.fit(given), refitted(given)
    assert refit.misfit < 1.05
    for own, comparison, lengths in zip(refit.own, fit.comparisons, LENGTHS, strict=False):
        assert list(own.values()) == pytest.approx(lengths, abs=1e-5)
        assert comparison.own == pytest.approx(own, abs=2e-6)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        (
            {"rel": 0.1, "per": "run"},
            "per is \"record\", for a value that each record has of its own, got 'run'",
        ),
        ({"rel": 0.1, "per": 1}, "per must be a text in quotes, got 1"),
        ({"per": "record"}, "give rel .* or min and max"),
        ({"min": 0.2, "max": 0.3, "per": "record"}, "the model's value 0.1 is outside 0.2 to 0.3"),
        ({"share": "near.s_rel0", "per": "record"}, "there is no key 'per'"),
    ],
)
def test_what_cannot_differ_by_record_is_told(records: list[Any], entry: Any, told: str) -> None:
    with pytest.raises(ia.ModelError, match=rf'parameters\."far\.s_rel0": {told}'):
        campaign({**SHARED, "far.s_rel0": entry}, records[:1])
