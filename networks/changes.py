"""Networks after a change: components taken out, or exchanged, at any depth."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile
from typing import TYPE_CHECKING, cast

from ..base import ModelError, nearest
from ..components.language import Component, PortRef, parts_of

if TYPE_CHECKING:
    from .network import Network

Node = tuple[PortRef, ...]
Key = tuple[Component, str]  # of a port


def exchange(network: Network, path: str, component: Component) -> None:
    """Put a component in the place of another one; connections go to the new one."""
    owners, name = _owners(network, path), path.rpartition(".")[2]
    networks, old = _networks(owners), parts_of(owners[-1])[name]
    joined = {
        p.name for owner in networks for node in owner.connections() for p in node if p.component is old
    }
    missing = sorted(joined - type(component).fields.keys())
    if missing:
        told = f"{type(component).__name__} has no {missing[0]}, at which '{path}' is joined"
        raise ModelError(f"Network '{network.name}': {told}; exchange it for one that has it")
    parts_of(owners[-1])[name] = component
    component._owner = owners[-1]
    for owner in networks:
        owner._refer({old: component})


def remove(network: Network, path: str) -> None:
    """Take a component out of a network; what is joined at its ports stays joined."""
    owners, name = _owners(network, path), path.rpartition(".")[2]
    networks, part = _networks(owners), parts_of(owners[-1])[name]
    if len(networks) < len(owners):
        kind = type(owners[len(networks)]).__name__
        raise ModelError(f"'{path}' is a part of a {kind}, which cannot be without it; exchange it instead")
    gone = {*_within(part)}
    for owner in networks:
        for port, near, _ in owner.insertions():
            if port.component in gone and near.component not in gone:
                told = next(n for n, other in parts_of(owner).items() if other is near.component)
                raise ModelError(
                    f"'{told}' is inserted at '{path}', at its {port.name}; remove '{told}', too"
                )
    _rejoin(networks, gone)
    del parts_of(networks[-1])[name]
    networks[-1]._inserted = [(port, other) for port, other in networks[-1]._inserted if other != name]


def _owners(network: Network, path: str) -> list[Component]:
    """Return what encloses a component that is named by its path, the network first."""
    owners, passed = list[Component]([network]), list[str]()
    for name in path.split("."):
        parts = parts_of(owners[-1])
        if name not in parts:
            place = f" in '{'.'.join(passed)}'" if passed else ""
            told = f"has no component '{name}'{place}{nearest(name, parts)}"
            raise ModelError(f"Network '{network.name}' {told}")
        owners.append(parts[name])
        passed.append(name)
    return owners[:-1]


def _networks(owners: Sequence[Component]) -> list[Network]:
    """Return the networks, whose connections may change, that come before the first owner that is none."""
    found = takewhile(lambda owner: "_joined" in vars(owner), owners)
    return [cast("Network", owner) for owner in found]


def _within(component: Component) -> Iterator[Component]:
    yield component
    for part in parts_of(component).values():
        yield from _within(part)


def _rejoin(networks: Sequence[Network], gone: set[Component]) -> None:
    """Let what was joined by way of ports that go stay joined, in the outermost network."""
    at_them = list[Node]()
    for owner in networks:
        at_them += [node for node in owner._joined if _lost(node, gone)]
        owner._joined = [node for node in owner._joined if not _lost(node, gone)]
    for node in _merged(at_them, gone):
        left = tuple(port for port in node if port.component not in gone)
        if left:
            networks[0]._joined.append(left)


def _merged(nodes: Iterable[Node], gone: set[Component]) -> list[Node]:
    """Return nodes of which those that share a port that goes are one."""
    merged = list[Node]()
    for node in nodes:
        touching = [other for other in merged if _lost(other, gone) & _lost(node, gone)]
        merged = [other for other in merged if other not in touching]
        merged.append(
            tuple({(p.component, p.name): p for other in (*touching, node) for p in other}.values())
        )
    return merged


def _lost(node: Node, gone: set[Component]) -> set[Key]:
    """Return the ports of a node that go."""
    return {(port.component, port.name) for port in node if port.component in gone}
