"""EMPS: which force does the measured motion of the axis not explain?

The rig turned round: the measured position is prescribed, the force of the drive, as its command tells it, is
what is compared, both behind the same low-pass. No control loop hides anything, and no model has to be run
into the motion first. The estimation record is fitted, the one with pulses is the test. The verdict is
printed for a model without Coulomb friction and for one with it, and a report is written.

    python examples/emps_force.py [--data DIR] [--out DIR] [--cutoff HZ]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import emps
from inertance import (
    ConstantForce,
    CoulombFriction,
    Damper,
    Fixed,
    ForceSensor,
    Mass,
    Network,
    Position,
    diagnose,
)
from inertance.diagnosis import Verdict, write_report
from inertance.identification import Campaign, Filter, Record

RATE, CUTOFF = 1000.0, 100.0  # [Hz]
KEPT = slice(200, -500)  # samples, away from the ends of the filter
PARAMETERS = {
    "carriage.m": {"rel": 0.2},
    "viscous.d": {"rel": 0.5},
    "offset.f_constant": {"min": -20.0, "max": 20.0},
}
COULOMB = {"coulomb.f_c": {"min": 0.0, "max": 60.0}}


def bench(coulomb: bool) -> Network:
    """Return the axis with its motion prescribed, without or with Coulomb friction."""
    net = Network(
        "EMPS bench",
        bed=Fixed(),
        motion=Position(),
        drive=ForceSensor(),
        carriage=Mass(m=95.0),
        viscous=Damper(d=200.0),
        offset=ConstantForce(f_constant=0.0),
    )
    net.connect(net.motion.flange, net.drive.flange_a)
    net.connect(net.drive.flange_b, net.carriage.flange, net.viscous.flange_b, net.offset.flange)
    net.connect(net.bed.flange, net.viscous.flange_a)
    if coulomb:
        net.add(coulomb=CoulombFriction(f_c=20.0))
        net.connect(net.viscous.flange_a, net.coulomb.flange_a)
        net.connect(net.viscous.flange_b, net.coulomb.flange_b)
    return net


def records(directory: Path, cutoff: float = CUTOFF) -> list[Record]:
    """Return the records, what is fitted first: position [m] and force of the drive [N] behind a low-pass."""
    low, found = Filter(cutoff=cutoff), []
    for file in emps.FILES.values():
        read = emps.load(directory / file)
        q, force = (low.apply(values, RATE)[KEPT] for values in (read.qm, read.force))
        found.append(Record(file, read.t[KEPT] - read.t[KEPT][0], {"q": q, "F": force}))
    return found


def campaign(read: Sequence[Record], coulomb: bool, late: float = 0.0) -> Campaign:
    """Return the campaign; the position may be known to be recorded `late` [s]."""
    return Campaign(
        bench(coulomb),
        channels={
            "q": {"input": "motion.s_ref", "unit": "m", "delay": -late},
            "F": {"output": "drive.f", "unit": "N"},
        },
        parameters={**PARAMETERS, **(COULOMB if coulomb else {})},
        train=[{"record": read[0]}],
        test=[{"record": read[1]}],
    )


def told(verdict: Verdict) -> str:
    """Return a verdict with what is left in newtons."""
    gap = verdict.gap["F"]
    steps = (f"{share * gap.size:.2f} N {name}" for share, name in (
        (gap.nominal, "as given"), (gap.refit, "refitted"), (gap.after, "with the effects")))  # fmt: skip
    values = "\n".join(f"  {placed.label}: {dict(placed.values)}" for placed in verdict.effects)
    return f"{verdict}\n{values}\n  force missed on the test record: {', '.join(steps)}"


def main() -> None:
    """Print both verdicts and write both reports."""
    parser = argparse.ArgumentParser(description="EMPS: the force that the measured motion does not explain.")
    parser.add_argument("--data", type=Path, default=emps.DATA, help="directory of the records (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("out"), help="directory for reports (%(default)s)")
    parser.add_argument("--cutoff", type=float, default=CUTOFF, help="of the low-pass [Hz] (%(default)s)")
    options = parser.parse_args()
    for file in emps.FILES.values():
        if not (options.data / file).is_file():
            sys.exit(emps.MISSING.format(file=file, directory=options.data))
    options.out.mkdir(parents=True, exist_ok=True)
    read = records(options.data, options.cutoff)
    for coulomb, model in zip((False, True), emps.MODELS, strict=True):
        found = diagnose(campaign(read, coulomb), report=lambda line: print(f"  {line}", file=sys.stderr))
        name = f"emps_force_{'with' if coulomb else 'without'}_coulomb.html"
        print(f"\n{model}: {told(found)}\n  wrote {write_report(found, options.out / name)}")


if __name__ == "__main__":
    main()
