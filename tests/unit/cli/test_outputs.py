"""What commands write: refused before the work, whole, and on any terminal."""

import os
import subprocess
import sys
from pathlib import Path

import inertance as ia
import pytest
from inertance.cli import app
from typer.testing import CliRunner

MODEL = """
import pathlib
import inertance as ia


def swing():
    pathlib.Path("worked").touch()
    net = ia.Network("schwinge – größe", wall=ia.Fixed(), spring=ia.Spring(k=1.0), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


def pushed():
    net = swing().add(push=ia.Force())
    return net.connect(net.push.flange, net.mass.flange)
"""
CAMPAIGN = """
model = "model.py:pushed"
[channels]
F = { input = "push.f", unit = "N" }
x = { output = "mass.s", unit = "m" }
[parameters]
"spring.k" = { rel = 0.1 }
[[train]]
file = "absent.csv"
"""
ONE_AFTER_ANOTHER = """
import sys
from inertance.cli import app

words = sys.argv[1:]
while words:
    end = words.index(";")
    try:
        app(words[:end], prog_name="inertance")
    except SystemExit as ended:
        if ended.code:
            raise
    words = words[end + 1 :]
"""
OUTPUTS = (
    (["run", "model.py:swing", "--out", "{}"], ".csv"),
    (["fmu", "export", "model.py:swing", "{}"], ".fmu"),
    (["fmu", "check", "model.py:swing", "--json", "{}"], ".json"),
    (["fmu", "import-test", "some.fmu", "--out", "{}"], ".csv"),
    (["fit", "campaign.toml", "--json", "{}"], ".json"),
    (["fit", "campaign.toml", "--plot", "{}"], ".png"),
    (["diagnose", "campaign.toml", "--json", "{}"], ".json"),
    (["diagnose", "campaign.toml", "--report", "{}"], ".html"),
)
LEGACY = {
    "cp1252": {"PYTHONIOENCODING": "cp1252", "PYTHONUTF8": "0"},
    "ascii": {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"},
    "C": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.py").write_text(MODEL, encoding="utf-8")
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    (tmp_path / "some.fmu").touch()
    return tmp_path


def refused(*arguments: str) -> str:
    result = CliRunner().invoke(app, list(arguments))
    assert result.exit_code == 2, result.output
    assert not Path("worked").exists(), "the work was begun"
    return result.stderr


def commands(*several: list[str], **more: str) -> subprocess.CompletedProcess[bytes]:
    """Run commands one after another, in one interpreter, as far as they succeed."""
    env = {k: v for k, v in os.environ.items() if not k.startswith(("LC_", "LANG"))}
    words = [word for command in several for word in (*command, ";")]
    script = [sys.executable, "-c", ONE_AFTER_ANOTHER, *words]
    return subprocess.run(script, capture_output=True, env={**env, **more}, check=False)


@pytest.mark.parametrize(("arguments", "ending"), OUTPUTS, ids=lambda v: v[1] if isinstance(v, list) else v)
def test_what_cannot_be_written_is_refused_before_the_work(arguments: list[str], ending: str) -> None:
    Path(f"folder{ending}").mkdir()
    before = sorted(Path().iterdir())
    for name, told in (
        ("a.xyz", "a.xyz"),
        ("a", "'a'"),
        ("a" * 300, "aaa'"),
        (f"folder{ending}", "it is a folder"),
        (f"absent/a{ending}", "there is no folder 'absent' to write"),
        (f"/proc/a{ending}", f"'/proc/a{ending}' cannot be written"),
        (f"{'a' * 300}{ending}", "file name too long"),
    ):
        assert told in refused(*(text.format(name) for text in arguments))
    assert sorted(Path().iterdir()) == before


def test_a_report_is_no_pdf() -> None:
    told = refused("diagnose", "campaign.toml", "--report", "a.pdf")
    assert "--report: 'a.pdf' ends in '.pdf'; it must end in .html or .htm" in told


def test_results_do_not_overwrite_the_data_they_come_from() -> None:
    data = "time,push.f\n0,0\n1,1\n2,0\n3,0\n"
    Path("push.csv").write_text(data)
    told = refused("run", "model.py:pushed", "--input", "push.csv", "--out", "./push.csv")
    assert "--out push.csv would overwrite what --input reads" in told
    assert Path("push.csv").read_text() == data


def test_a_run_that_cannot_write_its_picture_does_not_begin() -> None:
    Path("swing.png").mkdir()
    assert "--plot: 'swing.png' cannot be written" in refused("run", "model.py:swing", "--plot", "mass.s")


def test_a_disk_that_is_full_leaves_no_half_table() -> None:
    code = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))\n"
    code += "from inertance.cli import app; app(sys.argv[1:])"
    Path("o.csv").write_text("old")
    script = [sys.executable, "-c", code, "run", "model.py:swing", "--out", "o.csv"]
    done = subprocess.run(script, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "'o.csv' cannot be written: file too large" in done.stderr
    assert Path("o.csv").read_text() == "old"
    assert not list(Path().glob(".*"))


@pytest.mark.parametrize("arguments", ["components", "components Spring", "run model.py:swing"])
def test_a_closed_pipe_is_silent(arguments: str) -> None:
    script = f"{sys.executable} -m inertance {arguments} | head -1; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    assert len(lines) == 2
    assert lines[1] in ("0", "141")


def test_a_pipe_closed_early_does_not_cost_the_results() -> None:
    script = f"{sys.executable} -m inertance run model.py:swing --out o.csv | true"
    assert subprocess.run(["bash", "-c", script], capture_output=True, check=True).stderr == b""
    assert len(ia.load_table("o.csv")) == 501


def test_a_full_standard_output_is_named() -> None:
    script = f"{sys.executable} -m inertance components > /dev/full"
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr == "error: standard output cannot be written: no space left on device\n"


@pytest.mark.parametrize("terminal", LEGACY)
def test_terminals_of_other_encodings_are_written_to_and_files_are_utf_8(terminal: str) -> None:
    shown = ["components", "Spring"], ["components"]
    run = ["run", "model.py:swing", "--out", "maß und größe.csv"]
    done = commands(*shown, run, ["fmu", "export", "model.py:swing", "ü.fmu"], **LEGACY[terminal])
    assert (done.returncode, done.stderr) == (0, b"")
    assert b">= 0" in done.stdout
    assert b"SpringDamper" in done.stdout
    assert len(ia.load_table("maß und größe.csv")) == 501
    assert ia.FMU("ü.fmu").name == "schwinge – größe"
