"""`Template`: the equations of one component class in its own local symbols."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import casadi as ca

from .component import Component
from .pieces import slopes_of


@dataclass(frozen=True)
class Shock:
    """An impulse that sets a velocity at once: (impulse, velocity, velocity afterwards)."""

    impulse: Any
    velocity: Any
    after: Any


@dataclass(frozen=True)
class Transition:
    """A change of mode that happens when `indicator` rises above zero."""

    mode: str
    source: int
    target: int
    indicator: Any
    allowed: Any = None
    reset: dict[str, Any] = field(default_factory=dict)
    shock: Shock | None = None


@dataclass
class Template:
    """The equations of one component class in its own local symbols."""

    owner: type[Component]
    variables: dict[str, Any] = field(default_factory=dict)
    derivatives: dict[str, str] = field(default_factory=dict)
    parameters: dict[str, Any] = field(default_factory=dict)
    modes: dict[str, Any] = field(default_factory=dict)
    impulses: dict[str, Any] = field(default_factory=dict)
    time: Any = field(default_factory=lambda: ca.SX.sym("time"))
    residuals: list[Any] = field(default_factory=list)
    aliases: list[tuple[str, str, int]] = field(default_factory=list)
    transitions: list[Transition] = field(default_factory=list)
    choices: list[tuple[Any, str, dict[int, Any]]] = field(default_factory=list)
    held: list[tuple[str, str, int]] = field(default_factory=list)
    derived: dict[str, Any] = field(default_factory=dict)

    @cached_property
    def place(self) -> dict[str, int]:
        """Number of each variable by name; asked for once the equations are read."""
        return {name: number for number, name in enumerate(self.variables)}

    @cached_property
    def symbols(self) -> Any:
        """The variables as one vector; asked for once the equations are read."""
        return ca.vertcat(*self.variables.values())

    @cached_property
    def slopes(self) -> list[dict[int, Any]]:
        """Slopes of each residual, by number of the variable; asked for once the equations are read."""
        slopes: list[dict[int, Any]] = [{} for _ in self.residuals]
        if slopes:
            column = ca.vertcat(*self.residuals)
            matrix = slopes_of(column, self.symbols)
            for row, number in zip(*ca.jacobian_sparsity(column, self.symbols).get_triplet(), strict=True):
                slopes[row][number] = matrix[row, number]
        return slopes

    def variable(self, name: str) -> Any:
        """Return the symbol of a variable, made when it is first asked for."""
        if name not in self.variables:
            self.variables[name] = ca.SX.sym(name)
        return self.variables[name]

    def derivative(self, name: str) -> Any:
        """Return the symbol of a variable's time derivative."""
        self.derivatives[name] = f"der({name})"
        return self.variable(self.derivatives[name])

    def name_of(self, symbol: Any) -> str | None:
        """Return the local name of a symbol, or None if it is no variable."""
        name = symbol.name() if isinstance(symbol, ca.SX) and symbol.is_symbolic() else ""
        known = self.variables.get(name)
        return name if known is not None and known.element_hash() == symbol.element_hash() else None
