"""Springs, dampers and inerters in series, in parallel and in bridges, before they become components."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Any, ClassVar

from ...components import Component, Damper, Inerter, Spring
from ..two_terminal import bridge, parallel, series
from .ratio import INFINITY, AxisPole, Scale


@dataclass(frozen=True)
class Element:
    """One element: its admittance is value s^power: a spring (-1), a damper (0), an inerter (1)."""

    size: ClassVar[int] = 1
    power: int
    value: float

    def __call__(self, s: Any) -> Any:
        return self.value * s ** float(self.power)

    def mapped(self, change: Callable[[Element], Element]) -> Element:
        return change(self)

    def component(self) -> Component:
        if self.power < 0:
            return Spring(k=self.value)
        return Inerter(b=self.value) if self.power else Damper(d=self.value)


@dataclass(frozen=True)
class Join:
    """Parts as `how` joins them: `parallel`, `series` or `bridge`; called with s it is the admittance."""

    how: Callable[..., Component]
    parts: tuple[Tree, ...]

    @property
    def size(self) -> int:
        """Number of elements."""
        return sum(part.size for part in self.parts)

    def __call__(self, s: Any) -> Any:
        return ADMITTANCES[self.how]([part(s) for part in self.parts])

    def mapped(self, change: Callable[[Element], Element]) -> Join:
        """Return the network with each element changed."""
        return Join(self.how, tuple(part.mapped(change) for part in self.parts))

    def component(self) -> Component:
        return self.how(*(part.component() for part in self.parts))


Tree = Element | Join


def _bridge_admittance(parts: Sequence[Any]) -> Any:
    """Return the products of parts that join all nodes over those that part the ends (Kirchhoff's trees)."""
    a, b, c, d, e = parts
    whole = a * b * (c + d + e) + c * d * (a + b + e) + e * (a * d + b * c)
    return whole / ((a + b) * (c + d) + e * (a + b + c + d))


ADMITTANCES: dict[Callable[..., Component], Callable[[Sequence[Any]], Any]] = {
    parallel: sum,
    series: lambda parts: 1 / sum(1 / part for part in parts),
    bridge: _bridge_admittance,
}


@dataclass(frozen=True)
class Side:
    """Whether a function is an admittance, whose terms stand side by side, or an impedance."""

    beside: bool

    @property
    def other(self) -> Side:
        """The side of 1/F."""
        return Side(not self.beside)

    def term(self, power: int, factor: Decimal) -> Tree:
        """Return the element of the term factor s^power."""
        value = float(factor)
        return Element(power, value) if self.beside else Element(-power, 1 / value)

    def pole(self, pole: AxisPole) -> Tree:
        if pole.x in (0, INFINITY):
            return self.term(1 if pole.x else -1, pole.residue)
        return self.inverse({1: 1 / pole.residue, -1: pole.x / pole.residue})

    def inverse(self, terms: Mapping[int, Decimal]) -> Tree:
        """Return the network of 1/F, F the sum of terms, given as power: factor."""
        return self.other.joined([self.other.term(*term) for term in terms.items()])

    def joined(self, parts: Iterable[Tree]) -> Tree:
        """Join the terms of a sum; what is joined alike is one join, elements of a kind one element."""
        how: Callable[..., Component] = parallel if self.beside else series
        flat: list[Tree] = []
        for part in parts:
            flat += part.parts if isinstance(part, Join) and part.how is how else [part]
        kept: list[Tree] = [part for part in flat if isinstance(part, Join)]
        for power in (-1, 0, 1):
            alike = [part.value for part in flat if isinstance(part, Element) and part.power == power]
            if alike:
                kept.append(Element(power, ADMITTANCES[how](alike)))
        return kept[0] if len(kept) == 1 else Join(how, tuple(kept))

    def bridged(self, parts: Sequence[Tree]) -> Join:
        """Return the bridge of parts given for an impedance, or its dual for an admittance."""
        a, b, c, d, e = parts
        return Join(bridge, (a, c, b, d, e) if self.beside else (a, b, c, d, e))


def scaled_by(scale: Scale, network: Tree) -> Tree:
    """Return the network of the true function from that of the normalised one."""
    return network.mapped(lambda e: Element(e.power, e.value * scale.gain * scale.rate**-e.power))
