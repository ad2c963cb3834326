"""Small changes of states and inputs, from point to point along a run."""

from __future__ import annotations

from dataclasses import dataclass

from ...base import Array


@dataclass(frozen=True, eq=False)
class Forced:
    """Changes dx of the states and du of inputs, from point to point along a run, and signals there.

        dx' = map dx + here du + there du',   dy = to_x dx + to_u du

    Attributes:
        map: (intervals, states, states).
        here, there: by the inputs where an interval begins and ends, (intervals, states, inputs).
        to_x, to_u: of the signals at the points, (points, signals, states or inputs).
    """

    map: Array
    here: Array
    there: Array
    to_x: Array
    to_u: Array
