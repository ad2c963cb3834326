"""Program: a network as C files, with the tables that describe what they compute."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import casadi as ca

from ..dae import DAE, Input
from ..flattening.vectors import column
from ..simulation.bound_dae import BoundDAE
from ..simulation.events import constants
from ..simulation.input_signals import Polynomial, chosen_signals
from ..simulation.legs import Leg, endless_legs
from ..simulation.starting import Start
from ..simulation.time_signals import TimeSignals
from .model import Model
from .tables import macros

HORIZON = 1e5
HERE = Path(__file__).parent
HEADERS = ("core.h", "core_state.h")
PRODUCTS = ("products.c",)
STARTS = ("start.h", "start.c")
SOURCES = (
    "algebra.c", "chattering.c", "contacts.c", "core.c", "events.c", "impacts.c", "legs.c", "linear.c",
    "locate.c", "message.c", "rosenbrock.c", "shocks.c", "stepper.c",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class CProgram:
    """A network as self-contained C99: `core.h` is what others call.

    Attributes:
        files: text by name: headers, model.c and the sources of the core.
        states: names of the NX states; units and nominal values in the same order.
        inputs: the NU free inputs; those of `order` above 0 are time derivatives of the first.
        parameters: default of each of the NP parameters by name.
        modes: names of the NM modes; `mode_values` their values' names.
        variables: names of the NW other variables.
        indicators: their number, NG.
    """

    dae: DAE
    model: Model
    files: dict[str, str]

    @property
    def sources(self) -> list[str]:
        """Names of the C files to compile."""
        return [name for name in self.files if name.endswith(".c")]

    @property
    def states(self) -> list[str]:
        """Full names of the states."""
        return self.dae.state_names

    @property
    def inputs(self) -> list[Input]:
        """Free inputs and their derivatives."""
        return self.model.free

    @property
    def parameters(self) -> dict[str, float]:
        """Defaults of the parameters."""
        return self.dae.parameter_values

    @property
    def modes(self) -> list[str]:
        """Full names of the modes."""
        return self.dae.switching.mode_names

    @property
    def mode_values(self) -> list[tuple[str, ...]]:
        """The names of the values of each mode."""
        return self.dae.switching.mode_values

    @property
    def variables(self) -> list[str]:
        """Names of the other variables."""
        return list(self.model.variables)

    @property
    def indicators(self) -> int:
        """Number of event indicators."""
        return len(self.dae.switching.changes)

    @cached_property
    def dependencies(self) -> tuple[list[list[int]], list[list[int]]]:
        """What rates and other variables depend on: for each, places in (states, free inputs).

        Algebraic unknowns pass dependencies on.
        """
        dae = self.dae
        place = {(i.path, i.order): k for k, i in enumerate(dae.inputs)}
        free = [place[i.path, i.order] for i in self.inputs]
        known = ca.vertcat(dae.x, ca.SX(0, 1) if not free else dae.u[free])
        published = column([dae.expression(name) for name in self.variables])
        algebra = _reach(dae.alg, dae.z, known)
        return _rows(dae.ode, known, dae.z, algebra), _rows(published, known, dae.z, algebra)


def _reach(residuals: Any, unknowns: Any, known: Any) -> list[set[int]]:
    """Return what each algebraic unknown depends on; unknowns that share equations share it."""
    count = unknowns.numel()
    if not count:
        return []
    among = ca.jacobian_sparsity(residuals, unknowns)
    direct = _by_row(ca.jacobian_sparsity(residuals, known), residuals.numel())
    _, order, starts = (among.T * among).scc()
    reach: list[set[int]] = [set() for _ in range(count)]
    rows_of = _by_row(among.T, count)
    for begin, end in pairwise(starts):
        members = [order[k] for k in range(begin, end)]
        shared: set[int] = set().union(*(direct[row] for member in members for row in rows_of[member]))
        for member in members:
            reach[member] = shared
    return reach


def _rows(values: Any, known: Any, unknowns: Any, algebra: list[set[int]]) -> list[list[int]]:
    count = values.numel()
    direct = _by_row(ca.jacobian_sparsity(values, known), count)
    through = _by_row(ca.jacobian_sparsity(values, unknowns), count)
    return [sorted(direct[i].union(*(algebra[k] for k in through[i]))) for i in range(count)]


def _by_row(pattern: Any, count: int) -> list[set[int]]:
    rows: list[set[int]] = [set() for _ in range(count)]
    for row, place in zip(*pattern.get_triplet(), strict=True):
        rows[row].add(place)
    return rows


def c_program(
    dae: DAE,
    inputs: Mapping[str, Any] | None = None,
    variables: Sequence[str] = (),
    start: Start | None = None,
) -> CProgram:
    """Return a network as a C program.

    Args:
        dae: the network's equations.
        inputs: signals to build in, by name; those bound to components are built in too. All others are
            free, to be set from outside.
        variables: what to publish besides the states.
        start: where it starts from, if it is to find start values by itself, as `start.h` offers.

    Raises:
        ModelError: for unknown inputs, or signals that are none.
        UnknownNameError: for unknown variables, with the nearest name.
    """
    signals = chosen_signals(dae, dict(inputs or {}), free=True)
    model = Model(dae, signals, list(variables), _built_in_legs(dae, signals), start=start)
    more = STARTS if start else ()
    return CProgram(dae, model, model.texts() | sources((*SOURCES, *PRODUCTS, *more)))


def _built_in_legs(dae: DAE, signals: Mapping[str, Any]) -> list[Leg]:
    """Return the legs of any run of a program, by its own signals; free inputs come from outside."""
    free = {declared.path: Polynomial(0) for declared in dae.inputs if declared.path not in signals}
    closed = BoundDAE(dae, {**signals, **free})
    return endless_legs(TimeSignals(closed, closed.dae.parameters.values({}), 0.0, HORIZON), HORIZON)


def sources(names: Sequence[str]) -> dict[str, str]:
    """Return headers and some sources of the core by name, with the constants of events."""
    texts = {name: (HERE / name).read_text(encoding="utf-8") for name in (*HEADERS, *names)}
    return texts | {"constants.h": macros(vars(constants))}
