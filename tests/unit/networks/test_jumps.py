"""Jumps and kinks of prescribed motions: every solver gives what ever shorter ramps give, or refuses."""

from functools import cache
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import (
    Backlash,
    Component,
    ConstantForce,
    CoulombFriction,
    Damper,
    Fixed,
    HardStop,
    Inerter,
    Mass,
    Network,
    Polynomial,
    Position,
    QuadraticDamper,
    Sampled,
    Speed,
    Spring,
    Stepwise,
    TranslationalFlange,
    Variations,
    rotational,
    signals,
)

SOLVERS = ("auto", "idas", "rosenbrock", "compiled")
TWO = ("auto", "compiled")
LATER = 0.4  # s, when things jump


def driven(drive: Component, source: Component | None, *chain: Component) -> Network:
    """A drive that follows a source, and two-terminal elements in a row with a mass at the end."""
    net = Network("driven", drive=drive)
    if source is not None:
        net.add(source=source)
        reference = net.drive.v_ref if isinstance(drive, Speed) else net.drive.s_ref
        net.connect(net.source.y, reference)
    end = net.drive.flange
    for number, element in enumerate(chain):
        name = "mass" if isinstance(element, Mass) else f"element{number}"
        net.add(**{name: element})
        placed = getattr(net, name)
        net.connect(end, placed.flange if isinstance(element, Mass) else placed.flange_a)
        end = placed.flange if isinstance(element, Mass) else placed.flange_b
    return net


def step(height: float = 1.0) -> Component:
    return signals.Step(height=height, start_time=LATER)


def ramp(height: float = 1.0, duration: float = 1e-6) -> Component:
    return signals.Ramp(height=height, duration=duration, start_time=LATER)


def pushes(run: ia.Result) -> list[tuple[str, Any]]:
    return [(event.mode, event.impulse) for event in run.events if event.impulse is not None]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_speed_that_steps_drags_a_mass_along_through_an_inerter(solver: str) -> None:
    run = driven(Speed(), step(), Inerter(b=50.0), Mass(m=100.0)).simulate(1.0, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(1 / 3, rel=1e-9)
    assert pushes(run) == [("drive.v_ref", pytest.approx(100 / 3))]
    shorter = driven(Speed(), ramp(duration=1e-5), Inerter(b=50.0), Mass(m=100.0)).simulate(1.0)
    assert run["mass.v"][-1] == pytest.approx(shorter["mass.v"][-1], rel=1e-6)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_position_that_begins_to_move_is_a_speed_that_steps(solver: str) -> None:
    net = driven(Position(), ramp(0.6, 0.6), Inerter(b=50.0), Mass(m=100.0))
    run = net.simulate(1.2, solver=solver)
    assert run.at("mass.v", 0.8) == pytest.approx(1 / 3, rel=1e-6)
    assert run["mass.v"][-1] == pytest.approx(0, abs=1e-9)
    assert pushes(run) == [("drive.s_ref", pytest.approx(s * 100 / 3)) for s in (1, -1)]


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("elements", [(Damper(d=1000.0),), (Spring(k=10.0), Damper(d=1000.0))])
def test_a_position_that_steps_pushes_through_a_damper(solver: str, elements: Any) -> None:
    mass = Mass(m=100.0)
    net = driven(Position(), step(0.1), elements[-1], mass)
    if len(elements) > 1:
        net.add(beside=elements[0])
        net.connect(net.drive.flange, net.beside.flange_a)
        net.connect(net.beside.flange_b, net.mass.flange)
    run = net.simulate(LATER + 0.1, solver=solver, rtol=1e-8, atol=1e-10)
    assert run.peak("mass.v") == pytest.approx(1.0, rel=1e-6)
    assert pushes(run) == [("drive.s_ref", pytest.approx(100.0))]


@pytest.mark.parametrize("solver", TWO)
def test_a_ring_that_jumps_turns_sun_and_carrier_as_their_inertias_say(solver: str) -> None:
    def gearbox(source: Component) -> Network:
        net = Network(
            "gearbox", drive=rotational.Speed(), source=source, gear=rotational.IdealPlanetary(ratio=2.0),
            sun=rotational.Inertia(J=2.0), carrier=rotational.Inertia(J=2.0),
        )  # fmt: skip
        net.connect(net.source.y, net.drive.w_ref)
        net.connect(net.drive.flange, net.gear.ring)
        net.connect(net.gear.sun, net.sun.flange)
        net.connect(net.gear.carrier, net.carrier.flange)
        return net

    run = gearbox(step()).simulate(1.0, solver=solver)
    shorter = gearbox(ramp(duration=1e-5)).simulate(1.0)
    for name, speed in (("sun.w", -0.2), ("carrier.w", 0.6)):
        assert run[name][-1] == pytest.approx(speed, rel=1e-9)
        assert shorter[name][-1] == pytest.approx(speed, rel=1e-6)


JUMPING: dict[str, Any] = {
    "if_else": lambda t: ca.if_else(t < LATER, 0, 1),
    "comparison": lambda t: t >= LATER,
    "floor": lambda t: ca.floor(t / LATER),
}


@pytest.mark.parametrize("solver", TWO)
@pytest.mark.parametrize("course", JUMPING)
def test_functions_of_time_jump_too(solver: str, course: str) -> None:
    net = driven(Speed(), None, Inerter(b=50.0), Mass(m=100.0))
    run = net.simulate(0.7, inputs={"drive.v_ref": JUMPING[course]}, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(1 / 3, rel=1e-9)
    assert pushes(run) == [("drive.v_ref", pytest.approx(100 / 3))]


BENT: dict[str, Any] = {
    "if_else": lambda t: ca.if_else(t < LATER, 0, t - LATER),
    "fmax": lambda t: ca.fmax(0, t - LATER),
    "fabs": lambda t: 0.5 * (ca.fabs(t - LATER) + t - LATER),
}


@pytest.mark.parametrize("solver", TWO)
@pytest.mark.parametrize("course", BENT)
def test_functions_of_time_bend_too_though_their_second_derivative_is_zero(solver: str, course: str) -> None:
    net = driven(Position(), None, Inerter(b=50.0), Mass(m=100.0))
    run = net.simulate(0.7, inputs={"drive.s_ref": BENT[course]}, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(1 / 3, rel=1e-9)


@pytest.mark.parametrize("solver", TWO)
def test_data_that_begin_or_end_in_motion_and_are_held_bend(solver: str) -> None:
    time = np.linspace(LATER, 0.6, 21)
    data = Sampled(time, time - LATER, extrapolation="hold")
    net = driven(Position(s_ref=data), None, Inerter(b=50.0), Mass(m=100.0))
    run = net.simulate(0.8, solver=solver)
    assert run.at("mass.v", 0.5) == pytest.approx(1 / 3, rel=1e-6)
    assert run["mass.v"][-1] == pytest.approx(0, abs=1e-7)


class Kicked(Component):
    """A motion of time itself."""

    flange = TranslationalFlange("what is moved")

    def equations(self) -> Any:
        yield self.flange.s == ca.if_else(self.time > LATER, self.time - LATER, 0)


@pytest.mark.parametrize("solver", TWO)
def test_elements_of_ones_own_may_jump(solver: str) -> None:
    net = Network("own", own=Kicked(), inerter=Inerter(b=50.0), mass=Mass(m=100.0))
    net.connect(net.own.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange)
    run = net.simulate(0.6, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(1 / 3, rel=1e-9)
    assert [event.mode for event in run.events] == ["jump"]


SOURCES: dict[str, Any] = {
    "pulse": (
        signals.Pulse(period=0.2, start_time=0.1),
        lambda d: signals.Trapezoid(period=0.2, start_time=0.1, rising=d, width=0.1 - d, falling=d),
    ),
    "trapezoid": (
        signals.Trapezoid(period=0.2, start_time=0.1, rising=0, width=0.05, falling=0.02),
        lambda d: signals.Trapezoid(period=0.2, start_time=0.1, rising=d, width=0.05 - d, falling=0.02),
    ),
    "table": (
        signals.TimeTable(table=((0, 0), (0.2, 0), (0.2, 1), (0.3, 2), (0.3, -1), (0.5, -1))),
        lambda d: signals.TimeTable(
            table=((0, 0), (0.2, 0), (0.2 + d, 1), (0.3, 2), (0.3 + d, -1), (0.5, -1))
        ),
    ),
    "sine": (
        signals.Sine(f=1.0, phase=1.0, start_time=0.2),
        lambda d: signals.TimeTable(
            table=(
                (0.2, 0),
                *((t, np.sin(2 * np.pi * (t - 0.2) + 1)) for t in 0.2 + d + np.arange(301) / 750),
            )
        ),
    ),
}


def damped(source: Component) -> Network:
    made = driven(Speed(), source, Inerter(b=2.0), Mass(m=1.0))
    made.add(damper=Damper(d=2.0), wall=Fixed())
    made.connect(made.mass.flange, made.damper.flange_a)
    return made.connect(made.damper.flange_b, made.wall.flange)


@cache
def ramped(kind: str) -> ia.Result:
    """Return a run with very short ramps instead of jumps."""
    return damped(SOURCES[kind][1](1e-6)).simulate(0.55, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("solver", TWO)
@pytest.mark.parametrize("kind", SOURCES)
def test_every_source_keeps_its_impulse(kind: str, solver: str) -> None:
    run = damped(SOURCES[kind][0]).simulate(0.55, solver=solver, rtol=1e-8, atol=1e-10)
    shorter = ramped(kind)
    assert run["mass.v"][-1] == pytest.approx(shorter["mass.v"][-1], rel=1e-4)
    assert run["mass.s"][-1] == pytest.approx(shorter["mass.s"][-1], rel=1e-4)


def test_signals_between_source_and_motion_bend_a_jump() -> None:
    net = Network(
        "limited", drive=Speed(), step=step(3.0), gain=signals.Gain(k=2.0), lag=signals.FirstOrder(T=0.05),
        limit=signals.Limiter(y_max=0.5, y_min=-0.5), inerter=Inerter(b=50.0), mass=Mass(m=100.0),
    )  # fmt: skip
    net.connect(net.step.y, net.gain.u)
    net.connect(net.gain.y, net.limit.u)
    net.connect(net.limit.y, net.drive.v_ref)
    net.connect(net.drive.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange)
    net.connect(net.step.y, net.lag.u)
    run = net.simulate(1.0)
    assert run["mass.v"][-1] == pytest.approx(0.5 / 3, rel=1e-9)


def pressed(height: float, e: float) -> Network:
    """A body that an inerter drags, pressed against another one."""
    net = driven(Speed(), step(height), Inerter(b=2.0), Mass(m=1.0, s=0.0, v=0.0))
    net.add(stop=HardStop(e=e), other=Mass(m=3.0, s=0.0, v=0.0))
    net.add(load=ConstantForce(f_constant=5.0), back=ConstantForce(f_constant=-5.0))
    net.connect(net.mass.flange, net.stop.flange_a, net.load.flange)
    net.connect(net.stop.flange_b, net.other.flange, net.back.flange)
    return net


@pytest.mark.parametrize("e", [0.0, 0.5])
@pytest.mark.parametrize("solver", TWO)
def test_a_contact_that_holds_passes_a_shock_on_and_does_not_rebound(solver: str, e: float) -> None:
    run = pressed(1.0, e).simulate(0.6, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(1 / 3)
    assert run["other.v"][-1] == pytest.approx(1 / 3)
    assert pushes(run) == [("drive.v_ref", pytest.approx(4 / 3)), ("stop.mode", pytest.approx(1.0))]


@pytest.mark.parametrize("solver", TWO)
def test_a_contact_that_a_shock_pulls_apart_opens(solver: str) -> None:
    run = pressed(-1.0, 0.0).simulate(LATER + 1e-3, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(-2 / 3 + 5e-3 / 3)
    assert run["other.v"][-1] == pytest.approx(-5e-3 / 3)
    assert run["stop.mode"][-1] == 0


@pytest.mark.parametrize("solver", TWO)
@pytest.mark.parametrize("height", [1.0, -1.0])
def test_friction_that_sticks_slips_in_a_shock_and_takes_no_impulse(solver: str, height: float) -> None:
    net = driven(Speed(), step(height), Inerter(b=2.0), Mass(m=1.0))
    net.add(friction=CoulombFriction(f_c=50.0), wall=Fixed())
    net.connect(net.mass.flange, net.friction.flange_b)
    net.connect(net.friction.flange_a, net.wall.flange)
    run = net.simulate(LATER + 0.01, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(height * (2 / 3 - 50 / 3 * 0.01))
    assert pushes(run) == [("drive.v_ref", pytest.approx(2 / 3 * height))]


@pytest.mark.parametrize("solver", TWO)
def test_a_gap_that_a_jump_closes_pushes_for_the_rest_of_it(solver: str) -> None:
    net = driven(Position(), step(1.0), Backlash(k=1e3, d=20.0, eps=0.3), Mass(m=1.0))
    run = net.simulate(LATER + 1e-9, solver=solver)
    assert run["mass.v"][-1] == pytest.approx(20.0, rel=1e-6)


REFUSED: dict[str, tuple[Any, str]] = {
    "inertia": (lambda: driven(Position(), step(0.1), Inerter(b=50.0), Mass(m=100.0)), r"by 0\.1"),
    "mass": (lambda: driven(Position(), step(0.1), Mass(m=100.0)), r"by 0\.1"),
    "drag": (lambda: driven(Position(), step(0.1), QuadraticDamper(c=5.0), Mass(m=1.0)), r"by 0\.1"),
    "stop": (lambda: driven(Position(), step(1.0), HardStop(s_min=0.5), Mass(m=1.0, s=1.0)), "HardStop"),
    "contact": (
        lambda: driven(Position(), step(0.1), HardStop(), Mass(m=1.0, s=0.0, v=0.0)),
        "HardStop",
    ),
}


@pytest.mark.parametrize("solver", TWO)
@pytest.mark.parametrize("case", REFUSED)
def test_what_takes_infinite_forces_is_refused_with_time_size_and_remedy(case: str, solver: str) -> None:
    make, told = REFUSED[case]
    with pytest.raises(ia.SimulationError, match=told) as caught:
        make().simulate(0.6, solver=solver)
    assert f"t = {LATER:g} s" in str(caught.value)
    assert "ramp" in str(caught.value)


@pytest.mark.parametrize("solver", TWO)
def test_a_shock_through_losses_that_depend_on_its_own_torque_is_refused(solver: str) -> None:
    net = Network(
        "lossy", drive=rotational.Speed(), step=step(), inerter=rotational.Inerter(J=0.5),
        near=rotational.Inertia(J=0.3), far=rotational.Inertia(J=1.0),
        gear=rotational.LossyGear(ratio=2.0, lossTable=((0.0, 0.9, 0.8, 0.0, 0.0),)),
    )  # fmt: skip
    net.connect(net.step.y, net.drive.w_ref)
    net.connect(net.drive.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.near.flange, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.far.flange)
    with pytest.raises(ia.SimulationError, match=r"gear.*ramp"):
        net.simulate(0.6, solver=solver)


def test_a_position_may_step_where_a_spring_yields() -> None:
    run = driven(Position(), step(0.1), Spring(k=100.0), Mass(m=1.0)).simulate(LATER + np.pi / 10)
    assert run["mass.s"][-1] == pytest.approx(0.2, rel=1e-5)
    assert not pushes(run)


@pytest.mark.parametrize("solver", TWO)
def test_a_motion_that_pushes_by_its_derivatives_leaves_another_that_is_only_watched_alone(
    solver: str,
) -> None:
    """The acceleration across the spring is seen, and nothing answers to it; the far mass is moved."""
    net = driven(Position(), None, Spring(k=100.0), Mass(m=1.0))
    net.add(seen=ia.RelativeAccelerationSensor(), shaker=Position(), table=Mass(m=3.0))
    net.connect(net.drive.flange, net.seen.flange_a).connect(net.seen.flange_b, net.mass.flange)
    net.connect(net.shaker.flange, net.table.flange)
    moved = {"drive.s_ref": np.sin, "shaker.s_ref": np.sin}
    run = net.simulate(1.0, inputs=moved, solver=solver, rtol=1e-8, atol=1e-10)
    t = run.time
    assert run["table.a"] == pytest.approx(-np.sin(t), abs=1e-6)
    rest = (100 * np.sin(t) - 10 * np.sin(10 * t)) / 99
    assert run["mass.s"] == pytest.approx(rest, abs=1e-5)


@pytest.mark.parametrize("solver", TWO)
def test_what_jumps_in_the_first_instant_is_a_shock(solver: str) -> None:
    for drive, source in ((Speed(), signals.Step()), (Position(), signals.Ramp(duration=2.0, height=2.0))):
        net = driven(drive, source, Inerter(b=50.0), Mass(m=100.0))
        run = net.simulate(1.0, start={"mass.v": 0.0}, solver=solver)
        assert run["mass.v"] == pytest.approx(1 / 3, rel=1e-9)
        assert pushes(run)[0][1] == pytest.approx(100 / 3)


@pytest.mark.parametrize("solver", TWO)
def test_what_moved_before_a_run_begins_is_no_shock(solver: str) -> None:
    for source in (signals.Step(start_time=-0.1), None):
        net = driven(Speed(), source, Inerter(b=50.0), Mass(m=100.0))
        inputs = {} if source else {"drive.v_ref": 1.0}
        run = net.simulate(1.0, inputs=inputs, start={"mass.v": 0.0}, solver=solver)
        assert run["mass.v"] == pytest.approx(0.0, abs=1e-12)
        assert not pushes(run)


@pytest.mark.parametrize("solver", TWO)
def test_a_sawtooth_of_angles_is_a_shock_at_each_tooth(solver: str) -> None:
    net = driven(Speed(), None, Inerter(b=50.0), Mass(m=100.0))
    teeth = {"drive.v_ref": lambda t: ca.atan2(ca.sin(2 * t), ca.cos(2 * t))}
    run = net.simulate(5.0, inputs=teeth, solver=solver)
    assert run["mass.v"] == pytest.approx(
        np.arctan2(np.sin(2 * run.time), np.cos(2 * run.time)) / 3, abs=1e-6
    )
    assert [e.time for e in run.events] == pytest.approx([np.pi / 2, 3 * np.pi / 2])
    assert [e.impulse for e in run.events] == pytest.approx([-200 * np.pi / 3] * 2)


@pytest.mark.parametrize("begin", [1e3, 1e6])
@pytest.mark.parametrize("solver", TWO)
def test_a_late_beginning_tells_its_first_instant_from_shortly_before(solver: str, begin: float) -> None:
    for late, speed in ((0.0, 1 / 3), (-1e-4, 0.0), (1e-4, 1 / 3)):
        net = driven(Speed(), signals.Step(start_time=begin + late), Inerter(b=50.0), Mass(m=100.0))
        run = net.simulate(begin + 1.0, begin=begin, start={"mass.v": 0.0}, solver=solver)
        assert run["mass.v"][-1] == pytest.approx(speed, rel=1e-9, abs=1e-12)


def test_sensitivities_and_variations_through_a_shock_are_refused() -> None:
    net = driven(Speed(), None, Inerter(b=50.0), Mass(m=100.0))
    with pytest.raises(ia.SimulationError, match=r"drive.*t = 0\.4 s.*sensitivities"):
        net.simulate(0.6, inputs={"drive.v_ref": JUMPING["if_else"]}, sensitivities=["mass.m"])
    dae = driven(Speed(), step(), Inerter(b=50.0), Mass(m=100.0)).dae()
    with pytest.raises(ia.ModelError, match=r"drive.*t = 0\.4 s.*variations"):
        Variations(dae, ["mass.v"], ["mass.m"]).along(ia.simulate(dae, 0.6))
    dae = driven(Speed(), signals.Step(), Inerter(b=50.0), Mass(m=100.0)).dae()
    with pytest.raises(ia.ModelError, match=r"drive.*t = 0 s.*variations"):
        Variations(dae, ["mass.v"], ["mass.m"]).along(ia.simulate(dae, 0.6))


def test_sensitivities_are_followed_where_a_motion_jumps_without_a_shock() -> None:
    net = driven(Position(), None, Spring(k=100.0), Mass(m=1.0))
    jump = {"drive.s_ref": lambda t: ca.if_else(t < LATER, 0, 0.1)}

    def end(k: float) -> ia.Result:
        return net.simulate(
            0.6,
            inputs=jump,
            sensitivities=["element0.k"],
            parameters={"element0.k": k},
            rtol=1e-10,
            atol=1e-12,
        )

    slope = (end(101.0)["mass.s"][-1] - end(99.0)["mass.s"][-1]) / 2
    assert end(100.0).sensitivity("mass.s", "element0.k")[-1] == pytest.approx(slope, rel=1e-3)


def test_a_stepwise_run_acts_where_it_is_told_of_a_jump() -> None:
    dae = driven(Speed(), None, Inerter(b=50.0), Mass(m=100.0)).dae()
    run = Stepwise(dae, 0.0, 1.0, {"drive.v_ref": Polynomial(1)}, {"drive.v_ref": [0.0]})
    run.advance(0.4)
    run.set({"drive.v_ref": [1.0]}, jumps=True)
    run.advance(1.0)
    assert run.result()["mass.v"][-1] == pytest.approx(1 / 3)
    assert pushes(run.result()) == [("drive.v_ref", pytest.approx(100 / 3))]


def test_a_stepwise_run_meets_the_jumps_of_its_sources() -> None:
    run = Stepwise(driven(Speed(), step(), Inerter(b=50.0), Mass(m=100.0)).dae(), 0.0, 1.0, {}, {})
    for t in (0.3, LATER, 0.5):
        run.advance(t)
    assert run.observe([("mass.v", 0)])[0] == pytest.approx(1 / 3)
