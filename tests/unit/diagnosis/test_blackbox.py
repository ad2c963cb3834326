"""An FMU as the nominal model: a late sensor, friction at its port, nothing missing, and bad campaigns."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.cli import app
from inertance.diagnosis import diagnose
from inertance.fmu import FMUForce, FMUMotion
from inertance.identification import Campaign, Multisine, Record, sampled
from numpy.typing import NDArray
from typer.testing import CliRunner

Array = NDArray[np.float64]

RATE, DURATION, NOISE = 100.0, 3.0, 1e-4
PORT = {"force": "push.f", "position": "carriage.s", "velocity": "carriage.v"}
CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "mm"}}


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    """Return the carriage whose records these are."""
    return carriage(RATE, DURATION, NOISE)


@pytest.fixture(scope="module")
def fmus(cart: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the nominal rig as rig2.fmu and rig3.fmu."""
    folder = tmp_path_factory.mktemp("fmus")
    for version in ("2.0", "3.0"):
        ia.export_fmu(
            cart.rig(),
            folder / f"rig{version[0]}.fmu",
            fmi_version=version,
            outputs=["carriage.s", "carriage.v"],
        )
    return folder


def campaign_on(
    cart: Any,
    model: str,
    folder: Path,
    truth: ia.Network,
    sensor: Callable[[Array, Array], Array] | None = None,
    **changed: Any,
) -> Campaign:
    records = [cart.measured(truth, seed, sensor) for seed in (1, 2)]
    entries: dict[str, Any] = {
        "channels": CHANNELS,
        "parameters": {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.1}},
        "train": [{"record": records[0], "initial": "rest"}],
        "test": [{"record": records[1], "initial": "rest"}],
        "noise": {"x": NOISE * 1e3},
        "port": PORT,
    }
    return Campaign(model, base=folder, reader=ia.diagnosis.read_model, **{**entries, **changed})


def late(t: Array, x: Array) -> Array:
    return np.interp(t - 0.008, t, x)


@pytest.mark.usefixtures("few_effects")
@pytest.mark.parametrize(("model", "port"), [("rig2.fmu:CS", PORT), ("rig3.fmu:ME", {})])
def test_a_sensor_that_is_late_around_an_fmu(
    carriage: Callable[..., Any], fmus: Path, model: str, port: dict[str, str]
) -> None:
    cart = carriage(RATE, 2.0, NOISE)
    found = diagnose(campaign_on(cart, model, fmus, cart.rig(k=820.0), late, port=port))
    assert found.verdict == "ambiguous"  # of one input and one output either may be late
    (placed,) = found.effects
    assert {placed.key, *found.equivalent} == {("sensor_delay", "x"), ("actuator_delay", "F")}
    assert placed.values["delay"] == pytest.approx(0.008, rel=0.05)
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=0.01)
    assert found.closed > 0.95
    assert any("no [port]" in note for note in found.notes) == (not port)


@pytest.mark.usefixtures("few_effects")
def test_friction_at_the_port_of_an_fmu(cart: Any, fmus: Path, tmp_path: Path) -> None:
    found = diagnose(campaign_on(cart, "rig2.fmu", fmus, cart.rubbing()))
    assert found.verdict == "effect"
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("coulomb_friction", "rig")
    assert placed.values["f_c"] == pytest.approx(0.8, rel=0.05)
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=0.01)
    assert found.closed > 0.95
    assert any("inside of it" in note for note in found.notes)
    assert ia.diagnosis.write_report(found, tmp_path / "gap.html").stat().st_size > 0
    drive = found.evidence.campaign.testing[0].record
    run = ia.fmu.cosimulate(
        found.corrected(), 1.0, communication_step=2e-3, inputs={"push.f": drive.sampled("F")}, halving=False
    )
    seen = np.interp(drive.time[:100], run.time, run["rig.s"])
    assert np.std(seen - drive.values["x"][:100]) < 5 * NOISE


def test_nothing_is_missing_around_an_fmu(cart: Any, fmus: Path) -> None:
    found = diagnose(campaign_on(cart, "rig2.fmu", fmus, cart.rig()))
    assert (found.verdict, found.effects) == ("none", ())


def shaken(k: float = 800.0) -> ia.Network:
    """Return a rig on a shaking table, whose mass is free."""
    net = ia.Network("shaken", table=ia.Position(), spring=ia.SpringDamper(k=k, d=6.0), mass=ia.Mass(m=2.0))
    net.add(free=ia.Force())
    net.connect(net.table.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.free.flange)


@pytest.mark.usefixtures("few_effects")
def test_friction_at_a_free_port_of_an_fmu_on_a_table(tmp_path: Path) -> None:
    ia.export_fmu(shaken(), tmp_path / "shaken.fmu", outputs=["mass.s", "mass.v"])
    truth = shaken(k=820.0)
    truth.add(floor=ia.Fixed(), rail=ia.CoulombFriction(f_c=0.8))
    truth.connect(truth.floor.flange, truth.rail.flange_a).connect(truth.rail.flange_b, truth.mass.flange)
    rng, records = np.random.default_rng(0), []
    for seed in (1, 2):
        u = sampled(Multisine(rms=5e-3, low=0.5, high=6.0, period=2.0, seed=seed), 2.0, RATE, fade=0.4)
        run = truth.simulate(2.0, inputs={"table.s_ref": u, "free.f": 0.0}, step=1 / RATE)
        x = run["mass.s"][np.searchsorted(run.time, u.time + 1e-6, side="right") - 1]
        records.append(Record(f"run {seed}", u.time, {"u": u.values, "x": x + rng.normal(0, NOISE, len(x))}))
    campaign = Campaign(
        "shaken.fmu",
        channels={"u": {"input": "table.s_ref", "unit": "m"}, "x": {"output": "mass.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.1}},
        train=[{"record": records[0], "initial": "rest"}],
        test=[{"record": records[1], "initial": "rest"}],
        noise={"x": NOISE},
        port={"force": "free.f", "position": "mass.s", "velocity": "mass.v"},
        base=tmp_path,
        reader=ia.diagnosis.read_model,
    )
    found = diagnose(campaign)
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("coulomb_friction", "shaken")
    assert placed.values["f_c"] == pytest.approx(0.8, rel=0.05)
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=0.01)
    assert not any("keep their start values" in note for note in found.notes)


def strut(k: float = 800.0) -> ia.Network:
    """Return a strut that is moved and pushes back."""
    net = ia.Network(
        "strut", wall=ia.Fixed(), spring=ia.Spring(k=k), damper=ia.Damper(d=6.0), cell=ia.ForceSensor()
    )
    net.add(motion=ia.Position())
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.cell.flange_a)
    return net.connect(net.cell.flange_b, net.motion.flange)


def moved(fmu: Path) -> ia.Network:
    """Return the strut as an FMU, moved at its end."""
    net = ia.Network("bench", wall=ia.Fixed(), motion=ia.Position())
    net.add(
        strut=FMUForce(
            fmu,
            kind="CS",
            position="motion.s_ref",
            velocity="der(motion.s_ref)",
            force="-cell.f",
        )
    )
    net.connect(net.wall.flange, net.strut.flange_a)
    return net.connect(net.strut.flange_b, net.motion.flange)


@pytest.mark.usefixtures("few_effects")
@pytest.mark.parametrize("is_file", [True, False])
def test_an_fmu_that_is_moved_and_gives_a_force(tmp_path: Path, is_file: bool) -> None:
    ia.export_fmu(strut(), tmp_path / "strut.fmu", outputs=["cell.f"])
    truth = strut(k=820.0)
    truth.add(rail=ia.QuadraticDamper(c=250.0)).connect(truth.wall.flange, truth.rail.flange_a)
    truth.connect(truth.rail.flange_b, truth.cell.flange_a)
    rng, records = np.random.default_rng(0), []
    for seed in (1, 2):
        x = sampled(Multisine(rms=5e-3, low=0.5, high=4.0, period=3.0, seed=seed), 3.0, 100.0, fade=0.5)
        run = truth.simulate(3.0, inputs={"motion.s_ref": x}, step=0.01)
        f = run["cell.f"][np.searchsorted(run.time, x.time + 1e-6, side="right") - 1]
        records.append(Record(f"run {seed}", x.time, {"x": x.values, "F": f + rng.normal(0, 0.05, len(f))}))
    port = {"force": "-cell.f", "position": "motion.s_ref", "velocity": "der(motion.s_ref)"}
    place = "" if is_file else "strut."
    force = "cell.f" if is_file else "motion.flange.f"
    campaign = Campaign(
        "strut.fmu" if is_file else moved(tmp_path / "strut.fmu"),
        channels={"x": {"input": "motion.s_ref", "unit": "m"}, "F": {"output": force, "unit": "N"}},
        parameters={f"{place}spring.k": {"rel": 0.1}, f"{place}damper.d": {"rel": 0.2}},
        train=[{"record": records[0], "initial": "rest"}],
        test=[{"record": records[1], "initial": "rest"}],
        noise={"F": 0.05},
        port=port if is_file else {},
        base=tmp_path,
        reader=ia.diagnosis.read_model,
    )
    found = diagnose(campaign)
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("quadratic_damping", "strut")
    assert placed.values["c"] == pytest.approx(250.0, rel=0.03)
    assert found.closed > 0.95
    assert found.parameters[f"{place}spring.k"] == pytest.approx(820.0, rel=0.01)


def joined(fmu: Path, force: str = "push.f") -> ia.Network:
    """Return the rig as an FMU, pushed through a load cell."""
    net = ia.Network("bench", push=ia.Force(), cell=ia.ForceSensor())
    net.add(body=FMUMotion(fmu, kind="CS", force=force, position="carriage.s", velocity="carriage.v"))
    net.connect(net.push.flange, net.cell.flange_a)
    return net.connect(net.cell.flange_b, net.body.flange)


@pytest.mark.usefixtures("few_effects")
def test_a_network_with_an_fmu_in_it(cart: Any, fmus: Path) -> None:
    records = [cart.measured(cart.rig(k=820.0), seed, late) for seed in (1, 2)]
    campaign = Campaign(
        joined(fmus / "rig2.fmu"),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "body.flange.s", "unit": "m"}},
        parameters={"body.spring.k": {"rel": 0.1}, "body.guide.d": {"rel": 0.1}},
        train=[{"record": records[0], "initial": "rest"}],
        test=[{"record": records[1], "initial": "rest"}],
        noise={"x": NOISE},
        reader=ia.diagnosis.read_model,
    )
    found = diagnose(campaign)
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("sensor_delay", "x")
    assert placed.values["delay"] == pytest.approx(0.008, rel=0.05)
    assert found.parameters["body.spring.k"] == pytest.approx(820.0, rel=0.01)
    assert "body" in found.where


def test_a_network_that_has_more_than_an_fmu(cart: Any, fmus: Path) -> None:
    net = joined(fmus / "rig2.fmu")
    net.add(more=ia.Mass(m=1.0)).connect(net.more.flange, net.body.flange)
    record = cart.measured(cart.rig(), 1)
    with pytest.raises(ia.ModelError, match=r"'push.f' is not one input of the network; .*put the rest"):
        Campaign(net, CHANNELS, {}, [{"record": record, "initial": "rest"}], reader=ia.diagnosis.read_model)


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "unknown output": (
        {"channels": {"F": CHANNELS["F"], "x": {"output": "carriage.ss"}}},
        "channels.x: FMU 'rig' has no such variable 'carriage.ss'; did you mean 'carriage.s'?",
    ),
    "unknown input": (
        {"channels": {"F": {"input": "pull.f"}, "x": CHANNELS["x"]}},
        "channels.F: the model has no input 'pull.f'; did you mean 'push.f'?",
    ),
    "unknown parameter": (
        {"parameters": {"spring.kk": {"rel": 0.1}}},
        "parameters.\"spring.kk\": the model has no parameter 'spring.kk'; did you mean 'spring.k'?",
    ),
    "unit of another quantity": (
        {"channels": {"F": {"input": "push.f", "unit": "mm"}, "x": CHANNELS["x"]}},
        "channels.F: 'mm' measures m, the quantity of the model is in N",
    ),
    "port without velocity": (
        {"port": {"force": "push.f", "position": "carriage.s"}},
        'port: velocity = "name of a variable" must be given',
    ),
    "unknown key of the port": (
        {"port": {**PORT, "speed": "carriage.v"}},
        "port: there is no 'speed'",
    ),
    "port that takes nothing": (
        {"port": {**PORT, "force": "spring.f"}},
        "it takes neither 'spring.f' nor 'carriage.s'; one of them must be an input (it has push.f)",
    ),
    "port in other units": (
        {"port": {**PORT, "position": "carriage.v"}},
        "port: 'carriage.v' is in m/s, where m belongs",
    ),
    "unknown variable of the port": (
        {"port": {**PORT, "position": "carriage.x"}},
        "port: position: FMU 'rig' has no such variable 'carriage.x'; did you mean",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_told(cart: Any, fmus: Path, case: str) -> None:
    changed, message = WRONG[case]
    with pytest.raises(ia.ModelError) as caught:
        campaign_on(cart, "rig2.fmu", fmus, cart.rig(), **changed)
    assert message in str(caught.value)


def test_an_fmu_that_is_not_there(cart: Any, fmus: Path) -> None:
    with pytest.raises(ia.ModelError, match=r"there is no file .*rig.fmu'; did you mean 'rig"):
        campaign_on(cart, "rig.fmu", fmus, cart.rig())


def test_a_record_of_an_fmu_begins_at_rest(cart: Any, fmus: Path) -> None:
    record = cart.measured(cart.rig(), 1)
    with pytest.raises(ia.ModelError, match='run 1: initial = "rest" is needed'):
        campaign_on(cart, "rig2.fmu", fmus, cart.rig(), train=[{"record": record}])


def test_equations_of_an_fmu_are_not_known(cart: Any, fmus: Path) -> None:
    with pytest.raises(ia.ModelError, match="is an FMU, whose equations are not known"):
        ia.fit(campaign_on(cart, "rig2.fmu", fmus, cart.rig()))


def test_a_network_needs_no_port(cart: Any, fmus: Path) -> None:
    with pytest.raises(ia.ModelError, match=r"\[port\] is for a model that is an FMU"):
        Campaign(cart.rig(), CHANNELS, {}, [{"record": cart.measured(cart.rig(), 1)}], port=PORT)


FIT = """
import sys
import inertance as ia

{before}
try:
    ia.fit("campaign.toml")
except ia.ModelError as error:
    sys.exit(str(error))
"""


@pytest.mark.parametrize("before", ["", "import inertance.diagnosis"], ids=["alone", "after diagnosis"])
def test_fit_says_what_to_do_with_an_fmu_whatever_was_imported(fmus: Path, before: str) -> None:
    (fmus / "campaign.toml").write_text(
        'model = "rig2.fmu"\n[channels]\n[parameters]\n[[train]]\nfile = "train.csv"\n'
    )
    command = [sys.executable, "-c", FIT.format(before=before)]
    ended = subprocess.run(command, cwd=fmus, capture_output=True, text=True, check=False)
    assert "'rig2.fmu' is an FMU, whose equations are not known" in ended.stderr
    assert 'diagnose("campaign.toml")' in ended.stderr
    typed = CliRunner().invoke(app, ["fit", str(fmus / "campaign.toml")])
    assert typed.exit_code == 2
    assert "`inertance diagnose` fits its parameters" in " ".join(typed.output.split())


def test_the_machine_after_a_change_of_parameters_is_predicted(cart: Any, fmus: Path) -> None:
    heavy = cart.measured(cart.rig().with_values(carriage=ia.Mass(m=3.0)), 3)
    entry = {"record": heavy, "initial": "rest"}
    scaled = {**entry, "scale": {"carriage.m": 1.5}}
    found = diagnose(campaign_on(cart, "rig2.fmu", fmus, cart.rig(), counterfactual=[scaled]))
    (told,) = found.counterfactual
    assert told.change == "carriage.m times 1.5"
    assert told.over_noise == pytest.approx(1.0, abs=0.15)
    with pytest.raises(ia.ModelError, match="is an FMU, whose components cannot be removed or exchanged"):
        campaign_on(cart, "rig2.fmu", fmus, cart.rig(), counterfactual=[{**entry, "remove": ["guide"]}])
