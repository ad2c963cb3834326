"""Ctrl-C at the command line: it ends within seconds, with exit code 130, and states no verdict."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import inertance as ia
import pytest
from inertance.cli.terminal import insisting

LONGEST = 60.0  # seconds that the busiest machine may take to react
MARK = "begun"
MODEL = f"""
import pathlib, signal, threading, time
import inertance as ia


def watch():
    while signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        time.sleep(0.01)
    computing = time.process_time()
    while time.process_time() < computing + 0.5:
        time.sleep(0.01)
    pathlib.Path({MARK!r}).touch()


def swing():
    threading.Thread(target=watch, daemon=True).start()
    net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=1e6), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)
"""
WITHHELD = Path(ia.__file__).parent / "cli" / "withheld"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.py").write_text(MODEL)
    shutil.copytree(WITHHELD, tmp_path, dirs_exist_ok=True)
    rig = tmp_path / "rig.py"
    rig.write_text(f"import pathlib\npathlib.Path({MARK!r}).touch()\n{rig.read_text()}")
    return tmp_path


def is_alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def interrupted(after: float, *arguments: str) -> tuple[str, str]:
    """Send Ctrl-C, as a terminal does, some time after a model's sign; return what the command told."""
    process = subprocess.Popen(
        [sys.executable, "-m", "inertance", *arguments], start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    until = time.monotonic() + LONGEST
    while not Path(MARK).exists():
        assert process.poll() is None
        assert time.monotonic() < until
        time.sleep(0.02)
    time.sleep(after)
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=LONGEST)
    assert process.returncode == 130, err
    assert "Traceback" not in err
    until = time.monotonic() + LONGEST
    while is_alive(process.pid):
        assert time.monotonic() < until, "a process is left behind"
        time.sleep(0.05)
    return out, err


class Dropping:
    """An object whose end raises what Python then drops."""

    def __del__(self) -> None:
        raise KeyboardInterrupt


def test_ctrl_c_that_python_drops_is_sent_again() -> None:
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        drop_and_wait()
    assert time.monotonic() - began < LONGEST


def test_ctrl_c_that_a_compiled_library_drops_is_not_printed(capsys: pytest.CaptureFixture[str]) -> None:
    with insisting():
        sys.excepthook(KeyboardInterrupt, KeyboardInterrupt(), None)
        assert capsys.readouterr().err == ""
        sys.excepthook(ValueError, ValueError("seven"), None)
    assert "seven" in capsys.readouterr().err


def drop_and_wait() -> None:
    with insisting():
        Dropping()
        time.sleep(2 * LONGEST)


def test_run_keeps_what_it_has() -> None:
    out, err = interrupted(0.0, "run", "model.py:swing", "--stop", "3000", "--step", "0.1", "--out", "o.csv")
    assert "interrupted at t = " in err
    assert "wrote o.csv" in out
    assert 0 < ia.load_table("o.csv").index[-1] < 3000


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interrupted_diagnosis_states_no_verdict(jobs: str) -> None:
    options = ["--jobs", jobs, "--json", "v.json", "--report", "v.html"]
    out, err = interrupted(5.0, "diagnose", "campaign.toml", *options)
    assert "interrupted" in err
    if Path("v.json").exists():  # the parameters had been refitted
        told = json.loads(Path("v.json").read_text())
        assert told["verdict"] == "interrupted"
        assert "interrupted: The diagnosis was stopped before its end" in out
        assert "Nothing: the diagnosis was stopped before its end." in Path("v.html").read_text("utf-8")
    else:
        assert out == ""


@pytest.mark.parametrize("more", [[], ["--starts", "8", "--workers", "2"]], ids=["alone", "processes"])
def test_an_interrupted_fit_says_so(more: list[str]) -> None:
    out, err = interrupted(1.5, "fit", "campaign.toml", "--json", "f.json", *more)
    assert "interrupted" in err
    if Path("f.json").exists():
        assert json.loads(Path("f.json").read_text())["interrupted"] is True
        assert "the fit was interrupted before its end" in out
    else:
        assert out == ""


def test_a_check_of_fmus_is_ended() -> None:
    assert "interrupted" in interrupted(0.0, "fmu", "check", "model.py:swing", "--stop", "1000")[1]


def test_an_fmu_alone_is_ended() -> None:
    ia.export_fmu(ia.machines.quarter_car(ia.machines.suspension("S1", k=60e3, d=2000.0)), "car.fmu")
    Path(MARK).touch()
    options = ["--stop", "1e6", "--step", "1e-2"]
    assert "interrupted" in interrupted(4.0, "fmu", "import-test", "car.fmu", *options)[1]
