"""Counterfactuals on machines of a generator of its own: does the verdict's network predict what was changed?

    python benchmarks/blind/counterfactuals.py [--cases 60] [--seed 3] [--jobs 2] [--out counterfactuals.json]

Each case is a machine with a hidden law (`hidden.py`). Three records of it as it is (two to fit, one to test)
and one after a change (mass added, spring exchanged, damper removed) go to `diagnose`; all begin in motion,
some seconds into a run. What the verdict's network misses of the last record is told over the true noise,
beside what the refitted model without the effect misses.

Where a thousandth of a stiffness changes the last record by three times the noise, nobody who knows the law
can foretell it: such machines are drawn again before anything is diagnosed, twenty times at most.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import product
from pathlib import Path

import inertance as ia
import numpy as np
from hidden import RATE, Law, Machine, Push, laws, modelled, moved, multisine, right
from inertance.diagnosis import diagnose
from inertance.identification import Campaign, Record
from measures import wilson

BEGIN, LENGTH = 2.0, 8.0  # [s] before a record, [s]
NOISE_SHARE = 3e-3  # of the root mean square of each channel
SENSITIVE, DRAWS = 3.0, 20  # [noise] by a thousandth of a stiffness, [1] of such machines before one is kept
WITHIN = 1.5  # [noise] of the prediction that a right verdict makes
CHANGES = ("mass added", "spring exchanged", "damper removed")


def measured(
    machine: Machine, law: Law, place: int, push: Push, draw: np.random.Generator
) -> tuple[Record, dict[str, float]]:
    """Return a record of force and positions, and the noise of each position [m]."""
    time = np.arange(round((BEGIN + LENGTH) * RATE) + 1) / RATE
    kept = time >= BEGIN
    values, noise = {"F": push(time)[kept]}, dict[str, float]()
    for name, x in moved(machine, law, place, push, time).items():
        noise[name] = NOISE_SHARE * float(x[kept].std())
        values[name] = x[kept] + noise[name] * draw.standard_normal(kept.sum())
    return Record(f"record {draw.integers(10**6)}", time[kept], values), noise


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
class Case:
    """A machine with its law, how it is changed, and how it is pushed then."""

    machine: Machine
    law: Law
    place: int
    other: Machine
    entry: dict[str, object]
    push: Push
    sensitivity: float
    draws: int


def case(name: str, masses: int, change: str, draw: np.random.Generator) -> Case:
    """Return the first case that is drawn whose last record can be foretold."""
    drawn = (one_case(name, masses, change, draws, draw) for draws in range(1, DRAWS + 1))
    for made in drawn:
        if made.sensitivity < SENSITIVE:
            break
    return made


def one_case(name: str, masses: int, change: str, draws: int, draw: np.random.Generator) -> Case:
    """Draw a machine, its law and its change."""
    machine, law = Machine(m2=1.0 if masses == 2 else 0.0), laws(draw)[name]
    place = masses if name in ("cubic spring", "hysteresis") else 1
    (other, entry), push = changed(machine, change, draw), multisine(draw, draw.uniform(5.0, 8.0))
    time = np.arange(round((BEGIN + LENGTH) * RATE) + 1) / RATE
    as_is, near = (moved(one, law, place, push, time) for one in (other, replace(other, k1=1.001 * other.k1)))
    kept = time >= BEGIN
    off = max(float((near[c] - as_is[c])[kept].std() / as_is[c][kept].std()) for c in as_is)
    return Case(machine, law, place, other, entry, push, off / NOISE_SHARE, draws)


@dataclass(frozen=True)
class Outcome:
    """What became of a case: what models miss of the changed machine, in true noise, worst channel.

    `sensitivity` is what a thousandth of the first stiffness changes there, likewise; `draws` how many
    machines were drawn before one could be foretold.
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
    draws: int

    def __str__(self) -> str:
        return (
            f"{self.case:3d} {self.law:14s} {self.masses} {self.change:16s} {self.verdict:10s} "
            f"{self.found:42s} {'right' if self.right else 'other':6s} "
            f"refit {self.refit:8.3g}  after {self.after:6.3g}  "
            f"0.1 % of stiffness {self.sensitivity:.2g}, drawn {self.draws}"
        )


def outcome(number: int, seed: int) -> Outcome:
    """Make a case, diagnose it, and hold its verdict against the truth."""
    kinds = [*product([*laws(np.random.default_rng(0))], (1, 2), CHANGES)]
    name, masses, change = kinds[number % len(kinds)]
    draw = np.random.default_rng([seed, number])
    made = case(name, masses, change, draw)
    as_it_is = made.machine, made.law, made.place
    records = [measured(*as_it_is, multisine(draw, draw.uniform(5.0, 8.0)), draw)[0] for _ in range(3)]
    record, noise = measured(made.other, made.law, made.place, made.push, draw)
    verdict = diagnose(
        Campaign(
            **modelled(made.machine),
            train=[{"record": records[0]}, {"record": records[1]}],
            test=[{"record": records[2]}],
            counterfactual=[{"record": record, **made.entry}],
        )
    )
    missed = {one.channel: one for one in verdict.counterfactual}
    refit, after = (
        max((getattr(missed[c], of) or np.inf) * missed[c].size / noise[c] for c in noise)
        for of in ("refit", "after")
    )
    found = ", ".join(placed.label for placed in verdict.effects)
    good = right(made.law, made.place, verdict.effects)
    told = verdict.verdict, found, good, refit, after, made.sensitivity, made.draws
    return Outcome(number, name, masses, change, *told)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the cases and tell what became of them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--cases", type=int, default=60, help="every 30 hold each law, machine and change")
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", type=int, nargs="+", help="numbers of cases")
    parser.add_argument("--out", type=Path, help="JSON file of the outcomes")
    options = parser.parse_args(arguments)
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    done = []
    with ProcessPoolExecutor(options.jobs) as pool:
        for one in pool.map(partial(outcome, seed=options.seed), options.only or range(options.cases)):
            done.append(one)
            print(one, flush=True)
            if options.out:
                told = json.dumps([asdict(each) for each in done], indent=1, default=float)
                options.out.write_text(told + "\n")
    within = sum(one.after <= WITHIN for one in done)
    low, high = wilson(within, len(done))
    print(f"{within} of {len(done)} predicted within {WITHIN} times the noise ({low:.1%} to {high:.1%}),")
    print(f"without the effect {sum(one.refit <= WITHIN for one in done)};")
    print(
        f"{sum(one.right for one in done)} verdicts right, {sum(one.draws > 1 for one in done)} drawn again"
    )


if __name__ == "__main__":
    sys.exit(main())
