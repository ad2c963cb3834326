"""Which signals are meant: full names, and patterns such as `mass.*`."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from ...base import UnknownNameError, text

if TYPE_CHECKING:
    from ..dae import DAE


def chosen_signals(dae: DAE, names: Iterable[str]) -> list[str]:
    """Return the full names behind names and patterns, each once, in the order given.

    Args:
        dae: whose signals they are.
        names: full names; a `*` stands for any part of one.

    Raises:
        UnknownNameError: for an unknown signal, with the nearest one, or a pattern that matches none.
    """
    chosen: dict[str, None] = {}
    for name in names:
        if not text(name) and "*" in name:
            chosen |= dict.fromkeys(_matching(dae, name))
        else:
            dae.expression(name)
            chosen[name] = None
    return list(chosen)


def _matching(dae: DAE, pattern: str) -> list[str]:
    known = [*dae.names(), *dae.switching.mode_names]
    matches = [name for name in known if fnmatchcase(name, pattern)]
    if not matches:
        raise UnknownNameError(f"'{dae.name}' has no variable like '{pattern}'")
    return matches
