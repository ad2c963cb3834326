"""How a command ends when it cannot do its work: a clean message and an exit code."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import wraps
from typing import NoReturn, ParamSpec

import typer

from ..components import InertanceError
from .terminal import forget, insisting, prepare

Given = ParamSpec("Given")

FAILED = 1
WRONG_USE = 2
INTERRUPTED = 130
UNREAD = 141


def fail(message: str, code: int) -> NoReturn:
    """Print a message to standard error and end the command."""
    typer.secho("error: ", err=True, fg=typer.colors.RED, bold=True, nl=False)
    typer.echo(message, err=True)
    raise typer.Exit(code)


@contextmanager
def failing(code: int, *kinds: type[Exception]) -> Iterator[None]:
    """End the command with a code when an error of these kinds is raised within."""
    try:
        yield
    except kinds as error:
        fail(told(error), code)


def clean(command: Callable[Given, None]) -> Callable[Given, None]:
    """Return a command that tells what goes wrong in it by a message and an exit code."""

    @wraps(command)
    def cleaned(*args: Given.args, **kwargs: Given.kwargs) -> None:
        prepare()
        try:
            with insisting(), failing(FAILED, InertanceError):
                command(*args, **kwargs)
            if sys.stdout is not None:
                sys.stdout.flush()
        except KeyboardInterrupt:
            typer.echo("interrupted", err=True)
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            raise typer.Exit(_unwritable(error)) from None

    return cleaned


def _unwritable(error: OSError) -> int:
    """Tell what the system refused, silently if nobody reads any more, and return the exit code."""
    if isinstance(error, BrokenPipeError):
        forget()
        return UNREAD
    if error.filename is not None or error.errno is None:
        with suppress(typer.Exit):
            fail(str(error), WRONG_USE)
        return WRONG_USE
    forget()
    with suppress(typer.Exit):
        fail(f"standard output cannot be written: {(error.strerror or str(error)).lower()}", FAILED)
    return FAILED


def told(error: Exception) -> str:
    """Return the message of an error (a KeyError would put it in quotes)."""
    return str(error.args[0]) if isinstance(error, KeyError) else str(error)
