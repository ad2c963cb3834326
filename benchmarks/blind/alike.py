"""Which other effects change records as a true one does, to less than all samples can tell."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from assembly import Motion
from effects import Effect, Offer
from stepper import Array

APART = 10.0  # chi squared below which two answers are one
SCALED = 12  # times at most, as a shift is not quite linear
CLOSE = 1e-4  # change of a size that is none
ELSEWHERE = ("arm_gravity",)  # linear, too, and may be thought to act on what moves alike
LINEAR = ("constant_force", "added_inertia", "sensor_delay", "sensor_bias", "sensor_gain", "actuator_delay")


class Rivals:
    """What may be taken for an effect.

    Args:
        left: what an effect of a size changes in the records over noise, what else may explain it taken off.
        guess: a size from which the search for one begins.
        weight: samples in all records for one that is looked at.
    """

    def __init__(
        self, left: Callable[[Effect, float], Array], guess: Callable[[Effect], float], weight: float
    ) -> None:
        self.left, self.guess, self.weight = left, guess, weight

    def of(
        self, effect: Effect, change: Array, offers: Sequence[Offer], motions: Mapping[str, Motion]
    ) -> list[tuple[str, str]]:
        """Return kinds and sites that change records as `effect` does, by `change`, to less than APART."""
        elsewhere: list[Offer] = [
            (effect.kind, place, motion.sites)
            for place, motion in motions.items()
            if effect.kind in ELSEWHERE
        ]
        rivals = [
            offer
            for offer in [*offers, *elsewhere]
            if offer[:2] != (effect.kind, effect.place)
            and (
                offer[0] in LINEAR
                or (offer[0], offer[1]) == ("coulomb_friction", effect.place)
                or offer in elsewhere
            )
        ]
        found = [offer for offer in rivals if self._is(offer, effect, change)]
        return [(kind, site) for kind, _, sites in found for site in sites]

    def _is(self, offer: Offer, effect: Effect, change: Array) -> bool:
        """Return whether some size of a kind at a place makes a change, that of an effect, of the records."""
        kind, place, _ = offer
        shape = effect.shape if kind == effect.kind else {}
        for sign in (1.0, -1.0):
            other = Effect(kind, place, (), {**shape, "sign": sign, "filtered": 0.0})
            size = self.guess(other)
            for _ in range(SCALED):
                trial = self.left(other, size)
                if self.weight * float(np.sum((change - trial) ** 2)) < APART:
                    return True
                share = float(trial @ change) / max(float(trial @ trial), 1e-300)
                if share <= 0 or abs(share - 1) < CLOSE:
                    break
                size *= share
        return False
