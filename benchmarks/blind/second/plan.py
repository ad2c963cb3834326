"""Which cases the second generation has: balanced over verdicts, kinds, severities, noise and rigs."""

from __future__ import annotations

import numpy as np
from plan import Dealer, Draft, noises
from second.effects import outside, places
from second.rigs import RIGS

SHARES = {"effect": 14, "none": 3, "parameters": 3, "pair": 4, "twice": 1, "triple": 2, "unknown": 3}
BLOCK = [verdict for verdict, count in SHARES.items() for _ in range(count)]
SINGLE = (10.0, 3.0, 10.0, 3.0, 10.0, 3.0, 1.0)
OTHERS = (10.0, 3.0)


def drafts(count: int, seed: int) -> list[Draft]:
    """Return the drafts of a set; any first 30 of it are balanced by themselves."""
    rng = np.random.default_rng([seed, 2])
    offers = [(rig.name, *offer) for rig in RIGS.values() for offer in places(rig)]
    strange = [(rig.name, *offer) for rig in RIGS.values() for offer in outside(rig)]
    dealer = Dealer(rng, offers, strange)
    turn = dict.fromkeys(SHARES, 0)
    levels = noises(rng)
    made = []
    for block in range(-(-count // len(BLOCK))):
        for verdict in map(str, rng.permutation(BLOCK)[: count - block * len(BLOCK)]):
            severities = SINGLE if verdict == "effect" else OTHERS[:1] if verdict == "unknown" else OTHERS
            severity = severities[turn[verdict] % len(severities)]
            turn[verdict] += 1
            draw = int(rng.integers(2**63))
            made.append(Draft(verdict, severity, next(levels), draw, dealer.options(verdict)))
    return made
