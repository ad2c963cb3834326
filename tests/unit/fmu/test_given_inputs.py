"""What is built into an FMU is seen, whenever it comes: the same peak as in a native run."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import casadi as ca
import fmpy
import inertance as ia
import numpy as np
import pytest

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
STARTS = (0.0, 0.25, 1.0, 10.0, 100.0)


def at_once(t: Any) -> Any:
    return ca.if_else(ca.logic_and(t >= 0, t < 0.4), 0.025 * (1 - ca.cos(5 * ca.pi * t)), 0.0)


class Bumps(ia.Component):
    """Bumps at all of `STARTS`, as a block that looks at the clock by itself."""

    y = ia.RealOutput("m", "height")

    def equations(self) -> Any:
        yield self.y == sum(at_once(self.time - start) for start in STARTS[1:])


def in_data() -> ia.Sampled:
    t = np.unique(np.concatenate([np.linspace(0, 103, 104), *(np.linspace(s, s + 1, 2001) for s in STARTS)]))
    inside = [
        np.where((t >= s) & (t < s + 0.4), 0.025 * (1 - np.cos(5 * np.pi * (t - s))), 0) for s in STARTS
    ]
    return ia.Sampled(t, sum(inside[1:]))


def cars() -> ia.Network:
    """Three quarter cars, over bumps that are a function, data and a block."""
    net = ia.Network("cars", bumps=Bumps())
    roads = {
        "f": ia.Position(s_ref=lambda t: sum(at_once(t - start) for start in STARTS[1:])),
        "d": ia.Position(s_ref=in_data()),
        "b": ia.Position(),
    }
    for name, road in roads.items():
        tid = ia.series(ia.SpringDamper(k=24e3, d=2400.0), ia.Inerter(b=190.0))
        parts = {"road": road, "tyre": ia.Spring(k=150e3), "wheel": ia.Mass(m=35.0), "body": ia.Mass(m=250.0)}
        parts["strut"] = ia.parallel(ia.Spring(k=60e3), tid)
        net.add(**{f"{part}_{name}": component for part, component in parts.items()})
        road, tyre, wheel, body, strut = (getattr(net, f"{part}_{name}") for part in parts)
        net.connect(road.flange, tyre.flange_a)
        net.connect(tyre.flange_b, wheel.flange, strut.flange_a)
        net.connect(strut.flange_b, body.flange)
    return net.connect(net.bumps.y, net.road_b.s_ref)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_bumps_built_in_give_their_peaks_in_every_kind_of_fmu(version: str, tmp_path: Path) -> None:
    outputs = [f"body_{name}.s" for name in "fdb"]
    path = ia.export_fmu(
        cars(), tmp_path / "cars.fmu", fmi_version=version, outputs=outputs, stop=103.0, tolerance=1e-7
    )
    native = cars().simulate(103.0, step=0.02, rtol=1e-8, atol=1e-10)
    for kind, interval in (("ModelExchange", 0.02), ("CoSimulation", 0.02)):
        run = fmpy.simulate_fmu(
            str(path),
            fmi_type=kind,
            stop_time=103.0,
            output_interval=interval,
            output=outputs,
            relative_tolerance=1e-7,
        )
        for begin in STARTS[1:]:
            during = (run["time"] >= begin) & (run["time"] < begin + 2.5)
            there = (native.time >= begin) & (native.time < begin + 2.5)
            for name in outputs:
                peak = abs(native[name][there]).max()
                assert peak > 0.04
                assert abs(run[name][during]).max() == pytest.approx(peak, rel=1e-4), (kind, begin, name)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_model_exchange_announces_when_what_is_built_in_switches(version: str, tmp_path: Path) -> None:
    net = ia.Network(
        "wagon",
        push=ia.Force(f=lambda t: ca.if_else(ca.logic_and(t > 50, t < 50.001), 1e3, 0.0)),
        mass=ia.Mass(m=1.0),
    )
    net.connect(net.push.flange, net.mass.flange)
    path = ia.export_fmu(net, tmp_path / "wagon.fmu", fmi_version=version, outputs=["mass.v"])
    for kind in ("ModelExchange", "CoSimulation"):
        run = fmpy.simulate_fmu(str(path), fmi_type=kind, stop_time=100.0, output_interval=10.0)
        assert run["mass.v"][-1] == pytest.approx(1.0, rel=1e-5), kind
    for kind in ("ME", "CS"):
        run = ia.FMU(path).simulate(100.0, step=10.0, kind=kind)
        assert run["mass.v"][-1] == pytest.approx(1.0, rel=1e-5), kind
