"""Index reduction: differentiate the equations that constrain states.

The equations that Pantelides' algorithm would differentiate are the over-determined part of the
Dulmage-Mendelsohn decomposition of the highest derivatives' incidence, taken again until it is empty.
Source: C. Pantelides, SIAM J. Sci. Stat. Comput. 9 (1988) 213-231.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from ..components.base import ModelError
from .families import Family, Ints, sum_family
from .flatten import Flat
from .naming import Names


@dataclass(eq=False)
class System:
    """Equations in joined variables; derivatives of variables and of equations are linked."""

    flat: Flat
    names: Names
    families: list[Family]
    derivative: dict[int, tuple[int, int]]
    known: dict[int, tuple[str, int]]
    size: int
    held: dict[int, list[Any]] = field(default_factory=dict)
    next_level: list[dict[int, tuple[int, int]]] = field(default_factory=list)
    level: list[int] = field(default_factory=list)

    def derivative_of(self, variable: int) -> tuple[int, int]:
        """Return a variable's derivative and its sign, made when there is none yet."""
        if variable not in self.derivative:
            self.derivative[variable] = (self.size, 1)
            if variable in self.known:
                name, order = self.known[variable]
                self.known[self.size] = (name, order + 1)
            self.size += 1
        return self.derivative[variable]

    def equations(self) -> Iterator[tuple[int, int]]:
        """Yield (family, row) of every equation."""
        for number, family in enumerate(self.families):
            for row in range(len(family)):
                yield number, row

    def name(self, variable: int) -> str:
        """Return the full name of a variable."""
        return self.names.name(variable, self.derivative)

    def label(self, equation: tuple[int, int]) -> str:
        """Name the component an equation comes from."""
        return self.families[equation[0]].label(equation[1])


def joined_system(flat: Flat) -> System:
    """Write the flat equations in joined variables."""
    roots, signs = flat.joined.arrays()
    for family in flat.families:
        family.signs = family.signs * signs[family.columns]
        family.columns = roots[family.columns]
    derivative = {
        root: (int(roots[d]), int(signs[d])) for root, d in flat.joined.derivative.items()
    }
    known: dict[int, tuple[str, int]] = {}
    clashes = []
    for path, number in flat.inputs.items():
        root, order = int(roots[number]), 0
        if root in known:
            clashes.append(f"'{path}' and '{known[root][0]}' prescribe the same quantity; keep one")
        while root not in known:
            known[root] = (path, order)
            if root not in derivative:
                break
            root, order = derivative[root][0], order + 1
    if clashes:
        raise ModelError(f"'{flat.name}' has two rigid sources at one node:", clashes)
    names = Names(flat, roots, signs)
    system = System(flat, names, [f for f in flat.families if len(f)], derivative, known, len(roots))
    system.held = _held(flat, roots)
    _cut_cycles(system)
    system.next_level = [{} for _ in system.families]
    system.level = [0] * len(system.families)
    return system


def _held(flat: Flat, roots: Ints) -> dict[int, list[Any]]:
    """Return the conditions under which variables are exactly zero."""
    conditions: dict[int, list[Any]] = {}
    for number, (instance, mode) in enumerate(flat.modes):
        for variable, name, value in instance.template.held:
            if name == mode.name:
                root = int(roots[instance.index(variable)])
                conditions.setdefault(root, []).append(flat.mode_symbols[number] == value)
    return conditions


def _cut_cycles(system: System) -> None:
    """Give der(x) a name of its own where equal variables make x one of its own derivatives."""
    done: set[int] = set()
    for start in list(system.derivative):
        chain: list[int] = []
        variable = start
        while variable in system.derivative and variable not in done:
            done.add(variable)
            chain.append(variable)
            variable, sign = system.derivative[variable]
        if variable in chain:
            rate = system.size
            system.size += 1
            system.derivative[chain[-1]] = (rate, 1)
            system.families.append(sum_family([[rate, variable]], [[1, -sign]], "derivative"))


def reduce_index(system: System) -> None:
    """Differentiate equations until the highest derivatives can be solved for."""
    while True:
        tops = [
            (number, np.array([r for r in range(len(f)) if r not in later], dtype=np.int64))
            for number, (f, later) in enumerate(
                zip(system.families, system.next_level, strict=True)
            )
        ]
        rows, columns, owners = _incidence(system, tops)
        size = int(columns.max()) + 1 if len(columns) else 0
        pattern = ca.Sparsity.triplet(len(owners), size, rows.tolist(), columns.tolist())
        _, order, _, _, _, coarse, _ = pattern.btf()
        over = [owners[i] for i in order[: coarse[2]]]
        if not over:
            return
        by_family: dict[int, list[int]] = {}
        for number, row in over:
            by_family.setdefault(number, []).append(row)
        for number, chosen in by_family.items():
            _differentiate(system, number, np.array(sorted(chosen), dtype=np.int64))


def _differentiate(system: System, number: int, rows: Ints) -> None:
    family = system.families[number].differentiated(rows, system.derivative_of)
    later = len(system.families)
    system.families.append(family)
    system.next_level.append({})
    system.level.append(system.level[number] + 1)
    for place, row in enumerate(rows):
        system.next_level[number][int(row)] = (later, place)


def _incidence(
    system: System, tops: list[tuple[int, Ints]]
) -> tuple[Ints, Ints, list[tuple[int, int]]]:
    """Return where the highest derivatives stand in the highest-level equations."""
    highest = np.ones(system.size, dtype=bool)
    highest[[v for v in system.derivative]] = False
    highest[[v for v in system.known]] = False
    numbers = np.cumsum(highest) - 1
    rows, columns, owners = [], [], []
    for number, chosen in tops:
        cells = system.families[number].columns[chosen]
        start = len(owners)
        owners += [(number, int(row)) for row in chosen]
        r, c = np.nonzero(highest[cells]) if cells.size else (np.array([], int), np.array([], int))
        rows.append(r + start)
        columns.append(numbers[cells[r, c]])
    return (
        np.concatenate(rows).astype(np.int64),
        np.concatenate(columns).astype(np.int64),
        owners,
    )
