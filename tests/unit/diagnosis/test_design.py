"""The next experiment: it parts what can be parted, keeps its limits, and says what no input parts."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.cli import app
from inertance.identification import Campaign, Multisine, Record, Shuttle, read_record, sampled
from typer.testing import CliRunner

RATE, LENGTH, NOISE = 100.0, 4.0, 2e-4
CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "mm"}}
LIMITS = {"F": {"force": 30, "band": [0.5, 5]}, "x": {"travel": 12, "speed": "0.2 m/s"}}
MODEL = """import inertance as ia


def build():
    net = ia.Network("rig", wall=ia.Fixed(), spring=ia.Spring(k=800.0), guide=ia.Damper(d=6.0))
    net.add(carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)
"""
CAMPAIGN = """model = "rig.py:build"
channels.F = { input = "push.f", unit = "N" }
channels.x = { output = "carriage.s", unit = "mm" }
parameters."spring.k" = { rel = 0.1 }
parameters."guide.d" = { rel = 0.3 }
[noise]
x = 0.2
[limits]
duration = 4
rate = 100
F = { force = 30, band = [0.5, 5] }
x = { travel = 12, speed = "0.2 m/s" }
"""


def rig() -> ia.Network:
    names: dict[str, Any] = {}
    exec(MODEL, names)
    network: ia.Network = names["build"]()
    return network


def record(drive: ia.Sampled, seed: int, late: float = 0.0) -> Record:
    """Return what is seen of the carriage with a drag of 30 N.s2/m2, or else with its force late."""
    net = rig()
    if not late:
        net.add(drag=ia.QuadraticDamper(c=30.0)).connect(net.wall.flange, net.drag.flange_a)
        net.connect(net.drag.flange_b, net.carriage.flange)
    force = ia.Sampled(drive.time, np.interp(drive.time - late, drive.time, drive.values))
    run = net.simulate(float(drive.time[-1]), inputs={"push.f": force}, step=1 / RATE, rtol=1e-8, atol=1e-11)
    x = run["carriage.s"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(x))
    return Record(f"run {seed}", drive.time, {"F": drive.values, "x": x + noise})


def campaign(late: float = 0.0, limits: dict[str, Any] | None = None) -> Campaign:
    slow = Multisine(rms=3.0, low=1.0, high=2.0, period=LENGTH)
    return Campaign(
        rig(),
        CHANNELS,
        {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}},
        train=[{"record": record(sampled(slow, LENGTH, RATE, fade=0.5), 1, late), "initial": "rest"}],
        noise={"x": 1e3 * NOISE},
        limits={"rate": RATE, **(LIMITS if limits is None else limits)},
    )


def verdict(path: Path, one: tuple[str, str], other: tuple[str, str]) -> Path:
    """Write a verdict that cannot tell two effects apart."""
    effects, rivals = ([{"kind": kind, "site": site} for kind, site in pair] for pair in ([one], [other]))
    told = {"verdict": "ambiguous", "effects": effects, "equivalent": rivals, "ranking": []}
    path.write_text(json.dumps(told))
    return path


DRAGS = ("quadratic_damping", "guide"), ("coulomb_friction", "guide")


@pytest.fixture(scope="module")
def drags(tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, ia.diagnosis.Design]:
    """Return the experiment that tells a drag from dry friction, and the campaign that it was made for."""
    file = verdict(tmp_path_factory.mktemp("drags") / "gap.json", *DRAGS)
    given = campaign()
    return given, ia.design(given, file)


def test_rivals_are_parted_and_the_truth_is_the_likelier_one(drags: tuple[Any, ia.diagnosis.Design]) -> None:
    made = drags[1]
    (pair,) = made.odds
    assert pair.is_decisive
    assert pair.right > 0.9
    new = record(ia.Sampled(made.time, made.inputs["F"]), 7)
    missed = {}
    for model, seen in zip(made.models, made.made.seen, strict=True):
        missed[model.told] = float(np.std(new.values["x"] - seen.run.seen["x"]))
    assert min(missed, key=lambda told: missed[told]) == "quadratic damping at guide"


def test_the_experiment_keeps_the_limits_on_the_true_machine(drags: tuple[Any, ia.diagnosis.Design]) -> None:
    made = drags[1]
    force = made.inputs["F"]
    seen = record(ia.Sampled(made.time, force), 7).values["x"]
    assert np.abs(force).max() <= 30.0 * (1 + 1e-9)
    assert np.abs(seen).max() < 1.2 * 12e-3  # its model is not the machine
    foreseen = [one.run.seen["x"] for one in made.made.seen]
    assert max(np.abs(x).max() for x in foreseen) <= 12e-3 * (1 + 1e-9)
    assert max(np.abs(np.gradient(x, 1 / RATE)).max() for x in foreseen) <= 0.2 * (1 + 1e-9)
    power = np.abs(np.fft.rfft(force)) ** 2
    fast = np.fft.rfftfreq(len(force), 1 / RATE) > 6.0
    assert power[fast].sum() < 0.01 * power.sum()


def test_it_begins_and_ends_at_rest_and_is_read_back(
    drags: tuple[Campaign, ia.diagnosis.Design], tmp_path: Path
) -> None:
    given, made = drags
    force = made.inputs["F"]
    speed = np.abs(np.gradient(force, made.time))
    assert np.abs(force[[0, -1]]).max() < 1e-9
    assert speed[[0, -1]].max() < 0.05 * speed.max()
    read = read_record(made.save(tmp_path / "next.csv"), {"F": given.measured["F"]})
    assert read.values["F"] == pytest.approx(force, rel=1e-6, abs=1e-6)
    assert read.rate == pytest.approx(RATE)
    made.plot(tmp_path / "next.png")
    assert (tmp_path / "next.png").stat().st_size > 10_000
    told = json.loads(made.to_json(tmp_path / "next.json").read_text())
    assert told["odds"][0]["right"] == made.odds[0].right
    assert told["experiment"] == made.told


def test_delays_before_and_after_a_linear_machine_are_said_to_be_one(tmp_path: Path) -> None:
    file = verdict(tmp_path / "gap.json", ("sensor_delay", "x"), ("actuator_delay", "F"))
    with pytest.raises(ia.diagnosis.InseparableError, match="cannot be told apart by any input") as error:
        ia.design(campaign(late=0.02), file)
    assert "; measure '" in str(error.value)


def test_without_limits_nothing_goes_beyond_what_was_measured(tmp_path: Path) -> None:
    given = campaign(limits={})
    made = ia.design(given, verdict(tmp_path / "gap.json", *DRAGS))
    before = given.training[0].record.values
    assert np.abs(made.inputs["F"]).max() <= np.abs(before["F"]).max() * (1 + 1e-9)
    assert max(np.abs(s.run.seen["x"]).max() for s in made.made.seen) <= np.abs(before["x"]).max()


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "this is not JSON"),
        ("[]", "this is no verdict"),
        ('{"verdict": "none", "effects": [], "equivalent": [], "ranking": []}', "it names no effects"),
        ('{"effects": [{"kind": "backlesh", "site": "guide"}], "equivalent": [], "ranking": []}', "backlash"),
    ],
)
def test_what_is_no_open_verdict_is_refused(content: str, told: str, tmp_path: Path) -> None:
    file = tmp_path / "gap.json"
    file.write_text(content)
    with pytest.raises(ia.ModelError, match=told):
        ia.design(campaign(), file)


def test_an_unknown_site_is_told_with_the_nearest(tmp_path: Path) -> None:
    file = verdict(tmp_path / "gap.json", DRAGS[0], ("coulomb_friction", "giude"))
    with pytest.raises(ia.ModelError, match="did you mean 'guide'"):
        ia.design(campaign(), file)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "rig.py").write_text(MODEL)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    return tmp_path


def test_parameters_are_identified_before_any_rig_exists(folder: Path) -> None:
    outputs = [str(folder / name) for name in ("next.csv", "next.json", "next.png")]
    options = ["--parameters", "--jobs", "1", "--out", outputs[0], "--json", outputs[1], "--plot", outputs[2]]
    done = CliRunner().invoke(app, ["design", str(folder / "campaign.toml"), *options])
    assert done.exit_code == 0, done.output
    assert (folder / "next.csv").read_text().startswith("time [s],F [N]\n0,0\n")
    told = json.loads((folder / "next.json").read_text())
    known = {one["parameter"]: one for one in told["parameters"]}
    assert known["spring.k"]["before"] == pytest.approx(80.0)
    time, force = np.loadtxt(outputs[0], delimiter=",", skiprows=1).T
    fitted = ia.fit(_seen(ia.Sampled(time, force)))
    for name, one in known.items():
        assert one["after"] < 0.2 * one["before"]
        assert fitted.errors[name] == pytest.approx(one["after"], rel=0.3)


def _seen(drive: ia.Sampled) -> Campaign:
    """Return the campaign once an experiment has been made, on the machine as it is modelled."""
    net = rig()
    run = net.simulate(float(drive.time[-1]), inputs={"push.f": drive}, step=1 / RATE, rtol=1e-8, atol=1e-11)
    x = run["carriage.s"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
    noise = NOISE * np.random.default_rng(3).standard_normal(len(x))
    new = Record("new", drive.time, {"F": drive.values, "x": x + noise})
    entry = {"record": new, "initial": "rest"}
    parameters = {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}}
    return Campaign(net, CHANNELS, parameters, train=[entry], noise={"x": 1e3 * NOISE})


@pytest.mark.parametrize(
    ("change", "options", "told", "code"),
    [
        (lambda text: text, [], r"to tell hypotheses apart, \[\[train\]\] records are needed", 2),
        (lambda text: text.split("[limits]")[0], ["--parameters"], "duration", 2),
        (lambda text: text, ["--parameters", "--verdict", "gap.json"], "--verdict names hypotheses", 2),
        (lambda text: text.replace("[0.5, 5]", "[5, 0.5]"), ["--parameters"], "the lower frequency", 2),
        (lambda text: text, ["--parameters", "--out", "next.txt"], "--out", 2),
    ],
)
def test_wrong_use_is_told(
    folder: Path, change: Callable[[str], str], options: list[str], told: str, code: int
) -> None:
    file = folder / "campaign.toml"
    file.write_text(change(CAMPAIGN))
    done = CliRunner().invoke(app, ["design", str(file), *options])
    assert done.exit_code == code
    assert told.replace("\\", "") in " ".join(done.output.split())


def test_a_shuttle_rests_on_both_sides_and_moves_smoothly() -> None:
    drive = sampled(Shuttle(0.01, 1.0, moving=0.4), stop=4.0, rate=1000.0)
    speed = np.gradient(drive.values, drive.time)
    resting = np.abs(speed) < 1e-9
    assert np.mean(resting) == pytest.approx(0.6, abs=0.03)
    assert np.ptp(drive.values) == pytest.approx(0.02)
    assert np.abs(np.diff(speed)).max() < 0.05 * np.abs(speed).max()


def test_narrower_limits_part_less(drags: tuple[Any, ia.diagnosis.Design], tmp_path: Path) -> None:
    narrow = {"F": {"force": 2, "band": [0.5, 5]}, "x": {"travel": 1}}
    small = ia.design(campaign(limits=narrow), verdict(tmp_path / "gap.json", *DRAGS))
    assert small.odds[0].distance < drags[1].odds[0].distance
