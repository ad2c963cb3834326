"""Springs, dampers and inerters in series, in parallel and in bridges, before they become components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...components import Component, Damper, Inerter, Spring
from ..two_terminal import bridge, parallel, series
from .ratio import Scale


@dataclass(frozen=True)
class Element:
    """One element: its admittance is value s^power: a spring (-1), a damper (0), an inerter (1)."""

    power: int
    value: float

    @property
    def elements(self) -> list[Element]:
        """All elements."""
        return [self]

    def __call__(self, s: Any) -> Any:
        """Return the admittance."""
        return self.value * s ** float(self.power)

    def at(self, scale: Scale) -> Element:
        """Return the element of the true function from that of the normalised one."""
        return Element(self.power, self.value * scale.gain * scale.rate**-self.power)

    def component(self) -> Component:
        """Return the component."""
        if self.power < 0:
            return Spring(k=self.value)
        return Inerter(b=self.value) if self.power else Damper(d=self.value)


@dataclass(frozen=True)
class Join:
    """Parts side by side or end to end."""

    beside: bool
    parts: tuple[Tree, ...]

    @property
    def elements(self) -> list[Element]:
        """All elements."""
        return [element for part in self.parts for element in part.elements]

    def __call__(self, s: Any) -> Any:
        """Return the admittance."""
        if self.beside:
            return sum(part(s) for part in self.parts)
        return 1 / sum(1 / part(s) for part in self.parts)

    def at(self, scale: Scale) -> Join:
        """Return the network of the true function from that of the normalised one."""
        return Join(self.beside, tuple(part.at(scale) for part in self.parts))

    def component(self) -> Component:
        """Return the two-terminal element."""
        joined = parallel if self.beside else series
        return joined(*(part.component() for part in self.parts))


@dataclass(frozen=True)
class Bridge:
    """Five parts as `bridge` joins them."""

    parts: tuple[Tree, ...]

    @property
    def elements(self) -> list[Element]:
        """All elements."""
        return [element for part in self.parts for element in part.elements]

    def __call__(self, s: Any) -> Any:
        """Return the admittance: the trees that join all nodes over those that part the ends."""
        a, b, c, d, e = (part(s) for part in self.parts)
        whole = a * b * (c + d + e) + c * d * (a + b + e) + e * (a * d + b * c)
        return whole / ((a + b) * (c + d) + e * (a + b + c + d))

    def at(self, scale: Scale) -> Bridge:
        """Return the network of the true function from that of the normalised one."""
        return Bridge(tuple(part.at(scale) for part in self.parts))

    def component(self) -> Component:
        """Return the two-terminal element."""
        return bridge(*(part.component() for part in self.parts))


Tree = Element | Join | Bridge


def joined(beside: bool, parts: list[Tree]) -> Tree:
    """Join parts; what is joined alike is one join, elements of a kind one element."""
    flat: list[Tree] = []
    for part in parts:
        flat += part.parts if isinstance(part, Join) and part.beside == beside else [part]
    kept: list[Tree] = [part for part in flat if not isinstance(part, Element)]
    for power in (-1, 0, 1):
        alike = [p.value for p in flat if isinstance(p, Element) and p.power == power]
        if alike:
            kept.append(Element(power, sum(alike) if beside else 1 / sum(1 / v for v in alike)))
    return kept[0] if len(kept) == 1 else Join(beside, tuple(kept))


def bridged(beside: bool, parts: list[Tree]) -> Bridge:
    """Return the bridge of parts given for an impedance, or its dual for an admittance."""
    a, b, c, d, e = parts
    return Bridge((a, c, b, d, e) if beside else (a, b, c, d, e))
