"""The compiled functions by which a run watches and changes modes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...flattening.vectors import column, pick

if TYPE_CHECKING:
    from ..bound_dae import BoundDAE

NODES = 64


class SwitchFunctions:
    """Functions of (x, z, q, t) made once for a DAE and its inputs.

    Attributes:
        watch: indicators and their rates; `watch_nodes` the same at all nodes of a stretch.
        timed: per transition, whether time itself moves its indicator.
        everything: all switching expressions.
        motion: state derivatives.
        slopes: matrices of the blocks that depend on modes, one after the other, by columns.
        algebraic: residuals of the algebraic unknowns and their slopes.
        shock: what impulses do to states, and the slopes of the switching expressions in the states.
        reset: variables that transitions reset and that are no states, and their slopes in the states.
        reset_of, state_of: the row of a variable in `reset`, in the states.
        is_rate: which joined variables are derivatives.
        sources, mode_of: per transition, the mode it leaves and whose mode it is.
    """

    def __init__(self, closed: BoundDAE) -> None:
        dae = closed.dae
        changes = dae.switching.changes
        expressions = closed.close(dae.switching.expressions)
        indicators = expressions[[c.indicator for c in changes]]
        watched = indicators, closed.rate(indicators)
        self.watch = closed.compiled("watch", *watched)
        self.watch_nodes = closed.compiled("watch", *watched, instants=NODES + 1)
        self.timed = np.isin(np.arange(len(changes)), ca.jacobian_sparsity(indicators, closed.t).row())
        self.everything = closed.compiled("switching", expressions)
        self.motion = closed.compiled("motion", closed.close(dae.ode))
        matrices = [ca.vec(ca.densify(block.matrix)) for block in dae.blocks]
        self.slopes = closed.compiled("slopes", closed.close(column(matrices)))
        residual = closed.close(dae.alg)
        self.algebraic = closed.compiled("algebraic", residual, ca.jacobian(residual, closed.z))
        self.shock = _shock(closed, expressions) if dae.impulses.numel() else None
        self.state_of = {variable: row for row, variable in enumerate(dae.states)}
        others = sorted({r[0] for c in changes for r in c.resets} - set(dae.states))
        self.reset_of = {variable: row for row, variable in enumerate(others)}
        values = closed.close(pick(dae.variables, others))
        self.reset = closed.compiled("reset", values, ca.jacobian(values, closed.x))
        self.is_rate = np.isin(
            np.arange(dae.variables.numel()), [upper for upper, _ in dae.derivative.values()]
        )
        self.sources = np.array([c.source for c in changes])
        self.mode_of = np.array([c.mode for c in changes])


def _shock(closed: BoundDAE, expressions: Any) -> Any:
    dae = closed.dae
    response = ca.jacobian(dae.ode, dae.impulses)
    if dae.z.numel():
        yielding = ca.solve(ca.jacobian(dae.alg, dae.z), ca.jacobian(dae.alg, dae.impulses))
        response = response - ca.mtimes(ca.jacobian(dae.ode, dae.z), yielding)
    response = closed.close(response)
    return closed.compiled("shock", response, ca.jacobian(expressions, closed.x))
