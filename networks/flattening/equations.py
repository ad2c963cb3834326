"""Equations: the families of residuals of components and of nodes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

import casadi as ca
import numpy as np

from ...base import Ints
from .connections import Node
from .families import Family, sum_family
from .flat import Flat, Instance
from .forms import Form
from .vectors import column, pick


def local_arguments(flat: Flat, group: list[Instance]) -> tuple[Any, Any]:
    """Return what a template takes as given, as symbols (k,) and as arguments (k, instances)."""
    template = group[0].template
    mode_of = {(id(i), m.name): k for k, (i, m) in enumerate(flat.modes)}
    impulse_of = {(id(i), name): k for k, (i, name) in enumerate(flat.impulses)}
    discrete = [flat.mode_symbols[[mode_of[id(i), name] for i in group]].T for name in template.modes]
    discrete += [
        flat.impulse_symbols[[impulse_of[id(i), name] for i in group]].T for name in template.impulses
    ]
    parameters = flat.table.matrix(group)
    arguments = ca.vertcat(parameters, *discrete) if discrete else parameters
    symbols = [*template.parameters.values(), *template.modes.values(), *template.impulses.values()]
    return column(symbols), arguments


def local_values(flat: Flat, group: list[Instance], rows: Ints, expression: Any, values: Any) -> Any:
    """Return an expression of local symbols for some of like instances, as SX columns.

    `values` are all joined variables as `padded` returns them.
    """
    template = group[0].template
    locals_ = ca.vertcat(*template.variables.values())
    size, chosen = locals_.numel(), [group[row] for row in rows.tolist()]
    found = np.array([flat.joined.find(i.base + k) for i in chosen for k in range(size)])
    columns, signs = (found[:, k].reshape(len(chosen), size) for k in (0, 1))
    given, arguments = local_arguments(flat, chosen)
    form = Form(ca.SX(0), locals_, given, time=template.time)
    family = Family(form, columns, signs, arguments, str)
    return family.evaluate(expression, np.arange(len(chosen)), values, flat.time)


def _label(members: Sequence[Instance | Node]) -> Callable[[int], str]:
    return lambda row: str(members[row])


def component_families(flat: Flat) -> None:
    """Add the equations of all components, one family for each equation of a class."""
    for group in flat.groups:
        template = group[0].template
        if not template.residuals:
            continue
        modes = column([*template.modes.values()])
        given, arguments = local_arguments(flat, group)
        bases = np.array([i.base for i in group], dtype=np.int64)[:, None]
        for residual, slopes in zip(template.residuals, template.slopes, strict=True):
            locals_ = pick(template.symbols, [*slopes])
            columns = bases + np.array([*slopes], dtype=np.int64)[None, :]
            form = Form(residual, locals_, given, modes, template.time, [*slopes.values()])
            family = Family(form, columns, np.ones_like(columns), arguments, _label(group))
            flat.families.append(family)


def node_families(flat: Flat, nodes: list[Node]) -> None:
    """State that through variables sum to zero; two of them are equal and opposite at once."""
    sums: dict[int, list[tuple[list[int], list[int], Node]]] = defaultdict(list)
    for node in nodes:
        ending = node.ending("through")
        if not ending:
            continue
        numbers = [i.index(name + ending) for i, name, _ in node.ports]
        signs = [sign for *_, sign in node.ports]
        if len(numbers) == 2:
            flat.joined.join(numbers[0], numbers[1], -signs[0] * signs[1])
            continue
        sums[len(numbers)].append((numbers, signs, node))
    for members in sums.values():
        numbers_, signs_, summed = zip(*members, strict=True)
        flat.families.append(sum_family(numbers_, signs_, _label(summed)))


def zero_family(flat: Flat, variables: Sequence[int] | Sequence[tuple[int, int]], label: str) -> None:
    """State that variables, or sums of two, are zero."""
    if variables:
        columns = np.reshape(variables, (len(variables), -1))
        flat.families.append(sum_family(columns, np.ones_like(columns), lambda _: label))
