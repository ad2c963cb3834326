"""Two-terminal algebra: elements in series, in parallel and in a bridge, as one element."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

from ..components import Component, Domain, ModelError, TwoFlanges, rotational, variable
from ..components.language import PortRef


class _Joined(Component):
    """Elements between flange_a and flange_b, and the nodes that join them."""

    def __init__(self, how: str, nodes: list[list[tuple[str, str]]], parts: dict[str, Component]) -> None:
        super().__init__()
        self._how, self._nodes = how, nodes
        self._parts.update(parts)
        self._own_parts()

    def __repr__(self) -> str:
        parts = ", ".join(f"{name}={part!r}" for name, part in self._parts.items())
        return f"{self._how}({parts})"

    def connections(self) -> Iterable[tuple[Any, ...]]:
        """Return the nodes between the elements."""
        for node in self._nodes:
            yield tuple(getattr(self._parts[part] if part else self, port) for part, port in node)


class TwoTerminal(_Joined, TwoFlanges):
    """Several two-terminal elements as one, from flange_a to flange_b.

    `s_rel` is the distance of its flanges and `f` = flange_b.f the force through it.
    """

    f = variable("N", "force between the flanges, positive when it pulls them together")

    def equations(self) -> Iterable[Any]:
        """State what `f` is."""
        yield self.f == self.flange_b.f


class RotationalTwoTerminal(_Joined, rotational.TwoFlanges):
    """The same for turning elements: `phi_rel` and `tau` = flange_b.tau."""

    tau = variable("N.m", "torque between the flanges, positive when it turns b back towards a")

    def equations(self) -> Iterable[Any]:
        """State what `tau` is."""
        yield self.tau == self.flange_b.tau


def series(*elements: Component, **named: Component) -> TwoTerminal | RotationalTwoTerminal:
    """Join two-terminal elements end to end: one force, distances add.

    Args:
        elements: elements with `flange_a` and `flange_b`; they are named after their class.
        named: the same, with names of your own.

    Raises:
        ModelError: for an element without these flanges.

    Example:
        >>> from inertance import Inerter, SpringDamper, series
        >>> tid = series(SpringDamper(k=4e4, d=260.0), Inerter(b=130.0))
    """
    parts = _named(elements, named)
    names = list(parts)
    nodes = [[("", "flange_a"), (names[0], "flange_a")]]
    for left, right in pairwise(names):
        nodes.append([(left, "flange_b"), (right, "flange_a")])
    nodes.append([(names[-1], "flange_b"), ("", "flange_b")])
    return _joined("series", nodes, parts)


def parallel(*elements: Component, **named: Component) -> TwoTerminal | RotationalTwoTerminal:
    """Join two-terminal elements side by side: one distance, forces add.

    Args and errors as for `series`.
    """
    parts = _named(elements, named)
    nodes = [[("", port), *((name, port) for name in parts)] for port in ("flange_a", "flange_b")]
    return _joined("parallel", nodes, parts)


def bridge(*elements: Component, **named: Component) -> TwoTerminal | RotationalTwoTerminal:
    """Join five two-terminal elements as a bridge, which no `series` and `parallel` can say.

    The first leads from flange_a to an inner node, the second from there to flange_b; the third and the
    fourth lead by way of another inner node; the fifth joins both inner nodes.

    Args:
        elements: as for `series`.
        named: as for `series`.

    Raises:
        ModelError: unless they are five, and as for `series`.

    Example:
        >>> from inertance import Damper, Inerter, Spring, bridge
        >>> strut = bridge(Inerter(b=1.0), Damper(d=2.0), Damper(d=2.0), Spring(k=4.0), across=Damper(d=1.0))
    """
    parts = _named(elements, named)
    if len(parts) != 5:
        raise ModelError(f"bridge() joins five elements, got {len(parts)}")
    one, two, three, four, across = parts
    nodes = [
        [("", "flange_a"), (one, "flange_a"), (three, "flange_a")],
        [(one, "flange_b"), (two, "flange_a"), (across, "flange_a")],
        [(three, "flange_b"), (four, "flange_a"), (across, "flange_b")],
        [("", "flange_b"), (two, "flange_b"), (four, "flange_b")],
    ]
    return _joined("bridge", nodes, parts)


def _joined(
    how: str, nodes: list[list[tuple[str, str]]], parts: dict[str, Component]
) -> TwoTerminal | RotationalTwoTerminal:
    domain, *others = {PortRef(element, "flange_a").domain for element in parts.values()}
    if others or domain is None:
        raise ModelError(f"{how}() joins sliding elements or turning ones, not both")
    kind = TwoTerminal if domain == Domain.TRANSLATIONAL else RotationalTwoTerminal
    return kind(how, nodes, parts)


def _named(elements: tuple[Component, ...], named: dict[str, Component]) -> dict[str, Component]:
    parts: dict[str, Component] = {}
    for element in elements:
        stem = "branch" if isinstance(element, _Joined) else type(element).__name__.lower()
        count = sum(name.rstrip("0123456789_") == stem for name in parts)
        parts[f"{stem}_{count + 1}" if count else stem] = element
    for name, element in named.items():
        if name in parts or name.startswith("_") or hasattr(TwoTerminal, name):
            raise ModelError(f"'{name}' cannot name an element here; choose another")
        parts[name] = element
    if not parts:
        raise ModelError("series() and parallel() join at least one element")
    for name, element in parts.items():
        if not {"flange_a", "flange_b"} <= getattr(type(element), "fields", {}).keys():
            told = f"'{name}' ({element!r}) has no flange_a and flange_b"
            raise ModelError(f"{told}; series() and parallel() join two-terminal elements")
    return parts
