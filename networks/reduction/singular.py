"""The structural check: is there one equation for every unknown? If not: who is concerned, and the remedy.

The Dulmage-Mendelsohn decomposition parts what is determined twice from what nothing determines.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import TypeVar

import numpy as np

from ...base import ModelError
from ...components import Fixed
from ...components.language import Field, Parameter, Port, RealOutput, Variable, fields_of
from ...components.rotational import Fixed as RotationalFixed
from ..flattening.flat import Instance
from ..flattening.union import SignedUnion
from .pantelides import Equation, System, counted

_T = TypeVar("_T")
_GIVES_WAY = {
    "translational": "a Spring",
    "rotational": "a rotational.Spring",
    "thermal": "a ThermalConductor",
}
_HAS_INERTIA = {
    "translational": "a Mass or a Fixed",
    "rotational": "an Inertia or a rotational.Fixed",
    "thermal": "a HeatCapacitor or a FixedTemperature",
}


def check_structure(system: System) -> None:
    """Raise a ModelError that names the components of a singular network.

    Orders of differentiation are set aside: a variable and its derivatives count as one unknown, so
    what fails here cannot be mended by any index reduction.
    """
    bases = system.bases()
    chain = (bases == np.arange(system.size)) & system.is_root()
    chain[bases[list(system.known)]] = False
    chains = np.flatnonzero(chain).tolist()
    owners, pattern = system.equations(), system.incidence(counted(chain)[bases])
    _, order, permuted, _, _, coarse_rows, coarse_columns = pattern.btf()
    over = [owners[i] for i in order[: coarse_rows[2]]] if coarse_rows[1] else []
    under = [chains[i] for i in permuted[coarse_columns[2] :]] if coarse_columns[3] < len(chains) else []
    if over or under:
        problems = _told(system, over, under)
        raise ModelError(f"'{system.flat.name}' is structurally singular:", problems)


def _told(system: System, over: list[Equation], under: list[int]) -> list[str]:
    """Return what is wrong, a sentence for each place: too many equations, or unknowns with too few."""
    unbalanced = list(_unbalanced(system.flat.instances.values()))
    if unbalanced:
        return unbalanced
    place = _Place(system)
    problems: list[str] = []
    concerned: set[int] = set()
    for equations in grouped(over, place.unknowns_of):
        instances = place.instances_of(equations)
        if not instances and under:
            continue
        concerned |= place.through(instances)
        problems.append(_conflict(place, instances))
    open_ = [
        unknowns
        for unknowns in grouped(under, place.equations_with.__getitem__)
        if not concerned & set(unknowns)
    ]
    return problems + [_undetermined(place, unknowns) for unknowns in open_]


class _Place:
    """Finds components and ports behind equations and unknowns."""

    def __init__(self, system: System) -> None:
        self.system, self.bases = system, system.bases()
        self.by_label = {str(i): i for i in system.flat.instances.values()}
        self.equations_with: dict[int, set[Equation]] = defaultdict(set)
        for equation in system.equations():
            for unknown in self.unknowns_of(equation):
                self.equations_with[unknown].add(equation)
        self.ports_at: dict[int, list[tuple[Instance, Port]]] = defaultdict(list)
        for instance, port in self.ports(system.flat.instances.values()):
            self.ports_at[self.number(instance, port, "across")].append((instance, port))

    def unknowns_of(self, equation: Equation) -> set[int]:
        """Return the unknowns in an equation."""
        number, row = equation
        return set(self.bases[self.system.families[number].columns[row]].tolist())

    def instances_of(self, equations: Iterable[Equation]) -> list[Instance]:
        """Return the components that state some equations, in order of their names."""
        labels = {label for e in equations for label in self.system.label(e).split(", ")}
        return [self.by_label[label] for label in sorted(labels & self.by_label.keys())]

    def ports(self, instances: Iterable[Instance]) -> Iterator[tuple[Instance, Port]]:
        """Yield the ports of components."""
        for instance in instances:
            for declared in fields_of(instance.component, Port):
                yield instance, declared

    def number(self, instance: Instance, port: Port, kind: str) -> int:
        """Return the unknown that a port's across or through variable is."""
        local = instance.index(f"{port.name}.{port.across if kind == 'across' else port.through}")
        return int(self.bases[self.system.names.roots[local]])

    def through(self, instances: Iterable[Instance]) -> set[int]:
        """Return the through variables of components."""
        return {self.number(i, p, "through") for i, p in self.ports(instances)}

    def node(self, unknown: int) -> list[str]:
        """Return the names of the ports whose across variable is an unknown."""
        return [f"{i.path}.{p.name}".lstrip(".") for i, p in self.ports_at[unknown]]

    def domain(self, unknown: int) -> str:
        """Return the domain of the ports whose across variable is an unknown, empty if it is none."""
        return next((p.domain for _, p in self.ports_at[unknown]), "")


def grouped(members: list[_T], keys: Callable[[_T], Iterable[Hashable]]) -> list[list[_T]]:
    """Put members that share a key into one group."""
    joined = SignedUnion(len(members))
    first: dict[Hashable, int] = {}
    for number, member in enumerate(members):
        for key in keys(member):
            joined.join(first.setdefault(key, number), number)
    groups: dict[int, list[_T]] = defaultdict(list)
    for number, member in enumerate(members):
        groups[joined.find(number)[0]].append(member)
    return list(groups.values())


def _unbalanced(instances: Iterable[Instance]) -> Iterator[str]:
    """Tell of components that state more or fewer equations than they have unknowns of their own."""
    unknowns: dict[Instance, list[str]] = defaultdict(list)
    stated: dict[Instance, int] = defaultdict(int)
    for instance in instances:
        speaker = _speaker(instance)
        unknowns[speaker] += _unknowns(instance)
        stated[speaker] += len(instance.template.residuals) + len(instance.template.aliases)
    for instance, names in unknowns.items():
        missing = len(names) - stated[instance]
        if missing:
            yield (
                f"{instance}: states {stated[instance]} equations for its {len(names)} unknowns "
                f"({_listed(names)}), which is {abs(missing)} too {'few' if missing > 0 else 'many'}"
            )


def _speaker(instance: Instance) -> Instance:
    """Return the component that states the equations: the composite, if its own use a part's variables."""
    parent, name = instance.parent, instance.path.rpartition(".")[2]
    if parent is not None and any(v.startswith(f"{name}.") for v in parent.template.variables):
        return _speaker(parent)
    return instance


def _unknowns(instance: Instance) -> list[str]:
    component = instance.component
    inside = {p.name for ports in component.connections() for p in ports if p.component is component}
    fields = [f for f in fields_of(component, Field) if f.name not in inside]
    variables = [f.name for f in fields if isinstance(f, Variable | RealOutput)]
    return variables + [f"{f.name}.{f.through}" for f in fields if isinstance(f, Port)]


def _conflict(place: _Place, instances: list[Instance]) -> str:
    ends = [[(i, p) for _, p in place.ports([i]) if not p.optional] for i in instances]
    holders = [end[0] for end in ends if len(end) == 1]
    rigid = [str(i) for i, end in zip(instances, ends, strict=True) if len(end) > 1]
    if len(holders) < 2:
        return closed_loop(map(str, instances))
    yielding = _GIVES_WAY.get(holders[0][1].domain, "something that yields")
    grounds = all(isinstance(i.component, Fixed | RotationalFixed) for i, _ in holders)
    held = [_position(place.system, i) if grounds else "" for i, _ in holders]
    told = _listed(f"{i}{where}" for (i, _), where in zip(holders, held, strict=True))
    if rigid:
        return f"{told} are joined rigidly by {_listed(rigid)}; remove one, or put {yielding} between"
    node = _listed(place.node(place.number(*holders[0], "across")))
    if grounds:
        twice = "at different positions" if len(set(held)) > 1 else "twice"
        return f"{told} hold the node of {node} {twice}; remove one, or put {yielding} between"
    return f"{told} each prescribe the motion of the node of {node}; keep one, or put {yielding} between"


def closed_loop(components: Iterable[str]) -> str:
    """Tell of rigid elements that say the same of one motion."""
    return (
        f"{_listed(components)} close a rigid loop, so that one of them says what the others say already; "
        "remove one, or let one yield (a Spring)"
    )


def _position(system: System, ground: Instance) -> str:
    table = system.flat.table
    name = next(f.name for f in type(ground.component).fields.values() if isinstance(f, Parameter))
    number = table.index.get(f"{ground.path}.{name}".lstrip("."))
    if number is None:
        return ""
    return f" ({name} = {table.defaults[number]:g} {table.fields[number].unit})"


def _undetermined(place: _Place, unknowns: list[int]) -> str:
    nodes = [unknown for unknown in unknowns if place.domain(unknown)]
    if nodes:
        told = " and of ".join(_listed(place.node(unknown)) for unknown in nodes[:4])
        return (
            f"nothing determines where the node of {told} is: nothing there has inertia or is held; "
            f"join {_HAS_INERTIA.get(place.domain(nodes[0]), 'something that determines it')}"
        )
    forces = {i for i, p in place.ports(place.by_label.values()) if place.number(i, p, "through") in unknowns}
    if forces:
        return (
            f"nothing determines the forces of {_listed(sorted(map(str, forces)))}: they act on one rigid "
            "body or between held points; remove one, or let one yield (a Spring)"
        )
    return f"nothing determines {_listed(sorted(place.system.name(u) for u in unknowns))}"


def _listed(names: Iterable[str], most: int = 8) -> str:
    every = list(names)
    rest = len(every) - most
    return ", ".join(every[:most]) + (f" and {rest} more" if rest > 0 else "")
