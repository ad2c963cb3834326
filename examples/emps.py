"""EMPS: a measured ball-screw axis, simulated under its control loop beside its measurement.

A motor drives a carriage through a ball screw, and a computer holds it on the reference qg:

    m a = f - d v - f_c sgn(v) - f_0,   f = gtau vir,   vir = kv (kp (qg - qm) - v) + pulses

Mass, friction and offset are fitted to the force of the first record by least squares on filtered
derivatives of the position (IDIM-LS), once without Coulomb friction and once with it, and both models run
on the references of both records. m is carriage, screw and motor in one: the records cannot part them.

What remains in the pictures: near rest the axis rubs with 12 to 17 N, not with 20, and a reversal of its
friction takes it 10 ms or 20 um; a ripple of 1 to 2 N comes back every 2.5 mm of travel; over the length of
the screw friction changes by some 2 N. The loop answers 1 N by 0.73 um, so both errors show one thing.

    python examples/emps.py [--data DIR] [--out DIR]

Source: A. Janot, M. Gautier, M. Brunot, Data Set and Reference Models of EMPS, Workshop on Nonlinear
System Identification Benchmarks, Eindhoven, 2019. The records are not part of this project.
"""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from inertance import (
    Component,
    ConstantForce,
    CoulombFriction,
    Damper,
    Fixed,
    Force,
    Mass,
    Network,
    PositionSensor,
    Result,
    Sampled,
    SpeedSensor,
    SupportFriction,
    signals,
)
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from scipy.io import loadmat
from scipy.signal import butter, decimate, sosfiltfilt

Array = NDArray[np.float64]

SHARED = os.environ.get("INERTANCE_SHARED") or Path(__file__).resolve().parents[2] / "shared"
DATA = Path(SHARED) / "data" / "emps"
FILES = {"estimation": "DATA_EMPS.mat", "pulses": "DATA_EMPS_PULSES.mat"}
MISSING = """no {file} in {directory}
The EMPS records come from https://www.nonlinearbenchmark.org (benchmark "EMPS"), or from the Python package
nonlinear-benchmarks: nonlinear_benchmarks.EMPS(data_file_locations=True) loads them and says where they are.
Give their directory by --data DIR."""
SAMPLE = 1e-3
CUTOFF = 100.0
DECIMATION = 10
EDGE = 50
REVERSAL = (2.95, 3.3)
LABELS = ("force [N]", "force error [N]", "position error [µm]")


@dataclass(frozen=True, eq=False)
class Record:
    """A measured run: time [s], reference and position [m], command and pulses in it [V], gains."""

    t: Array
    qg: Array
    qm: Array
    vir: Array
    pulses: Array
    gtau: float
    kp: float
    kv: float

    @property
    def force(self) -> Array:
        """Motor force [N]."""
        return self.gtau * self.vir


@dataclass(frozen=True)
class Parameters:
    """Mass [kg], viscous friction [N.s/m], offset [N], and Coulomb friction [N] if there is any."""

    m: float
    d: float
    f_0: float
    f_c: float | None = None


MODELS = ("mass + viscous", "mass + viscous + Coulomb")
PUBLISHED = Parameters(m=95.1089, d=203.5034, f_0=-3.1648, f_c=20.3935)


@dataclass(frozen=True, eq=False)
class Comparison:
    """A simulated run beside its record, at the instants of the record."""

    record: Record
    run: Result
    s: Array
    force: Array

    @property
    def s_error(self) -> Array:
        """Simulated less measured position [m]."""
        return self.s - self.record.qm

    @property
    def force_error(self) -> Array:
        """Simulated less measured motor force [N]."""
        return self.force - self.record.force

    @property
    def relative(self) -> float:
        """Norm of the force error over the norm of the force."""
        return float(np.linalg.norm(self.force_error) / np.linalg.norm(self.record.force))


def load(path: Path) -> Record:
    """Read a record; its times are rounded to the millisecond at which they were taken."""
    found = {k: np.asarray(v, dtype=float).ravel() for k, v in loadmat(path).items() if k[0] != "_"}
    gtau, kp, kv = (float(found[k][0]) for k in ("gtau", "kp", "kv"))
    qg, qm, vir = (found[k] for k in ("qg", "qm", "vir"))
    pulses = found.get("pulses_N", np.zeros_like(vir))
    return Record(found["t"].round(3), qg, qm, vir, pulses, gtau, kp, kv)


def estimate(record: Record, coulomb: bool) -> Parameters:
    """Fit m a + d v + f_0 [+ f_c sgn(v)] to the measured force by least squares (IDIM-LS)."""
    low_pass = butter(4, CUTOFF, fs=1 / SAMPLE, output="sos")
    v = np.gradient(sosfiltfilt(low_pass, record.qm), SAMPLE)
    columns = [np.gradient(v, SAMPLE), v, np.ones_like(v)] + [np.sign(v)] * coulomb
    slow = [decimate(column[EDGE:-EDGE], DECIMATION) for column in (*columns, record.force)]
    fitted = np.linalg.lstsq(np.column_stack(slow[:-1]), slow[-1], rcond=None)[0]
    return Parameters(*(float(value) for value in fitted))


def axis(record: Record, parameters: Parameters) -> Network:
    """Return the axis and its control loop as a network.

    The computer takes the speed as difference over two samples, so 1 ms late, and holds its command for a
    sample, so that the drive lags by half of one.
    """
    p, kp, kv = parameters, record.kp, record.kv
    net = Network(
        "EMPS axis",
        bed=Fixed(),
        carriage=Mass(m=p.m),
        viscous=Damper(d=p.d),
        offset=ConstantForce(f_constant=-p.f_0),
        motor=Force(),
        position=PositionSensor(),
        speed=SpeedSensor(),
        late=signals.Delay(T=SAMPLE, n=2),
        dq_ref=signals.Add(u1=Sampled(record.t, record.qg), k1=kp, k2=-kp),
        law=signals.Add(k1=kv, k2=-kv),
        pulses=pulse_train(record),
        vir=signals.Add(),
        drive=signals.FirstOrder(k=record.gtau, T=SAMPLE / 2),
    )
    net.connect(net.carriage.flange, net.viscous.flange_b, net.offset.flange, net.motor.flange)
    net.connect(net.carriage.flange, net.position.flange, net.speed.flange)
    net.connect(net.bed.flange, net.viscous.flange_a)
    net.connect(net.position.s, net.dq_ref.u2)
    net.connect(net.speed.v, net.late.u)
    net.connect(net.dq_ref.y, net.law.u1)
    net.connect(net.late.y, net.law.u2)
    net.connect(net.law.y, net.vir.u1)
    net.connect(net.pulses.y, net.vir.u2)
    net.connect(net.vir.y, net.drive.u)
    net.connect(net.drive.y, net.motor.f)
    if p.f_c is not None:
        net.add(coulomb=SupportFriction(friction=CoulombFriction(f_c=p.f_c)))
        net.connect(net.carriage.flange, net.coulomb.flange)
    return net


def pulse_train(record: Record) -> Component:
    """Return the pulses in the command as a block: 0 or a voltage, in a fixed rhythm.

    The record has them in whole volts. Its law and its command give 5.07 V instead of 5, which puts the
    simulated position 1.8 um off while a pulse is on.
    """
    height = float(record.pulses.max())
    if not height:
        return signals.Constant(k=0.0)
    changes = np.diff(record.pulses)
    first, second = record.t[1:][changes > 0][:2]
    period = float(second - first)
    width = float(record.t[1:][changes < 0][0] - first) / period
    return signals.Pulse(amplitude=height, period=period, width=width, start_time=float(first))


def compare(record: Record, parameters: Parameters) -> Comparison:
    """Simulate the axis on the measured reference, from the measured start."""
    v = (record.qm[1] - record.qm[0]) / SAMPLE
    start = {"carriage.s": record.qm[0], "carriage.v": v, "late.stage1.x": v, "drive.y": record.force[0]}
    run = axis(record, parameters).simulate(float(record.t[-1]), step=SAMPLE, start=start)
    # An event at a sample ends a hair's breadth after it: take what holds from there on.
    at = np.searchsorted(run.time, record.t + 1e-3 * SAMPLE, side="right") - 1
    return Comparison(record, run, run["carriage.s"][at], record.gtau * run["vir.y"][at])


def study(directory: Path) -> tuple[list[Parameters], dict[str, list[Comparison]]]:
    """Fit both models on the first record and run them on both."""
    records = {name: load(directory / file) for name, file in FILES.items()}
    fitted = [estimate(records["estimation"], coulomb) for coulomb in (False, True)]
    return fitted, {name: [compare(record, p) for p in fitted] for name, record in records.items()}


def print_tables(fitted: list[Parameters], runs: dict[str, list[Comparison]]) -> None:
    """Print the parameters beside the published ones, and how far each model is from each record."""
    print(f"{'fitted on ' + FILES['estimation']:26}  m [kg]  d [N.s/m]  f_c [N]  f_0 [N]")
    for model, p in zip((*MODELS, "published"), (*fitted, PUBLISHED), strict=True):
        f_c = "-" if p.f_c is None else f"{p.f_c:.2f}"
        print(f"  {model:24}{p.m:8.2f}{p.d:11.1f}{f_c:>9}{p.f_0:9.2f}")
    print(f"\n{'':26}  position error [um]    force error             run")
    print(f"{'':26}       rms   largest   rms [N]  relative    steps  events  time [s]")
    for name, compared in runs.items():
        print(FILES[name])
        for model, c in zip(MODELS, compared, strict=True):
            s, stats = 1e6 * c.s_error, c.run.stats
            position = f"{rms(s):10.2f}{np.abs(s).max():10.1f}"
            force = f"{rms(c.force_error):10.2f}{c.relative:10.1%}"
            run = f"{stats['steps']:9}{stats['events']:8}{stats['seconds']:10.1f}"
            print(f"  {model:24}{position}{force}{run}")


def rms(values: Array) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(values**2)))


def picture(name: str, compared: list[Comparison]) -> Figure:
    """Plot force, force error and position error, over the whole record and around a reversal."""
    record = compared[0].record
    figure = Figure(figsize=(13, 8), layout="constrained")
    figure.suptitle(f"EMPS, {FILES[name]}: simulated under its control loop, beside the measurement")
    panels = figure.subplots(3, 2, sharex="col", sharey="row", width_ratios=(2, 1))
    for force, force_error, s_error in panels.T:
        force.plot(record.t, record.force, color="black", label="measured")
        for model, c in zip(MODELS, compared, strict=True):
            force.plot(record.t, c.force, label=model)
            force_error.plot(record.t, c.force_error, color=force.lines[-1].get_color())
            s_error.plot(record.t, 1e6 * c.s_error, color=force.lines[-1].get_color())
        s_error.set_xlabel("time [s]")
    panels[0, 0].set_xlim(record.t[0], record.t[-1])
    panels[0, 1].set_xlim(*REVERSAL)
    for axes, label in zip(panels[:, 0], LABELS, strict=True):
        axes.set_ylabel(label)
    for line in figure.findobj(Line2D):
        line.set_linewidth(0.8)
    panels[0, 0].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3, frameon=False)
    return figure


def main() -> None:
    """Print the tables and write a picture for each record."""
    parser = argparse.ArgumentParser(description="EMPS: a measured ball-screw axis beside its simulation.")
    parser.add_argument("--data", type=Path, default=DATA, help="directory of the records (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("out"), help="directory for pictures (%(default)s)")
    options = parser.parse_args()
    for file in FILES.values():
        if not (options.data / file).is_file():
            sys.exit(MISSING.format(file=file, directory=options.data))
    fitted, runs = study(options.data)
    print_tables(fitted, runs)
    options.out.mkdir(parents=True, exist_ok=True)
    for name, compared in runs.items():
        path = options.out / f"emps_{name}.png"
        picture(name, compared).savefig(path, dpi=150)
        print(f"wrote {path}")


if __name__ == "__main__":
    main()
