"""Ctrl-C while something long goes on: noted at once, raised where nothing is half done."""

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, local, main_thread
from types import FrameType
from typing import Any


class RunInterruptedError(KeyboardInterrupt):
    """Ctrl-C during a run; `result` holds what was computed before."""

    def __init__(self, message: str, result: Any) -> None:
        self.result = result
        super().__init__(message)


class Interrupted(KeyboardInterrupt):
    """Ctrl-C, raised where a loop is between two of its turns."""


class _Muted:
    """Standard error; while it drops, without what the main thread writes."""

    def __init__(self, stream: Any) -> None:
        self.stream, self.drops = stream, True

    def write(self, told: str) -> int:
        if self.drops and current_thread() is main_thread():
            return len(told)
        return int(self.stream.write(told))

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)


class _Ear:
    """Takes the place of the handler of Ctrl-C for a while.

    Integrators look for signals themselves, but take the exception for a failure of the equations and forget
    it. So what the handler raises is kept: within a `foreign` call it is raised
    as well, to end the call; elsewhere it waits for the next `heed`. Who presses Ctrl-C twice waits for
    nothing.
    """

    def __init__(self, handler: Any) -> None:
        self.handler = handler
        self.raised: BaseException | None = None
        self.muted: _Muted | None = None  # within a foreign call

    def __call__(self, number: int, frame: FrameType | None) -> None:
        again = self.raised is not None
        try:
            self._handle(number, frame)
        except BaseException as error:
            self.raised = error
            if again or self.muted:
                raise

    def _handle(self, number: int, frame: FrameType | None) -> None:
        """Let the program's own handler do what it does, and tell it."""
        if self.muted is None:
            self.handler(number, frame)
            return
        self.muted.drops = False
        try:
            self.handler(number, frame)
        finally:
            self.muted.drops = True


_HERE = local()


@contextmanager
def interruptible() -> Iterator[None]:
    """Let Ctrl-C end what goes on within only at `heed` and in `foreign` calls; also as a decorator.

    CasADi calls Python back while it looks at arguments, and forgets what that raises: around what builds
    equations, Ctrl-C waits.

    Does nothing in threads that signals do not reach, and where Ctrl-C is ignored.
    """
    handler = signal.getsignal(signal.SIGINT)
    if current_thread() is not main_thread() or not callable(handler) or isinstance(handler, _Ear):
        yield
        return
    ear = _HERE.ear = _Ear(handler)
    signal.signal(signal.SIGINT, ear)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        _HERE.ear = None
    heed(ear)


def heed(ear: _Ear | None = None) -> None:
    """Raise Interrupted if Ctrl-C was pressed, or what the program's own handler of Ctrl-C raised."""
    ear = ear or getattr(_HERE, "ear", None)
    if ear is None or ear.raised is None:
        return
    raised, ear.raised = ear.raised, None
    if isinstance(raised, KeyboardInterrupt):
        raise Interrupted from None
    raise raised


class foreign:  # noqa: N801
    """A call of compiled code that looks for signals itself: Ctrl-C ends it and raises Interrupted.

    What it tells on standard error is dropped: CasADi passes on each message of IDAS, whatever its options
    say, and IDAS tells of every step that it tries again. In the main thread it does so by `sys.stderr`.
    """

    def __enter__(self) -> None:
        heed()
        self._ear: _Ear | None = getattr(_HERE, "ear", None)
        self._muted, self._is_main = _Muted(sys.stderr), current_thread() is main_thread()
        if self._is_main and sys.stderr is not None:
            sys.stderr = self._muted
        if self._ear is not None:
            self._ear.muted = self._muted

    def __exit__(self, *_: object) -> None:
        self._muted.drops = False
        if self._is_main:
            sys.stderr = self._muted.stream
        if self._ear is not None:
            self._ear.muted = None
            heed(self._ear)
