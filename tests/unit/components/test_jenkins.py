"""Springs in series with dry friction, without mass between them; dampers that follow a signal."""

from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.networks import Variations
from numpy.typing import NDArray

Array = NDArray[np.float64]
K, LIMIT = 1000.0, 5.0


def driven(element: ia.Component, turning: bool = False) -> ia.Network:
    kind = rotational if turning else ia
    drive = rotational.Position() if turning else ia.Position()
    net = ia.Network("driven", wall=kind.Fixed(), drive=drive, element=element)
    return net.connect(net.wall.flange, net.element.flange_a).connect(net.drive.flange, net.element.flange_b)


def resonator() -> ia.Network:
    net = ia.Network("resonator", push=ia.Force(), mass=ia.Mass(m=1.0, v=0.3), wall=ia.Fixed())
    net.add(joint=ia.Jenkins(k=K, f_c=LIMIT), spring=ia.Spring(k=200.0))
    net.connect(net.wall.flange, net.joint.flange_a, net.spring.flange_a)
    return net.connect(net.mass.flange, net.push.flange, net.joint.flange_b, net.spring.flange_b)


def stop_operator(travel: Array) -> Array:
    """Return the force of the cell by its increments, which are exact between reversals."""
    force = np.zeros(len(travel))
    for n, step in enumerate(np.diff(travel)):
        force[n + 1] = np.clip(force[n] + K * step, -LIMIT, LIMIT)
    return force


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("turning", [False, True])
def test_a_cell_sticks_and_slips_as_the_stop_operator_says(solver: str, turning: bool) -> None:
    cell = rotational.Jenkins(c=K, tau_c=LIMIT) if turning else ia.Jenkins(k=K, f_c=LIMIT)
    t = np.linspace(1.0, 3.0, 2001)
    travel = 0.02 * np.sin(10 * t) + 0.008 * np.sin(31 * t)
    reference = {"drive.phi_ref" if turning else "drive.s_ref": (t, travel)}
    run = driven(cell, turning).simulate(3.0, begin=1.0, step=1e-3, inputs=reference, solver=solver)
    force = np.interp(t, run.time, run["element.tau" if turning else "element.f"])
    assert force == pytest.approx(stop_operator(travel), abs=0.05)
    assert np.abs(force).max() == pytest.approx(LIMIT, rel=1e-9)
    assert len(run.events) > 10


def test_slopes_pass_its_events() -> None:
    dae, t = resonator().dae(), np.linspace(0, 2, 2001)
    given: dict[str, Any] = {"inputs": {"push.f": (t, 12 * np.sin(10 * t))}, "step": 1e-3, "rtol": 1e-10}
    run = ia.simulate(dae, 2.0, **given)
    assert len(run.events) > 6
    slopes = Variations(dae, ["mass.s"], ["joint.k", "joint.f_c"]).along(run)[-1, 0]
    for n, (name, value) in enumerate((("joint.k", K), ("joint.f_c", LIMIT))):
        ends = [
            ia.simulate(dae, 2.0, **given, parameters={name: value * (1 + part)})["mass.s"][-1]
            for part in (-1e-3, 1e-3)
        ]
        assert slopes[n] == pytest.approx((ends[1] - ends[0]) / (2e-3 * value), rel=0.02)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_friction_in_series_with_a_spring_is_told_to_be_a_cell(solver: str) -> None:
    net = ia.Network("series", table=ia.Position(), spring=ia.Spring(k=K), wall=ia.Fixed())
    net.add(slider=ia.CoulombFriction(f_c=LIMIT)).connect(net.table.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.slider.flange_a).connect(net.slider.flange_b, net.wall.flange)
    t = np.linspace(0, 1, 101)
    with pytest.raises(ia.SimulationError, match=r"moves with .*'slider'.* take a Jenkins for both"):
        net.simulate(1.0, inputs={"table.s_ref": (t, 0.02 * np.sin(9 * t))}, solver=solver)


@pytest.mark.parametrize(
    ("element", "turning"),
    [(ia.VariableDamper(d=2.0, d_u=3.0), False), (rotational.VariableDamper(d=2.0, d_u=3.0), True)],
)
def test_a_damper_follows_a_signal(element: ia.Component, turning: bool) -> None:
    def current(t: Any) -> Any:
        return 1 + np.sin(3 * t)

    moved: Callable[[Any], Any] = lambda t: np.sin(2 * t)  # noqa: E731
    reference = "drive.phi_ref" if turning else "drive.s_ref"
    run = driven(element, turning).simulate(3.0, inputs={reference: moved, "element.u": current})
    law = (2.0 + 3.0 * current(run.time)) * 2 * np.cos(2 * run.time)
    assert run["element.tau" if turning else "element.f"] == pytest.approx(law, abs=1e-9)
