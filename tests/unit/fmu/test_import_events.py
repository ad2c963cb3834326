"""Events on either side of a coupling: the error falls with the square of the step across them."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pytest
from inertance import (
    FMU,
    Damper,
    Fixed,
    FMUError,
    Force,
    HardStop,
    Mass,
    Network,
    Result,
    Spring,
    SpringDamper,
    export_fmu,
    signals,
)
from inertance.fmu import Connection, CoupledRun, FMUForce, FMUMotion, SystemStructure, cosimulate

ALL = [("2.0", "ME"), ("3.0", "ME"), ("3.0", "CS")]
STEPS = (1e-2, 2.5e-3)
TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}
BALL, STRUT = "ball_flange", "strut_flange_a.motion.s_ref"
Exported = Callable[..., FMU]


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """Return a function that exports a network once for a version, with one flange as a terminal."""
    folder, made = tmp_path_factory.mktemp("events"), dict[tuple[str, str], FMU]()

    def export(network: Network, flange: str, causality: str, version: str) -> FMU:
        key = network.name, version
        if key not in made:
            path = folder / f"{network.name}-{version}.fmu"
            made[key] = FMU(export_fmu(network, path, terminals={flange: causality}, fmi_version=version))
        return made[key]

    return export


def bouncing(name: str, v: float = -1.0, e: float = 0.6) -> Network:
    net = Network(name, ball=Mass(m=1.0, s=0.2, v=v), stop=HardStop(e=e), ground=Fixed())
    net.connect(net.ground.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange)
    return net


def strut(name: str = "strut") -> Network:
    net = Network(name, strut=SpringDamper(k=400.0, d=8.0), wall=Fixed())
    net.connect(net.strut.flange_b, net.wall.flange)
    return net


def pushed(net: Network, t: float) -> Network:
    """Add a force that steps at t."""
    net.add(push=Force(), step=signals.Step(height=30.0, start_time=t))
    net.connect(net.step.y, net.push.f)
    return net


def motion(fmu: FMU, kind: str) -> FMUMotion:
    return FMUMotion(
        fmu, kind=kind, force=f"{BALL}.force.f", position=f"{BALL}.position.s", velocity=f"{BALL}.speed.v"
    )


def force(fmu: FMU, kind: str) -> FMUForce:
    return FMUForce(
        fmu, kind=kind, position=STRUT, velocity=f"der({STRUT})", force="-strut_flange_a.sensor.f"
    )


def errors(whole: Result, split: Callable[[float], Any], name: str, of: str = "") -> list[float]:
    found = []
    for step in STEPS:
        run = split(step)
        found.append(float(np.abs(np.interp(run.time, whole.time, whole[name]) - run[of or name]).max()))
    return found


def second_order(found: list[float], most: float) -> None:
    assert found[-1] < most
    assert 11 < found[0] / found[-1] < 30, found  # 4 with order 1, 16 with order 2


def whole_run(net: Network, stop: float) -> Result:
    return net.simulate(stop, step=1e-4, rtol=1e-10, atol=1e-12)


def hung(ball: Mass | FMUMotion, net: Network) -> Network:
    """Hang a mass on a wall and the ball on the mass."""
    net.add(link=SpringDamper(k=200.0, d=5.0), mass=Mass(m=0.5, s=0.2), hook=Spring(k=100.0), wall=Fixed())
    net.connect(ball.flange, net.link.flange_a)
    net.connect(net.link.flange_b, net.mass.flange, net.hook.flange_a)
    net.connect(net.hook.flange_b, net.wall.flange)
    return net


def of_ball(exported: Exported, version: str, kind: str) -> Callable[[float], CoupledRun]:
    def split(step: float) -> CoupledRun:
        net = Network(
            "split", ball=motion(exported(bouncing("ball"), "ball.flange", "force-in", version), kind)
        )
        return cosimulate(hung(net.ball, net), 0.5, communication_step=step, halving=False, **TIGHT)

    return split


@pytest.mark.parametrize(("version", "kind"), ALL)
def test_an_impact_inside_an_fmu(exported: Exported, version: str, kind: str) -> None:
    whole = bouncing("whole")
    run = whole_run(hung(whole.ball, whole), 0.5)
    second_order(errors(run, of_ball(exported, version, kind), "mass.s"), 6e-5)
    (event,) = [e for e in of_ball(exported, version, kind)(5e-3).events if e.time > 0]
    assert event.time == pytest.approx(run.events[0].time, abs=1e-4)


@pytest.mark.parametrize(("version", "kind"), [*ALL, ("2.0", "CS")])
def test_impacts_in_the_network_around_an_fmu(exported: Exported, version: str, kind: str) -> None:
    whole = bouncing("whole", v=-2.0)
    whole.add(strut=SpringDamper(k=400.0, d=8.0), wall=Fixed())
    whole.connect(whole.strut.flange_b, whole.wall.flange)
    whole.connect(whole.strut.flange_a, whole.ball.flange)

    def split(step: float) -> CoupledRun:
        net = bouncing("split", v=-2.0)
        net.add(fmu=force(exported(strut(), "strut.flange_a", "motion-in", version), kind), wall=Fixed())
        net.connect(net.wall.flange, net.fmu.flange_a)
        net.connect(net.fmu.flange_b, net.ball.flange)
        return cosimulate(net, 0.5, communication_step=step, halving=False, **TIGHT)

    run = whole_run(whole, 0.5)
    assert len(run.events) == 3
    second_order(errors(run, split, "ball.s"), 6e-5)


@pytest.mark.parametrize(("version", "kind"), ALL)
def test_impacts_on_both_sides_at_the_same_instant(exported: Exported, version: str, kind: str) -> None:
    def joined(net: Network) -> Network:
        net.add(mass=Mass(m=1.0, s=0.2, v=-1.0), floor=HardStop(e=0.3), base=Fixed())
        net.add(link=SpringDamper(k=200.0, d=5.0))
        net.connect(net.base.flange, net.floor.flange_a)
        net.connect(net.floor.flange_b, net.mass.flange, net.link.flange_b)
        net.connect(net.ball.flange, net.link.flange_a)
        return net

    def split(step: float) -> CoupledRun:
        net = Network(
            "split", ball=motion(exported(bouncing("ball"), "ball.flange", "force-in", version), kind)
        )
        return cosimulate(joined(net), 0.5, communication_step=step, halving=False, **TIGHT)

    run = whole_run(joined(bouncing("whole")), 0.5)
    assert len({event.time for event in run.events}) == 1 < len(run.events)
    second_order(errors(run, split, "mass.s"), 2e-5)


@pytest.mark.parametrize(("version", "kind"), [*ALL, ("2.0", "CS")])
@pytest.mark.parametrize("t", [0.1, 0.1033], ids=["at a communication point", "during a step"])
def test_a_force_that_steps_in_the_network(exported: Exported, version: str, kind: str, t: float) -> None:
    whole = pushed(strut("whole"), t)
    whole.add(ball=Mass(m=1.0))
    whole.connect(whole.strut.flange_a, whole.ball.flange, whole.push.flange)

    def split(step: float) -> CoupledRun:
        plain = exported(Network("plain", ball=Mass(m=1.0)), "ball.flange", "force-in", version)
        net = pushed(strut("split"), t)
        net.add(ball=motion(plain, kind))
        net.connect(net.strut.flange_a, net.ball.flange, net.push.flange)
        return cosimulate(net, 0.5, communication_step=step, halving=False, **TIGHT)

    second_order(errors(whole_run(whole, 0.5), split, "ball.s"), 5e-5)


@pytest.mark.parametrize(("version", "kind"), ALL)
@pytest.mark.parametrize("t", [0.1, 0.1033], ids=["at a communication point", "during a step"])
def test_a_force_that_steps_in_an_fmu(exported: Exported, version: str, kind: str, t: float) -> None:
    def stepping(name: str) -> Network:
        net = pushed(strut(name), t)
        net.connect(net.strut.flange_a, net.push.flange)
        return net

    whole = stepping("whole")
    whole.add(ball=Mass(m=1.0))
    whole.connect(whole.strut.flange_a, whole.ball.flange)

    def split(step: float) -> CoupledRun:
        fmu = exported(stepping(f"stepping{t}"), "strut.flange_a", "motion-in", version)
        net = Network("split", fmu=force(fmu, kind), wall=Fixed(), ball=Mass(m=1.0))
        net.connect(net.wall.flange, net.fmu.flange_a)
        net.connect(net.fmu.flange_b, net.ball.flange)
        return cosimulate(net, 0.5, communication_step=step, halving=False, **TIGHT)

    second_order(errors(whole_run(whole, 0.5), split, "ball.s"), 3e-5)


@pytest.mark.parametrize(("version", "kind"), ALL)
def test_an_impact_inside_a_system_of_fmus(exported: Exported, version: str, kind: str) -> None:
    whole = bouncing("whole")
    rest = Network("rest", link=SpringDamper(k=200.0, d=5.0), mass=Mass(m=0.5, s=0.2), hook=Spring(k=100.0))
    rest.add(wall=Fixed())
    rest.connect(rest.link.flange_b, rest.mass.flange, rest.hook.flange_a)
    rest.connect(rest.hook.flange_b, rest.wall.flange)
    s, f = "link_flange_a.motion.s_ref", "link_flange_a.sensor.f"
    system = SystemStructure(
        "system",
        {
            "a": exported(bouncing("ball"), "ball.flange", "force-in", version),
            "b": exported(rest, "link.flange_a", "motion-in", version),
        },
        [
            Connection(f"a.{BALL}.position.s", f"b.{s}"),
            Connection(f"a.{BALL}.speed.v", f"b.der({s})"),
            Connection(f"b.{f}", f"a.{BALL}.force.f"),
        ],
    )
    run = whole_run(hung(whole.ball, whole), 0.5)

    def split(step: float) -> Any:
        return system.simulate(0.5, communication_step=step, kind=kind, halving=False, rtol=1e-9)

    second_order(errors(run, split, "mass.s", "b.mass.s"), 2e-4)


def test_signals_have_two_points_at_an_event(exported: Exported) -> None:
    run = of_ball(exported, "2.0", "ME")(1e-2)
    place = int(np.flatnonzero(np.diff(run.time) == 0)[0])
    before, after = run["link.f"][place : place + 2]
    jump = run.fmus["ball"][f"{BALL}.speed.v"]
    jump = jump[np.flatnonzero(np.diff(run.fmus["ball"].time) == 0)[0] :][:2]
    assert before - after == pytest.approx(5.0 * (jump[1] - jump[0]), rel=1e-6)


def test_a_stop_between_network_and_fmu_is_refused(exported: Exported) -> None:
    """The FMU would not be told of the impulse: 1 kg m/s was lost without a word."""
    plain = exported(Network("plain", ball=Mass(m=1.0)), "ball.flange", "force-in", "2.0")
    net = Network("struck", ball=motion(plain, "ME"), stop=HardStop(), mass=Mass(m=1.0, s=0.2, v=-1.0))
    net.connect(net.ball.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.mass.flange)
    with pytest.raises(FMUError, match=r"impulse of HardStop 'stop' at t = 0\.2 s .*'ball'.*put a spring"):
        cosimulate(net, 0.5, communication_step=1e-2)


def test_inertia_that_an_impact_inside_an_fmu_would_move_is_refused(exported: Exported) -> None:
    ball = motion(exported(bouncing("ball"), "ball.flange", "force-in", "2.0"), "ME")
    net = Network("loaded", ball=ball, more=Mass(m=0.1), damper=Damper(d=1.0), wall=Fixed())
    net.connect(net.ball.flange, net.more.flange, net.damper.flange_a)
    net.connect(net.damper.flange_b, net.wall.flange)
    with pytest.raises(FMUError, match=r"velocity of 'ball\.s' jump by 1\.\d+ m/s .* 0\.1 kg .*put a spring"):
        cosimulate(net, 0.5, communication_step=1e-2)


def of_one_step_size(fmu: FMU, folder: Path) -> FMU:
    rigid = folder / "rigid.fmu"
    flexible = b'canHandleVariableCommunicationStepSize="true"'
    with zipfile.ZipFile(fmu.path) as archive, zipfile.ZipFile(rigid, "w") as copy:
        for name in archive.namelist():
            copy.writestr(name, archive.read(name).replace(flexible, flexible.replace(b"true", b"false")))
    return FMU(rigid)


def test_an_fmu_of_one_step_size_goes_on_after_its_own_event(exported: Exported, tmp_path: Path) -> None:
    """The rest of the step that it ended itself was refused, as if another had ended it."""
    ball = exported(bouncing("ball"), "ball.flange", "force-in", "3.0")
    net = Network("split", ball=motion(of_one_step_size(ball, tmp_path), "CS"))
    run = cosimulate(hung(net.ball, net), 0.5, communication_step=2.5e-3, halving=False, **TIGHT)
    whole = bouncing("whole")
    wanted = whole_run(hung(whole.ball, whole), 0.5)
    assert any(event.time > 0 for event in run.events)
    assert np.abs(np.interp(run.time, wanted.time, wanted["mass.s"]) - run["mass.s"]).max() < 6e-5


def test_a_network_s_events_that_a_step_cannot_end_at_are_told(exported: Exported, tmp_path: Path) -> None:
    plain = exported(Network("plain", ball=Mass(m=1.0)), "ball.flange", "force-in", "2.0")
    net = pushed(strut("split"), 0.1033)
    net.add(ball=motion(of_one_step_size(plain, tmp_path), "CS"))
    net.connect(net.strut.flange_a, net.ball.flange, net.push.flange)
    run = cosimulate(net, 0.5, communication_step=1e-2, halving=False)
    assert "0.1033 s, do not end a communication step" in run.notes[0]
    assert run.stats["communication steps"] == 50


@pytest.mark.parametrize(("version", "kind"), [("2.0", "ME"), ("2.0", "CS"), ("3.0", "CS")])
@pytest.mark.parametrize("t", [0.1, 0.1033], ids=["at a communication point", "during a step"])
def test_an_input_of_the_network_that_jumps(exported: Exported, version: str, kind: str, t: float) -> None:
    def jumping(time: Any) -> Any:
        return ca.if_else(time < t, 0.0, 30.0)

    def joined(name: str, **ball: Mass | FMUMotion) -> Network:
        net = strut(name)
        net.add(push=Force(), **ball)
        net.connect(net.strut.flange_a, net.ball.flange, net.push.flange)
        return net

    def split(step: float) -> CoupledRun:
        plain = exported(Network("plain", ball=Mass(m=1.0)), "ball.flange", "force-in", version)
        net, inputs = joined("split", ball=motion(plain, kind)), {"push.f": jumping}
        return cosimulate(net, 0.5, communication_step=step, halving=False, inputs=inputs, **TIGHT)

    whole = joined("whole", ball=Mass(m=1.0))
    run = whole.simulate(0.5, step=1e-4, rtol=1e-10, atol=1e-12, inputs={"push.f": jumping})
    second_order(errors(run, split, "ball.s"), 5e-5)


def test_a_shock_that_an_fmu_s_inertia_would_take_part_in_is_refused(
    make_fmu: Callable[..., Path],
) -> None:
    net = bouncing("struck")
    net.add(fmu=FMUForce(make_fmu("relay"), acceleration="u", force="y"), wall=Fixed())
    net.connect(net.wall.flange, net.fmu.flange_a)
    net.connect(net.fmu.flange_b, net.ball.flange)
    with pytest.raises(FMUError, match=r"impulse of HardStop 'stop' .* acts on the FMU 'fmu'"):
        cosimulate(net, 0.5, communication_step=1e-2, halving=False)
