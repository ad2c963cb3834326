"""One suite of events for both loops: in Python, `compiled`, and FMUs of either kind and version."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.networks.csource.toolchain import ToolchainError, compiler

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

Folders = Callable[[str], Path]
G = 9.81
FALL = np.sqrt(2 / G)
SOLVERS = ("cvodes", "rosenbrock", "compiled")
KINDS = [(version, kind) for version in ("2.0", "3.0") for kind in ("ME", "CS")]
COMMUNICATING = ("2.0", "CS"), ("3.0", "CS")  # of their events no instants are told
WAYS: list[Any] = [*SOLVERS, *KINDS]


def named(way: Any) -> str:
    return way if isinstance(way, str) else " ".join(way)


def fallen(*masses: float) -> ia.Network:
    """Balls that fall from 1 m onto stops that give half the speed back."""
    net = ia.Network("balls", floor=ia.Fixed())
    for k, m in enumerate(masses):
        ball, stop = ia.Mass(m=m, s=1.0), ia.HardStop(e=0.5)
        weight = ia.ConstantForce(f_constant=-m * G)
        net.add(**{f"ball{k}": ball, f"stop{k}": stop, f"weight{k}": weight})
        net.connect(net.floor.flange, stop.flange_a)
        net.connect(stop.flange_b, ball.flange, weight.flange)
    return net


def rubbing(*, push: Any = None, **start: float) -> ia.Network:
    """A mass of 1 kg that 1 N of dry friction holds."""
    force = ia.Force() if push is None else ia.Force(f=push)
    net = ia.Network(
        "rubbing", wall=ia.Fixed(), body=ia.Mass(m=1.0, **start), rub=ia.CoulombFriction(f_c=1.0), push=force
    )
    net.connect(net.wall.flange, net.rub.flange_a)
    return net.connect(net.rub.flange_b, net.body.flange, net.push.flange)


def stopped() -> ia.Network:
    net = rubbing(push=lambda t: 0.0 * t, s=0.3, v=-1.0).add(stop=ia.HardStop(e=0.5))
    return net.connect(net.wall.flange, net.stop.flange_a).connect(net.stop.flange_b, net.body.flange)


def pushed() -> ia.Network:
    net = rubbing().add(step=ia.signals.Step(height=3.0, start_time=0.3))
    return net.connect(net.step.y, net.push.f)


def held_twice() -> ia.Network:
    """A mass of 1 kg that two frictions hold, and that an inerter of 5 kg drives."""
    net = ia.Network(
        "held_twice",
        wall=ia.Fixed(),
        ramp=ia.signals.Ramp(height=1.0, duration=0.2, start_time=0.3),
        drive=ia.Speed(),
        body=ia.Mass(m=1.0),
        inerter=ia.Inerter(b=5.0),
        front=ia.CoulombFriction(f_c=0.5),
        back=ia.CoulombFriction(f_c=0.5),
    )
    net.connect(net.ramp.y, net.drive.v_ref)
    net.connect(net.drive.flange, net.inerter.flange_a, net.front.flange_a)
    net.connect(net.inerter.flange_b, net.front.flange_b, net.body.flange, net.back.flange_b)
    return net.connect(net.back.flange_a, net.wall.flange)


def relay(h: float) -> ia.Network:
    """Friction that overshoots by its hysteresis h [m/s]: it switches for ever once the mass rests."""

    class Relay(ia.Compliant):
        v_rel = ia.variable("m/s", "relative velocity")
        mode = ia.mode("forward", "backward")

        def equations(self) -> Any:
            yield self.v_rel == ia.der(self.s_rel)
            yield self.f == self.mode.choose(forward=1.0, backward=-1.0)

        def transitions(self) -> Any:
            yield self.mode.goes("forward", "backward", when=self.v_rel < -h)
            yield self.mode.goes("backward", "forward", when=self.v_rel > h)

    net = ia.Network("relay", wall=ia.Fixed(), body=ia.Mass(m=1.0, v=1.0), relay=Relay())
    return net.connect(net.wall.flange, net.relay.flange_a).connect(net.relay.flange_b, net.body.flange)


BOUNCES = FALL * np.array([1, 2, 2.5, 2.75])
STICKS, HIT = (1 - np.sqrt(0.2)) / 0.4, np.sqrt(0.4)
# What is built, until when [s], a speed, at which instants [s] something happens, with which impulses [N.s].
CASES: dict[str, tuple[Callable[[], ia.Network], float, str, Any, Any]] = {
    "bouncing ball": (lambda: fallen(2.0), 1.25, "ball0.v", BOUNCES, 3 * G * FALL * 0.5 ** np.arange(4)),
    "stick-slip": (lambda: rubbing(push=lambda t: 0.4 * t, v=1.0), 3.0, "body.v", [STICKS, 2.5], []),
    "stop with friction": (stopped, 1.0, "body.v", [1 - HIT, 1 - HIT + HIT / 2], [1.5 * HIT]),
    "time event": (pushed, 1.0, "body.v", [0.3], []),
    "held twice": (held_twice, 1.0, "body.v", [0.3, 0.5], []),
    "simultaneous events": (
        lambda: fallen(2.0, 4.0),
        1.25,
        "ball1.v",
        BOUNCES,
        np.outer(3 * G * FALL * 0.5 ** np.arange(4), [1, 2]).ravel(),
    ),
}
FLIGHT = 0.5 ** np.array([0, 1, 2, 3, 4])


def falls(t: Any) -> Any:
    k = np.searchsorted(BOUNCES, t)
    began = np.array([0.0, *BOUNCES])[k]
    return np.where(k == 0, 0.0, G * FALL * FLIGHT[k]) - G * (t - began)


SPEEDS: dict[str, Callable[[Any], Any]] = {
    "bouncing ball": falls,
    "simultaneous events": falls,
    "stick-slip": lambda t: np.where(
        t < STICKS, 1 - t + 0.2 * t**2, np.where(t < 2.5, 0, 0.2 * (t**2 - 2.5**2) - (t - 2.5))
    ),
    "stop with friction": lambda t: np.where(t < 1 - HIT, t - 1, np.maximum(0, 1 - HIT / 2 - t)),
    "time event": lambda t: 2 * np.maximum(0, t - 0.3),
    "held twice": lambda t: 5 / 6 * np.clip((t - 0.3) / 0.2, 0, 1),
}


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> Folders:
    """Return the folder of each case, so that an FMU is made once for both kinds."""
    return cache(lambda case: tmp_path_factory.mktemp(case.replace(" ", "_")))


def run(net: ia.Network, way: Any, stop: float, speed: str, folder: Path) -> Any:
    """Run a network in one of the ways, in 100 intervals."""
    if isinstance(way, str):
        return net.simulate(stop, step=stop / 100, solver=way, rtol=1e-9, atol=1e-11)
    version, kind = way
    path = folder / f"{version}.fmu"
    if not path.exists():
        ia.export_fmu(net, path, fmi_version=version, outputs=[speed])
    return ia.FMU(path).simulate(stop, step=stop / 100, kind=kind, rtol=1e-9)


def ways() -> Iterator[Any]:
    """Yield every case in every way, in FMUs of one version: their C is the same, and where it is called."""
    for number, case in enumerate(CASES):
        version = ("2.0", "3.0")[number % 2]
        yield from (pytest.param(case, way, id=f"{case}-{named(way)}") for way in SOLVERS)
        yield from (pytest.param(case, way, id=f"{case}-{named(way)}") for way in KINDS if way[0] == version)


@pytest.mark.parametrize(("case", "way"), [*ways()])
def test_the_same_happens_everywhere(case: str, way: Any, folders: Folders) -> None:
    build, stop, speed, instants, impulses = CASES[case]
    told = run(build(), way, stop, speed, folders(case))
    if isinstance(way, str):
        given = [event.impulse for event in told.events if event.impulse is not None]
        assert given == pytest.approx(impulses, rel=1e-7)
    if way not in COMMUNICATING:
        happened = np.array([event.time for event in told.events if event.time > 0])
        near = np.abs(happened[:, None] - np.asarray(instants)) < 1e-7
        assert near.any(axis=1).all()
        assert near.any(axis=0).all()
    away = np.abs(told.time[:, None] - np.asarray(instants)).min(axis=1) > 1e-6
    assert told[speed][away] == pytest.approx(SPEEDS[case](told.time[away]), abs=1e-6)


@pytest.mark.parametrize("way", WAYS, ids=named)
@pytest.mark.parametrize("h", [0.0, 1e-12])
def test_what_has_no_end_is_told_with_its_component(
    h: float, way: Any, folders: Callable[[str], Path]
) -> None:
    integrated_here = isinstance(way, str) or way in COMMUNICATING
    words = "switch for ever: " if integrated_here and h == 0.0 else r"chattering: 200 events .*, from "
    with pytest.raises(ia.InertanceError, match=rf"{words}Relay 'relay'"):
        run(relay(h), way, 3.0, "body.v", folders(f"relay {h}"))
