"""Solver "compiled" against the event loop in Python, feature by feature."""

import ctypes
from dataclasses import replace
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.machines import Sinusoid
from inertance.networks.csource import native
from inertance.networks.csource.library_cache import CLibrary
from inertance.networks.csource.toolchain import ToolchainError, compiler
from inertance.networks.simulation.bound_dae import bound

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}


def grounded(name: str, **parts: Any) -> ia.Network:
    return ia.Network(name, wall=ia.Fixed(), mass=ia.Mass(m=1.0), **parts)


def pfi() -> ia.Network:
    return ia.machines.inerter_rig(ia.machines.ge_wang.planetary_inerter(), Sinusoid(0.01, 3.0))


def bouncing_ball() -> ia.Network:
    net = ia.Network(
        "ball",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7, v_rest=3e-3),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
    )
    return net.connect(net.floor.flange, net.stop.flange_a).connect(
        net.stop.flange_b, net.ball.flange, net.weight.flange
    )


def two_stops() -> ia.Network:
    net = bouncing_ball()
    net.add(other=ia.HardStop(e=0.7, v_rest=3e-3)).connect(net.floor.flange, net.other.flange_a)
    return net.connect(net.other.flange_b, net.ball.flange)


def rubbing(*elements: ia.Component, push: Any) -> ia.Network:
    net = grounded("rubbing", push=ia.Force(f=push))
    net.connect(net.push.flange, net.mass.flange)
    for k, element in enumerate(elements):
        net.add(**{f"rub{k}": element})
        net.connect(net.wall.flange, element.flange_a).connect(element.flange_b, net.mass.flange)
    return net


def stick_slip() -> ia.Network:
    return rubbing(ia.StribeckFriction(f_c=8.0, f_s=10.0, v_s=0.1, d=1.0), push=lambda t: 14 * ca.sin(3 * t))


def sampled() -> ia.Network:
    t = np.linspace(0, 3, 301)
    return rubbing(ia.CoulombFriction(f_c=8.0), push=ia.Sampled(t, 14 * np.sin(3 * t)))


def two_brakes() -> ia.Network:
    return rubbing(ia.CoulombFriction(f_c=3.0), ia.CoulombFriction(f_c=5.0), push=lambda t: 4 * t)


def backlash() -> ia.Network:
    return rubbing(ia.Backlash(k=1e4, d=10.0, eps=1e-3), push=lambda t: 20 * ca.sin(9 * t))


def clutch() -> ia.Network:
    net = ia.Network(
        "clutch",
        a=rotational.Inertia(J=1.0, w=10.0),
        b=rotational.Inertia(J=2.0),
        clutch=rotational.Clutch(fn_max=20.0, f_normalized=lambda t: ca.if_else(t < 1, t, 0.0)),
        push=rotational.Torque(tau=lambda t: 3 * ca.sin(5 * t)),
    )
    return net.connect(net.a.flange, net.clutch.flange_a, net.push.flange).connect(
        net.clutch.flange_b, net.b.flange
    )


def lossy_gear() -> ia.Network:
    gear = rotational.LossyGear(ratio=2.0, lossTable=((0.0, 0.9, 0.8, 0.5, 0.5),))
    net = ia.Network(
        "gear",
        a=rotational.Inertia(J=1.0),
        gear=gear,
        b=rotational.Inertia(J=1.5),
        push=rotational.Torque(tau=lambda t: 10 * ca.sin(6 * t)),
    )
    return (
        net.connect(net.push.flange, net.a.flange)
        .connect(net.a.flange, net.gear.flange_a)
        .connect(net.gear.flange_b, net.b.flange)
    )


def guided() -> ia.Network:
    body = ia.MassWithStopAndFriction(m=1.0, s_min=-0.3, s_max=0.3, f_c=1.0, f_s=2.0, d=1.0, v_s=0.1)
    net = ia.Network("guided", body=body, push=ia.Force(f=lambda t: 20 * ca.sin(5 * t)))
    return net.connect(net.body.flange, net.push.flange)


def brake() -> ia.Network:
    net = ia.Network(
        "braked",
        shaft=rotational.Inertia(J=1.0, w=5.0),
        brake=rotational.Brake(fn_max=10.0, f_normalized=lambda t: ca.if_else(t > 0.5, 1.0, 0.0)),
    )
    return net.connect(net.shaft.flange, net.brake.flange)


def algebraic_loop() -> ia.Network:
    """Two springs in series, one of them cubic: where they meet, nothing has inertia."""
    chain = ia.series(soft=ia.Spring(k=100.0), hard=ia.CubicSpring(k=50.0, k3=4e4))
    net = grounded(
        "loop", chain=chain, rub=ia.CoulombFriction(f_c=1.0), push=ia.Force(f=lambda t: 10 * ca.sin(4 * t))
    )
    net.connect(net.wall.flange, net.chain.flange_a, net.rub.flange_a)
    return net.connect(net.chain.flange_b, net.mass.flange, net.push.flange, net.rub.flange_b)


def prescribed() -> ia.Network:
    net = ia.Network(
        "driven",
        drive=ia.Position(s_ref=lambda t: 0.1 * ca.sin(t)),
        rub=ia.CoulombFriction(f_c=3.0),
        wall=ia.Fixed(),
    )
    return net.connect(net.wall.flange, net.rub.flange_a).connect(net.rub.flange_b, net.drive.flange)


MACHINES = {
    pfi: ("inerter.flange_a.f", 0.5),
    stick_slip: ("mass.s", 4.0),
    sampled: ("mass.s", 3.0),
    backlash: ("mass.s", 2.0),
    two_brakes: ("mass.s", 4.0),
    bouncing_ball: ("ball.s", 2.9),
    two_stops: ("ball.s", 2.9),
    clutch: ("b.w", 2.0),
    lossy_gear: ("b.w", 2.0),
    guided: ("body.s", 3.0),
    brake: ("shaft.w", 2.0),
    algebraic_loop: ("chain.hard.f", 3.0),
    prescribed: ("rub.f", 7.0),
}


@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.__name__)
def test_agrees_with_the_event_loop(machine: Any) -> None:
    name, stop = MACHINES[machine]
    dae = machine().dae()
    ours, native = (ia.simulate(dae, stop, solver=solver, **TIGHT) for solver in ("compiled", "auto"))
    told = [[(e.component, e.mode, e.source, e.target) for e in run.events] for run in (ours, native)]
    assert told[0] == told[1]
    assert [e.time for e in ours.events] == pytest.approx([e.time for e in native.events], abs=1e-6)
    shocks = [[e.impulse for e in run.events if e.impulse is not None] for run in (ours, native)]
    assert shocks[0] == pytest.approx(shocks[1], rel=1e-6, abs=1e-6 * max(shocks[1], default=0.0))
    grid = np.linspace(0, stop, 200)[1:-1]
    away = np.array(
        [t for t in grid if all(abs(t - e.time) > 0.02 * stop for e in native.events)] or [0.9999 * stop]
    )
    values = [np.interp(away, run.time, run[name]) for run in (ours, native)]
    assert values[0] == pytest.approx(values[1], abs=1e-5 * np.ptp(native[name]))
    beside = [abs(e.time * 500 / stop - round(e.time * 500 / stop)) for e in native.events]
    assert abs(len(ours.time) - len(native.time)) <= sum(apart < 1e-9 for apart in beside)
    assert ours.notes == native.notes
    assert ours.stats["solver"] == "compiled"


def test_stuck_is_stuck() -> None:
    run = stick_slip().simulate(4.0, solver="compiled")
    stuck = run["rub0.mode"] == 0
    assert stuck.any()
    assert not stuck.all()
    assert (run["mass.v"][stuck] == 0.0).all()


def test_the_ball_comes_to_rest() -> None:
    run = bouncing_ball().simulate(5.0, solver="compiled", **TIGHT)
    assert run.events[-1].target == "contact"
    assert run["ball.v"][-1] == 0.0
    assert run["ball.s"].min() >= -1e-12


def test_bounces_without_a_resting_speed_end_and_at_the_same_instants() -> None:
    dae = bouncing_ball().dae()
    runs = [
        ia.simulate(dae, 3.0, parameters={"stop.v_rest": 0.0}, rtol=1e-10, atol=1e-14, solver=solver)
        for solver in ("auto", "compiled")
    ]
    times = [[event.time for event in run.events] for run in runs]
    assert times[1] == pytest.approx(times[0], abs=1e-6)
    end = (2 / 9.81) ** 0.5 * 1.7 / 0.3  # of the series, had it no last bounce
    for run in runs:
        assert run.events[-1].target == "contact"
        assert run.events[-1].time == pytest.approx(end, abs=1e-5)
        assert run["ball.v"][-1] == 0.0


def test_every_slip_is_seen_however_seldom_outputs_are() -> None:
    dae = rubbing(ia.CoulombFriction(f_c=10.0), push=lambda t: 10.01 * ca.sin(50 * t)).dae()
    for step in (0.02, 2.0, 8.0):
        run = ia.simulate(dae, 8.0, step=step, solver="compiled")
        begins = [event.time for event in run.events if event.source == "stuck"]
        slips = np.arcsin(10 / 10.01) / 50 + np.pi / 50 * np.arange(127)
        assert begins == pytest.approx(slips, abs=1e-6)


def test_slip_by_a_force_that_is_found_by_iteration_is_seen() -> None:
    net = ia.Network(
        "pressed",
        wall=ia.Fixed(),
        rail=ia.CoulombFriction(f_c=1.0),
        seal=ia.LoadedFriction(mu=0.1, regularised=1e-3),
        cell=ia.ForceSensor(),
        mass=ia.Mass(m=1.0),
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.rail.flange_a, net.seal.flange_a)
    net.connect(net.rail.flange_b, net.push.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.mass.flange, net.seal.flange_b)
    net.connect(net.cell.f, net.seal.load)
    assert net.dae().z.numel() == 1
    run = net.simulate(2.0, step=2.0, inputs={"push.f": lambda t: 1.2 * ca.sin(t)}, solver="compiled")
    assert [event.target for event in run.events] == ["forward"]
    assert run.events[0].time == pytest.approx(np.arcsin(1 / 1.2), abs=1e-6)


def test_an_event_passed_on_the_way_to_another_is_not_lost() -> None:
    """Pairs come to rest while others, touching, are about to strike: momentum tells."""
    masses, speeds, rubbing_ = [1.0, 1.0, 1.375, 1.125], [0.0, 0.0, -1.0, -1.0], [2.0, 0.0, 2.0]
    net = ia.Network("row")
    for i, (m, v) in enumerate(zip(masses, speeds, strict=True)):
        net.add(**{f"m{i}": ia.Mass(m=m, s=[0.0, 1.05, 2.05, 3.1][i], v=v)})
    for i, f_c in enumerate(rubbing_):
        net.add(**{f"c{i}": ia.HardStop(e=0.5, s_min=1.0), f"r{i}": ia.CoulombFriction(f_c=f_c)})
        left, right, stop, rub = (getattr(net, name) for name in (f"m{i}", f"m{i + 1}", f"c{i}", f"r{i}"))
        net.connect(left.flange, stop.flange_a, rub.flange_a)
        net.connect(right.flange, stop.flange_b, rub.flange_b)
    dae = net.dae()
    runs = [ia.simulate(dae, 1.0, rtol=1e-10, atol=1e-13, solver=solver) for solver in ("auto", "compiled")]
    for run in runs:
        momentum = sum(m * run[f"m{i}.v"] for i, m in enumerate(masses))
        assert momentum == pytest.approx(-2.5, abs=1e-10)
    first, second = ([(event.component, event.target) for event in run.events] for run in runs)
    assert first == second
    # later they touch at 1e-5 m/s, and when they do depends on the last digit of their distance
    times = [[event.time for event in run.events if event.time < 0.27] for run in runs]
    assert times[1] == pytest.approx(times[0], abs=1e-6)


def test_parameters_and_starts_change_without_compiling_again() -> None:
    net = grounded("oscillator", spring=ia.Spring(k=100.0))
    dae = (
        net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange).dae()
    )
    closed = bound(dae, {})
    for k, s in ((100.0, 0.1), (25.0, 0.2)):
        run = ia.simulate(
            dae, 2.0, solver="compiled", parameters={"spring.k": k}, start={"mass.s": s}, **TIGHT
        )
        assert run["mass.s"] == pytest.approx(s * np.cos(np.sqrt(k) * run.time), abs=1e-7)
    assert bound(dae, {}) is closed


def test_a_core_of_its_size_class_computes_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CFLAGS", "-O0")  # otherwise sums may be taken in another order
    shared = ia.simulate(pfi().dae(), 0.3, solver="compiled")
    monkeypatch.setattr("inertance.networks.csource.tables.most_of_class", lambda _: None)
    own = ia.simulate(pfi().dae(), 0.3, solver="compiled")
    assert (shared.points.x == own.points.x).all()
    assert shared.stats["steps"] == own.stats["steps"]
    assert len(shared.events) == len(own.events) > 1


def test_a_new_record_needs_no_new_compilation(monkeypatch: pytest.MonkeyPatch) -> None:
    net = ia.Network("shaker", table=ia.Position(), mount=ia.SpringDamper(k=1e3, d=10.0), box=ia.Mass(m=2.0))
    dae = net.connect(net.table.flange, net.mount.flange_a).connect(net.mount.flange_b, net.box.flange).dae()
    ia.simulate(dae, 0.1, inputs={"table.s_ref": 0.0}, solver="compiled")
    monkeypatch.setattr(CLibrary, "load", lambda *_: pytest.fail("compiled"))
    t = np.linspace(0, 2, 501)
    for w in (5.0, 20.0):
        record = ia.Sampled(t, 0.01 * np.sin(w * t))
        ours, native = (
            ia.simulate(dae, 2.0, inputs={"table.s_ref": record}, solver=s, **TIGHT)
            for s in ("compiled", "auto")
        )
        assert ours["box.a"] == pytest.approx(native["box.a"], abs=1e-6 * np.ptp(native["box.a"]))
    again = replace(dae, bindings={})  # as each reading of a campaign's records has it
    held = ia.simulate(again, 5.0, inputs={"table.s_ref": 0.01}, solver="compiled")
    assert held["box.s"][-1] == pytest.approx(0.01, abs=1e-6)


def test_many_masses() -> None:
    """60 of them take the sparse factorisation."""
    net = ia.Network("chain", wall=ia.Fixed())
    last: Any = net.wall.flange
    for i in range(60):
        net.add(
            **{f"s{i}": ia.SpringDamper(k=1e4, d=1.0), f"m{i}": ia.Mass(m=1.0, v=1.0 if i == 59 else 0.0)}
        )
        net.connect(last, getattr(net, f"s{i}").flange_a).connect(
            getattr(net, f"s{i}").flange_b, getattr(net, f"m{i}").flange
        )
        last = getattr(net, f"m{i}").flange
    dae = net.dae()
    ours, native = (ia.simulate(dae, 0.5, solver=solver, **TIGHT) for solver in ("compiled", "auto"))
    assert ours["m40.s"] == pytest.approx(native["m40.s"], abs=1e-7)


def test_failures_are_told_and_keep_what_was_computed() -> None:
    class Explosion(ia.Component):
        y = ia.variable("1", "grows without bound", start=1.0)

        def equations(self) -> Any:
            yield ia.der(self.y) == self.y**2

    with pytest.raises(
        ia.SimulationError, match=r"integration failed at t = (0\.99|1).*element\.y"
    ) as caught:
        ia.Network("bang", element=Explosion()).simulate(2.0, solver="compiled")
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert kept["element.y"][-1] > 100


def test_sensitivities_through_shocks_are_refused() -> None:
    with pytest.raises(ia.ModelError, match="'ball' has shocks"):
        bouncing_ball().simulate(1.0, solver="compiled", sensitivities=["ball.m"])


def test_without_a_compiler_the_remedy_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr("shutil.which", lambda name: None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(
        ia.ModelError, match=r"install a C compiler \(gcc or clang\), or `pip install ziglang`"
    ):
        compiler()
    with pytest.raises(ia.ModelError, match="no platform 'x86_64-linx'; did you mean 'x86_64-linux'"):
        compiler("x86_64-linx")


class Watched(ia.Component):
    """A body whose mode would change whenever it turns, but never may."""

    flange = ia.TranslationalFlange()
    v = ia.variable("m/s", "speed")
    state = ia.mode("quiet", "loud")

    def equations(self) -> Any:
        yield self.v == ia.der(self.flange.s)
        yield ia.der(self.v) == self.flange.f

    def transitions(self) -> Any:
        yield self.state.goes("quiet", "loud", when=self.v > 0, allowed=self.v > 1e9)
        yield self.state.goes("loud", "quiet", when=self.v > 1e9)


def test_landings_without_end_that_switch_nothing_fit_into_a_run() -> None:
    net = ia.Network("turning", wall=ia.Fixed(), spring=ia.Spring(k=1e6), body=Watched())
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.body.flange, net.spring.flange_b)
    run = net.simulate(30.0, step=6.0, solver="compiled", start={"body.v": 1.0}, rtol=1e-3)
    assert len(run.time) > 4000  # one at every turn, 1000 rad/s
    assert run.events == []
    assert np.abs(run["body.flange.s"]).max() < 2e-3


def driven_through(c: float, d: float) -> ia.Network:
    """A wheel on a shaft that is driven to and fro; a stiff spring leads from it to a light one that rubs."""
    t = np.linspace(0.0, 2.0, 2001)
    net = ia.Network(
        "stiff",
        wall=rotational.Fixed(),
        drive=rotational.Position(phi_ref=ia.Sampled(t, 2.0 * np.sin(2 * np.pi * t))),
        shaft=rotational.SpringDamper(c=1e3, d=0.1),
        wheel=rotational.Inertia(J=1e-3),
        spring=rotational.SpringDamper(c=c, d=d),
        light=rotational.Inertia(J=1e-6),
        rub=rotational.StribeckFriction(tau_c=0.2, tau_s=0.24, w_s=5e8, d=3e-3),
    )
    net.connect(net.drive.flange, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.wheel.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.light.flange, net.rub.flange_a)
    return net.connect(net.rub.flange_b, net.wall.flange)


def test_a_spring_that_is_all_but_rigid_does_not_blur_events() -> None:
    stiff, stiffer = (
        driven_through(c, d).simulate(2.0, step=0.004, solver="compiled", rtol=1e-5, atol=1e-7)
        for c, d in ((1e9, 1e6), (1e12, 1e11))
    )
    slips = [[e.time for e in run.events if e.target != "stuck"] for run in (stiff, stiffer)]
    assert len(slips[0]) > 3
    np.testing.assert_allclose(slips[1], slips[0], atol=5e-3)
    assert stiffer.stats["steps"] < 2 * stiff.stats["steps"]


def rubbing_by_its_load(torque: rotational.Torque | None = None) -> ia.Network:
    """A geared motor turns a load on a spring; what the gear passes on, an unknown, presses a bearing."""
    swung = rotational.Torque(tau=lambda t: 1.5 * ca.sin(2.3 * t) + 1.1 * ca.sin(7.1 * t + 1))
    net = ia.Network(
        "drive",
        ground=rotational.Fixed(),
        torque=torque or swung,
        motor=rotational.Inertia(J=2e-3),
        shaft=rotational.SpringDamper(c=50.0, d=0.06),
        gear=rotational.IdealGear(ratio=5.0),
        cell=rotational.TorqueSensor(),
        rub=rotational.LoadedFriction(mu=0.2, regularised=0.06),
        load=rotational.Inertia(J=0.08),
        spiral=rotational.SpringDamper(c=3.4, d=0.15),
    )
    net.connect(net.torque.flange, net.motor.flange, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.cell.flange_a, net.rub.flange_b)
    net.connect(net.cell.flange_b, net.load.flange, net.spiral.flange_b)
    net.connect(net.ground.flange, net.spiral.flange_a, net.rub.flange_a)
    return net.connect(net.cell.tau, net.rub.load)


def test_an_unknown_that_bends_as_it_crosses_zero_takes_no_shorter_steps_the_finer_its_tolerance() -> None:
    """They became a hundred billionth of what is needed; to 1e-14 no step was short enough."""
    dae = rubbing_by_its_load().dae()
    runs = [ia.simulate(dae, 20.0, solver="compiled", rtol=1e-5, atol=atol) for atol in (1e-8, 1e-12, 1e-14)]
    steps = [run.stats["steps"] for run in runs]
    assert max(steps) < 1.05 * min(steps)
    exact = ia.simulate(dae, 20.0, solver="idas", rtol=1e-8, atol=1e-10)
    for run in runs:
        for name in ("load.w", "cell.tau"):
            size = np.abs(exact[name]).max()
            np.testing.assert_allclose(run[name], exact[name], rtol=0, atol=1e-4 * size)


def test_an_unknown_is_as_exact_once_it_has_been_far_larger() -> None:
    """Held against the largest that it had ever been, it was 15 times less so."""
    torque = rotational.Torque(
        tau=lambda t: (1.5 * ca.sin(2.3 * t) + ca.sin(7.1 * t)) * (1 + 1e3 * ca.exp(-2 * t))
    )
    dae = rubbing_by_its_load(torque).dae()
    run, exact = (ia.simulate(dae, 20.0, solver="compiled", rtol=rtol, atol=1e-9) for rtol in (1e-6, 1e-9))
    size, late = np.abs(exact["cell.tau"]), exact.time > 15.0
    assert size.max() > 100 * size[late].max()
    np.testing.assert_allclose(
        run["cell.tau"][late], exact["cell.tau"][late], rtol=0, atol=1e-5 * size[late].max()
    )


def test_a_library_that_lays_out_numbers_otherwise_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    class _Shorter(ctypes.Structure):
        _fields_ = native._Run._fields_[:-1]

    monkeypatch.setattr(native, "_Run", _Shorter)
    with pytest.raises(
        ToolchainError,
        match=r"192 bytes for Shorter, this Python 184; CC and CFLAGS must build for the machine",
    ):
        stick_slip().simulate(1.0, solver="compiled")
