"""FMUs without what a master costs: against `compiled`, and against the FMU of another tool in one master.

python benchmarks/fmu_bare.py [--rounds N] [--peer FMU] [MACHINE ...]

The master is peers/fmu_master.c, which needs a C compiler and SUNDIALS 6. The machines are those of
examples/fmu_models.py, in Co-Simulation; `compiled` is a whole run of `simulate`, at the tolerance asked for
and at the one that FMUs keep to inside. The peer is an FMU, with a binary for this machine, of the block that
`pendulum` builds: SpringFrictionPendulumExtForce1D by Dymola 2023x, from
https://github.com/ThummeTo/FMIZoo.jl. It takes turns with ours in this master and under FMPy.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import fmpy
import inertance as ia
import numpy as np
from c_program import LIBRARIES, MissingError
from measure import Contender, Cost, Ratio, compare, timed
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))
from fmu_models import CASES

SOURCE = Path(__file__).parent / "peers" / "fmu_master.c"
PRINTED = re.compile(r"wall (\S+) s, cpu (\S+) s, steps (\d+)")
RTOL, OWN_SHARE = 1e-6, 3e-2
TARGET, PEER_TARGET = 1.5, 0.8
SWING, INTERVALS = 10.0, 1000
KINDS = {"cs": "CoSimulation", "me": "ModelExchange"}


def pendulum() -> ia.Network:
    """A block on a spring, with Stribeck friction and stops, that a force may push."""
    net = ia.Network(
        "pendulum", fixed=ia.Fixed(s0=0.1), spring=ia.Spring(k=10.0, s_rel0=1.0), push=ia.Force()
    )
    net.add(mass=ia.MassWithStopAndFriction(
        m=1.0, s_min=-25.0, s_max=25.0, d=0.05, f_c=0.25, f_s=0.75, v_s=0.5, s=0.5, v=0.0
    ))  # fmt: skip
    net.connect(net.fixed.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def master(folder: Path) -> Path:
    """Return the compiled master.

    Raises:
        MissingError: without a C compiler or SUNDIALS.
    """
    compiler, program = shutil.which("cc"), folder / "fmu_master"
    if compiler is None:
        raise MissingError("no C compiler `cc`")
    headers, libraries = Path(fmpy.__file__).parent / "c-code", [f"-lsundials_{name}" for name in LIBRARIES]
    command = [compiler, "-std=c99", "-O2", f"-I{headers}", SOURCE, "-o", program, *libraries, "-ldl", "-lm"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise MissingError(f"needs SUNDIALS 6 (libsundials-dev): {done.stderr.splitlines()[0]}")
    return program


@dataclass
class Bare:
    """An FMU in the master in C, instantiated anew for each run."""

    program: Path
    path: Path
    inside: Path
    outputs: Sequence[str]
    stop: float
    intervals: int

    def __post_init__(self) -> None:
        fmpy.extract(str(self.path), unzipdir=str(self.inside))
        self.description: Any = fmpy.read_model_description(str(self.path))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}

    def _printed(self, kind: str, runs: int, rows: str = "-") -> tuple[str, ...]:
        d = self.description
        library = self.inside / "binaries" / "linux64" / f"{d.coSimulation.modelIdentifier}.so"
        given = (
            kind, library, d.guid, (self.inside / "resources").as_uri(),
            self.stop, self.intervals, RTOL, runs,
            d.numberOfContinuousStates, d.numberOfEventIndicators,
            int(not d.modelExchange.completedIntegratorStepNotNeeded), rows,
            *(self.references[name] for name in self.outputs),
        )  # fmt: skip
        done = subprocess.run([self.program, *map(str, given)], check=True, capture_output=True, text=True)
        printed = PRINTED.match(done.stdout)
        assert printed
        return printed.groups()

    def go(self, kind: str) -> Cost:
        """Return the median cost of a few runs."""
        return Cost(*map(float, self._printed(kind, 9)[:2]))

    def under_fmpy(self, kind: str) -> None:
        """Run once under FMPy."""
        fmpy.simulate_fmu(
            str(self.inside), model_description=self.description, fmi_type=KINDS[kind], stop_time=self.stop,
            output_interval=self.stop / self.intervals, relative_tolerance=RTOL, validate=False,
            output=list(self.outputs),
        )  # fmt: skip

    def off(self, kind: str, exact: ia.Result) -> float:
        """Return by how much outputs miss a run, as a share of its range, but for 1 % of the points."""
        rows = self.inside / "rows.csv"
        self._printed(kind, 1, str(rows))
        return missed(np.loadtxt(rows, delimiter=","), exact, self.outputs)


def missed(rows: NDArray[np.float64], exact: ia.Result, outputs: Sequence[str]) -> float:
    """Return what `Bare.off` tells of rows of time and outputs; at jumps the side is a matter of rounding."""
    errors = (
        np.quantile(np.abs(rows[:, 1 + k] - exact.at(name, rows[:, 0])), 0.99) / np.ptp(exact[name])
        for k, name in enumerate(outputs)
    )
    return float(max(errors))


def told(name: str, ratio: Ratio) -> None:
    print(f"{name} over {ratio.contender.name}: CPU {ratio.cpu}, wall {ratio.wall} {ratio.met}", flush=True)


def against_compiled(name: str, program: Path, folder: Path, rounds: int) -> None:
    """Print what a machine costs as an FMU in Co-Simulation, over `compiled`."""
    case = CASES[name]
    step = case.step or case.stop / 500
    dae, path = case.build().dae(), folder / f"{name}.fmu"
    ia.export_fmu(dae, path, start=case.start, outputs=case.outputs, tolerance=RTOL)
    fmu = Bare(program, path, folder / name, case.outputs, case.stop, round(case.stop / step))
    inputs = dict.fromkeys(case.inputs, 0.0)

    def native(rtol: float) -> ia.Result:
        return ia.simulate(
            dae, case.stop, step=step, start=case.start, inputs=inputs, solver="compiled", rtol=rtol,
            atol=1e-2 * rtol, progress=False,
        )  # fmt: skip

    exact, run = native(1e-10), native(RTOL)
    times = np.linspace(0.0, case.stop, fmu.intervals + 1)
    rows = np.column_stack([times, *(run.at(output, times) for output in case.outputs)])
    ours, theirs = fmu.off("cs", exact), missed(rows, exact, case.outputs)
    print(f"{name}: bare CS off by {ours:.1e}, compiled by {theirs:.1e}")
    peers = [
        Contender("compiled", timed(partial(native, RTOL)), target=TARGET),
        Contender("compiled at its own tolerance", timed(partial(native, OWN_SHARE * RTOL))),
    ]
    for ratio in compare(Contender("bare CS", partial(fmu.go, "cs")), peers, rounds):
        told(f"{name}: bare CS", ratio)


def against_peer(path: Path, program: Path, folder: Path, rounds: int) -> None:
    """Print what the block costs as an FMU, over the other tool's FMU in the same master."""
    outputs = ["mass.s", "mass.v"]
    own = folder / "pendulum.fmu"
    ia.export_fmu(pendulum(), own, outputs=outputs, tolerance=RTOL)
    ours, theirs = (
        Bare(program, file, folder / inside, outputs, SWING, INTERVALS)
        for file, inside in ((own, "ours"), (path, "theirs"))
    )
    exact = pendulum().simulate(SWING, inputs={"push.f": 0.0}, rtol=1e-11, atol=1e-13, step=SWING / INTERVALS)
    for kind in KINDS:
        errors = ours.off(kind, exact), theirs.off(kind, exact)
        print(f"{kind.upper()}: ours off by {errors[0]:.1e}, theirs by {errors[1]:.1e}")
        bare = Contender("theirs, bare", partial(theirs.go, kind), target=PEER_TARGET)
        told(f"{kind.upper()}: ours", compare(Contender("ours", partial(ours.go, kind)), [bare], rounds)[0])
        under = Contender("theirs under FMPy", timed(partial(theirs.under_fmpy, kind)), target=PEER_TARGET)
        mine = Contender("ours", timed(partial(ours.under_fmpy, kind)))
        told(f"{kind.upper()}: ours", compare(mine, [under], rounds)[0])


def main(machines: Sequence[str], peer: Path | None, rounds: int) -> None:
    """Measure and print."""
    with TemporaryDirectory(prefix="inertance-") as name:
        folder = Path(name)
        program = master(folder)
        for machine in machines or CASES:
            against_compiled(machine, program, folder, rounds)
        if peer is not None:
            against_peer(peer, program, folder, rounds)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("machines", nargs="*", choices=[*CASES, []], metavar="MACHINE")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--peer", type=Path)
    given = parser.parse_args()
    main(given.machines, given.peer, given.rounds)
