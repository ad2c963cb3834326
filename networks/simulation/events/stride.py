"""Pace: how far one call of the integrator goes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....base import Array
from ..run import Run, record_here

LEAST_EXPONENT, FINE_EXPONENT, FIRST_EXPONENT, MOST_EXPONENT = -30, -3, 4, 6
DELAYS_AHEAD = 2  # how far beyond an expected event a stretch may go
LIMIT_SLACK = 1 + 1e-9


@dataclass(eq=False)
class Pace:
    """Stretches of 2^exponent output intervals, so that outputs are nodes of a stretch.

    Attributes:
        next: number of the output that comes next.
        since: what `next` was at the last event.
        limit: where a stretch ended that could not be integrated; none goes beyond it before an event.
    """

    outputs: Array
    next: int = 1
    since: int = 0
    exponent: int = FIRST_EXPONENT
    limit: float = np.inf

    @property
    def interval(self) -> float:
        """Time between outputs."""
        return float(self.outputs[1] - self.outputs[0])

    def stretch(self, t: float, delay: float, end: float, longest: float) -> tuple[float, int]:
        """Return where the next stretch from t ends, within the leg, and how many outputs it reaches.

        An event is expected after a `delay`, beyond which to go far would be in vain.
        """
        self._stay_within_limit(t)
        on_grid = t == self.outputs[self.next - 1]
        intervals = 2**self.exponent if on_grid and self.exponent >= 0 else 1
        remaining = int(np.searchsorted(self.outputs, end, "right")) - self.next
        most = min(DELAYS_AHEAD * delay, longest)
        while intervals > remaining or (intervals > 1 and self.interval * intervals > most):
            intervals //= 2
        stop = float(self.outputs[self.next + intervals - 1]) if intervals else end
        span = min(self.interval * 2.0**self.exponent if self.exponent < 0 else np.inf, longest)
        return (t + span, 0) if stop - t > span else (stop, intervals)

    def entered(self, run: Run) -> None:
        """Go on from where a leg begins, and record it if it is an output."""
        self.limit = np.inf
        if self.next < len(self.outputs) and self.outputs[self.next] <= run.point.t:
            record_here(run)
            self.next += 1

    def _stay_within_limit(self, t: float) -> None:
        left = self.limit - t
        if left <= 0:
            self.limit = np.inf
            return
        while self.exponent > LEAST_EXPONENT and self.interval * 2.0**self.exponent > LIMIT_SLACK * left:
            self.exponent -= 1

    def failed(self, end: float, intervals: int) -> None:
        """Make the next stretch shorter than one that could not be integrated to its end."""
        self.limit = end
        self.retry(intervals)

    def retry(self, intervals: int) -> None:
        """Make the next stretch shorter than one that was too long."""
        self.exponent = min(self.exponent, intervals.bit_length() - 1) - 1

    def passed(self) -> None:
        """Make the next stretch longer than one in which nothing happened."""
        self.exponent = min(self.exponent + 1, MOST_EXPONENT)

    def crossed(self) -> None:
        """Make stretches fit the time between events."""
        self.exponent = max(self.exponent - 1, min((self.next - self.since).bit_length(), MOST_EXPONENT))
        self.since = self.next
        self.limit = np.inf
