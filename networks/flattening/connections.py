"""Connections: ports joined at nodes, and what is wrong with them."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from typing import Any

from ...components.language import (
    Domain,
    Port,
    PortRef,
    RealInput,
    RealOutput,
    fields_of,
    is_there,
    values_of,
)
from .flat import FatalProblem, Flat, Instance

_Member = tuple[Instance, str, int]


@dataclass(eq=False, slots=True)
class Node:
    """Joined ports; a composite's own port, seen from inside, counts negatively.

    Attributes:
        domain: that of the flanges, None of signals.
    """

    ports: list[_Member] = field(default_factory=list)
    domain: Domain | None = None

    def ending(self, kind: str) -> str:
        """Return what follows the ports' names in those of their across or through variables."""
        return f".{getattr(self.domain, kind)}" if self.domain else ""

    def __str__(self) -> str:
        return "node of " + ", ".join(instance.full(name) for instance, name, _ in self.ports)


def connect_ports(flat: Flat) -> tuple[list[Node], dict[str, list[Any]]]:
    """Join what connections join; return the nodes, and what is zero as it is connected to nothing."""
    problems, by_component = flat.problems, {id(i.component): i for i in flat.instances.values()}
    node_of: dict[_Member, Node] = {}
    insertions = [(o, *ports) for o in flat.instances.values() for ports in o.component.insertions()]
    moved = {(id(port.component), port.name): near for _, port, _, near in insertions}
    for owner in flat.instances.values():
        try:
            for ports in owner.component.connections():
                members = _members(owner, ports, by_component, problems)
                if moved:
                    members = [_moved(member, moved, by_component) for member in members]
                _merge(members, node_of)
        except AttributeError as error:
            problems.append(FatalProblem(f"{owner}: its connections cannot be made: {error}"))
    for owner, port, far, _ in insertions:
        _merge(_members(owner, (port, far), by_component, problems), node_of)
    outside = {(instance, name) for instance, name, sign in node_of if sign > 0}
    nodes = list({id(node): node for node in node_of.values()}.values())
    for node in nodes:
        _check_node(node, problems)
    if not flat.hopeless:
        _join_nodes(flat, nodes)
    return nodes, _unconnected(flat, outside)


def _members(
    owner: Instance, ports: tuple[PortRef, ...], by_component: dict[int, Instance], problems: list[str]
) -> list[_Member]:
    members = []
    for port in ports:
        instance = by_component.get(id(port.component))
        if instance is None or (instance.parent is not owner and not _belongs(instance, owner)):
            told = f"{port!r} is connected in {owner if owner.path else 'the network'}"
            remedy = "but belongs to no component of it; add the component, or connect it where it lives"
            problems.append(FatalProblem(f"{told} {remedy}"))
            continue
        declared = port_of(instance, port.name)
        if not is_there(instance.component, declared):
            told = f"{instance}: {port.name} is there with {declared.when}=True only"
            problems.append(FatalProblem(told))
            continue
        members.append((instance, port.name, -1 if instance is owner else 1))
    return members


def _moved(
    member: _Member, moved: dict[tuple[int, str], PortRef], by_component: dict[int, Instance]
) -> _Member:
    """Return the flange of what is inserted at a port, if anything is, in the port's stead."""
    instance, name, sign = member
    near = moved.get((id(instance.component), name)) if sign > 0 else None
    if near is None:
        return member
    return _moved((by_component[id(near.component)], near.name, 1), moved, by_component)


def _belongs(instance: Instance | None, owner: Instance) -> bool:
    while instance is not None and instance is not owner:
        instance = instance.parent
    return instance is owner


def _merge(members: list[_Member], node_of: dict[_Member, Node]) -> None:
    node = Node()
    for member in members:
        present = node_of.get(member)
        if present is None:
            node.ports.append(member)
            node_of[member] = node
        elif present is not node:
            small, large = sorted((node, present), key=lambda n: len(n.ports))
            large.ports += small.ports
            for other in small.ports:
                node_of[other] = large
            node = large


def port_of(instance: Instance, name: str) -> Any:
    """Return the declaration of a port."""
    return type(instance.component).fields[name]


def _check_node(node: Node, problems: list[str]) -> None:
    domain, *others = {port_of(instance, name).domain for instance, name, _ in node.ports}
    if domain and not others:
        node.domain = domain
        return
    kinds, drivers = defaultdict(list), []
    for instance, name, sign in node.ports:
        declared, where = port_of(instance, name), instance.full(name)
        kinds[declared.domain or "signal"].append(where)
        if isinstance(declared, RealOutput if sign > 0 else RealInput):
            drivers.append(where)
    if len(kinds) > 1:
        told = "; ".join(f"{kind}: {', '.join(where)}" for kind, where in kinds.items())
        wrong = f"one node joins ports of different kinds ({told}); connect like with like"
        problems.append(FatalProblem(wrong))
    elif "signal" in kinds and len(drivers) > 1:
        problems.append(FatalProblem(f"one signal has several sources: {', '.join(drivers)}; keep one"))
    for instance, name, sign in node.ports if drivers else ():
        if sign > 0 and values_of(instance.component).get(name) is not None:
            wrong = f"{instance}: {name} has a signal of its own and that of {drivers[0]}; keep one"
            problems.append(FatalProblem(wrong))


def _join_nodes(flat: Flat, nodes: list[Node]) -> None:
    for node in nodes:
        ending = node.ending("across")
        first, name, _ = node.ports[0]
        anchor = first.index(name + ending)
        for instance, name, _ in node.ports[1:]:
            flat.joined.join(anchor, instance.index(name + ending))


def _unconnected(flat: Flat, outside: set[tuple[Instance, str]]) -> dict[str, list[Any]]:
    """Return what is zero at flanges that are connected to nothing, by what these are called.

    Supports are held and bodies free. At others, which are a problem, across and through variables are as if
    they met something that neither holds nor drives them, to look for more faults.
    """
    grounded, free, loose = list[int](), list[int](), list[tuple[int, int]]()
    for instance in flat.instances.values():
        if instance.parent is None:
            continue
        for declared in fields_of(instance.component, Port):
            if (instance, declared.name) in outside:
                continue
            kinds = declared.across, declared.through
            across, through = (instance.index(f"{declared.name}.{kind}") for kind in kinds)
            if declared.optional:
                grounded.append(across)
            elif declared.free:
                free.append(through)
            else:
                others = sum(not port.optional for port in fields_of(instance.component, Port)) > 1
                remedy = "connect it (to a Fixed if it is held, alone if its end is free)"
                remedy = remedy if others else "connect it, or leave it out"
                flat.problems.append(f"{instance}: {declared.name} is not connected; {remedy}")
                loose.append((across, through))
    return {"grounded support": grounded, "free flange": free, "loose flange": loose}


def find_inputs(flat: Flat, nodes: list[Node]) -> None:
    """Note the signals that no connection drives: the inputs of the whole network."""
    driven: set[tuple[int, str]] = set()
    for node in nodes:
        for instance, name, sign in () if node.domain else node.ports:
            declared = port_of(instance, name)
            source = RealOutput if sign > 0 else RealInput
            if isinstance(declared, source) and (sign > 0 or instance.parent is not None):
                driven.update((id(i), n) for i, n, inner in node.ports if inner > 0)
    for instance in flat.instances.values():
        for declared in fields_of(instance.component, RealInput):
            if (id(instance), declared.name) not in driven:
                flat.inputs[instance.full(declared.name)] = instance.index(declared.name)
