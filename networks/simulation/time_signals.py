"""Signals of time: what enters a network's equations and depends on time alone, wherever it stands."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...base import Array, Flags
from ...components.language import Sampled
from ..evaluation.compiled import Batch
from ..flattening.vectors import column, pick, stacked
from .intervals import Bounds, Enclosure
from .splines import sampled_at

if TYPE_CHECKING:
    from ..dae import DAE
    from .bound_dae import BoundDAE

STATES, CONSTANT, TIMED = range(3)
DRAWN = 8193


class TimeSignals:
    """The largest expressions of time, inputs and parameters alone that the equations of a network hold.

    Args:
        closed: the network with its inputs.
        parameters: values of the parameters.
        begin: start of the run [s]; inputs that only numbers can be put into are drawn from there on
        stop: to here [s].
    """

    def __init__(self, closed: BoundDAE, parameters: Array, begin: float, stop: float) -> None:
        self._closed, self._parameters, self._span = closed, parameters, (begin, stop)
        self._rows = closed.timed_rows
        self.count: int = self._rows.numel()

    @cached_property
    def formal(self) -> Flags:
        """Which signals are formulas, with no data in them."""
        moved = ca.jacobian_sparsity(self._rows, pick(self._symbols[0], self._drawn)).row()
        return ~np.isin(np.arange(self.count), moved)

    def __call__(self, times: Array) -> Array:
        """Return the signals at instants, (instants, signals)."""
        inputs = self._input_values(times)
        if self.plain is not None:
            return inputs[:, self.plain]
        constant = np.broadcast_to(self._parameters, (len(times), len(self._parameters)))
        return self._evaluate(inputs, constant, times[:, None])[0][:, :, 0]

    @cached_property
    def plain(self) -> list[int] | None:
        """Places of the inputs that the signals are, if they are nothing more."""
        u = self._symbols[0]
        place = {u.nz[k].element_hash(): k for k in range(u.numel())}
        found = [place.get(self._rows.nz[row].element_hash()) for row in range(self.count)]
        return None if None in found else [k for k in found if k is not None]

    def bounds(self, low: Array, high: Array) -> tuple[Array, Array]:
        """Return what the signals can be within intervals, (intervals, signals)."""
        return self._enclosure(*self._boxes(low, high))[:2]

    def may_switch(self, low: Array, high: Array) -> Flags:
        """Tell within which intervals a formula may jump or bend."""
        if not self.formal.any():
            return np.zeros(len(low), dtype=bool)
        return self._formulas_enclosure(*self._boxes(low, high))[2]

    def steepest(self, low: Array, high: Array) -> Array:
        """Return how fast the signals can change within intervals, (intervals, signals)."""
        below, above, _ = self._slope(*self._boxes(low, high))
        return np.maximum(np.abs(below), np.abs(above))

    def ends(self, begin: float, stop: float) -> list[tuple[float, float]]:
        """Return the neighbouring instants between which data that are held begin or end."""
        signals = [self._closed.signals[self._closed.dae.inputs[k].path] for k in self._drawn]
        held = [s for s in signals if isinstance(s, Sampled) and s.extrapolation == "hold"]
        instants = {float(t) for s in held for t in (s.time[0], s.time[-1]) if begin < t < stop}
        return [(float(np.nextafter(t, -np.inf)), t) for t in sorted(instants)]

    def within_data(self, low: Array, high: Array) -> Flags:
        """Tell which intervals hold no more than one instant of the data, so that a few points show all."""
        first, last = (np.searchsorted(self._instants, side) for side in (low, high))
        few: Flags = last - first <= 1
        return few

    @cached_property
    def _instants(self) -> Array:
        return np.unique(np.concatenate([np.zeros(0), *(times for times, _ in self._tables.values())]))

    def _boxes(self, low: Array, high: Array) -> tuple[list[Bounds], list[Bounds], list[Bounds]]:
        data = [_range(*self._tables[k], low, high) for k in self._drawn]
        constants = [(value, value) for value in (np.full_like(low, number) for number in self._parameters)]
        return data, constants, [(low, high)]

    @cached_property
    def _drawn(self) -> list[int]:
        """Places of the inputs that are known by numbers, not by a formula."""
        return [k for k, formula in enumerate(self._formulas) if formula is None]

    @cached_property
    def _formulas(self) -> list[Any]:
        """Each input as an expression of time, None if there is none."""
        time = self._symbols[2]
        return [self._closed.formula(k, time) for k in range(len(self._closed.dae.inputs))]

    @cached_property
    def _symbols(self) -> tuple[Any, Any, Any]:
        dae = self._closed.dae
        return dae.u, dae.p, dae.time

    @cached_property
    def _of_time(self) -> tuple[Any, Any]:
        """The signals with formulas put in, and their slopes in time."""
        u, _, t = self._symbols
        known = [k for k, formula in enumerate(self._formulas) if formula is not None]
        rows = self._rows
        if known:
            rows = ca.substitute(rows, pick(u, known), column([ca.densify(self._formulas[k]) for k in known]))
        unknown = ca.SX(np.where(self.formal, 0.0, np.inf))
        return rows, ca.densify(ca.jacobian(rows, t)) + unknown

    @cached_property
    def _enclosure(self) -> Enclosure:
        return Enclosure(self._function(self._of_time[0]))

    @cached_property
    def _formulas_enclosure(self) -> Enclosure:
        return Enclosure(self._function(pick(self._of_time[0], np.flatnonzero(self.formal).tolist())))

    @cached_property
    def _slope(self) -> Enclosure:
        return Enclosure(self._function(self._of_time[1]))

    def _function(self, rows: Any) -> Any:
        u, p, t = self._symbols
        return ca.Function("timed", [pick(u, self._drawn), p, t], [ca.densify(rows)])

    @cached_property
    def _evaluate(self) -> Batch:
        return Batch(ca.Function("timed", [*self._symbols], [ca.densify(self._rows)]))

    def _input_values(self, times: Array) -> Array:
        constants = np.zeros((len(times), self._closed.q.numel()))
        constants[:, : len(self._parameters)] = self._parameters
        values: Array = self._closed.input_values(constants, times)
        return values

    @cached_property
    def _tables(self) -> dict[int, tuple[Array, Array]]:
        """Instants and values of the inputs that are known by numbers."""
        tables = {}
        evenly = np.linspace(*self._span, DRAWN)
        for k in self._drawn:
            declared = self._closed.dae.inputs[k]
            signal = self._closed.signals[declared.path]
            if isinstance(signal, Sampled):
                tables[k] = signal.time, declared.sign * sampled_at(signal, signal.time, declared.order)
            else:
                tables[k] = evenly, self._input_values(evenly)[:, k]
        return tables


def _range(times: Array, values: Array, low: Array, high: Array) -> Bounds:
    """Return the least and greatest of a table's values around intervals in order."""
    first = np.clip(np.searchsorted(times, low, "right") - 1, 0, len(times) - 1)
    last = np.clip(np.searchsorted(times, high, "left") + 1, first + 1, len(times))
    pairs = np.column_stack([first, last]).ravel()
    padded = np.append(values, values[-1])
    return np.minimum.reduceat(padded, pairs)[::2], np.maximum.reduceat(padded, pairs)[::2]


def timed_rows(dae: DAE, given: Sequence[int], watched: bool = False) -> Any:
    """Return the largest expressions of time, given inputs and parameters alone in the equations of a DAE.

    Args:
        dae: the equations.
        given: places of the inputs that are known before a run.
        watched: whether these themselves count, as they are looked at from outside.
    """
    jumping = dae.jumps.watched if dae.jumps else ca.SX(0, 1)
    indicators = pick(dae.switching.expressions, [c.indicator for c in dae.switching.changes])
    equations = stacked(dae.ode, dae.alg, indicators, pick(dae.u, given if watched else []), jumping)
    moved = ca.jacobian_sparsity(equations, ca.vertcat(pick(dae.u, given), dae.time)).row()
    if not moved:
        return ca.SX(0, 1)
    return _largest(dae, pick(equations, sorted(set(moved))), set(given))


def _largest(dae: DAE, equations: Any, given: set[int]) -> Any:
    read = dae.jumps.before if dae.jumps else ca.SX(0, 1)
    function = ca.Function("equations", [*dae.arguments(), read], [equations])
    arguments = [argument.nz[:] for argument in dae.arguments()]
    parameters = dae.p.numel()
    work: dict[int, tuple[int, Any, int]] = {}
    found: dict[int, Any] = {}
    for k in range(function.n_instructions()):
        operation, into, of = (
            function.instruction_id(k),
            function.instruction_output(k),
            function.instruction_input(k),
        )
        if operation == ca.OP_INPUT:
            kind = _kind(of[0], of[1], parameters, given)
            work[into[0]] = kind, arguments[of[0]][of[1]] if kind != STATES else None, k
        elif operation == ca.OP_CONST:
            work[into[0]] = CONSTANT, ca.SX(function.instruction_constant(k)), k
        elif operation == ca.OP_OUTPUT:
            _note(found, [work[of[0]]])
        else:
            operands = [work[place] for place in of]
            if any(kind == STATES for kind, *_ in operands):
                _note(found, operands)
                work[into[0]] = STATES, None, k
            else:
                kind = max(kind for kind, *_ in operands)
                work[into[0]] = kind, _applied(operation, [value for _, value, _ in operands]), k
    return column([*found.values()])


def _kind(argument: int, entry: int, parameters: int, given: set[int]) -> int:
    """Tell what an argument of the DAE's functions is: x, z, u, constants, time."""
    if argument == 4 or (argument == 2 and entry in given):
        return TIMED
    return CONSTANT if argument == 3 and entry < parameters else STATES


def _note(found: dict[int, Any], operands: Sequence[tuple[int, Any, int]]) -> None:
    found.update({number: value for kind, value, number in operands if kind == TIMED})


def _applied(operation: int, operands: list[Any]) -> Any:
    return ca.SX.unary(operation, *operands) if len(operands) == 1 else ca.SX.binary(operation, *operands)
