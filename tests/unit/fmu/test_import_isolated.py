"""Isolated FMUs: what they do to themselves, they do not do to us."""

from __future__ import annotations

import os
import signal
import threading
import time as clock
from pathlib import Path
from typing import Protocol

import numpy as np
import pytest
from inertance import FMU, FMUError


class Make(Protocol):
    def __call__(self, model: str, *defines: str) -> Path: ...


def test_the_same_numbers(make_fmu: Make) -> None:
    path = make_fmu("ball")
    here, there = (FMU(path, isolated=isolated).simulate(1.0, step=0.02) for isolated in (False, True))
    assert np.array_equal(here["h"], there["h"])
    assert here.events == there.events


@pytest.mark.parametrize(
    ("kind", "fault", "told"),
    [
        ("ME", 1, "'derivatives': its process was killed by SIGSEGV"),
        ("CS", 2, "'step': its process was killed by SIGABRT"),
        ("ME", 3, "'derivatives': its process ended itself with exit code 7"),
    ],
)
def test_crashes(
    make_fmu: Make, kind: str, fault: int, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    fmu = FMU(make_fmu("body"), isolated=True)
    with pytest.raises(FMUError, match=f"'body' crashed in {told}"):
        fmu.simulate(1.0, kind=kind, parameters={"fault": fault, "when": 0.1}, step=0.05)
    assert list(tmp_path.iterdir()) == []


def test_a_call_that_never_returns(make_fmu: Make) -> None:
    fmu = FMU(make_fmu("body"), isolated=True, timeout=0.7)
    with pytest.raises(FMUError, match=r"did not return from 'derivatives' within 0\.7 s and was ended"):
        fmu.simulate(1.0, parameters={"fault": 4, "when": 0.1}, step=0.05)


@pytest.mark.parametrize(("call", "named"), [(1, "instantiate"), (2, "start"), (3, "started"), (4, "step")])
def test_the_time_waited_is_what_was_asked(make_fmu: Make, call: int, named: str) -> None:
    fmu = FMU(make_fmu("body", f"HANG={call}"), isolated=True, timeout=0.5)
    began = clock.monotonic()
    with pytest.raises(FMUError, match=rf"did not return from '{named}' within 0\.5 s and was ended"):
        fmu.simulate(0.1, kind="CS", step=0.05)
    assert 0.5 < clock.monotonic() - began < 40  # with the start of a Python


@pytest.mark.parametrize("call", [5, 6], ids=["terminate", "free"])
def test_the_time_asked_is_what_the_end_of_an_fmu_is_given(make_fmu: Make, call: int) -> None:
    instance = FMU(make_fmu("body", f"HANG={call}"), isolated=True, timeout=0.5).instantiate("CS")
    instance.start(0.0, 1.0, 1e-6, [], [])
    instance.started()
    began = clock.monotonic()
    instance.close()
    assert 0.5 <= clock.monotonic() - began < 40


def test_an_interrupt_ends_what_hangs_at_once(make_fmu: Make) -> None:
    fmu = FMU(make_fmu("body", "HANG=4"), isolated=True, timeout=60.0)
    instance = fmu.instantiate("CS")
    instance.start(0.0, 1.0, 1e-6, [], [])
    instance.started()

    def step() -> None:
        threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT]).start()
        instance.step(0.0, 0.1, [], [])

    began = clock.monotonic()
    with pytest.raises(KeyboardInterrupt), instance:
        step()
    assert clock.monotonic() - began < 40


def test_errors_of_the_fmu_pass(make_fmu: Make) -> None:
    with pytest.raises(FMUError, match="binary lacks FMI functions: fmi2GetStringStatus"):
        FMU(make_fmu("body", "INCOMPLETE"), isolated=True).simulate(1.0, kind="CS")
