"""A quarter car cut in two: what co-simulation costs, by the cut and by the communication step.

Body and wheel become FMUs that are solved apart and exchange what acts between them at communication points.
Three cuts are compared with the car in one piece:

- at the body: the strut belongs to the wheel side, the body takes its force and gives its motion;
- at the wheel: the strut belongs to the body side, the wheel takes its force and gives its motion;
- through the strut: both sides hold it, and give each other their motion (displacement/displacement).

What a side takes is held over a step, or follows the line through the last two exchanges. An FMU of FMI 2.0
is told the slope (fmi2SetRealInputDerivatives); FMI 3.0 has no such call, so it gets the mean over the step.

    python examples/cosimulation.py [--out DIR]
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
from fmpy.ssp.simulation import simulate_ssp
from inertance import Network, Result
from inertance.fmu import Split, SystemStructure
from matplotlib.figure import Figure
from numpy.typing import NDArray

Array = NDArray[np.float64]

STOP = 2.0
STEPS = (10e-3, 5e-3, 2.5e-3, 1.25e-3, 0.625e-3)
VERSIONS = ("2.0", "3.0")
ORDERS = {0: "held", 1: "line"}
STYLES = {"FMI 2": "o-", "FMI 3": "x--", "FMPy,": "s:"}
TOLERANCE = 1e-9


@dataclass(frozen=True)
class Study:
    """Errors of one cut in one way of exchanging, by communication step.

    Attributes:
        cut: where the car was cut.
        way: FMI version and extrapolation, or the other master.
        steps: communication steps [s].
        errors: largest error of the body's position, of its range [1].
    """

    cut: str
    way: str
    steps: tuple[float, ...]
    errors: Array

    @property
    def slopes(self) -> Array:
        """Powers of the step with which the error falls, from each step to the next."""
        falls: Array = np.diff(np.log(self.errors)) / np.diff(np.log(self.steps))
        return falls


def quarter_car() -> Network:
    """Return a quarter car on a wavy road: 2 cm, 2 Hz; strut 20 kN/m and 1.5 kN.s/m."""
    car = Network(
        "quarter car",
        wave=ia.signals.Sine(amplitude=0.02, f=2.0),
        road=ia.Position(),
        tyre=ia.Spring(k=150e3),
        wheel=ia.Mass(m=35.0),
        strut=ia.SpringDamper(k=20e3, d=1.5e3),
        body=ia.Mass(m=250.0),
    )
    car.connect(car.wave.y, car.road.s_ref)
    car.connect(car.road.flange, car.tyre.flange_a)
    car.connect(car.tyre.flange_b, car.wheel.flange, car.strut.flange_a)
    return car.connect(car.strut.flange_b, car.body.flange)


def cuts(car: Network) -> dict[str, Split]:
    """Return the car cut in three ways, into the sides `body` and `wheel`."""
    wheel = ["wave", "road", "tyre", "wheel"]
    return {
        "at the body": ia.fmu.split(car, ["body"], names=("body", "wheel")),
        "at the wheel": ia.fmu.split(car, wheel, names=("wheel", "body")),
        "through the strut": ia.fmu.split(car, ["body"], through=["strut"], names=("body", "wheel")),
    }


def system(cut: Split, folder: Path, version: str) -> SystemStructure:
    """Export both sides and write the system as an .ssp file beside them."""
    folder.mkdir(parents=True, exist_ok=True)
    found = cut.export(
        folder, fmi_version=version, outputs=["body.s"], tolerance=TOLERANCE, stop=STOP, sources=False
    )
    found.write(folder / "quarter_car.ssp")
    return found


def error(truth: Result, time: Array, s: Array) -> float:
    """Return the largest error of the body's position at the instants of the truth, of its range."""
    inside = truth.time <= time[-1] + 1e-9
    errors = np.interp(truth.time[inside], time, s) - truth["body.s"][inside]
    return float(np.abs(errors).max() / np.ptp(truth["body.s"]))


def coupled(run: Any, truth: Result) -> float:
    """Return the error of a run of the system."""
    return error(truth, run.time, run["body.body.s"])


def by_fmpy(path: Path, truth: Result, step: float) -> float:
    """Return the error of FMPy as the master; its rows hold the end of the step that begins at `time`."""
    rows = simulate_ssp(str(path), stop_time=STOP, step_size=step)
    start = [0.0], [truth["body.s"][0]]
    time, s = (np.concatenate(p) for p in zip(start, (rows["time"] + step, rows["body.body.s"]), strict=True))
    return error(truth, time, s)


def study(folder: Path, steps: tuple[float, ...] = STEPS, versions: Iterable[str] = VERSIONS) -> list[Study]:
    """Run every cut in every way."""
    car = quarter_car()
    truth = car.simulate(STOP, step=max(steps), rtol=1e-11, atol=1e-13)
    found = []
    for cut, sides in cuts(car).items():
        for version in versions:
            where = folder / cut.replace(" ", "_") / version
            joined = system(sides, where, version)
            for order, way in ORDERS.items():
                options: dict[str, Any] = {"order": order, "halving": False, "rtol": TOLERANCE}
                errors = [
                    coupled(joined.simulate(communication_step=step, **options), truth) for step in steps
                ]
                found.append(Study(cut, f"FMI {version}, {way}", steps, np.array(errors)))
            if version == "2.0":
                errors = [by_fmpy(where / "quarter_car.ssp", truth, step) for step in steps]
                found.append(Study(cut, "FMPy, held", steps, np.array(errors)))
    return found


def print_table(studies: list[Study]) -> None:
    """Print errors by step, and the slope between the last two steps."""
    steps = "".join(f"{1e3 * step:>10g}" for step in studies[0].steps)
    print("largest error of the body's position, of its range, by communication step [ms]")
    print(f"{'':34}{steps}   slope")
    for one in studies:
        errors = "".join(f"{e:10.1e}" for e in one.errors)
        print(f"{one.cut:18}{one.way:16}{errors}{one.slopes[-1]:8.2f}")


def picture(studies: list[Study]) -> Figure:
    """Plot errors over the step, a panel for each cut."""
    names = list(dict.fromkeys(one.cut for one in studies))
    figure = Figure(figsize=(12, 4.5), layout="constrained")
    panels = figure.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    for axes, cut in zip(panels, names, strict=True):
        axes.set_title(f"cut {cut}")
        axes.set_xlabel("communication step [ms]")
        for one in (s for s in studies if s.cut == cut):
            label = f"{one.way}: slope {one.slopes[-1]:.2f}"
            axes.loglog(1e3 * np.array(one.steps), one.errors, STYLES[one.way[:5]], label=label)
        axes.grid(which="both", alpha=0.3)
        axes.legend(fontsize=8)
    panels[0].set_ylabel("largest error of the body's position, of its range")
    return figure


def main() -> None:
    """Print the table and write the picture."""
    parser = argparse.ArgumentParser(description="A quarter car cut in two, as FMUs in an SSP.")
    parser.add_argument("--out", type=Path, default=Path("out"), help="directory for results (%(default)s)")
    out = parser.parse_args().out
    studies = study(out / "cosimulation")
    print_table(studies)
    path = out / "cosimulation.png"
    picture(studies).savefig(path, dpi=150)
    print(f"wrote {path}, and an .ssp file for each cut in {out / 'cosimulation'}")


if __name__ == "__main__":
    main()
