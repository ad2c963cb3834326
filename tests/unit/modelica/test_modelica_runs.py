"""Modelica text is run by a Modelica tool, rumoca, and does what the native run does."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import machines, rotational, signals
from inertance.modelica.names import reference

LIBRARY = [p for p in os.environ.get("MODELICAPATH", "").split(os.pathsep) if (Path(p) / "Modelica").is_dir()]
needs_msl = pytest.mark.skipif(not LIBRARY, reason="no Modelica Standard Library under MODELICAPATH")


def quarter_car() -> ia.Network:
    net = ia.Network(
        "quarter car",
        road=ia.Position(s_ref=lambda t: 0.02 * ca.sin(8 * t)),
        tyre=ia.Spring(k=150e3),
        wheel=ia.Mass(m=35.0),
        strut=ia.SpringDamper(k=20e3, d=1.5e3),
        body=ia.Mass(m=250.0, v=0.3),
    )
    net.connect(net.road.flange, net.tyre.flange_a)
    net.connect(net.tyre.flange_b, net.wheel.flange, net.strut.flange_a)
    return net.connect(net.strut.flange_b, net.body.flange)


def frame_with_tid() -> ia.Network:
    net = ia.Network(
        "frame with TID",
        ground=ia.Accelerate(a_ref=lambda t: 3 * ca.exp(-t) * ca.sin(11 * t)),
        column=ia.SpringDamper(k=4e4, d=80.0),
        floor=ia.Mass(m=400.0),
        tid=ia.series(ia.SpringDamper(k=3e3, d=90.0), ia.Inerter(b=30.0)),
    )
    net.connect(net.ground.flange, net.column.flange_a, net.tid.flange_a)
    return net.connect(net.column.flange_b, net.floor.flange, net.tid.flange_b)


def torsional_drive() -> ia.Network:
    net = ia.Network(
        "torsional drive",
        torque=rotational.Torque(tau=lambda t: 5 * ca.sin(20 * t) + 2),
        motor=rotational.Inertia(J=0.1, w=5.0),
        shaft=rotational.SpringDamper(c=800.0, d=0.6),
        gear=rotational.IdealGear(ratio=3.0),
        load=rotational.Inertia(J=2.0),
        brake=rotational.Damper(d=0.5),
        house=rotational.Fixed(phi0=0.2),
    )
    net.connect(net.torque.flange, net.motor.flange, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.load.flange, net.brake.flange_a)
    return net.connect(net.brake.flange_b, net.house.flange)


def block_on_belt() -> ia.Network:
    net = ia.Network(
        "block on belt",
        belt=ia.Speed(v_ref=0.1),
        rub=ia.StribeckFriction(f_c=8.0, f_s=12.0, v_s=0.02),
        block=ia.Mass(m=1.0),
        spring=ia.Spring(k=400.0),
        wall=ia.Fixed(),
    )
    net.connect(net.belt.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.block.flange, net.spring.flange_b)
    return net.connect(net.wall.flange, net.spring.flange_a)


def play_and_buffer() -> ia.Network:
    net = ia.Network(
        "play and buffer",
        push=ia.Force(f=lambda t: 30 * ca.sin(6 * t)),
        cart=ia.Mass(m=2.0),
        gap=ia.Backlash(k=2e4, d=40.0, eps=2e-3),
        slide=ia.Mass(m=1.0),
        hold=ia.SpringDamper(k=900.0, d=4.0),
        buffer=ia.ElastoGap(k=5e4, d=60.0, s_rel0=-0.03),
        wall=ia.Fixed(),
    )
    net.connect(net.push.flange, net.cart.flange, net.gap.flange_a)
    net.connect(net.gap.flange_b, net.slide.flange, net.hold.flange_b, net.buffer.flange_b)
    return net.connect(net.wall.flange, net.hold.flange_a, net.buffer.flange_a)


def servo() -> ia.Network:
    net = ia.Network(
        "servo",
        wanted=signals.Sine(amplitude=0.1, f=0.7),
        error=signals.Feedback(),
        gain=signals.Gain(k=500.0),
        lag=signals.FirstOrder(T=0.01),
        motor=ia.Force(),
        cart=ia.Mass(m=3.0),
        guide=ia.SupportFriction(friction=ia.CoulombFriction(f_c=10.0)),
        sensor=ia.PositionSensor(),
    )
    net.connect(net.wanted.y, net.error.u1)
    net.connect(net.sensor.s, net.error.u2)
    net.connect(net.error.y, net.gain.u)
    net.connect(net.gain.y, net.lag.u)
    net.connect(net.lag.y, net.motor.f)
    return net.connect(net.motor.flange, net.cart.flange, net.guide.flange, net.sensor.flange)


def planetary_inerter() -> ia.Network:
    """A screw with clearance and friction, planets with elastic teeth and friction, on its rig."""
    net = ia.Network(
        "planetary inerter",
        drive=ia.Force(f=lambda t: 300 * ca.sin(12 * t)),
        rod=ia.Mass(m=0.5),
        inerter=machines.ge_wang.planetary_inerter(),
        frame=ia.Fixed(),
    )
    net.connect(net.drive.flange, net.rod.flange, net.inerter.flange_a)
    return net.connect(net.inerter.flange_b, net.frame.flange)


# By machine: how long it runs [s], what is compared, and least number of events.
MACHINES: dict[Any, tuple[float, list[str], int]] = {
    quarter_car: (2.0, ["body.s", "wheel.v"], 0),
    frame_with_tid: (4.0, ["floor.s", "column.f"], 0),
    torsional_drive: (3.0, ["motor.w", "load.phi", "shaft.tau"], 0),
    block_on_belt: (2.0, ["block.s", "block.v"], 8),
    play_and_buffer: (2.0, ["cart.s", "slide.s", "slide.v"], 0),
    servo: (3.0, ["cart.s", "cart.v"], 6),
    planetary_inerter: (0.3, ["rod.s", "rod.v"], 5),
}


def error(net: ia.Network, stop: float, names: list[str], events: int, **options: Any) -> float:
    """Return the largest difference between both runs, as a share of how far a signal goes."""
    rumoca = pytest.importorskip("rumoca", reason="rumoca is not installed")
    text = ia.to_modelica(net, stop=stop, msl=bool(options))
    kept = rumoca.SimConfig(rtol=1e-8, atol=1e-10, max_wall_seconds=60)
    model = rumoca.Session(**options).loads(text, model=text.split()[1])
    other = model.simulate((0.0, stop), dt=stop / 400, config=kept)
    run = net.simulate(stop, step=stop / 400, rtol=1e-9)
    assert len(run.events) >= events
    grid = np.linspace(0, stop, 401)[1:-1]
    time = np.array(other.time)
    mine, theirs = np.searchsorted(run.time, grid - 1e-9), np.searchsorted(time, grid - 1e-9)
    assert np.allclose(run.time[mine], grid)
    assert np.allclose(time[theirs], grid)
    largest = 0.0
    for name in names:
        moved = np.ptp(run[name])
        assert moved > 0
        largest = max(
            largest, float(np.abs(np.array(other[reference(name)])[theirs] - run[name][mine]).max() / moved)
        )
    return largest


@pytest.mark.parametrize("machine", MACHINES)
def test_a_machine_runs_as_natively(machine: Any) -> None:
    assert error(machine(), *MACHINES[machine]) < 1e-4


@needs_msl
@pytest.mark.parametrize("machine", MACHINES)
def test_a_machine_of_the_standard_library_runs_as_natively(machine: Any) -> None:
    assert error(machine(), *MACHINES[machine], roots=LIBRARY) < 1e-4
