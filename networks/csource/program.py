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
from ..flattening.vectors import column, pick
from ..simulation.bound_dae import BoundDAE
from ..simulation.events import constants
from ..simulation.input_signals import Polynomial, chosen_signals
from ..simulation.legs import Leg, endless_legs
from ..simulation.starting import Start
from ..simulation.time_signals import TimeSignals
from .model import CModel
from .tables import macros

HORIZON = 1e5  # s: until when instants at which signals switch are sought
HEADERS = ("core.h", "core_state.h", "rodas5p.h")
STARTS = ("start.h", "start.c")
SOURCES = (
    "algebra.c", "core.c", "events.c", "impacts.c", "legs.c", "linear.c",
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
    files: dict[str, str]
    states: list[str]
    inputs: list[Input]
    parameters: dict[str, float]
    modes: list[str]
    mode_values: list[tuple[str, ...]]
    variables: list[str]
    indicators: int

    @property
    def sources(self) -> list[str]:
        """Names of the C files to compile."""
        return [name for name in self.files if name.endswith(".c")]

    @cached_property
    def dependencies(self) -> tuple[list[list[int]], list[list[int]]]:
        """What rates and other variables depend on: for each, places in (states, free inputs).

        Algebraic unknowns pass dependencies on; those that share equations share what they depend on.
        """
        dae = self.dae
        place = {(i.path, i.order): k for k, i in enumerate(dae.inputs)}
        known = ca.vertcat(dae.x, pick(dae.u, [place[i.path, i.order] for i in self.inputs]))
        published = column([dae.expression(name) for name in self.variables])
        among = _incidence(dae.alg, dae.z)
        _, order, starts = (among.T @ among).sparsity().scc()
        groups = [k for k, (begin, end) in enumerate(pairwise(starts)) for _ in range(begin, end)]
        member = ca.DM(ca.Sparsity.triplet(len(starts), len(order), groups, order))
        reach = member.T @ (member @ (among.T @ _incidence(dae.alg, known)))
        rates, variables = (
            _by_row(_incidence(values, known) + _incidence(values, dae.z) @ reach)
            for values in (dae.ode, published)
        )
        return rates, variables


def _incidence(values: Any, symbols: Any) -> Any:
    """Return which values depend on which symbols, as a matrix of ones."""
    return ca.DM(ca.jacobian_sparsity(values, symbols))


def _by_row(matrix: Any) -> list[list[int]]:
    """Return the columns of each row's nonzeros."""
    starts, places = matrix.T.sparsity().get_ccs()
    return [places[begin:end] for begin, end in pairwise(starts)]


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
    model = CModel(dae, signals, list(variables), _built_in_legs(dae, signals), start=start)
    return CProgram(
        dae,
        files=model.texts() | sources((*SOURCES, "products.c", *(STARTS if start else ()))),
        states=dae.state_names,
        inputs=model.free,
        parameters=dae.parameter_values,
        modes=dae.switching.mode_names,
        mode_values=dae.switching.mode_values,
        variables=[*variables],
        indicators=len(dae.switching.changes),
    )


def _built_in_legs(dae: DAE, signals: Mapping[str, Any]) -> list[Leg]:
    """Return the legs of any run of a program, by its own signals; free inputs come from outside."""
    free = {declared.path: Polynomial(0) for declared in dae.inputs if declared.path not in signals}
    closed = BoundDAE(dae, {**signals, **free})
    return endless_legs(TimeSignals(closed, closed.dae.parameters.values({}), 0.0, HORIZON), HORIZON)


def sources(names: Sequence[str]) -> dict[str, str]:
    """Return headers and some sources of the core by name, with the constants of events."""
    texts = {name: Path(__file__).with_name(name).read_text(encoding="utf-8") for name in (*HEADERS, *names)}
    return texts | {"constants.h": macros(vars(constants))}
