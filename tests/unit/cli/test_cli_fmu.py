"""`inertance fmu`: what it writes, prints and returns."""

from __future__ import annotations

import io
import json
import shutil
import zipfile
from pathlib import Path

import pytest
from inertance.cli import app
from typer.testing import CliRunner

needs_compiler = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
MODEL = """
import inertance as ia


def build():
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "model.py").write_text(MODEL)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*words: str) -> tuple[int, str]:
    done = CliRunner().invoke(app, ["fmu", *words])
    return done.exit_code, done.output


@needs_compiler
def test_export_info_and_import_test(folder: Path) -> None:
    rights = "--author", "A. Mueller", "--version", "1.2", "--license", "proprietary"
    code, told = run("export", "model.py:build", "it.fmu", "--fmi", "3.0", "--output", "mass.*", *rights)
    assert (code, "wrote it.fmu" in told) == (0, True), told
    with zipfile.ZipFile("it.fmu") as archive:
        described = archive.read("modelDescription.xml").decode()
    assert 'author="A. Mueller" version="1.2" license="proprietary"' in described
    code, told = run("info", "it.fmu")
    assert code == 0
    assert "oscillator: FMI 3.0, ME and CS" in told
    code, told = run("import-test", "it.fmu", "--stop", "0.5", "--no-isolated", "--out", "it.csv")
    assert code == 0, told
    assert (folder / "it.csv").read_text().startswith("time,")


@needs_compiler
def test_check_tells_by_its_exit_code(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from inertance.fmu.check import states as check_states

    monkeypatch.setattr(check_states, "INSTANCES", 2)
    monkeypatch.setattr(check_states, "REPEATED", 1)
    words = ["check", "model.py:build", "--stop", "0.2", "--step", "0.01", "--fmi", "2.0", "--json", "r.json"]
    code, told = run(*words)
    assert (code, "all good" in told) == (0, True), told
    assert json.loads((folder / "r.json").read_text())["passed"] is True
    code, told = run(*words, "--limit", "1e-15")
    assert (code, "FAILED" in told) == (1, True)


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (["check", "absent.fmu"], 1, "there is no file 'absent.fmu'"),
        (["check", "model.py:built"], 2, "did you mean 'build'"),
        (["check", "model.py:build", "--stop=-1"], 2, "stop must be finite and at least 1e-06 s"),
        (["check", "model.py:build", "--input", "x"], 2, "tables end in .csv"),
        (["check", "it.fmu", "--input", "x=a"], 2, "NAME=VALUE"),
        (["export", "model.py:build", "it.zip"], 2, "ends in '.fmu'"),
        (["export", "model.py:build", "it.fmu", "--fmi", "1.0"], 2, "fmi_version must be one of"),
        (["export", "model.py:build", "it.fmu", "--terminal", "mass.flange"], 2, "FLANGE=CAUSALITY"),
        (["import-test", "it.fmu", "--out", "it.txt"], 2, ".csv"),
    ],
)
def test_wrong_use_is_told(folder: Path, words: list[str], code: int, told: str) -> None:
    before = sorted(folder.iterdir())
    found = run(*words)
    assert (found[0], told in found[1]) == (code, True), found
    assert sorted(p for p in folder.iterdir() if p.name != "__pycache__") == before


def archive(**files: str) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as packed:
        for name, text in files.items():
            packed.writestr(name.replace("__", "/"), text)
    return data.getvalue()


OLD = '<fmiModelDescription fmiVersion="1.0"/>'
BAD = {
    "corrupt": (b"PK no archive", "no sound zip archive"),
    "empty": (archive(), "has no modelDescription.xml"),
    "no xml": (archive(**{"modelDescription.xml": "<fmi"}), "is no XML"),
    "old": (
        archive(**{"modelDescription.xml": '<fmiModelDescription fmiVersion="1.0"/>'}),
        "only FMI 2.0 and 3.0",
    ),
    "escape": (archive(**{"../out.txt": "x", "modelDescription.xml": "<a/>"}), "leads out of the archive"),
    "absolute": (archive(**{"/out.txt": "x", "modelDescription.xml": "<a/>"}), "is an absolute path"),
}


@pytest.mark.parametrize("name", BAD)
@pytest.mark.parametrize("command", ["check", "info", "import-test"])
def test_bad_fmus_are_clear_errors(folder: Path, name: str, command: str) -> None:
    content, told = BAD[name]
    inside = folder / "inside"
    inside.mkdir()
    (inside / "bad.fmu").write_bytes(content)
    code, output = run(command, "inside/bad.fmu")
    assert (code, told in output) == (1, True), output
    assert sorted(p.name for p in inside.iterdir()) == ["bad.fmu"]
    assert not (folder / "out.txt").exists()


@needs_compiler
def test_a_model_file_may_hold_dataclasses(folder: Path) -> None:
    """The machines of examples/fmu_models.py could not be checked on the command line."""
    case = "\n\n@dataclass\nclass Case:\n    name: str\n"
    (folder / "model.py").write_text(
        f"from __future__ import annotations\nfrom dataclasses import dataclass\n{MODEL}{case}"
    )
    code, told = run("export", "model.py:build", "it.fmu")
    assert (code, "wrote it.fmu" in told) == (0, True), told


DRIVEN = """
import inertance as ia


def build():
    inner = ia.Network("rig", road=ia.Position(), load=ia.Force(f=0.0))
    net = ia.Network("driven", rig=inner, spring=ia.SpringDamper(k=100.0, d=1.0), mass=ia.Mass(m=1.0))
    net.connect(net.rig.road.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.rig.load.flange)
"""


@needs_compiler
def test_a_table_drives_a_network_and_its_fmus(folder: Path) -> None:
    (folder / "driven.py").write_text(DRIVEN)
    rows = [f"{t / 100},{10 * (t / 100) ** 2},{t / 50}" for t in range(41)]
    (folder / "road.csv").write_text("\n".join(["time,rig.road.s_ref [mm],rig.load.f", *rows]))
    code, told = run("check", "driven.py:build", "--input", "road.csv", "--fmi", "3.0", "--json", "it.json")
    assert code == 0, told
    assert "all good" in told
    code, told = run("check", "driven.py:build", "--input", "road.csv", "--stop", "1")
    assert code == 1 or code == 2
    assert "rig.road.s_ref" in told
    assert "0.4 s" in told


def test_a_table_for_an_fmu_alone_is_sent_to_what_takes_it(folder: Path) -> None:
    code, told = run("check", "it.fmu", "--input", "road.csv")
    assert code == 2
    assert "`inertance fmu import-test it.fmu --input road.csv` runs it on a table" in told
