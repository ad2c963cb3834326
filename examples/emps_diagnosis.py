"""EMPS: what does the model of a measured ball-screw axis lack?

The axis of `emps.py` under its control loop is held against both records, once as mass and viscous friction
only and once with Coulomb friction in it. The estimation record is fitted, the other motion with pulses is
the test. Each time the verdict is printed, with what every effect does for the test, and a report is written.

    python examples/emps_diagnosis.py [--data DIR] [--out DIR]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import emps
from inertance import Network, diagnose, signals
from inertance.diagnosis import Verdict, write_report
from inertance.identification import Campaign, Record

CHANNELS = {
    "qg": {"input": "dq_ref.u1", "unit": "m"},
    "pulses": {"input": "pulses.u", "unit": "V"},
    "vir": {"output": "vir.y", "unit": "V"},
}
PARAMETERS = {
    "carriage.m": {"rel": 0.2},
    "viscous.d": {"rel": 0.5},
    "offset.f_constant": {"min": -20.0, "max": 20.0},
}
COULOMB = {"coulomb.friction.f_c": {"min": 0.0, "max": 60.0}}


def axis(record: emps.Record, coulomb: bool) -> Network:
    """Return the axis with the reference and the pulses as inputs."""
    net = emps.axis(record, emps.estimate(record, coulomb))
    return net.with_values(dq_ref=signals.Add(k1=record.kp, k2=-record.kp), pulses=signals.Gain(k=1.0))


def verdict(directory: Path, coulomb: bool) -> Verdict:
    """Diagnose the axis without or with Coulomb friction in its model."""
    read = {file: emps.load(directory / file) for file in emps.FILES.values()}
    fitted, tested = (
        Record(file, r.t, {"qg": r.qg, "pulses": r.pulses, "vir": r.vir}) for file, r in read.items()
    )
    campaign = Campaign(
        axis(read[emps.FILES["estimation"]], coulomb),
        channels=CHANNELS,
        parameters={**PARAMETERS, **(COULOMB if coulomb else {})},
        train=[{"record": fitted}],
        test=[{"record": tested}],
    )
    return diagnose(campaign, report=lambda line: print(f"  {line}", file=sys.stderr))


def main() -> None:
    """Print both verdicts and write both reports."""
    parser = argparse.ArgumentParser(description="EMPS: what the model of a measured axis lacks.")
    parser.add_argument("--data", type=Path, default=emps.DATA, help="directory of the records (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("out"), help="directory for reports (%(default)s)")
    options = parser.parse_args()
    for file in emps.FILES.values():
        if not (options.data / file).is_file():
            sys.exit(emps.MISSING.format(file=file, directory=options.data))
    options.out.mkdir(parents=True, exist_ok=True)
    for coulomb, model in zip((False, True), emps.MODELS, strict=True):
        found = verdict(options.data, coulomb)
        gap = found.gap["vir"]
        print(f"\n{model}: {found.verdict}. {found.sentence}")
        print(f"  command on the test record, NRMSE: {gap.nominal:.2%} as given, {gap.refit:.2%} refitted, "
              f"{gap.after:.2%} with the effect, noise {gap.floor:.2%}")  # fmt: skip
        for one in found.ranking:
            told = f"{one.test_gain:8.1%} of the squared test residual, p {one.p:.2g}"
            print(f"  {one.kind:26}{one.site:20}{told}")
        for line in found.lines:
            print(f"  {line}")
        name = "with" if coulomb else "without"
        print(f"  wrote {write_report(found, options.out / f'emps_{name}_coulomb.html')}")


if __name__ == "__main__":
    main()
