"""What commands are given: a model, numbers by name; what is wrong ends the command."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import typer

from ..components import ModelError
from ..networks import Network, UserCodeError, load_model
from .failure import FAILED, WRONG_USE, fail

Model = Annotated[
    str, typer.Argument(metavar="MODEL", help="path/to/file.py:function that returns a Network.")
]
SOLVER_NAMES = "auto, cvodes, idas, rosenbrock or compiled."
StartValues = Annotated[list[str] | None, typer.Option(metavar="NAME=VALUE", help="Fix a start value.")]
GivenInputs = Annotated[
    list[str] | None,
    typer.Option(
        "--input", metavar="FILE|NAME=VALUE",
        help="Table with a column 'time' and one named after each input; or a constant input.",
    ),
]  # fmt: skip


def told(page: str) -> str:
    """Return where the documentation tells more of a command."""
    return f"`inertance docs {page}` tells more."


def load_network(model: str) -> Network:
    """Return the network of `path/to/file.py:function`, or end the command with what is wrong."""
    try:
        return load_model(model, asked="MODEL")
    except UserCodeError as error:
        fail(str(error), FAILED)
    except ModelError as error:
        fail(str(error), WRONG_USE)


def pairs(option: str, texts: Iterable[str] | None) -> dict[str, float]:
    """Return the numbers of `name=value` texts by name, or end the command."""
    found = {}
    for text in texts or ():
        name, _, value = text.partition("=")
        try:
            found[name.strip()] = float(value)
        except ValueError:
            fail(f"{option} takes NAME=VALUE with a number, got '{text}'", WRONG_USE)
    return found
