"""Does one designed experiment resolve what records leave open? Beside a random one of equal size.

    python benchmarks/blind/designed.py [--classes 40] [--seed 3] [--jobs 2] [--out designed.json]

Machines with a hidden law (`hidden.py`) are shaken by sines of one frequency alone: two records of 8 s to
fit, one to test, noise of 0.3 to 3 %. Most verdicts of such records name one effect; those that are
`ambiguous` are the classes. For each `design` says what to play next, for 20 s, within 15 N, 0.3 to 8 Hz and
1.5 times the travel that was seen. It is played twice, to fit and to test, and diagnosed again; so is, in its
place, a sum of sines of all the band, of random phases and the same largest force.

A class is resolved rightly if one effect is named, of the true kind and at the true place.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from hidden import (
    RATE,
    Array,
    Law,
    Machine,
    Push,
    laws,
    modelled,
    moved,
    one_sided,
    right,
)
from inertance.diagnosis import InseparableError, Verdict, design, diagnose
from inertance.identification import Campaign, Record
from measures import wilson

BEGIN, LENGTH, DURATION = 2.0, 8.0, 20.0  # [s] before a record, of one, of the experiment
NOISES = (3e-3, 1e-2, 3e-2)  # of the root mean square of each channel
SIZES = 0.15, 1.0  # of hidden laws
FORCE, BAND, ROOM = 15.0, (0.3, 8.0), 1.5  # [N], [Hz], [largest travel seen]: limits of the experiment
KINDS = ("dry friction", "cubic spring", "square drag", "hysteresis", "one-sided spring")


@dataclass(frozen=True)
class Rig:
    """A machine with its law and the noise of its channels [m], which can be shaken."""

    machine: Machine
    law: Law
    place: int
    noise: dict[str, float]
    draw: np.random.Generator

    def shaken(self, push: Push, time: Array, kept: Array, name: str) -> Record:
        """Return what is measured of it at instants of which some are kept."""
        x = moved(self.machine, self.law, self.place, push, time)
        seen = {c: x[c][kept] + self.noise[c] * self.draw.standard_normal(kept.sum()) for c in x}
        return Record(name, time[kept], {"F": push(time)[kept], **seen})


def sine(frequency: float, force: float, phase: float) -> Push:
    return lambda t: np.asarray(force * np.sin(2 * np.pi * frequency * np.asarray(t) + phase))


def through(time: Array, force: Array) -> Push:
    """Return the push that samples make, smooth between them."""
    from scipy.interpolate import CubicSpline

    return CubicSpline(time, force)


def known(number: int, seed: int) -> tuple[Rig, dict[str, Any]]:
    """Return a rig, and the campaign of the sines that it was shaken by."""
    draw = np.random.default_rng([seed, number])
    name, masses = KINDS[number % len(KINDS)], 1 + (number // len(KINDS)) % 2
    machine, place = Machine(m2=1.0 if masses == 2 else 0.0), int(draw.integers(1, masses + 1))
    law = {**laws(draw, *SIZES), "one-sided spring": one_sided(draw, *SIZES)}[name]
    share, frequency = float(draw.choice(NOISES)), draw.uniform(1.0, 4.0)
    pushes = [sine(frequency, draw.uniform(4.0, 9.0), draw.uniform(0, 2 * np.pi)) for _ in range(3)]
    time = np.arange(round((BEGIN + LENGTH) * RATE) + 1) / RATE
    kept = time >= BEGIN
    first = moved(machine, law, place, pushes[0], time)
    rig = Rig(machine, law, place, {c: share * float(x[kept].std()) for c, x in first.items()}, draw)
    records = [rig.shaken(push, time, kept, f"sine {n + 1}") for n, push in enumerate(pushes)]
    travel = {c: ROOM * max(float(np.abs(r.values[c]).max()) for r in records) for c in rig.noise}
    limits = {c: {"travel": float(most)} for c, most in travel.items()}
    return rig, {
        **modelled(machine),
        "train": [{"record": record} for record in records[:2]],
        "test": [{"record": records[2]}],
        "limits": {"duration": DURATION, "rate": RATE, "F": {"force": FORCE, "band": list(BAND)}, **limits},
    }


def random_push(draw: np.random.Generator, time: Array, most: float) -> Array:
    """Return a push of random phases over all of the band, faded at its ends [N]."""
    frequencies = np.arange(BAND[0], BAND[1], 1 / DURATION)
    phases = draw.uniform(0, 2 * np.pi, len(frequencies))
    force = np.sin(2 * np.pi * np.multiply.outer(time, frequencies) + phases).sum(axis=1)
    force *= np.clip(np.minimum(time, time[-1] - time) / 0.5, 0.0, 1.0)
    return np.asarray(most * force / np.abs(force).max())


def after(rig: Rig, told: dict[str, Any], time: Array, force: Array) -> Verdict:
    """Return the verdict once an experiment was made twice, to fit and to test."""
    every, push = np.ones(len(time), dtype=bool), through(time, force)
    entries = [
        {"record": rig.shaken(push, time, every, name), "initial": "rest"} for name in ("new", "again")
    ]
    more = {"train": [*told["train"], entries[0]], "test": [*told["test"], entries[1]]}
    return diagnose(Campaign(**{**told, **more}))


@dataclass(frozen=True)
class Outcome:
    """What became of a class: what it held, what was played, and what was named then."""

    case: int
    law: str
    place: int
    noise: float
    class_: list[str]
    holds: bool
    played: str
    designed: str
    designed_right: bool
    random: str
    random_right: bool

    def __str__(self) -> str:
        marks = ["right" if good else "OTHER" for good in (self.designed_right, self.random_right)]
        return (
            f"{self.case:3d} {self.law:20s} {self.noise:.2g} {' | '.join(self.class_)}\n"
            f"      {self.played}\n"
            f"      {marks[0]} {self.designed}; random: {marks[1]} {self.random}"
        )


def outcome(number: int, seed: int) -> Outcome | None:
    """Make a case; if its verdict leaves a class, resolve it; None otherwise."""
    rig, told = known(number, seed)
    verdict = diagnose(Campaign(**told))
    if verdict.verdict != "ambiguous":
        return None
    class_ = [placed.label for placed in verdict.effects]
    class_ += [f"{kind} at {site}" for kind, site in verdict.equivalent]
    holds = any(label.startswith(rig.law.kind) for label in class_)
    try:
        plan = design(Campaign(**told), verdict)
        time, force, played = plan.time, plan.inputs["F"], plan.told
        found = after(rig, told, time, force)
        designed, good = _named(rig, found)
    except InseparableError as error:
        played, designed, good = f"nothing: {error}"[:200], "told to be inseparable", False
        time, force = np.arange(0.0, DURATION, 1 / RATE), np.array([FORCE])
    random = random_push(rig.draw, time, float(np.abs(force).max()))
    beside, beside_good = _named(rig, after(rig, told, time, random))
    law, noise = f"{rig.law.kind}", rig.noise["x1"]
    return Outcome(number, law, rig.place, noise, class_, holds, played, designed, good, beside, beside_good)


def _named(rig: Rig, verdict: Verdict) -> tuple[str, bool]:
    labels = ", ".join(placed.label for placed in verdict.effects)
    good = verdict.verdict == "effect" and right(rig.law, rig.place, verdict.effects)
    return f"{verdict.verdict} {labels}", good


def outcomes(classes: int, seed: int, jobs: int) -> Iterator[Outcome]:
    """Yield so many classes, in order of their cases."""
    with ProcessPoolExecutor(jobs) as pool:
        found = 0
        for begin in count(0, 4 * jobs):
            for one in pool.map(partial(outcome, seed=seed), range(begin, begin + 4 * jobs)):
                if one is not None and found < classes:
                    found += 1
                    yield one
            if found >= classes:
                return


def main(arguments: Sequence[str] | None = None) -> None:
    """Find classes, resolve them, and tell what became of them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--classes", type=int, default=40)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="JSON file of the outcomes")
    options = parser.parse_args(arguments)
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    done = []
    for one in outcomes(options.classes, options.seed, options.jobs):
        done.append(one)
        print(one, flush=True)
        if options.out:
            options.out.write_text(json.dumps([asdict(each) for each in done], indent=1) + "\n")
    hold = sum(one.holds for one in done)
    print(f"{len(done)} classes of {done[-1].case + 1} machines; {hold} hold the truth")
    for what, good in (
        ("designed", sum(one.designed_right for one in done)),
        ("random", sum(one.random_right for one in done)),
    ):
        low, high = wilson(good, len(done))
        print(f"resolved rightly, {what}: {good} of {len(done)} ({low:.1%} to {high:.1%})")


if __name__ == "__main__":
    sys.exit(main())
