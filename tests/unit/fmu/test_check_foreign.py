"""Checks of foreign FMUs: what crashes, hangs or returns nonsense is a finding, in a process of its own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import inertance as ia
import pytest
from inertance.fmu.check.sections import SECTIONS

MakeFMU = Callable[..., Path]


def test_a_crash_is_a_finding(make_fmu: MakeFMU) -> None:
    report = ia.fmu.check_fmu(make_fmu("body", "FAULT=1"), 0.2, step=0.01)
    assert not report.passed
    told = [f.told for f in report.failures if f.check in SECTIONS]
    assert told
    assert all("crashed: the process was killed by SIGSEGV" in t for t in told)


def test_a_call_that_never_returns_is_a_finding(make_fmu: MakeFMU) -> None:
    report = ia.fmu.check_fmu(make_fmu("body", "FAULT=4"), 0.2, step=0.01, timeout=1.0)
    assert any("did not end within 1 s" in f.told for f in report.failures)


def test_a_model_that_returns_nan_is_a_finding(make_fmu: MakeFMU) -> None:
    report = ia.fmu.check_fmu(make_fmu("body", "FAULT=5"), 0.2, step=0.01, isolated=False)
    assert any("nan" in f.told for f in report.failures)


def test_sound_ones_pass(make_fmu: MakeFMU) -> None:
    report = ia.fmu.check_fmu(make_fmu("ball"), 0.6, step=0.01, isolated=False)
    runs = report.of("FMI 2.0 ME", "run")
    assert runs.passed, runs.told


def test_an_fmu_may_end_the_run(make_fmu: MakeFMU) -> None:
    report = ia.fmu.check_fmu(make_fmu("clock"), 1.5, step=0.01, isolated=False)
    runs = report.of("FMI 2.0 ME", "run")
    assert runs.passed, runs.told
    assert "to 1 s, where the FMU ended it" in runs.told


def test_what_is_no_fmu_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "broken.fmu"
    path.write_bytes(b"no archive")
    with pytest.raises(ia.FMUError, match="no sound zip archive"):
        ia.fmu.check_fmu(path)
