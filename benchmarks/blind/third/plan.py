"""Which cases the third generation has: laws that no list has, and causes that no static law is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from third.laws import LAWS, OTHERS
from third.machines import MACHINES

BLOCK = [*LAWS, *LAWS, *OTHERS]  # 8 laws and 4 others


@dataclass(frozen=True)
class Draft:
    """What a case is to be; the force is `size` of what the site bears, the noise a share of the output."""

    verdict: str
    kind: str
    machine: str
    joint: str
    size: float
    noise: float
    seed: int


def drafts(count: int, seed: int) -> list[Draft]:
    """Return the drafts of a set; any first 12 of it are balanced by themselves."""
    rng = np.random.default_rng([seed, 3])
    made: list[Draft] = []
    while len(made) < count:
        for kind in map(str, rng.permutation(BLOCK)):
            names = [n for n in MACHINES if _offers(kind, n)]
            machine = names[int(rng.integers(len(names)))]
            joints = _offers(kind, machine)
            joint = joints[int(rng.integers(len(joints)))]
            size, noise = float(rng.uniform(0.2, 0.6)), float(rng.choice([0.001, 0.003, 0.01]))
            verdict = "law" if kind in LAWS else "unknown"
            made.append(Draft(verdict, kind, machine, joint, size, noise, int(rng.integers(2**63))))
    return made[:count]


def _offers(kind: str, machine: str) -> list[str]:
    """Return the joints of a machine at which something may act: what turns freely has no dead band."""
    rig = MACHINES[machine]
    held = [name for name, joint in rig.joints.items() if joint.k]
    if kind in ("dead_band", "softening"):
        return held
    if kind in ("varying_mass", "loose_part"):
        return [] if rig.free else [next(iter(rig.joints))]
    return [*rig.joints]
