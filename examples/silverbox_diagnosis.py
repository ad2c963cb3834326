"""Silverbox: what does a linear model of a measured electronic oscillator lack?

The circuit is the analogue of a mass on a spring, m s'' + d s' + k s = g u. The model is linear, with guessed
numbers; one record of 43 s is fitted, two others are the test, of which the second goes beyond the amplitudes
of the first. All begin in motion. The verdict is printed with what free runs of the tests miss, and a report
is written.

    python examples/silverbox_diagnosis.py [--data DIR] [--out DIR]

Source: T. Wigren, J. Schoukens, Three free data sets for development and benchmarking in nonlinear system
identification, European Control Conference, 2013. The records are not part of this project.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from inertance import Damper, Fixed, Force, Mass, Network, Spring, diagnose, signals
from inertance.diagnosis import Verdict, write_report
from inertance.identification import Campaign

SHARED = os.environ.get("INERTANCE_SHARED") or Path(__file__).resolve().parents[2] / "shared"
DATA = Path(SHARED) / "data" / "silverbox"
TRAIN, TESTS = "train_1", ("test_1", "test_2")
MISSING = """no {file} in {directory}
The Silverbox records come from https://www.nonlinearbenchmark.org (benchmark "Silverbox"); write stretches of
the multisines as train_1.csv and test_1.csv, the growing noise as test_2.csv, with columns t [s], u_V, y_V.
Give their directory by --data DIR."""
CHANNELS = {"u_V": {"input": "gain.u", "unit": "1"}, "y_V": {"output": "mass.s", "unit": "m"}}
PARAMETERS = {"spring.k": {"rel": 0.2}, "damper.d": {"rel": 0.5}, "gain.k": {"rel": 0.2}}


def oscillator() -> Network:
    """Return the linear oscillator; 1 m stands for 1 V of the output."""
    net = Network(
        "silverbox",
        wall=Fixed(),
        spring=Spring(k=1.8e5),
        damper=Damper(d=30.0),
        mass=Mass(m=1.0),
        gain=signals.Gain(k=1.8e5),
        push=Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    return net.connect(net.gain.y, net.push.f)


def campaign(directory: Path) -> Campaign:
    """Return the campaign of the records in a directory."""
    train, *test = ({"file": str(directory / f"{name}.csv")} for name in (TRAIN, *TESTS))
    return Campaign(oscillator(), channels=CHANNELS, parameters=PARAMETERS, train=[train], test=test)


def told(verdict: Verdict) -> str:
    """Return a verdict with what free runs of the tests miss, in millivolts."""
    gap = verdict.gap["y_V"]
    values = [f"  {placed.label}: {dict(placed.values)}" for placed in verdict.effects]
    return "\n".join([str(verdict), *values, f"  output missed on the tests, of {gap.size:.4g} V: "
        f"{gap.nominal:.2%} as given, {gap.refit:.2%} refitted, {gap.after:.2%} with the effect; by record "
        + ", ".join(f"{name} {share:.2%}" for name, share in gap.records.items())])  # fmt: skip


def main() -> None:
    """Print the verdict and write the report."""
    parser = argparse.ArgumentParser(description="Silverbox: what a linear model of an oscillator lacks.")
    parser.add_argument("--data", type=Path, default=DATA, help="directory of the records (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("out"), help="directory of the report (%(default)s)")
    options = parser.parse_args()
    for name in (TRAIN, *TESTS):
        if not (options.data / f"{name}.csv").is_file():
            sys.exit(MISSING.format(file=f"{name}.csv", directory=options.data))
    options.out.mkdir(parents=True, exist_ok=True)
    found = diagnose(campaign(options.data), report=lambda line: print(f"  {line}", file=sys.stderr))
    print(f"{told(found)}\n  wrote {write_report(found, options.out / 'silverbox.html')}")


if __name__ == "__main__":
    main()
