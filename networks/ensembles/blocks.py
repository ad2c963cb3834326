"""Blocks of members, computed here or by an executor."""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil
from typing import Any

from ...base import Array
from ..csource.crew import CrewProgram
from ..csource.members import Members, Told
from ..sweeps.pool import Point, Pool
from ..sweeps.work import Row

BLOCK_LANES = 8  # members of a block, a lane
MOST_VALUES = 2_000_000  # of a block, which travel back


@dataclass(frozen=True, eq=False)
class Task:
    """What is done with members."""

    program: CrewProgram
    outputs: Array
    rtol: float
    atol: float

    def run(self, members: Members) -> Told:
        """Run members in this process."""
        return self.program.run(members, self.outputs, self.rtol, self.atol)

    def spread(
        self, members: Members, executor: Any, workers: int | None, at: Callable[[int], None]
    ) -> tuple[Told, dict[int, str]]:
        """Run members in blocks by an executor; return what is told, and why blocks were lost, by member.

        Args:
            members: all of them.
            executor: as for a sweep.
            workers: likewise.
            at: called with how many members are done.
        """
        whole = Told.blank(len(members), self.outputs, self.program.width, self.program.lanes)
        lost: dict[int, str] = {}
        pool = Pool(executor, workers, pickle.dumps(self), work_on_blocks)
        done = 0
        for row in pool.rows(self._blocks(members)):
            places = range(int(row.key), int(row.key) + len(row.values["members"]))
            if row.error:
                lost |= dict.fromkeys(places, row.error)
            else:
                whole.take_over(places, row.results["told"])
            done += len(places)
            at(done)
        return whole, lost

    def _blocks(self, members: Members) -> Iterator[Point]:
        each = max(1, len(self.outputs) * self.program.width)
        size = max(1, min(BLOCK_LANES * self.program.lanes, ceil(MOST_VALUES / each)))
        for first in range(0, len(members), size):
            yield str(first), {"members": members.some(slice(first, first + size))}


def work_on_blocks(blob: bytes, points: list[Point]) -> list[Row]:
    """Return what comes of some blocks; runs in another process."""
    task: Task = pickle.loads(blob)
    rows = []
    for key, values in points:
        began = time.perf_counter()
        told = task.run(values["members"])
        rows.append(Row(key, values, {"told": told}, "", time.perf_counter() - began))
    return rows
