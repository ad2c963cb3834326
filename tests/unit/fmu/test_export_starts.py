"""Where FMUs start: as the native run does, whatever parameters, starts and start time they are given."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.validation import validate_fmu

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
KINDS = ("ModelExchange", "CoSimulation")
VERSIONS = ("2.0", "3.0")
S = ia.signals
SOURCES: dict[str, Any] = {
    "pulse": S.Pulse(period=0.5, width=0.3),
    "trapezoid": S.Trapezoid(rising=0.05, width=0.1, falling=0.07, period=0.4),
    "step": S.Step(),
    "ramp": S.Ramp(duration=0.3),
    "late": S.Sine(f=1.3, start_time=0.25),
    "sine": S.Sine(f=0.7),
    "table": S.TimeTable(table=((-0.5, 1.0), (0, 1.0), (0, 0.5), (0.4, 0.2), (0.6, 0.2), (0.6, 1.0))),
    "constant": S.Constant(k=0.4),
    "clock": S.Clock(),
}
MOVABLE = ("pulse", "trapezoid", "step", "ramp")


def driven(sources: list[str]) -> ia.Network:
    """Each of some sources of signals pushes a mass on a damper."""
    net = ia.Network("sources", wall=ia.Fixed())
    for name in sources:
        source = SOURCES[name].clone()
        force, mass, damper = ia.Force(), ia.Mass(m=1.0), ia.Damper(d=2.0)
        net.add(**{name: source, f"force_{name}": force, f"mass_{name}": mass, f"damper_{name}": damper})
        net.connect(net.wall.flange, damper.flange_a)
        net.connect(damper.flange_b, mass.flange, force.flange)
        net.connect(source.y, force.f)
    return net


def stopped() -> ia.Network:
    """A ball above a stop, a train of two masses with a stop between them, one that sticks on a belt."""
    net = ia.Network(
        "stops",
        floor=ia.Fixed(s0=0.05),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
        first=ia.Mass(m=1.0, v=0.5),
        between=ia.HardStop(e=0.4),
        second=ia.Mass(m=2.0, s=0.1),
        belt=ia.Speed(v_ref=0.3),
        rub=ia.CoulombFriction(f_c=3.0),
        block=ia.Mass(m=1.0, s=0.2),
        spring=ia.Spring(k=50.0, s_rel0=0.1),
    )
    net.connect(net.floor.flange, net.stop.flange_a, net.spring.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)
    net.connect(net.first.flange, net.between.flange_a)
    net.connect(net.between.flange_b, net.second.flange)
    net.connect(net.belt.flange, net.rub.flange_a)
    return net.connect(net.rub.flange_b, net.block.flange, net.spring.flange_b)


def differences(
    native: ia.Result, run: Any, names: list[str], skipped: float = 1e-4
) -> dict[str, tuple[float, float]]:
    """Return by how much variables differ where no event is near, and when most."""
    events = np.array([native.time[0] - 1, native.time[-1], *(e.time for e in native.events)])
    times = run["time"]
    apart = np.abs(times[:, None] - events).min(axis=1) > skipped
    found = {}
    for name in names:
        wanted = np.interp(times[apart], native.time, native[name])
        error = np.abs(run[name][apart] - wanted)
        found[name] = float(error.max()), float(times[apart][error.argmax()])
    return found


def run_of(path: Path, kind: str, begin: float, stop: float, given: Mapping[str, float]) -> Any:
    return fmpy.simulate_fmu(
        str(path), fmi_type=kind, start_time=begin, stop_time=stop, output_interval=0.01,
        start_values=dict(given), relative_tolerance=1e-8,
    )  # fmt: skip


def exported(
    net: ia.Network, names: list[str], folder: Path, versions: Sequence[str] = VERSIONS
) -> tuple[Any, list[Path]]:
    dae = net.dae()
    paths = [
        ia.export_fmu(dae, folder / f"{net.name}{v[0]}.fmu", fmi_version=v, outputs=names) for v in versions
    ]
    assert [validate_fmu(str(path)) for path in paths] == [[] for _ in versions]
    return dae, paths


@pytest.mark.parametrize(("version", "half"), [("2.0", 0), ("3.0", 1)])
def test_every_source_runs_as_natively_whenever_it_and_the_run_begin(
    version: str, half: int, tmp_path: Path
) -> None:
    sources = [*SOURCES][half::2]
    names = [f"{part}{name}{what}" for name in sources for part, what in (("", ".y"), ("mass_", ".s"))]
    dae, paths = exported(driven(sources), names, tmp_path, [version])
    random = np.random.default_rng(14)
    for begin in (0.0, 0.0, 0.0, 5.0, -0.7, 0.37):
        given = {
            f"{name}.start_time": float(random.choice([-0.35, 0.0, 0.2, begin, random.uniform(-1, 2)]))
            for name in MOVABLE
            if name in sources
        }
        native = ia.simulate(dae, begin + 2, begin=begin, step=1e-3, parameters=given, rtol=1e-9, atol=1e-11)
        for path in paths:
            for kind in KINDS:
                run = run_of(path, kind, begin, begin + 2, given)
                off = differences(native, run, names)
                assert {n: e for n, e in off.items() if e[0] > 1e-5} == {}, (path.name, kind, begin, given)


@pytest.mark.parametrize("start", [-0.2, 0.0])
def test_a_first_period_that_has_begun_is_not_lost(start: float, tmp_path: Path) -> None:
    """The states after the events of t = 0 stood beside the modes from before: the first pulse was lost."""
    net = ia.Network(
        "late", mass=ia.Mass(m=1.0), force=ia.Force(), pulse=S.Pulse(period=1.0, width=0.7, start_time=start)
    )
    net.connect(net.mass.flange, net.force.flange)
    net.connect(net.pulse.y, net.force.f)
    dae, paths = exported(net, ["mass.v", "pulse.y"], tmp_path)
    native = ia.simulate(dae, 2.0, rtol=1e-9, atol=1e-11)
    for path in paths:
        for kind in KINDS:
            run = run_of(path, kind, 0.0, 2.0, {})
            assert run["mass.v"][-1] == pytest.approx(native["mass.v"][-1], abs=1e-6), (path.name, kind)
            assert run["pulse.y"][1] == 1.0


def test_starts_follow_from_parameters_and_from_starts_that_are_set(tmp_path: Path) -> None:
    names = ["ball.s", "ball.v", "first.s", "first.v", "second.s", "second.v", "block.s", "block.v", "rub.f"]
    dae, paths = exported(stopped(), names, tmp_path)
    random = np.random.default_rng(5)
    parameters = {
        "floor.s0": (0.0, 0.4),
        "stop.e": (0.1, 0.9),
        "spring.s_rel0": (0.0, 0.2),
        "rub.f_c": (1.0, 9.0),
    }
    starts = {"ball.s": (0.5, 2.0), "ball.v": (-1, 1), "first.v": (0.1, 1), "second.s": (0.05, 0.3),
              "block.s": (0, 0.4), "block.v": (-0.5, 0.5)}  # fmt: skip
    settable = {v.name for v in fmpy.read_model_description(str(paths[0])).modelVariables if v.start}
    for number in range(6):
        changed = {
            n: float(random.uniform(*r)) for n, r in parameters.items() if number and random.random() < 0.7
        }
        begun = {n: float(random.uniform(*r)) for n, r in starts.items() if number and random.random() < 0.6}
        assert settable >= {*changed, *begun}
        native = ia.simulate(dae, 0.8, step=1e-3, start=begun, parameters=changed, rtol=1e-9, atol=1e-11)
        for path in paths:
            for kind in KINDS:
                run = run_of(path, kind, 0.0, 0.8, changed | begun)
                for name in names[:-1]:
                    assert run[name][0] == pytest.approx(native[name][0], abs=1e-9), (number, kind, name)
                off = differences(native, run, names)
                wrong = {n: e for n, e in off.items() if e[0] > 1e-4}
                assert wrong == {}, (number, path.name, kind, changed, begun)
