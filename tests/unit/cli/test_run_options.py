"""`inertance run` by solver, with constant inputs and results as JSON; what `fmu export` is asked for."""

import json
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from inertance.cli import app
from typer.testing import CliRunner, Result

MODEL = """
import inertance as ia


def pushed():
    net = ia.Network("pushed", mass=ia.Mass(m=2.0, s=0.0, v=0.0), push=ia.Force(), pull=ia.Force())
    return net.connect(net.mass.flange, net.push.flange, net.pull.flange)


def rubbing():
    net = ia.Network(
        "rubbing", ice=ia.Fixed(), rub=ia.CoulombFriction(f_c=1.0), puck=ia.Mass(m=1.0, s=0.0, v=1.0),
        hand=ia.Force(f=0.0),
    )
    net.connect(net.ice.flange, net.rub.flange_a)
    return net.connect(net.rub.flange_b, net.puck.flange, net.hand.flange)


def diverging():
    net = ia.Network(
        "diverging", wall=ia.Fixed(), spring=ia.CubicSpring(k=0.0, k3=-1.0), mass=ia.Mass(m=1.0, s=1.0, v=1.0)
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.py").write_text(MODEL)
    time = np.linspace(1.0, 3.0, 9)
    rows = "".join(f"{t},{1e-3 * t}\n" for t in time)
    (tmp_path / "push.csv").write_text(f"time,push.f [kN]\n{rows}")
    (tmp_path / "bare.csv").write_text("time\n0\n1\n2\n3\n")
    return tmp_path


def call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def refused(*arguments: str) -> str:
    result = call(*arguments)
    assert result.exit_code == 2
    return result.stderr.removeprefix("error: ").rstrip("\n")


def figures(folder: Path, *arguments: str, code: int = 0) -> Any:
    result = call("run", *arguments, "--json", "run.json")
    assert result.exit_code == code, result.stderr
    return json.loads((folder / "run.json").read_text(encoding="utf-8"), parse_constant=pytest.fail)


@pytest.mark.parametrize("solver", ["cvodes", "rosenbrock"])
def test_constant_inputs_and_the_solver_asked_for(folder: Path, solver: str) -> None:
    """(3 - 1)/2 m/s2 for 4 s."""
    inputs = ["--input", "push.f=3", "--input", "pull.f=-1"]
    told = figures(folder, "model.py:pushed", *inputs, "--stop", "4", "--solver", solver)
    assert told["statistics"]["solver"] == solver
    speed = told["signals"]["mass.v"]
    assert (speed["unit"], speed["decided"]) == ("m/s", "fixed")
    assert speed["last"] == pytest.approx(4.0)
    assert (told["begin"], told["end"], told["failure"]) == (0.0, 4.0, None)


def test_a_table_and_a_constant_together(folder: Path) -> None:
    """From 1 to 3 s, t N and 2 N on 2 kg: (4 + 4)/2 m/s."""
    told = figures(
        folder, "model.py:pushed", "--input", "push.csv", "--input", "pull.f=2", "--signals", "push.f"
    )
    assert (told["begin"], told["end"]) == (1.0, 3.0)
    speed, force = told["signals"]["mass.v"], told["signals"]["push.f"]
    assert speed["last"] == pytest.approx(4.0)
    assert (force["unit"], force["last"]) == ("N", pytest.approx(3.0))


def test_events_and_a_failure_are_told(folder: Path) -> None:
    told = figures(folder, "model.py:rubbing", "--stop", "2")
    (stop,) = [event for event in told["events"] if event["target"] == "stuck"]
    assert stop["time"] == pytest.approx(1.0)
    assert stop["component"] == "CoulombFriction 'rub'"
    told = figures(folder, "model.py:diverging", code=1)
    assert "integration failed" in told["failure"]
    assert 0 < told["end"] < 10


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["--input", "push.csv"],
            "push.csv, line 1: no column 'pull.f' [N], an input that has no other signal",
        ),
        (
            ["--input", "push.csv", "--input", "pull.f=1", "--input", "push.f=1"],
            "push.csv, line 1, column 'push.f': 'push.f' has a value given by --input, too",
        ),
        (
            ["--input", "bare.csv", "--input", "pull.f=1", "--input", "push.f=1"],
            "bare.csv, line 1: 'time' is the only column; name the inputs, too",
        ),
        (["--input", "push.g=1"], "--input push.g: there is no such input; did you mean 'push.f'?"),
        (["--input", "q=1"], "--input q: there is no such input; the inputs are pull.f, push.f"),
        (["--input", "push.f=x"], "--input takes NAME=VALUE with a number, got 'push.f=x'"),
        (
            ["--input", "push.csv", "--input", "more.csv"],
            "--input takes one file, got push.csv and more.csv; put all columns into one table",
        ),
        (
            ["--input", "push.f=1"],
            "no signal for 'pull.f' [N]; give --input FILE.csv with the header time,pull.f, "
            "or --input pull.f=VALUE",
        ),
        (["--json", "run.txt"], "--json: 'run.txt' ends in '.txt'; it must end in .json"),
        (
            ["--signals", "mass.*"],
            "--signals says what --out writes and --json tells; give --out FILE or --json FILE, too",
        ),
    ],
)
def test_wrong_use_is_told(arguments: list[str], message: str) -> None:
    assert refused("run", "model.py:pushed", *arguments) == message


def test_a_wrong_solver_is_told() -> None:
    told = refused("run", "model.py:rubbing", "--solver", "euler")
    assert "solver must be one of 'auto', 'cvodes', 'idas', 'rosenbrock', 'compiled', got 'euler'" in told


def test_an_fmu_is_exported_with_inputs_and_a_default_experiment(folder: Path) -> None:
    options = ["--input", "hand.f", "--stop", "7.5", "--step", "0.25", "--platform", "x86_64-linux"]
    assert call("fmu", "export", "model.py:rubbing", "rub.fmu", *options).exit_code == 0
    with zipfile.ZipFile(folder / "rub.fmu") as archive:
        root = ET.fromstring(archive.read("modelDescription.xml"))
    experiment = root.find("DefaultExperiment")
    assert experiment is not None
    assert (experiment.get("stopTime"), experiment.get("stepSize")) == ("7.5", "0.25")
    inputs = [v.get("name") for v in root.iter("ScalarVariable") if v.get("causality") == "input"]
    assert inputs == ["hand.f"]


def test_an_fmu_takes_the_same_tables(folder: Path) -> None:
    """From 1 to 3 s, t N and 2 N on 2 kg: (4 + 4)/2 m/s; the record is in kN."""
    assert call("fmu", "export", "model.py:pushed", "pushed.fmu", "--output", "mass.v").exit_code == 0
    test = ["fmu", "import-test", "pushed.fmu", "--no-isolated"]
    done = call(*test, "--input", "push.csv", "--input", "pull.f=2", "--out", "out.csv")
    assert done.exit_code == 0, done.stderr
    rows = np.genfromtxt(folder / "out.csv", delimiter=",", names=True, encoding="utf-8", deletechars="")
    time = next(iter(rows.dtype.names or ["time"]))
    assert rows[time][[0, -1]].tolist() == [1.0, 3.0]
    assert rows["mass.v"][-1] == pytest.approx(4.0, rel=1e-5)
    told = refused(*test, "--input", "push.csv", "--input", "push.f=1")
    assert told == "push.csv, line 1, column 'push.f': 'push.f' has a value given by --input, too"
    assert (
        refused(*test, "--input", "pus.f=1")
        == "--input pus.f: there is no such input; did you mean 'push.f'?"
    )
