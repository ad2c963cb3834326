"""The generator of the blind benchmark: right where nothing is missing, sealed, repeatable, independent."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from inertance import CoulombFriction, Network

BLIND = Path(__file__).parents[2] / "benchmarks" / "blind"
NAMES = (
    "acquisition",
    "case",
    "effects",
    "excitations",
    "measures",
    "plan",
    "rigs",
    "score",
    "seal",
    "stepper",
    "severity",
)


@pytest.fixture(scope="module")
def blind() -> Any:
    """The modules of the benchmark, which are no package."""
    sys.path.insert(0, str(BLIND))
    try:
        yield SimpleNamespace(**{name: importlib.import_module(name) for name in NAMES})
    finally:
        sys.path.remove(str(BLIND))


def built(blind: Any, name: str) -> Network:
    space: dict[str, Any] = {}
    exec(blind.case.nominal_model(name).read_text(), space)
    network: Network = space["build"]()
    return network


def apart(blind: Any, rig: Any, network: Network, effects: list[Any], seconds: float = 5.0) -> list[float]:
    """Return how far truth and library part in each output channel, over its root mean square."""
    drive = blind.excitations.excitation(
        "random", rig.amplitude, rig.band, np.random.default_rng(5), rig.prescribed
    )
    typical = blind.effects.typical_of(rig, drive)
    fine = blind.effects.signals(rig, rig.parameters, drive, effects, typical)[:: blind.acquisition.FACTOR]
    time = np.arange(len(fine)) / blind.acquisition.SAMPLING
    path, _ = rig.channels[rig.input]
    run = network.simulate(seconds, step=1e-3, inputs={path: (time, fine[:, 0])}, rtol=1e-8, atol=1e-10)
    kept = np.r_[True, np.diff(run.time) > 0]
    until = time <= seconds
    parted = []
    for column, name in enumerate(rig.outputs, start=1):
        simulated = np.interp(time[until], run.time[kept], run[rig.channels[name][0]][kept])
        true = fine[until, column]
        parted.append(float(np.sqrt(np.mean((simulated - true) ** 2) / np.mean(true**2))))
    return parted


@pytest.mark.parametrize("name", ["pfi", "disk", "car", "frame", "drive"])
def test_truth_and_nominal_agree_where_nothing_is_missing(blind: Any, name: str) -> None:
    rig = blind.rigs.RIGS[name]
    assert max(apart(blind, rig, built(blind, name), [], seconds=2.0)) < 1e-4


def test_the_nominal_parameters_are_those_of_the_models(blind: Any) -> None:
    for name, rig in blind.rigs.RIGS.items():
        values = built(blind, name).dae().parameter_values
        assert {path: values[path] for path in rig.parameters} == rig.parameters
        assert all(built(blind, name).dae().unit(path) == unit for path, unit in rig.channels.values())


def test_set_valued_friction_agrees_with_friction_that_sticks_by_events(blind: Any) -> None:
    rig, network = blind.rigs.RIGS["disk"], built(blind, "disk")
    network.add(rub=CoulombFriction(f_c=0.3 * rig.scale))
    network.connect(network.frame.flange, network.rub.flange_a)
    network.connect(network.carriage.flange, network.rub.flange_b)
    effect = blind.effects.Effect("coulomb_friction", "main", ("spring",), {})
    parted = apart(blind, rig, network, [(effect, 0.3)])
    assert parted[0] < 2e-4  # position
    assert parted[1] < 3e-2  # acceleration, which jumps: half a sample of time is seen


def test_a_size_is_found_for_a_gap_that_parameters_leave(blind: Any) -> None:
    rig = blind.rigs.RIGS["disk"]
    drive = blind.excitations.excitation("random", 300.0, rig.band, np.random.default_rng(1), False)
    scale = blind.severity.Scale(rig, rig.parameters, [drive], blind.effects.typical_of(rig, drive), 0.01)
    stiffer = blind.effects.Effect("linear_stiffness", "main", ("spring",), {})
    left, change = scale.gap([(stiffer, 0.01)])
    assert left < 0.1 * change  # a parameter explains it
    cubic = blind.effects.Effect("cubic_stiffness", "main", ("spring",), {})
    size = scale.size(cubic, 3.0)
    assert scale.gap([(cubic, size)])[0] == pytest.approx(3.0, rel=0.1)


def test_a_gain_that_is_a_scaled_machine_has_no_size(blind: Any) -> None:
    """Of the only output it is what all parameters do, each a little: no size makes it a gap."""
    gain = blind.effects.Effect("sensor_gain", "F", ("F",), {"sign": -1.0})
    rig = blind.rigs.RIGS["pfi"]
    scale = sized(blind, rig)
    for size in (0.03, 0.3):
        assert scale.refitted(gain, size) < 0.1 * scale.gap([(gain, size)])[1]
    assert scale.size(gain, 10.0) is None


def test_the_first_24_cases_are_balanced(blind: Any) -> None:
    drafts = blind.plan.drafts(240, seed=1)
    assert drafts[:24] == blind.plan.drafts(24, seed=1)
    groups = {"effect": 15, "pair": 2, "none": 2, "parameters": 2, "unknown": 3}
    assert Counter(d.verdict for d in drafts[:24]) == groups
    single = [d for d in drafts if d.verdict == "effect"]
    assert set(Counter(d.severity for d in single).values()) == {50}
    kinds = Counter(d.options[0][1] for d in single)
    assert len(kinds) == 21
    assert max(kinds.values()) - min(kinds.values()) <= 1


def test_a_case_is_repeatable_and_tells_nothing(blind: Any, tmp_path: Path) -> None:
    draft = next(
        d for d in blind.plan.drafts(48, seed=3) if d.options[0][0] == "disk" and d.verdict == "effect"
    )
    first, second = (blind.case.make(draft, tmp_path / name) for name in "ab")
    assert first == second
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes()
    told = (tmp_path / "a" / "campaign.toml").read_text() + (tmp_path / "a" / "model.py").read_text()
    assert first["effects"][0]["kind"] not in told
    with np.load(tmp_path / "a" / "train_1.npz") as record:
        assert set(record) == {"time", "u", "s", "a"}
        assert len(record["time"]) == 20001


def sealed_set(blind: Any, folder: Path) -> Path:
    labels = {"0001": {"verdict": "none"}, "0002": {"verdict": "unknown"}}
    blind.seal.seal(folder, labels, {"0001": "a", "0002": "b"})
    for name in labels:
        (folder / "cases" / name).mkdir(parents=True)
        (folder / "cases" / name / "verdict.json").write_text('{"verdict": "none"}')
    return folder


def test_labels_open_once_verdicts_are_there(blind: Any, tmp_path: Path) -> None:
    folder = sealed_set(blind, tmp_path)
    assert blind.seal.unseal(folder)["0002"] == {"verdict": "unknown"}
    assert blind.seal.unseal(folder)["0001"] == {"verdict": "none"}  # and again, while nothing changes
    (folder / "cases" / "0002" / "verdict.json").write_text('{"verdict": "unknown"}')
    with pytest.raises(blind.seal.SealError, match="after the labels were opened: 0002"):
        blind.seal.unseal(folder)


def test_a_calibration_set_may_be_opened_again(blind: Any, tmp_path: Path) -> None:
    blind.seal.seal(tmp_path, {"0001": {"verdict": "none"}}, {"0001": "a"}, reopen=True)
    verdict = tmp_path / "cases" / "0001" / "verdict.json"
    verdict.parent.mkdir(parents=True)
    for told in ("none", "parameters"):
        verdict.write_text(told)
        assert blind.seal.unseal(tmp_path) == {"0001": {"verdict": "none"}}


def test_a_changed_label_breaks_the_seal(blind: Any, tmp_path: Path) -> None:
    folder = sealed_set(blind, tmp_path)
    path = folder / "labels" / "labels.json"
    kept = json.loads(path.read_text())
    kept["0002"]["label"]["verdict"] = "none"
    path.write_text(json.dumps(kept))
    with pytest.raises(blind.seal.SealError, match="do not fit their sealed hashes: 0002"):
        blind.seal.unseal(folder)


@pytest.mark.parametrize(
    ("rig", "kind", "place", "shape", "kinds"),
    [
        ("disk", "coulomb_friction", "main", {"bristles": 1.0}, ["coulomb_friction", "presliding_friction"]),
        ("disk", "coulomb_friction", "main", {"bristles": 0.0}, ["coulomb_friction"]),
        ("pfi", "asymmetric_friction", "screw", {"skew": 0.5}, ["asymmetric_friction", "constant_force"]),
        ("disk", "asymmetric_friction", "main", {"skew": 0.5}, ["asymmetric_friction"]),
    ],
)
def test_two_names_of_one_force(blind: Any, rig: Any, kind: str, place: str, shape: Any, kinds: Any) -> None:
    rig = blind.rigs.RIGS[rig]
    sites = rig.motions[place].sites
    assert blind.case.kinds(blind.effects.Effect(kind, place, sites, shape), rig) == kinds


def test_what_no_record_can_tell_apart_is_equally_right(blind: Any) -> None:
    effect, rigs = blind.effects.Effect, blind.rigs.RIGS
    inerter, disk = (sized(blind, rigs[name]) for name in ("pfi", "disk"))
    late, zero = effect("sensor_delay", "F", ("F",), {}), effect("sensor_bias", "s", ("s",), {"sign": 1.0})
    assert inerter.alike(late, 1e-3, blind.effects.rivals(rigs["pfi"])) == [("actuator_delay", "x")]
    forces = inerter.alike(
        effect("sensor_bias", "F", ("F",), {"sign": 1.0}), 0.02, blind.effects.rivals(rigs["pfi"])
    )
    assert ("constant_force", "inerter.screw") in forces
    assert {kind for kind, _ in disk.alike(zero, 0.1, blind.effects.rivals(rigs["disk"]))} == {
        "constant_force"
    }
    friction = effect("coulomb_friction", "main", ("carriage",), {"bristles": 0.0})
    assert disk.alike(friction, 0.05, blind.effects.rivals(rigs["disk"])) == []


def sized(blind: Any, rig: Any) -> Any:
    """Return what measures gaps on a random and a swept record of a rig."""
    rng = np.random.default_rng(3)
    how = rig.amplitude, rig.band, rng, rig.prescribed
    drives = [blind.excitations.excitation(shape, *how) for shape in ("random", "chirp")]
    typical = blind.effects.typical_of(rig, drives[0])
    return blind.severity.Scale(rig, rig.parameters, drives, typical, 0.01, weight=2.5)


def test_wilson_interval(blind: Any) -> None:
    # 81 of 263: the example of R. G. Newcombe, Statist. Med. 17 (1998) 857-872, table I
    assert blind.measures.wilson(81, 263) == pytest.approx((0.2553, 0.3662), abs=5e-5)
    assert blind.measures.wilson(0, 20) == pytest.approx((0.0, 0.1611), abs=5e-5)
    assert blind.measures.wilson(1, 29) == pytest.approx((0.0061, 0.1718), abs=5e-5)


def test_scores(blind: Any) -> None:
    answers = [["backlash", "shaft"], ["backlash", "gear"]]
    label = {"group": "effect", "severity": 10.0, "rig": "drive", "effects": [{"answers": answers}]}
    null = {"group": "none", "severity": 0.0, "rig": "drive", "effects": []}

    def case(label: Any, verdict: str, *named: tuple[str, str], equivalent: Any = ()) -> Any:
        effects = [{"kind": kind, "site": site} for kind, site in named]
        others = [{"kind": kind, "site": site} for kind, site in equivalent]
        told = {"verdict": verdict, "effects": effects, "equivalent": others, "closed": 0.9}
        return blind.measures.Scored(label, told, seconds=2.0)

    right = case(label, "effect", ("backlash", "gear"))
    wrong_site = case(label, "effect", ("backlash", "motor"), equivalent=[("backlash", "shaft")])
    too_many = case(label, "effect", ("backlash", "gear"), ("cubic_stiffness", "shaft"))
    alarm, quiet = case(null, "unknown"), case(null, "parameters")
    assert [case.hit for case in (right, wrong_site, too_many)] == [True, False, False]
    rows = {row[0]: row[1] for row in blind.score.table([right, wrong_site, too_many, alarm, quiet])}
    assert rows["kind and site, gap-to-noise 10"].endswith("1/3")
    assert rows["class holds the truth"].endswith("3/3")
    assert rows["mean size of a class"] == "1.67"
    assert rows["false alarms, both"].endswith("1/2")
    assert rows["closed, of all that is above the noise"].startswith("median 0.900")
    assert blind.score.missed([right, quiet]) == []
    poor = blind.score.missed([right, wrong_site, too_many, alarm, quiet, blind.measures.Scored(label, {})])
    assert [told.split(",")[0] for told in poor] == [
        "1 of 4 single effects named at gap-to-noise 3 and 10",
        "1 false alarms in 2 cases",
        "1 cases without a verdict",
    ]


def test_the_generator_does_not_know_the_library() -> None:
    program = "import sys, generate; print('inertance' in sys.modules, 'casadi' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=BLIND, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "False"]


def test_what_integrates_leaves_small_numbers_to_the_process(blind: Any) -> None:
    blind.stepper._library()
    assert np.nextafter(np.zeros(1), 1.0)[0] * np.ones(1)[0] > 0.0
