"""Inputs that keep each sample until the next, as commands of digital controllers do."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.fmu import FMU
from inertance.networks import Stepwise, Variations
from inertance.networks.evaluation.saltation import passages
from inertance.networks.simulation.legs import legs_of
from numpy.typing import NDArray
from scipy.linalg import expm

Array = NDArray[np.float64]
SOLVERS = ["cvodes", "idas", "rosenbrock", "compiled"]
K, D = 100.0, 2.0
RNG = np.random.default_rng(0)
TIME = np.sort(np.r_[2.0, 3.0, RNG.uniform(2, 3, 30)])
FORCE = RNG.normal(size=32)
FORCE[5:9] = FORCE[5]  # a command that does not change for a while


def oscillator(force: Any = None, k: float = K) -> ia.Network:
    push = ia.Force() if force is None else ia.Force(f=force)
    net = ia.Network("oscillator", push=push, mass=ia.Mass(m=1.0), wall=ia.Fixed())
    net.add(spring=ia.SpringDamper(k=k, d=D)).connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def held(**options: Any) -> ia.Sampled:
    return ia.Sampled(TIME, FORCE, interpolation="hold", **options)


def exact(stop: float, begin: float = 2.0, k: float = K, force: Array = FORCE) -> float:
    """Return where the mass ends, from the matrix exponential between the jumps."""
    rates = np.array([[0.0, 1.0], [-k, -D]])
    x = np.zeros(2)
    edges = [begin, *TIME[(begin < TIME) & (stop > TIME)], stop]
    for low, high in pairwise(edges):
        rest = np.array([force[max(0, np.searchsorted(TIME, low, "right") - 1)] / k, 0.0])
        x = rest + expm(rates * (high - low)) @ (x - rest)
    return float(x[0])


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_held_force_acts_from_sample_to_sample(solver: str) -> None:
    run = oscillator().simulate(3.0, begin=2.0, inputs={"push.f": held()}, solver=solver, rtol=1e-8)
    assert run["mass.s"][-1] == pytest.approx(exact(3.0), abs=1e-8)
    assert set(run["push.f"]) == set(FORCE)
    assert run["mass.a"][-1] == pytest.approx(FORCE[-1] - K * run["mass.s"][-1] - D * run["mass.v"][-1])
    longer = oscillator().simulate(
        5.0, begin=1.0, inputs={"push.f": held(extrapolation="hold")}, solver=solver, rtol=1e-8
    )
    assert longer["mass.s"][-1] == pytest.approx(exact(5.0, 1.0), abs=1e-8)


@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_held_data_go_into_an_fmu_and_drive_one(tmp_path: Path, kind: str) -> None:
    command = ia.Sampled(TIME - 2.0, FORCE, interpolation="hold")
    within, free = (
        ia.export_fmu(oscillator(force), tmp_path / f"{name}.fmu", outputs=["mass.s"])
        for name, force in (("within", command), ("free", None))
    )
    assert FMU(within).simulate(1.0, kind=kind)["mass.s"][-1] == pytest.approx(exact(3.0), abs=1e-6)
    run = FMU(free).simulate(1.0, kind=kind, inputs={"push.f": command})
    assert run["mass.s"][-1] == pytest.approx(exact(3.0), abs=1e-7)


def test_a_run_that_is_advanced_from_outside_holds_bound_data() -> None:
    going = Stepwise(oscillator(held()).dae(), 2.0, 3.0, {}, {})
    for t in (2.3, 2.31, 3.0):
        going.advance(t)
    assert going.result()["mass.s"][-1] == pytest.approx(exact(3.0), abs=1e-6)


def test_slopes_pass_the_jumps() -> None:
    dae = oscillator().dae()
    run = ia.simulate(dae, 3.0, begin=2.0, inputs={"push.f": held()}, solver="rosenbrock", rtol=1e-9)
    variations = Variations(dae, ["mass.s"], ["spring.k"])
    slope = (exact(3.0, k=K + 0.01) - exact(3.0, k=K - 0.01)) / 0.02
    assert variations.along(run)[-1, 0, 0] == pytest.approx(slope, rel=1e-4)
    change = np.where(np.arange(len(FORCE)) == 11, 1.0, 0.0)
    now = np.searchsorted(TIME, run.time, side="right") - 1
    answer = variations.pushed(run, {"push.f": change[now][:, None]})[-1, 0, 0]
    moved = exact(3.0, force=FORCE + 0.5 * change) - exact(3.0, force=FORCE - 0.5 * change)
    assert answer == pytest.approx(moved, rel=1e-3)


def rubbed() -> ia.DAE:
    """Return the oscillator with friction, driven through a gain."""
    net = ia.Network("rubbed", push=ia.Force(), gain=ia.signals.Gain(k=3.0), mass=ia.Mass(m=1.0))
    net.add(wall=ia.Fixed(), strut=ia.SpringDamper(k=K, d=D), guide=ia.CoulombFriction(f_c=1.5))
    net.connect(net.gain.y, net.push.f)
    net.connect(net.wall.flange, net.strut.flange_a, net.guide.flange_a)
    return net.connect(net.push.flange, net.mass.flange, net.strut.flange_b, net.guide.flange_b).dae()


def pushed(dae: ia.DAE, **parameters: float) -> ia.Result:
    given = {name.replace("__", "."): value for name, value in parameters.items()}
    inputs = {"gain.u": held()}
    return ia.simulate(dae, 3.0, begin=2.0, inputs=inputs, parameters=given, solver="rosenbrock", rtol=1e-10)


def test_slopes_pass_the_jumps_between_which_friction_sticks_and_slips() -> None:
    dae = rubbed()
    run = pushed(dae)
    switching = [number for number, _ in passages(run)]
    jumps = np.count_nonzero(np.diff(FORCE))
    assert 0 < len(switching) < len(run.segments) - 1 - jumps / 2
    slopes = Variations(dae, ["mass.s"], ["strut.k", "guide.f_c"]).along(run)[-1, 0]
    for slope, name, value in zip(slopes, ("strut__k", "guide__f_c"), (K, 1.5), strict=False):
        low, high = (pushed(dae, **{name: value * (1 + step)})["mass.s"][-1] for step in (-1e-4, 1e-4))
        assert slope == pytest.approx((high - low) / (2e-4 * value), rel=1e-3)


def test_when_a_command_jumps_is_found_once_for_all_gains(monkeypatch: pytest.MonkeyPatch) -> None:
    sought: list[float] = []

    def counted(*given: Any) -> Any:
        sought.append(given[1])
        return legs_of(*given)

    monkeypatch.setattr("inertance.networks.simulation.bound_dae.legs_of", counted)
    dae, command = rubbed(), {"gain.u": held()}
    for gain in (1.0, 2.0, 3.0):
        ia.simulate(dae, 3.0, begin=2.0, inputs=command, parameters={"gain.k": gain})
    assert len(sought) == 1


@pytest.mark.parametrize("solver", ["rosenbrock", "compiled"])
def test_a_held_position_pulls_springs_strikes_by_dampers_and_is_refused_by_masses(solver: str) -> None:
    time, place = np.array([0.0, 0.1, 1.0]), np.array([0.0, 0.01, 0.01])
    command = {"table.s_ref": ia.Sampled(time, place, interpolation="hold")}
    driven = ia.Network("driven", table=ia.Position(), mass=ia.Mass(m=2.0))

    sprung = driven.clone().add(spring=ia.Spring(k=50.0))
    sprung.connect(sprung.table.flange, sprung.spring.flange_a)
    sprung.connect(sprung.spring.flange_b, sprung.mass.flange)
    run = sprung.simulate(1.0, inputs=command, solver=solver, rtol=1e-8)
    assert run["mass.s"][-1] == pytest.approx(0.01 * (1 - np.cos(5.0 * 0.9)), abs=1e-8)

    damped = driven.clone().add(strut=ia.Damper(d=3.0))
    damped.connect(damped.table.flange, damped.strut.flange_a)
    damped.connect(damped.strut.flange_b, damped.mass.flange)
    run = damped.simulate(1.0, inputs=command, solver=solver, rtol=1e-8)
    assert run["mass.v"][np.searchsorted(run.time, 0.1, "right") - 1] == pytest.approx(3.0 * 0.01 / 2.0)
    assert run["mass.s"][-1] == pytest.approx(0.01 * (1 - np.exp(-1.5 * 0.9)), abs=1e-8)

    rigid = driven.connect(driven.table.flange, driven.mass.flange)
    with pytest.raises(ia.SimulationError, match=r"table\.s_ref' \(by 0\.01\), .* exact=False"):
        rigid.simulate(1.0, inputs=command, solver=solver)


def test_samples_that_are_too_few_to_be_held_are_told() -> None:
    with pytest.raises(ia.ModelError, match="at least 2 samples are needed for a held signal, got 1"):
        ia.Sampled([0.0], [1.0], interpolation="hold")
