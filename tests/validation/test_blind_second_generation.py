"""The second generation of the blind benchmark: its rigs and laws, how it records, what counts as right."""

from __future__ import annotations

import importlib
import sys
from collections import Counter
from hashlib import sha256
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from inertance import Network
from inertance.diagnosis.effects.sites import sites_of
from inertance.identification import Campaign

BLIND = Path(__file__).parents[2] / "benchmarks" / "blind"
SECOND = ("case", "effects", "excitations", "plan", "recording", "rigs", "score", "severity")
RIGS = ("oscillator", "bench", "servo", "spindle", "isolator", "carts")
SHORT = 3.0


@pytest.fixture(scope="module")
def blind() -> Any:
    """The modules of the benchmark, which are no package."""
    sys.path.insert(0, str(BLIND))
    try:
        modules = {name: importlib.import_module(f"second.{name}") for name in SECOND}
        shared = {name: importlib.import_module(name) for name in ("effects", "measures", "plan", "stepper")}
        yield SimpleNamespace(**modules, shared=SimpleNamespace(**shared))
    finally:
        sys.path.remove(str(BLIND))


def built(name: str) -> Network:
    space: dict[str, Any] = {}
    exec((BLIND / "models" / f"{name}.py").read_text(), space)
    network: Network = space["build"]()
    return network


def driven(blind: Any, rig: Any, *, rested: bool = True, shape: str = "random") -> Any:
    rng = np.random.default_rng(5)
    return blind.excitations.excitation(
        shape, rig.amplitude, rig.band, rng, rig.prescribed, SHORT, rested, blind.rigs.BIAS.get(rig.name, 0.0)
    )


def logger(blind: Any, **other: Any) -> Any:
    plain = {
        "duration": SHORT,
        "rate": 500,
        "begin": "motion",
        "filtered": "none",
        "cutoffs": (60.0,) * 4,
        "bits": 16,
        "gap": "none",
        "offset": (),
        "clock": False,
        "filed": False,
    }
    return blind.recording.Logger(**plain | other)


def bench_of(blind: Any, rig: Any, taking: Any, noise: float = 0.01) -> Any:
    drives = [driven(blind, rig, rested=False), driven(blind, rig, rested=False, shape="chirp")]
    typical = blind.shared.effects.typical_of(rig, drives[0])
    rel = dict.fromkeys(rig.parameters, 0.2)
    return blind.severity.Bench(rig, rig.parameters, drives, typical, noise, rel, taking)


@pytest.mark.parametrize("name", RIGS)
def test_truth_and_nominal_agree_where_nothing_is_missing(blind: Any, name: str) -> None:
    rig, network = blind.rigs.RIGS[name], built(name)
    drive = driven(blind, rig)
    typical = blind.shared.effects.typical_of(rig, drive)
    fine = blind.effects.signals(rig, rig.parameters, drive, [], typical, 5e-5, SHORT)[::20]
    time, end = np.arange(len(fine)) * 1e-3, blind.excitations.PREROLL + SHORT
    inputs = {rig.channels[rig.input][0]: (time, fine[:, 0])}
    run = network.simulate(end, step=1e-3, inputs=inputs, rtol=1e-8, atol=1e-10)
    kept = np.r_[True, np.diff(run.time) > 0]
    until = time <= end
    for column, output in enumerate(rig.outputs, start=1):
        simulated = np.interp(time[until], run.time[kept], run[rig.channels[output][0]][kept])
        true = fine[until, column]
        assert np.sqrt(np.mean((simulated - true) ** 2) / np.mean(true**2)) < 1e-4


@pytest.mark.parametrize("name", RIGS)
def test_parameters_units_and_sites_are_those_of_the_model(blind: Any, name: str) -> None:
    rig, network = blind.rigs.RIGS[name], built(name)
    values = network.dae().parameter_values
    assert {path: values[path] for path in rig.parameters} == rig.parameters
    assert all(network.dae().unit(path) == unit for path, unit in rig.channels.values() if unit)
    sites = {site.path for site in sites_of(network)} | set(rig.channels)
    assert all(set(right) <= sites for _, _, right in blind.effects.places(rig))


def offers(blind: Any) -> list[tuple[Any, Any]]:
    """Return one rig and offer of every kind, also of those outside the vocabulary."""
    found: dict[str, tuple[Any, Any]] = {}
    for rig in blind.rigs.RIGS.values():
        for offer in [*blind.effects.places(rig), *blind.effects.outside(rig)]:
            found.setdefault(offer[0], (rig, offer))
    return list(found.values())


def test_the_integrator_has_converged_for_every_kind(blind: Any) -> None:
    for rig, offer in offers(blind):
        rng = np.random.default_rng(3)
        drive = driven(blind, rig, rested=False)
        typical = blind.shared.effects.typical_of(rig, drive)
        effect = blind.effects.draw(offer, rng, SHORT)
        size = blind.effects.guess(effect, rig, drive, 5e-5)
        coarse = type(drive)(*(x[::2] for x in vars(drive).values()))
        seen = [
            blind.effects.signals(rig, rig.parameters, d, effects, typical, step, SHORT)[::every, 1:]
            for d, step, every in ((drive, 5e-5, 20), (coarse, 1e-4, 10))
            for effects in ([(effect, size)], [])
        ]
        parted = np.std(seen[0] - seen[2], axis=0) / np.std(seen[0], axis=0)
        assert np.all(np.isfinite(seen[0])), offer
        assert parted.max() < 1e-4, (offer, parted)  # a tenth of the least noise
        assert np.any(np.std(seen[0] - seen[1], axis=0) > 0), offer


def test_first_generation_has_the_cases_it_had(blind: Any) -> None:
    drafts = repr(blind.shared.plan.drafts(24, 1001))
    told = "0d93e5a197360f890d3e09296e3d53f3fe6fd5bd8d91f5534d375be20627502b"
    assert sha256(drafts.encode()).hexdigest() == told


def test_any_first_30_cases_are_balanced(blind: Any) -> None:
    drafts = blind.plan.drafts(300, seed=1)
    assert drafts[:30] == blind.plan.drafts(30, seed=1)
    assert Counter(d.verdict for d in drafts[:30]) == blind.plan.SHARES
    groups = Counter(d.verdict for d in drafts)
    assert groups["none"] + groups["parameters"] == 60
    kinds = Counter(d.options[0][1] for d in drafts if d.verdict == "effect")
    assert set(kinds) == {
        kind for rig in blind.rigs.RIGS.values() for kinds in rig.kinds.values() for kind in kinds
    }
    assert max(kinds.values()) - min(kinds.values()) <= 1


def test_sizes_give_the_wanted_gap(blind: Any) -> None:
    rig = blind.rigs.RIGS["oscillator"]
    bench = bench_of(blind, rig, logger(blind, offset=("x",)))
    effect = blind.effects.draw(("cubic_stiffness", "cart", ("cart",)), np.random.default_rng(0), SHORT)
    size = bench.size(effect, 3.0)
    assert bench.gap([(effect, size)])[0] == pytest.approx(3.0, rel=0.1)
    pull = blind.shared.effects.Effect("constant_force", "cart", ("cart",), {"sign": 1.0})
    left, change = bench.gap([(pull, 0.01)])
    assert left < 1e-3 * change  # a zero that is unknown explains it, but for what still rings of its onset


def test_what_no_record_can_tell_apart_is_equally_right(blind: Any) -> None:
    rig = blind.rigs.RIGS["bench"]
    bench = bench_of(blind, rig, logger(blind))
    late = blind.shared.effects.Effect("actuator_delay", "x", ("x",), {})
    assert ("sensor_delay", "F") in bench.alike(late, 0.02, blind.effects.places(rig))
    pull = blind.shared.effects.Effect("constant_force", "stroke", ("specimen",), {"sign": -1.0})
    assert bench.alike(pull, 0.1, blind.effects.places(rig)) == [("sensor_bias", "F")]


@pytest.mark.parametrize("filtered", ["none", "zero-phase", "causal", "apart"])
def test_records_part_from_the_true_law_by_their_noise(blind: Any, filtered: str) -> None:
    rig = blind.rigs.RIGS["carts"]
    drive = driven(blind, rig, rested=False)
    typical = blind.shared.effects.typical_of(rig, drive)
    fine = blind.effects.signals(rig, rig.parameters, drive, [], typical, 5e-5, SHORT)
    noise = np.array([0.0, *(0.01 * np.std(fine[:, 1:], axis=0))])
    cutoffs = (80.0, 60.0, 90.0) if filtered == "apart" else (80.0,) * 3
    taking = logger(blind, filtered=filtered, cutoffs=cutoffs, offset=("x1",), clock=True)
    rng = np.random.default_rng(1)
    record = blind.recording.taken(fine, taking, rig, noise, np.abs(fine).max(axis=0), rng)
    assert len(record.time) == 1501
    scatter = np.std((record.values - record.zeros - record.clean)[:, 1:], axis=0)
    np.testing.assert_allclose(scatter, noise[1:], rtol=0.15)
    speed = np.diff(record.clean[:2, 1]) * taking.rate
    assert abs(speed[0]) > 1e-3  # it moves where it begins


def test_an_excitation_has_the_derivatives_it_states(blind: Any) -> None:
    rig = blind.rigs.RIGS["isolator"]
    for shape in blind.excitations.SHAPES:
        drive = driven(blind, rig, rested=False, shape=shape)
        scale = np.std(drive.wd), np.std(drive.wdd)
        assert np.std(np.gradient(drive.w, 5e-5) - drive.wd) < 1e-3 * scale[0], shape
        assert np.std(np.gradient(drive.wd, 5e-5) - drive.wdd) < 1e-3 * scale[1], shape


@pytest.fixture(scope="module")
def short(blind: Any) -> Any:
    """Records of a few seconds."""
    patch = pytest.MonkeyPatch()
    patch.setattr(blind.case, "DURATION", SHORT)
    yield
    patch.undo()


def test_a_case_is_repeatable_readable_and_tells_nothing(blind: Any, short: None, tmp_path: Path) -> None:
    wanted = {"effect", "none"}
    for draft in blind.plan.drafts(30, seed=7):
        if draft.verdict not in wanted:
            continue
        wanted.remove(draft.verdict)
        first, second = (blind.case.make(draft, tmp_path / draft.verdict / name) for name in "ab")
        assert first == second
        for path in (tmp_path / draft.verdict / "a").iterdir():
            assert path.read_bytes() == (tmp_path / draft.verdict / "b" / path.name).read_bytes()
        told = (tmp_path / draft.verdict / "a" / "campaign.toml").read_text()
        assert not any(effect["kind"] in told for effect in first["effects"])
        assert "[noise]" not in told
        campaign = Campaign.of(tmp_path / draft.verdict / "a" / "campaign.toml")
        assert len(campaign.training) >= 3


def test_scores(blind: Any) -> None:
    effects = [{"kind": "backlash", "answers": [["backlash", "shaft"]]}]
    taking = {"begin": "motion", "filtered": "none", "bits": 16, "gap": "none", "offset": [], "clock": True}
    common = {"generation": 2, "rig": "servo", "noise": 0.01, "logger": taking, "left": {"phi": 0.01}}
    effect = common | {"group": "effect", "severity": 10.0, "effects": effects}
    null = common | {"group": "none", "severity": 0.0, "effects": []}
    strange = common | {"group": "unknown", "severity": 10.0, "effects": [{"kind": "jam", "answers": []}]}

    def case(label: Any, said: str, *named: tuple[str, str], other: Any = (), after: float = 0.01) -> Any:
        told = {
            "verdict": said,
            "effects": [{"kind": kind, "site": site} for kind, site in named],
            "equivalent": [{"kind": kind, "site": site} for kind, site in other],
            "gap": {"phi": {"refit": 0.1, "after": after}},
        }
        return blind.shared.measures.Scored(label, told, seconds=2.0)

    right = case(effect, "effect", ("backlash", "shaft"))
    either = case(effect, "ambiguous", ("compliance", "shaft"), other=[("backlash", "shaft")])
    wrong = case(effect, "effect", ("compliance", "shaft"), after=0.05)
    quiet, alarm = case(null, "none"), case(null, "partial", ("backlash", "shaft"))
    some, fooled = (
        case(strange, "partial", ("backlash", "shaft")),
        case(strange, "effect", ("backlash", "shaft")),
    )
    cases = [right, either, wrong, quiet, alarm, some, fooled]
    assert [blind.score.stray(c) for c in cases] == [False, False, True, False, True, True, True]
    assert [blind.score.right(c) for c in cases] == [True, False, False, True, False, True, False]
    assert blind.score.closed(right) == pytest.approx(1.0)
    assert blind.score.closed(wrong) == pytest.approx(1 - 24 / 99)
    rows = {row[0].strip(): row[1] for row in blind.score.table(cases)}
    assert rows["kind and site, gap-to-noise 10"].endswith("1/3")
    assert rows["false alarms"].endswith("1/2")
    assert rows["a named effect that is not there"].endswith("4/7")
    assert rows["where the list has all that acts"].endswith("2/5")
    assert rows["unknown or partial, outside the list"].endswith("1/2")
    assert rows["time for five records"].startswith("median 2.0 s")
    causes = {row[0]: row[1] for row in blind.score.by_cause(cases)}
    assert causes["begins: motion"].endswith("3/7")


def test_how_sure_verdicts_are_is_held_against_how_often_they_are_right(blind: Any) -> None:
    label = {"effects": [{"kind": "backlash", "answers": [["backlash", "shaft"]]}]}

    def case(kind: str, confidence: float | None) -> Any:
        effect = {"kind": kind, "site": "shaft", "confidence": confidence}
        return blind.shared.measures.Scored(label, {"verdict": "effect", "effects": [effect]})

    told = [
        ("backlash", 0.95),
        ("backlash", 0.97),
        ("compliance", 0.94),
        ("backlash", 0.5),
        ("backlash", None),
    ]
    rows = blind.shared.measures.reliability([case(*one) for one in told])
    assert [(row[0], row[1].split()[-1], row[2]) for row in rows] == [
        ("confidence 0 to 0.6", "1/1", "0.5 told"),
        ("confidence 0.9 to 0.99", "2/3", "0.9533 told"),
    ]
