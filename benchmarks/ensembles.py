"""Ensembles: 10 000 members side by side, against `simulate` by solver `compiled`, one after the other.

Costs are those of a member on one core: of all members for the ensemble, of the first 200 for `simulate`, of
few for SciPy's LSODA, which a pool of processes would divide. rtol 1e-6, atol 1e-8. `simulate` starts each
member in Python and returns a whole result; "its C program alone" is what is left without.

- cars: quarter cars with an inerter over a kerb, 3 s, smooth
- PFIs: planetary flywheel inerters on the rig, true sticking, 1 s at 3 Hz, 1001 outputs
- frames: three storeys with a tuned inerter damper under 20 s of an artificial earthquake, smooth
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import inertance as ia
import numpy as np
import pfi
import pypi
import sweep
from inertance.networks.simulation.bound_dae import bound
from measure import Contender, Cost, compare
from numpy.typing import NDArray
from peers import scipy_pfi
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from table import show

OTHERS = {"diffrax": "JAX, vmap, Tsit5", "heyoka": "Taylor's method, vectors, tol 1e-8"}
MEMBERS, ONE_BY_ONE, BY_SCIPY = 10_000, 200, 10
RTOL, ATOL = 1e-6, 1e-8
SMOOTH_TARGET, HYBRID_TARGET = 1 / 3, 1 / 1.8
STOREYS, M, K, D = 3, 1e3, 1.5e6, 1e3
ABSORBER_K, ABSORBER_D, ABSORBER_B = 3e4, 300.0, 200.0

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """What runs, and how often."""

    name: str
    dae: ia.DAE
    stop: float
    signal: str
    parameters: Mapping[str, Array]
    peer: Callable[[int], object]
    target: float
    inputs: Mapping[str, Any] | None = None
    start: Mapping[str, float] | None = None
    step: float | None = None

    @property
    def asked(self) -> dict[str, Any]:
        """What both ways are asked alike."""
        return {"inputs": self.inputs, "step": self.step, "rtol": RTOL, "atol": ATOL}

    def together(self) -> ia.Ensemble:
        """Run all members side by side."""
        return ia.ensemble(
            self.dae,
            self.stop,
            signals=self.signal,
            parameters=self.parameters,
            starts=self.start,
            **self.asked,
        )

    def one(self, member: int) -> ia.Result:
        """Run one member alone."""
        own = {name: float(values[member]) for name, values in self.parameters.items()}
        return ia.simulate(
            self.dae, self.stop, parameters=own, start=self.start, solver="compiled", **self.asked
        )


def factors(seed: int, **ranges: tuple[float, float]) -> dict[str, Array]:
    draw = np.random.default_rng(seed)
    return {name: draw.uniform(low, high, MEMBERS) for name, (low, high) in ranges.items()}


def cars() -> Case:
    drawn = {
        "strut.rest.damper.d": np.array([point[0] for point in sweep.DESIGN.points]),
        "strut.rest.inerter.b": np.array([point[1] for point in sweep.DESIGN.points]),
    }
    parameters = {name: np.resize(values, MEMBERS) for name, values in drawn.items()}

    def by_hand(member: int) -> object:
        return sweep.by_hand(sweep.DESIGN.points[member])

    inputs = {"road.s_ref": sweep.kerb}
    return Case(
        "quarter cars", sweep.build().dae(), sweep.STOP, "body.a", parameters, by_hand, SMOOTH_TARGET, inputs
    )


def pfis() -> Case:
    dae = pfi.reduced()
    nominal = dae.parameter_values
    drawn = factors(1, screw=(0.8, 1.2), inertia=(0.9, 1.1))
    parameters = {
        "inerter.screw.k": nominal["inerter.screw.k"] * drawn["screw"],
        "inerter.flywheel.J_p": nominal["inerter.flywheel.J_p"] * drawn["inertia"],
    }
    drive = scipy_pfi.Drive(pfi.AMPLITUDE, 2 * pi * pfi.FREQUENCY)

    def by_hand(_: int) -> object:
        return scipy_pfi.solve_hybrid(drive, pfi.GRID, method="LSODA", rtol=RTOL, atol=ATOL)

    return Case(
        "PFIs with stick-slip", dae, pfi.DURATION, pfi.FORCE, parameters, by_hand, HYBRID_TARGET,
        start=pfi.rolling(), step=pfi.STEP,
    )  # fmt: skip


def earthquake() -> tuple[Array, Array]:
    """Return the motion of the ground: sines of 0.5 to 8 Hz with random phases that swell and fade."""
    t, draw = np.arange(0.0, 20.01, 0.02), np.random.default_rng(0)
    frequencies, phases = np.linspace(0.5, 8.0, 60), draw.uniform(0, 2 * pi, 60)
    waves = np.sin(2 * pi * np.outer(t, frequencies) + phases) / frequencies**2
    return t, 0.01 * waves.sum(axis=1) * np.exp(-(((t - 6.0) / 4.0) ** 2))


def frames() -> Case:
    tid = ia.machines.tid(k=ABSORBER_K, d=ABSORBER_D, b=ABSORBER_B)
    frame = ia.machines.shear_frame([M] * STOREYS, [K] * STOREYS, [D] * STOREYS, {(0, 1): tid})
    drawn = factors(2, b=(0.5, 2.0), k=(0.8, 1.2))
    parameters = {"absorber1.inerter.b": ABSORBER_B * drawn["b"], "storey1.k": K * drawn["k"]}
    t, motion = earthquake()
    ground = CubicSpline(t, motion)
    moving = ground.derivative()

    def by_hand(member: int) -> object:
        b, k1 = (values[member] for values in parameters.values())
        stiffness = np.array([k1, *[K] * (STOREYS - 1)])

        def rates(at: float, x: Array) -> Array:
            s, v, r, w = x[:STOREYS], x[STOREYS:-2], x[-2], x[-1]
            s_0, v_0 = ground(at), moving(at)
            shear = stiffness * np.diff(s, prepend=s_0) + D * np.diff(v, prepend=v_0)
            pull = ABSORBER_K * (s[0] - s_0 - r) + ABSORBER_D * (v[0] - v_0 - w)
            f = -shear + np.append(shear[1:], 0.0)
            f[0] -= pull
            return np.concatenate([v, f / M, [w, pull / b]])

        grid = np.linspace(0.0, 20.0, 501)
        return solve_ivp(rates, (0.0, 20.0), np.zeros(2 * STOREYS + 2), "LSODA", grid, rtol=RTOL, atol=ATOL)

    inputs = {"ground.s_ref": ia.Sampled(t, motion)}
    return Case("frames", frame.dae(), 20.0, "floor3.s", parameters, by_hand, SMOOTH_TARGET, inputs)


def each(action: Callable[[], object], count: int) -> Callable[[], Cost]:
    """Return a go: the cost of one of `count` members that an action computes."""

    def go() -> Cost:
        wall, cpu = perf_counter(), process_time()
        action()
        return Cost((perf_counter() - wall) / count, (process_time() - cpu) / count)

    return go


def in_c(case: Case) -> Callable[[], Cost]:
    """Return a go: the cost of one member in the C program of `compiled` alone, without start and result."""
    native = bound(case.dae, case.inputs or {}).native
    run_in_c, spent = native.run, [0.0, 0.0]

    def timed(*given: Any) -> None:
        wall, cpu = perf_counter(), process_time()
        run_in_c(*given)
        spent[0] += perf_counter() - wall
        spent[1] += process_time() - cpu

    def go() -> Cost:
        spent[:] = [0.0, 0.0]
        native.run = timed  # type: ignore[method-assign]
        try:
            for member in range(ONE_BY_ONE):
                case.one(member)
        finally:
            native.run = run_in_c  # type: ignore[method-assign]
        return Cost(spent[0] / ONE_BY_ONE, spent[1] / ONE_BY_ONE)

    return go


class _Script:
    """The quarter cars of another library, which another interpreter may run: cost of one, and how exact."""

    def __init__(self, python: str, name: str) -> None:
        self.command = [python, str(Path(__file__).parent / "peers" / f"ensemble_{name}.py")]
        self.told: dict[str, Any] = {}

    def go(self) -> Cost:
        done = subprocess.run(self.command, check=True, capture_output=True, text=True)
        self.told = json.loads(done.stdout.splitlines()[-1])
        return Cost(self.told["wall"], self.told["cpu"])

    def error(self, case: Case) -> str:
        """Say how far the body's acceleration is from the exact one, as a share of its range."""
        own = {"strut.rest.damper.d": self.told["d"], "strut.rest.inerter.b": self.told["b"]}
        return off(case, own, np.array(self.told["a"]))


def off(case: Case, parameters: Mapping[str, float], found: Array) -> str:
    """Say how far a signal is from that of an exact run, as a share of its range."""
    exact = ia.simulate(
        case.dae, case.stop, parameters=parameters, inputs=case.inputs, start=case.start, step=case.step,
        rtol=1e-11, atol=1e-13, solver="compiled",
    )[case.signal]  # fmt: skip
    return f"error {np.abs(found - exact).max() / np.ptp(exact):.1e}"


def others(case: Case, python: str) -> tuple[list[Contender], list[str]]:
    """Return the other libraries that an interpreter has, and notes on those that it has not."""
    peers, notes = [], []
    for name, remark in OTHERS.items():
        version = pypi.version(python, name)
        if version is None:
            notes.append(f"{name} left out: not installed for {Path(python).name}; see --peers-python.")
            continue
        script = _Script(python, name)
        script.go()
        peers.append(Contender(f"{name} {version}", script.go, f"{remark}; {script.error(case)}"))
    return peers, notes


def apart(case: Case, many: ia.Ensemble) -> str:
    """Say how far members are from runs of their own, as a share of the range, and whether events agree."""
    most, events = 0.0, 0
    for member in range(0, ONE_BY_ONE, 10):
        run = case.one(member)
        alone = run[case.signal][np.searchsorted(run.time, many.time + 1e-12, side="right") - 1]
        most = max(most, float(np.abs(many[case.signal][member] - alone).max() / np.ptp(alone)))
        own = [event for event in run.events if event.time > 0]
        events += len(own) != len(many.events(member))
    return f"{most:.1e} of range apart, events differ in {events} of {ONE_BY_ONE // 10}"


def main(rounds: int, python: str = sys.executable) -> None:
    for make in (cars, pfis, frames):
        case = make()
        many = case.together()
        one_by_one = each(lambda case=case: [case.one(member) for member in range(ONE_BY_ONE)], ONE_BY_ONE)
        by_scipy = each(lambda case=case: [case.peer(member) for member in range(BY_SCIPY)], BY_SCIPY)
        peers = [
            Contender("`simulate` by `compiled`", one_by_one, apart(case, many), case.target),
            Contender("its C program alone", in_c(case), target=case.target),
            Contender("SciPy's LSODA", by_scipy),
        ]
        more, notes = others(case, python) if make is cars else ([], [])
        told = "{} lanes, efficiency {:.3f}, {} failed".format(
            many.stats["lanes"], many.stats["lane efficiency"], len(many.errors)
        )
        first = {name: float(values[0]) for name, values in case.parameters.items()}
        error = "" if case.target == HYBRID_TARGET else f", {off(case, first, many[case.signal][0])}"
        ours = Contender("ensemble", each(case.together, MEMBERS))
        title = f"Ensemble of {MEMBERS} {case.name} ({told}{error})"
        show(title, compare(ours, [*peers, *more], rounds), notes)


if __name__ == "__main__":
    main(3)
