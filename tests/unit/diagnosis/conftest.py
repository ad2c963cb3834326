"""A carriage on a spring, as it is modelled and as it rubs, and what an instrument records of it."""

from collections.abc import Callable
from dataclasses import dataclass

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import EFFECTS
from inertance.identification import Multisine, Record, sampled
from numpy.typing import NDArray

Array = NDArray[np.float64]
Sensor = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class Carriage:
    """The machine, and records of it.

    Attributes:
        rate: samples per second.
        duration: of a record [s].
        noise: of the position [m].
    """

    rate: float
    duration: float
    noise: float

    def rig(self, k: float = 800.0, d: float = 6.0) -> ia.Network:
        """Return the carriage as it is modelled."""
        net = ia.Network(
            "rig",
            wall=ia.Fixed(),
            spring=ia.Spring(k=k),
            guide=ia.Damper(d=d),
            carriage=ia.Mass(m=2.0),
            push=ia.Force(),
        )
        net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
        return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)

    def rubbing(self) -> ia.Network:
        """Return the carriage with 0.8 N of dry friction and a stiffer spring."""
        net = self.rig(k=820.0)
        net.add(rail=ia.CoulombFriction(f_c=0.8)).connect(net.wall.flange, net.rail.flange_a)
        return net.connect(net.rail.flange_b, net.carriage.flange)

    def measured(self, truth: ia.Network, seed: int, sensor: Sensor | None = None) -> Record:
        """Return force F and position x under a random force, as an instrument with noise records them."""
        pushed = Multisine(rms=5.0, low=0.5, high=8.0, period=self.duration, seed=seed)
        drive = sampled(pushed, self.duration, self.rate, fade=0.5)
        inputs = {"push.f": drive}
        run = truth.simulate(self.duration, inputs=inputs, step=1 / self.rate, rtol=1e-8, atol=1e-11)
        x = run["carriage.s"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
        noise = self.noise * np.random.default_rng(seed).standard_normal(len(x))
        seen = sensor(drive.time, x) if sensor else x
        return Record(f"run {seed}", drive.time, {"F": drive.values, "x": seen + noise})


@pytest.fixture
def few_effects(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a diagnosis try but some effects, where what is tested is not how it tells them from all others."""
    tried = "coulomb_friction", "viscous_damping", "cubic_stiffness", "sensor_delay", "actuator_delay"
    for kind in EFFECTS.keys() - {*tried, "quadratic_damping", "sensor_gain"}:
        monkeypatch.delitem(EFFECTS, kind)


@pytest.fixture(scope="session")
def carriage() -> Callable[..., Carriage]:
    """Return the carriage, given rate, duration and noise of its records."""
    return Carriage
