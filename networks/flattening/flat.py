"""`Flat`: the variables and equations of a whole network, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import casadi as ca

from ...base import UnknownNameError, nearest, shown
from ...components.language import Component, ModeField, Template
from .families import Family
from .parameters import ParameterTable
from .union import SignedUnion


@dataclass(eq=False, slots=True)
class Instance:
    """One component in its place.

    Attributes:
        base: number of its first variable.
        row: which of the components of its kind it is.
        given: numbers of its parameters, negative for those that follow from others.
    """

    path: str
    component: Component
    parent: Instance | None
    template: Template
    base: int = 0
    row: int = 0
    given: list[int] = field(default_factory=list)

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
    problems: list[str] = field(default_factory=list)
    families: list[Family] = field(default_factory=list)
    modes: list[tuple[Instance, ModeField]] = field(default_factory=list)
    impulses: list[tuple[Instance, str]] = field(default_factory=list)
    mode_symbols: Any = None
    impulse_symbols: Any = None
    inputs: dict[str, int] = field(default_factory=dict)
    time: Any = field(default_factory=lambda: ca.SX.sym("time"))

    def variable(self, path: str) -> int:
        """Return the number of a variable given by its full name, or raise with the nearest one."""
        self.check_name(path)
        if self.table.field(path) is not None:
            raise UnknownNameError(
                f"'{path}' is a parameter of '{self.name}', no variable; set it by parameters="
            )
        inner = path.removeprefix("der(").removesuffix(")") if path.startswith("der(") else path
        pieces = inner.split(".")
        for cut in range(len(pieces) - 1, -1, -1):
            instance = self.instances.get(".".join(pieces[:cut]))
            local = ".".join(pieces[cut:])
            if instance is not None and local in instance.template.variables:
                index = instance.index(local)
                return index if inner is path else self.derivative_of(path, index)
        known = [*self.names(), *self.table.index]
        raise UnknownNameError(f"'{self.name}' has no variable '{path}'{nearest(path, known)}")

    def check_name(self, path: str) -> None:
        """Raise an UnknownNameError for what is no name at all."""
        if not isinstance(path, str):
            raise UnknownNameError(
                f"'{self.name}': variables are asked for by full names, such as 'mass.s', got {shown(path)}"
            )

    def derivative_of(self, path: str, index: int) -> int:
        """Return the number of a variable's derivative, for a name like der(mass.v)."""
        root, sign = self.joined.find(index)
        known = self.joined.derivative.get(root)
        if known is None or sign < 0:
            raise UnknownNameError(f"'{self.name}' has no variable '{path}'")
        return known

    def names(self) -> Iterator[str]:
        """Yield the full names of all variables."""
        for instance in self.instances.values():
            prefix = instance.path + "." if instance.path else ""
            for local in instance.template.variables:
                if not local.startswith("der("):
                    yield prefix + local
