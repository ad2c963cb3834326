"""Walls: a system's components in systems of their own, and what leads through the walls of these."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NoReturn

from ...base import nearest
from ..errors import FMUError
from ..foreign.variable import ForeignVariable

if TYPE_CHECKING:
    from .system import Connection, SystemStructure

Place = tuple[str, ...]  # names of the systems that lead to a component
End = tuple[str | None, str]  # element, or None for the system itself, and connector


@dataclass
class Walls:
    """One system as it is written.

    Attributes:
        connectors: kind and variable by name.
        links: from source to sink; the connection whose transformation acts there, if one does.
        components: names in the whole, by name here.
        systems: those inside.
    """

    connectors: dict[str, tuple[str, ForeignVariable]] = field(default_factory=dict)
    links: dict[tuple[End, End], Connection | None] = field(default_factory=dict)
    components: dict[str, str] = field(default_factory=dict)
    systems: dict[str, Walls] = field(default_factory=dict)


def walls(system: SystemStructure, groups: Mapping[str, Iterable[str]]) -> Walls:
    """Return the whole, with the systems inside: component names by path, as "chassis.axle".

    A component that is called after its systems has the rest as its name there, "wheel" for "axle_wheel".

    Raises:
        FMUError: for unknown components, one in two groups, two elements of one name, names that cannot be.
    """
    return _Built(system, groups).whole


class _Built:
    def __init__(self, system: SystemStructure, groups: Mapping[str, Iterable[str]]) -> None:
        self.system, self.whole = system, Walls()
        self.places: dict[str, Place] = {}
        for path, names in groups.items():
            for name in names:
                self._group(name, tuple(path.split(".")))
        self.names: dict[str, str] = {}
        for name in system.components:
            self._stand(name)
        for path in system.free_inputs():
            self._free(path)
        for connection in system.connections:
            self._join(connection)

    def _group(self, name: str, place: Place) -> None:
        told = f"system '{self.system.name}' cannot be nested:"
        if name not in self.system.components:
            raise FMUError(f"{told} there is no component '{name}'{nearest(name, self.system.components)}")
        if name in self.places:
            raise FMUError(f"{told} '{name}' is in two systems")
        if any(not part or set(part) & set("/:\\\0") for part in place):
            raise FMUError(f"{told} '{'.'.join(place)}' is no path of names without / : \\")
        self.places[name] = place

    def _stand(self, name: str) -> None:
        place = self.places.setdefault(name, ())
        inside = self._at(place)
        short = name.removeprefix("".join(f"{part}_" for part in place)) or name
        if short in inside.components or short in inside.systems:
            self._refuse_two((*place, short))
        inside.components[short], self.names[name] = name, short

    def _at(self, place: Place) -> Walls:
        level = self.whole
        for depth, part in enumerate(place, 1):
            if part in level.components:
                self._refuse_two(place[:depth])
            level = level.systems.setdefault(part, Walls())
        return level

    def _refuse_two(self, place: Place) -> NoReturn:
        told = f"'{'.'.join(place)}' would be two elements"
        raise FMUError(f"system '{self.system.name}' cannot be nested: {told}")

    def _free(self, path: str) -> None:
        name = path.replace(".", ":", 1)
        self.whole.connectors[name] = "input", self.system.variable(path)[1]
        self._down((None, name), (), path, None)

    def _join(self, connection: Connection) -> None:
        (a, source), (b, _) = (self.system.variable(path) for path in (connection.start, connection.end))
        here, there = self.places[a], self.places[b]
        common = next((k for k, (x, y) in enumerate(zip(here, there, strict=False)) if x != y), None)
        shared = here[: min(len(here), len(there)) if common is None else common]
        start: End = self.names[a], source.name
        for depth in range(len(here), len(shared), -1):
            level = self._at(here[:depth])
            level.connectors[connection.start] = "output", source
            level.links[start, (None, connection.start)] = None
            start = here[depth - 1], connection.start
        self._down(start, shared, connection.end, connection)

    def _down(self, start: End, place: Place, path: str, connection: Connection | None) -> None:
        """Lead a value from where it is in a system to an input somewhere inside of it."""
        component, variable = self.system.variable(path)
        for part in self.places[component][len(place) :]:
            self._at(place).links[start, (part, path)] = connection
            place, connection = (*place, part), None
            self._at(place).connectors[path] = "input", variable
            start = None, path
        self._at(place).links[start, (self.names[component], variable.name)] = connection
