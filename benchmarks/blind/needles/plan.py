"""Which cases the set of needles has: effects of the list whose misfit is a needle in free runs."""

from __future__ import annotations

import numpy as np
from third.plan import Draft

KINDS = {"valleys": ("rotor", "slide"), "stiff_play": ("screw",), "hardening": ("slide", "pair")}
RIPPLED = {"rotor": ("bearing", "brake"), "slide": ("rail",)}
HARDENED = {"slide": ("rail",), "pair": ("left", "middle", "right")}


def drafts(count: int, seed: int) -> list[Draft]:
    """Return the drafts of a set; any first 3 of it are one of each kind."""
    rng = np.random.default_rng([seed, 4])
    made: list[Draft] = []
    while len(made) < count:
        for kind in map(str, rng.permutation(list(KINDS))):
            machine = str(rng.choice(KINDS[kind]))
            joints = {"valleys": RIPPLED, "hardening": HARDENED}.get(kind, {"screw": ("coupling",)})[machine]
            noise = float(rng.choice([0.001, 0.003, 0.01]))
            joint, size, own = str(rng.choice(joints)), rng.uniform(), int(rng.integers(2**63))
            made.append(Draft("effect", kind, machine, joint, size, noise, own))
    return made[:count]
