"""What drifts does so from where a run began, whatever the clocks of its records show."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import inertance as ia
import pytest
from inertance.identification import Campaign, Record

CHANNELS = {
    "F": {"input": "push.f", "unit": "N"},
    "x": {"output": "carriage.s", "unit": "m"},
}
PRIORS = {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}}


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(rate=500.0, duration=6.0, noise=1e-5)


def warming() -> ia.Network:
    """A cart whose guide gets stiffer by the second."""
    net = ia.Network(
        "cart", wall=ia.Fixed(), spring=ia.Spring(k=800.0), guide=ia.VariableDamper(d=6.0, d_u=1.5)
    )
    net.add(carriage=ia.Mass(m=2.0), push=ia.Force(), clock=ia.signals.Clock())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)
    return net.connect(net.clock.y, net.guide.u)


def on_a_clock_of_its_own(record: Record, begin: float) -> Record:
    return replace(record, time=record.time + begin)


def began(records: list[Record], cart: Any) -> list[float]:
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, [{"record": record} for record in records])
    return [experiment.began for experiment in campaign.experiments]


def test_a_drift_counts_from_where_a_run_began(cart: Any) -> None:
    """By clocks that stand anywhere, what drifts would be larger by another amount in each record."""
    records = [
        on_a_clock_of_its_own(cart.measured(warming(), n), begin)
        for n, begin in ((1, 0.0), (2, 411.7), (3, 173.2))
    ]
    train, test = [{"record": r} for r in records[:2]], [{"record": records[2]}]
    found = ia.diagnose(Campaign(cart.rig(), CHANNELS, PRIORS, train, test))
    assert [placed.label for placed in found.effects] == ["viscous_drift at guide"]
    assert found.effects[0].values["d_u"] == pytest.approx(1.5, rel=0.05)


def test_pieces_of_a_run_go_on_where_others_ended(cart: Any) -> None:
    whole = on_a_clock_of_its_own(cart.measured(warming(), 1), 100.0)
    first, second = whole.window(100.0, 103.0), replace(whole.window(103.2, 106.0), name="second piece")
    other = on_a_clock_of_its_own(cart.measured(warming(), 2), 250.0)
    assert began([second, other, first], cart) == pytest.approx([100.0, 250.0, 100.0])
    late = on_a_clock_of_its_own(cart.measured(warming(), 2), 110.0)
    assert began([first, late], cart) == [100.0, 110.0]
