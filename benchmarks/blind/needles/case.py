"""One case of the needles: ripple that holds in valleys, play behind a stiff screw, a spring driven hard."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from third.case import RATE, off_nominal, usual, write
from third.case import drive as driven
from third.machines import MACHINES, Cause, Joint, Machine, run
from third.plan import Draft

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


@dataclass(frozen=True)
class _Rig:
    """A machine with its true parameters, its input at half steps, and whether its records begin at rest."""

    machine: Machine
    values: dict[str, float]
    drive: Array
    begin: str

    def run(self, cause: Cause, rate: float = RATE) -> tuple[Array, Array]:
        """Return coordinates and speeds."""
        return run(self.machine, self.values, cause, self.drive, 1 / rate)


def make(draft: Draft, folder: Path) -> dict[str, Any]:
    """Write campaign, model and records of a case, and return its label."""
    rng = np.random.default_rng(draft.seed)
    machine = SCREW if draft.machine == "screw" else MACHINES[draft.machine]
    values = off_nominal(machine, rng)
    begin = "motion" if rng.uniform() < 0.5 else "rest"
    finer = FINER if draft.kind == "stiff_play" else 1
    drive = driven(machine, begin, rng, RATE * finer)
    cause = {"valleys": _valleys, "stiff_play": _stiff_play, "hardening": _hardening}[draft.kind]
    rig = _Rig(machine, values, drive, begin)
    acting = cause(draft, rig, rng)
    q, v = (seen[::finer] for seen in rig.run(acting, RATE * finer))
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


def _valleys(draft: Draft, rig: _Rig, rng: np.random.Generator) -> Cause:
    """Return a ripple as large as what drives the machine; one that begins at rest begins in a valley."""
    travel, _, force = usual(rig.machine, draft.joint, rig.values, rig.drive)
    size = force * np.interp(draft.size, (0, 1), AMPLITUDES)
    period, phase = travel * rng.uniform(*PERIODS), 0.0 if rig.begin == "rest" else rng.uniform(0, 2 * np.pi)
    return Cause(draft.joint, lambda t, s, v: size * np.sin(2 * np.pi * s / period + phase))


def _stiff_play(draft: Draft, rig: _Rig, rng: np.random.Generator) -> Cause:
    """Return a stiff coupling that carries beyond a gap."""
    plain, _ = rig.run(Cause("coupling", _contact(rig.values, 0.0)), RATE * FINER)
    half = 0.5 * float(np.ptp(plain[:, 0, 1])) * np.geomspace(*GAPS, 101)[round(100 * draft.size)]
    return Cause("coupling", _contact(rig.values, half))


def _contact(values: dict[str, float], half: float) -> Any:
    stiffness, damping = values["coupling.c"], values["coupling.d"]

    def torque(t: float, s: Array, v: Array) -> Array:
        deep = np.sign(s) * np.maximum(np.abs(s) - half, 0.0)
        pushed = stiffness * deep + damping * v * (deep != 0)
        return np.where(pushed * deep > 0, pushed, 0.0) if half else stiffness * s + damping * v

    return torque


def _hardening(draft: Draft, rig: _Rig, rng: np.random.Generator) -> Cause:
    """Return a cubic spring that is, where the motion turns, 1.8 to 2.5 times as stiff as without it."""
    joint, more = rig.machine.joints[draft.joint], np.interp(draft.size, (0, 1), (0.8, 1.5))
    stiffness, cubic = rig.values[joint.k], 0.0
    for _ in range(SETTLING):
        moved = rig.run(_cubic(draft.joint, cubic))[0] @ np.array(joint.row)
        cubic = more * stiffness / (3 * float(np.quantile(np.abs(moved), 0.99)) ** 2)
    return _cubic(draft.joint, cubic)


def _cubic(joint: str, cubic: float) -> Cause:
    return Cause(joint, lambda t, s, v: cubic * s**3)
