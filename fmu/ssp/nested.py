"""Nested systems: the components of all levels in one, and the connections that lead through their walls."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..errors import FMUError
from .system import Connection
from .write import NAMESPACES

Place = tuple[str, ...]  # names of the systems that lead to an element, and its own
End = tuple[Place, str]


@dataclass(frozen=True)
class _Link:
    start: End
    end: End
    factor: float
    offset: float
    convert: bool

    @property
    def plain(self) -> bool:
        """Whether values go through as they are."""
        return (self.factor, self.offset) == (1.0, 0.0)


class Levels:
    """The systems and components of a document by their place, `()` for the whole.

    A component of a system inside the system is called after both, "axle_wheel".
    """

    def __init__(self, whole: Any) -> None:
        self.systems: dict[Place, Any] = {}
        self.components: dict[Place, Any] = {}
        self._walk(whole, ())
        names = [self.name(place) for place in self.components]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise FMUError(f"two components would both be called '{twice[0]}'; rename one where it was made")

    def name(self, place: Place) -> str:
        """Return what a component is called."""
        return "_".join(place)

    def _walk(self, system: Any, place: Place) -> None:
        self.systems[place] = system
        for entry in system.findall("ssd:Elements/ssd:Component", NAMESPACES):
            self.components[*place, entry.get("name")] = entry
        for entry in system.findall("ssd:Elements/ssd:System", NAMESPACES):
            self._walk(entry, (*place, entry.get("name")))

    def variable(self, system: Place, path: str) -> str:
        """Return component and variable of a path in a system: of "axle.wheel.m" it is "axle_wheel.m".

        Raises:
            FMUError: if no component is on the way.
        """
        place, names = system, path.split(".")
        for count, name in enumerate(names, 1):
            place = (*place, name)
            if place in self.components:
                return ".".join([self.name(place), *names[count:]])
        raise FMUError(f"a parameter is given for '{path}', where there is no component")

    def connections(self) -> list[Connection]:
        """Return the connections from component to component; what comes from outside is left out."""
        into = {link.end: link for place in self.systems for link in self._links(place)}
        found = []
        for end in into:
            if end[0] in self.components:
                link = self._traced(end, into)
                if link.start[0] in self.components:
                    start, stop = (f"{self.name(place)}.{name}" for place, name in (link.start, link.end))
                    found.append(Connection(start, stop, link.factor, link.offset, link.convert))
        return found

    def _traced(self, end: End, into: dict[End, _Link]) -> _Link:
        """Return the link from where a value comes first."""
        link, seen = into[end], {end}
        while link.start in into and link.start[0] not in self.components and link.start not in seen:
            seen.add(link.start)
            before = into[link.start]
            if not (before.plain or link.plain):
                told = f"'{self.name(end[0])}.{end[1]}'"
                raise FMUError(f"{told} is reached by two linear transformations; keep one of them")
            scaled = before if link.plain else link
            convert = before.convert and link.convert
            link = _Link(before.start, end, scaled.factor, scaled.offset, convert)
        return link

    def _links(self, system: Place) -> Iterator[_Link]:
        """Yield the connections of one system from source to sink; SSP lets them be written either way."""
        for entry in self.systems[system].findall("ssd:Connections/ssd:Connection", NAMESPACES):
            ends = [self._end(system, entry, side) for side in ("start", "end")]
            if self._takes(system, ends[0]) and not self._takes(system, ends[1]):
                ends.reverse()
            linear = entry.find("ssc:LinearTransformation", NAMESPACES)
            told = {} if linear is None else linear.attrib
            convert = entry.get("suppressUnitConversion") not in ("true", "1")
            factor, offset = float(told.get("factor", 1.0)), float(told.get("offset", 0.0))
            yield _Link(ends[0], ends[1], factor, offset, convert)

    def _end(self, system: Place, entry: Any, side: str) -> End:
        element = entry.get(f"{side}Element")
        return (system if element is None else (*system, element)), entry.get(f"{side}Connector")

    def _takes(self, system: Place, end: End) -> bool:
        """Tell whether a value goes into an end, as it is seen inside of a system."""
        place, name = end
        entry = self.systems.get(place, self.components.get(place))
        listed = [] if entry is None else entry.findall("ssd:Connectors/ssd:Connector", NAMESPACES)
        kinds = [connector.get("kind") for connector in listed if connector.get("name") == name]
        return kinds == (["output"] if place == system else ["input"])
