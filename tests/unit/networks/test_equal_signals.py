"""Signals whose difference is nothing at all times cost no steps."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import signals


@pytest.mark.parametrize(
    ("kind", "more"),
    [
        (signals.LimPI, {}),
        (signals.LimPI, {"wp": 0.8}),
        (signals.LimPID, {"Td": 0.1}),
        (signals.LimPID, {"Td": 0.1, "wd": 1.0}),
    ],
)
@pytest.mark.parametrize(
    "source", [signals.Sine(amplitude=3.0, f=2.0, offset=0.4), signals.Ramp(height=2.0, duration=0.7)]
)
def test_a_controller_without_error_takes_no_short_steps(
    kind: Any, more: dict[str, float], source: Any
) -> None:
    net = ia.Network("held", wanted=source, control=kind(k=2.0, Ti=0.5, y_max=1.5, **more))
    net.connect(net.wanted.y, net.control.u_s, net.control.u_m)
    run = net.simulate(2.0)
    assert run.stats["steps"] < 2000
    if not more:
        assert np.abs(run["control.y"]).max() == 0.0


def test_equal_formulas_through_a_gain_of_one() -> None:
    net = ia.Network("loop", gain=signals.Gain(k=1.0), control=signals.LimPI(k=2.0, Ti=0.5, y_max=1.5))
    net.connect(net.gain.y, net.control.u_m)
    given: dict[str, Any] = {name: lambda t: np.sin(9 * t) for name in ("gain.u", "control.u_s")}
    run = net.simulate(1.0, inputs=given)
    assert run.stats["steps"] < 500
    other = net.simulate(1.0, inputs=given, parameters={"gain.k": 0.5})
    t = other.time
    integral = 0.5 * (1 - np.cos(9 * t)) / 9 / 0.5  # of half the setpoint
    unlimited = 2.0 * (0.5 * np.sin(9 * t) + integral)
    assert np.abs(unlimited).max() < 1.5
    assert other["control.y"] == pytest.approx(unlimited, abs=1e-5)
