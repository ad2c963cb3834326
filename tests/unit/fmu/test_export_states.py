"""Instances of exported FMUs: states saved and restored, order of calls, derivatives, events."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Model, FMU3Slave

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
FALL = (2 / 9.81) ** 0.5


def machine() -> ia.Network:
    """A driven ball above a stop, and beside it a mass on a cubic spring."""
    net = ia.Network(
        "machine",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
        push=ia.Force(),
        spring=ia.CubicSpring(k=80.0, k3=2e3),
        block=ia.Mass(m=2.0, s=0.3),
        damper=ia.Damper(d=0.5),
    )
    net.connect(net.floor.flange, net.stop.flange_a, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange, net.push.flange)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.block.flange)


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Box:
    folder = tmp_path_factory.mktemp("states")
    outputs = ["ball.s", "ball.v", "ball.a", "block.s", "spring.f", "stop.mode"]
    path = ia.export_fmu(machine(), folder / "machine.fmu", fmi_version=request.param, outputs=outputs)
    return Box(path, str(fmpy.extract(str(path), unzipdir=str(folder / "inside"))))


class Box:
    """An extracted FMU and its value references."""

    def __init__(self, path: Path, folder: str) -> None:
        self.folder = folder
        self.description: Any = fmpy.read_model_description(str(path))
        self.new = self.description.fmiVersion != "2.0"
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}

    def instance(self, kind: str = "cs", running: bool = True, **options: Any) -> Any:
        """Return an instance, initialized unless told otherwise."""
        classes: dict[str, Any] = {"cs": (FMU2Slave, FMU3Slave), "me": (FMU2Model, FMU3Model)}
        made = classes[kind][self.new](
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="it",
        )
        if not self.new:  # those of FMPy share one logger, which `simulate_fmu` frees
            options["callbacks"] = fmi2CallbackFunctions(logger=fmi2CallbackLoggerTYPE(lambda *told: None))
        made.instantiate(**options)
        if running:
            self.begin(made)
        return made

    def begin(self, made: Any) -> None:
        if not self.new:
            made.setupExperiment(startTime=0.0)
        made.enterInitializationMode(**({"startTime": 0.0} if self.new else {}))
        made.exitInitializationMode()

    def get(self, made: Any, *names: str) -> list[float]:
        references = [self.reference[name] for name in names]
        values: list[float] = made.getFloat64(references) if self.new else made.getReal(references)
        return values

    def set(self, made: Any, **values: float) -> None:
        references = [self.reference[name.replace("__", ".")] for name in values]
        (made.setFloat64 if self.new else made.setReal)(references, list(values.values()))

    def step(self, made: Any, count: int, begin: int = 0) -> list[float]:
        for k in range(begin, begin + count):
            made.doStep(currentCommunicationPoint=k * 0.01, communicationStepSize=0.01)
        return self.get(made, "ball.s", "ball.v", "block.s", "spring.f")

    def state(self, made: Any) -> Any:
        return made.getFMUState() if self.new else made.getFMUstate()

    def restore(self, made: Any, state: Any) -> None:
        made.setFMUState(state) if self.new else made.setFMUstate(state)

    def serialized(self, made: Any, state: Any) -> bytes:
        data: bytes = made.serializeFMUState(state) if self.new else made.serializeFMUstate(state)
        return data

    def deserialized(self, made: Any, data: bytes) -> Any:
        return made.deserializeFMUState(data) if self.new else made.deSerializeFMUstate(data)


def test_a_step_after_restoring_is_equal_to_the_last_bit(fmu: Box) -> None:
    made = fmu.instance()
    fmu.step(made, 44)  # the ball strikes at 0.4515 s
    state = fmu.state(made)
    first = fmu.step(made, 30, 44)
    fmu.restore(made, state)
    assert fmu.step(made, 30, 44) == first
    other = fmu.instance()
    fmu.restore(other, fmu.deserialized(other, fmu.serialized(made, state)))
    assert fmu.step(other, 30, 44) == first
    made.reset()
    fmu.begin(made)
    fmu.step(made, 44)
    assert fmu.step(made, 30, 44) == first


def test_a_state_of_something_else_is_refused(fmu: Box) -> None:
    made, model = fmu.instance(), fmu.instance("me")
    with pytest.raises(FMICallException):
        fmu.restore(made, ctypes.c_void_p())
    with pytest.raises(FMICallException):
        fmu.restore(made, fmu.state(model))
    data = bytearray(fmu.serialized(made, fmu.state(made)))
    data[len(data) // 2] ^= 1
    for broken in (bytes(data), bytes(data[:100])):
        with pytest.raises(FMICallException):
            fmu.deserialized(made, broken)
    assert len(fmu.step(made, 1)) == 4


def test_refused_calls_leave_the_instance_as_it_was(fmu: Box) -> None:
    made, twin = fmu.instance(), fmu.instance()
    numbers = (made.setFloat64, made.getFloat64) if fmu.new else (made.setReal, made.getReal)
    refusals: list[Callable[[], Any]] = [
        lambda: numbers[0]([fmu.reference["push.f"]], [float("nan")]),
        lambda: numbers[0]([fmu.reference["push.f"]], [float("inf")]),
        lambda: numbers[0]([fmu.reference["ball.m"]], [-1.0]),
        lambda: numbers[0]([fmu.reference["ball.a"]], [1.0]),
        lambda: numbers[0]([10**6], [1.0]),
        lambda: numbers[1]([10**6]),
        lambda: made.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.0),
        lambda: made.doStep(currentCommunicationPoint=0.0, communicationStepSize=-0.1),
        lambda: made.doStep(currentCommunicationPoint=0.5, communicationStepSize=0.1),
        lambda: made.doStep(currentCommunicationPoint=float("nan"), communicationStepSize=0.1),
        lambda: made.exitInitializationMode(),
    ]
    for refusal in refusals:
        with pytest.raises(FMICallException):
            refusal()
    assert fmu.step(made, 10) == fmu.step(twin, 10)
    made.terminate()
    for late in (lambda: fmu.step(made, 1, 10), made.terminate):
        with pytest.raises(FMICallException):
            late()
    fmu.get(made, "ball.s")


def test_parameters_and_starts_can_be_set(fmu: Box) -> None:
    made = fmu.instance(running=False)
    fmu.set(made, ball__s=2.0, weight__f_constant=-1.0)
    fmu.begin(made)
    assert fmu.step(made, 50)[0] == pytest.approx(2.0 - 0.5 * 2.0 * 0.25, rel=1e-9)
    fmu.set(made, weight__f_constant=0.0)
    before = fmu.get(made, "ball.v")
    fmu.step(made, 10, 50)
    assert fmu.get(made, "ball.v") == pytest.approx(before)


@pytest.mark.parametrize("contact", [False, True])
def test_directional_derivatives_are_those_of_differences(fmu: Box, contact: bool) -> None:
    made = fmu.instance("me", running=False)
    if contact:
        fmu.set(made, ball__s=0.0)
    fmu.begin(made)
    made.updateDiscreteStates() if fmu.new else made.newDiscreteStates()
    made.enterContinuousTimeMode()
    names = [s.variable.derivative.name for s in fmu.description.derivatives]
    count = len(names)
    x = (ctypes.c_double * count)()
    made.getContinuousStates(x, count)
    unknowns = [fmu.reference[n] for n in ("ball.a", "block.s", "spring.f", *(f"der({n})" for n in names))]
    numbers = made.getFloat64 if fmu.new else made.getReal
    for place, name in enumerate(names):
        known = [fmu.reference[name]]
        exact = made.getDirectionalDerivative(unknowns, known, [1.0])
        sides = []
        for step in (1e-6, -1e-6):
            moved = (ctypes.c_double * count)(*x)
            moved[place] += step
            made.setContinuousStates(moved, count)
            sides.append(np.array(numbers(unknowns)))
        made.setContinuousStates(x, count)
        assert exact == pytest.approx((sides[0] - sides[1]) / 2e-6, rel=1e-6, abs=1e-6), name
        if fmu.new:
            seed = np.arange(1.0, len(unknowns) + 1)
            adjoint = made.getAdjointDerivative(unknowns, known, list(seed), nSensitivity=1)
            assert adjoint[0] == pytest.approx(float(seed @ np.array(exact)), rel=1e-12)


def test_many_instances_and_two_threads(fmu: Box) -> None:
    made = [fmu.instance() for _ in range(100)]
    alone = fmu.step(fmu.instance(), 60)
    with ThreadPoolExecutor(2) as pool:
        assert all(found == alone for found in pool.map(lambda one: fmu.step(one, 60), made[:20]))
    for one in made:
        one.freeInstance()


def test_an_input_follows_the_slope_it_is_given(fmu: Box) -> None:
    if fmu.new:
        pytest.skip("FMI 3 has no derivatives of inputs")
    made = fmu.instance(running=False)
    fmu.set(made, ball__s=100.0, weight__f_constant=0.0)
    fmu.begin(made)
    for k in range(100):
        fmu.set(made, push__f=0.03 * k)
        made.setRealInputDerivatives([fmu.reference["push.f"]], [1], [3.0])
        made.doStep(currentCommunicationPoint=0.01 * k, communicationStepSize=0.01)
    assert fmu.get(made, "ball.s")[0] == pytest.approx(100.0 + 3.0 / 0.5 / 6.0, rel=1e-9)


def test_event_mode_returns_at_the_event(fmu: Box) -> None:
    if not fmu.new:
        pytest.skip("event mode in Co-Simulation came with FMI 3")
    made = fmu.instance(eventModeUsed=True, earlyReturnAllowed=True)
    made.updateDiscreteStates()
    made.enterStepMode()
    needed, terminate, early, time = made.doStep(currentCommunicationPoint=0.0, communicationStepSize=1.0)
    assert (needed, terminate, early) == (True, False, True)
    assert time == pytest.approx(FALL, abs=1e-6)
    assert fmu.get(made, "ball.v")[0] < 0
    made.enterEventMode()
    _, _, _, changed, _, _ = made.updateDiscreteStates()
    assert changed
    made.enterStepMode()
    assert fmu.get(made, "ball.v")[0] == pytest.approx(0.7 * 9.81 * FALL, rel=1e-5)
    made.doStep(currentCommunicationPoint=time, communicationStepSize=0.1)


def test_a_state_passes_to_another_process(fmu: Box, tmp_path: Path) -> None:
    made = fmu.instance()
    fmu.step(made, 30)
    (tmp_path / "state").write_bytes(fmu.serialized(made, fmu.state(made)))
    wanted = fmu.step(made, 30, 30)
    code = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
from test_export_states import Box
from pathlib import Path
box = Box(Path({str(fmu.folder)!r}), {str(fmu.folder)!r})
made = box.instance()
box.restore(made, box.deserialized(made, Path({str(tmp_path / "state")!r}).read_bytes()))
print(repr(box.step(made, 30, 30)))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.strip() == repr(wanted), done.stderr
