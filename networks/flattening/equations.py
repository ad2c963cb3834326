"""Equations: the families of residuals of components and of nodes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

import casadi as ca
import numpy as np

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
    modes = [[mode_of[id(i), name] for i in group] for name in template.modes]
    impulses = [[impulse_of[id(i), name] for i in group] for name in template.impulses]
    discrete = [
        *[flat.mode_symbols[row].T for row in modes],
        *[flat.impulse_symbols[row].T for row in impulses],
    ]
    parameters = flat.table.matrix(group)
    arguments = ca.vertcat(parameters, *discrete) if discrete else parameters
    symbols = [*template.parameters.values(), *template.modes.values(), *template.impulses.values()]
    return column(symbols), arguments


def _label(group: list[Instance]) -> Callable[[int], str]:
    return lambda row: str(group[row])


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
            flat.families.append(
                Family(
                    Form(residual, locals_, given, modes, template.time, [*slopes.values()]),
                    columns,
                    np.ones_like(columns),
                    arguments,
                    _label(group),
                )
            )


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
        flat.families.append(sum_family(numbers_, signs_, _node_label(summed)))


def _node_label(nodes: Sequence[Node]) -> Callable[[int], str]:
    def label(row: int) -> str:
        ports = nodes[row].ports
        return "node of " + ", ".join(f"{i.path}.{name}".lstrip(".") for i, name, _ in ports)

    return label


def zero_family(flat: Flat, variables: list[int], label: str) -> None:
    """State that variables are zero."""
    if variables:
        columns = [[v] for v in variables]
        flat.families.append(sum_family(columns, [[1] for _ in variables], lambda _: label))


def open_family(flat: Flat, loose: list[tuple[int, int]]) -> None:
    """Let loose flanges meet something that neither holds nor drives them, to look for more faults."""
    if loose:
        flat.families.append(sum_family(loose, [[1, 1] for _ in loose], lambda _: "loose flange"))
