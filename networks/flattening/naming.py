"""Names, units and start values of joined variables, taken from their declarations."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np

from ...base import Ints
from ...components.language import Port, Variable
from .flat import Flat, Instance

_STATE = {"prefer": 1, "default": 0, "avoid": -1}


@dataclass(frozen=True, eq=False)
class Local:
    """What a template says of one local variable."""

    unit: str
    doc: str
    rank: int
    start: float = 0.0
    nominal: float = np.nan
    state: int = -1


def _facts(instance: Instance, name: str) -> Local:
    """Return what is declared of a local variable."""
    head, _, tail = name.partition(".")
    declared = type(instance.component).fields.get(head)
    if isinstance(declared, Variable):
        state = _STATE[declared.state]
        return Local(declared.unit, declared.doc, 4 + state, declared.start, declared.nominal, state)
    if isinstance(declared, Port):
        unit = declared.units[0] if tail == declared.across else declared.units[1]
        return Local(unit, f"{tail} of {head}", 1)
    if declared is not None:
        return Local(declared.unit, declared.doc, 2)
    return Local("", name, 0)


class Names:
    """The best name of every joined variable and what is declared of it."""

    def __init__(self, flat: Flat, roots: Ints, signs: Ints) -> None:
        self.roots = roots
        self.instances: list[Instance] = []
        self.facts: list[Local] = []
        columns = []
        for group in flat.groups:
            local = [_facts(group[0], name) for name in group[0].template.variables]
            self.instances += group
            self.facts += local * len(group)
            numbers = np.array([(f.rank, f.state, f.start, f.nominal) for f in local]).reshape(-1, 4)
            columns.append(np.tile(numbers.T, len(group)))
        rank, state, start, nominal = np.hstack(columns)
        count = len(self.facts)
        order = np.lexsort((-rank, roots[:count]))
        of, first = np.unique(roots[order], return_index=True)
        self.best = dict(zip(of.tolist(), order[first].tolist(), strict=True))
        self.state = np.full(len(roots), -1)
        self.state[of] = np.maximum.reduceat(state[order], first)
        self.nominal = np.ones(len(roots))
        least = np.fmin.reduceat(nominal[order], first)
        self.nominal[of] = np.where(np.isnan(least), 1.0, least)
        given = np.flatnonzero(start)
        self.start = np.zeros(len(roots))
        self.start[roots[given]] = start[given] * signs[given]

    def full_name(self, number: int) -> str:
        """Return the full name of a variable of the flat network."""
        instance = self.instances[bisect_right(self.instances, number, key=lambda i: i.base) - 1]
        name = list(instance.template.variables)[number - instance.base]
        return f"der({instance.full(name[4:-1])})" if name.startswith("der(") else instance.full(name)

    def name(self, root: int, derivative: dict[int, tuple[int, int]]) -> str:
        """Return the best name of a joined variable."""
        if root in self.best:
            return self.full_name(self.best[root])
        for lower, (upper, _) in derivative.items():
            if upper == root:
                return f"der({self.name(lower, derivative)})"
        return f"variable {root}"

    def unit(self, root: int) -> str:
        """Return the unit of a joined variable, empty if it is not declared."""
        return self.facts[self.best[root]].unit if root in self.best else ""
