"""Energy is kept over sticking, clearances and strikes: what goes in is stored or lost, to heat or shocks."""

from functools import cache
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

Array = NDArray[np.float64]
FEW = settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow])
size = st.floats(0.2, 5.0)
STOP = 1.0
TIME = np.linspace(0.0, STOP, 101)


FRICTIONS = {
    "Coulomb": ia.CoulombFriction(f_c=5.0),
    "Stribeck": ia.StribeckFriction(f_c=4.0, f_s=6.0, v_s=0.1, d=0.3),
}
PARAMETERS = (
    "first.m", "second.m", "third.m", "spring.k", "tie.k", "gap.k", "gap.d", "screw.b", "friction.f_c",
)  # fmt: skip
SPEEDS = ("first.v", "second.v", "third.v")


@cache
def rig(friction: str) -> ia.DAE:
    """Three masses in a row: dry friction on the first, a rigid stop and a clearance between them."""
    net = ia.Network(
        "rig", wall=ia.Fixed(), push=ia.Force(), friction=FRICTIONS[friction], stop=ia.HardStop(s_min=0.05),
        first=ia.Mass(m=1.0, s=0.0), second=ia.Mass(m=1.0, s=0.1), third=ia.Mass(m=1.0, s=0.2),
        spring=ia.Spring(k=50.0), tie=ia.Spring(k=30.0, s_rel0=0.1), screw=ia.Inerter(b=1.0),
        gap=ia.Backlash(k=500.0, d=1.0, eps=0.05, s_rel0=0.1),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.friction.flange_a, net.screw.flange_a)
    net.connect(
        net.first.flange, net.spring.flange_b, net.friction.flange_b, net.stop.flange_a, net.tie.flange_a,
        net.push.flange,
    )  # fmt: skip
    net.connect(net.second.flange, net.stop.flange_b, net.tie.flange_b, net.gap.flange_a, net.screw.flange_b)
    net.connect(net.third.flange, net.gap.flange_b)
    return net.dae()


@st.composite
def numbers(draw: st.DrawFn) -> dict[str, float]:
    return {name: draw(size) * rig("Coulomb").parameter_values[name] for name in PARAMETERS}


def integral(run: ia.Result, power: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(np.diff(run.time) * (power[1:] + power[:-1]) / 2)])


def lost_in_shocks(run: ia.Result, speed: str) -> Array:
    """Energy that shocks have taken up to each point: half the impulse times the speeds before and after."""
    lost = np.zeros(len(run.time))
    for event in run.events:
        if event.impulse is not None:
            after = int(np.searchsorted(run.time, event.time, side="right")) - 1
            before = int(np.searchsorted(run.time, event.time, side="left"))
            both = run[speed][before] + run[speed][after]
            lost[after:] -= abs(event.impulse) * both / 2
    return lost


def books(run: ia.Result, p: dict[str, float]) -> tuple[Array, Array]:
    """Return the energy that is stored, and what it should be: that at the start, and what came and went."""
    beyond = run["gap.s_rel"] - 0.1
    elastic = p["gap.k"] * np.sign(beyond) * np.maximum(np.abs(beyond) - 0.05, 0.0)
    kinetic = [
        ("first.m", "first.v"),
        ("second.m", "second.v"),
        ("third.m", "third.v"),
        ("screw.b", "screw.v_rel"),
    ]
    stored = sum(0.5 * p[m] * run[v] ** 2 for m, v in kinetic)
    stored += 0.5 * p["spring.k"] * run["spring.s_rel"] ** 2
    stored += 0.5 * p["tie.k"] * (run["tie.s_rel"] - 0.1) ** 2
    stored += 0.5 * elastic**2 / p["gap.k"]
    power = run["push.f"] * run["first.v"] - run["friction.f"] * run["friction.v_rel"]
    power = power - (run["gap.f"] - elastic) * run["gap.v_rel"]
    return stored, stored[0] + integral(run, power) - lost_in_shocks(run, "stop.v_rel")


@pytest.mark.parametrize("solver", ["auto", "rosenbrock", "compiled"])
@FEW
@given(
    friction=st.sampled_from(sorted(FRICTIONS)), p=numbers(), restitution=st.floats(0.0, 1.0),
    speeds=st.tuples(*3 * [st.floats(-2, 2)]), force=st.floats(-60, 60),
)  # fmt: skip
def test_energy_is_kept_over_events(
    solver: str,
    friction: str,
    p: dict[str, float],
    restitution: float,
    speeds: tuple[float, ...],
    force: float,
) -> None:
    run = ia.simulate(
        rig(friction),
        STOP,
        step=1e-4,  # at which the sums below are exact enough
        rtol=1e-8,
        inputs={"push.f": (TIME, force * np.sin(7 * TIME))},
        solver=solver,
        parameters={**p, "stop.e": restitution},
        start=dict(zip(SPEEDS, speeds, strict=True)),
    )
    stored, expected = books(run, p)
    assert stored == pytest.approx(expected, abs=1e-4 * stored.max() + 1e-20)


def test_the_books_would_show_a_shock_that_is_not_reported() -> None:
    """The check itself: without the shocks' losses it must not balance."""
    net: Any = ia.Network(
        "strike", wall=ia.Fixed(), stop=ia.HardStop(e=0.5), mass=ia.Mass(m=2.0, s=0.1, v=-1.0)
    )
    net.connect(net.wall.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.mass.flange)
    run = net.simulate(1.0)
    kinetic = run["mass.v"] ** 2
    assert lost_in_shocks(run, "stop.v_rel")[-1] == pytest.approx(kinetic[0] - kinetic[-1])
    assert kinetic[0] - kinetic[-1] == pytest.approx(0.75)
