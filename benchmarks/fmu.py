"""Exported FMUs under FMPy against the native run, and what an export costs.

python benchmarks/fmu.py [--rounds N] [--masses N]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

import fmpy
import inertance as ia
from inertance.machines import Sinusoid
from measure import Contender, Cost, compare, timed

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))
from fmu_models import CASES, chain

STOP, STEP, RTOL = 1.0, 1e-3, 1e-6
TARGET = 2.0


def rig() -> tuple[ia.DAE, dict[str, float]]:
    """Return the planetary flywheel inerter on its rig, and how it starts."""
    net = ia.machines.inerter_rig(ia.machines.ge_wang.planetary_inerter(), Sinusoid(0.01, 3.0))
    return net.dae(), CASES["pfi_rig"].start


def run(path: Path, folder: str, kind: str) -> Contender:
    """Return an FMU under FMPy, unpacked, with its description read, and instantiated anew for each run."""
    description = fmpy.read_model_description(str(path))

    def go() -> None:
        fmpy.simulate_fmu(
            folder, model_description=description, fmi_type=kind, stop_time=STOP, output_interval=STEP,
            relative_tolerance=RTOL, validate=False,
        )  # fmt: skip

    return Contender(f"FMI {description.fmiVersion} {kind}", timed(go))


def exporting(name: str, dae: ia.DAE, start: dict[str, float], folder: Path) -> None:
    """Print what an export takes: to generate, and to compile."""
    began = perf_counter()
    ia.export_fmu(dae, folder / "sources.fmu", start=start, platforms=[])
    generated = perf_counter() - began
    began = perf_counter()
    ia.export_fmu(dae, folder / "whole.fmu", start=start)
    compiled = perf_counter() - began - generated
    size = (folder / "whole.fmu").stat().st_size / 1e3
    print(f"export of {name}: generate {generated:.2f} s, compile {compiled:.2f} s, {size:.0f} kB")


def against_native(
    name: str,
    dae: ia.DAE,
    start: dict[str, float],
    outputs: list[str],
    kinds: list[str],
    rounds: int,
    folder: Path,
) -> None:
    """Print what FMUs of a network cost under FMPy, over the native run."""
    options = {"start": start, "step": STEP, "rtol": RTOL, "atol": 1e-2 * RTOL}
    native = Contender("native", timed(lambda: ia.simulate(dae, STOP, **options)), target=TARGET)
    for version in ("2.0", "3.0"):
        path = folder / f"benchmark{version[0]}.fmu"
        ia.export_fmu(dae, path, fmi_version=version, start=start, outputs=outputs, tolerance=RTOL)
        inside = fmpy.extract(str(path), unzipdir=str(folder / f"{name}{version}"))
        for kind in kinds:
            contender = run(path, inside, kind)
            ratio = compare(contender, [native], rounds)[0]
            costs: list[Cost] = [contender.go() for _ in range(3)]
            wall = 1e3 * median(cost.wall for cost in costs)
            told = f"(target {TARGET:g}: {ratio.met})" if kind == "CoSimulation" else ""
            spent = f"CPU {ratio.cpu}, wall {ratio.wall} {told} {wall:.0f} ms"
            print(f"{name}: {contender.name} over native: {spent}", flush=True)


def main(rounds: int, masses: int) -> None:
    """Measure and print."""
    dae, start = rig()
    chained, both = chain(masses).dae(), ["CoSimulation", "ModelExchange"]
    with TemporaryDirectory(prefix="inertance-") as name:
        folder = Path(name)
        against_native("rig", dae, start, ["inerter.flange_a.f"], both, rounds, folder)
        against_native(f"{masses} masses", chained, {}, CASES["chain"].outputs, both[:1], rounds, folder)
        exporting("the rig", dae, start, folder)
        exporting(f"{masses} masses", chained, {}, folder)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--masses", type=int, default=1000)
    given = parser.parse_args()
    main(given.rounds, given.masses)
