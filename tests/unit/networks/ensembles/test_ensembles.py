"""What an ensemble is given, what it refuses, and what becomes of members that fail."""

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pandas as pd
import pytest
from inertance.base import RunInterruptedError
from inertance.networks.csource import crew
from inertance.networks.csource.toolchain import ToolchainError, compiler
from inertance.networks.simulation import starting
from inertance.sweeps import grid, saltelli, sobol_indices

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)


class Growing(ia.Component):
    """A force with the cube of the position, which may push it away."""

    flange = ia.TranslationalFlange("what it acts on")
    k = ia.parameter("N/m3", "stiffness", default=1.0)

    def equations(self) -> Any:
        yield self.flange.f == self.k * self.flange.s**3


def swing() -> ia.DAE:
    net = ia.Network("swing", mass=ia.Mass(m=1.0), spring=Growing(), push=ia.Force())
    return net.connect(net.mass.flange, net.spring.flange, net.push.flange).dae()


@pytest.fixture(scope="module")
def dae() -> ia.DAE:
    return swing()


def run(dae: ia.DAE, **given: Any) -> ia.Ensemble:
    given = {"signals": "mass.s", "inputs": {"push.f": 0.0}, "starts": {"mass.s": 1.0}} | given
    return ia.ensemble(dae, 1.0, **given)


def test_shapes(dae: ia.DAE) -> None:
    many = run(dae, signals=["mass.s", "mass.v", "spring.k"], parameters={"spring.k": [1.0, 4.0]}, step=0.25)
    assert many.values.shape == (2, 5, 3)
    assert many.time.tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert many["spring.k"][:, 0].tolist() == [1.0, 4.0]
    assert (many["mass.s"] == many.values[:, :, 0]).all()
    assert len(many) == many.done == 2
    assert many.events(1) == []
    assert repr(many) == "<Ensemble 'swing': 2 members, 0 failed, 5 instants of 3 signals>"


def test_one_member(dae: ia.DAE) -> None:
    alone = ia.simulate(dae, 1.0, inputs={"push.f": 0.0}, start={"mass.s": 1.0}, solver="compiled")
    assert run(dae)["mass.s"][0] == pytest.approx(alone["mass.s"], abs=1e-9)


def test_tables_of_parameters(dae: ia.DAE) -> None:
    mass, k = [1.0, 1.0, 2.0, 2.0], [1.0, 3.0, 1.0, 3.0]
    plain = run(dae, parameters={"mass.m": mass, "spring.k": np.array(k)}).values
    table = pd.DataFrame({"mass.m": mass, "spring.k": k})
    assert (run(dae, parameters=table).values == plain).all()
    assert (run(dae, parameters=grid({"mass.m": [1.0, 2.0], "spring.k": [1.0, 3.0]})).values == plain).all()


def test_a_member_that_fails_leaves_the_others(dae: ia.DAE) -> None:
    """A push away from rest that grows with the cube of the distance has no solution for long."""
    k = np.array([1.0, -10.0, 2.0, -0.1, 3.0])
    many = run(dae, parameters={"spring.k": k})
    assert list(many.errors) == [1]
    assert many.stats["failed"] == 1
    assert "'swing': member 1: integration failed at t = 0.58" in many.errors[1]
    assert "mass.s" in many.errors[1]
    gone = many.time > 0.5863
    assert np.isnan(many["mass.s"][1, gone]).all()
    assert np.isfinite(many["mass.s"][1, many.time < 0.58]).all()
    assert np.isfinite(many["mass.s"][[0, 2, 3, 4]]).all()
    with pytest.raises(ia.SimulationError, match="none of 2 members could be run") as raised:
        run(dae, parameters={"spring.k": [-10.0, -20.0]})
    assert isinstance(raised.value.result, ia.Ensemble)


def test_more_start_values_than_a_program_seeks(dae: ia.DAE, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are found in Python, one after the other."""
    given: dict[str, Any] = {"starts": {"mass.s": 2.0}, "parameters": {"spring.k": [1.0, 0.5]}}
    found = run(dae, **given).values
    monkeypatch.setattr(starting, "MOST_SOUGHT", -1)
    assert run(dae, **given).values == pytest.approx(found)
    many = run(dae, starts={"mass.s": [1.0, 2.0, 3.0], "spring.flange.f": 8.0})
    assert list(many.errors) == [0, 2]


def test_a_start_that_cannot_be_is_told_of_its_member(dae: ia.DAE) -> None:
    starts = {"mass.s": 1.0, "mass.a": [-1.0, -4.0]}
    many = run(dae, starts=starts, parameters={"spring.k": [1.0, 1.0]})
    assert list(many.errors) == [1]
    assert "member 1: 'mass.a' = -4 m/s2 cannot be reached" in many.errors[1]


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (
            {"parameters": {"mass.m": [1.0, np.nan]}},
            r"of member 1: m must be a finite number \[kg\]",
        ),
        (
            {"parameters": {"mass.m": [1.0, 2.0, -3.0]}},
            "'mass.m' of member 2: m must be above 0 kg",
        ),
        ({"parameters": {"mass.m": np.full(9, -1.0)}}, "'mass.m' of 6 more members: likewise"),
        ({"parameters": {"mass.mm": [1.0]}}, "there is no parameter 'mass.mm'; did you mean 'mass.m'"),
        ({"parameters": {"mass.m": ["one"]}}, "parameters 'mass.m' takes numbers, one for each member"),
        ({"parameters": {"mass.m": np.ones((2, 2))}}, r"got an array of shape \(2, 2\)"),
        ({"parameters": {"mass.m": [1.0, 2.0, 3.0], "spring.k": [1.0, 2.0]}}, "'mass.m': 3\n.*'spring.k': 2"),
        ({"parameters": {"mass.m": [1.0, 2.0]}, "starts": {"mass.s": [1.0] * 3}}, "starts 'mass.s': 3"),
        (
            {"starts": {"mass.s": [0.0, np.inf]}},
            "'mass.s' of member 1 must be a finite number",
        ),
        ({"starts": {"mass.x": [0.0]}}, "no variable 'mass.x'"),
        ({"inputs": {"push.f": [ca.sin, ca.cos]}}, "member 0 is a function of time; members share functions"),
        ({"inputs": {"push.g": 0.0}}, "there is no input 'push.g'; did you mean 'push.f'"),
        ({"inputs": {"push.f": [(np.linspace(0, 0.5, 9), np.ones(9))] * 2}}, "its data are from 0 to 0.5 s"),
        ({"inputs": {"push.f": ia.Polynomial(1)}}, "takes no Polynomial"),
        ({"signals": []}, "signals that are named"),
        ({"signals": "mass.x"}, "no variable 'mass.x'"),
        ({"workers": -1}, "workers"),
        ({"member": 3}, "there is no argument 'member'"),
    ],
    ids=lambda part: part if isinstance(part, str) else "",
)
def test_refusals(dae: ia.DAE, given: dict[str, Any], told: str) -> None:
    with pytest.raises((ia.ModelError, ia.UnknownNameError), match=told):
        run(dae, **given)


def test_what_shapes_the_equations_is_refused_with_the_remedy() -> None:
    net = ia.Network("rubbing", wall=ia.Fixed(), rub=ia.CoulombFriction(f_c=1.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.rub.flange_a).connect(net.rub.flange_b, net.mass.flange)
    with pytest.raises(ia.ModelError, match=r"'rub\.regularised' shapes .* a network for each"):
        ia.ensemble(net, 1.0, signals="mass.v", parameters={"rub.regularised": [0.1, 0.2]})


def test_what_was_not_asked_for(dae: ia.DAE) -> None:
    many = run(dae)
    with pytest.raises(ia.UnknownNameError, match=r"no signal 'mass\.x'; did you mean 'mass\.s'.* signals="):
        many["mass.x"]
    with pytest.raises(ia.ModelError, match="members 0 to 0, and none of number 1"):
        many.events(1)


def test_a_measure_of_each_member_is_a_sweep(dae: ia.DAE) -> None:
    k = [1.0, -10.0, 4.0]
    many = run(dae, signals=["mass.s", "mass.v"], parameters={"spring.k": k, "mass.m": 2.0})
    assert many.member(0).unit("mass.v") == "m/s"
    done = many.sweep(lambda member: {"peak": member.peak("mass.v"), "last": member["mass.s"][-1]})
    assert list(done.table.columns) == ["spring.k", "mass.m", "peak", "last", "error", "seconds"]
    assert done.table["spring.k"].tolist() == k
    assert done.table["peak"][2] == np.abs(many["mass.v"][2]).max()
    assert done.failed.index.tolist() == [1]
    with pytest.raises(ia.ModelError, match="this ensemble has none: give parameters="):
        run(dae).sweep(lambda member: member["mass.s"][-1])


def test_sobol_indices_of_an_ensemble(dae: ia.DAE) -> None:
    """The inertia alone decides where a mass ends that a constant force drives."""
    pytest.importorskip("SALib", reason="needs SALib")
    design = saltelli({"mass.m": (1.0, 2.0), "spring.k": (0.0, 1e-9)}, 64)
    many = run(dae, parameters=design, inputs={"push.f": 1.0}, starts={"mass.s": 0.0}, step=0.5)
    found = sobol_indices(many.sweep(lambda member: member["mass.s"][-1]))
    assert found["S1"].to_numpy() == pytest.approx([1.0, 0.0], abs=0.02)


def test_processes_and_threads_give_the_same(dae: ia.DAE) -> None:
    k = np.linspace(-10, 10, 200)
    here, there = (run(dae, parameters={"spring.k": k}, workers=workers) for workers in (0, 2))
    with ThreadPoolExecutor(2) as threads:
        beside = run(dae, parameters={"spring.k": k}, executor=threads)
    assert np.array_equal(here.values, there.values, equal_nan=True)
    assert np.array_equal(here.values, beside.values, equal_nan=True)
    assert dict(here.errors) == dict(there.errors) == dict(beside.errors)
    assert 1 < len(here.errors) < 100


def test_ctrl_c_keeps_what_is_done(dae: ia.DAE, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = iter(range(100))

    def third_time() -> None:
        if next(calls) == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr(crew, "heed", third_time)
    with pytest.raises(RunInterruptedError, match=r"interrupted: .* of 1000 members are done") as raised:
        run(dae, parameters={"spring.k": np.linspace(1, 10, 1000)})
    many = raised.value.result
    assert 0 < many.done < 1000
    assert np.isfinite(many.values[0]).all()
    assert "interrupted" in many.errors[999]
