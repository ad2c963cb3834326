"""Interleaved measurements: every round runs every contender, so noise of the machine hits them all."""

from __future__ import annotations

import os
import resource
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from time import perf_counter, process_time


@dataclass(frozen=True)
class Cost:
    """What one go took."""

    wall: float
    cpu: float


@dataclass(frozen=True)
class Contender:
    """Something that is measured, what it costs, and what is said of it beside its ratio."""

    name: str
    go: Callable[[], Cost]
    remark: str = ""
    target: float | None = None


@dataclass(frozen=True)
class Spread:
    """Median, least and greatest of some ratios."""

    middle: float
    least: float
    most: float

    def __str__(self) -> str:
        return f"{self.middle:.3g} ({self.least:.3g} to {self.most:.3g})"


@dataclass(frozen=True)
class Ratio:
    """Cost of the library over that of a contender, round by round."""

    contender: Contender
    cpu: Spread
    wall: Spread

    @property
    def met(self) -> str:
        """Whether the target is met by the medians of CPU and of wall time."""
        if self.contender.target is None:
            return ""
        return "yes" if max(self.cpu.middle, self.wall.middle) <= self.contender.target else "NO"


def timed(action: Callable[[], object], repeats: int = 3) -> Callable[[], Cost]:
    """Return a go: the median of some calls in this process, after one that does not count."""

    def go() -> Cost:
        action()
        costs = []
        for _ in range(repeats):
            wall, cpu = perf_counter(), process_time()
            action()
            costs.append(Cost(perf_counter() - wall, process_time() - cpu))
        return Cost(median(c.wall for c in costs), median(c.cpu for c in costs))

    return go


def once(action: Callable[[], object]) -> Callable[[], Cost]:
    """Return a go: a single call in this process, for what takes long."""

    def go() -> Cost:
        wall, cpu = perf_counter(), process_time()
        action()
        return Cost(perf_counter() - wall, process_time() - cpu)

    return go


def process(command: Sequence[str], cache: str) -> Callable[[], Cost]:
    """Return a go: a whole process from start to end, its bytecode being kept in the directory `cache`."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    environment["PYTHONPYCACHEPREFIX"] = cache

    def go() -> Cost:
        before, wall = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
        subprocess.run(command, check=True, capture_output=True, env=environment)
        wall, after = perf_counter() - wall, resource.getrusage(resource.RUSAGE_CHILDREN)
        return Cost(wall, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)

    return go


def compare(subject: Contender, peers: Sequence[Contender], rounds: int) -> list[Ratio]:
    """Measure all in turn, starting with another one each round; return subject over peer."""
    everyone = [subject, *peers]
    costs: dict[str, list[Cost]] = {contender.name: [] for contender in everyone}
    for number in range(rounds):
        first = number % len(everyone)
        for contender in everyone[first:] + everyone[:first]:
            costs[contender.name].append(contender.go())
    return [ratio(peer, costs[subject.name], costs[peer.name]) for peer in peers]


def ratio(peer: Contender, ours: Sequence[Cost], theirs: Sequence[Cost]) -> Ratio:
    """Return the spread of the ratios of paired costs."""
    pairs = list(zip(ours, theirs, strict=True))
    return Ratio(peer, spread([a.cpu / b.cpu for a, b in pairs]), spread([a.wall / b.wall for a, b in pairs]))


def spread(values: Sequence[float]) -> Spread:
    """Return median and range."""
    return Spread(median(values), min(values), max(values))
