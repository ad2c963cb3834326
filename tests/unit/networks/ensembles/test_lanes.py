"""Every member of an ensemble is what a run of its own by solver "compiled" is, events included."""

import importlib
from collections.abc import Callable
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.networks.csource import crew, program
from inertance.networks.csource.toolchain import ToolchainError, compiler

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}
COUNT = 11  # no multiple of 4 or 8
ensembles = importlib.import_module("inertance.networks.ensembles.ensemble")


def drawn(seed: int, **ranges: tuple[float, float]) -> dict[str, Any]:
    draw = np.random.default_rng(seed)
    return {name.replace("__", "."): draw.uniform(*limits, COUNT) for name, limits in ranges.items()}


def rubbing(push: Any = None) -> ia.Network:
    """A mass that sticks and slips, friction falling with speed."""
    rub = ia.StribeckFriction(f_c=8.0, f_s=10.0, v_s=0.1, d=1.0)
    push = push or (lambda t: 14 * ca.sin(3 * t))
    net = ia.Network("rubbing", wall=ia.Fixed(), mass=ia.Mass(m=1.0), rub=rub, push=ia.Force(f=push))
    net.connect(net.wall.flange, net.rub.flange_a)
    return net.connect(net.push.flange, net.rub.flange_b, net.mass.flange)


def loop() -> ia.Network:
    """Two springs in series, one of them cubic, whose joint has no inertia; and friction."""
    chain = ia.series(soft=ia.Spring(k=100.0), hard=ia.CubicSpring(k=50.0, k3=4e4))
    push, rub = ia.Force(f=lambda t: 10 * ca.sin(4 * t)), ia.CoulombFriction(f_c=1.0)
    net = ia.Network("loop", wall=ia.Fixed(), mass=ia.Mass(m=1.0), chain=chain, rub=rub, push=push)
    net.connect(net.wall.flange, net.chain.flange_a, net.rub.flange_a)
    return net.connect(net.chain.flange_b, net.mass.flange, net.push.flange, net.rub.flange_b)


def ball() -> ia.Network:
    """A ball that bounces until it rests."""
    net = ia.Network("ball", floor=ia.Fixed(), stop=ia.HardStop(e=0.7, v_rest=3e-3), ball=ia.Mass(m=0.5))
    net.add(weight=ia.ConstantForce(f_constant=-4.905)).connect(net.floor.flange, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)


def told(events: list[ia.Event]) -> list[tuple[str, ...]]:
    return [(e.component, e.mode, e.source, e.target) for e in events]


def agree(dae: ia.DAE, stop: float, many: ia.Ensemble, alone: Callable[[int], ia.Result]) -> int:
    """Compare all members with runs of their own; return how many events there were."""
    count = 0
    for member in range(len(many)):
        run = alone(member)
        last = np.searchsorted(run.time, many.time, side="right") - 1  # what is true after an event
        for name in many.signals:
            scale = max(np.ptp(run[name]), 1e-6)
            assert many[name][member] == pytest.approx(run[name][last], abs=1e-6 * scale)
        own, ours = [e for e in run.events if e.time > 0], many.events(member)
        assert told(ours) == told(own)
        assert [e.time for e in ours] == pytest.approx([e.time for e in own], abs=1e-8)
        assert [e.impulse for e in ours if e.impulse] == pytest.approx([e.impulse for e in own if e.impulse])
        count += len(ours)
    assert many.event_counts.sum() == count
    return count


CASES: dict[str, tuple[Callable[[], ia.Network], float, dict[str, Any], dict[str, Any], int]] = {
    "stick-slip": (rubbing, 3.0, drawn(1, rub__f_c=(7.0, 9.0), mass__m=(0.8, 1.2)), {}, 40),
    "algebraic": (loop, 3.0, drawn(2, chain__soft__k=(80.0, 120.0), rub__f_c=(0.5, 1.5)), {}, 40),
    "bouncing": (ball, 2.5, drawn(3, stop__e=(0.5, 0.8)), drawn(4, ball__s=(0.5, 1.0)), 40),
}


def compared(case: str) -> ia.Ensemble:
    build, stop, parameters, starts, events = CASES[case]
    dae = build().dae()
    many = ia.ensemble(dae, stop, signals=dae.state_names, parameters=parameters, starts=starts, **TIGHT)

    def alone(member: int) -> ia.Result:
        own, start = ({n: float(v[member]) for n, v in given.items()} for given in (parameters, starts))
        return ia.simulate(dae, stop, parameters=own, start=start, solver="compiled", **TIGHT)

    assert agree(dae, stop, many, alone) > events
    assert not many.errors
    return many


@pytest.mark.parametrize("case", CASES)
def test_members_are_runs_of_their_own(case: str) -> None:
    many = compared(case)
    assert many.stats["lanes"] in (4, 8)
    assert 0.5 < many.stats["lane efficiency"] <= 1


def test_one_after_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """As models go that are too large for vectors, or that a compiler has none for."""
    monkeypatch.setattr(crew, "can_be_wide", lambda _: False)
    many = compared("stick-slip")
    assert many.stats["lanes"] == many.stats["lane efficiency"] == 1


def test_rows_are_exchanged_lane_by_lane(monkeypatch: pytest.MonkeyPatch) -> None:
    """As often as possible: in each column in which the pivot is not the greatest."""
    read, line = program.sources, "#define FAIR 0.1 "

    def other(names: Any) -> dict[str, str]:
        texts = read(names)
        if "wide_linear.c" in texts:
            assert line in texts["wide_linear.c"]
            texts["wide_linear.c"] = texts["wide_linear.c"].replace(line, "#define FAIR 1 ")
        return texts

    monkeypatch.setattr(crew, "sources", other)
    assert compared("algebraic").stats["lanes"] > 1


def test_neighbours_do_not_matter() -> None:
    """A member is the same to the last bit, whoever goes beside it."""
    build, stop, parameters, _, _ = CASES["stick-slip"]
    dae = build().dae()
    there = ia.ensemble(dae, stop, signals="mass.s", parameters=parameters)
    back = ia.ensemble(dae, stop, signals="mass.s", parameters={n: v[::-1] for n, v in parameters.items()})
    assert np.array_equal(there.values, back.values[::-1])
    assert [there.events(k) for k in range(COUNT)] == [back.events(k) for k in reversed(range(COUNT))]


def test_inputs_of_their_own() -> None:
    """Data, constants and starts that differ between members, one of each kind in neighbouring lanes."""
    t = np.linspace(0, 3, 61)
    pushes = [9.5, *(ia.Sampled(t, force * np.sin(3 * t)) for force in np.linspace(12, 16, 4)), 12.0]
    dae, speeds = rubbing(push=ia.Sampled(t, 0 * t)).dae(), np.linspace(-1, 1, len(pushes))
    inputs, starts = {"push.f": pushes}, {"mass.v": speeds}
    many = ia.ensemble(dae, 3.0, signals=["mass.s", "rub.f"], inputs=inputs, starts=starts, **TIGHT)

    def alone(member: int) -> ia.Result:
        push, start = {"push.f": pushes[member]}, {"mass.v": float(speeds[member])}
        return ia.simulate(dae, 3.0, solver="compiled", inputs=push, start=start, **TIGHT)

    assert agree(dae, 3.0, many, alone) > 10
