"""SO-101: what does a model of three numbers lack of a measured joint of a hobby robot's arm?

The joint is a bus servo under its own position controller. Its model is what one writes down first, a spring
to the command, a damper and an inertia:

    J w' = k (command - phi) - d w

The command is held from one cycle of 20 ms to the next, and the encoder tells 4096 steps a turn. From
positions only the ratios of the three numbers can be told, so J stays and the other two are uncertain by as
much as they are. Fifteen seconds of each of four motions are fitted; four others, one of eight times the
amplitude, are the test.

What the arm does not repeat itself bounds what any law can explain: motions in which a stretch of the command
comes back are held against themselves.

    python examples/so101_diagnosis.py [--data DIR] [--out DIR]

Source: one of six joints of the robot arm SO-101 in the project SAGE, https://github.com/isaac-sim2real/sage
(Apache-2.0), output/real/so101/custom. The records are not part of this project.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from inertance import Network, diagnose, rotational, signals
from inertance.diagnosis import Verdict, write_report
from inertance.identification import Campaign, Record, read_record
from matplotlib.figure import Figure
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHARED = os.environ.get("INERTANCE_SHARED") or Path(__file__).resolve().parents[2] / "shared"
DATA = Path(SHARED) / "data" / "so101"
MISSING = """no {file} in {directory}
The records come from https://github.com/isaac-sim2real/sage, output/real/so101/custom: of each motion join
control.csv and state_motor.csv to one table with t [s], command and position [rad] of the joint "Rotation".
Give their directory by --data DIR."""

FITTED = {name: (80.0, 95.0) for name in ("chirp_sweep", "multisine", "prbs_excitation", "velocity_ramp")}
TESTED = {
    "single_joint_rotation": (70.0, 95.0),
    "step_response": (40.0, 65.0),
    "sinusoidal_sweep": (40.0, 65.0),
    "backlash_detection": (40.0, 65.0),
}
# Samples after which the command comes back.
CYCLES = {"single_joint_rotation": 600, "backlash_detection": 33, "velocity_ramp": 1496}
SAME_COMMAND = 2e-3  # rad, about a step of the encoder
CHANNELS = {
    "command": {"input": "error.u1", "unit": "rad", "interpolation": "hold"},
    "position": {"output": "encoder.phi", "unit": "rad"},
}
PARAMETERS = {"stiffness.k": {"rel": 1.0}, "damping.d": {"rel": 1.0}}
MODELS = "refitted", "corrected"


class Compared(NamedTuple):
    """A whole motion, and its position [rad] as the refitted and as the corrected model has it."""

    record: Record
    before: Array
    after: Array


def servo() -> Network:
    """Return the joint as one would guess it: k = 10 N.m/rad, d = 0.5 N.m.s/rad, J = 0.02 kg.m2."""
    net = Network(
        "servo",
        error=signals.Add(k2=-1.0),
        stiffness=signals.Gain(k=10.0),
        motor=rotational.Torque(),
        arm=rotational.Inertia(J=0.02),
        encoder=rotational.AngleSensor(),
        damping=rotational.Damper(d=0.5),
        base=rotational.Fixed(),
    )
    net.connect(net.encoder.phi, net.error.u2).connect(net.error.y, net.stiffness.u)
    net.connect(net.stiffness.y, net.motor.tau)
    net.connect(net.motor.flange, net.arm.flange, net.encoder.flange, net.damping.flange_b)
    return net.connect(net.base.flange, net.damping.flange_a)


def records(directory: Path, motions: Mapping[str, tuple[float, float]]) -> list[dict[str, object]]:
    """Return windows of motions as records of a campaign; the encoder's zero is not known."""
    return [
        {"file": str(directory / f"{name}.csv"), "window": list(span), "offset": ["position"]}
        for name, span in motions.items()
    ]


def campaign(directory: Path) -> Campaign:
    """Return the motions that are fitted and those that judge."""
    train, test = (records(directory, motions) for motions in (FITTED, TESTED))
    return Campaign(servo(), channels=CHANNELS, parameters=PARAMETERS, train=train, test=test)


def predicted(network: Network, parameters: Mapping[str, float], record: Record) -> Array:
    """Return the position of a whole motion as a model has it, from rest where the arm began [rad]."""
    begin, end = float(record.time[0]), float(record.time[-1])
    run = network.simulate(
        end,
        begin=begin,
        step=1 / record.rate,
        inputs={"error.u1": record.sampled("command", "hold")},
        guess={"arm.phi": float(record.values["position"][0])},
        parameters=parameters,
        progress=False,
    )
    return run["encoder.phi"][np.searchsorted(run.time, record.time, side="right") - 1]


def scatter(values: Array) -> float:
    """Return the root mean square about the mean."""
    return float(np.std(values))


def unrepeated(record: Record, cycle: int) -> float:
    """Return what the arm does otherwise when the command comes back: its difference over the root of 2."""
    command, position = (
        record.values[n][cycle:] - record.values[n][:-cycle] for n in ("command", "position")
    )
    return scatter(position[np.abs(command) < SAME_COMMAND]) / 2**0.5


def compared(verdict: Verdict, directory: Path) -> dict[str, Compared]:
    """Return the motions that were not fitted, whole, beside the refitted and the corrected model."""
    channels, found = verdict.evidence.campaign.measured, {}
    for name in TESTED:
        record = read_record(directory / f"{name}.csv", channels)
        before = predicted(servo(), verdict.evidence.refit.parameters, record)
        found[name] = Compared(record, before, predicted(verdict.corrected(), verdict.parameters, record))
    return found


def shares(motions: Mapping[str, Compared]) -> str:
    """Return what both models miss of all motions together, over how much these move."""

    def whole(parts: list[Array]) -> float:
        return scatter(np.concatenate([part - part.mean() for part in parts]))

    measured = [motion.record.values["position"] for motion in motions.values()]
    models = zip(*((motion.before, motion.after) for motion in motions.values()), strict=True)
    missed = (whole([m - own for m, own in zip(measured, model, strict=True)]) for model in models)
    return "".join(f"{size / whole(measured):12.2%}" for size in missed)


def draw(motions: Mapping[str, Compared], path: Path) -> Path:
    """Draw a few seconds of each motion, and the errors of both models."""
    figure = Figure(figsize=(11, 11), layout="constrained")
    for row, (name, (record, *models)) in zip(figure.subplots(len(motions), 2), motions.items(), strict=True):
        measured, t = record.values["position"], record.time
        middle = float(np.mean(TESTED[name]))
        shown = np.abs(t - middle) < (2.0 if name == "backlash_detection" else 8.0)
        row[0].step(t[shown], record.values["command"][shown], where="post", color="0.7", label="command")
        row[0].plot(t[shown], measured[shown], "k", label="measured")
        for model, label in zip(models, MODELS, strict=True):
            row[0].plot(t[shown], model[shown], label=label)
            missed = measured - model
            row[1].plot(t, 1e3 * (missed - missed.mean()), lw=0.6, label=label)
        row[0].set(title=name.replace("_", " "), ylabel="position [rad]", xlabel="time [s]")
        row[1].set(ylabel="missed [mrad]", xlabel="time [s]")
    figure.axes[0].legend()
    figure.savefig(path, dpi=110)
    return path


def main() -> None:
    """Print the verdict, the errors on whole motions and what bounds them, and write report and picture."""
    parser = argparse.ArgumentParser(description="SO-101: what a servo's model of three numbers lacks.")
    parser.add_argument("--data", type=Path, default=DATA, help="directory of the records (%(default)s)")
    parser.add_argument(
        "--out", type=Path, default=Path("out"), help="directory for the results (%(default)s)"
    )
    options = parser.parse_args()
    for name in (*FITTED, *TESTED):
        if not (options.data / f"{name}.csv").is_file():
            sys.exit(MISSING.format(file=f"{name}.csv", directory=options.data))
    options.out.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(2) as executor:
        found = diagnose(campaign(options.data), executor=executor, report=progress)
    gap = found.gap["position"]
    print(f"{found.verdict}: {found.sentence}")
    print(f"  position on the test runs, NRMSE: {gap.nominal:.2%} as given, {gap.refit:.2%} refitted, "
          f"{gap.after:.2%} with the effects, noise {gap.floor:.2%}")  # fmt: skip
    for one in found.ranking:
        print(f"  {one.kind:28}{one.site:12}{one.test_gain:8.1%} of the squared test residual, p {one.p:.2g}")
    for line in found.lines:
        print(f"  {line}")
    motions = compared(found, options.data)
    print(f"\n{'mrad':26}{'moves by':>10}{MODELS[0]:>12}{MODELS[1]:>12}")
    for name, (record, before, after) in motions.items():
        measured = record.values["position"]
        sizes = [1e3 * scatter(values) for values in (measured, measured - before, measured - after)]
        print(f"{name:26}{sizes[0]:10.1f}{sizes[1]:12.2f}{sizes[2]:12.2f}")
    print(f"{'of all of it':36}{shares(motions)}")
    for name, cycle in CYCLES.items():
        record = read_record(options.data / f"{name}.csv", found.evidence.campaign.measured)
        print(f"{name} does not repeat itself by {1e3 * unrepeated(record, cycle):.1f} mrad")
    print(f"wrote {write_report(found, options.out / 'so101.html')}")
    print(f"wrote {draw(motions, options.out / 'so101.png')}")


def progress(line: str) -> None:
    """Tell how far the diagnosis is."""
    print(f"  {line}", file=sys.stderr)


if __name__ == "__main__":
    main()
