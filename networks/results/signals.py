"""Which signals are meant: full names, and patterns such as `mass.*`."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from ...base import UnknownNameError, text

if TYPE_CHECKING:
    from ..dae import DAE


def chosen_signals(dae: DAE, names: Iterable[str]) -> list[str]:
    """Return the full names behind names and patterns, in which `*` stands for anything, each once, in order.

    Raises:
        UnknownNameError: for an unknown signal, with the nearest one, or a pattern that matches none.
    """
    chosen: dict[str, None] = {}
    for name in names:
        matches = [name]
        if not text(name) and "*" in name:
            known = (*dae.names(), *dae.switching.mode_names)
            matches = [other for other in known if fnmatchcase(other, name)]
            if not matches:
                raise UnknownNameError(f"'{dae.name}' has no variable like '{name}'")
        else:
            dae.expression(name)
        chosen |= dict.fromkeys(matches)
    return list(chosen)
