"""`Flat`: the variables and equations of a whole network, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import casadi as ca

from ...base import UnknownNameError, nearest, shown
from ...components.language import Component, ModeField, Template
from .families import Family
from .union import SignedUnion

if TYPE_CHECKING:
    from .parameters import ParameterTable


class FatalProblem(str):
    """A problem, in words, that leaves no structure to look at for more."""

    __slots__ = ()


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

    def full(self, local: str) -> str:
        """Return the full name of what is called so in it."""
        return f"{self.path}.{local}" if self.path else local

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
    problems: list[str]
    families: list[Family] = field(default_factory=list)
    modes: list[tuple[Instance, ModeField]] = field(default_factory=list)
    impulses: list[tuple[Instance, str]] = field(default_factory=list)
    mode_symbols: Any = None
    impulse_symbols: Any = None
    inputs: dict[str, int] = field(default_factory=dict)
    time: Any = field(default_factory=lambda: ca.SX.sym("time"))

    @property
    def hopeless(self) -> bool:
        """Whether a problem leaves no structure to look at."""
        return any(isinstance(problem, FatalProblem) for problem in self.problems)

    def variable(self, path: str) -> int:
        """Return the number of a variable given by its full name, or raise with the nearest one."""
        self.check_name(path)
        if self.table.field(path) is not None:
            raise UnknownNameError(
                f"'{path}' is a parameter of '{self.name}', no variable; set it by parameters="
            )
        if path.startswith("der("):
            root, sign = self.joined.find(self.variable(path[4:-1]))
            if root in self.joined.derivative and sign > 0:
                return self.joined.derivative[root]
        for instance, local in self.owners(path):
            if local in instance.template.variables:
                return instance.index(local)
        known = [*self.names(), *self.table.index]
        raise UnknownNameError(f"'{self.name}' has no variable '{path}'{nearest(path, known)}")

    def owners(self, path: str) -> Iterator[tuple[Instance, str]]:
        """Yield the components that a full name leads through, innermost first, and the name in each."""
        pieces = path.split(".")
        for cut in range(len(pieces) - 1, -1, -1):
            instance = self.instances.get(".".join(pieces[:cut]))
            if instance is not None:
                yield instance, ".".join(pieces[cut:])

    def check_name(self, path: str) -> None:
        """Raise an UnknownNameError for what is no name at all."""
        if not isinstance(path, str):
            raise UnknownNameError(
                f"'{self.name}': variables are asked for by full names, such as 'mass.s', got {shown(path)}"
            )

    def names(self) -> Iterator[str]:
        """Yield the full names of all variables."""
        for instance in self.instances.values():
            for local in instance.template.variables:
                if not local.startswith("der("):
                    yield instance.full(local)
