"""Signals that are on or off, or whole numbers, are Booleans and integers of an FMU."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from inertance import Component, RealInput, RealOutput, signals
from inertance.components.language import Stated
from inertance.fmu import FMUError


class Turned(Component):
    """The same signal with its sign turned: one variable of the equations."""

    u = RealInput("1", "input")
    y = RealOutput("1", "output")

    def equations(self) -> Stated:
        yield self.y == -self.u


def switched() -> ia.Network:
    """A mass of 2 kg, from -0.1 m at 0.4 m/s, that 10 N push while its gate is on; on from 1 to 0.5 m/s."""
    net = ia.Network(
        "switched", gate=signals.BooleanToReal(realTrue=10.0), push=ia.Force(),
        mass=ia.Mass(m=2.0, s=-0.1, v=0.4), speed=ia.SpeedSensor(), place=ia.PositionSensor(),
        fast=signals.Hysteresis(uLow=0.5, uHigh=1.0), side=signals.Sign(), other=Turned(), slow=Turned(),
    )  # fmt: skip
    net.connect(net.gate.y, net.push.f)
    net.connect(net.push.flange, net.mass.flange, net.speed.flange, net.place.flange)
    net.connect(net.speed.v, net.fast.u)
    net.connect(net.place.s, net.side.u)
    net.connect(net.side.y, net.other.u)
    net.connect(net.fast.y, net.slow.u)
    return net


OUTPUTS = ["fast.y", "side.y", "other.y", "slow.y", "mass.v"]


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def path(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("switched")
    return ia.export_fmu(switched(), folder / "it.fmu", fmi_version=request.param, outputs=OUTPUTS)


def test_the_types_are_told(path: Path) -> None:
    assert validate_fmu(str(path)) == []
    told: dict[str, Any] = {v.name: v for v in fmpy.read_model_description(str(path)).modelVariables}
    whole = "Integer" if told["mass.v"].type == "Real" else "Int32"
    wanted = {"gate.u": "Boolean", "fast.y": "Boolean", "side.y": whole, "other.y": whole}
    assert {name: told[name].type for name in wanted} == wanted
    assert {told[name].variability for name in wanted} == {"discrete"}
    assert told["gate.u"].start == "false"
    assert told["slow.y"].type == told["mass.v"].type  # 0 and -1 are no truth values


@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_a_gate_is_switched_in_the_middle_of_a_run(path: Path, kind: str) -> None:
    given = {"gate.u": ([0.0, 0.2, 0.8], [False, True, False])}
    run = ia.FMU(path).simulate(1.0, step=0.05, kind=kind, inputs=given, rtol=1e-8)
    v = 0.4 + 5.0 * np.clip(run.time - 0.2, 0.0, 0.6)
    assert run["mass.v"] == pytest.approx(v, abs=1e-6)
    apart = np.abs(v - 1.0) > 1e-6
    assert run["fast.y"][apart] == pytest.approx((v > 1.0)[apart].astype(float))
    crossed = -0.1 + 0.4 * 0.2 + 0.4 * (run.time - 0.2) + 2.5 * (run.time - 0.2) ** 2 > 0
    assert run["side.y"][run.time > 0.4] == pytest.approx(np.where(crossed, 1.0, -1.0)[run.time > 0.4])
    assert run["other.y"] == pytest.approx(-run["side.y"])


def test_what_is_no_truth_value_is_refused(path: Path) -> None:
    with pytest.raises(FMUError, match="2"):
        ia.FMU(path).simulate(0.1, start={}, inputs={"gate.u": 2.0})


def test_a_gate_is_switched_at_events_only(path: Path) -> None:
    description = fmpy.read_model_description(str(path))
    gate, fast, speed = (
        next(v.valueReference for v in description.modelVariables if v.name == name)
        for name in ("gate.u", "fast.y", "mass.v")
    )
    folder = fmpy.extract(str(path))
    instance: Any = fmpy.instantiate_fmu(folder, description, "ModelExchange")
    if description.fmiVersion == "2.0":
        instance.setupExperiment()
    instance.enterInitializationMode()
    instance.exitInitializationMode()
    instance.setBoolean([gate], [True])
    real = "Real" if description.fmiVersion == "2.0" else "Float64"
    get, put = (getattr(instance, f"{way}{real}") for way in ("get", "set"))
    for call, arguments in ((get, ([fast],)), (put, ([gate], [1.0])), (instance.getBoolean, ([speed],))):
        with pytest.raises(Exception, match="failed"):
            call(*arguments)
    assert list(instance.getBoolean([gate, fast])) == [True, False]
    instance.enterContinuousTimeMode()
    with pytest.raises(Exception, match="failed"):
        instance.setBoolean([gate], [False])
    instance.freeInstance()
