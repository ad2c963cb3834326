"""`Tolerance`: how exact a run is to be."""

from __future__ import annotations

from dataclasses import dataclass

# Of runs that ask for none; with so little, motions of micrometres are as exact as those of metres.
RTOL, ATOL = 1e-6, 1e-12
SHARE, FINEST = 0.01, 1e-10


@dataclass(frozen=True)
class Tolerance:
    """Relative and absolute tolerance of a run."""

    rtol: float
    atol: float

    def between_events(self) -> Tolerance:
        """Return what a multistep method keeps to: each event makes it start anew at order 1.

        Not so little that rounding errors rule its steps, unless that was asked for.
        """
        share = min(1.0, max(SHARE, FINEST / self.rtol))
        return Tolerance(share * self.rtol, max(share * self.atol, min(self.atol, ATOL)))
