"""One case of the needles: ripple that holds in valleys, play behind a stiff screw, a spring driven hard."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from needles.plan import Draft
from numpy.typing import NDArray
from third.case import RATE, off_nominal, usual, write
from third.case import drive as driven
from third.machines import MACHINES, Cause, Joint, Machine, run

Array = NDArray[np.float64]
ANSWERS = {
    "valleys": ("position_ripple", "harmonic_ripple"),
    "stiff_play": ("backlash",),
    "hardening": ("cubic_stiffness",),
}
SCREW = replace(
    MACHINES["rotor"],
    name="screw",
    values={"coupling.c": 6000.0, "coupling.d": 0.6, "bearing.d": 0.12, "brake.d": 0.1},
    uncertain=("bearing.d", "brake.d"),
    joints=MACHINES["rotor"].joints | {"coupling": Joint((-1.0, 1.0), ("coupling",))},
    drive=(1.2, 0.2, 8.0),
)
AMPLITUDES, PERIODS = (0.8, 1.6), (0.3, 0.8)  # of a ripple, in the usual force and the usual travel
GAPS = (0.005, 0.05)  # of half a play, in the range of the load
SETTLING = 6  # runs in which the stiffness at the turning points comes to twice its own
FINER = 4  # steps of a stiff contact


def make(draft: Draft, folder: Path) -> dict[str, Any]:
    """Write campaign, model and records of a case, and return its label."""
    rng = np.random.default_rng(draft.seed)
    machine = SCREW if draft.machine == "screw" else MACHINES[draft.machine]
    values = off_nominal(machine, rng)
    begin = "motion" if rng.uniform() < 0.5 else "rest"
    finer = FINER if draft.kind == "stiff_play" else 1
    drive = driven(machine, begin, rng, RATE * finer)
    cause = {"valleys": _valleys, "stiff_play": _stiff_play, "hardening": _hardening}[draft.kind]
    acting = cause(draft, machine, values, drive, begin, rng)
    q, v = (seen[::finer] for seen in run(machine, values, acting, drive, 1 / RATE / finer))
    write(folder, machine, begin, draft.noise, drive[::finer], q, v, rng)
    return {
        "generation": 4,
        "verdict": "effect",
        "group": "effect",
        "kind": draft.kind,
        "rig": machine.name,
        "severity": draft.size,
        "noise": draft.noise,
        "begin": begin,
        "effects": [{"kind": draft.kind, "answers": []}],
        "kinds": list(ANSWERS[draft.kind]),
        "sites": list(machine.joints[draft.joint].sites),
    }


def _valleys(
    draft: Draft,
    machine: Machine,
    values: dict[str, float],
    drive: Array,
    begin: str,
    rng: np.random.Generator,
) -> Cause:
    """Return a ripple as large as what drives the machine; one that begins at rest begins in a valley."""
    travel, _, force = usual(machine, draft.joint, values, drive)
    size = force * np.interp(draft.size, (0, 1), AMPLITUDES)
    period, phase = travel * rng.uniform(*PERIODS), 0.0 if begin == "rest" else rng.uniform(0, 2 * np.pi)
    return Cause(draft.joint, lambda t, s, v: size * np.sin(2 * np.pi * s / period + phase))


def _stiff_play(
    draft: Draft,
    machine: Machine,
    values: dict[str, float],
    drive: Array,
    begin: str,
    rng: np.random.Generator,
) -> Cause:
    """Return a stiff coupling that carries beyond a gap."""
    plain = run(machine, values, Cause("coupling", _contact(values, 0.0)), drive, 1 / RATE / FINER)[0]
    half = 0.5 * float(np.ptp(plain[:, 0, 1])) * np.geomspace(*GAPS, 101)[round(100 * draft.size)]
    return Cause("coupling", _contact(values, half))


def _contact(values: dict[str, float], half: float) -> Any:
    stiffness, damping = values["coupling.c"], values["coupling.d"]

    def torque(t: float, s: Array, v: Array) -> Array:
        deep = np.sign(s) * np.maximum(np.abs(s) - half, 0.0)
        pushed = stiffness * deep + damping * v * (deep != 0)
        return np.where(pushed * deep > 0, pushed, 0.0) if half else stiffness * s + damping * v

    return torque


def _hardening(
    draft: Draft,
    machine: Machine,
    values: dict[str, float],
    drive: Array,
    begin: str,
    rng: np.random.Generator,
) -> Cause:
    """Return a cubic spring that is, where the motion turns, 1.8 to 2.5 times as stiff as without it."""
    row, more = np.array(machine.joints[draft.joint].row), np.interp(draft.size, (0, 1), (0.8, 1.5))
    stiffness, cubic = values[machine.joints[draft.joint].k], 0.0
    for _ in range(SETTLING):
        moved = run(machine, values, _cubic(draft.joint, cubic), drive, 1 / RATE)[0] @ row
        cubic = more * stiffness / (3 * float(np.quantile(np.abs(moved), 0.99)) ** 2)
    return _cubic(draft.joint, cubic)


def _cubic(joint: str, cubic: float) -> Cause:
    return Cause(joint, lambda t, s, v: cubic * s**3)
