"""Varied parameters: how a linearisation changes with them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping


class Varied(dict[str, float]):
    """Changed parameters by name, of which `by` are those in which slopes are wanted.

    `linearise(..., parameters=Varied(...))` returns a system with `slopes`, whose norms have a `gradient`.
    """

    def __init__(self, parameters: Mapping[str, float], by: Iterable[str] | None = None) -> None:
        super().__init__(parameters)
        self.by = tuple(parameters if by is None else by)
