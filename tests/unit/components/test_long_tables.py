"""Tables of hundreds of rows say what the same tables say in a few, and cost little more."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertance import rotational, signals
from inertance.components.language import Pieces, Stated, pieces, reading
from inertance.modelica import to_modelica

Table = Sequence[Sequence[float]]
CURVE = ((-0.02, -900.0), (-0.004, -150.0), (0.003, 0.0), (0.011, 500.0), (0.02, 700.0))
SPEEDS = ((-0.5, -40.0), (-0.1, -25.0), (0.2, 10.0), (0.6, 90.0))
RUBS = ((0.0, 5.0), (0.05, 3.0), (0.3, 4.0))
PUSHES = ((0.0, 1e4), (0.05, 6e3), (0.3, 8e3))
LOSSES = ((0.0, 0.98, 0.97, 0.3, 0.2), (20.0, 0.9, 0.8, 0.6, 0.4), (90.0, 0.7, 0.6, 1.1, 0.9))
TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-12}


def finer(table: Table, rows: int = 150) -> Table:
    """The same lines between more points."""
    x, *columns = np.array(table).T
    points = np.union1d(x, np.linspace(x[0], x[-1], rows))
    between = [np.interp(points, x, one).tolist() for one in columns]
    return [*zip(points.tolist(), *between, strict=True)]


def shaken(element: ia.Component) -> ia.Network:
    """A mass on an element and a spring that is soft against a stop, shaken at its foot."""
    net = ia.Network(
        "shaken",
        road=ia.Position(s_ref=lambda t: 0.012 * np.sin(9 * t) + 0.004 * np.sin(31 * t)),
        element=element,
        spring=ia.SpringDamper(k=2e4, d=9.0),
        stop=ia.ElastoGap(k=1e5, d=20.0, s_rel0=-0.02),
        mass=ia.Mass(m=2.0),
    )
    net.connect(net.road.flange, net.element.flange_a, net.spring.flange_a, net.stop.flange_a)
    return net.connect(net.mass.flange, net.element.flange_b, net.spring.flange_b, net.stop.flange_b)


def in_series(element: ia.Component) -> ia.Network:
    """The same with a spring between element and mass, and nothing that has mass between these."""
    net = ia.Network(
        "in series",
        road=ia.Position(s_ref=lambda t: 0.03 * np.sin(9 * t)),
        element=element,
        spring=ia.CubicSpring(k=3e4, k3=1e8),
        mass=ia.Mass(m=2.0),
    )
    net.connect(net.road.flange, net.element.flange_a)
    net.connect(net.element.flange_b, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


def geared(gear: ia.Component) -> ia.Network:
    net = ia.Network(
        "geared",
        motor=rotational.Torque(tau=lambda t: 6 * np.sin(3 * t)),
        rotor=rotational.Inertia(J=0.02),
        gear=gear,
        load=rotational.Inertia(J=0.5),
    )
    net.connect(net.motor.flange, net.rotor.flange, net.gear.flange_a)
    return net.connect(net.gear.flange_b, net.load.flange)


def pushed(block: ia.Component) -> ia.Network:
    """A mass pushed by a table over its own motion."""
    net = ia.Network(
        "pushed",
        wall=ia.Fixed(),
        spring=ia.SpringDamper(k=100.0, d=1.0),
        mass=ia.Mass(m=1.0, s=0.4),
        where=ia.PositionSensor(),
        block=block,
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)
    net.connect(net.mass.flange, net.where.flange)
    net.connect(net.block.y, net.push.f)
    return net.connect(net.where.s, net.block.u)


def tooth(table: Table) -> ia.Network:
    """A mass that a table over time pushes."""
    block = signals.CombiTable1D(table=table)
    net = ia.Network("tooth", clock=signals.Clock(), block=block, push=ia.Force(), mass=ia.Mass(m=1.0))
    net.connect(net.clock.y, net.block.u).connect(net.block.y, net.push.f)
    return net.connect(net.push.flange, net.mass.flange)


Machine = Callable[[Any], ia.Network]
MACHINES: dict[str, tuple[Machine, Table, str]] = {
    "spring": (lambda t: shaken(ia.TabulatedSpring(table=t)), CURVE, "mass.v"),
    "damper": (lambda t: shaken(ia.TabulatedDamper(table=t)), SPEEDS, "mass.v"),
    "law": (lambda t: shaken(ia.TabulatedForce(table=t, over="position")), CURVE, "mass.v"),
    "friction": (lambda t: shaken(ia.TabulatedFriction(table=t)), RUBS, "mass.v"),
    "in series": (lambda t: in_series(ia.TabulatedSpring(table=t)), CURVE, "mass.v"),
    "gear": (lambda t: geared(rotational.LossyGear(ratio=4.0, lossTable=t)), LOSSES, "load.w"),
    "signal": (lambda t: pushed(signals.CombiTable1D(table=t)), PUSHES, "mass.v"),
}


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("machine", MACHINES)
def test_more_rows_of_the_same_table_move_nothing(machine: str, solver: str) -> None:
    built, table, name = MACHINES[machine]
    short, long = (built(rows).simulate(2.0, solver=solver, **TIGHT)[name] for rows in (table, finer(table)))
    assert len(finer(table)) > pieces.MOST_WRITTEN
    assert np.ptp(short) > 0.01
    assert long == pytest.approx(short, abs=1e-5 * np.ptp(short))


X = np.linspace(-0.1, 0.1, 21)
SPLINE = ca.interpolant("spline", "bspline", [X.tolist()], (1e3 * X + 1e5 * X**3).tolist())


class BySpline(ia.Component):
    """A cubic spring between two flanges, by CasADi's interpolant."""

    flange_a, flange_b = ia.TranslationalFlange("one side"), ia.TranslationalFlange("other side")

    def equations(self) -> Stated:
        yield self.flange_b.f == SPLINE(self.flange_b.s - self.flange_a.s)
        yield self.flange_a.f == -self.flange_b.f


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("built", [shaken, in_series])
def test_equations_may_call_functions_of_casadi(built: Machine, solver: str) -> None:
    by_spline, cubic = (
        built(element).simulate(2.0, solver=solver, **TIGHT)["mass.v"]
        for element in (BySpline(), ia.CubicSpring(k=1e3, k3=1e5))
    )
    assert np.ptp(cubic) > 0.01
    assert by_spline == pytest.approx(cubic, abs=1e-5 * np.ptp(cubic))


@settings(deadline=None, max_examples=40)
@given(
    seed=st.integers(0, 2**31),
    order=st.integers(1, 4),
    count=st.integers(pieces.MOST_WRITTEN + 1, 90),
    near=st.sampled_from(["an edge", "a piece", "beyond"]),
)
def test_what_is_looked_up_is_what_is_written(seed: int, order: int, count: int, near: str) -> None:
    draw = np.random.default_rng(seed)
    edges = np.cumsum(draw.uniform(0.01, 3.0, count)) - count
    one = Pieces(edges, draw.normal(size=(order + 1, count + 1)))
    low, high = edges[[0, -1]]
    inside, beyond = draw.uniform(low, high, 20), np.array([low - 3, high + 5])
    places = {"an edge": edges, "a piece": inside, "beyond": beyond}[near] / 2
    at = ca.SX.sym("at")
    values = one.value(2 * at), one.written(2 * at)
    told = [ca.Function("told", [at], [f, ca.gradient(f, at), ca.hessian(f, at)[0]]) for f in values]
    looked_up, written = (np.array([f(place) for place in places.tolist()]) for f in told)
    assert looked_up == pytest.approx(written, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("how", ["linear", "smooth"])
def test_equations_do_not_grow_with_the_table(how: Any) -> None:
    sizes = set()
    for rows in (60, 600):
        dae = shaken(ia.TabulatedSpring(table=finer(CURVE, rows), interpolation=how)).dae()
        sizes.add(ca.Function("equations", dae.arguments(), [dae.ode]).n_instructions())
    assert len(sizes) == 1


def test_equations_do_not_grow_where_much_follows_from_a_table() -> None:
    """One after the other, the torques of a train of gears follow from that of the table at its end."""
    sizes = []
    for table in (CURVE, finer(CURVE)):
        train = {f"gear{k}": rotational.IdealGear(ratio=1.01) for k in range(40)}
        rotors = {f"rotor{k}": rotational.Inertia(J=0.1) for k in range(41)}
        spring = rotational.TabulatedSpring(table=table)
        net = ia.Network("train", spring=spring, wall=rotational.Fixed(), **train, **rotors)
        for k, gear in enumerate(train.values()):
            net.connect(rotors[f"rotor{k}"].flange, gear.flange_a)
            net.connect(gear.flange_b, rotors[f"rotor{k + 1}"].flange)
        net.connect(rotors["rotor40"].flange, spring.flange_a).connect(spring.flange_b, net.wall.flange)
        dae = net.dae()
        all_of_it = ca.Function("all", dae.arguments(), [dae.variables], {"allow_free": True})
        sizes.append(all_of_it.n_instructions())
    assert sizes[1] <= sizes[0]


@pytest.mark.parametrize("solver", ["cvodes", "compiled"])
def test_no_tooth_of_a_long_table_over_time_is_stepped_over(solver: str) -> None:
    still = [(t, 0.0) for t in np.linspace(0.0, 90.0, 50).tolist()]
    table = sorted([*still, (50.0, 0.0), (50.0001, 2e4), (50.0002, 0.0)])
    run = tooth(table).simulate(100.0, solver=solver)
    assert run["mass.v"][[0, -1]] == pytest.approx([0.0, 2.0], rel=1e-6)


def test_a_long_table_in_modelica_is_written_out(monkeypatch: pytest.MonkeyPatch) -> None:
    def text() -> str:
        ia.TabulatedSpring._templates.clear()
        return to_modelica(shaken(ia.TabulatedSpring(table=finer(CURVE, 60))).dae())

    looked_up = text()
    monkeypatch.setattr(pieces, "MOST_WRITTEN", 1000)
    assert looked_up == text()
    assert "looked_up" not in looked_up
    ia.TabulatedSpring._templates.clear()


def test_tables_that_are_used_no_more_are_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "MOST_TEMPLATES", 4)
    kept, kinds = ia.TabulatedSpring(table=CURVE), ia.TabulatedSpring._templates
    kinds.clear()
    first = reading.template_of(kept)
    for slope in range(1, 9):
        reading.template_of(ia.TabulatedSpring(table=((0.0, 0.0), (1.0, slope))))
        assert reading.template_of(kept) is first
    assert len(kinds) == 4


def test_members_of_an_ensemble_look_up_as_a_run_does() -> None:
    net = in_series(ia.TabulatedSpring(table=finer(CURVE, 300)))
    masses = np.linspace(1.0, 3.0, 5)
    found = ia.ensemble(net, 1.0, signals="mass.v", parameters={"mass.m": masses}, **TIGHT)
    for mass, course in zip(masses, found["mass.v"], strict=True):
        alone = net.simulate(1.0, parameters={"mass.m": mass}, solver="compiled", **TIGHT)
        assert course == pytest.approx(alone["mass.v"], abs=1e-6)


def test_an_fmu_looks_up_as_a_run_does(tmp_path: Path) -> None:
    net = shaken(ia.TabulatedSpring(table=finer(CURVE, 300), interpolation="smooth"))
    run = net.simulate(1.0, step=0.01, **TIGHT)
    found = ia.FMU(ia.export_fmu(net, tmp_path / "shaken.fmu")).simulate(1.0, step=0.01)
    places = np.searchsorted(found.time, run.time - 1e-9)
    assert found["mass.v"][places] == pytest.approx(run["mass.v"], abs=1e-3 * np.ptp(run["mass.v"]))
