"""Profile-likelihood intervals: as standard errors where the cost is a parabola, as the cost elsewhere."""

from types import SimpleNamespace
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, FitInterruptedError, Multisine, Record
from inertance.identification.campaign.priors import Prior
from inertance.identification.fitting.intervals import profiled
from inertance.identification.fitting.problem import Optimum

RATE = 200.0
CHANNELS = {"x": {"input": "table.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}}


def rig(k: float = 1000.0, d: float = 4.0, friction: float | None = None, m: float = 0.0) -> ia.Network:
    """Return a spring and a damper on a table that moves; a mass behind them is held by friction."""
    net = ia.Network("rig", table=ia.Position(), cell=ia.ForceSensor(), spring=ia.SpringDamper(k=k, d=d))
    net.add(wall=ia.Fixed())
    net.connect(net.table.flange, net.cell.flange_a).connect(net.cell.flange_b, net.spring.flange_a)
    if not m:
        return net.connect(net.spring.flange_b, net.wall.flange)
    net.add(mass=ia.Mass(m=m), rub=ia.CoulombFriction(f_c=friction or 0.0))
    net.connect(net.wall.flange, net.rub.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.rub.flange_b)


def record(truth: ia.Network, noise: float, seed: int = 0, rms: float = 2e-3) -> Record:
    motion = Multisine(rms=rms, low=0.5, high=8.0, period=2.0)
    drive = ia.identification.sampled(motion, stop=4.0, rate=RATE, fade=0.3)
    run = truth.simulate(4.0, step=1 / RATE, inputs={"table.s_ref": drive})
    force = run["cell.f"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
    scatter = np.random.default_rng(seed).normal(0, noise, len(force))
    return Record(f"seed {seed}", drive.time, {"x": drive.values, "F": force + scatter})


def campaign(
    truth: ia.Network, model: ia.Network, parameters: dict[str, Any], noise: float = 0.3
) -> Campaign:
    train = [{"record": record(truth, noise), "initial": "rest"}]
    return Campaign(model, CHANNELS, parameters, train, [])


STRAIGHT = {"spring.k": {"min": 0.0}, "spring.d": {"min": 0.0}}


@pytest.mark.parametrize(("level", "deviations"), [(0.95, 1.96), (0.5, 0.6745)])
def test_where_the_force_is_linear_in_all_it_is_the_standard_error(level: float, deviations: float) -> None:
    found = ia.fit(campaign(rig(1080.0, 5.0), rig(), STRAIGHT), intervals=level)
    for name, value in found.values.items():
        own, error = found.intervals[name], found.errors[name]
        assert own.level == level
        assert [own.low, own.high] == pytest.approx(
            [value - deviations * error, value + deviations * error], abs=0.03 * deviations * error
        )


def test_without_being_asked_there_are_none() -> None:
    found = ia.fit(campaign(rig(1080.0, 5.0), rig(), STRAIGHT))
    assert not found.intervals
    assert "interval" not in found.table()
    assert "interval" not in found.to_dict()["parameters"]["spring.k"]


def test_they_end_at_bounds_and_are_told() -> None:
    """The damper is 0, its bound; what a stiffness may be is bounded far from where it is."""
    wide = {"spring.k": {"min": 1.0, "max": 1e5}, "spring.d": {"min": 0.0}}
    found = ia.fit(campaign(rig(1080.0, 0.0), rig(), wide), intervals=0.95)
    damping, stiffness = found.intervals["spring.d"], found.intervals["spring.k"]
    assert damping.low == 0.0
    assert 0.0 < damping.high < 0.5
    assert stiffness.low < 1080.0 < stiffness.high
    assert f"{stiffness.low:.5g} to {stiffness.high:.5g}" in found.table()
    told = found.to_dict()["parameters"]["spring.d"]["interval"]
    assert told == {"level": 0.95, "low": 0.0, "high": damping.high}


def test_what_records_do_not_tell_has_no_limit() -> None:
    """No record reaches where friction begins to slide: it may be as large as one likes."""
    truth, model = rig(1080.0, 5.0, 400.0, m=2.0), rig(1000.0, 4.0, 300.0, m=2.0)
    asked = {**STRAIGHT, "rub.f_c": {"min": 0.0}}
    found = ia.fit(campaign(truth, model, asked), solver="compiled", intervals=0.95)
    friction = found.intervals["rub.f_c"]
    assert friction.high == np.inf
    assert 1.0 < friction.low < 300.0
    assert found.to_dict()["parameters"]["rub.f_c"]["interval"]["high"] is None
    assert any("rub.f_c: the records set it no limit above" in line for line in found.warnings)


def test_a_profile_that_leads_to_something_better_mends_the_fit() -> None:
    """From where friction holds the mass throughout no slope leads to where it slides."""
    truth, model = rig(1080.0, 5.0, 0.2, m=2.0), rig(1000.0, 4.0, 3.0, m=2.0)
    told = list[str]()
    asked = {"spring.k": {"rel": 0.2}, "spring.d": {"rel": 0.5}, "rub.f_c": {"min": 0.0, "max": 50.0}}
    case = campaign(truth, model, asked)
    assert abs(ia.fit(case, solver="compiled").values["spring.k"] - 1080.0) > 100.0
    found = ia.fit(case, solver="compiled", intervals=0.95, report=told.append)
    assert "a profile has led to a lower misfit: fitting again from there" in told
    assert found.values["spring.k"] == pytest.approx(1080.0, rel=5e-3)
    assert found.intervals["rub.f_c"].low < 0.2 < found.intervals["rub.f_c"].high


def test_interrupted_it_keeps_the_intervals_that_are_known() -> None:
    def interrupt(line: str) -> None:
        if line == "95% interval of spring.d, upper end":
            raise KeyboardInterrupt

    with pytest.raises(FitInterruptedError) as caught:
        ia.fit(campaign(rig(1080.0, 5.0), rig(), STRAIGHT), intervals=0.95, report=interrupt)
    found = caught.value.fit
    assert [*found.intervals] == ["spring.k"]
    assert "0.95 interval" in found.table()


@pytest.mark.parametrize("level", [0.0, 1.0, 95.0, "0.95"])
def test_a_level_is_a_share(level: Any) -> None:
    with pytest.raises(ia.ModelError, match="intervals"):
        ia.fit(campaign(rig(), rig(), STRAIGHT), intervals=level)


def test_a_record_that_the_model_meets_to_the_last_digit_has_intervals_by_its_noise() -> None:
    model = rig()
    train = [{"record": record(model, noise=0.0), "initial": "rest"}]
    found = ia.fit(Campaign(model, CHANNELS, STRAIGHT, train, [], noise={"F": 0.3}), intervals=0.95)
    assert found.errors["spring.k"] == 0.0
    assert 980.0 < found.intervals["spring.k"].low < 1000.0 < found.intervals["spring.k"].high < 1020.0


class Walled:
    """A problem of one parameter whose cost is nothing up to a wall, and then a thousand."""

    def __init__(self, wall: float) -> None:
        self.wall, self.priors = wall, {"p": Prior(0.0, np.inf, -1e3, 1e3)}

    def minimise(self, begin: Any, held: str) -> Any:
        cost = 1e3 * float(abs(begin[0]) > self.wall)
        return SimpleNamespace(vector=begin, cost=cost, values={"p": float(begin[0])})


@pytest.mark.parametrize("wall", [1e-5, 1e-3, 0.4, 7.0, 300.0])
def test_an_end_that_is_a_wall_is_not_told_too_near(wall: float) -> None:
    """No root of the rise is ever at the level: what is told is behind the wall, not before it."""
    none, one = np.zeros(1), np.ones(1)
    optimum = Optimum({"p": 0.0}, [], 0.0, none, np.ones((1, 1)), one, none, 0, "")
    problem: Any = Walled(wall)
    ((_, found),) = profiled(problem, optimum, {"p": 1.0}, 0.95)
    assert found.low <= -wall
    assert found.high >= wall
