"""Claims: one process at a time writes into a file that grows."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .files import OutputError, refusal


@contextmanager
def claimed(path: Path) -> Iterator[None]:
    """Keep others from `path` meanwhile, by a lock on a file beside it that a dead process leaves open.

    Raises an OutputError if another process or thread has claimed it; without locks on the disk, nothing is.
    """
    beside = path.with_name(f"{path.name}.lock")
    try:
        lock = os.open(beside, os.O_CREAT | os.O_RDWR, 0o666)
    except OSError as error:
        raise refusal(beside, error) from error
    try:
        if not (_locked(lock) and _is_there(lock, beside)):
            raise OutputError(f"'{path}' is being written by another process; wait, or choose another path")
        try:
            yield
        finally:
            with suppress(OSError):
                beside.unlink()
    finally:
        os.close(lock)


def _is_there(lock: int, path: Path) -> bool:
    """Tell whether an open file is still the one of that name, which whoever had it may have removed."""
    try:
        return os.path.samestat(os.fstat(lock), path.stat())
    except FileNotFoundError:
        return False


def _locked(lock: int) -> bool:
    """Lock an open file, and tell whether nobody else had."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(lock, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return sys.platform != "win32" and not isinstance(error, BlockingIOError)
    return True
