"""Signals of time: what enters a network's equations and depends on time alone, wherever it stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...base import Array, Flags
from ...components.language import Sampled
from ..evaluation.compiled import Batch
from ..flattening.instructions import instructions
from ..flattening.vectors import column, pick, stacked
from .input_signals import SignalKey
from .intervals import Bounds, Enclosure
from .splines import breaks, sampled_at

if TYPE_CHECKING:
    from ..dae import DAE
    from .bound_dae import BoundDAE

STATES, CONSTANT, FORMAL, DRAWN = range(4)
TABLE_POINTS = 2**17 + 1
LINE_SHARE = 1e-9  # of a table's values within which they lie on a line


class TimeSignals:
    """The largest expressions of time, inputs and parameters alone that the equations of a network hold.

    Inputs that only numbers can be put into are drawn from `begin` to `stop` [s].

    Args:
        closed: the equations with their inputs.
        parameters: their numbers.
        begin, stop: first and last instant [s].
        places: of some of the expressions, if not all are meant.
    """

    def __init__(
        self,
        closed: BoundDAE,
        parameters: Array,
        begin: float,
        stop: float,
        places: Sequence[int] | None = None,
    ) -> None:
        self._closed, self._dae = closed, closed.dae
        self._parameters, self._span = parameters, (begin, stop)
        self._rows = closed.timed_rows if places is None else pick(closed.timed_rows, places)
        self.count: int = self._rows.numel()
        self._enclosure = cache(self._enclosed)

    @cached_property
    def formal(self) -> Flags:
        """Which signals are formulas, with no data in them."""
        moved = ca.jacobian_sparsity(self._rows, pick(self._dae.u, self._drawn)).row()
        return ~np.isin(np.arange(self.count), moved)

    def __call__(self, times: Array) -> Array:
        """Return the signals at instants, (instants, signals)."""
        inputs = self._input_values(times)
        plain = [k for k in self._plain if k is not None]
        if len(plain) == self.count:
            return inputs[:, plain]
        constant = np.broadcast_to(self._parameters, (len(times), len(self._parameters)))
        return self._evaluate(inputs, constant, times[:, None])[0][:, :, 0]

    @cached_property
    def _plain(self) -> list[int | None]:
        """Place of the input that a signal is, if it is nothing more, for each of them."""
        u = self._dae.u
        place = {u.nz[k].element_hash(): k for k in range(u.numel())}
        return [place.get(self._rows.nz[row].element_hash()) for row in range(self.count)]

    @cached_property
    def is_led(self) -> bool:
        """Whether parameters make a difference to the signals."""
        return bool(ca.depends_on(self._rows, self._dae.p))

    def apart(self) -> list[tuple[SignalKey | None, TimeSignals]]:
        """Return what is an input alone, by inputs and with what tells them from others, and all else."""
        rows: dict[int | None, list[int]] = {}
        signals = [None if k is None else self._closed.given[k] for k in self._plain]
        for row, signal in enumerate(signals):
            rows.setdefault(signal and id(signal[1]), []).append(row)
        found = []
        for places in rows.values():
            part = [signals[row] for row in places]
            told = None if None in part else SignalKey({i.order: signal for i, signal in filter(None, part)})
            found.append((told, TimeSignals(self._closed, self._parameters, *self._span, places)))
        return found

    def bounds(self, low: Array, high: Array) -> tuple[Array, Array]:
        """Return what the signals can be within intervals, (intervals, signals)."""
        return self._enclosure("signals")(*self._boxes(low, high))[:2]

    def may_switch(self, low: Array, high: Array) -> Flags:
        """Tell within which intervals a formula may jump or bend, or one around a function that it calls."""
        if not self.formal.any() and not self._calling:
            return np.zeros(len(low), dtype=bool)
        return self._enclosure("formulas")(*self._boxes(low, high))[2]

    def steepest(self, low: Array, high: Array) -> Array:
        """Return how fast the signals can change within intervals, (intervals, signals)."""
        return self._greatest("slopes", low, high)

    def most_bent(self, low: Array, high: Array) -> Array:
        """Return how large second derivatives in time can be within intervals that hold no switch."""
        return self._greatest("bends", low, high)

    def _greatest(self, what: str, low: Array, high: Array) -> Array:
        below, above, _ = self._enclosure(what)(*self._boxes(low, high))
        return np.maximum(np.abs(below), np.abs(above))

    def ends(self, begin: float, stop: float) -> tuple[Array, Array]:
        """Return the neighbouring instants between which data jump, or that are held begin or end."""
        signals = [self._closed.given[k][1] for k in self._drawn]
        found = [breaks(s) for s in signals if isinstance(s, Sampled)]
        instants = np.unique(np.concatenate([np.zeros(0), *found]))
        inside = instants[(begin < instants) & (instants <= stop)]
        return np.nextafter(inside, -np.inf), inside

    def within_data(self, low: Array, high: Array) -> Flags:
        """Tell which intervals hold no more than one instant of the data, so that a few points show all."""
        few: Flags = np.diff(np.searchsorted(self._instants, [low, high]), axis=0)[0] <= 1
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
        """Places of the inputs that are in them and known by numbers, not by a formula."""
        there = set(ca.jacobian_sparsity(self._rows, self._dae.u).get_triplet()[1])
        return [k for k in sorted(there) if k not in self._closed.formulas]

    @cached_property
    def _calling(self) -> list[Any]:
        """The inputs known by numbers that are formulas around functions, which these may miss to switch."""
        return [self._closed.read[k] for k in self._drawn if k in self._closed.read]

    @cached_property
    def _of_time(self) -> Any:
        """The signals with formulas and numbers put in: a difference of equal ones is 0 at all times.

        An enclosure cannot see that two formulas are equal, nor that a gain of 1 keeps them so, and would
        look for a pulse in their difference.
        """
        dae = self._dae
        known = self._closed.formulas
        formulas = ca.substitute(self._rows, pick(dae.u, [*known]), column([*known.values()]))
        return ca.cse(ca.substitute(formulas, dae.p, ca.SX(self._parameters)))

    def _enclosed(self, what: str) -> Enclosure:
        """Return an enclosure of all "signals", of "formulas" alone, or of "slopes" or "bends" of all."""
        dae, rows = self._dae, self._of_time
        if what == "formulas":
            rows = ca.vertcat(pick(rows, np.flatnonzero(self.formal).tolist()), *self._calling)
        for _ in range({"slopes": 1, "bends": 2}.get(what, 0)):
            rows = ca.densify(ca.jacobian(rows, dae.time)) + ca.SX(np.where(self.formal, 0.0, np.inf))
        arguments = [pick(dae.u, self._drawn), dae.p, dae.time]
        return Enclosure(ca.Function("timed", arguments, [ca.densify(rows)]))

    @cached_property
    def _evaluate(self) -> Batch:
        dae = self._dae
        return Batch(ca.Function("timed", [dae.u, dae.p, dae.time], [ca.densify(self._rows)]))

    def _input_values(self, times: Array) -> Array:
        constants = self._closed.blank(self._parameters)
        return self._closed.input_values(np.broadcast_to(constants, (len(times), len(constants))), times)

    @cached_property
    def _tables(self) -> dict[int, tuple[Array, Array]]:
        """Instants and values of the inputs that are known by numbers."""
        tables = {}
        evenly = np.linspace(*self._span, TABLE_POINTS)
        for k in self._drawn:
            declared, signal = self._closed.given[k]
            if isinstance(signal, Sampled):
                tables[k] = signal.time, declared.sign * sampled_at(signal, signal.time, declared.order)
            else:
                tables[k] = _corners(evenly, self._input_values(evenly)[:, k])
        return tables


def _corners(times: Array, values: Array) -> tuple[Array, Array]:
    """Return the corners of evenly spaced values, if lines between them give all of these; else the values.

    Where two neighbours bend and those around them do not, the lines of these meet in a corner between.
    """
    size, rates = np.abs(values).max(), np.diff(values)
    bends = np.append(False, ~(np.abs(np.diff(rates)) <= LINE_SHARE * size))  # at the first of two rates
    first = np.flatnonzero(bends[1:-2] & bends[2:-1] & ~bends[:-3] & ~bends[3:]) + 1
    with np.errstate(all="ignore"):
        share = (rates[first] - rates[first + 1]) / (rates[first - 1] - rates[first + 1])
    met = (share >= 0) & (share <= 1)
    first, share = first[met], share[met]
    bends[[*first, *(first + 1)]] = False
    alone = np.concatenate([[0], np.flatnonzero(bends), [len(times) - 1]])
    corners = np.append(times[alone], times[first] + share * (times[1] - times[0]))
    heights = np.append(values[alone], values[first] + share * rates[first - 1])
    order = np.argsort(corners)
    between = np.interp(times, corners[order], heights[order])
    lines = np.abs(between - values).max() <= LINE_SHARE * size
    return (corners[order], heights[order]) if lines else (times, values)


def _range(times: Array, values: Array, low: Array, high: Array) -> Bounds:
    """Return the least and greatest of a table's values around intervals in order."""
    first = np.clip(np.searchsorted(times, low, "right") - 1, 0, len(times) - 1)
    last = np.clip(np.searchsorted(times, high, "left") + 1, first + 1, len(times))
    pairs = np.column_stack([first, last]).ravel()
    padded = np.append(values, values[-1])
    return np.minimum.reduceat(padded, pairs)[::2], np.maximum.reduceat(padded, pairs)[::2]


def timed_rows(
    dae: DAE,
    given: Sequence[int],
    still: Sequence[int] = (),
    drawn: Sequence[int] = (),
    watched: bool = False,
) -> Any:
    """Return the largest expressions of time, given inputs and parameters alone in the equations of a DAE.

    Given inputs are told by their places, those that are `still` all the time, and those of the given ones
    that are `drawn` from data. Where formulas meet data in an expression, they count for themselves, too, as
    the samples by which data are looked at may miss where a formula switches. Given inputs themselves count
    where they are `watched` from outside.
    """
    jumping = dae.jumps.watched if dae.jumps else ca.SX(0, 1)
    indicators = pick(dae.switching.expressions, [c.indicator for c in dae.switching.changes])
    equations = stacked(dae.ode, dae.alg, indicators, pick(dae.u, given if watched else []), jumping)
    moved = ca.jacobian_sparsity(equations, ca.vertcat(pick(dae.u, given), dae.time)).row()
    if not moved:
        return ca.SX(0, 1)
    inputs = dict.fromkeys(given, FORMAL) | dict.fromkeys(still, CONSTANT) | dict.fromkeys(drawn, DRAWN)
    return _largest(dae, pick(equations, sorted(set(moved))), inputs)


def _largest(dae: DAE, equations: Any, inputs: Mapping[int, int]) -> Any:
    moving = ca.vertcat(pick(dae.u, [k for k, kind in inputs.items() if kind >= FORMAL]), dae.time)
    symbols = [*dae.arguments(), dae.jumps.before if dae.jumps else ca.SX(0, 1)]
    entries = [symbol.nz[:] for symbol in symbols]
    work: dict[int, tuple[int, Any]] = {}
    found: dict[int, Any] = {}
    for instruction in instructions(ca.Function("equations", symbols, [equations])):
        operation, into, of = instruction.operation, instruction.into, instruction.of
        if operation == ca.OP_INPUT:
            work[into[0]] = _kind(of[0], of[1], dae.p.numel(), inputs), entries[of[0]][of[1]]
        elif operation == ca.OP_CONST:
            work[into[0]] = CONSTANT, ca.SX(instruction.constant)
        else:
            operands = [work[place] for place in of]
            kinds, values = [kind for kind, _ in operands], [value for _, value in operands]
            known = instruction if STATES in kinds else instruction.written_out
            hidden = STATES in kinds or known.is_closed
            ends = operation == ca.OP_OUTPUT or hidden
            apart = {FORMAL, DRAWN} if ends else {FORMAL} if DRAWN in kinds else set()
            timed = [_bare(value, moving) for kind, value in operands if kind in apart]
            found |= {value.element_hash(): value for value in timed}
            if operation != ca.OP_OUTPUT:
                made = [None] * len(into) if hidden else known.applied(values)
                kind = STATES if hidden else max(kinds)
                work.update(zip(into, ((kind, one) for one in made), strict=True))
    return column([*found.values()])


def _bare(value: Any, moving: Any) -> Any:
    """Return an expression without what does not move, and its sign: they say nothing of when it moves."""
    while value.op() in (ca.OP_MUL, ca.OP_ADD, ca.OP_SUB, ca.OP_NEG):
        parts = [p for p in map(value.dep, range(value.n_dep())) if ca.depends_on(p, moving)]
        if len(parts) != 1:
            break
        (value,) = parts
    return value


def _kind(argument: int, entry: int, parameters: int, inputs: Mapping[int, int]) -> int:
    """Tell what an argument of the DAE's functions is: x, z, u, constants, time."""
    if argument == 2:
        return inputs.get(entry, STATES)
    if argument == 4:
        return FORMAL
    return CONSTANT if argument == 3 and entry < parameters else STATES
