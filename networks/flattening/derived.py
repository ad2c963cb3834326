"""Derived quantities of a network: of single elements, and summed over what a composite is made of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import casadi as ca
import numpy as np

from ...base import Symbolic
from ...components.language import KINETIC, LOSS_POWER, POTENTIAL, SUPPLY_POWER, Derived
from .equations import local_values
from .families import padded
from .flat import Flat, Instance

SUMMED = {KINETIC: "J", POTENTIAL: "J", LOSS_POWER: "W", SUPPLY_POWER: "W"}


class DerivedTable:
    """What follows from the variables of a network, by full names; computed when it is asked for.

    `SUMMED` quantities of a composite, or of the network, are the sums over the elements in it.
    """

    def __init__(self, flat: Flat) -> None:
        self.flat = flat

    def names(self) -> Iterator[str]:
        """Yield the full names of those that elements declare."""
        for instance in self.flat.instances.values():
            for name in instance.template.derived:
                yield instance.full(name)

    def declaring(self, name: str, within: str = "") -> list[Instance]:
        """Return the elements, within a composite or all, that declare a quantity."""
        inside = f"{within}." if within else ""
        found = self.flat.instances.values()
        return [i for i in found if name in i.template.derived and f"{i.path}.".startswith(inside)]

    def unit(self, path: str) -> str | None:
        """Return the unit of a quantity by its full name, None if there is none of this name."""
        owner, _, name = path.rpartition(".")
        instance = self.flat.instances.get(owner)
        if instance is None:
            return None
        field = type(instance.component).fields.get(name)
        if isinstance(field, Derived):
            return field.unit
        known = field is None and name in SUMMED and self.declaring(name, owner)
        return SUMMED[name] if known else None

    def doc(self, path: str) -> str:
        """Return what a quantity that there is stands for."""
        owner, _, name = path.rpartition(".")
        field = type(self.flat.instances[owner].component).fields.get(name)
        return field.doc if isinstance(field, Derived) else f"sum of {name} over the elements in it"

    def expression(self, path: str, variables: Any) -> Symbolic:
        """Return a quantity that there is by its full name, in terms of the joined variables."""
        owner, _, name = path.rpartition(".")
        found: Symbolic = ca.sum2(self.row(name, self.declaring(name, owner), variables))
        return found

    def row(self, name: str, instances: list[Instance], variables: Any) -> Any:
        """Return a quantity of several elements, as an SX row in their order."""
        values, wanted = padded(variables), {id(instance) for instance in instances}
        found: dict[int, Any] = {}
        for group in self.flat.groups:
            rows = np.array([row for row, i in enumerate(group) if id(i) in wanted], dtype=np.int64)
            if len(rows):
                law = group[0].template.derived[name]
                told = local_values(self.flat, group, rows, law, values)
                found |= {id(group[k]): told[n] for n, k in enumerate(rows.tolist())}
        return ca.horzcat(ca.SX(1, 0), *(found[id(instance)] for instance in instances))
