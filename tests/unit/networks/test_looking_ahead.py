"""What is looked at before a run: no more than is needed, and what hides on a crest all the same."""

from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.machines import RandomDisplacement
from inertance.networks.simulation import legs


def test_crests_of_a_sum_of_sines_are_not_halved_again_and_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Bounds by slopes alone halve the intervals around each crest ten times over, 2500 for these 2 s."""
    looked, look_at = list[int](), legs._looked_at

    def counted(signals: Any, low: Any, *rest: Any, **told: Any) -> Any:
        looked.append(len(low))
        return look_at(signals, low, *rest, **told)

    monkeypatch.setattr(legs, "_looked_at", counted)
    road = ia.Position(s_ref=RandomDisplacement(seed=1, period=8.0))
    net = ia.Network("shaken", road=road, spring=ia.Spring(k=1e3), mass=ia.Mass(m=1.0))
    net.connect(net.road.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
    net.simulate(1.0, begin=-1.0)
    assert 0 < sum(looked) < 500


@pytest.mark.parametrize("width", [1e-2, 1e-3, 1e-4, 1e-5])
def test_a_pulse_on_a_crest_is_seen(width: float) -> None:
    def ended(height: float) -> float:
        def push(t: Any) -> Any:
            return ca.sin(2 * np.pi * t) + height * ca.exp(-(((t - 0.2503) / width) ** 2))

        net = ia.Network("pushed", push=ia.Force(f=push), mass=ia.Mass(m=1.0))
        run = net.connect(net.push.flange, net.mass.flange).simulate(1.0, rtol=1e-10, atol=1e-14)
        return float(run["mass.v"][-1])

    assert ended(0.1) - ended(0.0) == pytest.approx(0.1 * np.sqrt(np.pi) * width, rel=1e-3, abs=1e-11)
