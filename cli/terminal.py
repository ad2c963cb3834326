"""The terminal: its encoding, its closed pipes, and its Ctrl-C, which must not be lost."""

from __future__ import annotations

import codecs
import io
import os
import signal
import sys
import unicodedata
from collections.abc import Callable, Container, Iterable, Iterator
from contextlib import contextmanager, suppress
from threading import Timer, main_thread
from types import TracebackType
from typing import Any

from rich.console import Console, JustifyMethod, OverflowMethod
from rich.table import Table
from rich.text import Text

PLAIN_WORDS = {
    "\N{GREATER-THAN OR EQUAL TO}": ">=", "\N{LESS-THAN OR EQUAL TO}": "<=", "\N{EN DASH}": "-",
    "\N{MINUS SIGN}": "-", "\N{RIGHTWARDS ARROW}": "->", "\N{MIDDLE DOT}": ".", "\N{DOT OPERATOR}": ".",
    "\N{MULTIPLICATION SIGN}": "x", "\N{DEGREE SIGN}": " deg", "\N{PLUS-MINUS SIGN}": "+-",
    "\N{GREEK SMALL LETTER LAMDA}": "lambda", "\N{GREEK SMALL LETTER TAU}": "tau",
    "\N{GREEK SMALL LETTER BETA}": "beta", "\N{GREEK SMALL LETTER OMEGA}": "omega",
    "\N{GREEK SMALL LETTER PHI}": "phi", "\N{SQUARE ROOT}": "sqrt ", "\N{INFINITY}": "inf",
}  # fmt: skip

RESEND_SECONDS = 0.02


class CommandConsole(Console):
    """A console that leaves a closed pipe to the command."""

    def on_broken_pipe(self) -> None:
        """Raise what was raised."""
        raise BrokenPipeError


def table_of(
    title: str, headings: Iterable[str], words: Container[str], overflow: OverflowMethod = "ellipsis"
) -> Table:
    """Return a table to fill, with the columns of `words` to the left and those of numbers to the right."""
    table = Table(title=title)
    for heading in headings:
        justify: JustifyMethod = "left" if heading in words else "right"
        table.add_column(heading, justify=justify, overflow=overflow)
    return table


@contextmanager
def progress(first: str) -> Iterator[Callable[[str], None]]:
    """Give a function that tells how far a command is: in one line of a terminal, else in lines on stderr."""
    console = CommandConsole(stderr=True)

    with console.status(first) as status:

        def tell(line: str) -> None:
            if console.is_terminal:
                status.update(Text(line))
            else:
                console.print(line, highlight=False, markup=False, soft_wrap=True)

        yield tell


def prepare() -> None:
    """Let no character of ours stop a command, whatever the encoding of the terminal."""
    codecs.register_error("inertance", _in_other_words)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="inertance")


def _in_other_words(error: UnicodeError) -> tuple[str | bytes, int]:
    """Return what stands for a character that an encoding lacks; bytes that were no text stay as they are."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    character = error.object[error.start]
    after = error.start + 1
    if "\udc80" <= character <= "\udcff":
        return bytes([ord(character) - 0xDC00]), after
    plain = PLAIN_WORDS.get(character) or unicodedata.normalize("NFKD", character)
    return plain.encode("ascii", "ignore").decode() or "?", after


def _send() -> None:
    """Send Ctrl-C to the main thread, so that it also wakes from what it waits for."""
    if sys.platform == "win32":
        signal.raise_signal(signal.SIGINT)
    else:
        signal.pthread_kill(main_thread().ident or 0, signal.SIGINT)


@contextmanager
def insisting() -> Iterator[None]:
    """Send Ctrl-C again if it came where Python drops exceptions, such as the end of an import.

    Compiled libraries print what they drop before they drop it: of Ctrl-C, nothing is printed.
    """
    before, before_printed = sys.unraisablehook, sys.excepthook
    again: list[Timer] = []

    def told(dropped: Any) -> None:
        if not issubclass(dropped.exc_type, KeyboardInterrupt):
            before(dropped)
        elif not any(timer.is_alive() for timer in again):  # as one may be dropped by several callers
            again.append(Timer(RESEND_SECONDS, _send))
            again[-1].start()

    def printed(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if not issubclass(kind, KeyboardInterrupt):
            before_printed(kind, error, trace)

    sys.unraisablehook, sys.excepthook = told, printed
    try:
        yield
    finally:
        sys.unraisablehook, sys.excepthook = before, before_printed
        with suppress(KeyboardInterrupt):
            for timer in again:
                timer.cancel()
                timer.join()  # or one that had begun to send would end what comes after


def settle() -> None:
    """Let Python forget a Ctrl-C that was caught.

    Of one that has passed through text that is executed, as in the definition of a dataclass, a note is kept,
    by which `python -m` ends as by the signal, whatever the exit code; text that is executed clears it.
    """
    exec("")


def forget() -> None:
    """Drop what standard output has not taken, so that leaving does not try again."""
    with suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
