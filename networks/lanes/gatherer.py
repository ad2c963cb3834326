"""`Gatherer`: works that each ask for runs get them side by side, as if each ran alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextvars import copy_context
from threading import Lock, Thread, get_ident
from typing import Any, TypeVar

from ..results.result import Result
from ..simulation.bound_dae import BINDING_THREAD
from ..simulation.run_asked import RUNS, RunAsked
from ..simulation.simulate import run_alone
from .kinds import Kind, Likeness, Unlike, likeness

MOST_KINDS = 8
BESIDE = "side by side"
Done = TypeVar("Done")


class Gatherer:
    """Lets works go on one at a time, each to where it asks for a run, and runs like ones together.

    A work is a function that may ask for runs by `simulate`. It is called once, in a thread of its own while
    others are under way; never do two go on at the same instant. First works are called one after another,
    until it is known what their runs cost.

    Args:
        expected: how many works are foreseen.

    Attributes:
        told: how runs went, and how many: `BESIDE`, or why they went alone.
    """

    def __init__(self, expected: int) -> None:
        self.expected = expected
        self.told: Counter[str] = Counter()
        self._kinds: dict[Likeness, Kind] = {}
        self._last: RunAsked | None = None

    @property
    def at_once(self) -> int:
        """How many works it would take at once."""
        kind = self._kinds.get(likeness(self._last)) if self._last is not None else None
        if kind is None or self._last is None or not kind.ready(self._last, self.expected):
            return 1
        return kind.at_once

    def blocks(self, works: Sequence[Callable[[], Done]]) -> Iterator[list[Done]]:
        """Yield what comes of works, in their order: lists of those that were under way together."""
        done = 0
        while done < len(works):
            some = works[done : done + self.at_once]
            yield [self._watched(some[0])] if len(some) == 1 else self._together(some)
            done += len(some)
            self.expected = max(0, self.expected - len(some))

    def results(self, works: Sequence[Callable[[], Done]]) -> list[Done]:
        """Return what comes of works, in their order."""
        return [found for block in self.blocks(works) for found in block]

    def _watched(self, work: Callable[[], Done]) -> Done:
        """Do a work by itself, and note what its runs cost and what is asked of them."""
        made: list[tuple[Kind, Result]] = []

        def run(asked: RunAsked) -> Result:
            kind = self._kind(asked)
            if kind is None:
                return run_alone(asked)
            with kind.paying():
                found = run_alone(asked)
            self.told[kind.against or "too few for lanes so far"] += 1
            self._last = asked
            made.append((kind, found))
            return found

        before = RUNS.set(run)
        try:
            return work()
        finally:
            RUNS.reset(before)
            for kind, found in made:
                kind.signals |= found.asked_for

    def _kind(self, asked: RunAsked) -> Kind | None:
        """Return the kind of a run; None if it goes alone, which is noted."""
        try:
            like = likeness(asked)
        except Unlike as reason:
            self.told[str(reason)] += 1
            return None
        if like not in self._kinds:
            self._kinds[like] = Kind(like)
            if len(self._kinds) > MOST_KINDS:
                del self._kinds[next(iter(self._kinds))]
        return self._kinds[like]

    def _together(self, works: Sequence[Callable[[], Done]]) -> list[Done]:
        """Do works side by side."""
        tasks = [_Task(work) for work in works]
        try:
            going = tasks
            while going:
                for task in going:
                    task.go_on()
                going = [task for task in going if task.asked is not None]
                self._answer(going)
        finally:
            for task in tasks:
                task.abandon()
        return [task.result for task in tasks]

    def _answer(self, tasks: Sequence[_Task]) -> None:
        """Run what tasks have asked for."""
        groups: dict[int, tuple[Kind, list[_Task]]] = {}
        for task in tasks:
            assert task.asked is not None
            kind = self._kind(task.asked)
            if kind is not None and kind.ready(task.asked, self.expected):
                groups.setdefault(id(kind), (kind, []))[1].append(task)
            elif kind is not None:
                self.told[kind.against or "few are like it"] += 1
        for kind, some in groups.values():
            found = kind.results([task.asked for task in some if task.asked is not None])
            for task, result in zip(some, found, strict=True):
                task.answer = result
            for result in found:
                self.told[BESIDE if result is not None else "it could not go beside others"] += 1
        for task in tasks:
            if task.answer is None:
                task.run_alone()


class _Abandoned(BaseException):
    """Ends a work whose runs nobody computes any more."""


class _Task:
    """A work in a thread of its own, which goes on only while whoever leads it waits."""

    def __init__(self, work: Callable[[], Any]) -> None:
        self.asked: RunAsked | None = None
        self.answer: Result | None = None
        self._error: BaseException | None = None
        self._ended = self._left = False
        self._found: Any = None
        self._turn, self._pause = Lock(), Lock()
        self._turn.acquire()
        self._pause.acquire()
        context = copy_context()
        context.run(RUNS.set, self._ask)
        context.run(BINDING_THREAD.set, BINDING_THREAD.get() or get_ident())
        self._thread = Thread(target=context.run, args=(self._do, work), daemon=True)
        self._begun = False

    def go_on(self) -> None:
        """Let it go on to where it asks for a run, or ends."""
        if self._begun:
            self._turn.release()
        else:
            self._begun = True
            self._thread.start()
        self._pause.acquire()

    def _do(self, work: Callable[[], Any]) -> None:
        try:
            self._found = work()
        except BaseException as error:
            self._error = error
        self._ended, self.asked = True, None
        self._pause.release()

    def _ask(self, asked: RunAsked) -> Result:
        """Wait for a run; called in the thread of the work."""
        self._check_left()
        self.asked, self.answer, self._error = asked, None, None
        self._pause.release()
        self._turn.acquire()
        self._check_left()
        self.asked = None
        return self._answered()

    def _check_left(self) -> None:
        if self._left:
            raise _Abandoned

    def _answered(self) -> Result:
        if self._error is not None:
            error, self._error = self._error, None
            raise error
        assert self.answer is not None
        return self.answer

    def run_alone(self) -> None:
        """Compute what it has asked for by itself."""
        assert self.asked is not None
        try:
            self.answer = run_alone(self.asked)
        except Exception as error:
            self._error = error

    def abandon(self) -> None:
        """End its thread, if that waits."""
        if self._begun and not self._ended:
            self._left = True
            self._turn.release()

    @property
    def result(self) -> Any:
        """What came of it."""
        if self._error is not None:
            raise self._error
        return self._found
