"""Steps of an FMU in Co-Simulation that lead beyond communication points change nothing but the cost."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
STOP, POINTS = 2.0, 1000
TOLERANCE = 1e-6
SHOWN = ("block.s", "block.v", "rub.f", "ball.s", "ball.v")
Array = np.ndarray[Any, np.dtype[np.float64]]


def machine() -> ia.Network:
    """A block that a spring draws over a belt, on which it sticks and slips, and a ball that bounces."""
    net = ia.Network("machine", belt=ia.Speed(v_ref=0.1), rub=ia.StribeckFriction(f_c=5.0, f_s=8.0, v_s=0.05))
    net.add(block=ia.Mass(m=1.0), spring=ia.Spring(k=100.0), wall=ia.Fixed(), push=ia.Force())
    net.add(stop=ia.HardStop(e=0.7), ball=ia.Mass(m=0.5, s=1.0), weight=ia.ConstantForce(f_constant=-4.905))
    net.connect(net.belt.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.block.flange, net.spring.flange_b, net.push.flange)
    net.connect(net.wall.flange, net.spring.flange_a, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)


class Slave:
    """The machine as an FMU, stepped by hand."""

    def __init__(self, folder: str, description: Any) -> None:
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.shown = [self.reference[name] for name in SHOWN]
        self.fmu: Any = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="it",
        )
        quiet = fmi2CallbackFunctions(logger=fmi2CallbackLoggerTYPE(lambda *told: None))
        self.fmu.instantiate(callbacks=quiet)
        self.fmu.setupExperiment(tolerance=TOLERANCE, startTime=0.0, stopTime=STOP)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def set(self, name: str, value: float) -> None:
        self.fmu.setReal([self.reference[name]], [value])

    def over(
        self, times: Array, before: Callable[[Slave, float], None] = lambda slave, t: None
    ) -> dict[str, Array]:
        """Step from instant to instant, and return what is shown at each."""
        rows = [self.fmu.getReal(self.shown)]
        for t, until in zip(times[:-1].tolist(), times[1:].tolist(), strict=True):
            before(self, t)
            self.fmu.doStep(t, until - t)
            rows.append(self.fmu.getReal(self.shown))
        return dict(zip(SHOWN, np.array(rows).T, strict=True))

    def end(self) -> None:
        self.fmu.terminate()
        self.fmu.freeInstance()


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Any]:
    folder: Path = tmp_path_factory.mktemp("ahead")
    path = ia.export_fmu(machine(), folder / "machine.fmu", outputs=list(SHOWN), start={"rub.v_rel": 0.0})
    return str(fmpy.extract(str(path), unzipdir=str(folder / "inside"))), fmpy.read_model_description(
        str(path)
    )


@pytest.fixture
def slave(exported: tuple[str, Any]) -> Any:
    made = Slave(*exported)
    yield made
    made.end()


def exact(**asked: Any) -> ia.Result:
    asked = {"inputs": {"push.f": 0.0}, "start": {"rub.v_rel": 0.0}} | asked
    return machine().simulate(STOP, rtol=1e-10, atol=1e-12, step=1e-4, **asked)


def off(found: dict[str, Array], run: ia.Result, times: Array) -> float:
    """Return by how much what was found misses a run, as a share of its range, but right at its events."""
    instants = [event.time for event in run.events]
    apart = np.array([min(abs(t - instant) for instant in instants) for t in times]) > 1e-5
    return max(
        float(np.abs(found[name] - run.at(name, times))[apart].max() / np.ptp(run[name])) for name in SHOWN
    )


@pytest.mark.parametrize("points", [7, POINTS, 20 * POINTS])
def test_however_fine_they_are_an_fmu_keeps_what_is_asked(slave: Slave, points: int) -> None:
    times = np.linspace(0.0, STOP, points + 1)
    assert off(slave.over(times), exact(), times) < 10 * TOLERANCE


def test_uneven_points_do_not_matter(slave: Slave) -> None:
    times = np.unique(np.r_[0.0, np.random.default_rng(0).integers(0, 20 * POINTS, 2 * POINTS) * 1e-4, STOP])
    assert off(slave.over(times), exact(), times) < 10 * TOLERANCE


def test_an_input_that_is_set_within_a_step_acts_at_once(slave: Slave) -> None:
    times = np.linspace(0.0, STOP, POINTS + 1)
    at = float(times[437])

    def push(slave: Slave, t: float) -> None:
        slave.set("push.f", -3.0 if t >= at else 0.0)

    found = slave.over(times, push)
    record = ia.Sampled([0.0, at, STOP], [0.0, -3.0, -3.0], interpolation="hold")
    assert off(found, exact(inputs={"push.f": record}), times) < 10 * TOLERANCE


def test_a_parameter_that_is_tuned_within_a_step_acts_at_once(slave: Slave) -> None:
    times = np.linspace(0.0, STOP, POINTS + 1)
    at = 437
    found = slave.over(times[: at + 1])
    slave.set("spring.k", 60.0)
    rest = slave.over(times[at:])
    before = exact()
    last = {name: float(found[name][-1]) for name in ("block.s", "block.v", "ball.s", "ball.v")}
    after = machine().simulate(
        STOP,
        begin=float(times[at]),
        start=last,
        parameters={"spring.k": 60.0},
        inputs={"push.f": 0.0},
        rtol=1e-10,
        atol=1e-12,
        guess={"rub.s_rel": 0.0},
    )
    assert off(found, before, times[: at + 1]) < 10 * TOLERANCE
    assert abs(rest["block.s"][-1] - after["block.s"][-1]) < 10 * TOLERANCE


def test_a_state_saved_within_a_step_goes_on_to_the_last_bit(slave: Slave) -> None:
    times = np.linspace(0.0, STOP, POINTS + 1)
    slave.over(times[:301])
    state = slave.fmu.getFMUState()
    first = slave.over(times[300:])
    slave.fmu.setFMUState(state)
    again = slave.over(times[300:])
    slave.fmu.freeFMUState(state)
    for name in SHOWN:
        np.testing.assert_array_equal(first[name], again[name])


def test_a_step_taken_back_and_taken_otherwise_forgets_what_lay_ahead(slave: Slave) -> None:
    """As masters do that iterate: the second time another force acts."""
    times = np.linspace(0.0, STOP, POINTS + 1)
    slave.over(times[:438])
    state = slave.fmu.getFMUState()
    slave.over(times[437:500])
    slave.fmu.setFMUState(state)
    slave.fmu.freeFMUState(state)
    slave.set("push.f", -3.0)
    found = slave.over(times[437:])
    record = ia.Sampled([0.0, float(times[437]), STOP], [0.0, -3.0, -3.0], interpolation="hold")
    assert off(found, exact(inputs={"push.f": record}), times[437:]) < 10 * TOLERANCE
