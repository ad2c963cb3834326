"""A planetary flywheel inerter identified in three stages, as Ge & Wang do on their rig.

    python examples/staged_identification.py

Three experiments on three machines that share a ball screw, each with what the stages before it found:

1. eq. (28): friction of the screw, without flywheel, 20 mm at 0.1 Hz, forces through a low-pass of 0.5 Hz;
2. eq. (29): nut, inertia, stiffness, damping and clearance of the screw, with a disk, 10 mm at 3 Hz;
3. eq. (30): meshes and friction of the planets, 10 mm at 3 Hz.

What a stage has found is known in the next to its standard error, no better. Held fast, the viscous friction
of stage 1, known to 2 %, would leave several newtons at 3 Hz for other parameters to explain wrongly.

Nobody has published the records, so they are made here by machines with other parameters than the models
start from, plus noise. What the experiments cannot tell is said in the warnings.

Source: Ge & Wang, Modeling, Testing, and Characteristic Analysis of a Planetary Flywheel Inerter, eqs.
(28)-(30), tables 1-4.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import inertance as ia
import numpy as np
from inertance.identification import Campaign, Fit, Record
from inertance.machines import BallScrewInerter, Sinusoid

RATE = 1000.0  # Hz
NOISE = 1.0  # N
UNKNOWN = 0.3  # relative standard deviation before the fit
FRICTION, SCREW, DISK, PLANETS = (
    f"inerter.{part}" for part in ("screw.friction", "screw", "flywheel", "flywheel")
)

MODEL: dict[str, dict[str, float]] = {
    "friction": {"tau_c": 0.19, "tau_s": 0.22, "w_s": 5.437e8, "d": 2.7e-3},
    "screw": {"lead": 0.010, "m_r": 1.7, "k": 1.2e7, "d": 1.2e3, "eps": 1e-7},
    "disk": {"m": 0.974, "R": 0.050, "J_s": 2.8e-5},
    "planets": {
        "R": 0.050, "r": 0.017, "J_s": 3.17e-4, "J_p": 1.66e-5, "J_r": 1.02e-4,
        "k_r": 1.35e9, "c_r": 4.7e4, "g_r": 1.8e-9, "T_pm": 8e-4, "T_pv": 1.4e-4,
    },
}  # fmt: skip
TRUTH: dict[str, dict[str, float]] = {
    "friction": {**MODEL["friction"], "tau_s": 0.26, "d": 3.3e-3},
    "screw": {**MODEL["screw"], "m_r": 1.55, "k": 1.05e7, "d": 1.5e3},
    "disk": {**MODEL["disk"], "m": 1.06},
    "planets": {**MODEL["planets"], "T_pm": 1.1e-3, "T_pv": 1.8e-4},
}
Values = dict[str, dict[str, Any]]


def rig(flywheel: ia.Component, values: Values) -> ia.Network:
    """Return the rig: housing on the frame, rod on an actuator that prescribes its motion, a load cell."""
    friction = ia.rotational.StribeckFriction(**values["friction"])
    screw = ia.CompliantNutScrew(**values["screw"], friction=friction)
    net = ia.Network(
        "rig",
        frame=ia.Fixed(),
        inerter=BallScrewInerter(screw=screw, flywheel=flywheel),
        load_cell=ia.ForceSensor(),
        actuator=ia.Position(),
    )
    net.connect(net.actuator.flange, net.load_cell.flange_a)
    net.connect(net.load_cell.flange_b, net.inerter.flange_a)
    return net.connect(net.inerter.flange_b, net.frame.flange)


def bare(values: Values) -> ia.Network:
    """Return the rig with the screw alone, a light hub in place of the flywheel."""
    return rig(ia.DiskFlywheel(m=0.01, R=0.01, J_s=values["disk"]["J_s"]), values)


def disk(values: Values) -> ia.Network:
    """Return the rig with the disk."""
    return rig(ia.DiskFlywheel(**values["disk"]), values)


def planetary(values: Values) -> ia.Network:
    """Return the rig with the planets."""
    return rig(ia.PlanetaryFlywheel(N=4, **values["planets"]), values)


@dataclass(frozen=True)
class Experiment:
    """A machine, how it is driven, and what is fitted: by name, the group of values it belongs to."""

    title: str
    build: Callable[[Values], ia.Network]
    excitation: Sinusoid
    duration: float
    fitted: dict[str, tuple[str, str]]
    filter: dict[str, float] | None = None


def named(path: str, group: str, *names: str) -> dict[str, tuple[str, str]]:
    """Return parameters of a component by path, with where their values stand."""
    return {f"{path}.{name}": (group, name) for name in names}


EXPERIMENTS = (
    Experiment(
        "(28) friction of the screw, no flywheel, 20 mm at 0.1 Hz",
        bare,
        Sinusoid(0.020, 0.1),
        20.0,
        named(FRICTION, "friction", "tau_c", "tau_s", "d"),
        {"cutoff": 0.5, "order": 6},
    ),
    Experiment(
        "(29) screw, with the disk, 10 mm at 3 Hz",
        disk,
        Sinusoid(0.010, 3.0),
        4.0,
        {**named(SCREW, "screw", "m_r", "k", "d", "eps"), **named(DISK, "disk", "m")},
    ),
    Experiment(
        "(30) planets, 10 mm at 3 Hz",
        planetary,
        Sinusoid(0.010, 3.0),
        4.0,
        named(PLANETS, "planets", "k_r", "c_r", "g_r", "T_pm", "T_pv"),
    ),
)


def measured(experiment: Experiment, seed: int = 0) -> Record:
    """Return what the true machine shows, with the noise of its load cell."""
    drive = ia.identification.sampled(experiment.excitation, stop=experiment.duration, rate=RATE, fade=0.5)
    run = experiment.build(TRUTH).simulate(
        experiment.duration,
        step=1 / RATE,
        inputs={"actuator.s_ref": drive},
        rtol=1e-9,
        atol=1e-11,
        progress=False,
    )
    at = np.searchsorted(run.time, drive.time + 0.5e-3 / RATE, side="right") - 1
    noise = np.random.default_rng(seed).normal(0, NOISE, len(at))
    return Record(experiment.title, drive.time, {"x": drive.values, "F": run["load_cell.f"][at] + noise})


def identify(experiment: Experiment, values: Values, known: dict[str, float], record: Record) -> Fit:
    """Fit what an experiment is for, and what is known of the machine already within its error."""
    network = experiment.build(values)
    present = network.dae().parameter_values
    parameters = {name: {"rel": error / present[name]} for name, error in known.items() if name in present}
    parameters |= {name: {"rel": UNKNOWN} for name in experiment.fitted}
    stage: list[dict[str, Any]] = [{"filter": experiment.filter}] if experiment.filter else []
    campaign = Campaign(
        network,
        channels={"x": {"input": "actuator.s_ref", "unit": "m"}, "F": {"output": "load_cell.f", "unit": "N"}},
        parameters=parameters,
        train=[{"record": record, "initial": "rest"}],
        noise={"F": NOISE},
        stage=stage,
    )
    return ia.fit(campaign)


def study() -> list[Fit]:
    """Run the three stages, each from what those before it found."""
    values = {group: dict(own) for group, own in MODEL.items()}
    places: dict[str, tuple[str, str]] = {}
    known: dict[str, float] = {}
    found = []
    for experiment in EXPERIMENTS:
        done = identify(experiment, values, known, measured(experiment))
        places |= experiment.fitted
        for name, value in done.values.items():
            group, key = places[name]
            values[group][key] = value
            known[name] = done.errors[name]
        found.append(done)
    return found


def main() -> None:
    """Print each stage: values with standard errors, and what the record cannot tell."""
    for experiment, done in zip(EXPERIMENTS, study(), strict=True):
        print(f"\n{experiment.title}\n{done.table()}")
        for name, (group, key) in experiment.fitted.items():
            print(f"  {name}: {done.values[name]:.6g}, true {TRUTH[group][key]:.6g}")


if __name__ == "__main__":
    main()
