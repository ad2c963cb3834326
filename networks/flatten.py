"""Flatten: from a tree of components to one set of variables and families of equations.

Paths, templates and connections become integers here; equal variables are joined before any
symbolic work, so the cost is linear in the number of elements.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from ..components.base import (
    Component,
    Mode,
    ModelError,
    Port,
    PortRef,
    RealInput,
    RealOutput,
    Template,
    nearest,
    template_of,
)
from .families import Family, sum_family
from .parameters import ParameterTable
from .union import SignedUnion
from .vectors import column, pick


@dataclass(eq=False)
class Instance:
    """One component in its place."""

    path: str
    component: Component
    parent: Instance | None
    template: Template
    base: int = 0
    row: int = 0

    def index(self, local: str) -> int:
        """Return the number of a variable given by its local name."""
        return self.base + self.template.place[local]

    def __str__(self) -> str:
        return f"{type(self.component).__name__} '{self.path}'"


@dataclass(eq=False)
class Flat:
    """Variables, equations and modes of a whole network."""

    name: str
    instances: dict[str, Instance]
    groups: list[list[Instance]]
    joined: SignedUnion
    table: ParameterTable
    families: list[Family] = field(default_factory=list)
    modes: list[tuple[Instance, Mode]] = field(default_factory=list)
    impulses: list[tuple[Instance, str]] = field(default_factory=list)
    mode_symbols: Any = None
    impulse_symbols: Any = None
    inputs: dict[str, int] = field(default_factory=dict)
    time: Any = field(default_factory=lambda: ca.SX.sym("time"))

    def variable(self, path: str) -> int:
        """Return the number of a variable given by its full name, or raise with the nearest one."""
        inner = path.removeprefix("der(").removesuffix(")") if path.startswith("der(") else path
        pieces = inner.split(".")
        for cut in range(len(pieces) - 1, -1, -1):
            instance = self.instances.get(".".join(pieces[:cut]))
            local = ".".join(pieces[cut:])
            if instance is not None and local in instance.template.variables:
                index = instance.index(local)
                return index if inner is path else self.derivative_of(path, index)
        raise KeyError(f"'{self.name}' has no variable '{path}'{nearest(path, self.names())}")

    def derivative_of(self, path: str, index: int) -> int:
        """Return the number of a variable's derivative, for a name like der(mass.v)."""
        root, sign = self.joined.find(index)
        known = self.joined.derivative.get(root)
        if known is None or sign < 0:
            raise KeyError(f"'{self.name}' has no variable '{path}'")
        return known

    def names(self) -> Iterator[str]:
        """Yield the full names of all variables."""
        for instance in self.instances.values():
            prefix = instance.path + "." if instance.path else ""
            for local in instance.template.variables:
                if not local.startswith("der("):
                    yield prefix + local


def flatten(network: Component) -> Flat:
    """Return the network's variables and equations, equal variables joined.

    Raises:
        ModelError: listing every problem of values and connections by component path.
    """
    name = getattr(network, "name", type(network).__name__)
    problems: list[str] = []
    instances = {i.path: i for i in _walk(network, "", None, problems, {})}
    groups = _grouped(instances)
    size = sum(len(group) * len(group[0].template.variables) for group in groups)
    flat = Flat(name, instances, groups, SignedUnion(size), ParameterTable(instances, problems))
    _collect_modes(flat)
    nodes, grounded = _connect(flat, problems)
    if problems:
        raise ModelError(f"'{name}' cannot be assembled:", problems)
    _join_aliases(flat)
    _find_inputs(flat, nodes)
    _component_families(flat)
    _node_families(flat, nodes)
    _zero_family(flat, grounded, "grounded support")
    _zero_family(flat, flat.joined.contradictions, "contradiction")
    return flat


def _walk(
    component: Component,
    path: str,
    parent: Instance | None,
    problems: list[str],
    seen: dict[int, str],
) -> Iterator[Instance]:
    if id(component) in seen:
        problems.append(
            f"{type(component).__name__} '{path}' is the same object as '{seen[id(component)]}'; "
            "give each place its own (`.clone()`)"
        )
        return
    seen[id(component)] = path
    problems.extend(f"{type(component).__name__} '{path}': {p}" for p in component.problems())
    instance = Instance(path, component, parent, template_of(component))
    yield instance
    for name, part in component._parts.items():
        yield from _walk(part, f"{path}.{name}" if path else name, instance, problems, seen)


def _grouped(instances: dict[str, Instance]) -> list[list[Instance]]:
    groups: dict[int, list[Instance]] = defaultdict(list)
    for instance in instances.values():
        groups[id(instance.template)].append(instance)
    base = 0
    for group in groups.values():
        for row, instance in enumerate(group):
            instance.base, instance.row = base, row
            base += len(instance.template.variables)
    return list(groups.values())


def _collect_modes(flat: Flat) -> None:
    for instance in flat.instances.values():
        fields = type(instance.component).fields
        for name in instance.template.modes:
            flat.modes.append((instance, fields[name]))  # type: ignore[arg-type]
        flat.impulses.extend((instance, name) for name in instance.template.impulses)
    flat.mode_symbols = ca.SX.sym("mode", len(flat.modes))
    flat.impulse_symbols = ca.SX.sym("impulse", len(flat.impulses))


@dataclass(eq=False)
class _Node:
    """Ports joined at one level of the tree; own ports of the composite count negatively."""

    ports: list[tuple[Instance, str, int]] = field(default_factory=list)


def _connect(flat: Flat, problems: list[str]) -> tuple[list[_Node], list[int]]:
    """Join what connections join; return the nodes and the across variables that are grounded."""
    by_component = {id(i.component): i for i in flat.instances.values()}
    outside: set[tuple[int, str]] = set()
    nodes: list[_Node] = []
    for owner in flat.instances.values():
        node_of: dict[tuple[int, str], _Node] = {}
        for ports in owner.component.connections():
            members = _members(owner, ports, by_component, problems)
            outside.update((id(i), name) for i, name, sign in members if sign > 0)
            _merge(members, node_of)
        distinct = {id(node): node for node in node_of.values()}
        nodes.extend(distinct.values())
    for node in nodes:
        _check_node(node, problems)
    if not problems:
        _join_nodes(flat, nodes)
    return nodes, list(_unconnected(flat, outside, problems))


def _members(
    owner: Instance,
    ports: tuple[PortRef, ...],
    by_component: dict[int, Instance],
    problems: list[str],
) -> list[tuple[Instance, str, int]]:
    members = []
    for port in ports:
        instance = by_component.get(id(port.component))
        if instance is None or (instance is not owner and instance.parent is not owner):
            problems.append(
                f"{port!r} is connected in '{owner.path or 'the network'}' but belongs to no "
                "component of it; add the component, or connect it where it lives"
            )
            continue
        members.append((instance, port.name, -1 if instance is owner else 1))
    return members


def _merge(members: list[tuple[Instance, str, int]], node_of: dict[tuple[int, str], _Node]) -> None:
    node = _Node()
    for member in members:
        key = (id(member[0]), member[1])
        present = node_of.get(key)
        if present is node:
            continue
        if present is None:
            node.ports.append(member)
            node_of[key] = node
            continue
        small, large = sorted((node, present), key=lambda n: len(n.ports))
        large.ports.extend(small.ports)
        for other in small.ports:
            node_of[(id(other[0]), other[1])] = large
        node = large


def _port(instance: Instance, name: str) -> Any:
    return type(instance.component).fields[name]


def _check_node(node: _Node, problems: list[str]) -> None:
    kinds = defaultdict(list)
    drivers = []
    for instance, name, sign in node.ports:
        declared = _port(instance, name)
        where = f"{instance.path}.{name}".lstrip(".")
        kinds[getattr(declared, "domain", "signal")].append(where)
        if isinstance(declared, RealOutput if sign > 0 else RealInput):
            drivers.append(where)
    if len(kinds) > 1:
        told = "; ".join(f"{kind}: {', '.join(where)}" for kind, where in kinds.items())
        problems.append(f"one node joins ports of different kinds ({told}); connect like with like")
    elif "signal" in kinds and len(drivers) > 1:
        problems.append(f"one signal has several sources: {', '.join(drivers)}; keep one")


def _join_nodes(flat: Flat, nodes: list[_Node]) -> None:
    for node in nodes:
        suffix = _suffix(node, "across")
        first, name, _ = node.ports[0]
        anchor = first.index(name + suffix)
        for instance, name, _ in node.ports[1:]:
            flat.joined.join(anchor, instance.index(name + suffix))


def _suffix(node: _Node, kind: str) -> str:
    declared = _port(node.ports[0][0], node.ports[0][1])
    return f".{getattr(declared, kind)}" if isinstance(declared, Port) else ""


def _unconnected(flat: Flat, outside: set[tuple[int, str]], problems: list[str]) -> Iterator[int]:
    for instance in flat.instances.values():
        if instance.parent is None:
            continue
        for name, declared in type(instance.component).fields.items():
            if not isinstance(declared, Port) or (id(instance), name) in outside:
                continue
            if declared.optional:
                yield instance.index(f"{name}.{declared.across}")
            else:
                problems.append(f"{instance}: {name} is not connected; connect it (to a Fixed if it is held)")


def _join_aliases(flat: Flat) -> None:
    for group in flat.groups:
        template = group[0].template
        place = template.place
        pairs = [(place[x], place[dx]) for x, dx in template.derivatives.items()]
        aliases = [(place[a], place[b], sign) for a, b, sign in template.aliases]
        for instance in group:
            base = instance.base
            for x, dx in pairs:
                flat.joined.set_derivative(base + x, base + dx)
            for a, b, sign in aliases:
                flat.joined.join(base + a, base + b, sign)
            if instance.component._parts:
                _join_used_parts(flat, instance)


def _join_used_parts(flat: Flat, instance: Instance) -> None:
    """Tie the symbols by which equations use variables of parts to the parts' own."""
    for local in instance.template.variables:
        head = local.split(".")[0]
        if head in instance.component._parts and not local.startswith("der("):
            path = f"{instance.path}.{local}" if instance.path else local
            owner, _, rest = _owner(flat, path)
            flat.joined.join(instance.index(local), owner.index(rest))


def _owner(flat: Flat, path: str) -> tuple[Instance, str, str]:
    pieces = path.split(".")
    for cut in range(len(pieces) - 1, 0, -1):
        head = ".".join(pieces[:cut])
        if head in flat.instances:
            return flat.instances[head], head, ".".join(pieces[cut:])
    raise KeyError(path)


def _find_inputs(flat: Flat, nodes: list[_Node]) -> None:
    """Note the signals that no connection drives: the inputs of the whole network."""
    driven: set[tuple[int, str]] = set()
    for node in nodes:
        for instance, name, sign in node.ports:
            declared = _port(instance, name)
            source = RealOutput if sign > 0 else RealInput
            if isinstance(declared, source) and (sign > 0 or instance.parent is not None):
                driven.update((id(i), n) for i, n, _ in node.ports)
    for instance in flat.instances.values():
        for name, declared in type(instance.component).fields.items():
            if isinstance(declared, RealInput) and (id(instance), name) not in driven:
                path = f"{instance.path}.{name}" if instance.path else name
                flat.inputs[path] = instance.index(name)


def local_arguments(flat: Flat, group: list[Instance]) -> tuple[Any, Any]:
    """Return what a template takes as given, as symbols (k,) and as arguments (k, instances)."""
    template = group[0].template
    mode_of = {(id(i), m.name): k for k, (i, m) in enumerate(flat.modes)}
    impulse_of = {(id(i), name): k for k, (i, name) in enumerate(flat.impulses)}
    modes = [[mode_of[id(i), name] for i in group] for name in template.modes]
    impulses = [[impulse_of[id(i), name] for i in group] for name in template.impulses]
    arguments = ca.vertcat(
        flat.table.matrix(group),
        *[flat.mode_symbols[row].T for row in modes],
        *[flat.impulse_symbols[row].T for row in impulses],
    )
    symbols = [*template.parameters.values(), *template.modes.values(), *template.impulses.values()]
    return column(symbols), arguments


def _label(group: list[Instance]) -> Callable[[int], str]:
    return lambda row: str(group[row])


def _component_families(flat: Flat) -> None:
    for group in flat.groups:
        template = group[0].template
        if not template.residuals:
            continue
        symbols = ca.vertcat(*template.variables.values())
        modes = column([*template.modes.values()])
        given, arguments = local_arguments(flat, group)
        bases = np.array([i.base for i in group], dtype=np.int64)[:, None]
        for residual in template.residuals:
            used = [i for i in range(symbols.numel()) if ca.depends_on(residual, symbols[i])]
            columns = bases + np.array(used, dtype=np.int64)[None, :]
            flat.families.append(
                Family(
                    residual, pick(symbols, used), given, template.time, columns,
                    np.ones_like(columns), arguments, _label(group), modes,
                )
            )  # fmt: skip


def _node_families(flat: Flat, nodes: list[_Node]) -> None:
    """State that through variables sum to zero; two of them are equal and opposite at once."""
    sums: dict[int, list[tuple[list[int], list[int], str]]] = defaultdict(list)
    for node in nodes:
        suffix = _suffix(node, "through")
        if not suffix:
            continue
        numbers = [i.index(name + suffix) for i, name, _ in node.ports]
        signs = [sign for *_, sign in node.ports]
        if len(numbers) == 2:
            flat.joined.join(numbers[0], numbers[1], -signs[0] * signs[1])
            continue
        ports = ", ".join(f"{i.path}.{name}".lstrip(".") for i, name, _ in node.ports)
        sums[len(numbers)].append((numbers, signs, f"node of {ports}"))
    for members in sums.values():
        numbers_, signs_, labels = zip(*members, strict=True)
        flat.families.append(sum_family(numbers_, signs_, labels))


def _zero_family(flat: Flat, variables: list[int], label: str) -> None:
    if variables:
        flat.families.append(sum_family([[v] for v in variables], [[1] for _ in variables], label))
