"""`DAE`: the equations of a network, the one thing everything below reads."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ..base import Symbolic, UnknownNameError, nearest, number, rate_unit, shown, text
from ..components.language import Parameter, Variable
from .flattening.derived import DerivedTable
from .flattening.vectors import stacked

if TYPE_CHECKING:
    from .flattening.flat import Flat
    from .flattening.naming import Names
    from .flattening.parameters import ParameterTable
    from .reduction.jumps import Jumps
    from .reduction.tearing import Torn
    from .reduction.transitions import Switching


@dataclass(frozen=True)
class Input:
    """An external signal, or one of its time derivatives (`order`); the symbol in u is `sign` times it."""

    path: str
    order: int
    sign: int
    unit: str
    signal: Any
    variable: int


@dataclass(frozen=True, eq=False)
class DAE:
    """Semi-explicit equations of index 1 with modes, in CasADi SX.

        x' = ode(x, z, u, p, modes, t),   0 = alg(x, z, u, p, modes, t)

    Attributes:
        x: states; z: algebraic unknowns; u: inputs and their derivatives; p: parameters.
        modes: discrete modes, constant between events.
        impulses: zero except inside a shock.
        completion: makes blocks that a mode leaves singular solvable (least norm), else zero.
        variables: every joined variable as an expression of the above.
        switching: the transitions between modes.
        flat: the components in their places, and which variables are joined.
        parameters: every parameter with its declaration, value and symbol.
        declared: name, unit, nominal and start value of every joined variable.
        derivative: by joined variable its derivative, and the sign of that.
        jumps: the equations while signals jump whose derivatives they hold, if there are any.
        bindings: what runs have compiled, by the signals they were given.
        timed: what its equations hold that depends on time alone, by the inputs that are given.
    """

    name: str
    x: Symbolic
    z: Symbolic
    u: Symbolic
    p: Symbolic
    modes: Symbolic
    impulses: Symbolic
    completion: Symbolic
    time: Symbolic
    ode: Symbolic
    alg: Symbolic
    inputs: list[Input]
    states: list[int]
    algebraic: list[int]
    blocks: list[Torn]
    switching: Switching
    variables: Symbolic
    flat: Flat
    parameters: ParameterTable
    declared: Names
    derivative: dict[int, tuple[int, int]]
    jumps: Jumps | None = None
    bindings: dict[Any, Any] = field(default_factory=dict)
    timed: dict[Any, Any] = field(default_factory=dict)

    @cached_property
    def state_names(self) -> list[str]:
        """Full names of the states."""
        return [self.name_of(v) for v in self.states]

    def name_of(self, variable: int) -> str:
        """Return the best name of a joined variable, given by its number.

        Raises:
            UnknownNameError: for a number of none.
        """
        if number(variable) or variable not in range(self.variables.numel()):
            raise UnknownNameError(f"'{self.name}' has no variable of number {shown(variable)}")
        return self.declared.name(variable, self.derivative)

    @property
    def input_names(self) -> list[str]:
        """Full names of the external inputs."""
        return [i.path for i in self.inputs if i.order == 0]

    @property
    def parameter_values(self) -> dict[str, float]:
        """Every parameter that can be set, with its value."""
        return dict(zip(self.parameters.index, self.parameters.defaults, strict=True))

    @property
    def hybrid(self) -> bool:
        """Whether there are modes to switch."""
        return bool(self.switching.changes)

    @cached_property
    def followed(self) -> dict[int, tuple[int, int]]:
        """By variable that starts where an input does: that input, and its sign against the variable."""
        flat, found = self.flat, dict[int, tuple[int, int]]()
        for group in flat.groups:
            for name, declared in type(group[0].component).fields.items():
                leader = declared.follows if isinstance(declared, Variable) else ""
                for instance in group if leader and name in group[0].template.place else ():
                    (root, sign), (led, other) = (flat.joined.find(instance.index(n)) for n in (name, leader))
                    if root != led:
                        found[root] = led, sign * other
        return found

    @cached_property
    def derived(self) -> DerivedTable:
        """What follows from the variables: energies, losses and what else elements declare so."""
        return DerivedTable(self.flat)

    def names(self) -> Iterable[str]:
        """Yield the full names of all variables."""
        return self.flat.names()

    def expression(self, path: str) -> Symbolic:
        """Return a variable, a mode, a parameter, a derived quantity or `der(...)` of a variable as SX.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.flat.check_name(path)
        if path == "time":
            return self.time
        if path in self.switching.mode_names:
            return self.modes[self.switching.mode_names.index(path)]
        parameter = self.parameters.at(path)
        if parameter is not None:
            return parameter
        if self.derived.unit(path) is not None:
            return self.derived.expression(path, self.variables)
        root, sign = self.root(path)
        return self.variables[root] * sign

    def root(self, path: str) -> tuple[int, int]:
        """Return the joined variable behind a name, and the sign against it.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        flat = self.flat
        if not text(path) and path.startswith("der("):
            root, sign = self.root(path[4:-1])
            upper = self.derivative.get(root)
            if upper is None:
                raise UnknownNameError(f"'{self.name}' has no variable '{path}'")
            return upper[0], sign * upper[1]
        return flat.joined.find(flat.variable(path))

    def unit(self, path: str) -> str:
        """Return the unit of a variable, parameter or derived quantity, empty if it has none.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.flat.check_name(path)
        declared = self.parameters.field(path)
        if declared is not None:
            return declared.unit
        if path == "time":
            return "s"
        if path in self.switching.mode_names:
            return ""
        if path.startswith("der("):
            return rate_unit(self.unit(path[4:-1]))
        derived = self.derived.unit(path)
        if derived is not None:
            return derived
        return self.declared.facts[self.flat.variable(path)].unit

    def field(self, path: str) -> Parameter:
        """Return the declaration of a parameter.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.flat.check_name(path)
        table = self.parameters
        if path not in self.parameter_values:
            told = nearest(str(path), table.index)
            raise UnknownNameError(f"'{self.name}' has no parameter '{path}' that can be set{told}")
        return table.fields[table.index[path]]

    def arguments(self) -> list[Symbolic]:
        """Return the symbols every expression depends on: x, z, u, q, time."""
        return [self.x, self.z, self.u, self.constants, self.time]

    @cached_property
    def constants(self) -> Symbolic:
        """All that is constant within a segment: p, modes, impulses, completion."""
        return stacked(self.p, self.modes, self.impulses, self.completion)
