"""What holds for every jump of a prescribed motion: it does what ever shorter ramps do."""

from itertools import pairwise
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from inertance import (
    CoulombFriction,
    Damper,
    ElastoGap,
    Fixed,
    HardStop,
    Inerter,
    Mass,
    Network,
    Position,
    Speed,
    Spring,
    SpringDamper,
    signals,
)

JUMP, END = 0.3, 0.4  # s
YIELDING = ("spring", "damper", "both", "friction", "gap")
RIGID = ("inerter", "stop")


def element(kind: str, size: float) -> Any:
    """A two-terminal element whose parameters follow a size from 0 to 1."""
    made: dict[str, Any] = {
        "spring": lambda: Spring(k=10 + 500 * size),
        "damper": lambda: Damper(d=1 + 30 * size),
        "both": lambda: SpringDamper(k=10 + 500 * size, d=1 + 30 * size),
        "friction": lambda: CoulombFriction(f_c=0.5 + 20 * size),
        "gap": lambda: ElastoGap(k=100 + 1e4 * size, d=1 + 50 * size, s_rel0=size - 0.5),
        "inerter": lambda: Inerter(b=0.5 + 5 * size),
        "stop": lambda: HardStop(s_min=-0.05 - 0.3 * size, e=0.5 if size > 0.5 else 0.0),
    }
    return made[kind]()


@st.composite
def machines(draw: Any, kinds: tuple[str, ...]) -> Any:
    """How many masses, and elements between them, the drive (0) and the wall (1)."""
    masses = draw(st.lists(st.floats(0.5, 5.0), min_size=1, max_size=4))
    places = [(draw(st.integers(0, k + 1)) if k else 0, k + 2) for k in range(len(masses))]
    ends = st.tuples(st.integers(0, len(masses) + 1), st.integers(2, len(masses) + 1))
    places += [(a, b) for a, b in draw(st.lists(ends, max_size=3)) if a != b]
    sizes = st.tuples(st.sampled_from(kinds), st.floats(0, 1))
    return masses, [(place, *draw(sizes)) for place in places]


def network(machine: Any, drive: Any, source: Any) -> Network:
    masses, elements = machine
    net = Network("machine", drive=drive, source=source, wall=Fixed(), held=Spring(k=5.0))
    net.connect(net.source.y, net.drive.v_ref if isinstance(drive, Speed) else net.drive.s_ref)
    nodes = [net.drive.flange, net.wall.flange]
    for k, m in enumerate(masses):
        net.add(**{f"mass{k}": Mass(m=m)})
        nodes.append(getattr(net, f"mass{k}").flange)
    net.connect(net.wall.flange, net.held.flange_a)
    net.connect(net.held.flange_b, nodes[2])
    for k, ((a, b), kind, size) in enumerate(elements):
        net.add(**{f"element{k}": element(kind, size)})
        placed = getattr(net, f"element{k}")
        net.connect(nodes[a], placed.flange_a)
        net.connect(placed.flange_b, nodes[b])
    return net


def ending(net: Network, solver: str) -> Any:
    run = net.simulate(END, solver=solver, rtol=1e-8, atol=1e-10)
    names = [name for name in net.dae().names() if name.startswith("mass") and name.endswith((".s", ".v"))]
    return np.array([run[name][-1] for name in names])


def held_against_ramps(machine: Any, drive: Any, height: float, solver: str) -> None:
    jumped = ending(network(machine, drive(), signals.Step(height=height, start_time=JUMP)), solver)
    near = 2e-4 * max(1.0, np.abs(jumped).max())
    ends, missed = {}, []
    for duration in (1e-5, 1e-6, 1e-4, 3e-5):  # one that comes near is enough
        ramp = signals.Ramp(height=height, duration=duration, start_time=JUMP)
        try:
            ends[duration] = ending(network(machine, drive(), ramp), "auto")
        except ia.SimulationError:  # at very short ramps, whose speed is 1e6 m/s, modes may not settle
            continue
        missed.append(np.abs(jumped - ends[duration]).max())
        if missed[-1] <= near:
            return
    assume(len(ends) > 1)
    for short, long in pairwise(sorted(ends)):  # a ramp acts late by half of it: so to no duration at all
        missed.append(np.abs(jumped - (long * ends[short] - short * ends[long]) / (long - short)).max())
    assert min(missed) <= near, f"missed by {missed}"


@given(machines((*YIELDING, *RIGID)), st.sampled_from([1.0, -1.0]))
@settings(max_examples=25, deadline=None)
def test_a_speed_that_jumps_does_what_short_ramps_do(machine: Any, height: float) -> None:
    held_against_ramps(machine, Speed, height, "auto")


@given(machines(YIELDING), st.sampled_from([0.2, -0.2]))
@example(([0.5, 3.0], [((0, 2), "spring", 1.0), ((0, 3), "friction", 0.0), ((2, 3), "spring", 0.0)]), 0.2)
@settings(max_examples=25, deadline=None)
def test_a_position_that_jumps_does_what_short_ramps_do(machine: Any, height: float) -> None:
    held_against_ramps(machine, Position, height, "auto")


@given(machines((*YIELDING, *RIGID)))
@settings(max_examples=5, deadline=None)
def test_a_compiled_run_does_so_too(machine: Any) -> None:
    held_against_ramps(machine, Speed, 1.0, "compiled")


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_what_nearly_rests_after_a_very_fast_motion_breaks_away(solver: str) -> None:
    """At 2e5 m/s a speed of 1e-7 m/s is rounding; once the motion has ended it is one."""
    machine = [0.5, 3.0], [((0, 2), "spring", 1.0), ((0, 3), "friction", 0.0), ((2, 3), "spring", 0.0)]
    ramp = signals.Ramp(height=0.2, duration=1e-6, start_time=JUMP)
    run = network(machine, Position(), ramp).simulate(END, solver=solver)
    slips = [event.time for event in run.events if event.target == "forward"]
    assert slips[-1] == pytest.approx(0.3226455, abs=1e-6)  # where the spring between the masses overcomes it
