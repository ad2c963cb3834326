"""Networks whose equations constrain or hide each other: reduced to the right states and forces."""

from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational


def oscillator(element: ia.Component) -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), element=element, mass=ia.Mass(m=1.0, s=0.1))
    return net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)


def test_joined_masses_are_one_variable() -> None:
    net = ia.Network("joined", a=ia.Mass(m=1.0), b=ia.Mass(m=3.0), push=ia.Force(f=8.0))
    net.connect(net.a.flange, net.b.flange, net.push.flange)
    run = net.simulate(1.0)
    assert run.dae.state_names == ["a.s", "a.v"]
    assert run["a.flange.f"] == pytest.approx(2.0)
    assert run["b.flange.f"] == pytest.approx(6.0)


def test_every_rod_of_a_rigid_line_carries_what_lies_behind_it() -> None:
    count = 30
    masses = {f"m{i}": ia.Mass(m=1.0 + i) for i in range(count)}
    rods = {f"r{i}": ia.Rod(L=0.1 * i) for i in range(count - 1)}
    net = ia.Network("line", **masses, **rods, push=ia.Force(f=1.0))
    net.connect(net.push.flange, masses["m0"].flange)
    for i in range(count - 1):
        net.connect(masses[f"m{i}"].flange, rods[f"r{i}"].flange_a)
        net.connect(rods[f"r{i}"].flange_b, masses[f"m{i + 1}"].flange)
    run = net.simulate(1.0, step=0.5)
    total = sum(range(1, count + 1))
    for i in range(count - 1):
        behind = sum(range(i + 2, count + 1))
        assert run[f"r{i}.flange_a.f"] == pytest.approx(behind / total)
        assert run[f"m{i + 1}.s"] - run[f"m{i}.s"] == pytest.approx(0.1 * i)
    assert len(run.dae.states) == 2


@pytest.mark.parametrize(
    "rigid", [ia.Position(s_ref=np.sin), ia.Speed(v_ref=np.cos), ia.Accelerate(a_ref=np.sin)]
)
def test_a_prescribed_motion_drives_masses_and_reports_its_force(rigid: ia.Component) -> None:
    net = ia.Network(
        "driven", drive=rigid.clone(), mass=ia.Mass(m=2.0), tail=ia.Spring(k=3.0), end=ia.Mass(m=1.0)
    )
    net.connect(net.drive.flange, net.mass.flange, net.tail.flange_a)
    net.connect(net.tail.flange_b, net.end.flange)
    run = net.simulate(2.0, rtol=1e-9, atol=1e-11)
    t = run.time
    acceleration = np.sin(t) if isinstance(rigid, ia.Accelerate) else -np.sin(t)
    assert run["mass.a"] == pytest.approx(acceleration, abs=1e-9)
    assert -run["drive.flange.f"] == pytest.approx(2 * run["mass.a"] - run["tail.f"], abs=1e-9)


def test_a_held_mass_has_no_states() -> None:
    net = ia.Network("held", wall=ia.Fixed(s0=2.0), mass=ia.Mass(m=1.0), push=ia.Force(f=np.sin))
    net.connect(net.wall.flange, net.mass.flange, net.push.flange)
    run = net.simulate(1.0)
    assert run.dae.state_names == []
    assert run["mass.s"] == pytest.approx(2.0)
    assert run["wall.flange.f"] == pytest.approx(np.sin(run.time))


@pytest.mark.parametrize(
    ("middle", "states"),
    [
        (lambda: ia.Inerter(b=2.0), 4),
        (lambda: ia.parallel(ia.Inerter(b=2.0), ia.Damper(d=2.0)), 4),
        (lambda: ia.parallel(ia.Inerter(b=2.0), ia.Inerter(b=1.0), ia.Damper(d=2.0)), 4),
        (lambda: ia.parallel(ia.series(ia.Damper(d=1.0), ia.Damper(d=2.0)), ia.Inerter(b=2.0)), 5),
        (lambda: ia.parallel(ia.series(ia.Inerter(b=1.0), ia.Inerter(b=2.0)), ia.Inerter(b=2.0)), 6),
    ],
)
def test_parallel_states_between_massless_nodes(middle: Callable[[], ia.Component], states: int) -> None:
    """Distances that are states but not free: their equations look independent and are not."""
    strut = ia.series(ia.Spring(k=10.0), middle(), ia.Spring(k=30.0))
    run = oscillator(strut).simulate(1.0)
    assert len(run.dae.states) == states
    assert np.isfinite(run["mass.s"]).all()
    assert run["element.spring.f"] == pytest.approx(run["element.spring_2.f"])


def test_a_dangling_loop_of_springs_carries_nothing() -> None:
    net = oscillator(ia.Spring(k=10.0))
    net.add(arm=ia.Spring(k=1.0, s_rel0=0.2), left=ia.Spring(k=2.0), right=ia.Spring(k=3.0))
    net.connect(net.mass.flange, net.arm.flange_a)
    net.connect(net.arm.flange_b, net.left.flange_a, net.right.flange_a)
    net.connect(net.left.flange_b, net.right.flange_b)
    run = net.simulate(1.0)
    assert run["arm.f"] == pytest.approx(0.0, abs=1e-12)
    assert run["arm.s_rel"] == pytest.approx(0.2)
    assert run["left.f"] == pytest.approx(0.0, abs=1e-12)


def test_an_element_with_both_ends_at_one_node_does_nothing() -> None:
    net = oscillator(ia.Spring(k=10.0))
    net.add(idle=ia.Damper(d=5.0))
    net.connect(net.idle.flange_a, net.mass.flange, net.idle.flange_b)
    run = net.simulate(1.0, rtol=1e-9, atol=1e-11)
    assert run["idle.f"] == pytest.approx(0.0, abs=1e-12)
    assert run["mass.s"] == pytest.approx(0.1 * np.cos(np.sqrt(10.0) * run.time), abs=1e-8)


def test_a_free_end_carries_no_force() -> None:
    net = oscillator(ia.Spring(k=10.0))
    net.add(probe=ia.Spring(k=1.0))
    net.connect(net.mass.flange, net.probe.flange_a).connect(net.probe.flange_b)
    assert net.simulate(1.0)["probe.f"] == pytest.approx(0.0, abs=1e-12)


def test_mass_screw_and_gear_reflect_inertia_and_hold_each_other() -> None:
    lead, ratio = 0.02, 5.0
    net = ia.Network(
        "train",
        push=ia.Force(f=10.0),
        slide=ia.Mass(m=3.0),
        screw=ia.NutScrew(lead=lead),
        shaft=rotational.Inertia(J=1e-4),
        gear=rotational.IdealGear(ratio=ratio),
        wheel=rotational.Inertia(J=2e-3),
    )
    net.connect(net.push.flange, net.slide.flange, net.screw.flange_t)
    net.connect(net.screw.flange_r, net.shaft.flange, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.wheel.flange)
    run = net.simulate(0.5)
    turns = 2 * np.pi / lead
    assert run["slide.a"] == pytest.approx(10.0 / (3.0 + turns**2 * (1e-4 + 2e-3 / ratio**2)))
    assert abs(run["wheel.w"]) == pytest.approx(run["slide.v"] * turns / ratio)
    assert len(run.dae.states) == 2


def test_closed_loops_that_are_not_redundant_are_solved() -> None:
    """Two springs and a rod round a loop; the rod fixes one distance, the springs share the rest."""
    net = ia.Network(
        "loop",
        wall=ia.Fixed(),
        a=ia.Spring(k=4.0),
        rod=ia.Rod(L=0.3),
        b=ia.Spring(k=6.0),
        mass=ia.Mass(m=2.0),
    )
    net.connect(net.wall.flange, net.a.flange_a, net.b.flange_a)
    net.connect(net.a.flange_b, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.b.flange_b, net.mass.flange)
    run = net.simulate(2.0, rtol=1e-9, atol=1e-11)
    rest = 4.0 * 0.3 / 10.0
    assert run["mass.s"] == pytest.approx(rest - rest * np.cos(np.sqrt(5.0) * run.time), abs=1e-8)


def test_assembling_leaves_garbage_collection_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    def never() -> None:
        raise AssertionError("garbage collection is switched off, in all threads")

    monkeypatch.setattr("gc.disable", never)
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=1.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
    assert net.dae().state_names


def test_signals_that_are_only_passed_on_need_no_equation() -> None:
    class Wire(ia.Component):
        u = ia.RealInput("1")
        y = ia.RealOutput("1")

        def equations(self) -> Any:
            yield self.y == self.u

    run = ia.Network("wire", wire=Wire(u=lambda t: 2 * t)).simulate(1.0)
    assert run.dae.state_names == []
    assert run["wire.y"] == pytest.approx(2 * run.time)
