"""Do 95 % intervals hold the truth? Fits of machines whose parameters are known, by what disturbs records.

    python benchmarks/intervals.py [--fits 600] [--seed 1] [--jobs 2] [--out intervals.json]

The machines are integrated from equations written out here: an oscillator whose spring hardens, two masses
on a table whose motion is prescribed, a slide that rubs. Their parameters are drawn within 20 % of what the
model says, which knows nothing of them but wide bounds. Three records of 12 s at 200 Hz begin in motion and
hold white noise; noise that is coloured; white noise and a random force on the machine that nobody measured;
white noise and a law that the model lacks. The size of noise is never stated. Told is how many of the
intervals hold the true parameter, by profiles of the misfit and by 1.96 standard errors. Where a law is
missing, that is told of a fit, which knows nothing of it, and of a diagnosis of the same records.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
from blind.measures import wilson
from inertance.identification import Campaign, Interval, Record
from numpy.typing import NDArray

Array = NDArray[np.float64]
Signal = Callable[[Any], Any]
Numbers = Mapping[str, float]
RATE, BEGIN, LENGTH, STEP = 200.0, 3.0, 12.0, 1e-4  # [Hz], [s] before a record, [s], [s]
RECORDS = 3
NOISE_SHARE = 0.02  # of the root mean square of a channel
LEVEL, QUANTILE = 0.95, 1.959964
DISTURBANCES = ("white noise", "coloured noise", "random force", "missing law")


def tones(draw: np.random.Generator, low: float, high: float, rms: float, count: int = 100) -> Signal:
    """Return a sum of sines."""
    rate = 2 * np.pi * draw.uniform(low, high, count)
    phase = draw.uniform(0, 2 * np.pi, count)
    size = rms * (2 / count) ** 0.5
    return lambda t: size * np.sin(np.multiply.outer(t, rate) + phase).sum(axis=-1)


@dataclass(frozen=True)
class Bench:
    """A machine: its nominal parameters, its model, its channels, what drives it, and how it moves."""

    nominal: Mapping[str, float]
    model: Callable[[], ia.Network]
    channels: Mapping[str, Mapping[str, str]]
    drive: Callable[[np.random.Generator], Signal]
    course: Callable[..., dict[str, Array]]


def oscillator() -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.CubicSpring(k=1000.0, k3=4e5))
    net.add(damper=ia.Damper(d=6.0), mass=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


def storeys() -> ia.Network:
    net = ia.Network("storeys", table=ia.Position(), low=ia.Mass(m=3.0), high=ia.Mass(m=1.0))
    net.add(foot=ia.SpringDamper(k=3000.0, d=8.0), neck=ia.SpringDamper(k=900.0, d=3.0))
    net.connect(net.table.flange, net.foot.flange_a).connect(
        net.foot.flange_b, net.low.flange, net.neck.flange_a
    )
    return net.connect(net.neck.flange_b, net.high.flange)


def slide() -> ia.Network:
    net = ia.Network("slide", wall=ia.Fixed(), spring=ia.SpringDamper(k=600.0, d=5.0))
    net.add(rail=ia.CoulombFriction(f_c=2.0), mass=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.rail.flange_a)
    return net.connect(net.spring.flange_b, net.rail.flange_b, net.mass.flange, net.push.flange)


def stepped(
    instants: Array, drive: Signal, law: Callable[[float, float], float], m: float, dry: float
) -> Array:
    """Return where a mass with dry friction is at instants: each step a move, a push and another move."""
    steps = round((BEGIN + instants[-1]) / STEP)
    pushes = drive(-BEGIN + STEP * (np.arange(steps) + 0.5)).tolist()
    x, v, course = 0.0, 0.0, [0.0]
    for push in pushes:
        x += 0.5 * STEP * v
        half = v + 0.5 * STEP * (push + law(x, v)) / m
        v += STEP * (push + law(x, half)) / m
        v -= max(-STEP * dry / m, min(v, STEP * dry / m))
        x += 0.5 * STEP * v
        course.append(x)
    return np.array(course)[np.rint((BEGIN + instants) / STEP).astype(int)]


def hardening(p: Numbers, drive: Signal, other: Signal, lacks: float, at: Array) -> dict[str, Array]:
    def law(x: float, v: float) -> float:
        return -p["spring.k"] * x - p["spring.k3"] * x**3 - p["damper.d"] * v - lacks * 40.0 * abs(v) * v

    return {"F": drive(at), "x": stepped(at, lambda t: drive(t) + other(t), law, 2.0, 0.0)}


def rubbing(p: Numbers, drive: Signal, other: Signal, lacks: float, at: Array) -> dict[str, Array]:
    def law(x: float, v: float) -> float:
        return -p["spring.k"] * x - lacks * 5e4 * x**3 - p["spring.d"] * v

    return {"F": drive(at), "x": stepped(at, lambda t: drive(t) + other(t), law, 2.0, p["rail.f_c"])}


def shaken(p: Numbers, drive: Signal, other: Signal, lacks: float, at: Array) -> dict[str, Array]:
    from scipy.integrate import solve_ivp

    def rates(t: float, y: Array) -> list[float]:
        x, z, v, w = y
        base, speed = drive(t), (drive(t + 1e-5) - drive(t - 1e-5)) / 2e-5
        foot = p["foot.k"] * (base - x) + p["foot.d"] * (speed - v)
        neck = p["neck.k"] * (x - z) + p["neck.d"] * (v - w) + lacks * 30.0 * abs(v - w) * (v - w)
        return [v, w, (foot - neck) / 3.0, (neck + other(t)) / 1.0]

    run = solve_ivp(rates, (-BEGIN, at[-1]), np.zeros(4), t_eval=at, rtol=1e-9, atol=1e-12)
    return {"s": drive(at), "x": run.y[0], "z": run.y[1]}


PUSHED = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}}
BENCHES = {
    "oscillator": Bench(
        {"spring.k": 1000.0, "spring.k3": 4e5, "damper.d": 6.0}, oscillator, PUSHED,
        lambda draw: tones(draw, 0.5, 8.0, 12.0), hardening,
    ),
    "storeys": Bench(
        {"foot.k": 3000.0, "foot.d": 8.0, "neck.k": 900.0, "neck.d": 3.0}, storeys,
        {
            "s": {"input": "table.s_ref", "unit": "m"},
            "x": {"output": "low.s", "unit": "m"},
            "z": {"output": "high.s", "unit": "m"},
        },
        lambda draw: tones(draw, 0.5, 10.0, 2e-3), shaken,
    ),
    "slide": Bench(
        {"spring.k": 600.0, "spring.d": 5.0, "rail.f_c": 2.0}, slide, PUSHED,
        lambda draw: tones(draw, 0.5, 6.0, 12.0), rubbing,
    ),
}  # fmt: skip


def noisy(draw: np.random.Generator, values: Array, coloured: bool) -> Array:
    """Return a channel with white noise, or with noise that forgets itself over 40 ms."""
    from scipy.signal import lfilter

    noise = draw.standard_normal(len(values) + 200)
    if coloured:
        kept = float(np.exp(-1 / (0.04 * RATE)))
        noise = (1 - kept**2) ** 0.5 * lfilter([1.0], [1.0, -kept], noise)
    return values + NOISE_SHARE * values.std() * noise[200:]


def _kind_of(number: int) -> tuple[str, str]:
    """Return the machine and the disturbance of a fit."""
    kinds = list(product(BENCHES, DISTURBANCES))
    return kinds[number % len(kinds)]


def one(number: int, seed: int) -> dict[str, Any]:
    """Return how a fit with a number came out: which intervals hold the truth."""
    name, disturbance = _kind_of(number)
    bench, draw = BENCHES[name], np.random.default_rng([seed, number])
    truth = {path: value * draw.uniform(0.8, 1.2) for path, value in bench.nominal.items()}
    at = np.arange(0.0, LENGTH, 1 / RATE)
    records = []
    for turn in range(RECORDS):
        drive = bench.drive(draw)
        other = tones(draw, 0.3, 9.0, 0.15 * (disturbance == "random force"))
        values = bench.course(truth, drive, other, float(disturbance == "missing law"), at)
        measured = {
            channel: noisy(draw, found, disturbance == "coloured noise") if "output" in told else found
            for (channel, told), found in zip(bench.channels.items(), values.values(), strict=True)
        }
        records.append({"record": Record(f"record {turn + 1}", at, measured)})
    wide = {path: {"min": 0.2 * value, "max": 5.0 * value} for path, value in bench.nominal.items()}
    campaign = Campaign(bench.model(), bench.channels, wide, records, [])
    found = ia.fit(campaign, intervals=LEVEL)
    told = {"machine": name, "disturbance": disturbance}
    told["parameters"] = _rows(truth, found.intervals, found.values, found.errors)
    if disturbance == "missing law":
        verdict = ia.diagnose(campaign)
        told["named"] = [placed.label for placed in verdict.missing]
        known, errors = verdict.intervals(LEVEL), verdict.standard_errors
        told["diagnosed"] = _rows(truth, known, verdict.parameters, errors) if known else []
    return told


def _rows(
    truth: Numbers, intervals: Mapping[str, Interval], values: Numbers, errors: Numbers
) -> list[dict[str, Any]]:
    return [
        asdict(intervals[path])
        | {"path": path, "truth": truth[path], "value": values[path], "error": errors[path]}
        for path in truth
    ]


def held(row: Mapping[str, float]) -> bool:
    return row["low"] <= row["truth"] <= row["high"]


def near(row: Mapping[str, float]) -> bool:
    return abs(row["truth"] - row["value"]) <= QUANTILE * row["error"]


def share(told: Sequence[bool]) -> str:
    """Return a share with its Wilson 95 % interval."""
    low, high = wilson(sum(told), len(told))
    return f"{sum(told) / len(told):.1%} ({low:.1%} to {high:.1%})"


def table(found: Sequence[Mapping[str, Any]]) -> str:
    lines = [
        "| records with | fits | intervals | profiles hold the truth | 1.96 standard errors do |",
        "|---" * 5 + "|",
    ]
    parts = {chosen: (chosen, "parameters") for chosen in DISTURBANCES}
    parts["missing law, diagnosed"] = "missing law", "diagnosed"
    for told, (chosen, of) in parts.items():
        fits = [one for one in found if one["disturbance"] == chosen]
        rows = [row for one in fits for row in one[of]]
        if rows:
            shares = share([held(row) for row in rows]), share([near(row) for row in rows])
            lines.append(f"| {told} | {len(fits)} | {len(rows)} | {' | '.join(shares)} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--fits", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", choices=DISTURBANCES, help="fits of these records alone")
    parser.add_argument("--out", type=Path, default=Path("intervals.json"))
    given = parser.parse_args()
    found: list[dict[str, Any]] = []
    with ProcessPoolExecutor(given.jobs) as pool:
        numbers = [n for n in range(given.fits) if given.only in (None, _kind_of(n)[1])]
        for case in pool.map(partial(one, seed=given.seed), numbers):
            found.append(case)
            given.out.write_text(json.dumps(found, indent=1))
            print(f"\r{len(found)}/{len(numbers)} fits", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    print(table(found))


if __name__ == "__main__":
    main()
