"""Model: a DAE as C text, `model.h` and `model.c`: functions by CasADi, tables by us.

Every function reads (x, z, u, q, t): u holds all inputs and their derivatives, q all that is
constant between events. Inputs bound to a signal come from a function of time alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Sized
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from ...base import Ints
from ...components.language import Sampled
from ..dae import DAE
from ..evaluation.compiled import dense
from ..flattening.vectors import column, pick
from ..simulation.input_signals import input_value
from ..simulation.integrator import nominal_sizes
from ..simulation.legs import Leg
from ..simulation.starting import Start
from .jumping import jump_functions, jump_tables
from .reduction import Reduction
from .starts import start_functions, start_tables
from .tables import Tables
from .text import generated

DENSE_SIZE = 32  # unknowns up to which the matrix of a step is factored as a full one


@dataclass(eq=False)
class CModel:
    """The functions of a network, ready to be written as C.

    Attributes:
        signals: signal of every bound input by name; the others are `free`, set from outside.
        variables: names of what is published besides the states.
        legs: parts of a run between instants at which signals switch; none if a run brings its own.
        standalone: whether derivative products, which are long, and default values are written; a run in this
            process needs no products, and brings its values along.
        start: where it starts from, if it is to find that by itself.
    """

    dae: DAE
    signals: dict[str, Any]
    variables: Sequence[str]
    legs: Sequence[Leg]
    standalone: bool = True
    start: Start | None = None

    def __post_init__(self) -> None:
        dae, switching = self.dae, self.dae.switching
        self.free = [declared for declared in dae.inputs if declared.path not in self.signals]
        self._motion, self._moving = ca.vertcat(dae.ode, dae.alg), (dae.x, dae.z, dae.u)
        self._reduction = Reduction(dae)
        self._indicators = pick(switching.expressions, [c.indicator for c in switching.changes])
        self._shocks = [c for c in switching.changes if c.impulse is not None]
        self._velocities = pick(switching.expressions, [c.velocity for c in self._shocks])
        self._resets = [r for c in switching.changes for r in c.resets]
        self._reset_variables = sorted({r[0] for r in self._resets} - set(dae.states))
        self._others = pick(dae.variables, self._reset_variables)

    @property
    def dense(self) -> bool:
        """Whether the matrix of a step is factored as a full one."""
        return len(self._reduction.kept) <= DENSE_SIZE

    def texts(self) -> dict[str, str]:
        """Return model.h and model.c."""
        functions = self.functions()
        text, work = generated(functions)
        tables = self._tables()
        tables.sizes(
            MODEL_ARGS=max(f.sz_arg() for f in functions),
            MODEL_RESULTS=max(f.sz_res() for f in functions),
            MODEL_INTEGERS=max(f.sz_iw() for f in functions),
            MODEL_WORK=work,
        )
        names = [f.name() for f in functions]
        self.shared_sizes, self.shared_header = tables.shared_sizes(), tables.shared_header(names)
        return {"model.h": tables.header(self.dae.name, names), "model.c": tables.source() + text}

    def functions(self) -> list[Any]:
        """Return the CasADi functions, named as in C."""
        dae, motion, indicators = self.dae, self._motion, self._indicators
        rates = [ca.SX.sym("rate", s.numel()) for s in self._moving]
        published = column([dae.expression(name) for name in self.variables])
        by_time = ca.jtimes(motion, dae.u, rates[2]) + ca.jacobian(motion, dae.time)
        slope = ca.project(ca.jacobian(motion, ca.vertcat(dae.x, dae.z)), self._reduction.slopes)
        blocks = column([ca.vec(ca.densify(block.matrix)) for block in dae.blocks])
        shock = ca.jacobian(motion, dae.impulses).nz[:], ca.jacobian(self._velocities, dae.x).nz[:]
        moved = ca.jacobian(indicators, dae.time)
        for symbol, rate in zip(self._moving, rates, strict=True):
            moved = moved + ca.jtimes(indicators, symbol, rate)
        return [
            self._inputs(),
            self._function("model_motion", [], [motion]),
            self._function("model_slope", rates[2:], [slope.nz[:], by_time]),
            self._function("model_watch", rates, [indicators, moved]),
            self._function("model_switch", [], [dae.switching.expressions]),
            self._function("model_blocks", [], [blocks]),
            self._function("model_shock", [], shock),
            self._function("model_reset", [], [self._others, ca.jacobian(self._others, dae.x).nz[:]]),
            self._function("model_variables", [], [published]),
            *jump_functions(dae, self._function),
            *(self._products(published) if self.standalone else []),
            *(start_functions(self.start, dae.arguments()) if self.start else []),
        ]

    def _products(self, published: Any) -> list[Any]:
        """Return forward and reverse derivatives of motion and variables in x, z, u and p.

        Where a law has no slope in a parameter, as a power of zero in its exponent, directions in which
        parameters stay have one all the same: the last argument says whether any parameter moves.
        """
        results, of = ca.vertcat(self._motion, published), [*self._moving, self.dae.p]
        seeds = [ca.SX.sym(f"seed{k}", s.numel()) for k, s in enumerate(of)]
        *moved, by_parameters = (ca.densify(ca.jtimes(results, s, d)) for s, d in zip(of, seeds, strict=True))
        tuned = ca.SX.sym("tuned")
        forward = sum(moved, ca.if_else(tuned, by_parameters, 0))
        weights = ca.SX.sym("weights", results.numel())
        reverse = [ca.jtimes(results, s, weights, True) for s in of]
        return [
            self._function("model_forward", [*seeds, tuned], [forward]),
            self._function("model_adjoint", [weights], reverse),
        ]

    def _function(self, name: str, more: Sequence[Any], results: Sequence[Any]) -> Any:
        return ca.Function(name, [*self.dae.arguments(), *more], dense(*results), {"cse": True})

    def _inputs(self) -> Any:
        """Return bound inputs and their rates as a function of time; zero where inputs are free."""
        sampled = any(isinstance(signal, Sampled) for signal in self.signals.values())
        kind: Any = ca.MX if sampled else ca.SX
        t = kind.sym("t")
        values = [
            input_value(declared, self.signals[declared.path], t)
            if declared.path in self.signals
            else kind(0)
            for declared in self.dae.inputs
        ]
        joined = ca.densify(ca.vertcat(kind(0, 1), *values))
        return ca.Function("model_inputs", [t], [joined, ca.densify(ca.jacobian(joined, t))], {"cse": True})

    def _tables(self) -> Tables:
        dae, tables = self.dae, Tables()
        sized = zip(("NX", "NZ", "NA", "NP"), (*self._moving, dae.p), strict=True)
        tables.sizes(**{name: symbols.numel() for name, symbols in sized})
        tables.sizes(NM=dae.modes.numel(), NI=dae.impulses.numel(), NK=dae.completion.numel())
        self._add_numbers(tables)
        self._add_inputs(tables)
        self._add_changes(tables)
        self._add_resets(tables)
        jump_tables(dae, tables)
        self._add_blocks(tables)
        self._add_patterns(tables)
        if self.start:
            start_tables(tables, self.start, dae.modes.numel())
        return tables

    def _add_numbers(self, tables: Tables) -> None:
        dae, table, start = self.dae, self.dae.parameters, self.dae.declared.start
        unknowns = [*dae.states, *dae.algebraic]
        parameters = table.defaults
        starts = [float(start[v]) if v < len(start) else 0.0 for v in unknowns]
        if not self.standalone:
            parameters, starts = [0.0] * len(parameters), [0.0] * len(starts)
        tables.doubles(
            parameter=parameters,
            start=starts,
            least=[_least(f) for f in table.fields],
            most=[np.inf if f.max is None else f.max for f in table.fields],
            nominal=nominal_sizes(dae, unknowns),
        )
        tables.integers(open=[f.above is not None for f in table.fields])
        tables.strings(
            parameter_name=list(table.index),
            parameter_unit=[f.unit for f in table.fields],
            unknown_name=[dae.name_of(v) for v in unknowns],
        )

    def _add_inputs(self, tables: Tables) -> None:
        """Add free inputs, from when until when all data built in are known, and legs."""
        limited = [s for s in self.signals.values() if isinstance(s, Sampled) and s.extrapolation == "none"]
        free, legs = self.free, self.legs
        place = {(i.path, i.order): k for k, i in enumerate(self.dae.inputs)}
        number = {(i.path, i.order): k for k, i in enumerate(free)}
        tables.sizes(NU=len(free), NW=len(self.variables), MODEL_LEGS=len(legs))
        tables.integers(
            input_at=[place[i.path, i.order] for i in free],
            input_sign=[i.sign for i in free],
            input_rate=[number.get((i.path, i.order + 1), -1) for i in free],
            input_order=[i.order for i in free],
            leg_jumps=[leg.jumps for leg in legs],
        )
        tables.strings(input_name=[i.path for i in free])
        tables.doubles(
            data_span=(
                max((float(s.time[0]) for s in limited), default=-np.inf),
                min((float(s.time[-1]) for s in limited), default=np.inf),
            ),
            leg_begin=[leg.begin for leg in legs],
            leg_end=[leg.end for leg in legs],
            leg_longest=[leg.max_step for leg in legs],
        )

    def _add_changes(self, tables: Tables) -> None:
        switching, changes = self.dae.switching, self.dae.switching.changes
        tables.sizes(NG=len(changes), NE=switching.expressions.numel(), NS=len(self._shocks))
        for name in ("mode", "source", "target", "indicator", "velocity", "after"):
            tables.integers(**{f"change_{name}": [getattr(c, name) for c in changes]})
        number = {id(c): k for k, c in enumerate(self._shocks)}
        stands_in = zip(switching.in_shock, switching.mode_values, strict=True)
        tables.integers(
            change_allowed=[-1 if c.allowed is None else c.allowed for c in changes],
            change_impulse=[-1 if c.impulse is None else c.impulse for c in changes],
            change_shock=[number.get(id(c), -1) for c in changes],
            change_timed=self._timed(),
            in_shock_start=_starts(switching.mode_values),
            in_shock=[table.get(k, -1) for table, values in stands_in for k in range(len(values))],
        )
        tables.strings(component=[c.component for c in changes], mode_name=switching.mode_names)

    def _add_resets(self, tables: Tables) -> None:
        changes = self.dae.switching.changes
        states = {v: k for k, v in enumerate(self.dae.states)}
        others = {v: k for k, v in enumerate(self._reset_variables)}
        resets = self._resets
        tables.sizes(NO=len(others))
        tables.integers(
            reset_start=_starts(c.resets for c in changes),
            reset_state=[states.get(r[0], -1) for r in resets],
            reset_other=[others.get(r[0], -1) for r in resets],
            reset_sign=[r[1] for r in resets],
            reset_value=[r[2] for r in resets],
        )

    def _timed(self) -> list[bool]:
        """Tell of each change whether time and inputs reach its indicator, be it by algebraic unknowns."""
        dae, count = self.dae, len(self.dae.switching.changes)
        given = ca.vertcat(dae.time, dae.u)
        if ca.depends_on(dae.alg, given):
            given = ca.vertcat(given, dae.z)
        rows = set(ca.jacobian_sparsity(self._indicators, given).row())
        return [k in rows for k in range(count)]

    def _add_blocks(self, tables: Tables) -> None:
        blocks, rates = self.dae.blocks, {upper for upper, _ in self.dae.derivative.values()}
        sizes = [len(block.torn) for block in blocks]
        tables.sizes(NB=len(sizes), BLOCK=max(sizes, default=0))
        tables.integers(block_size=sizes, block_rate=[v in rates for block in blocks for v in block.torn])
        tables.strings(block_label=[", ".join(block.labels) for block in blocks])

    def _add_patterns(self, tables: Tables) -> None:
        reduction = self._reduction
        size, led = len(reduction.kept), reduction.led_by
        tables.sparsity("slope", reduction.slopes)
        tables.sparsity("reduced", reduction.pattern)
        tables.sparsity("response", ca.jacobian_sparsity(self._motion, self.dae.impulses))
        tables.sparsity("velocity", ca.jacobian_sparsity(self._velocities, self.dae.x))
        tables.sparsity("other", ca.jacobian_sparsity(self._others, self.dae.x))
        tables.sizes(NF=size, NLED=len(led), MODEL_SPARSE=size > DENSE_SIZE)
        tables.integers(kept=reduction.kept, entry=reduction.places, led=led, leader=led.values())
        tables.factor(reduction.pattern if size > DENSE_SIZE else ca.Sparsity(0, 0))


def _least(field: Any) -> float:
    least = field.above if field.above is not None else field.min
    return -np.inf if least is None else float(least)


def _starts(parts: Iterable[Sized]) -> Ints:
    """Return where each part begins if they stand one after the other, and where the last one ends."""
    return np.cumsum([0, *map(len, parts)])
