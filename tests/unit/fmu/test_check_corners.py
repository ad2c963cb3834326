"""Derivatives near rest, where a law has none of its own to speak of: right ones pass, wrong ones do not."""

from __future__ import annotations

import shutil
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.fmu.check import probe

pytestmark = [
    pytest.mark.skipif(
        not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
    ),
    pytest.mark.usefixtures("few_instances"),
]


def near_rest(at: float) -> ia.Network:
    """A mass that a cubic spring and a quadratic damper hold, beside a force a million times theirs."""
    net = ia.Network("near rest", wall=ia.Fixed(), mass=ia.Mass(m=1.0, s=at, v=-2 * at))
    net.add(spring=ia.CubicSpring(k=0.0, k3=40.0), damper=ia.QuadraticDamper(c=3.0))
    net.add(push=ia.ConstantForce(f_constant=1e-3))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.mass.flange, net.spring.flange_b, net.damper.flange_b, net.push.flange)


@pytest.mark.parametrize("at", [0.0, 1e-7, -3e-5, 0.02])
def test_slopes_that_vanish_are_no_fault(at: float) -> None:
    report = ia.fmu.check_fmu(near_rest(at), 0.02, step=1e-3, versions=["2.0"])
    assert report.passed, str(report)


@pytest.mark.parametrize("at", [0.0, 1e-7, -3e-5, 0.02])
@pytest.mark.parametrize("wrong", [1e-4, -2.0])
def test_slopes_that_do_not_vanish_there_are(
    at: float, wrong: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = probe.Probe.directional

    def off(self: Any, rows: Any, columns: Any, seed: Any) -> Any:
        given = np.array(right(self, rows, columns, seed))
        return np.where(np.abs(given) < 1.0, given + wrong, given)

    monkeypatch.setattr(probe.Probe, "directional", off)
    report = ia.fmu.check_fmu(near_rest(at), 0.02, step=1e-3, versions=["2.0"])
    assert report.of("FMI 2.0 ME", "directional derivatives").passed is False
