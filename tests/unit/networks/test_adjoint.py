"""What inputs change in a weighted sum of signals: backwards along a run as forwards."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.networks import Variations

RNG = np.random.default_rng(0)


def carriage(**more: Any) -> ia.Network:
    net = ia.Network(
        "carriage", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0), push=ia.Force()
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)
    for name, part in more.items():
        net.add(**{name: part}).connect(net.wall.flange, getattr(net, name).flange_a)
        net.connect(getattr(net, name).flange_b, net.mass.flange)
    return net


def drawn() -> ia.Network:
    net = ia.Network(
        "drawn", drive=ia.Position(), cell=ia.ForceSensor(), mass=ia.Mass(m=2.0), push=ia.Force()
    )
    net.connect(net.drive.flange, net.cell.flange_a)
    return net.connect(net.cell.flange_b, net.mass.flange, net.push.flange)


@pytest.mark.parametrize(
    ("network", "inputs", "signals"),
    [
        (carriage(oil=ia.CubicDamper(d3=3.0)), {}, ["mass.s", "mass.a"]),
        (carriage(rail=ia.CoulombFriction(f_c=4.0)), {}, ["mass.s", "mass.v"]),  # sticks and slides
        (drawn(), {"drive.s_ref": lambda t: 0.1 * np.sin(3 * t)}, ["cell.f"]),  # no states
    ],
)
def test_backwards_is_forwards_transposed(network: ia.Network, inputs: Any, signals: list[str]) -> None:
    dae = network.dae()
    force = {"push.f": lambda t: 10 * np.sin(4 * t)}
    run = ia.simulate(dae, 3.0, step=0.01, inputs={**force, **inputs})
    variations = Variations(dae, signals, [])
    change = RNG.standard_normal((len(run.time), 2))
    weights = RNG.standard_normal((len(run.time), len(signals)))
    forwards = np.einsum("ks,ksc->c", weights, variations.pushed(run, {"push.f": change}))
    backwards = variations.adjoint(run, weights, "push.f")
    assert backwards is not None
    assert backwards @ change == pytest.approx(forwards, rel=1e-9)


@pytest.mark.parametrize("more", [{}, {"rail": ia.CoulombFriction(f_c=2.0)}])
def test_a_command_that_is_held_cuts_a_run_where_no_mode_switches(more: Any) -> None:
    dae = carriage(**more).dae()
    t = np.arange(0.0, 3.0, 0.1)
    command = ia.Sampled(t, 8 * np.sign(RNG.standard_normal(len(t))), interpolation="hold")
    run = ia.simulate(dae, 2.9, step=0.02, inputs={"push.f": command})
    cuts, switches = len(run.segments) - 1, sum(event.mode is not None for event in run.events)
    assert cuts > switches
    assert bool(switches) == bool(more)
    variations = Variations(dae, ["mass.s"], [])
    change = RNG.standard_normal((len(run.time), 1))
    weights = RNG.standard_normal((len(run.time), 1))
    forwards = float(np.einsum("ks,ksc->", weights, variations.pushed(run, {"push.f": change})))
    backwards = variations.adjoint(run, weights, "push.f")
    assert backwards is not None
    assert float(backwards @ change[:, 0]) == pytest.approx(forwards, rel=1e-9)


def test_an_input_whose_derivatives_act_has_none() -> None:
    dae = drawn().dae()
    run = ia.simulate(dae, 1.0, inputs={"drive.s_ref": lambda t: 0.1 * np.sin(3 * t), "push.f": 0.0})
    assert Variations(dae, ["cell.f"], []).adjoint(run, np.ones((len(run.time), 1)), "drive.s_ref") is None


def test_slopes_are_the_same_without_parameters_and_after_inputs_were_pushed() -> None:
    """Each asks for another part of what is known along the run; a hard spring is followed in parts."""
    dae = carriage(stop=ia.CubicSpring(k=0.0, k3=1e6)).dae()
    run = ia.simulate(dae, 2.0, step=0.02, inputs={"push.f": lambda t: 50 * np.sin(4 * t)})
    change = {"push.f": np.ones((len(run.time), 1))}
    alone, beside, pushed = (Variations(dae, ["mass.s"], names) for names in ([], ["spring.k"], ["spring.k"]))
    moved = pushed.pushed(run, change)
    slopes = beside.along(run)
    assert alone.along(run) == pytest.approx(slopes[:, :, 1:], rel=1e-9)
    assert pushed.along(run) == pytest.approx(slopes, rel=1e-12)
    assert beside.pushed(run, change) == pytest.approx(moved, rel=1e-12)
