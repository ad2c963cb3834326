"""Flatten: from a tree of components to one set of variables and families of equations.

Paths, templates and connections become integers here; equal variables are joined before any
symbolic work, so the cost is linear in the number of elements.
"""

from __future__ import annotations

import traceback
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import casadi as ca

from ...base import ModelError
from ...components.language import Component, Template, declared_template, parts_of, template_of
from .connections import connect_ports, find_inputs
from .equations import component_families, node_families, zero_family
from .flat import FatalProblem, Flat, Instance
from .parameters import ParameterTable
from .union import SignedUnion


def flatten(network: Component) -> Flat:
    """Return the network's variables and equations, equal variables joined.

    `Flat.problems` lists what is wrong with values and connections by component path.

    Raises:
        ModelError: with these problems, if they leave no structure to look at.
    """
    name = getattr(network, "name", type(network).__name__)
    problems: list[str] = []
    instances = {i.path: i for i in _walk(network, "", None, problems, {})}
    if len(instances) == 1 and not instances[""].template.variables:
        problems.append(FatalProblem("it has no components; give some to Network(...) or add()"))
    groups = _grouped(instances)
    size = sum(len(group) * len(group[0].template.variables) for group in groups)
    flat = Flat(name, instances, groups, SignedUnion(size), ParameterTable(instances, problems), problems)
    _collect_modes(flat)
    nodes, unconnected = connect_ports(flat)
    if flat.hopeless or any(i.component._shapeless for i in instances.values()):
        raise ModelError(f"'{name}' cannot be assembled:", problems)
    _join_aliases(flat)
    find_inputs(flat, nodes)
    component_families(flat)
    node_families(flat, nodes)
    for label, variables in {**unconnected, "contradiction": flat.joined.contradictions}.items():
        zero_family(flat, variables, label)
    return flat


def _walk(
    component: Component, path: str, parent: Instance | None, problems: list[str], seen: dict[int, str]
) -> Iterator[Instance]:
    if id(component) in seen:
        told = f"{type(component).__name__} '{path}' is the same object as '{seen[id(component)]}'"
        problems.append(FatalProblem(f"{told}; give each place its own (`.clone()`)"))
        return
    seen[id(component)] = path
    instance = Instance(path, component, parent, _template(component, path, problems))
    problems += [f"{instance}: {problem}" for problem in component.problems()]
    yield instance
    for name, part in parts_of(component).items():
        yield from _walk(part, instance.full(name), instance, problems, seen)


def _template(component: Component, path: str, problems: list[str]) -> Template:
    if not component._shapeless:
        try:
            return template_of(component)
        except ModelError as error:
            told = str(error)
        except Exception as error:
            told = f"its equations cannot be read: {_told(error)}"
        problems.append(FatalProblem(f"{type(component).__name__} '{path}': {told}"))
    return declared_template(component)


def _told(error: Exception) -> str:
    """Say what went wrong in a component's own lines, and where."""
    frames = traceback.extract_tb(error.__traceback__)
    place = next(
        (f for f in reversed(frames) if Path(f.filename).name not in ("casadi.py", "quiet.py")), frames[-1]
    )
    what = f"{type(error).__name__}: {error}"
    if "truth value" in what:
        what = "Python decides here by a symbol; write ca.if_else, ca.logic_and, ca.fmin or ca.fmax"
    return f"{what} ({place.name}(), line {place.lineno} of {Path(place.filename).name})"


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
        for name in instance.template.modes:
            flat.modes.append((instance, type(instance.component).fields[name]))  # type: ignore[arg-type]
        flat.impulses.extend((instance, name) for name in instance.template.impulses)
    flat.mode_symbols = ca.SX.sym("mode", len(flat.modes))
    flat.impulse_symbols = ca.SX.sym("impulse", len(flat.impulses))


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
            if parts_of(instance.component):
                _join_used_parts(flat, instance)


def _join_used_parts(flat: Flat, instance: Instance) -> None:
    """Tie the symbols by which equations use variables of parts to the parts' own."""
    for local in instance.template.variables:
        head = local.split(".")[0]
        if head in parts_of(instance.component) and not local.startswith("der("):
            owner, rest = next(flat.owners(instance.full(local)))
            flat.joined.join(instance.index(local), owner.index(rest))
