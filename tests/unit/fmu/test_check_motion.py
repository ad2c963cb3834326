"""Checks that could say little, or fail an FMU for what it is not to blame for, say so."""

from __future__ import annotations

import shutil
from pathlib import Path

import inertance as ia
import pytest

pytestmark = [
    pytest.mark.skipif(
        not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
    ),
    pytest.mark.usefixtures("few_instances"),
]


def held() -> ia.Network:
    """A spring between a wall and a prescribed motion: no states."""
    net = ia.Network("held", wall=ia.Fixed(), spring=ia.Spring(k=100.0), hand=ia.Position())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.hand.flange)


def oscillator(k: float = 100.0) -> ia.Network:
    net = ia.Network(
        "oscillator", wall=ia.Fixed(), spring=ia.Spring(k=k), mass=ia.Mass(m=1.0), push=ia.Force()
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def test_without_states_and_outputs_there_is_nothing_to_compare(tmp_path: Path) -> None:
    """numpy wanted an array to concatenate, and a state of no numbers differed from itself."""
    report = ia.fmu.check_fmu(held(), 0.2, step=0.01, versions=["2.0"])
    assert (report.passed, report.vacuous) == (True, True)
    assert "give outputs= that move" in report.of("native", "motion").told
    assert str(report).endswith("nothing moved, so that agreement says little: see 'motion'")
    path = ia.export_fmu(held(), tmp_path / "held.fmu")
    report = ia.fmu.check_fmu(path, 0.2, step=0.01, isolated=False)
    assert (report.failures, report.vacuous) == ([], True)


def test_without_states_an_output_is_compared() -> None:
    report = ia.fmu.check_fmu(
        held(), 0.2, step=0.01, versions=["3.0"], outputs=["spring.f"], inputs={"hand.s_ref": 0.1}
    )
    assert (report.failures, report.vacuous) == ([], True)
    assert report.of("FMI 3.0 CS", "outputs").passed


def test_what_rests_is_told(tmp_path: Path) -> None:
    """It said "37 checks, all good" of a machine that never moved."""
    report = ia.fmu.check_fmu(oscillator(), 0.2, step=0.01, versions=["2.0"])
    assert report.vacuous
    assert (
        "nothing moves: each of 2 variables is constant; give inputs=" in report.of("native", "motion").told
    )
    assert report.to_dict()["vacuous"] is True
    path = ia.export_fmu(oscillator(), tmp_path / "it.fmu")
    report = ia.fmu.check_fmu(path, 0.2, step=0.01, isolated=False)
    assert report.of("FMI 2.0 ME", "motion").passed is None
    report = ia.fmu.check_fmu(path, 0.2, step=0.01, inputs={"push.f": 1.0}, isolated=False)
    assert (report.passed, report.vacuous) == (True, False)


def test_an_fmu_is_not_to_blame_for_cvodes_limit_of_steps(capfd: pytest.CaptureFixture[str]) -> None:
    """500 steps from one output to the next were too few for 40 periods, and the FMU had FAILED."""
    report = ia.fmu.check_fmu(oscillator(k=1e6), 1.0, step=0.25, versions=["3.0"], inputs={"push.f": 1e4})
    assert "mxstep" in capfd.readouterr().err
    assert report.passed, str(report)
    error = report.of("FMI 3.0 ME", "outputs").error
    assert error is not None
    assert error < 1e-5
