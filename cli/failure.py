"""How a command ends when it cannot do its work: a clean message and an exit code."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import NoReturn, ParamSpec

import typer

from ..components import InertanceError
from .terminal import forget, insisting, prepare, settle

Arguments = ParamSpec("Arguments")

FAILED = 1
WRONG_USE = 2
INTERRUPTED = 130
BROKEN_PIPE_EXIT = 141


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
        told = error.args[0] if isinstance(error, KeyError) else error  # which would put it in quotes
        fail(str(told), code)


def clean(command: Callable[Arguments, None]) -> Callable[Arguments, None]:
    """Return a command that tells what goes wrong in it by a message and an exit code."""

    @wraps(command)
    def cleaned(*args: Arguments.args, **kwargs: Arguments.kwargs) -> None:
        prepare()
        try:
            with insisting(), failing(FAILED, InertanceError):
                command(*args, **kwargs)
            if sys.stdout is not None:
                sys.stdout.flush()
        except KeyboardInterrupt:
            typer.echo("interrupted", err=True)
            settle()
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            _unwritable(error)

    return cleaned


def _unwritable(error: OSError) -> NoReturn:
    """End the command with what the system refused, silently if nobody reads any more."""
    if isinstance(error, BrokenPipeError):
        forget()
        raise typer.Exit(BROKEN_PIPE_EXIT)
    if error.filename is not None or error.errno is None:
        fail(str(error), WRONG_USE)
    forget()
    fail(f"standard output cannot be written: {(error.strerror or str(error)).lower()}", FAILED)
