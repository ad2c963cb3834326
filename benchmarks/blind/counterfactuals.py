"""Counterfactuals on machines of a generator of its own: does the verdict's network predict what was changed?

    python benchmarks/blind/counterfactuals.py [--only N ...] [--out counterfactuals.json]

Each case is a machine with a hidden law, integrated by SciPy from equations written out here, which share
nothing with the library. Three records of it as it is (two to fit, one to test) and one after a change (mass
added, spring exchanged, damper removed) go to `diagnose`; all begin in motion, some seconds into a run. What
the verdict's network misses of the last record is told over the true noise, beside what the refitted model
without the effect misses.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import asdict, dataclass, replace
from itertools import product
from pathlib import Path

import inertance as ia
import numpy as np
from inertance.diagnosis import diagnose
from inertance.identification import Campaign, Record
from numpy.typing import NDArray

Array = NDArray[np.float64]
RATE, BEGIN, LENGTH = 100.0, 2.0, 8.0  # [Hz], [s], [s]
NOISE_SHARE = 3e-3  # of the root mean square of each channel
SENSITIVE = 3.0  # [noise] by a thousandth of a stiffness: motions that parameters a fit knows do not tell
WITHIN = 1.5  # [noise] of the prediction that a right verdict makes
CHANGES = ("mass added", "spring exchanged", "damper removed")


@dataclass(frozen=True)
class Machine:
    """Two masses in a row or one: m1 on spring and damper against the wall, m2 on another pair against m1."""

    m1: float = 2.0
    k1: float = 900.0
    d1: float = 7.0
    m2: float = 0.0
    k2: float = 500.0
    d2: float = 4.0


@dataclass(frozen=True)
class Law:
    """A force against the relative motion (s, v, z), and the rate of its inner state z."""

    kind: str
    force: Callable[[float, float, float], float]
    rate: Callable[[float, float, float], float] = lambda s, v, z: 0.0


def laws(draw: np.random.Generator) -> dict[str, Law]:
    """Return hidden laws with sizes drawn at random."""
    size = draw.uniform(0.7, 1.3)
    dry, cubic, drag = 1.2 * size, 6e5 * size, 60.0 * size
    height, pitch = 1.5 * size, 6e-3 * draw.uniform(0.8, 1.2)
    stiff, yielded = 900.0 * size, 1.5e-3 * draw.uniform(0.8, 1.2)

    def turning(s: float, v: float, z: float) -> float:
        return v - 0.5 * (abs(v) * z * abs(z) + v * z * z) / yielded**2

    return {
        "dry friction": Law("coulomb_friction", lambda s, v, z: dry * np.tanh(v / 3e-5)),
        "cubic spring": Law("cubic_stiffness", lambda s, v, z: cubic * s**3),
        "square drag": Law("quadratic_damping", lambda s, v, z: drag * abs(v) * v),
        "ripple": Law("position_ripple", lambda s, v, z: height * np.sin(2 * np.pi * s / pitch)),
        "hysteresis": Law("hysteresis", lambda s, v, z: stiff * z, turning),
    }


def measured(
    machine: Machine, law: Law, place: int, draw: np.random.Generator
) -> tuple[Record, dict[str, float]]:
    """Return a record of force and positions, and the noise of each position [m]."""
    from scipy.integrate import solve_ivp

    frequencies = np.linspace(0.4, 6.0, 24) * draw.uniform(0.97, 1.03, 24)
    phases, rms = draw.uniform(0, 2 * np.pi, 24), draw.uniform(5.0, 8.0)

    def push(t: Array | float) -> Array:
        lines = np.sin(2 * np.pi * np.multiply.outer(t, frequencies) + phases)
        return np.asarray(rms * np.sqrt(2 / 24) * lines.sum(axis=-1))

    def slope(t: float, y: Array) -> list[float]:
        x1, v1, x2, v2, z = y
        s, v = (x1, v1) if place == 1 else (x2 - x1, v2 - v1)
        hidden = law.force(s, v, z)
        inner = machine.k2 * (x2 - x1) + machine.d2 * (v2 - v1) + (hidden if place == 2 else 0.0)
        inner *= machine.m2 > 0
        outer = float(push(t)) - machine.k1 * x1 - machine.d1 * v1 - (hidden if place == 1 else 0.0)
        return [v1, (outer + inner) / machine.m1, v2, -inner / (machine.m2 or 1.0), law.rate(s, v, z)]

    time = np.arange(round((BEGIN + LENGTH) * RATE) + 1) / RATE
    method = "LSODA" if law.kind == "coulomb_friction" else "DOP853"
    run = solve_ivp(slope, (0, time[-1]), np.zeros(5), method, time, rtol=1e-7, atol=1e-9, max_step=0.01)
    kept = time >= BEGIN
    values, noise = {"F": push(time)[kept]}, dict[str, float]()
    for name, x in {"x1": run.y[0], "x2": run.y[2]}.items():
        if name == "x1" or machine.m2:
            noise[name] = NOISE_SHARE * float(x[kept].std())
            values[name] = x[kept] + noise[name] * draw.standard_normal(kept.sum())
    return Record(f"record {draw.integers(10**6)}", time[kept], values), noise


def network(machine: Machine) -> ia.Network:
    """Return the machine as an engineer would model it, 10 % off in its springs and 20 % in its dampers."""
    net = ia.Network("rig", wall=ia.Fixed(), push=ia.Force(), carriage=ia.Mass(m=machine.m1))
    net.add(spring=ia.Spring(k=1.1 * machine.k1), damper=ia.Damper(d=0.8 * machine.d1))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.push.flange, net.carriage.flange, net.spring.flange_b, net.damper.flange_b)
    if machine.m2:
        net.add(tool=ia.Mass(m=machine.m2), leaf=ia.Spring(k=0.9 * machine.k2), pad=ia.Damper(d=machine.d2))
        net.connect(net.carriage.flange, net.leaf.flange_a, net.pad.flange_a)
        net.connect(net.tool.flange, net.leaf.flange_b, net.pad.flange_b)
    return net


def changed(machine: Machine, change: str, draw: np.random.Generator) -> tuple[Machine, dict[str, object]]:
    """Return the machine after a change, and what a campaign says of it."""
    if change == "mass added":
        mass = machine.m1 * draw.uniform(1.3, 2.2)
        return replace(machine, m1=mass), {"set": {"carriage.m": f"{1e3 * mass:.17g} g"}}
    if change == "spring exchanged":
        k = machine.k1 * draw.choice([0.55, 1.8])
        return replace(machine, k1=k), {"exchange": {"spring": ia.Spring(k=k)}}
    if machine.m2:
        return replace(machine, d2=0.0), {"remove": ["pad"]}
    return replace(machine, d1=0.0), {"remove": ["damper"]}


@dataclass(frozen=True)
class Outcome:
    """What became of a case: what models miss of the changed machine, in true noise, worst channel.

    `sensitivity` is what a thousandth of the first stiffness changes there, likewise: what no fit knows.
    """

    case: int
    law: str
    masses: int
    change: str
    verdict: str
    found: str
    right: bool
    refit: float
    after: float
    sensitivity: float


def outcome(number: int, name: str, masses: int, change: str) -> Outcome:
    """Make a case, diagnose it, and hold its verdict against the truth."""
    draw = np.random.default_rng([17, number])
    machine, law = Machine(m2=1.0 if masses == 2 else 0.0), laws(draw)[name]
    place = masses if name in ("cubic spring", "hysteresis") else 1
    records = [measured(machine, law, place, draw)[0] for _ in range(3)]
    other, entry = changed(machine, change, draw)
    twin = deepcopy(draw)
    record, noise = measured(other, law, place, draw)
    near, _ = measured(replace(other, k1=1.001 * other.k1), law, place, twin)
    outputs = {"x1": "carriage.s", "x2": "tool.s"}
    deviations = {"spring.k": 0.2, "damper.d": 0.5, "leaf.k": 0.2, "pad.d": 0.5}
    verdict = diagnose(
        Campaign(
            network(machine),
            {"F": {"input": "push.f", "unit": "N"}}
            | {channel: {"output": outputs[channel], "unit": "m"} for channel in noise},
            {
                path: {"rel": rel}
                for path, rel in deviations.items()
                if masses == 2 or path in ("spring.k", "damper.d")
            },
            [{"record": records[0]}, {"record": records[1]}],
            [{"record": records[2]}],
            counterfactual=[{"record": record, **entry}],
        )
    )
    sites = ("leaf", "pad") if place == 2 else ("spring", "damper", "carriage")
    right = [placed.effect.kind for placed in verdict.effects] == [law.kind]
    right &= all(placed.site.path in sites for placed in verdict.effects)
    missed = {one.channel: one for one in verdict.counterfactual}
    refit, after = (
        max((getattr(missed[c], of) or np.inf) * missed[c].size / noise[c] for c in noise)
        for of in ("refit", "after")
    )
    sensitivity = max(float(np.std(near.values[c] - record.values[c])) / noise[c] for c in noise)
    found = ", ".join(placed.label for placed in verdict.effects)
    return Outcome(number, name, masses, change, verdict.verdict, found, right, refit, after, sensitivity)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the cases and tell what became of them."""
    parser = argparse.ArgumentParser(description="Counterfactuals of machines with hidden laws.")
    parser.add_argument("--only", type=int, nargs="+", help="numbers of cases")
    parser.add_argument("--out", type=Path, help="JSON file of the outcomes")
    options = parser.parse_args(arguments)
    names = [*laws(np.random.default_rng(0))]
    cases = [*enumerate(product(names, (1, 2), CHANGES))]
    done = []
    for number, (name, masses, change) in cases:
        if options.only is None or number in options.only:
            one = outcome(number, name, masses, change)
            done.append(one)
            print(
                f"{number:3d} {name:14s} {masses} {change:16s} {one.verdict:10s} {one.found:42s} "
                f"{'right' if one.right else 'other':6s} refit {one.refit:8.3g}  after {one.after:6.3g}  "
                f"0.1 % of stiffness {one.sensitivity:.2g}",
                flush=True,
            )
    right = [one for one in done if one.right]
    tame = [one for one in right if one.sensitivity < SENSITIVE]
    groups = {"all": done, "right verdicts": right, f"of these less sensitive than {SENSITIVE:g}": tame}
    for told, group in groups.items():
        within = sum(one.after <= WITHIN for one in group)
        print(f"{told}: {within} of {len(group)} predicted within {WITHIN} times the noise")
    if options.out:
        options.out.write_text(json.dumps([asdict(one) for one in done], indent=1, default=float) + "\n")


if __name__ == "__main__":
    main()
