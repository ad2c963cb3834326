"""Numbers given as NAME=VALUE."""

from __future__ import annotations

from collections.abc import Iterable

from .failure import WRONG_USE, fail


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
