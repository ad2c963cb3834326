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
import numpy as np
import pytest
from inertance.cli import terminal
from inertance.cli.terminal import insisting

LONGEST = 60.0  # seconds that the busiest machine may take to react
SAMPLES = 1001
READING = "the model is read"
ERRORS = Path("errors.txt")
MODEL = f"""
import signal, sys, threading, time
import inertance as ia


def watch():
    while signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        time.sleep(0.01)
    computing = time.process_time()
    while time.process_time() < computing + 0.2:
        time.sleep(0.01)
    print({READING!r}, file=sys.stderr, flush=True)


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
    for record in tmp_path.glob("*.npz"):  # a part of each, to be where Ctrl-C comes the sooner
        with np.load(record) as whole:
            part = {name: values[:SAMPLES] for name, values in whole.items()}
        np.savez(record, **part)
    rig = tmp_path / "rig.py"
    rig.write_text(f"import sys\nprint({READING!r}, file=sys.stderr, flush=True)\n{rig.read_text()}")
    return tmp_path


def is_alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def interrupted(sign: str, *arguments: str) -> tuple[str, str]:
    """Send Ctrl-C, as a terminal does, at a sign on standard error; return what the command told."""
    with ERRORS.open("w") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "inertance", *arguments], start_new_session=True,
            stdout=subprocess.PIPE, stderr=errors, text=True,
        )  # fmt: skip
    until = time.monotonic() + LONGEST
    while sign not in ERRORS.read_text():
        assert process.poll() is None, ERRORS.read_text()
        assert time.monotonic() < until
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    out, _ = process.communicate(timeout=LONGEST)
    err = ERRORS.read_text()
    assert process.returncode == 130, err
    assert "Traceback" not in err, err
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


def test_ctrl_c_that_is_being_sent_again_comes_before_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[bool] = []

    def send_slowly() -> None:
        sent.append(False)
        time.sleep(0.3)
        sent.append(True)

    monkeypatch.setattr(terminal, "_send", send_slowly)
    with insisting():
        Dropping()
        while not sent:
            time.sleep(0.001)
    assert sent == [False, True]


def test_ctrl_c_that_a_compiled_library_drops_is_not_printed(capsys: pytest.CaptureFixture[str]) -> None:
    with insisting():
        sys.excepthook(KeyboardInterrupt, KeyboardInterrupt(), None)
        assert capsys.readouterr().err == ""
        sys.excepthook(ValueError, ValueError("seven"), None)
    assert "seven" in capsys.readouterr().err


def test_ctrl_c_in_text_that_is_executed_ends_by_the_exit_code(tmp_path: Path) -> None:
    (tmp_path / "rig.py").write_text("def build():\n    exec('raise KeyboardInterrupt')\n")
    command = [sys.executable, "-m", "inertance", "run", str(tmp_path / "rig.py:build"), "--stop", "1"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert (done.returncode, done.stderr) == (130, "interrupted\n")


def drop_and_wait() -> None:
    with insisting():
        Dropping()
        time.sleep(2 * LONGEST)


def test_run_keeps_what_it_has() -> None:
    options = ["--stop", "3000", "--step", "0.1", "--out", "o.csv"]
    out, err = interrupted(READING, "run", "model.py:swing", *options)
    assert "interrupted at t = " in err
    assert "wrote o.csv" in out
    assert 0 < ia.load_table("o.csv").index[-1] < 3000


@pytest.mark.parametrize(
    ("sign", "jobs"),
    [
        (READING, "1"),
        ("refitting the parameters", "2"),  # as the other processes begin
        ("screening effects", "1"),
        ("screening effects", "2"),
        ("fitted ", "2"),
    ],
)
def test_an_interrupted_diagnosis_states_no_verdict(sign: str, jobs: str) -> None:
    options = ["--jobs", jobs, "--json", "v.json", "--report", "v.html"]
    out, err = interrupted(sign, "diagnose", "campaign.toml", *options)
    assert "interrupted" in err
    if sign in ("screening effects", "fitted "):  # the parameters had been refitted
        told = json.loads(Path("v.json").read_text())
        assert told["verdict"] == "interrupted"
        assert "interrupted: The diagnosis was stopped before its end" in out
        assert "Nothing: the diagnosis was stopped before its end." in Path("v.html").read_text("utf-8")
    else:
        assert out == ""
        assert not Path("v.json").exists()


@pytest.mark.parametrize(
    ("sign", "more"),
    [
        (READING, []),
        ("iteration 1,", []),
        ("start 1 of 8", ["--starts", "8", "--workers", "2"]),
    ],
)
def test_an_interrupted_fit_says_so(sign: str, more: list[str]) -> None:
    out, err = interrupted(sign, "fit", "campaign.toml", "--json", "f.json", *more)
    assert "interrupted" in err
    if sign == READING:
        assert out == ""
        assert not Path("f.json").exists()
    else:
        assert json.loads(Path("f.json").read_text())["interrupted"] is True
        assert "the fit was interrupted before its end" in out


def test_a_check_of_fmus_is_ended() -> None:
    assert "interrupted" in interrupted(READING, "fmu", "check", "model.py:swing", "--stop", "1000")[1]


def test_an_fmu_alone_is_ended() -> None:
    ia.export_fmu(ia.machines.quarter_car(ia.machines.suspension("S1", k=60e3, d=2000.0)), "car.fmu")
    options = ["--stop", "1e5", "--step", "0.1"]
    assert "interrupted" in interrupted("running ", "fmu", "import-test", "car.fmu", *options)[1]
