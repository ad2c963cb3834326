"""An FMU replayed on samples, with a load at its port: as the network that has the load in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import inertance as ia
import numpy as np
import pytest
from inertance.fmu import Load, Replay
from numpy.typing import NDArray

Array = NDArray[np.float64]
TIME = np.linspace(0, 2, 1001)
FORCE = 5 * np.sin(12 * TIME) * np.sin(3 * TIME)


def rig() -> ia.Network:
    net = ia.Network("rig", wall=ia.Fixed(), spring=ia.Spring(k=800.0), mass=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


@dataclass(frozen=True)
class Damped:
    """Damper and mass."""

    d: float = 6.0
    m: float = 0.0

    @property
    def accelerating(self) -> bool:
        return self.m > 0

    def __call__(self, t: float, s: float, v: float, a: float) -> float:
        return -self.d * v - self.m * a


def exact(law: Damped, k: float = 800.0) -> Array:
    net = rig().with_values(spring=ia.Spring(k=k))
    net.add(damper=ia.Damper(d=law.d), more=ia.Mass(m=max(law.m, 1e-9)))
    net.connect(net.damper.flange_a, net.wall.flange)
    net.connect(net.damper.flange_b, net.mass.flange, net.more.flange)
    drive = ia.Sampled(TIME, FORCE)
    run = net.simulate(2.0, inputs={"push.f": drive}, step=TIME[1], rtol=1e-9, atol=1e-12)
    return run["mass.s"]


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> ia.FMU:
    path = tmp_path_factory.mktemp("replay") / "rig.fmu"
    ia.export_fmu(rig(), path, fmi_version=request.param, outputs=["mass.s", "mass.v"])
    return ia.FMU(path)


def replayed(
    fmu: ia.FMU, kind: str, law: Damped | None, parameters: dict[str, float], every: int = 1
) -> Array:
    load = Load("push.f", "mass.s", "mass.v", law) if law else None
    with Replay(fmu, kind, ["push.f"], ["mass.s"]) as replay:
        table = replay.run(TIME, FORCE[:, None], parameters, load=load, every=every)
    column: Array = table[:, 0]
    return column


@pytest.mark.parametrize(
    ("kind", "law", "tolerance"),
    [
        ("ME", Damped(), 1e-5),
        ("CS", Damped(), 1e-3),
        ("ME", Damped(m=0.4), 1e-5),
        ("CS", Damped(m=0.4), 2e-2),  # acceleration is known half a step late
    ],
)
def test_a_load_at_the_port(fmu: ia.FMU, kind: str, law: Damped, tolerance: float) -> None:
    wanted = exact(law)
    assert np.abs(replayed(fmu, kind, law, {}) - wanted).max() < tolerance * np.ptp(wanted)


@pytest.mark.parametrize(("kind", "tolerance"), [("ME", 1e-4), ("CS", 1e-6)])
def test_samples_may_be_held(fmu: ia.FMU, kind: str, tolerance: float) -> None:
    held = np.repeat(FORCE[::20], 20)[: len(TIME)]
    command = {"push.f": ia.Sampled(TIME, held, interpolation="hold")}
    run = rig().simulate(float(TIME[-1]), step=TIME[1], inputs=command, rtol=1e-9)
    wanted = run["mass.s"][np.searchsorted(run.time, TIME + 1e-9, side="right") - 1]
    with Replay(fmu, kind, ["push.f"], ["mass.s"], held=["push.f"]) as replay:
        seen = replay.run(TIME, held[:, None], {})[:, 0]
    assert np.abs(seen - wanted).max() < tolerance * np.ptp(wanted)


@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_parameters_and_thinned_outputs(fmu: ia.FMU, kind: str) -> None:
    wanted = exact(Damped(d=1e-9), k=900.0)[::5]
    seen = replayed(fmu, kind, None, {"spring.k": 900.0}, every=5)
    assert np.abs(seen - wanted).max() < 1e-3 * np.ptp(wanted)


def test_an_inertia_needs_a_velocity_that_is_a_state(fmu: ia.FMU) -> None:
    load = Load("push.f", "mass.s", "spring.f", Damped(m=0.4))
    with Replay(fmu, "ME", ["push.f"], ["mass.s"]) as replay, pytest.raises(ia.FMUError, match="is no state"):
        replay.run(TIME, FORCE[:, None], {}, load=load)


@dataclass(frozen=True)
class Pulling:
    """Pulls back to zero."""

    accelerating = False

    def __call__(self, t: float, s: float, v: float, a: float) -> float:
        return -s


def test_a_replay_that_chatters_is_told(make_fmu: Callable[..., Path]) -> None:
    """The relay pulled back to where it switches has events without end, which ran for ever."""
    load = Load("u", "y", "y", Pulling())
    fmu = ia.FMU(make_fmu("relay"))
    with Replay(fmu, "ME", ["u"], ["y"]) as replay, pytest.raises(ia.FMUError, match="is chattering: 200"):
        replay.run(TIME, np.full((len(TIME), 1), 0.1), {}, load=load)
