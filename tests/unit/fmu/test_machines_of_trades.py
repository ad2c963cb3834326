"""Every ready machine as an FMU: exported, checked against its network, and linearised."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from itertools import cycle
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import machines, rotational

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


def building() -> ia.Network:
    tid = machines.tid(1e6, 3e5, 150e3)
    frame: Any = machines.isolated_building([200e3] * 3, [3e8] * 3, [2e6] * 3, absorber=tid)
    frame.ground.s_ref = lambda t: 0.02 * ca.sin(3 * t) ** 3
    built: ia.Network = frame
    return built


def interconnected() -> ia.Network:
    struts = machines.InterconnectedStruts(A_b=8e-4, A_r=5e-4, p_0=2e6, V_0=2e-4, R=2e9)
    car: Any = machines.interconnected_car(struts)
    car.left_road.s_ref = lambda t: 0.01 * ca.sin(9 * t)
    built: ia.Network = car
    return built


def drop() -> ia.Network:
    strut = machines.OleoStrut(
        s_rel0=0.8, A_a=2e-3, A_h=1.6e-3, A_o=3e-5, p_0=1.5e6, V_0=8e-4, n=1.3, C_d=0.9, rho=870.0
    )
    return machines.landing_gear(strut, L=0.8)


def drivetrain() -> ia.Network:
    clutch = rotational.Clutch(fn_max=2000.0, cgeo=0.2, mu_pos=((0, 0.4), (300, 0.3)))
    return machines.clutch_drivetrain(clutch)


def bogie() -> ia.Network:
    train: Any = machines.bogie()
    train.front_rail.s_ref = lambda t: 0.001 * ca.sin(40 * t)
    train.rear_rail.s_ref = lambda t: 0.001 * ca.sin(40 * t - 1.0)
    built: ia.Network = train
    return built


def train_of_cars() -> ia.Network:
    net: Any = ia.Network(
        "buffers", push=ia.Force(), first=ia.MassWithLength(m=2.0, L=0.5),
        second=ia.MassWithLength(m=3.0, L=0.4),
        buffer=ia.SpringDamper(k=300.0, d=2.0, s_rel0=0.1),
    )  # fmt: skip
    net.connect(net.push.flange, net.first.flange_a).connect(net.first.flange_b, net.buffer.flange_a)
    built: ia.Network = net.connect(net.buffer.flange_b, net.second.flange_a)
    return built


MACHINES: dict[str, tuple[Callable[[], ia.Network], float, dict[str, float]]] = {
    "building": (building, 1.0, {}),
    "interconnected car": (interconnected, 0.5, {}),
    "landing gear": (drop, 0.3, {}),
    "drivetrain": (drivetrain, 0.5, {"clutch.f_normalized": 0.4, "engine_torque.tau": 90.0}),
    "bogie": (bogie, 0.3, {}),
    "sieve": (machines.sieve, 0.5, {"drive.w_ref": 60.0}),
    "foundation": (machines.machine_foundation, 0.5, {"drive.w_ref": 30.0}),
    "cars": (train_of_cars, 0.5, {"push.f": 4.0}),
}


@pytest.mark.parametrize(("name", "version"), list(zip(MACHINES, cycle(("2.0", "3.0")))))
@pytest.mark.usefixtures("few_instances")
def test_a_machine_agrees_with_its_fmu(name: str, version: str) -> None:
    make, stop, inputs = MACHINES[name]
    report = ia.fmu.check_fmu(make(), stop, step=stop / 100, versions=[version], inputs=inputs)
    assert report.passed, str(report)


@pytest.mark.parametrize("name", MACHINES)
def test_a_machine_is_linearised(name: str) -> None:
    make, stop, inputs = MACHINES[name]
    net = make()
    run = net.simulate(stop, inputs=inputs)
    system = ia.analysis.linearise(net, at=run, time=0.6 * stop)
    assert np.isfinite(system.A).all()
    assert len(system.states) >= 2
