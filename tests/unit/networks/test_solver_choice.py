"""What solver "auto" stands for: compiled where that pays, and why."""

import os
from pathlib import Path
from time import sleep
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.machines import Sinusoid, ge_wang, inerter_rig
from inertance.networks import foresee
from inertance.networks.csource import toolchain
from inertance.networks.csource.native import Native
from inertance.networks.csource.toolchain import ToolchainError, compiler
from inertance.networks.simulation import solver_choice
from inertance.networks.simulation.bound_dae import bound
from inertance.networks.simulation.integrator import IntegratorError
from inertance.networks.simulation.solver_choice import Account

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

OWN = {name: getattr(Account, name) for name in ("told", "_begin")}


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache that holds nothing of other tests; those here share a core, and tell their networks apart."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(autouse=True)
def interpreted(monkeypatch: pytest.MonkeyPatch, cache: Path) -> None:
    """Here the choice is what other tests leave out, on a machine that has compiled nothing before."""
    for name, method in OWN.items():
        monkeypatch.setattr(Account, name, method)
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))


@pytest.fixture
def soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solver_choice, "COMPILE_SECONDS", 0.0)
    monkeypatch.setattr(solver_choice, "WRITE_SECONDS", 0.0)


def swing(name: str = "swing", k: float = 4.0) -> ia.Network:
    net = ia.Network(name, wall=ia.Fixed(), spring=ia.Spring(k=k), mass=ia.Mass(m=1.0, s=1.0))
    return net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)


def how(dae: ia.DAE, **options: Any) -> tuple[str, str]:
    run = ia.simulate(dae, 1.0, **options)
    return run.stats["solver"], run.stats["why"]


def wait_for(dae: ia.DAE) -> None:
    closed = bound(dae, {})
    while not closed.program.is_ready(closed):
        sleep(0.01)


def test_a_short_run_is_interpreted() -> None:
    solver, why = how(swing().dae())
    assert solver == "cvodes"
    assert why == "its runs have taken 0 s, and compiling pays from 0.25 s on"


def test_a_model_is_compiled_beside_its_runs_and_kept(soon: None) -> None:
    dae = swing("kept").dae()
    first = ia.simulate(dae, 1.0)
    wait_for(dae)
    again = ia.simulate(dae, 1.0)
    assert [run.stats["solver"] for run in (first, again)] == ["cvodes", "compiled"]
    assert again["mass.s"] == pytest.approx(np.cos(2 * again.time), abs=1e-6)
    other = swing("kept", k=9.0).dae()
    solver, why = how(other)
    assert (solver, why) == ("compiled", "it was compiled before")
    assert how(other, parameters={"spring.k": 1.0})[0] == "compiled"


def test_after_a_long_run_the_next_waits_for_the_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    dae = swing("long").dae()
    clock = iter(np.arange(0.0, 100.0, 10.0))  # s: every look at it is ten seconds later
    monkeypatch.setattr(solver_choice, "thread_time", lambda: float(next(clock)))
    assert how(dae)[0] == "cvodes"
    assert how(dae)[0] == "compiled"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes that fork")
def test_a_forked_process_compiles_for_itself(soon: None) -> None:
    dae = swing("forking").dae()
    assert how(dae)[0] == "cvodes"
    assert bound(dae, {}).program.is_begun
    child = os.fork()
    if child == 0:  # where nobody will ever tell what the other process has compiled
        os._exit(0 if not bound(dae, {}).program.is_begun and how(dae)[0] == "compiled" else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_what_is_foreseen_is_compiled_at_once() -> None:
    few, many = swing("few").dae(), swing("many").dae()
    foresee(few, 39_999)
    foresee(many, 40_000)
    assert how(few)[0] == "cvodes"
    assert how(many) == ("compiled", "runs of 40000 samples are foreseen")
    assert how(many, solver="idas") == ("idas", "it was asked for")


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ({"sensitivities": ["spring.k"]}, "sensitivities are followed"),
        ({"rtol": 1e-11}, "rtol is below 1e-10"),
    ],
)
def test_what_only_multistep_methods_do_is_theirs(options: Any, why: str) -> None:
    dae = swing().dae()
    foresee(dae, 10**6)
    assert how(dae, **options) == ("cvodes", why)


def test_without_a_compiler_runs_are_interpreted_and_say_so(
    soon: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing(platform: str | None = None) -> list[str]:
        raise ToolchainError("no C compiler was found; install one")

    monkeypatch.setattr(toolchain, "compiler", missing)
    dae = swing().dae()
    foreseen = swing().dae()
    foresee(foreseen, 10**6)
    assert [how(each)[0] for each in (dae, dae, foreseen)] == ["cvodes"] * 3
    assert how(dae)[1] == how(foreseen)[1] == "no C compiler was found; install one"


def test_a_compiler_that_refuses_is_asked_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CFLAGS", "-no-such-flag")
    dae = swing().dae()
    foresee(dae, 10**6)
    for _ in range(2):
        solver, why = how(dae)
        assert solver == "cvodes"
        assert "could not compile the network" in why


def test_what_fails_compiled_is_run_again(monkeypatch: pytest.MonkeyPatch) -> None:
    def stuck(*_: Any) -> None:
        raise IntegratorError("no step was small enough")

    dae = swing("failing").dae()
    foresee(dae, 10**6)
    monkeypatch.setattr(Native, "run", stuck)
    with pytest.raises(ia.SimulationError, match="no step was small enough"):
        ia.simulate(dae, 1.0, max_steps=1000)  # who grants so many does not grant them twice
    solver, why = how(dae)
    assert solver == "cvodes"
    assert why.startswith("compiled it failed: 'failing': integration failed")
    assert how(dae) == (solver, why)
    foresee(dae, 0)
    assert how(dae) == (solver, why)


def test_across_events_compiled_runs_are_as_exact(soon: None) -> None:
    dae = inerter_rig(ge_wang.planetary_inerter(), Sinusoid(0.01, 3.0)).dae()
    exact = ia.simulate(dae, 0.5, rtol=1e-10, atol=1e-14, solver="cvodes")
    usual = ia.simulate(dae, 0.5)
    wait_for(dae)
    ours = ia.simulate(dae, 0.5)
    assert (usual.stats["solver"], ours.stats["solver"]) == ("cvodes", "compiled")
    assert len(ours.events) == len(exact.events) > 20
    grid = np.linspace(0.01, 0.49, 300)

    def off(run: ia.Result) -> float:
        sought = [exact.at(name, grid) for name in dae.state_names]
        found = [run.at(name, grid) for name in dae.state_names]
        return max(float(np.abs(f - s).max() / np.ptp(s)) for f, s in zip(found, sought, strict=True))

    assert off(ours) < 1.3 * off(usual)
    assert ours.stats["rtol"] == 1e-6
    foresee(dae, 10**6)  # to tolerances that are chosen for them
    assert ia.simulate(dae, 0.5).stats["steps"] < ours.stats["steps"]
