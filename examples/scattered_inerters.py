"""2000 planetary flywheel inerters as they leave the workshop: how the force on the rod scatters.

    python examples/scattered_inerters.py

Stiffness, clearance and friction of each differ by what the tolerances of manufacture allow. All run on the
rig at 10 mm and 3 Hz, sticking and slipping, side by side in the lanes of this processor. They begin as they
roll with the rod.
"""

from __future__ import annotations

from math import pi
from pathlib import Path

import inertance as ia
import matplotlib.pyplot as plt
import numpy as np
from inertance.machines import Sinusoid, ge_wang, inerter_rig

TOLERANCES = {  # standard deviations, as shares of the nominal values
    "inerter.screw.k": 0.10,
    "inerter.screw.eps": 0.30,
    "inerter.screw.friction.tau_c": 0.15,
    "inerter.flywheel.T_pm": 0.15,
    "inerter.flywheel.J_p": 0.01,
}
BANDS = 5, 25, 50, 75, 95  # %
FORCE, PEAK = "inerter.flange_a.f", "peak [N]"
AMPLITUDE, FREQUENCY = 0.010, 3.0  # m, Hz
PLANET = "inerter.flywheel.planet"


def rolling(rig: ia.DAE) -> dict[str, float]:
    """Return start values with which screw and planets roll with the rod."""
    values = rig.parameter_values
    lead, ring, planet = (values[f"inerter.{name}"] for name in ("screw.lead", "flywheel.R", "flywheel.r"))
    screw = 2 * pi / lead * AMPLITUDE * 2 * pi * FREQUENCY
    return {f"{PLANET}.w_s": screw, f"{PLANET}.w_p": screw * (ring - planet) / planet}


def run(count: int, seed: int = 0) -> ia.Ensemble:
    """Return so many inerters, one stroke of each."""
    rig = inerter_rig(ge_wang.planetary_inerter(), Sinusoid(AMPLITUDE, FREQUENCY)).dae()
    draw, nominal = np.random.default_rng(seed), rig.parameter_values
    scatter = {name: nominal[name] * draw.lognormal(0.0, share, count) for name, share in TOLERANCES.items()}
    return ia.ensemble(rig, 1 / FREQUENCY, signals=FORCE, parameters=scatter, starts=rolling(rig), step=5e-4)


def table(many: ia.Ensemble) -> dict[str, tuple[float, ...]]:
    """Return percentiles of the peak force, and of how often each inerter sticks or slips."""
    peaks = np.abs(many[FORCE]).max(axis=1)
    told = {PEAK: peaks, "events": many.event_counts}
    return {name: tuple(np.percentile(values, BANDS)) for name, values in told.items()}


def draw(many: ia.Ensemble, path: Path) -> None:
    """Draw the force over time: the median, and where half and nine tenths of all inerters lie."""
    low, lower, middle, upper, high = np.percentile(many[FORCE], BANDS, axis=0)
    figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
    axes.fill_between(many.time, low, high, alpha=0.25, label="nine tenths")
    axes.fill_between(many.time, lower, upper, alpha=0.5, label="half")
    axes.plot(many.time, middle, lw=1, label="median")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("force on the rod [N]")
    axes.legend(loc="upper left")
    figure.savefig(path)
    plt.close(figure)


def main() -> None:
    """Run, print the percentiles, draw the bands."""
    many = run(2000)
    print(many)
    seconds, lanes = many.stats["seconds"], many.stats["lanes"]
    print(f"{seconds:.1f} s with {lanes} lanes, {many.stats['lane efficiency']:.1%} of their steps taken")
    print(f"{'percentile':>12}" + "".join(f"{band:>9} %" for band in BANDS))
    for name, values in table(many).items():
        print(f"{name:>12}" + "".join(f"{value:>11.0f}" for value in values))
    path = Path("scattered_inerters.png")
    draw(many, path)
    print(f"written: {path}")


if __name__ == "__main__":
    main()
