"""Backlash behind a spring and damper that relax: what a flank gives, it gives back slowly."""

from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertance import rotational
from scipy.optimize import root_scalar

A, W = 0.01, 12.0  # of the motion that is given


def held(element: Any, **others: Any) -> ia.Network:
    """Return an element between a wall and a flange that is moved to and fro."""
    given = ia.Position(exact=True, s_ref=lambda t: A * np.sin(W * t))
    net = ia.Network("held", wall=ia.Fixed(), element=element, drive=given, **others)
    return net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.drive.flange)


def root(of: Callable[[float], float], low: float, high: float) -> float:
    return float(root_scalar(of, bracket=(low, high), xtol=1e-15).root)


def test_flanks_touch_and_let_go_where_the_equations_say() -> None:
    """Solved by hand: touched at b/2, held until f = 0, relaxed from there, and struck by the other flank."""
    k, d, b = 2e4, 900.0, 4e-3
    run = held(ia.RelaxingBacklash(k=k, d=d, b=b)).simulate(0.4, step=1e-4, rtol=1e-10, atol=1e-14)

    def x(t: float) -> float:
        return float(A * np.sin(W * t))

    def v(t: float) -> float:
        return float(A * W * np.cos(W * t))

    first = float(np.arcsin(b / 2 / A)) / W
    leaves = root(lambda t: k * (x(t) - b / 2) + d * v(t), np.pi / 2 / W, np.pi / W)
    stretch = x(leaves) - b / 2

    def relaxed(t: float) -> float:
        return float(stretch * np.exp(-k * (t - leaves) / d))

    struck = root(lambda t: x(t) + b / 2 - relaxed(t), leaves, 1.5 * np.pi / W)
    assert [event.time for event in run.events[:3]] == pytest.approx([first, leaves, struck], abs=1e-8)
    assert run.at("element.f", first + 1e-9) == pytest.approx(d * v(first), rel=1e-5)
    late = (leaves + struck) / 2
    assert run.at("element.z", late) == pytest.approx(relaxed(late), rel=1e-6)
    assert run.at("element.f", late) == 0.0
    after = k * relaxed(struck) + d * v(struck)
    assert run.at("element.f", struck + 1e-9) == pytest.approx(after, rel=1e-5)
    assert after < -50.0


def swept(k: float, d: float, b: float, t: np.ndarray, step: float = 1e-5) -> np.ndarray:
    """Return the force of a stretch that relaxes and is swept along by the flanks, step by step."""
    length, forces = 0.0, []
    for place in (A * np.sin(W * step * np.arange(round(t[-1] / step) + 1))).tolist():
        relaxed = length / (1 + step * k / d)
        moved = min(max(relaxed, place - b / 2), place + b / 2)
        forces.append(0.0 if moved == relaxed else k * moved + d * (moved - length) / step)
        length = moved
    return np.array([forces[round(instant / step)] for instant in t])


@settings(max_examples=12, deadline=None)
@given(
    k=st.sampled_from([0.0, 3e3, 2e4, 1e6]),
    d=st.floats(30.0, 3000.0),
    b=st.sampled_from([0.0, 1e-6, 3e-3, 1e-2]),
)
def test_it_is_a_process_of_sweeping_whatever_the_numbers(k: float, d: float, b: float) -> None:
    run = held(ia.RelaxingBacklash(k=k, d=d, b=b)).simulate(1.0, step=2e-3)
    t = np.arange(0.002, 1.0, 2e-3)
    wanted = swept(k, d, b, t)
    away = np.abs(run.at("element.f", t) - wanted)
    assert np.quantile(away, 0.97) < 2e-3 * np.abs(wanted).max()  # a jump is within a step of the process


@pytest.mark.parametrize("size", [1e-6, 0.01])
@pytest.mark.parametrize("phase", [1.0, 2.0, 3.5, 5.0])
def test_begun_in_motion_beyond_its_backlash_it_comes_to_what_it_would_be(size: float, phase: float) -> None:
    """Its stretch is not known then: it begins with none, between flanks or in what would be one."""
    begin, k, d, b = 137.0, 2e4, 900.0, 0.4 * size
    given = ia.Position(exact=True, s_ref=lambda t: size * np.sin(W * (t - begin) + phase))
    net = ia.Network("begun", wall=ia.Fixed(), element=ia.RelaxingBacklash(k=k, d=d, b=b), drive=given)
    net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.drive.flange)
    run = net.simulate(begin + 1.0, begin=begin, step=2e-3)
    later = np.arange(0.4, 1.0, 2e-3)
    wanted = swept(k, d, b * A / size, later + phase / W) * size / A
    away = np.abs(run.at("element.f", begin + later) - wanted)
    assert np.quantile(away, 0.97) < 2e-3 * np.abs(wanted).max()


@pytest.mark.parametrize("pulled", [True, False])
def test_without_backlash_it_is_a_spring_and_damper(pulled: bool) -> None:
    made: dict[str, Any] = {"k": 500.0, "d": 12.0, "s_rel0": 0.2}
    runs = []
    for element in (ia.RelaxingBacklash(b=0.0, **made), ia.SpringDamper(**made)):
        mass = ia.Mass(m=2.0, s=0.2, v=1.0 if pulled else -1.0)
        net = ia.Network("one", wall=ia.Fixed(), element=element, mass=mass)
        net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)
        runs.append(net.simulate(1.0, step=1e-2, rtol=1e-9, atol=1e-12))
    t = np.linspace(0, 1, 101)
    assert runs[0].at("mass.s", t) == pytest.approx(runs[1].at("mass.s", t), abs=1e-7)


def test_both_domains_have_one_law() -> None:
    sliding = ia.Network("slides", wall=ia.Fixed(), mass=ia.Mass(m=1.0, s=0.1, v=-2.0))
    sliding.add(element=ia.RelaxingBacklash(k=50.0, d=3.0, b=0.2, s_rel0=0.1, d_0=0.01))
    turning = ia.Network("turns", wall=rotational.Fixed(), mass=rotational.Inertia(J=1.0, phi=0.1, w=-2.0))
    turning.add(element=rotational.RelaxingBacklash(c=50.0, d=3.0, b=0.2, phi_rel0=0.1, d_0=0.01))
    runs = []
    for net in (sliding, turning):
        net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)
        runs.append(net.simulate(3.0, step=1e-2))
    assert len(runs[0].events) > 3
    assert runs[0]["element.f"] == pytest.approx(runs[1]["element.tau"], abs=1e-9)
    assert runs[0]["element.lossPower"] == pytest.approx(runs[1]["element.lossPower"], abs=1e-9)


def test_a_load_that_rests_on_it_rests_where_the_spring_bears_it() -> None:
    k, load = 2e3, 15.0
    net = ia.Network("rest", wall=ia.Fixed(), element=ia.RelaxingBacklash(k=k, d=40.0, b=0.02))
    net.add(mass=ia.Mass(m=3.0), weight=ia.ConstantForce(f_constant=-load))
    net.connect(net.wall.flange, net.element.flange_a)
    net.connect(net.element.flange_b, net.mass.flange, net.weight.flange)
    start = {"mass.v": 0.0, "mass.a": 0.0, "der(element.z)": 0.0}
    resting = net.simulate(0.5, start=start, guess={"mass.s": -0.02})
    assert resting["mass.s"] == pytest.approx(-0.01 - load / k, abs=1e-9)
    falling = net.simulate(5.0)
    assert falling["mass.s"][-1] == pytest.approx(-0.01 - load / k, abs=1e-5)


@pytest.mark.parametrize("solver", ["cvodes", "compiled"])
def test_behind_a_spring_without_mass_oil_tells_where_it_stays(solver: str) -> None:
    """In a slow motion the two springs in series share what is beyond the backlash."""
    k, other, b = 2e4, 3e4, 4e-3
    element = ia.RelaxingBacklash(k=k, d=20.0, b=b, d_0=0.1)
    net = ia.Network("two", wall=ia.Fixed(), element=element, second=ia.Spring(k=other))
    net.add(drive=ia.Position(exact=True, s_ref=lambda t: A * np.sin(0.5 * t)))
    net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.second.flange_a)
    net.connect(net.second.flange_b, net.drive.flange)
    run = net.simulate(12.0, step=0.01, solver=solver)
    s = A * np.sin(0.5 * run.time)
    wanted = np.sign(s) * np.maximum(np.abs(s) - b / 2, 0) / (1 / k + 1 / other)
    assert run["second.f"] == pytest.approx(wanted, abs=0.01 * wanted.max())
