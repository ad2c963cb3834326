"""A folder of published FMUs with reference results, tried in every importer that is installed.

    python examples/publish_fmus.py FOLDER [NAME ...]

writes the machines of `fmu_models.py` as FMI 2.0 and 3.0, for Model Exchange and Co-Simulation, in the
layout of the FMI project's cross-check (its rules, version 4.1):
`fmus/2.0/cs/linux64/inertance/VERSION/NAME/` has `NAME.fmu`, `NAME_ref.csv` and `NAME_ref.opt` from the
native run, and `NAME_in.csv` where there are inputs. FMPy's validator looks at each, and each importer of
`fmu_importers.py` runs it, whose `passed` or `failed` goes under `results/`. The table is printed and
written to `FOLDER/README.md`. The exit code is 1 if a validator or an importer complains.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import fmpy
import inertance as ia
import numpy as np
from fmpy.validation import validate_fmu
from fmu_importers import IMPORTERS, ImporterError, imported
from fmu_models import CASES, Case

STEPS, TOLERANCE, REFERENCE_TOLERANCE = 500, 1e-8, 1e-11
LIMIT = 1e-4  # of a variable's size
SAME_INSTANT = 1e-6  # of an event, around which nothing is compared [s]


@dataclass(frozen=True)
class Published:
    """One machine as one file, and what the native run says of it."""

    name: str
    version: str
    path: Path
    step: float
    reference: ia.Result
    outputs: tuple[str, ...]

    def off(self, times: np.ndarray, values: np.ndarray) -> float:
        """Return the greatest deviation apart from events, as a share of each output's size."""
        run = self.reference
        events = np.array([event.time for event in run.events] or [-np.inf])
        apart = np.abs(times[:, None] - events).min(axis=1) > SAME_INSTANT
        apart &= times < run.time[-1] * (1 + 1e-9)
        if not apart.any() or times.max() < run.time[-1] - 1.5 * self.step:
            return np.inf
        rows = np.searchsorted(run.time, times[apart] + 1e-9 * self.step, side="right") - 1
        aligned = np.abs(run.time[rows] - times[apart]) < 1e-6 * self.step
        if not aligned.any():
            return np.inf
        wanted = np.array([run[name][rows] for name in self.outputs]).T
        sizes = np.array([np.abs(run[name]).max() for name in self.outputs])
        return float((np.abs(values[apart] - wanted) / sizes)[aligned].max(initial=0.0))


def publish(folder: Path, name: str, version: str) -> Published:
    """Write one machine in one version of FMI, its reference and what goes with it, once for each kind."""
    case = CASES[name]
    step = case.stop / STEPS
    machine = _fed(case)
    run = machine.simulate(
        case.stop, step=step, start=case.start, rtol=REFERENCE_TOLERANCE, atol=1e-2 * REFERENCE_TOLERANCE
    )
    written: list[Path] = []
    for kind in ("me", "cs"):
        place = folder / "fmus" / version / kind / fmpy.platform / "inertance" / ia.__version__ / name
        place.mkdir(parents=True, exist_ok=True)
        path = place / f"{name}.fmu"
        if written:
            path.write_bytes(written[0].read_bytes())
        else:
            ia.export_fmu(
                machine, path, fmi_version=version, outputs=case.outputs, inputs=list(case.inputs),
                start=case.start, stop=case.stop, step=step, tolerance=TOLERANCE,
            )  # fmt: skip
        written.append(path)
        outputs = tuple(
            v.name for v in fmpy.read_model_description(str(path)).modelVariables if v.causality == "output"
        )
        _table(place / f"{name}_ref.csv", run.time, {n: run[n] for n in outputs})
        if case.inputs:
            ends = np.array([0.0, case.stop])
            _table(place / f"{name}_in.csv", ends, {n: np.full(2, v) for n, v in case.inputs.items()})
        options = {"StartTime": 0.0, "StopTime": case.stop, "StepSize": step if kind == "cs" else 0.0}
        options |= {"RelTol": TOLERANCE, "OutputIntervalLength": step}
        (place / f"{name}_ref.opt").write_text(
            "".join(f"{key}, {value!r}\n" for key, value in options.items())
        )
        (place / "README.md").write_text(
            f"# {name}\n\n{case.build.__doc__}\n\nWritten by inertance {ia.__version__}.\n"
        )
    return Published(name, version, written[0], step, run, outputs)


def _fed(case: Case) -> ia.Network:
    """Return the machine with its inputs at their values, which become start values of the FMU."""
    machine = case.build()
    for path, value in case.inputs.items():
        component, _, name = path.partition(".")
        setattr(getattr(machine, component), name, value)
    return machine


def _table(path: Path, time: np.ndarray, columns: dict[str, np.ndarray]) -> None:
    rows = np.column_stack([time, *columns.values()])
    rows = rows[np.append(np.diff(time) > 0, True)]  # of two points at one time that after the event
    header = ",".join(f'"{name}"' for name in ("time", *columns))
    np.savetxt(path, rows, fmt="%.12g", delimiter=",", header=header, comments="")


@dataclass(frozen=True)
class Tried:
    """What an importer made of one file: how far off, or why it failed."""

    importer: str
    file: Published
    kind: str
    off: float
    told: str = ""

    @property
    def good(self) -> bool:
        """Whether it passed."""
        return self.off <= LIMIT


def tried(folder: Path, file: Published, names: Sequence[str]) -> Iterator[Tried]:
    """Run one file in importers, and leave `passed` or `failed` where the cross-check looks for it."""
    for name in names:
        importer = IMPORTERS[name]
        for kind in importer.kinds if file.version in importer.versions else ():
            try:
                off, told = (
                    file.off(*imported(name, file.path, file.version, kind, file.step, STEPS, TOLERANCE)),
                    "",
                )
            except ImporterError as error:
                off, told = np.inf, str(error)
            found = Tried(name, file, kind, off, told)
            place = folder / "results" / file.version / kind.lower() / fmpy.platform / name / importer.version
            place = place / "inertance" / ia.__version__ / file.name
            place.mkdir(parents=True, exist_ok=True)
            (place / ("passed" if found.good else "failed")).write_text(told)
            yield found


def report(found: Sequence[Tried]) -> str:
    """Return the table of importers: what each ran, and the greatest deviation."""
    lines = ["| importer | version | kinds | FMUs | passed | farthest off |", "|---|---|---|---|---|---|"]
    for name, importer in IMPORTERS.items():
        for kind in importer.kinds:
            mine = [t for t in found if (t.importer, t.kind) == (name, kind)]
            if not mine:
                continue
            good, worst = [t for t in mine if t.good], max(mine, key=lambda t: t.off)
            versions = ", ".join(sorted({t.file.version for t in mine}))
            far = (
                f"{worst.off:.1e}, {worst.file.name} {worst.file.version}"
                if np.isfinite(worst.off)
                else "no end"
            )
            lines.append(
                f"| {name} | {importer.version} | {kind}, {versions} | {len(mine)} | {len(good)} | {far} |"
            )
    return "\n".join([*lines, "", f"{date.today():%d %B %Y}, inertance {ia.__version__}, {fmpy.platform}."])


def main(arguments: Sequence[str]) -> int:
    """Write the folder, try what is in it, and return the exit code."""
    folder, names = Path(arguments[0]), arguments[1:] or list(CASES)
    present = [name for name, importer in IMPORTERS.items() if importer.version]
    found, problems = list[Tried](), 0
    for name in names:
        for version in ("2.0", "3.0"):
            file = publish(folder, name, version)
            complaints = validate_fmu(str(file.path))
            problems += len(complaints)
            print(f"{name} {version}: {'; '.join(complaints) or 'valid'}", flush=True)
            for one in tried(folder, file, present):
                print(f"  {one.importer:10} {one.kind}  {one.off:.1e}  {one.told[-200:]}", flush=True)
                found.append(one)
    text = report(found)
    (folder / "README.md").write_text(f"# FMUs of inertance\n\n{text}\n")
    print(f"\n{text}")
    return int(problems > 0 or not all(one.good for one in found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
