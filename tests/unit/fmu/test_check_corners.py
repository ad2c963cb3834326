"""Derivatives near rest, where a law has none of its own to speak of: right ones pass, wrong ones do not."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.fmu.check import probe, sections
from inertance.fmu.check.probe import CheckedFMU
from inertance.fmu.check.report import Finding
from inertance.fmu.check.sections import Plan

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


def near_rest(at: float) -> ia.Network:
    """A mass that a cubic spring and a quadratic damper hold, beside a force a million times theirs."""
    net = ia.Network("near rest", wall=ia.Fixed(), mass=ia.Mass(m=1.0, s=at, v=-2 * at))
    net.add(spring=ia.CubicSpring(k=0.0, k3=40.0), damper=ia.QuadraticDamper(c=3.0))
    net.add(push=ia.ConstantForce(f_constant=1e-3))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.mass.flange, net.spring.flange_b, net.damper.flange_b, net.push.flange)


@pytest.fixture(scope="module", params=[0.0, 1e-7, -3e-5, 0.02])
def exported(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ia.export_fmu(near_rest(request.param), tmp_path_factory.mktemp("near_rest") / "it.fmu")


def found(path: Path) -> dict[str, Finding]:
    """Return what is found in runs, which look at derivatives."""
    with CheckedFMU(path) as fmu:
        plan = Plan(stop=0.02, step=1e-3, rtol=1e-6, limit=1e-5, inputs={})
        return {finding.check: finding for finding in sections.runs(fmu, plan)}


def test_slopes_that_vanish_are_no_fault(exported: Path) -> None:
    told = found(exported)
    assert told["directional derivatives"].passed
    assert not [str(finding) for finding in told.values() if finding.passed is False]


@pytest.mark.parametrize("wrong", [1e-4, -2.0])
def test_slopes_that_do_not_vanish_there_are(
    exported: Path, wrong: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = probe.Probe.directional

    def off(self: Any, rows: Any, columns: Any, seed: Any) -> Any:
        given = np.array(right(self, rows, columns, seed))
        return np.where(np.abs(given) < 1.0, given + wrong, given)

    monkeypatch.setattr(probe.Probe, "directional", off)
    assert found(exported)["directional derivatives"].passed is False
