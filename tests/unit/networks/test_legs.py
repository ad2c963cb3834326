"""Legs of a run are found for each signal alone, once, and none steps over any of them."""

from itertools import pairwise
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inertance.networks.simulation.legs import Leg, legs_of, together

STOP = 10.0


@st.composite
def courses(draw: Any) -> list[Leg]:
    """Legs of a signal, of any length from none to all, some of which end right before the next."""
    inner = draw(st.lists(st.floats(0.1, STOP - 0.1), max_size=5, unique=True))
    begins = [0.0, *sorted(inner)]
    jumps = [False, *draw(st.lists(st.booleans(), min_size=len(inner), max_size=len(inner)))]
    steps = draw(st.lists(st.floats(1e-4, 1.0), min_size=len(begins), max_size=len(begins)))
    ends = [np.nextafter(b, -1) if j else b for b, j in zip(begins[1:], jumps[1:], strict=True)]
    return [Leg(*told) for told in zip(begins, [*ends, STOP], steps, jumps, strict=True)]


@given(st.lists(courses(), min_size=1, max_size=4))
def test_legs_of_all_signals_go_over_the_whole_run_and_are_as_fine_as_those_of_each(parts: Any) -> None:
    legs = together(parts)
    assert (legs[0].begin, legs[-1].end) == (0.0, STOP)
    for before, after in pairwise(legs):
        assert before.begin < after.begin
        assert before.end in (after.begin, np.nextafter(after.begin, -1))
        assert before.end < after.begin or not after.jumps
    for part in parts:
        for own in part:
            inside = [leg for leg in legs if own.begin <= leg.begin and leg.end <= own.end]
            assert sum(leg.end - leg.begin for leg in inside) == pytest.approx(own.end - own.begin)
            lasting = [leg for leg in inside if leg.begin < leg.end]  # one between two floats has no step
            assert all(leg.max_step <= own.max_step for leg in lasting)
            assert inside[0].begin == own.begin
            assert inside[0].jumps >= own.jumps


def pushed_twice() -> ia.DAE:
    net = ia.Network("twice", wall=ia.Fixed(), spring=ia.SpringDamper(k=50.0, d=1.0), mass=ia.Mass(m=1.0))
    net.add(push=ia.Force(), pull=ia.Force(), hold=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.push.flange, net.pull.flange, net.hold.flange)
    return net.dae()


def test_an_input_that_is_changed_has_only_its_own_legs_found_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    sought: list[int] = []

    def counted(signals: Any, *rest: Any) -> Any:
        sought.append(signals.count)
        return legs_of(signals, *rest)

    monkeypatch.setattr("inertance.networks.simulation.bound_dae.legs_of", counted)
    dae, time = pushed_twice(), np.linspace(0.0, 2.0, 401)
    push, pull, other = (
        ia.Sampled(time, f, interpolation="linear") for f in np.random.default_rng(3).normal(size=(3, 401))
    )

    def course(push: Any, pull: Any, hold: float) -> Any:
        run = ia.simulate(dae, 2.0, inputs={"push.f": push, "pull.f": pull, "hold.f": hold}, rtol=1e-9)
        return run["mass.s"]

    course(push, pull, 0.0)
    assert sought == [1, 1]
    both = course(push, other, 3.0)
    assert sought == [1, 1, 1]
    apart = course(push, 0.0, 0.0) + course(0.0, other, 0.0) + course(0.0, 0.0, 3.0)
    assert sought == [1, 1, 1]
    assert both == pytest.approx(apart, abs=1e-7)


@pytest.mark.parametrize("solver", ["cvodes", "compiled"])
@pytest.mark.parametrize("wide", [1e-5, 1e-3, 0.1])
def test_a_pulse_beside_data_at_the_same_mass_is_seen(wide: float, solver: str) -> None:
    net = ia.Network("free", mass=ia.Mass(m=2.0), push=ia.Force(), pull=ia.Force())
    net.connect(net.push.flange, net.mass.flange, net.pull.flange)
    begin, stop, time = 3.7, 20.0, np.linspace(3.7, 20.0, 200)
    spikes = np.zeros(200)
    spikes[[30, 77]] = 50.0, -20.0
    inputs = {
        "push.f": lambda t: ca.if_else(ca.logic_and(t >= 7.123, t < 7.123 + wide), 90.0, 0.0),
        "pull.f": ia.Sampled(time, spikes, interpolation="linear"),
    }
    run = net.simulate(stop, begin=begin, inputs=inputs, rtol=1e-8, solver=solver)
    wanted = (90.0 * wide + np.trapezoid(spikes, time)) / 2.0
    assert run["mass.v"][-1] == pytest.approx(wanted, abs=1e-6)
