"""Model: a DAE as C text, `model.h` and `model.c`: functions by CasADi, tables by us.

Every function reads (x, z, u, q, t): u holds all inputs and their derivatives, q all that is
constant between events. Inputs bound to a signal come from a function of time alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from ...components.language import Sampled
from ..dae import DAE, Input
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

DENSE = 32


@dataclass(frozen=True, eq=False)
class Model:
    """The functions of a network, ready to be written as C.

    Attributes:
        signals: signal of every bound input by name; the others are free.
        variables: names of what is published besides the states.
        legs: parts of a run between instants at which signals switch; none if a run brings its own.
        products: whether derivative products are wanted, which are long.
        start: where it starts from, if it is to find that by itself.
    """

    dae: DAE
    signals: dict[str, Any]
    variables: Sequence[str]
    legs: Sequence[Leg]
    products: bool = True
    start: Start | None = None

    @property
    def free(self) -> list[Input]:
        """Inputs and derivatives of inputs that are set from outside."""
        return [declared for declared in self.dae.inputs if declared.path not in self.signals]

    def texts(self) -> dict[str, str]:
        """Return model.h and model.c."""
        functions = self.functions()
        tables = self._tables()
        text, work = generated(functions)
        tables.size("MODEL_ARGS", max(f.sz_arg() for f in functions))
        tables.size("MODEL_RESULTS", max(f.sz_res() for f in functions))
        tables.size("MODEL_INTEGERS", max(f.sz_iw() for f in functions))
        tables.size("MODEL_WORK", work)
        names = [f.name() for f in functions]
        return {
            "model.h": tables.header(self.dae.name, names),
            "model.c": tables.source() + text,
        }

    def functions(self) -> list[Any]:
        """Return the CasADi functions, named as in C."""
        dae = self.dae
        changes, expressions = dae.switching.changes, dae.switching.expressions
        indicators = pick(expressions, [c.indicator for c in changes])
        motion = ca.vertcat(dae.ode, dae.alg)
        x_rate, z_rate, u_rate = (
            ca.SX.sym(f"{n}_rate", s.numel()) for n, s in zip("xzu", self._moving(), strict=True)
        )
        rates = [x_rate, z_rate, u_rate]
        shocks = [c for c in changes if c.impulse is not None]
        velocities = pick(expressions, [c.velocity for c in shocks])
        others = pick(dae.variables, self._reset_variables())
        published = column([dae.expression(name) for name in self.variables])
        by_time = ca.jtimes(motion, dae.u, u_rate) + ca.jacobian(motion, dae.time)
        slope = ca.project(ca.jacobian(motion, ca.vertcat(dae.x, dae.z)), Reduction(dae).slopes)
        blocks = column([ca.vec(ca.densify(block.matrix)) for block in dae.blocks])
        return [
            self._inputs(),
            self._function("model_motion", [], [ca.densify(motion)]),
            self._function("model_slope", [u_rate], [_sparse(slope), ca.densify(by_time)]),
            self._function(
                "model_watch", rates, [ca.densify(indicators), ca.densify(self._moved(indicators, rates))]
            ),
            self._function("model_switch", [], [ca.densify(expressions)]),
            self._function("model_blocks", [], [ca.densify(blocks)]),
            self._function(
                "model_shock",
                [],
                [_sparse(ca.jacobian(motion, dae.impulses)), _sparse(ca.jacobian(velocities, dae.x))],
            ),
            self._function("model_reset", [], [ca.densify(others), _sparse(ca.jacobian(others, dae.x))]),
            self._function("model_variables", [], [ca.densify(published)]),
            *jump_functions(dae, self._function),
            *(self._products(motion, published) if self.products else []),
            *(start_functions(self.start, dae.arguments()) if self.start else []),
        ]

    def _moving(self) -> tuple[Any, Any, Any]:
        return self.dae.x, self.dae.z, self.dae.u

    def _moved(self, expressions: Any, rates: list[Any]) -> Any:
        """Return the time derivative of expressions for given rates."""
        moved = ca.jacobian(expressions, self.dae.time)
        for symbol, rate in zip(self._moving(), rates, strict=True):
            moved = moved + ca.jtimes(expressions, symbol, rate)
        return moved

    def _products(self, motion: Any, published: Any) -> list[Any]:
        """Return forward and reverse derivatives of motion and variables in x, z, u and p.

        Where a law has no slope in a parameter, as a power of zero in its exponent, directions in which
        parameters stay have one all the same: the last argument says whether any parameter moves.
        """
        dae = self.dae
        results = ca.vertcat(motion, published)
        of = [*self._moving(), dae.p]
        seeds = [ca.SX.sym(f"seed{k}", s.numel()) for k, s in enumerate(of)]
        *moved, by_parameters = (ca.densify(ca.jtimes(results, s, d)) for s, d in zip(of, seeds, strict=True))
        tuned = ca.SX.sym("tuned")
        forward = sum(moved, ca.if_else(tuned, by_parameters, 0))
        weights = ca.SX.sym("weights", results.numel())
        reverse = [ca.densify(ca.jtimes(results, s, weights, True)) for s in of]
        return [
            self._function("model_forward", [*seeds, tuned], [ca.densify(forward)]),
            self._function("model_adjoint", [weights], reverse),
        ]

    def _function(self, name: str, more: list[Any], results: list[Any]) -> Any:
        return ca.Function(name, [*self.dae.arguments(), *more], results, {"cse": True})

    def _inputs(self) -> Any:
        """Return bound inputs and their rates as a function of time; zero where inputs are free."""
        sampled = any(isinstance(signal, Sampled) for signal in self.signals.values())
        kind: Any = ca.MX if sampled else ca.SX
        t = kind.sym("t")
        values = []
        for declared in self.dae.inputs:
            value = kind(0)
            if declared.path in self.signals:
                value = input_value(declared, self.signals[declared.path], t)
            values.append(value)
        joined = ca.densify(ca.vertcat(kind(0, 1), *values))
        return ca.Function("model_inputs", [t], [joined, ca.densify(ca.jacobian(joined, t))], {"cse": True})

    def _reset_variables(self) -> list[int]:
        """Return the variables that transitions reset and that are no states."""
        resets = {r[0] for c in self.dae.switching.changes for r in c.resets}
        return sorted(resets - set(self.dae.states))

    def _tables(self) -> Tables:
        dae = self.dae
        tables = Tables()
        for name, count in (
            ("NX", dae.x),
            ("NZ", dae.z),
            ("NA", dae.u),
            ("NP", dae.p),
            ("NM", dae.modes),
            ("NI", dae.impulses),
            ("NK", dae.completion),
        ):
            tables.size(name, count.numel())
        tables.size("NU", len(self.free))
        tables.size("NW", len(self.variables))
        self._numbers(tables)
        self._inputs_tables(tables)
        self._legs(tables)
        self._changes(tables)
        jump_tables(dae, tables)
        self._blocks(tables)
        self._patterns(tables)
        if self.start:
            start_tables(tables, self.start, dae.modes.numel())
        return tables

    def _numbers(self, tables: Tables) -> None:
        dae, table = self.dae, self.dae.parameters
        start = dae.declared.start
        tables.doubles("model_parameter", table.defaults)
        tables.doubles("model_least", [_least(f) for f in table.fields])
        tables.doubles("model_most", [np.inf if f.max is None else f.max for f in table.fields])
        tables.integers("model_open", [f.above is not None for f in table.fields])
        tables.strings("model_parameter_name", list(table.index))
        tables.strings("model_parameter_unit", [f.unit for f in table.fields])
        tables.doubles(
            "model_start", [float(start[v]) if v < len(start) else 0.0 for v in (*dae.states, *dae.algebraic)]
        )
        tables.doubles("model_nominal", nominal_sizes(dae, [*dae.states, *dae.algebraic]))
        tables.strings("model_unknown_name", [dae.name_of(v) for v in (*dae.states, *dae.algebraic)])

    def _data_span(self) -> tuple[float, float]:
        """Return from when until when all data built in are known [s]."""
        limited = [s for s in self.signals.values() if isinstance(s, Sampled) and s.extrapolation == "none"]
        begin = max((float(s.time[0]) for s in limited), default=-np.inf)
        return begin, min((float(s.time[-1]) for s in limited), default=np.inf)

    def _inputs_tables(self, tables: Tables) -> None:
        tables.doubles("model_data_span", self._data_span())
        free, place = self.free, {(i.path, i.order): k for k, i in enumerate(self.dae.inputs)}
        tables.integers("model_input_at", [place[i.path, i.order] for i in free])
        tables.integers("model_input_sign", [i.sign for i in free])
        number = {(i.path, i.order): k for k, i in enumerate(free)}
        tables.integers("model_input_rate", [number.get((i.path, i.order + 1), -1) for i in free])
        tables.integers("model_input_order", [i.order for i in free])
        tables.strings("model_input_name", [i.path for i in free])

    def _legs(self, tables: Tables) -> None:
        tables.size("MODEL_LEGS", len(self.legs))
        tables.doubles("model_leg_begin", [leg.begin for leg in self.legs])
        tables.doubles("model_leg_end", [leg.end for leg in self.legs])
        tables.doubles("model_leg_longest", [leg.max_step for leg in self.legs])
        tables.integers("model_leg_jumps", [leg.jumps for leg in self.legs])

    def _changes(self, tables: Tables) -> None:
        switching, states = self.dae.switching, {v: k for k, v in enumerate(self.dae.states)}
        changes = switching.changes
        others = {v: k for k, v in enumerate(self._reset_variables())}
        tables.size("NG", len(changes))
        tables.size("NE", switching.expressions.numel())
        tables.size("NO", len(others))
        for name in ("mode", "source", "target", "indicator", "velocity", "after"):
            tables.integers(f"model_change_{name}", [getattr(c, name) for c in changes])
        tables.integers("model_change_allowed", [-1 if c.allowed is None else c.allowed for c in changes])
        tables.integers("model_change_impulse", [-1 if c.impulse is None else c.impulse for c in changes])
        shocks = iter(range(len(changes)))
        tables.integers("model_change_shock", [-1 if c.impulse is None else next(shocks) for c in changes])
        tables.size("NS", sum(c.impulse is not None for c in changes))
        starts = np.cumsum([0, *(len(c.resets) for c in changes)])
        resets = [r for c in changes for r in c.resets]
        tables.integers("model_reset_start", starts.tolist())
        tables.integers("model_reset_state", [states.get(r[0], -1) for r in resets])
        tables.integers("model_reset_other", [others.get(r[0], -1) for r in resets])
        tables.integers("model_reset_sign", [r[1] for r in resets])
        tables.integers("model_reset_value", [r[2] for r in resets])
        tables.integers("model_change_timed", self._timed(changes))
        tables.integers(
            "model_in_shock_start", np.cumsum([0, *(len(v) for v in switching.mode_values)]).tolist()
        )
        tables.integers(
            "model_in_shock",
            [
                t.get(k, -1)
                for t, v in zip(switching.in_shock, switching.mode_values, strict=True)
                for k in range(len(v))
            ],
        )
        tables.strings("model_component", [c.component for c in changes])
        tables.strings("model_mode_name", switching.mode_names)

    def _timed(self, changes: Any) -> list[bool]:
        """Tell of each change whether time and inputs reach its indicator, be it by algebraic unknowns."""
        if not changes:
            return []
        dae = self.dae
        indicators = pick(dae.switching.expressions, [c.indicator for c in changes])
        given = [dae.time, dae.u]
        if any(ca.depends_on(dae.alg, symbol) for symbol in given):
            given.append(dae.z)
        rows = set(ca.jacobian_sparsity(indicators, ca.vertcat(*given)).row())
        return [k in rows for k in range(len(changes))]

    def _blocks(self, tables: Tables) -> None:
        dae = self.dae
        rates = {upper for upper, _ in dae.derivative.values()}
        sizes = [len(block.torn) for block in dae.blocks]
        tables.size("NB", len(sizes))
        tables.size("BLOCK", max(sizes, default=0))
        tables.integers("model_block_size", sizes)
        tables.integers("model_block_rate", [v in rates for block in dae.blocks for v in block.torn])
        tables.strings("model_block_label", [", ".join(block.labels) for block in dae.blocks])

    def _patterns(self, tables: Tables) -> None:
        dae = self.dae
        reduction = Reduction(dae)
        tables.sparsity("model_slope", "NSLOPE", reduction.slopes)
        tables.size("NF", len(reduction.kept))
        tables.sparsity("model_reduced", "NREDUCED", reduction.pattern)
        tables.integers("model_kept", reduction.kept)
        tables.integers("model_entry", reduction.places)
        tables.size("NLED", len(reduction.led_by))
        tables.integers("model_led", list(reduction.led_by))
        tables.integers("model_leader", list(reduction.led_by.values()))
        motion = ca.vertcat(dae.ode, dae.alg)
        tables.sparsity("model_response", "NRESPONSE", ca.jacobian_sparsity(motion, dae.impulses))
        shocks = [c.velocity for c in dae.switching.changes if c.impulse is not None]
        tables.sparsity(
            "model_velocity",
            "NVELOCITY",
            ca.jacobian_sparsity(pick(dae.switching.expressions, shocks), dae.x),
        )
        others = pick(dae.variables, self._reset_variables())
        tables.sparsity("model_other", "NOTHER", ca.jacobian_sparsity(others, dae.x))
        large = len(reduction.kept) > DENSE
        tables.size("MODEL_SPARSE", int(large))
        tables.factor(reduction.pattern if large else None)


def _least(field: Any) -> float:
    least = field.above if field.above is not None else field.min
    return -np.inf if least is None else float(least)


def _sparse(matrix: Any) -> Any:
    """Return the nonzeros of a matrix as a full column."""
    return ca.densify(matrix.nz[:]) if matrix.nnz() else ca.SX(0, 1)
