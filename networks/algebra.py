"""Two-terminal algebra: elements in series and in parallel, as one element."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

from ..components import Component, ModelError, TwoFlanges, variable


class TwoTerminal(TwoFlanges):
    """Several two-terminal elements as one, from flange_a to flange_b.

    `s_rel` is the distance of its flanges and `f` = flange_b.f the force through it.
    """

    f = variable("N", "force between the flanges, positive when it pulls them together")

    def __init__(self, ports: list[list[tuple[str, str]]], parts: dict[str, Component]) -> None:
        super().__init__()
        self._parts.update(parts)
        self._nodes = ports

    def equations(self) -> Iterable[Any]:
        """State what `f` is."""
        yield self.f == self.flange_b.f

    def connections(self) -> Iterable[tuple[Any, ...]]:
        """Return the nodes between the elements."""
        for node in self._nodes:
            yield tuple(getattr(self._parts[part] if part else self, port) for part, port in node)


def series(*elements: Component, **named: Component) -> TwoTerminal:
    """Join two-terminal elements end to end: one force, distances add.

    Args:
        elements: elements with `flange_a` and `flange_b`; they are named after their class.
        named: the same, with names of your own.

    Raises:
        ModelError: for an element without these flanges.

    Example:
        >>> from inertance import Damper, Inerter, Spring, parallel, series
        >>> tid = series(Spring(k=4e4), parallel(Inerter(b=130.0), Damper(d=260.0)))
    """
    parts = _named(elements, named)
    names = list(parts)
    nodes = [[("", "flange_a"), (names[0], "flange_a")]]
    for left, right in pairwise(names):
        nodes.append([(left, "flange_b"), (right, "flange_a")])
    nodes.append([(names[-1], "flange_b"), ("", "flange_b")])
    return TwoTerminal(nodes, parts)


def parallel(*elements: Component, **named: Component) -> TwoTerminal:
    """Join two-terminal elements side by side: one distance, forces add.

    Args and errors as for `series`.
    """
    parts = _named(elements, named)
    nodes = [[("", port), *((name, port) for name in parts)] for port in ("flange_a", "flange_b")]
    return TwoTerminal(nodes, parts)


def _named(elements: tuple[Component, ...], named: dict[str, Component]) -> dict[str, Component]:
    parts: dict[str, Component] = {}
    for element in elements:
        stem = "branch" if isinstance(element, TwoTerminal) else type(element).__name__.lower()
        count = sum(name.rstrip("0123456789_") == stem for name in parts)
        parts[f"{stem}_{count + 1}" if count else stem] = element
    parts |= named
    if not parts:
        raise ModelError("series() and parallel() join at least one element")
    for name, element in parts.items():
        fields = type(element).fields
        if not isinstance(element, TwoFlanges) and not {"flange_a", "flange_b"} <= set(fields):
            raise ModelError(
                f"'{name}' ({type(element).__name__}) has no flange_a and flange_b; "
                "series() and parallel() join two-terminal elements"
            )
    return parts
