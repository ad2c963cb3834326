"""Send points to processes and get every result back, whatever happens to the processes."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from functools import cache
from typing import Any

from ...base import ModelError
from ...base.processes import Processes
from .work import Row, Values, work

Point = tuple[str, Values]
TASK_SECONDS = 0.05
MOST_POINTS = 64
ATTEMPTS = 2
LOST_TASKS = ("KilledWorker", "CancelledError", "FutureCancelledError", "CommClosedError")  # also of dask


class Pool:
    """An executor that may break, and what is under way in it.

    A task is lost if its process dies. Its points are tried again, each alone, so that a point that kills
    processes is found: after the second time it gets a row that says so.

    The executor is one of `concurrent.futures`, a `dask.distributed.Client`, or None for processes of its
    own: `workers`, or as many as there are processors. The blob holds model and measure, or whatever else
    what is `done` with points needs.
    """

    def __init__(
        self,
        executor: Any,
        workers: int | None,
        blob: bytes,
        done: Callable[[bytes, list[Point]], list[Row]] = work,
    ) -> None:
        if hasattr(executor, "get_executor"):
            executor = executor.get_executor()
        if not (executor is None or isinstance(executor, Executor)):
            raise ModelError(
                f"an executor is one of concurrent.futures or a dask.distributed.Client, got {executor!r}"
            )
        self.workers = workers or _processors()
        self.blob, self.work, self.own = blob, done, executor is None
        self.executor: Executor = executor or Processes(self.workers)
        self.width = 2 * processes_of(None if self.own else executor, workers)
        self.pending: dict[Future[list[Row]], list[Point]] = {}
        self.suspects: deque[tuple[Point, int]] = deque()
        self.size = 1

    def rows(self, points: Iterable[Point]) -> Iterator[Row]:
        """Yield the row of every point as it comes; own processes end with it, whatever they are at."""
        try:
            yield from self._computed(list(points)[::-1])
        except BaseException:
            for future in self.pending:
                future.cancel()
            if isinstance(self.executor, Processes):
                self.executor.abandon()
            raise
        if self.own:
            self.executor.shutdown()

    def _computed(self, left: list[Point]) -> Iterator[Row]:
        while left or self.pending or self.suspects:
            while left and not self.suspects and len(self.pending) < self.width:
                size = min(self.size, -(-2 * len(left) // self.width))
                self._submit([left.pop() for _ in range(size)])
            _load_tables()
            if self.suspects and not self.pending:
                yield from self._alone(*self.suspects.popleft())
            elif self.pending:
                yield from self._finished()

    def _submit(self, points: list[Point]) -> None:
        try:
            self.pending[self.executor.submit(self.work, self.blob, points)] = points
        except BrokenExecutor:
            self._suspect(points)
            self._renew()

    def _finished(self) -> Iterator[Row]:
        done, _ = wait(self.pending, return_when=FIRST_COMPLETED)
        broken = False
        for future in done:
            points = self.pending.pop(future)
            rows = _rows(future)
            if rows is None:
                self._suspect(points)
                broken = True
            else:
                seconds = sum(row.seconds for row in rows) / len(rows)
                size = min(MOST_POINTS, int(TASK_SECONDS / max(seconds, 1e-6)))
                self.size = max(1, size, *(row.at_once for row in rows))
                yield from rows
        if broken:
            self._renew()

    def _alone(self, point: Point, attempt: int) -> Iterator[Row]:
        rows = None
        try:
            rows = _rows(self.executor.submit(self.work, self.blob, [point]))
        except BrokenExecutor:
            attempt -= 1
        if rows is not None:
            yield from rows
        else:
            self._renew()
            if attempt < ATTEMPTS:
                self.suspects.append((point, attempt + 1))
            else:
                yield Row(*point, {}, f"the process that computed it died {ATTEMPTS} times", 0.0)

    def _suspect(self, points: list[Point]) -> None:
        self.suspects.extend((point, 1) for point in points)

    def _renew(self) -> None:
        """Replace own processes if they are broken; those of others are theirs to mend."""
        if self.own:
            for future, points in list(self.pending.items()):
                if not future.done() or _rows(future) is None:
                    del self.pending[future]
                    self._suspect(points)
            self.executor.shutdown(wait=False, cancel_futures=True)
            self.executor = Processes(self.workers)


def _rows(future: Future[list[Row]]) -> list[Row] | None:
    """Return what came of a task, or None if it was lost with its process."""
    try:
        return future.result()
    except Exception as error:
        if isinstance(error, BrokenExecutor) or type(error).__name__ in LOST_TASKS:
            return None
        raise


@cache
def _load_tables() -> None:
    """Load what the results' table needs while processes are at work."""
    import pandas  # noqa: F401


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def processes_of(executor: Any, workers: int | None) -> int:
    """Return how many points are computed at the same time, by an executor or by processes of one's own."""
    if executor is None:
        return workers or _processors()
    client = getattr(executor, "_client", executor)
    threads = sum(client.nthreads().values()) if hasattr(client, "nthreads") else 0
    return threads or getattr(executor, "_max_workers", None) or _processors()
