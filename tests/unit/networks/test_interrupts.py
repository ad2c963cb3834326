"""Ctrl-C: a real signal to a real process ends every kind of run, which keeps what it has."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from threading import Thread, Timer
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.base import interrupts
from inertance.networks.csource import native

LONGEST = 1.0  # seconds of processor time, which other load on the machine does not lengthen
HANGING = 120.0
SCRIPT = """
import json, os, signal, sys, threading, time
import numpy as np
import inertance as ia

def swing(**more):
    net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=1e6), mass=ia.Mass(m=1.0, s=0.1), **more)
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)

def rubbing():
    net = swing(rub=ia.CoulombFriction(f_c=1.0))
    net.connect(net.wall.flange, net.rub.flange_a)
    return net.connect(net.mass.flange, net.rub.flange_b)

def watch():
    # Say when a run is under way, and note when Ctrl-C arrives.
    while signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        time.sleep(0.01)
    computing = time.process_time()
    while time.process_time() < computing + 0.2:
        time.sleep(0.01)
    print("begun", flush=True)
    os.read(ear, 1)
    heard.append(time.process_time())

def run(kind):
    global watching
    dae = (rubbing() if kind in ("events", "stepwise") else swing()).dae()
    solver = kind if kind in ("idas", "rosenbrock", "compiled") else "auto"
    options = {"solver": solver, "progress": False}
    if kind == "stepwise":
        run = ia.Stepwise(dae, 0.0, 3000.0, {}, {}, solver="cvodes")
        run.advance(0.01)
        watching = threading.Thread(target=watch, daemon=True)
        watching.start()
        run.advance(3000.0)
    if kind == "sensitivities":
        options["sensitivities"] = ["spring.k"]
    ia.simulate(dae, 0.01, **options)
    watching = threading.Thread(target=watch, daemon=True)
    watching.start()
    ia.simulate(dae, 3000.0, step=3.0 if kind == "steps" else 0.01, **options)

heard = []
ear, mouth = os.pipe()
os.set_blocking(mouth, False)
signal.set_wakeup_fd(mouth)
for kind in sys.argv[1:]:
    try:
        run(kind)
    except BaseException as error:
        ended = time.process_time()
        watching.join(10.0)
        result = getattr(error, "result", None)
        told = {"error": type(error).__name__, "interrupt": isinstance(error, KeyboardInterrupt)}
        told["took"] = ended - heard.pop() if heard else None
        if result is not None:
            told |= {"points": len(result.time), "rising": bool((np.diff(result.time) >= 0).all())}
            told["off"] = float(np.abs(result["mass.s"] - 0.1 * np.cos(1000 * result.time))[:50].max())
        print(json.dumps(told), flush=True)
    else:
        print(json.dumps({"error": "none"}), flush=True)
"""
KINDS = ("cvodes", "idas", "rosenbrock", "compiled", "steps", "events", "sensitivities", "stepwise")


def interrupted(process: subprocess.Popen[str]) -> dict[str, Any]:
    """Send Ctrl-C to the run that a process has begun, and return what it tells of its end."""
    assert process.stdout is not None
    assert process.stdout.readline() == "begun\n"
    process.send_signal(signal.SIGINT)
    told: dict[str, Any] = json.loads(process.stdout.readline() or "{}")
    assert told.get("error") == "RunInterruptedError"
    assert told["took"] < LONGEST
    assert told["interrupt"]
    assert told["rising"]
    return told


def test_ctrl_c_ends_every_kind_of_run_and_keeps_what_it_computed(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    process = subprocess.Popen(
        [sys.executable, str(script), *KINDS],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    expired = Timer(HANGING, process.kill)
    expired.start()
    try:
        found = {kind: interrupted(process) for kind in KINDS}
        assert process.wait() == 0
        assert process.stderr is not None
        assert process.stderr.read() == ""
    finally:
        expired.cancel()
        process.kill()
        process.communicate()
    for kind in ("cvodes", "idas", "rosenbrock", "compiled"):
        assert found[kind]["points"] > 3, kind
        assert found[kind]["off"] < 1e-3, kind
    assert found["events"]["points"] > 3


def test_a_handler_of_ones_own_that_only_notes_ctrl_c_lets_the_run_go_on(swing: ia.Network) -> None:
    heard = []
    before = signal.signal(signal.SIGINT, lambda *_: heard.append(1))
    try:
        Timer(0.1, os.kill, [os.getpid(), signal.SIGINT]).start()
        run = swing.simulate(3.0, progress=False)
        until = time.monotonic() + HANGING
        while not heard and time.monotonic() < until:
            time.sleep(0.01)
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard == [1]
    assert run.time[-1] == 3.0


def test_the_handler_stands_as_before_after_runs(swing: ia.Network) -> None:
    before = signal.getsignal(signal.SIGINT)
    swing.simulate(0.01)
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(ia.SimulationError):
        swing.simulate(0.01, max_steps=1)
    assert signal.getsignal(signal.SIGINT) is before


def test_points_of_a_failed_run_lie_in_order() -> None:
    net = ia.Network("diverging", wall=ia.Fixed(), spring=ia.CubicSpring(k=0.0, k3=-1.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    start = {"mass.s": 1.0, "mass.v": 1.0}
    with pytest.raises(ia.SimulationError) as failed:
        net.simulate(1.6, step=1.6 / 2051, start=start)  # fails in the last chunk, which begins early
    result = failed.value.result
    assert isinstance(result, ia.Result)
    assert (np.diff(result.time) > 0).all()


@pytest.fixture
def swing() -> ia.Network:
    net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=1e6), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


def test_what_a_handler_tells_within_a_run_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    ear = interrupts._Ear(lambda *_: print("noted", file=sys.stderr))
    interrupts._HERE.ear = ear
    try:
        with interrupts.foreign():
            print("IDAS tells of a step", file=sys.stderr)
            ear(signal.SIGINT, None)
            print("and of another one", file=sys.stderr)
        print("after it", file=sys.stderr)
    finally:
        interrupts._HERE.ear = None
    assert capsys.readouterr().err == "noted\nafter it\n"


def test_what_another_thread_tells_meanwhile_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    with interrupts.foreign():
        elsewhere = Thread(target=print, args=("progress",), kwargs={"file": sys.stderr})
        elsewhere.start()
        elsewhere.join()
        kept = sys.stderr
    print("after it", file=kept)  # as a progress bar does that began within
    assert capsys.readouterr().err == "progress\nafter it\n"


def test_ctrl_c_while_equations_are_built_is_not_lost() -> None:
    def forgotten(t: Any) -> Any:
        with suppress(KeyboardInterrupt):  # as CasADi forgets what Python raises where it is called back
            signal.raise_signal(signal.SIGINT)
        return t

    net = ia.Network("pressed", push=ia.Force(f=forgotten), mass=ia.Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    with pytest.raises(KeyboardInterrupt):
        net.simulate(0.01)


def test_ctrl_c_before_the_first_step_keeps_the_start(
    swing: ia.Network, monkeypatch: pytest.MonkeyPatch
) -> None:
    def pressed() -> None:
        raise interrupts.Interrupted

    monkeypatch.setattr(native, "heed", pressed)
    with pytest.raises(ia.RunInterruptedError, match="interrupted at t = 0 s of 1 s") as told:
        swing.simulate(1.0, solver="compiled")
    assert told.value.result is not None
    assert told.value.result.time.tolist() == [0.0]
