"""Jumps of prescribed motions in FMUs: all four kinds do what the network does."""

from pathlib import Path
from typing import Any

import casadi as ca
import fmpy
import inertance as ia
import numpy as np
import pytest
from inertance import Damper, Fixed, HardStop, Inerter, Mass, Network, Position, Speed, signals

KINDS = [(v, kind) for v in ("2.0", "3.0") for kind in ("ModelExchange", "CoSimulation")]


def dragged(drive: Any, source: Any = None) -> Network:
    net = Network("dragged", drive=drive, inerter=Inerter(b=50.0), damper=Damper(d=20.0), mass=Mass(m=100.0))
    net.connect(net.drive.flange, net.inerter.flange_a, net.damper.flange_a)
    net.connect(net.inerter.flange_b, net.damper.flange_b, net.mass.flange)
    if source is not None:
        net.add(source=source)
        net.connect(net.source.y, net.drive.v_ref if isinstance(drive, Speed) else net.drive.s_ref)
    return net


CASES = {
    "step": lambda: dragged(Speed(), signals.Step(start_time=0.4)),
    "step at once": lambda: dragged(Speed(), signals.Step()),
    "kink at once": lambda: dragged(Position(), signals.Ramp(duration=0.3)),
    "pulse": lambda: dragged(Speed(), signals.Pulse(period=0.3, start_time=0.05)),
    "kink": lambda: dragged(Position(), signals.Ramp(start_time=0.3, duration=0.3)),
    "function": lambda: dragged(Speed(v_ref=lambda t: ca.if_else(t < 0.4, 0, 1))),
    "bent function": lambda: dragged(Position(s_ref=lambda t: ca.fmax(0, t - 0.4))),
}


@pytest.mark.parametrize("case", CASES)
def test_four_kinds_agree_with_the_run_of_the_network(case: str, tmp_path: Path) -> None:
    net = CASES[case]()
    run = net.simulate(1.0, step=0.01, rtol=1e-10, atol=1e-12)
    for version, kind in KINDS:
        path = tmp_path / f"{version}.fmu"
        if not path.exists():
            ia.export_fmu(net, path, fmi_version=version, outputs=["mass.v"])
        told = fmpy.simulate_fmu(
            str(path), fmi_type=kind, stop_time=1.0, output=["mass.v"], output_interval=0.01,
            relative_tolerance=1e-8,
        )  # fmt: skip
        assert told["mass.v"][-1] == pytest.approx(run["mass.v"][-1], abs=1e-6), (version, kind)
        assert told["mass.v"].max() == pytest.approx(run["mass.v"].max(), abs=1e-6), (version, kind)


def test_the_check_of_an_fmu_knows_shocks_through_contacts() -> None:
    net = dragged(Speed(), signals.Step(start_time=0.4))
    net.add(stop=HardStop(s_min=-1.0), wall=Fixed())
    net.connect(net.wall.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.mass.flange)
    assert ia.fmu.check_fmu(net).passed


def given(path: Path, version: str, kind: str, columns: dict[str, Any]) -> float:
    times = np.linspace(0, 2, 201)
    names = [("time", float), *((name, float) for name in columns)]
    data = np.zeros(len(times), dtype=names)
    data["time"] = times
    for name, course in columns.items():
        data[name] = course(times)
    told = fmpy.simulate_fmu(
        str(path), fmi_type=kind, stop_time=2.0, input=data, output=["mass.v"], output_interval=0.01
    )
    return float(told["mass.v"][-1])


@pytest.mark.parametrize(("version", "kind"), KINDS)
def test_an_input_that_moves_without_its_derivative_ends_the_run(
    version: str, kind: str, tmp_path: Path
) -> None:
    net = Network("bare", drive=Speed(), inerter=Inerter(b=50.0), mass=Mass(m=100.0))
    net.connect(net.drive.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange)
    made = ia.FMU(ia.export_fmu(net, tmp_path / "bare.fmu", fmi_version=version))
    short = "ME" if kind == "ModelExchange" else "CS"
    ramp: dict[str, Any] = {"drive.v_ref": lambda t: min(t, 1.0)}
    slope: dict[str, Any] = {"der(drive.v_ref)": lambda t: 1.0 * (t < 1.0)}
    if (version, short) == ("2.0", "CS"):  # whose slopes are told by fmi2SetRealInputDerivatives
        run = made.simulate(2.0, kind=short, inputs=ramp, step=0.01)
        assert run["mass.v"][-1] == pytest.approx(1 / 3, rel=5e-3)
    else:
        with pytest.raises(ia.FMUError, match=r"derivative.*exact=False"):
            made.simulate(2.0, kind=short, inputs=ramp, step=0.01)
    if short == "CS":
        run = made.simulate(2.0, kind=short, inputs=ramp | slope, step=0.01)
        assert run["mass.v"][-1] == pytest.approx(1 / 3, rel=5e-3)


@pytest.mark.parametrize(("version", "kind"), KINDS)
def test_a_filtered_motion_needs_no_derivative(version: str, kind: str, tmp_path: Path) -> None:
    net = Network("filtered", drive=Speed(exact=False), inerter=Inerter(b=50.0), mass=Mass(m=100.0))
    net.connect(net.drive.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange)
    path = ia.export_fmu(net, tmp_path / "filtered.fmu", fmi_version=version)
    inputs = [v.name for v in fmpy.read_model_description(str(path)).modelVariables if v.causality == "input"]
    assert inputs == ["drive.v_ref"]
    assert given(path, version, kind, {"drive.v_ref": lambda t: np.minimum(t, 1.0)}) == pytest.approx(
        1 / 3, rel=1e-5
    )
