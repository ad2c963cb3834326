"""examples/fmu_models.py: at the tolerance asked for by default, FMUs agree within ten tolerances."""

import shutil
from typing import Any

import pytest
from inertance.fmu.check import states as check_states

EXAMPLE = "fmu_models"
pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


def test_sticking_and_slipping(example: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check_states, "INSTANCES", 5)
    report = example.check("stick_slip", versions=["3.0"])
    assert report.passed, str(report)
    assert "rtol 1e-06" in report.of("FMI 3.0 CS", "outputs").told
    assert "rtol 1e-12" in report.of("FMI 3.0 ME", "outputs").told
    for kind in ("ME", "CS"):
        assert report.of(f"FMI 3.0 {kind}", "outputs").limit == pytest.approx(1e-5)
        assert report.of(f"FMI 3.0 {kind}", "events").error < 1e-7
    native = report.of("native", "rtol 1e-06")
    assert native.passed is None  # told, not judged


def test_the_end_of_bouncing_is_found(example: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check_states, "INSTANCES", 5)
    report = example.check("bouncing_ball", versions=["2.0"])
    assert report.passed, str(report)
    assert "of 37 events" in report.of("FMI 2.0 ME", "events").told
