"""Random trains of pulses on a free mass: whatever is given must be seen.

    python tests/fuzz/pulse_trains.py [--count 10000] [--seed 0] [--solvers cvodes,rosenbrock,compiled]

Pulses are rectangles, cosine bumps, Gaussians and triangles from a millionth of the run in width (data: a
ten-thousandth), given as functions of time, as data and as prescribed acceleration, from any start time on.
The mass must end with the velocity that the area under the pulses gives it, and at the place that their first
moment gives. A train that is not seen ends in a line that repeats it, and in exit code 1.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from inertance import Accelerate, Force, Mass, Network, Sampled, simulate

SHAPES = {
    "rectangle": (lambda s: ca.if_else(ca.logic_and(s > -0.5, s < 0.5), 1.0, 0.0), 1.0, 0.5),
    "bump": (lambda s: ca.if_else(ca.fabs(s) < 0.5, 0.5 + 0.5 * ca.cos(2 * np.pi * s), 0.0), 0.5, 0.5),
    "gaussian": (lambda s: ca.exp(-((8 * s) ** 2)), np.sqrt(np.pi) / 8, 1.0),
    "triangle": (lambda s: ca.fmax(0.0, 1 - 2 * ca.fabs(s)), 0.5, 0.5),
}
TOLERANCE = 1e-4


@dataclass(frozen=True)
class Train:
    """Pulses of one shape: heights, centres [s] and widths [s]."""

    shape: str
    heights: np.ndarray
    centres: np.ndarray
    widths: np.ndarray

    def __call__(self, t: Any) -> Any:
        shape: Any = SHAPES[self.shape][0]
        pulses = zip(self.heights, self.centres, self.widths, strict=True)
        return sum(height * shape((t - centre) / width) for height, centre, width in pulses)

    @property
    def areas(self) -> np.ndarray:
        areas: np.ndarray = self.heights * self.widths * SHAPES[self.shape][1]
        return areas


def drawn(rng: np.random.Generator, begin: float, span: float, narrowest: float) -> Train:
    count = int(rng.integers(1, 8))
    shape = str(rng.choice(list(SHAPES)))
    widths = span * 10 ** rng.uniform(np.log10(narrowest), -2, count)
    places = np.sort(rng.uniform(0.03, 0.97, count))
    heights = rng.choice([-1, 1], count) * 10 ** rng.uniform(0, 1, count) / widths  # so that each area counts
    return Train(shape, heights, begin + span * places, widths)


def as_data(train: Train, begin: float, stop: float) -> Sampled:
    """Return samples at 16 points a width of the narrowest pulse around pulses, and far apart elsewhere."""
    times = [np.linspace(begin, stop, 50)]
    for centre, width in zip(train.centres, train.widths, strict=True):
        times.append(np.linspace(max(begin, centre - 1.2 * width), min(stop, centre + 1.2 * width), 401))
    instants = np.unique(np.concatenate(times).round(13))
    return Sampled(instants, np.array(ca.Function("f", [T], [train(T)])(instants[None, :])).ravel())


T = ca.SX.sym("t")


def wagon(source: Any, port: str) -> Any:
    net = Network("wagon", source=source, mass=Mass(m=1.0))
    net.connect(net.source.flange, net.mass.flange)
    return net.dae(), f"source.{port}"


@dataclass
class Case:
    number: int
    kind: str
    solver: str
    begin: float
    span: float
    train: Train


def drawn_case(number: int, seed: int, solvers: list[str]) -> Case:
    rng = np.random.default_rng([seed, number])
    kind = str(rng.choice(["force", "data", "accelerate"], p=[0.7, 0.2, 0.1]))
    begin = float(rng.choice([0.0, 0.0, -3.0, 1e3]))
    span = float(10 ** rng.uniform(-1, 3))
    solver = str(rng.choice(solvers))
    if solver == "compiled":
        kind = "data"  # a function would be compiled each time
    train = drawn(rng, begin, span, 1e-4 if kind == "data" else 1e-6)
    return Case(number, kind, solver, begin, span, train)


def missed(case: Case, machines: dict[str, Any]) -> float:
    """Return the greater error of velocity and place at the end, over the size of what all pulses do."""
    dae, name = machines["accelerate" if case.kind == "accelerate" else "force"]
    stop = case.begin + case.span
    signal: Callable[[Any], Any] | Sampled = case.train
    areas, centres = case.train.areas, case.train.centres
    if case.kind == "data":
        from scipy.interpolate import CubicSpline

        signal = as_data(case.train, case.begin, stop)
        spline = CubicSpline(signal.time, signal.values)
        speeds = spline.antiderivative()
        speed = float(speeds(stop) - speeds(case.begin))
        place = float(spline.antiderivative(2)(stop) - spline.antiderivative(2)(case.begin))
        place -= float(speeds(case.begin)) * case.span
    else:
        speed, place = float(areas.sum()), float((areas * (stop - centres)).sum())
    run = simulate(
        dae, stop, begin=case.begin, inputs={name: signal}, solver=case.solver, rtol=1e-8, atol=1e-13
    )
    size = float(np.abs(areas).sum())
    off = abs(run["mass.v"][-1] - speed) / size, abs(run["mass.s"][-1] - place) / (size * case.span)
    return float(max(off))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--count", type=int, default=10_000, help="how many trains")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--solvers", default="cvodes,idas,rosenbrock,compiled")
    given = parser.parse_args()
    machines = {"force": wagon(Force(), "f"), "accelerate": wagon(Accelerate(), "a_ref")}
    worst, failed = 0.0, 0
    for number in range(given.count):
        case = drawn_case(number, given.seed, given.solvers.split(","))
        error = missed(case, machines)
        worst = max(worst, error)
        if error > TOLERANCE:
            failed += 1
            print(f"missed by {error:.2g}: {case}", flush=True)
        if (number + 1) % 1000 == 0:
            print(f"{number + 1} trains, {failed} missed, worst error {worst:.2g}", flush=True)
    print(f"{given.count} trains, {failed} missed, worst error {worst:.2g}")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
