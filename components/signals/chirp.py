"""Signals whose frequency changes."""

import casadi as ca

from ..language import Stated, mode, parameter
from .sources import Source


class Chirp(Source):
    """A sine whose frequency changes evenly from f_min to f_max, a linear chirp.

    y = offset + amplitude sin(2 pi (f_min t + (f_max - f_min) t^2/(2 T))), where t counts from start_time,
    T is `duration`; before it begins y = offset, after T it goes on at f_max. A frequency that falls has
    f_max below f_min.
    """

    amplitude = parameter("", "amplitude", default=1.0)
    f_min = parameter("Hz", "frequency at its beginning", min=0)
    f_max = parameter("Hz", "frequency after its duration", min=0)
    duration = parameter("s", "how long the frequency changes", above=0)
    offset = parameter("", "mean", default=0.0)
    start_time = parameter("s", "when it begins", default=0.0)
    mode = mode("before", "sweeping", "after", doc="before, while or after the frequency changes")

    def equations(self) -> Stated:
        t = self.time - self.start_time
        sweep = self.f_min * t + (self.f_max - self.f_min) * t**2 / (2 * self.duration)
        on = self.f_max * t - (self.f_max - self.f_min) * self.duration / 2
        turns = self.mode.choose(before=0.0, sweeping=sweep, after=on)
        yield self.y == self.offset + self.amplitude * ca.sin(2 * ca.pi * turns)

    def transitions(self) -> Stated:
        elapsed = self.time - self.start_time
        yield self.mode.goes("before", "sweeping", when=elapsed > 0)
        yield self.mode.goes("sweeping", "after", when=elapsed > self.duration)
