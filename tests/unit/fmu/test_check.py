"""Checks: networks against their FMUs, files against themselves, and that faults are found."""

from __future__ import annotations

import dataclasses
import json
import shutil
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.fmu import CheckReport, Finding
from inertance.fmu.check import agreement, derivatives, states
from inertance.fmu.check import probe as probe_module
from inertance.fmu.check.agreement import Reference, events_finding, modes_finding, outputs_finding
from inertance.fmu.check.report import measured
from inertance.fmu.check.runs import Course

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make few instances, to be quick."""
    monkeypatch.setattr(states, "INSTANCES", 5)
    monkeypatch.setattr(states, "REPEATED", 2)


def ball() -> ia.Network:
    net = ia.Network(
        "ball",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
        push=ia.Force(),
    )
    net.connect(net.floor.flange, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange, net.push.flange)


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("check")
    return ia.export_fmu(ball(), folder / "ball.fmu", fmi_version="3.0", stop=0.6, step=0.01)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_network_agrees_with_its_fmus(version: str) -> None:
    told: list[Finding] = []
    report = ia.fmu.check_fmu(
        ball(), 1.2, step=0.01, versions=[version], inputs={"push.f": 0.5}, found=told.append
    )
    assert report.passed, str(report)
    assert told == report.findings
    for kind in ("ME", "CS"):
        subject = f"FMI {version} {kind}"
        assert report.of(subject, "events").error < 1e-7  # type: ignore[operator]
        assert report.of(subject, "outputs").error < 1e-6  # type: ignore[operator]
    assert "all good" in str(report)
    assert json.loads(json.dumps(report.to_dict()))["passed"] is True


def test_a_file_is_held_against_itself(exported: Path) -> None:
    report = ia.fmu.check_fmu(exported, isolated=False)
    assert report.passed, str(report)
    assert report.of("FMI 3.0 CS", "outputs against ME").error < 1e-6  # type: ignore[operator]
    assert "1 event" in report.of("FMI 3.0 ME", "run").told


@pytest.mark.usefixtures("few_instances")
def test_a_wrong_derivative_is_found(exported: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = probe_module.Probe.directional
    monkeypatch.setattr(probe_module.Probe, "directional", lambda *given: right(*given) * 1.00001)
    report = ia.fmu.check_fmu(exported, isolated=False)
    found = report.of("FMI 3.0 ME", "directional derivatives")
    assert found.passed is False
    assert found.error == pytest.approx(1e-5, rel=0.01)
    assert report.of("FMI 3.0 ME", "adjoint derivatives").passed is False
    assert found.limit == derivatives.LIMIT


@pytest.mark.usefixtures("few_instances")
def test_a_state_that_is_not_restored_is_found(exported: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(probe_module.Probe, "restore_state", lambda probe, state: None)
    report = ia.fmu.check_fmu(exported, isolated=False)
    for kind in ("ME", "CS"):
        assert report.of(f"FMI 3.0 {kind}", "save and restore").passed is False
        assert report.of(f"FMI 3.0 {kind}", "reset equals fresh").passed is True


@pytest.mark.usefixtures("few_instances")
def test_another_network_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    heavier = ball().with_values(weight=ia.ConstantForce(f_constant=-4.906))
    write = ia.export_fmu
    monkeypatch.setattr(
        "inertance.fmu.check.against_network.export_fmu", lambda dae, *a, **k: write(heavier.dae(), *a, **k)
    )
    report = ia.fmu.check_fmu(ball(), 0.6, step=0.01, versions=["2.0"])
    assert not report.passed
    assert {f.check for f in report.failures if f.subject == "FMI 2.0 ME"} == {"outputs", "events"}
    assert {f.check for f in report.failures if f.subject == "FMI 2.0 CS"} == {"outputs", "events"}
    assert "failed" in str(report)


def course(values: list[list[float]], events: list[float]) -> Course:
    table = np.array(values, dtype=float)
    return Course(
        [f"y{k}" for k in range(table.shape[1])],
        np.arange(len(table), dtype=np.float64),
        table,
        np.array(events),
    )


def test_points_at_events_are_left_out_of_outputs() -> None:
    wanted = course([[1, 0], [2, 0], [3, 0]], [1.0])
    reference = Reference(wanted, np.array([4.0, 1e-12]))
    found = course([[1, 0], [9, 0], [3.004, 0]], [1.0 + 1e-8])
    finding = outputs_finding("it", found, reference, 1e-2)
    assert finding.passed
    assert finding.error == pytest.approx(1e-3)
    assert "y0 at 2 s" in finding.told
    assert outputs_finding("it", found, reference, 1e-4).passed is False
    bad = dataclasses.replace(found, values=np.array([[1, 0], [2, 0], [np.nan, 0]]))
    assert outputs_finding("it", bad, reference, 1e-2).passed is False


def test_every_event_wants_one_nearby() -> None:
    wanted = np.array([0.5, 1.0])
    assert events_finding("it", np.array([0.5 + 1e-8, 0.7, 1.0]), wanted).passed is True
    missing = events_finding("it", np.array([0.5]), wanted)
    assert (missing.passed, missing.error) == (False, 0.5)
    assert events_finding("it", np.array([]), wanted).passed is False
    assert agreement.EVENT_TOLERANCE == 1e-6


def test_a_mode_may_differ_where_nothing_else_does() -> None:
    wanted = course([[1], [1], [1]], [])
    reference = Reference(wanted, np.array([1.0]))
    modes = course([[0], [1], [1]], []), course([[0], [0], [1]], [])
    assert modes_finding("it", modes, wanted, reference, 1e-3).passed is True
    moved = course([[1], [1.1], [1]], [])
    found = modes_finding("it", modes, moved, reference, 1e-3)
    assert (found.passed, found.error) == (False, 1.0)


def test_nan_is_no_agreement() -> None:
    assert measured("it", "outputs", float("nan"), 1.0).passed is False
    assert not CheckReport("empty").passed


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"stop": -1.0}, "stop must be finite and at least 1e-06 s, got -1 s"),
        ({"step": 0.0}, "step must be finite and at least 1e-09 s"),
        ({"tolerance": 2.0}, "tolerance must lie between"),
        ({"versions": ["4.0"]}, "versions are of 2.0, 3.0"),
        ({"versions": []}, "versions are of 2.0, 3.0"),
        ({"inputs": {"push.ff": 1.0}}, "no free input 'push.ff'; did you mean 'push.f'"),
    ],
)
def test_wrong_options_are_told(options: dict[str, Any], told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        ia.fmu.check_fmu(ball(), **options)
