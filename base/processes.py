"""Processes for work that is spread: Ctrl-C does not reach them, and none outlives what began it."""

import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from threading import Thread
from typing import Any, TypeVar

from .interrupts import interruptible

T = TypeVar("T")
THREADS = "OPENBLAS_NUM_THREADS"


class Processes(ProcessPoolExecutor):
    """Processes that end when they are told to, or with their parent, whatever they are at.

    With a process a core, threads of linear algebra only queue: those that are spawned get one, unless
    OPENBLAS_NUM_THREADS says otherwise. They begin by "spawn", "fork" or "forkserver", as is
    usual on the system if `method` is None.
    """

    def __init__(self, count: int, method: str | None = None) -> None:
        context = get_context(method)
        self._heard, self._told = context.Pipe(duplex=False)
        super().__init__(count, mp_context=context, initializer=_belong, initargs=(self._heard,))

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        """See `ProcessPoolExecutor.submit`; processes that begin here do so without Ctrl-C."""
        with interruptible(), _held_back(), _one_thread():  # a thread here may be woken by what is held back
            return super().submit(fn, *args, **kwargs)

    def abandon(self) -> None:
        """End the processes without waiting for what they are at."""
        self._told.send(None)
        self.shutdown(wait=True, cancel_futures=True)

    def __exit__(self, *raised: Any) -> bool | None:
        if any(raised):
            self.abandon()
        return super().__exit__(*raised)


@contextmanager
def _held_back() -> Iterator[None]:
    """Let Ctrl-C wait, here and in processes that begin meanwhile."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _one_thread() -> Iterator[None]:
    """Let processes that begin meanwhile use one thread for linear algebra; those here stay as they are."""
    if THREADS in os.environ:
        yield
        return
    os.environ[THREADS] = "1"
    try:
        yield
    finally:
        del os.environ[THREADS]


def _belong(told: Connection) -> None:
    """Leave Ctrl-C to the parent, and end when it says so or is no more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_when, args=(told,), daemon=True).start()


def _end_when(told: Connection) -> None:
    parent = parent_process()
    assert parent is not None
    wait([told, parent.sentinel])  # what is told is left there for the others
    os._exit(1)
