"""Blocks of members, computed here or by an executor."""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable, Iterator
from functools import lru_cache
from math import ceil
from typing import Any

from ..csource.members import Members, Status, Told
from ..lanes.task import Task
from ..sweeps.pool import Point, Pool
from ..sweeps.work import Row

BLOCK_LANES = 8  # members of a block, a lane
MOST_VALUES = 2_000_000  # of a block, which travel back


def spread(
    task: Task, members: Members, told: Told, executor: Any, workers: int | None, at: Callable[[int], None]
) -> None:
    """Run members in blocks by an executor, as a sweep does its points; `at` hears how many are done."""
    done, pool = 0, Pool(executor, workers, pickle.dumps(task), work_on_blocks)
    for row in pool.rows(_blocks(task, members)):
        places = range(int(row.key), int(row.key) + len(row.values["members"]))
        if row.error:
            told.messages |= dict.fromkeys(places, row.error)
            told.status[places] = Status.FAILED
        else:
            told.take_over(places, row.results["told"])
        done += len(places)
        at(done)


def _blocks(task: Task, members: Members) -> Iterator[Point]:
    each = max(1, len(task.outputs) * task.program.width)
    size = max(1, min(BLOCK_LANES * task.program.lanes, ceil(MOST_VALUES / each)))
    for first in range(0, len(members), size):
        yield str(first), {"members": members.some(slice(first, first + size))}


@lru_cache(maxsize=4)
def _task(blob: bytes) -> Task:
    task: Task = pickle.loads(blob)
    return task


def work_on_blocks(blob: bytes, points: list[Point]) -> list[Row]:
    """Return what comes of some blocks; runs in another process."""
    task, rows = _task(blob), []
    for key, values in points:
        began = time.perf_counter()
        told = task.blank(len(values["members"]))
        task.run(values["members"], told)
        rows.append(Row(key, values, {"told": told}, "", time.perf_counter() - began))
    return rows
