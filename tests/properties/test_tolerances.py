"""A finer tolerance moves a result by no more than the coarser one promised (docs/networks.md)."""

from collections.abc import Callable
from functools import cache
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.machines import TMDI, Sinusoid
from numpy.typing import NDArray

Array = NDArray[np.float64]
PROMISED = {"cvodes": 1000.0, "idas": 1000.0, "rosenbrock": 30.0, "compiled": 30.0}
STOP = 1.0
TIME = np.linspace(0.0, STOP, 101)


def road(t: Any) -> Any:
    return 0.02 * ca.sin(8 * t) + 0.05 * ca.exp(-((6 * (t - 0.6)) ** 2))


def force(t: Any) -> Any:
    return 100 * ca.sin(20 * t)


def strut() -> Any:
    return ia.machines.suspension("S6", 20e3, d=1500.0, b=50.0)


def frame(absorber: ia.Component) -> ia.Network:
    return ia.machines.shear_frame([1e3] * 3, [1e6] * 3, [1e3] * 3, absorbers={(0, 1): absorber})


def on_a_rig(inerter: ia.Component) -> ia.Network:
    return ia.machines.inerter_rig(inerter, Sinusoid(0.01, 2.0))


MACHINES: dict[str, Callable[[], ia.Network]] = {
    "quarter car": lambda: ia.machines.quarter_car(strut()),
    "half car": lambda: ia.machines.half_car(strut(), strut()),
    "full car": lambda: ia.machines.full_car(strut(), strut()),
    "isolated machine": lambda: ia.machines.isolated_machine(ia.SpringDamper(k=1e5, d=50.0)),
    "seat": lambda: ia.machines.seat_in_cab(ia.SpringDamper(k=5e3, d=300.0), ia.SpringDamper(k=1e5, d=3e3)),
    "frame with TMDI": lambda: frame(TMDI(m=20.0, k=1e4, d=50.0, b=100.0)),
    "frame with TID": lambda: frame(ia.machines.tid(k=1e4, d=50.0, b=100.0)),
    "frame with TVMD": lambda: frame(ia.machines.tvmd(k=1e4, d=50.0, b=100.0)),
    "cable": lambda: ia.machines.taut_cable(100.0, 1e6, 50.0, parts=10, damper=ia.Damper(d=1e4)),
    "ball-screw inerter": lambda: on_a_rig(ia.machines.ge_wang.disk_inerter()),
    "planetary inerter": lambda: on_a_rig(ia.machines.ge_wang.planetary_inerter()),
}


@cache
def machine(name: str) -> ia.DAE:
    return MACHINES[name]().dae()


def courses(name: str, **options: Any) -> Array:
    """Return every state at TIME."""
    dae = machine(name)
    inputs = {path: road if path.endswith("s_ref") else force for path in dae.input_names}
    run = ia.simulate(dae, STOP, step=0.01, inputs=inputs, **options)
    return np.array([run.at(state, TIME) for state in dae.state_names])


@cache
def exact(name: str) -> Array:
    return courses(name, rtol=1e-10, atol=1e-14)


@pytest.mark.parametrize("solver", PROMISED)
@pytest.mark.parametrize("name", MACHINES)
def test_a_tolerance_keeps_what_it_promises(name: str, solver: str) -> None:
    if solver == "cvodes" and machine(name).z.numel():
        pytest.skip("cvodes takes no algebraic unknowns")
    ranges = np.ptp(exact(name), axis=1)
    moving = ranges > 1e-9
    for rtol in (1e-5, 1e-6):
        found = courses(name, rtol=rtol, solver=solver)
        off = np.abs(found - exact(name)).max(axis=1)[moving] / ranges[moving]
        assert off.max() < PROMISED[solver] * rtol


def test_rounding_does_not_rule_the_steps_at_the_default_tolerance() -> None:
    """A hundredth of 1e-12 between events did, in gears of 0.1 m and 1e8 N/m, and took 30 times the steps."""
    car = ia.machines.quarter_car(
        ia.machines.suspension("S4", 60e3, 3200.0, ia.machines.ge_wang.planetary_inerter())
    ).dae()
    inputs = {"road.s_ref": ia.analysis.road_profile("A", 25.0, 8.0, seed=1)}
    steps = [ia.simulate(car, 0.5, inputs=inputs, atol=atol).stats["steps"] for atol in (1e-8, 1e-12)]
    assert steps[1] < 2 * steps[0]
