"""`DAE`: the equations of a network, the one thing everything below reads."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from threading import get_ident
from typing import TYPE_CHECKING, Any, Never

from ..base import UnknownNameError, listed, named, nearest, text
from ..components.language import Parameter, Variable
from .flattening.vectors import stacked
from .simulation.tolerance import ATOL, RTOL

if TYPE_CHECKING:
    from .reduction.jumps import Jumps
    from .reduction.pantelides import System
    from .reduction.tearing import Torn
    from .reduction.transitions import Switching
    from .results.result import Result
    from .simulation.bound_dae import Closed


KEPT = 4


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
        jumps: the equations while signals jump whose derivatives they hold, if there are any.
    """

    name: str
    x: Any
    z: Any
    u: Any
    p: Any
    modes: Any
    impulses: Any
    completion: Any
    time: Any
    ode: Any
    alg: Any
    inputs: list[Input]
    states: list[int]
    algebraic: list[int]
    blocks: list[Torn]
    switching: Switching
    variables: Any
    system: System
    jumps: Jumps | None = None
    _closed: dict[tuple[object, ...], Closed] = field(default_factory=dict)

    @cached_property
    def state_names(self) -> list[str]:
        """Full names of the states."""
        return [self.system.name(v) for v in self.states]

    @property
    def input_names(self) -> list[str]:
        """Full names of the external inputs."""
        return [i.path for i in self.inputs if i.order == 0]

    @property
    def parameter_values(self) -> dict[str, float]:
        """Every parameter that can be set, with its value."""
        table = self.system.flat.table
        return dict(zip(table.index, table.defaults, strict=True))

    @property
    def hybrid(self) -> bool:
        """Whether there are modes to switch."""
        return bool(self.switching.changes)

    @cached_property
    def followed(self) -> dict[int, tuple[int, int]]:
        """By variable that starts where an input does: that input, and its sign against the variable."""
        flat = self.system.flat
        found = {}
        for group in flat.groups:
            for name, declared in type(group[0].component).fields.items():
                leader = declared.follows if isinstance(declared, Variable) else ""
                for instance in group if leader and name in group[0].template.place else ():
                    (root, sign), (led, other) = (flat.joined.find(instance.index(n)) for n in (name, leader))
                    if root != led:
                        found[root] = led, sign * other
        return found

    def names(self) -> Iterable[str]:
        """Yield the full names of all variables."""
        return self.system.flat.names()

    def expression(self, path: str) -> Any:
        """Return a variable, a mode, a parameter or `der(...)` of a variable as SX.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.system.flat.check_name(path)
        if path == "time":
            return self.time
        if path in self.switching.mode_names:
            return self.modes[self.switching.mode_names.index(path)]
        parameter = self.system.flat.table.at(path)
        if parameter is not None:
            return parameter
        root, sign = self.root(path)
        return self.variables[root] * sign

    def root(self, path: str) -> tuple[int, int]:
        """Return the joined variable behind a name, and the sign against it.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        flat = self.system.flat
        if not text(path) and path.startswith("der("):
            root, sign = self.root(path[4:-1])
            upper = self.system.derivative.get(root)
            if upper is None:
                raise UnknownNameError(f"'{self.name}' has no variable '{path}'")
            return upper[0], sign * upper[1]
        return flat.joined.find(flat.variable(path))

    def unit(self, path: str) -> str:
        """Return the unit of a variable or parameter, empty if it has none.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.system.flat.check_name(path)
        declared = self.system.flat.table.field(path)
        if declared is not None:
            return declared.unit
        if path == "time":
            return "s"
        if path in self.switching.mode_names:
            return ""
        if path.startswith("der("):
            return f"{self.unit(path[4:-1])}/s"
        return self.system.names.facts[self.system.flat.variable(path)].unit

    def field(self, path: str) -> Parameter:
        """Return the declaration of a parameter.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.system.flat.check_name(path)
        table = self.system.flat.table
        if path not in self.parameter_values:
            told = nearest(str(path), table.index)
            raise UnknownNameError(f"'{self.name}' has no parameter '{path}' that can be set{told}")
        return table.fields[table.index[path]]

    def simulate(
        self,
        stop: float,
        *,
        start: Mapping[str, float] | None = None,
        guess: Mapping[str, float] | None = None,
        inputs: Mapping[str, Any] | None = None,
        parameters: Mapping[str, float] | None = None,
        begin: float = 0.0,
        step: float | None = None,
        rtol: float = RTOL,
        atol: float = ATOL,
        solver: str = "auto",
        sensitivities: Iterable[str] = (),
        progress: bool | None = None,
        max_steps: int | None = None,
        max_step: float = inf,
        **unknown: Never,
    ) -> Result:
        """Run from `begin` to `stop` and return the result.

        Args:
            stop: end time [s].
            start: fixed start values by name (of states or of anything that determines them).
            guess: start values that may give way to fixed ones.
            inputs: signals by name: a number, a function of time (CasADi or NumPy functions), a
                `Sampled` or a pair (time, values).
            parameters: changed parameters by name.
            begin: start time [s].
            step: output interval [s]; a 500th of the run if not given.
            rtol: relative tolerance.
            atol: absolute tolerance, times the nominal value of each state.
            solver: "auto", "cvodes", "idas", "rosenbrock", or "compiled" (in C, needs a compiler). "auto" is
                "idas" where algebraic unknowns are left and "cvodes" elsewhere; `fit` and `diagnose`, which
                run a model again and again, let it be "compiled" if that pays.
            sensitivities: parameters whose forward sensitivities are wanted (smooth networks).
            progress: show progress; by default on runs that last over a second on a terminal.
            max_steps: steps of the integrator after which the run is given up; no limit if not given. Solver
                "compiled" also gives up where events between two outputs are 20 times their share of it.
            max_step: longest step of the integrator [s]; runs stop by themselves where inputs switch, and
                keep steps short where inputs move.
            unknown: refused, with the nearest argument that there is.

        Raises:
            ModelError: for unknown names or arguments, values out of range, and tolerances or steps that no
                run can keep to.
            InitialConditionError: for start values that contradict each other.
            SimulationError: if the run cannot be finished; its `result` keeps what was computed.
            RunInterruptedError: on Ctrl-C; its `result` likewise.
        """
        from ..base.keywords import check_keywords
        from .simulation.run import Settings
        from .simulation.simulate import simulate

        check_keywords("simulate()", unknown, DAE.simulate)
        settings = Settings(begin, stop, step, rtol, atol, solver, progress, max_steps, max_step)
        return simulate(
            self, settings, named("start", start), named("guess", guess), named("inputs", inputs),
            named("parameters", parameters), listed("sensitivities", sensitivities),
        )  # fmt: skip

    def closed(self, signals: Mapping[str, Any]) -> Closed:
        """Return the equations with input signals put in; the last few are kept, compiled.

        Raises:
            ModelError: for unknown inputs and for inputs without a signal.
        """
        from .simulation.bound_dae import Closed, Given, chosen_signals

        chosen = chosen_signals(self, named("inputs", signals))
        key = get_ident(), Given(chosen)
        known = self._closed.pop(key, None) or Closed(self, chosen)
        self._closed[key] = known
        if len(self._closed) > KEPT:
            del self._closed[next(iter(self._closed))]
        return known

    def arguments(self) -> list[Any]:
        """Return the symbols every expression depends on: x, z, u, q, time."""
        return [self.x, self.z, self.u, self.constants, self.time]

    @cached_property
    def constants(self) -> Any:
        """All that is constant within a segment: p, modes, impulses, completion."""
        return stacked(self.p, self.modes, self.impulses, self.completion)
