"""FMUs of other tools: pythonfmu (FMI 2.0) and pythonfmu3 (FMI 3.0)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from inertance import FMU, Fixed, FMUError, Mass, Network, SpringDamper, rotational
from inertance.fmu import CoupledRun, FMUForce, FMUMotion, FMURotation, FMUTorque, cosimulate

DRAG = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Drag(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.v, self.c = 0.0, 50.0
        self.register_variable(Real("v", causality=Fmi2Causality.input))
        output, tunable = Fmi2Causality.output, Fmi2Variability.tunable
        self.register_variable(Real("c", causality=Fmi2Causality.parameter, variability=tunable))
        self.register_variable(Real("F", causality=output, getter=lambda: self.c * self.v * abs(self.v)))

    def do_step(self, current_time, step_size):
        return True
"""
BODY = """
from pythonfmu3 import Fmi3Causality, Fmi3Slave, Fmi3Variability, Float64


class Body(Fmi3Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.time, self.F, self.s, self.v, self.m = 0.0, 0.0, 0.0, 0.0, 2.0
        moving, fixed = Fmi3Variability.continuous, Fmi3Variability.fixed
        self.register_variable(Float64("time", causality=Fmi3Causality.independent, variability=moving))
        self.register_variable(Float64("F", causality=Fmi3Causality.input, variability=moving, start=0.0))
        self.register_variable(Float64("m", causality=Fmi3Causality.parameter, variability=fixed, start=2.0))
        self.register_variable(Float64("s", causality=Fmi3Causality.output, variability=moving))
        self.register_variable(Float64("v", causality=Fmi3Causality.output, variability=moving))

    def do_step(self, current_time, step_size):
        a = self.F / self.m
        self.s += self.v * step_size + 0.5 * a * step_size**2
        self.v += a * step_size
        return True
"""


BALL = """
from pythonfmu3 import Fmi3Causality, Fmi3Initial, Fmi3SlaveBase, Fmi3Variability, Float64, ModelExchange
from pythonfmu3.modelexchange import Fmi3UpdateDiscreteStatesResult as Update


class Ball(Fmi3SlaveBase, ModelExchange):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.time, self.h, self.v, self.dh, self.dv, self.above = 0.0, 1.0, 0.0, 0.0, 0.0, 1.0
        out, local, moving, exact = (
            Fmi3Causality.output, Fmi3Causality.local, Fmi3Variability.continuous, Fmi3Initial.exact)
        self.register_variable(Float64("time", causality=Fmi3Causality.independent, variability=moving))
        height = Float64("h", causality=out, variability=moving, initial=exact, start=1.0)
        self.register_variable(height, has_event_indicator=True)
        self.register_variable(Float64("v", causality=out, variability=moving, initial=exact, start=0.0))
        self.register_variable(Float64("dh", causality=local, variability=moving, derivative=1))
        self.register_variable(Float64("dv", causality=local, variability=moving, derivative=2))

    def get_continuous_state_derivatives(self):
        self.dh, self.dv = self.v, -9.81
        return [self.dh, self.dv]

    def get_event_indicators(self):
        return [self.h]

    def update_discrete_states(self):
        update = Update()
        if self.h <= 0.0 and self.v < 0.0:
            self.h, self.v = 0.0, -0.8 * self.v
            update.valuesOfContinuousStatesChanged = True
        return update
"""


@pytest.fixture
def drag(tmp_path: Path) -> FMU:
    """F = c v |v|, FMI 2.0."""
    builder = pytest.importorskip("pythonfmu.builder", reason="needs pythonfmu")
    (tmp_path / "drag.py").write_text(DRAG, encoding="utf-8")
    return FMU(builder.FmuBuilder.build_FMU(tmp_path / "drag.py", dest=tmp_path))


@pytest.fixture
def body(tmp_path: Path) -> FMU:
    """m a = F, FMI 3.0."""
    builder = pytest.importorskip("pythonfmu3.builder", reason="needs pythonfmu3")
    (tmp_path / "body.py").write_text(BODY, encoding="utf-8")
    return FMU(builder.FmuBuilder.build_FMU(tmp_path / "body.py", dest=tmp_path))


def test_a_damper_of_pythonfmu(drag: FMU) -> None:
    strut = FMUForce(drag, velocity="v", force="F", parameters={"c": 2.0})
    net = Network("braked", wall=Fixed(), drag=strut, mass=Mass(m=1.0, v=1.0))
    net.connect(net.wall.flange, net.drag.flange_a)
    net.connect(net.drag.flange_b, net.mass.flange)
    run = cosimulate(net, 1.0, communication_step=0.01)
    assert np.abs(run["mass.v"] - 1 / (1 + 2 * run.time)).max() < 1e-4
    assert run.step_error["drag.f"] < 2e-3


def test_a_damper_that_turns_and_a_sign(drag: FMU) -> None:
    brake = FMUTorque(drag, speed="-v", torque="-F", parameters={"c": 2.0})
    net = Network("braked", wall=rotational.Fixed(), drag=brake, disc=rotational.Inertia(J=1.0, w=1.0))
    net.connect(net.wall.flange, net.drag.flange_a)
    net.connect(net.drag.flange_b, net.disc.flange)
    run = cosimulate(net, 1.0, communication_step=0.01, halving=False)
    assert np.abs(run["disc.w"] - 1 / (1 + 2 * run.time)).max() < 1e-4


INERTER = DRAG.replace("self.v * abs(self.v)", "self.v").replace("Drag", "Inerter")


@pytest.fixture
def inerter(tmp_path: Path) -> FMU:
    """F = c v, FMI 2.0; fed with an acceleration, an inerter."""
    builder = pytest.importorskip("pythonfmu.builder", reason="needs pythonfmu")
    (tmp_path / "inerter.py").write_text(INERTER, encoding="utf-8")
    return FMU(builder.FmuBuilder.build_FMU(tmp_path / "inerter.py", dest=tmp_path))


def with_inerter(fmu: FMU, b: float) -> CoupledRun:
    strut = FMUForce(fmu, acceleration="v", force="F", parameters={"c": b})
    spring = SpringDamper(k=100.0, d=0.0)
    net = Network("inert", wall=Fixed(), spring=spring, strut=strut, mass=Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a, net.strut.flange_a)
    net.connect(net.mass.flange, net.spring.flange_b, net.strut.flange_b)
    return cosimulate(net, 1.0, communication_step=0.01)


def test_an_inerter_of_less_than_the_mass_couples(inerter: FMU) -> None:
    run = with_inerter(inerter, 0.9)
    assert np.abs(run["mass.s"] - 0.1 * np.cos(np.sqrt(100 / 1.9) * run.time)).max() < 2e-3 * 0.1
    assert run.notes == []


def test_an_inerter_of_more_than_the_mass_is_refused(inerter: FMU) -> None:
    with pytest.raises(FMUError, match=r"half the communication step changes .* the coupling is unstable"):
        with_inerter(inerter, 1.2)


def test_a_body_of_pythonfmu3(body: FMU) -> None:
    assert body.version.startswith("3.0")
    assert body.kinds == ["CS"]
    alone = body.simulate(1.0, inputs={"F": 1.0}, parameters={"m": 4.0}, step=0.1)
    assert np.allclose(alone["s"], alone.time**2 / 8)
    moved = FMUMotion(body, force="F", position="s", velocity="v")
    net = Network("swing", wall=Fixed(), spring=SpringDamper(k=8.0, d=0.0, s_rel0=-0.1), body=moved)
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.body.flange)
    run = cosimulate(net, 2.0, communication_step=0.01, halving=False)
    assert np.abs(run["body.s"] - 0.1 * (np.cos(2 * run.time) - 1)).max() < 1e-4


def test_a_body_that_turns(body: FMU) -> None:
    turned = FMURotation(body, torque="F", angle="s", speed="v")
    spring = rotational.SpringDamper(c=8.0, d=0.0, phi_rel0=-0.1)
    net = Network("swing", wall=rotational.Fixed(), spring=spring, disc=turned)
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.disc.flange)
    run = cosimulate(net, 2.0, communication_step=0.01, halving=False)
    assert np.abs(run["disc.phi"] - 0.1 * (np.cos(2 * run.time) - 1)).max() < 1e-4


def test_a_bouncing_ball_of_pythonfmu3(tmp_path: Path) -> None:
    builder = pytest.importorskip("pythonfmu3.builder", reason="needs pythonfmu3")
    (tmp_path / "ball.py").write_text(BALL, encoding="utf-8")
    ball = FMU(builder.FmuBuilder.build_FMU(tmp_path / "ball.py", dest=tmp_path))
    assert ball.kinds == ["ME"]
    run = ball.simulate(1.0)
    assert run.events[0].time == pytest.approx((2 / 9.81) ** 0.5, abs=1e-6)
    assert run["v"].max() == pytest.approx(0.8 * (2 * 9.81) ** 0.5, rel=1e-6)
