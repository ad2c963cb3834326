"""Inputs that move or jump and parameters that change, at the start and between steps, in every FMU."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
KINDS = ("ModelExchange", "CoSimulation")
VERSIONS = ("2.0", "3.0")


def belt(hand: Any) -> ia.Network:
    """A block on a belt that is moved by hand, held by a spring."""
    net = ia.Network(
        "belt",
        hand=hand,
        rub=ia.CoulombFriction(f_c=5.0, peak=1.5),
        block=ia.Mass(m=1.0),
        spring=ia.SpringDamper(k=50.0, d=1.0),
        wall=ia.Fixed(),
    )
    net.connect(net.hand.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.block.flange, net.spring.flange_b)
    return net.connect(net.wall.flange, net.spring.flange_a)


# How the hand moves, what that is natively, and what a tool gives: values at 0 and 0.05 s.
HANDS: dict[str, tuple[Callable[[], Any], dict[str, Any], dict[str, tuple[float, float]]]] = {
    "speed": (lambda: ia.Speed(v_ref=-0.5), {}, {}),
    "given speed": (ia.Speed, {"hand.v_ref": 0.5}, {"hand.v_ref": (0.5, 0.5)}),
    "speed of time": (lambda: ia.Speed(v_ref=lambda t: 0.5 * ca.cos(3 * t)), {}, {}),
    "position of time": (lambda: ia.Position(s_ref=lambda t: 0.1 * ca.sin(5 * t)), {}, {}),
    "given position": (
        ia.Position,
        {"hand.s_ref": lambda t: 0.5 * t},
        {"hand.s_ref": (0, 0.025), "der(hand.s_ref)": (0.5, 0.5)},
    ),
    "acceleration": (lambda: ia.Accelerate(a_ref=30.0), {}, {}),
}


# What a tool gives is set by calls that differ between versions; what is built in is C, the same for both.
CASES = [(case, v) for case in HANDS for v in (VERSIONS if HANDS[case][2] else VERSIONS[len(case) % 2 :][:1])]


@pytest.mark.parametrize(("case", "version"), CASES)
def test_what_is_driven_starts_to_slide_as_natively(case: str, version: str, tmp_path: Path) -> None:
    """With the speed given to the FMU it was stuck to a belt that passed by, with 0.5 N for 5 N."""
    hand, inputs, given = HANDS[case]
    dae = belt(hand()).dae()
    native = ia.simulate(dae, 0.05, step=1e-3, inputs=inputs, rtol=1e-9, atol=1e-11)
    names = ["rub.mode", "rub.f", "block.v"]
    path = ia.export_fmu(dae, tmp_path / "it.fmu", fmi_version=version, outputs=names)
    rows = [(t, *(values[k] for values in given.values())) for k, t in enumerate((0.0, 0.05))]
    table: Any = (
        np.array(rows, dtype=[("time", float), *((name, float) for name in given)]) if given else None
    )
    for kind in KINDS:
        run = fmpy.simulate_fmu(
            str(path), fmi_type=kind, stop_time=0.05, output_interval=1e-3, input=table,
            relative_tolerance=1e-8,
        )  # fmt: skip
        assert [run[name][0] for name in names] == pytest.approx(
            [native[name][0] for name in names], abs=1e-8
        )
        assert run["block.v"][-1] == pytest.approx(native["block.v"][-1], abs=2e-4), (
            kind
        )  # inputs are held 1 ms


def rubbed() -> ia.Network:
    """A block that sticks, and is pushed."""
    net = ia.Network(
        "rubbed", wall=ia.Fixed(), rub=ia.CoulombFriction(f_c=5.0), block=ia.Mass(m=1.0), push=ia.Force()
    )
    net.connect(net.wall.flange, net.rub.flange_a)
    return net.connect(net.rub.flange_b, net.block.flange, net.push.flange)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_push_that_jumps_between_steps_breaks_away(kind: str, version: str, tmp_path: Path) -> None:
    """In Co-Simulation what an input set off when it was set never happened: the block stuck for ever."""
    path = ia.export_fmu(rubbed(), tmp_path / "it.fmu", fmi_version=version, outputs=["block.v"])
    courses = [(0.0, 3.0), (0.1, 3.0), (0.1, 10.0), (0.2, 10.0)]
    push = np.array(courses, dtype=[("time", float), ("push.f", float)])
    run = fmpy.simulate_fmu(str(path), fmi_type=kind, stop_time=0.2, output_interval=0.01, input=push)
    assert run["block.v"][-1] == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_parameter_that_changes_between_steps_counts_at_once(version: str, tmp_path: Path) -> None:
    path = ia.export_fmu(rubbed(), tmp_path / "it.fmu", fmi_version=version, outputs=["block.v", "rub.mode"])
    told: Any = fmpy.read_model_description(str(path))
    made: Any = (FMU2Slave if version == "2.0" else FMU3Slave)(
        guid=told.guid, unzipDirectory=fmpy.extract(str(path), unzipdir=str(tmp_path / "inside")),
        modelIdentifier=told.coSimulation.modelIdentifier, instanceName="it",
    )  # fmt: skip
    made.instantiate()
    reference = {v.name: v.valueReference for v in told.modelVariables}
    put, get = (made.setReal, made.getReal) if version == "2.0" else (made.setFloat64, made.getFloat64)
    if version == "2.0":
        made.setupExperiment(startTime=0.0)
    made.enterInitializationMode(**({} if version == "2.0" else {"startTime": 0.0}))
    put([reference["push.f"]], [3.0])
    made.exitInitializationMode()
    for k in range(20):
        if k == 10:
            assert get([reference["block.v"]]) == [0.0]
            put([reference["rub.f_c"]], [1.0])
        made.doStep(currentCommunicationPoint=k * 0.01, communicationStepSize=0.01)
    assert get([reference["block.v"]]) == pytest.approx([0.2])
    made.terminate()
    made.freeInstance()
