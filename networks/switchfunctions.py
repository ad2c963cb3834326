"""The compiled functions by which a run watches and changes modes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from .vectors import column

if TYPE_CHECKING:
    from .closed import Closed

NODES = 32


class SwitchFunctions:
    """Functions of (x, z, q, t) made once for a DAE and its inputs.

    Attributes:
        watch: indicators and their rates; `watch_nodes` the same at all nodes of a stretch.
        timed: whether time itself moves an indicator.
        everything: all switching expressions.
        motion: state derivatives.
        slopes: matrices of the blocks that depend on modes, one after the other, by columns.
        algebraic: residuals of the algebraic unknowns and their slopes.
        shock: what impulses do to states, and the slopes of the switching expressions in the states.
        sources, mode_of: per transition, the mode it leaves and whose mode it is.
    """

    def __init__(self, closed: Closed) -> None:
        dae = closed.dae
        changes = dae.switching.changes
        expressions = closed.close(dae.switching.expressions)
        indicators = expressions[[c.indicator for c in changes]]
        watched = indicators, closed.rate(indicators)
        self.watch = closed.compiled("watch", *watched)
        self.watch_nodes = closed.compiled("watch", *watched, instants=NODES + 1)
        self.timed = ca.depends_on(indicators, closed.t)
        self.everything = closed.compiled("switching", expressions)
        self.motion = closed.compiled("motion", closed.close(dae.ode))
        matrices = [ca.vec(ca.densify(block.matrix)) for block in dae.blocks]
        self.slopes = closed.compiled("slopes", closed.close(column(matrices)))
        residual = closed.close(dae.alg)
        self.algebraic = closed.compiled("algebraic", residual, ca.jacobian(residual, closed.z))
        self.shock = _shock(closed, expressions) if dae.impulses.numel() else None
        self.sources = np.array([c.source for c in changes])
        self.mode_of = np.array([c.mode for c in changes])


def _shock(closed: Closed, expressions: Any) -> Any:
    dae = closed.dae
    response = ca.jacobian(dae.ode, dae.impulses)
    if dae.z.numel():
        yielding = ca.solve(ca.jacobian(dae.alg, dae.z), ca.jacobian(dae.alg, dae.impulses))
        response = response - ca.mtimes(ca.jacobian(dae.ode, dae.z), yielding)
    response = closed.close(response)
    return closed.compiled("shock", response, ca.jacobian(expressions, closed.x))
