"""Elements between two ends that move alike, or nearly: what differs is seen, and nothing else."""

from typing import Any

import inertance as ia
import numpy as np
import pytest

LAWS = {
    "DahlFriction": ia.DahlFriction(f_c=5.0, s_p=0.01),
    "BoucWen": ia.BoucWen(k=100.0, beta=0.5, gamma=0.3),
    "Maxwell": ia.Maxwell(k=100.0, d=10.0),
    "Damper": ia.Damper(d=3.0),
}


def motion(t: Any) -> Any:
    return 0.015 * (np.sin(5 * t) + 1)


def between(element: ia.Component, first: Any, second: Any) -> ia.Network:
    net = ia.Network(
        "between", element=element.clone(), a=ia.Position(s_ref=first), b=ia.Position(s_ref=second)
    )
    net.connect(net.a.flange, net.element.flange_a)
    return net.connect(net.element.flange_b, net.b.flange)


@pytest.mark.parametrize("solver", ["auto", "rosenbrock"])
@pytest.mark.parametrize("law", LAWS)
def test_ends_that_move_alike_leave_an_element_at_rest(law: str, solver: str) -> None:
    again = lambda t: 0.015 * (np.sin(5 * t) + 1)  # noqa: E731
    for other in (motion, again):
        run = between(LAWS[law], motion, other).simulate(2.0, begin=0.3, solver=solver)
        assert np.abs(run["element.f"]).max() < 1e-12
        assert run.stats["steps"] < 100


def test_a_small_difference_of_large_motions_is_followed() -> None:
    for size in (1e-9, 1e-4):
        net = between(LAWS["Maxwell"], motion, lambda t, size=size: motion(t) + size * np.sin(t))
        run = net.simulate(8.0, atol=1e-6 * size)
        assert run.stats["steps"] < 1000
        t = run.time
        z = size * (10 * np.sin(t) - np.cos(t) + np.exp(-10 * t)) * 10 / 101
        assert run["element.z"] == pytest.approx(z, abs=1e-4 * size)


def test_a_pulse_in_one_of_two_motions_is_not_stepped_over() -> None:
    pulse = lambda t: motion(t) + 0.01 * np.exp(-(((t - 5.2) / 1e-3) ** 2))  # noqa: E731
    run = between(LAWS["Maxwell"], motion, pulse).simulate(8.0, step=0.5)
    gained = 10 * 0.01 * 1e-3 * np.sqrt(np.pi)  # z' = 10 (s_rel - z) over so short a time
    assert run["element.z"][-1] == pytest.approx(gained * np.exp(-10 * 2.8), rel=0.03)
