"""A common start: values that two sides return to each other unchanged."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...base import Array
from ..errors import FMUError

ROUNDS = 30
CLOSE = 1e-9


def unchanged(answer: Callable[[Array], Array], guess: Array, problem: str) -> Array:
    """Return u = answer(u), by Broyden's method from plain repetition on.

    Raises:
        FMUError: beginning with the `problem`, if it is not found.
    """
    u, leap = guess, np.eye(len(guess))
    rest = answer(u) - u
    for _ in range(ROUNDS + len(guess)):
        if (np.abs(rest) <= CLOSE * np.abs(u) + CLOSE**2).all():
            return u
        move = leap @ rest
        u = u + move
        change = answer(u) - u - rest
        rest = rest + change
        weight = move @ leap
        if abs(weight @ change) > 0:
            leap = leap - np.outer(move + leap @ change, weight) / (weight @ change)
    raise FMUError(
        f"{problem}, as one answers to the other at once and they contradict; put a state (a mass, a lag) "
        "between them"
    )
