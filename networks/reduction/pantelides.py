"""Index reduction: differentiate the equations that constrain states.

The equations that Pantelides' algorithm would differentiate are the over-determined part of the
Dulmage-Mendelsohn decomposition of the highest derivatives' incidence, taken again until it is empty.
Source: C. Pantelides, SIAM J. Sci. Stat. Comput. 9 (1988) 213-231.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from ...base import Flags, Ints, ModelError
from ..flattening.families import Family, sum_family, without_duplicates
from ..flattening.flat import Flat
from ..flattening.naming import Names

Equation = tuple[int, int]  # family and row


@dataclass(eq=False)
class System:
    """Equations in joined variables; derivatives of variables and of equations are linked."""

    flat: Flat
    names: Names
    families: list[Family]
    derivative: dict[int, tuple[int, int]]
    known: dict[int, tuple[str, int, int]]
    size: int
    held: dict[int, list[Any]] = field(default_factory=dict)
    next_level: list[dict[int, Equation]] = field(default_factory=list)
    level: list[int] = field(default_factory=list)

    @property
    def calls(self) -> bool:
        """Whether equations call functions."""
        return any(family.form.calls for family in self.families)

    def derivative_of(self, variable: int) -> tuple[int, int]:
        """Return a variable's derivative and its sign, made when there is none yet."""
        if variable not in self.derivative:
            self.derivative[variable] = (self.size, 1)
            if variable in self.known:
                name, order, sign = self.known[variable]
                self.known[self.size] = (name, order + 1, sign)
            self.size += 1
        return self.derivative[variable]

    def is_root(self) -> Flags:
        """Tell which numbers stand for variables; the others are joined to one of these."""
        root = np.ones(self.size, dtype=bool)
        own = self.names.roots
        root[: len(own)] = own == np.arange(len(own))
        return root

    def highest(self) -> Flags:
        """Tell which variables are unknown and have no derivative."""
        highest = self.is_root()
        highest[[*self.derivative, *self.known]] = False
        return highest

    def bases(self) -> Ints:
        """Return, for every variable, the one it is a derivative of."""
        lower = np.arange(self.size)
        for variable, (upper, _) in self.derivative.items():
            lower[upper] = variable
        while (lower[lower] != lower).any():
            lower = lower[lower]
        return lower

    def equations(self) -> list[Equation]:
        """Return every equation, in the order of their numbers."""
        return [(n, row) for n, family in enumerate(self.families) for row in range(len(family))]

    def family_starts(self) -> Ints:
        """Return the number of each family's first equation, and how many there are in all."""
        return np.cumsum([0, *map(len, self.families)], dtype=np.int64)

    def incidence(self, number: Ints, chosen: Flags | None = None) -> Any:
        """Return which equations hold which variables, as a sparsity (equations, variables).

        Args:
            number: what each variable is counted as, negative if it is left out.
            chosen: which equations count; all if not given.
        """
        starts = self.family_starts()
        row_of = np.arange(starts[-1]) if chosen is None else counted(chosen)
        rows, columns = list[int](), list[int]()
        for family, start in zip(self.families, starts.tolist(), strict=False):
            held = number[family.columns]
            row = row_of[start : start + len(family), None]
            r, c = np.nonzero((held >= 0) & (row >= 0))
            rows += row[r, 0].tolist()
            columns += held[r, c].tolist()
        return ca.Sparsity.triplet(
            int(row_of.max(initial=-1)) + 1, int(number.max(initial=-1)) + 1, rows, columns
        )

    def residual(self, equation: Equation, values: Any) -> Any:
        """Return the residual of an equation; `values` are all variables, as `padded` returns them."""
        number, row = equation
        family = self.families[number]
        return family.evaluate(family.form.residual, np.array([row]), values, self.flat.time)

    def name(self, variable: int) -> str:
        """Return the full name of a variable."""
        return self.names.name(variable, self.derivative)

    def label(self, equation: Equation) -> str:
        """Name the component an equation comes from."""
        return self.families[equation[0]].label(equation[1])


def joined_system(flat: Flat) -> System:
    """Write the flat equations in joined variables."""
    roots, signs = flat.joined.arrays()
    for family in flat.families:
        family.signs = family.signs * signs[family.columns]
        family.columns = roots[family.columns]
    derivative = {root: (int(roots[d]), int(signs[d])) for root, d in flat.joined.derivative.items()}
    known: dict[int, tuple[str, int, int]] = {}
    clashes = []
    for path, number in flat.inputs.items():
        root, order, sign = int(roots[number]), 0, int(signs[number])
        if root in known:
            clashes.append(
                f"'{path}' and '{known[root][0]}' prescribe one quantity: nothing lies between them; keep "
                "one, or put a Mass between forces, a Spring between motions"
            )
        while root not in known:
            known[root] = (path, order, sign)
            if root not in derivative:
                break
            root, order, sign = derivative[root][0], order + 1, sign * derivative[root][1]
    if clashes:
        raise ModelError(f"'{flat.name}' is over-determined:", clashes)
    names = Names(flat, roots, signs)
    families = [part for family in flat.families if len(family) for part in without_duplicates(family)]
    system = System(flat, names, families, derivative, known, len(roots))
    rates = {upper for upper, _ in derivative.values()}
    system.held = {v: c for v, c in _held(flat, roots).items() if v in rates}
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
        variable, sign = start, 1
        while variable in system.derivative and variable not in done:
            done.add(variable)
            chain.append(variable)
            variable, sign = system.derivative[variable]
        if variable in chain:
            rate = system.size
            system.size += 1
            system.derivative[chain[-1]] = (rate, 1)
            system.families.append(sum_family([[rate, variable]], [[1, -sign]], lambda _: "derivative"))


def reduce_index(system: System) -> None:
    """Differentiate equations until the highest derivatives can be solved for."""
    while True:
        starts = system.family_starts()
        top = np.ones(starts[-1], dtype=bool)
        for start, later in zip(starts.tolist(), system.next_level, strict=False):
            top[[start + row for row in later]] = False
        _, order, _, _, _, coarse, _ = system.incidence(counted(system.highest()), top).btf()
        over = np.sort(np.flatnonzero(top)[list(order[: coarse[2]])])
        if not len(over):
            return
        family_of = np.searchsorted(starts, over, side="right") - 1
        for number in sorted(set(family_of.tolist())):
            _differentiate(system, number, over[family_of == number] - starts[number])


def counted(chosen: Flags) -> Ints:
    """Number the chosen ones from zero; -1 for the others."""
    return np.where(chosen, np.cumsum(chosen) - 1, -1)


def _differentiate(system: System, number: int, rows: Ints) -> None:
    family = system.families[number].differentiated(rows, system.derivative_of)
    later = len(system.families)
    system.families.append(family)
    system.next_level.append({})
    system.level.append(system.level[number] + 1)
    system.next_level[number] |= {row: (later, place) for place, row in enumerate(rows.tolist())}
