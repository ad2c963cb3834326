"""Impacts: the impulses that act at one instant, wherever motions cannot go on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ....base import Array, SimulationError
from ...reduction.transitions import Change, Switching
from .constants import IMPACT_RANK


def partners(switching: Switching, modes: Array, shocks: list[Change]) -> list[Change]:
    """Return the contacts that already hold and pass a shock on, as changes that stay where they are.

    Only shocks that end in contact are shared at once; rebounds strike one after the other, so that
    a row of balls passes a blow on.
    """
    if not all(change.target in switching.in_shock[change.mode] for change in shocks):
        return []
    struck = {change.mode for change in shocks}
    return [
        replace(change, source=change.target)
        for change in switching.changes
        if change.impulse is not None
        and change.mode not in struck
        and change.target == modes[change.mode]
        and change.target in switching.in_shock[change.mode]
    ]


def solve_impact(
    changes: list[Change], response: Array, slopes: Array, everything: Array
) -> tuple[dict[int, float], Array]:
    """Return the impulses that give the wanted velocities, none of them pulling, and the states' step.

    `response` is what a unit of each impulse does to the states, (states, impulses); `slopes` are those of
    the switching expressions in the states, (expressions, states).

    Raises:
        SimulationError: if a velocity does not yield to its impulse, because the motion is prescribed.
    """
    acting = list(changes)
    while True:
        numbers = [int(change.impulse or 0) for change in acting]
        wanted = np.array([everything[c.after] - everything[c.velocity] for c in acting])
        effect = slopes[[c.velocity for c in acting]] @ response[:, numbers]
        immovable = [c.component for c, row in zip(acting, effect, strict=True) if not row.any()]
        if immovable:
            raise SimulationError(
                f"{', '.join(immovable)}: a shock meets a motion that is prescribed on both sides; let a "
                "Mass move freely, or a Spring yield, on one of them"
            )
        size = np.linalg.lstsq(effect, wanted, rcond=IMPACT_RANK)[0]
        if size.min() >= 0 or len(acting) == 1:
            step: Array = response[:, numbers] @ size
            return {n: float(s) for n, s in zip(numbers, size, strict=True)}, step
        del acting[int(size.argmin())]
