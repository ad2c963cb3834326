"""Pieces: what is another polynomial between any two edges, written out or looked up."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array
from .component import Expression

Slopes = Callable[[Array, Array], Array]

MOST_WRITTEN = 32  # edges, up to which writing out all pieces costs less than looking one up
NAME = "looked_up_pieces"
DERIVATIVES = {"fwd1_": "forward", "adj1_": "reverse"}


@dataclass(frozen=True, eq=False)
class Pieces:
    """Polynomials between edges, and beyond the first and the last.

    Attributes:
        edges: where one ends and the next begins, increasing, (edges,).
        powers: coefficients by the power of the distance from the left edge of a piece, of the first piece
            from its right edge, (order + 1, edges + 1).
    """

    edges: Array
    powers: Array

    @classmethod
    def through(cls, x: Array, y: Array, slopes: Slopes | None = None) -> Pieces:
        """Return lines through points or, with slopes there, cubic pieces; beyond the ends lines go on."""
        h, rise = np.diff(x), np.diff(y) / np.diff(x)
        steep, inner = rise, [y[:-1], rise]
        if slopes:
            steep = slopes(x, y)
            first, last = steep[:-1], steep[1:]
            inner = [y[:-1], first, (3 * rise - 2 * first - last) / h, (first + last - 2 * rise) / h**2]
        beyond = np.zeros((2, len(inner)))
        beyond[:, :2] = (y[0], steep[0]), (y[-1], steep[-1])
        return cls(x, np.column_stack([beyond[0], np.array(inner), beyond[1]]))

    def value(self, at: Expression) -> Expression:
        """Return the value at a place: of many pieces by a function that looks up the right one."""
        place = ca.SX(at)
        if len(self.edges) <= MOST_WRITTEN:
            return self.written(place)
        return ca.SX(self._looked_up(ca.DM(place) if place.is_constant() else place))

    def area(self, at: Expression) -> Expression:
        """Return the area below the value, from 0."""
        below = self._integrated
        return below.value(at) - below.value(0.0)

    def written(self, at: Expression) -> Expression:
        """Return the value at a place as an expression that holds all pieces."""
        at, value, edges = ca.SX(at), ca.SX(0), ca.DM(self.edges)
        past = at - ca.pw_const(at, edges, ca.DM(self._origins))
        for power in self.powers[::-1]:
            value = value * past + ca.pw_const(at, edges, ca.DM(power))
        return value

    @property
    def _integrated(self) -> Pieces:
        orders = np.arange(1, len(self.powers) + 1)[:, None]
        powers = np.vstack([np.zeros(self.powers.shape[1]), self.powers / orders])
        passed = (powers[1:, 1:-1] * np.diff(self.edges) ** orders).sum(axis=0)
        powers[0, 2:] = np.cumsum(passed)
        return Pieces(self.edges, powers)

    @property
    def _origins(self) -> Array:
        """Where distances count from, by piece."""
        return np.append(self.edges[0], self.edges)

    @cached_property
    def _looked_up(self) -> Any:
        """A function of a place, which expressions call as it is.

        Lines have further powers of zero: CasADi takes what is looked up for a constant, so that slopes and
        bends would not be seen to depend on the place.
        """
        order, count = self.powers.shape
        rows = np.vstack([self._origins, self.powers, np.zeros((max(0, 4 - order), count))])
        at, value, table = ca.MX.sym("at"), ca.MX(0), ca.MX(ca.DM(rows))
        piece = ca.low(ca.DM(np.r_[-np.inf, self.edges, np.inf]), at, {"lookup_mode": "binary"})
        past = at - table[piece * len(rows)]
        for row in range(len(rows) - 1, 0, -1):
            value = value * past + table[piece * len(rows) + row]
        return ca.Function(NAME, [at], [value], {"never_inline": True})


def written_out(function: Any) -> Any:
    """Return a function with all the pieces that one looks up as an SX function; None if it looks up none.

    That may be a derivative, of any order, of one that does.
    """
    orders: list[str] = []
    name = function.name()
    while name[:5] in DERIVATIVES:
        orders, name = [DERIVATIVES[name[:5]], *orders], name[5:]
    table = _table(function) if name == NAME else None
    if table is None:
        return None
    at = ca.SX.sym("at")
    found = ca.Function(NAME, [at], [Pieces(table[0, 1:], table[1:]).written(at)])
    for derive in orders:
        found = getattr(found, derive)(1)
    return found


def calls(expression: Expression) -> bool:
    """Tell whether an expression calls a function, of which nothing but its numbers is known."""
    return bool(ca.Function("value", [], [expression], {"allow_free": True}).get_function())


def slopes_of(column: Expression, symbols: Expression) -> Expression:
    """Return the slopes of expressions in symbols, (expressions, symbols), dense.

    Where they call a function these come from its back, as forwards CasADi 3.8.2 calls it for the directions,
    too, in which it does not move, and what is constant is no longer seen to be.
    """
    if not calls(column):
        return ca.densify(ca.jacobian(column, symbols))
    return ca.vertcat(*(ca.densify(ca.gradient(row, symbols)).T for row in ca.vertsplit(column)))


def called(function: Any, operands: Sequence[Expression]) -> list[Expression]:
    """Return the entries of what a function makes of the entries of its arguments."""
    left = iter(operands)
    shapes = map(function.sparsity_in, range(function.n_in()))
    arguments = [ca.SX(shape, ca.vertcat(*islice(left, shape.nnz()))) for shape in shapes]
    results = function.call(arguments, False, not function.is_a("SXFunction"))  # others stay calls
    return [entry for result in results for entry in ca.vertsplit(result.nz[:])]


def _table(function: Any) -> Array | None:
    """Return the one matrix that a function holds: origins and powers, by piece."""
    places = [k for k in range(function.n_instructions()) if function.instruction_id(k) == ca.OP_CONST]
    held = (function.instruction_MX(k).to_DM() for k in places)
    return next((matrix.full() for matrix in held if min(matrix.shape) > 1), None)
