"""How a command ends when it cannot do its work: a clean message and an exit code."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

import typer

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


def told(error: Exception) -> str:
    """Return the message of an error (a KeyError would put it in quotes)."""
    return str(error.args[0]) if isinstance(error, KeyError) else str(error)
