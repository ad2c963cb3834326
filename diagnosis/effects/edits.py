"""Edits: what an effect changes in a network, as operations and as the Python lines that make it for good."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from ...base.checks import demand, instance, text
from ...components import FAMILIES, Component, rotational, signals
from ...components.language import PortRef, parts_of
from ...networks import Network, exchange
from .sites import GROUND


@dataclass(frozen=True)
class AddPart:
    """Add a component by name."""

    name: str
    component: Component

    def __call__(self, network: Network) -> None:
        network.add(**{self.name: self.component.clone()})

    def __str__(self) -> str:
        return f"net.add({self.name}={_code(self.component)})"


@dataclass(frozen=True)
class Connect:
    """Join ports given by path."""

    ports: tuple[str, ...]

    def __call__(self, network: Network) -> None:
        network.connect(*(port_at(network, path) for path in self.ports))

    def __str__(self) -> str:
        return f"net.connect({', '.join(f'net.{path}' for path in self.ports)})"


@dataclass(frozen=True)
class Insert:
    """Put a component between a port given by path and what the port is connected to."""

    port: str
    name: str
    component: Component

    def __call__(self, network: Network) -> None:
        network.insert(port_at(network, self.port), **{self.name: self.component.clone()})

    def __str__(self) -> str:
        return f"net.insert(net.{self.port}, {self.name}={_code(self.component)})"


@dataclass(frozen=True)
class Exchange:
    """Put a component in the place of another one, given by path."""

    path: str
    component: Component

    def __call__(self, network: Network) -> None:
        exchange(network, self.path, self.component.clone())

    def __str__(self) -> str:
        return f'net = net.with_values(**{{"{self.path}": {_code(self.component)}}})'


Edit = AddPart | Connect | Insert | Exchange


def edited(network: Network, edits: Iterable[Edit]) -> Network:
    """Return a copy of a network with edits made."""
    copy = network.clone()
    for edit in edits:
        edit(copy)
    return copy


def between(name: str, component: Component, fixed: str, moving: str) -> list[Edit]:
    """Return the edits that put a component between two flanges, of which `fixed` may be the ground."""
    demand(
        "between()",
        name=(name, text),
        component=(component, instance(Component)),
        fixed=(fixed, text),
        moving=(moving, text),
    )
    edits: list[Edit] = [AddPart(name, component)]
    if fixed == GROUND:
        edits.append(AddPart(f"{name}_ground", FAMILIES[PortRef(component, "flange_a").domain or ""].Fixed()))
        fixed = f"{name}_ground.flange"
    return [*edits, Connect((fixed, f"{name}.flange_a")), Connect((f"{name}.flange_b", moving))]


def part_at(network: Network, path: str) -> Component:
    """Return a component of a network by its path."""
    component: Component = network
    for name in path.split("."):
        component = parts_of(component)[name]
    return component


def port_at(network: Network, path: str) -> PortRef:
    """Return a port of a network by its path."""
    owner, _, name = path.rpartition(".")
    return PortRef(part_at(network, owner) if owner else network, name)


def _code(component: Component) -> str:
    """Return the call that makes a component; those of families go by their prefix, joined ones as well."""
    families = {"rotational.": rotational.__name__, "signals.": signals.__name__}
    told = repr(component)
    for part in (component, *parts_of(component).values()):
        kind = type(part)
        prefix = "".join(p for p, family in families.items() if kind.__module__.startswith(family))
        told = re.sub(rf"(?<![\w.]){kind.__name__}\(", f"{prefix}{kind.__name__}(", told)
    return told
