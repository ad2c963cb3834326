"""How a command ends when it cannot do its work: a clean message and an exit code."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import NoReturn, ParamSpec

import typer

from ..components import InertanceError

Given = ParamSpec("Given")

FAILED = 1
WRONG_USE = 2


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
        with failing(FAILED, InertanceError), failing(WRONG_USE, OSError):
            command(*args, **kwargs)

    return cleaned


def told(error: Exception) -> str:
    """Return the message of an error (a KeyError would put it in quotes)."""
    return str(error.args[0]) if isinstance(error, KeyError) else str(error)
