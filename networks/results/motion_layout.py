"""Where the parts of a machine stand when it is drawn to move: nodes in columns, what joins them in rows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ...base import ModelError
from ...components.language import Component, parts_of
from .network_drawing import inner_parts, joined_nodes

MOST_PARTS = 60
COORDINATES = {"translational": "s", "rotational": "phi"}


@dataclass(eq=False)
class Place:
    """A node: what is joined there moves as one.

    Attributes:
        signal: name of its position or angle.
        turns: whether it turns.
        bodies: names of the parts that are at this node alone.
        held: whether a part that is fixed to the ground is there.
        column: how many parts are between it and the ground, or the first node.
        x: where it stands, in widths of a part: those of a column whose rows overlap stand side by side.
        rows: of the parts that it joins.
    """

    signal: str
    turns: bool
    bodies: list[str] = field(default_factory=list)
    held: bool = False
    column: int = -1
    x: int = 0
    rows: list[int] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class Link:
    """A part between two nodes."""

    name: str
    part: Component
    left: Place
    right: Place
    row: int


def laid_out(machine: Component) -> tuple[list[Place], list[Link]]:
    """Return the nodes of a machine and what joins them, each with its place.

    Raises:
        ModelError: if nothing slides or turns, or there are too many parts to draw.
    """
    parts = parts_of(machine)
    if len(parts) > MOST_PARTS:
        raise ModelError(f"{len(parts)} components are too many to draw in motion; {MOST_PARTS} are the most")
    places, of_part = _places(machine, parts)
    if not places:
        raise ModelError("nothing slides or turns here that could be drawn in motion")
    ends = {name: list(dict.fromkeys(at)) for name, at in of_part.items()}
    for name, at in ends.items():
        if len(at) == 1:
            at[0].held = at[0].held or type(parts[name]).__name__ == "Fixed"
            at[0].bodies.append(name)
    _number_columns(places, [at for at in ends.values() if len(at) > 1])
    links = list(_links(parts, ends))
    for place in places:
        place.rows = [link.row for link in links if place in (link.left, link.right)]
    _place_loose([place for place in places if not place.rows], links)
    _spread(places)
    return places, links


def _places(machine: Component, parts: dict[str, Component]) -> tuple[list[Place], dict[str, list[Place]]]:
    paths = {id(part): path for path, part in inner_parts(machine, "")}
    places: list[Place] = []
    of_part: dict[str, list[Place]] = {name: [] for name in parts}
    for ports in joined_nodes(machine):
        known = [(paths[id(port.component)], port) for port in ports if id(port.component) in paths]
        for path, port in known:
            domain = getattr(type(port.component).fields[port.name], "domain", "")
            if domain in COORDINATES:
                places.append(Place(f"{path}.{port.name}.{COORDINATES[domain]}", domain == "rotational"))
                break
        else:
            continue
        for path, _ in known:
            of_part[path.partition(".")[0]].append(places[-1])
    return places, of_part


def _number_columns(places: list[Place], joined: list[list[Place]]) -> None:
    """Number the nodes by how many parts are between them and the ground, or the first."""
    for root in sorted(places, key=lambda place: not place.held):
        if root.column >= 0:
            continue
        root.column = 0
        reached = [root]
        for place in reached:
            for ends in joined:
                for other in ends if place in ends else ():
                    if other.column < 0:
                        other.column = place.column + 1
                        reached.append(other)


def _links(parts: dict[str, Component], ends: dict[str, list[Place]]) -> Iterator[Link]:
    """Yield what joins nodes, each in the first row that is free between its columns."""
    taken: list[list[tuple[int, int]]] = []
    spans = []
    for name, at in ends.items():
        if len(at) > 1:
            left, right = sorted((at[0], at[1]), key=lambda place: place.column)
            spans.append((left.column, right.column, name, left, right))
    for first, last, name, left, right in sorted(spans, key=lambda span: span[:2]):
        row = next(
            (
                row
                for row, others in enumerate(taken)
                if all(last <= a or first >= b for a, b in others) and first < last
            ),
            len(taken),
        )
        if row == len(taken):
            taken.append([])
        taken[row].append((first, max(last, first + 1)))
        yield Link(name, parts[name], left, right, row)


def _place_loose(loose: list[Place], links: list[Link]) -> None:
    """Give nodes that nothing joins a row of their own, below all others."""
    below = max((link.row for link in links), default=-1) + 1
    for number, place in enumerate(loose):
        place.rows = [below + number]


def _spread(places: list[Place]) -> None:
    """Put the nodes of a column side by side where their rows overlap, those of few rows first."""
    x = 0
    for column in range(max(place.column for place in places) + 1):
        standing: list[list[Place]] = []
        for place in sorted((p for p in places if p.column == column), key=lambda p: len(p.rows)):
            free = (k for k, others in enumerate(standing) if not any(_overlap(place, o) for o in others))
            layer = next(free, len(standing))
            standing += [[]] * (layer == len(standing))
            standing[layer] = [*standing[layer], place]
            place.x = x + layer
        x += len(standing)


def _overlap(a: Place, b: Place) -> bool:
    return min(a.rows) <= max(b.rows) and min(b.rows) <= max(a.rows)
