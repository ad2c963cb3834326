"""Which cases there are: balanced over verdicts, kinds, severities, noise and topologies, drawn by seed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from effects import outside, places
from rigs import RIGS

BLOCK = ["effect"] * 15 + ["pair"] * 2 + ["none"] * 2 + ["parameters"] * 2 + ["unknown"] * 3
SEVERITIES = (10.0, 3.0, 1.0)
NOISES = (0.01, 0.001, 0.03)


@dataclass(frozen=True)
class Draft:
    """What a case is to be; `options` are (rig, kind, place, sites) in the order to try."""

    verdict: str
    severity: float
    noise: float
    seed: int
    options: tuple[tuple[str, str, str, tuple[str, ...]], ...]


def drafts(count: int, seed: int) -> list[Draft]:
    """Return the drafts of a set; any first 24 of it are balanced by themselves."""
    rng = np.random.default_rng(seed)
    offers = [(rig.name, *offer) for rig in RIGS.values() for offer in places(rig)]
    strange = [(rig.name, *offer) for rig in RIGS.values() for offer in outside(rig)]
    dealer = Dealer(rng, offers, strange)
    turn: Counter[str] = Counter()
    levels = noises(rng)
    made = []
    for block in range(-(-count // len(BLOCK))):
        order = rng.permutation(BLOCK)
        for verdict in order[: count - block * len(BLOCK)]:
            severity = SEVERITIES[turn[verdict] % 3] if verdict == "effect" else SEVERITIES[turn[verdict] % 2]
            turn[verdict] += 1
            draw = int(rng.integers(2**63))
            made.append(Draft(str(verdict), severity, next(levels), draw, dealer.options(str(verdict))))
    return made


class Dealer:
    """Deals kinds in turn, and for each kind the places least dealt so far."""

    def __init__(
        self,
        rng: np.random.Generator,
        offers: list[tuple[str, str, str, tuple[str, ...]]],
        strange: list[tuple[str, str, str, tuple[str, ...]]],
    ) -> None:
        self.rng, self.offers, self.strange = rng, offers, strange
        self.dealt: Counter[str] = Counter()

    def options(self, verdict: str) -> tuple[tuple[str, str, str, tuple[str, ...]], ...]:
        """Return what a case may be made of, best first."""
        offers = self.strange if verdict == "unknown" else self.offers
        if verdict in ("none", "parameters"):
            offers = [(name, "", "", ()) for name in dict.fromkeys(offer[0] for offer in self.offers)]
        kinds = sorted({offer[1] for offer in offers})
        jitter = {offer: self.rng.uniform() for offer in offers}
        least = {kind: self.dealt[f"{verdict} {kind}"] + self.rng.uniform() for kind in kinds}
        order = sorted(
            offers, key=lambda o: (least[o[1]], self.dealt[f"{o[1]} {o[0]}"], self.dealt[o[0]], jitter[o])
        )
        self.dealt.update((f"{verdict} {order[0][1]}", f"{order[0][1]} {order[0][0]}", order[0][0]))
        return tuple(order)


def noises(rng: np.random.Generator) -> Iterator[float]:
    while True:
        yield from (float(x) for x in rng.permutation(NOISES))
