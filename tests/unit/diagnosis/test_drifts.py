"""What drifts does so from where a run began, whatever the clocks of its records show."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
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


def test_a_drift_that_settles_is_one_that_bends(cart: Any) -> None:
    """Oil warms up as a lag does: no line follows its damping over two time constants."""
    net = ia.Network("cart", wall=ia.Fixed(), spring=ia.Spring(k=800.0), on=ia.signals.Constant(k=1.0))
    net.add(guide=ia.VariableDamper(d=12.0, d_u=-6.0), oil=ia.signals.FirstOrder(T=3.0))
    net.add(carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)
    net.connect(net.on.y, net.oil.u).connect(net.oil.y, net.guide.u)
    train, test = ([{"record": cart.measured(net, n)} for n in some] for some in ((1, 2), (3,)))
    found = ia.diagnose(Campaign(cart.rig(), CHANNELS, PRIORS, train, test))
    assert found.verdict == "effect"
    (placed,) = found.effects
    assert placed.label == "viscous_drift at guide"
    assert placed.values["d_u"] < 0 < placed.values["d_uu"]
    assert found.closed > 0.95


def test_pieces_of_a_run_go_on_where_others_ended(cart: Any) -> None:
    whole = on_a_clock_of_its_own(cart.measured(warming(), 1), 100.0)
    first, second = whole.window(100.0, 103.0), replace(whole.window(103.2, 106.0), name="second piece")
    other = on_a_clock_of_its_own(cart.measured(warming(), 2), 250.0)
    assert began([second, other, first], cart) == pytest.approx([100.0, 250.0, 100.0])
    late = on_a_clock_of_its_own(cart.measured(warming(), 2), 110.0)
    assert began([first, late], cart) == [100.0, 110.0]


def test_a_window_is_of_a_run_that_began_where_its_file_does(cart: Any, tmp_path: Path) -> None:
    """A drift that has gone on before the window is no offset."""
    whole = on_a_clock_of_its_own(cart.measured(warming(), 1), 100.0)
    assert began([whole.window(103.0, 106.0)], cart) == [100.0]
    assert began([whole.window(101.0, 106.0).window(104.0, 106.0)], cart) == [100.0]
    columns = np.column_stack([whole.time, whole.values["F"], whole.values["x"]])
    np.savetxt(tmp_path / "run.csv", columns, delimiter=",", header="time,F,x", comments="")
    entry = {"file": str(tmp_path / "run.csv"), "window": [103.0, 106.0]}
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, [entry])
    assert campaign.training[0].began == 100.0
    assert campaign.training[0].record.time[0] == pytest.approx(103.0)


def test_a_run_that_begins_soon_after_another_is_one_of_its_own(cart: Any) -> None:
    """Nobody starts a machine once more within a second, but a logger goes on with another file."""
    first = on_a_clock_of_its_own(cart.measured(warming(), 1), 100.0)
    for pause, begins in ((0.3, 100.0), (0.85, 106.85)):
        other = on_a_clock_of_its_own(cart.measured(warming(), 2), 106.0 - 1 / cart.rate + pause)
        assert began([first, other], cart)[1] == pytest.approx(begins, abs=0.01)


@pytest.mark.parametrize("rate", [0.2, 1.0, 50.0])
def test_a_slow_record_goes_on_with_the_next_sample(cart: Any, rate: float) -> None:
    """Half a second is less than a step of a record that was taken once a second."""
    time = np.arange(200) / rate
    drive, seen = np.sin(np.arange(200) / 9), np.cos(np.arange(200) / 7)
    first = Record("first", time, {"F": drive, "x": seen})
    other = Record("other", time + time[-1] + 1 / rate, {"F": drive[::-1], "x": seen[::-1]})
    assert began([first, other], cart) == [0.0, 0.0]
    late = replace(other, name="late", time=time + time[-1] + max(0.8, 4 / rate))
    assert began([first, late], cart)[1] == late.time[0]


def test_a_sensor_that_drifts_along_a_curve_needs_no_other_effect(cart: Any) -> None:
    def drifting(t: Any, x: Any) -> Any:
        return x + 2e-4 * (t / 6.0) ** 1.3

    records = [cart.measured(cart.rig(k=820.0), seed, drifting) for seed in (1, 2, 3)]
    train, test = [{"record": record} for record in records[:2]], [{"record": records[2]}]
    found = ia.diagnose(Campaign(cart.rig(), CHANNELS, PRIORS, train, test))
    assert [placed.label for placed in found.effects] == ["sensor_drift at x"]
    rate, bend = found.effects[0].values["rate"], found.effects[0].values["bend"]
    assert 6.0 * (rate + 6.0 * bend) == pytest.approx(2e-4, rel=0.05)
    assert found.effects[0].units(found.evidence.campaign) == {"rate": "m/s", "bend": "m/s2"}
