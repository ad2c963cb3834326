"""Tearing: solve a block of coupled equations for few unknowns, the rest following one by one.

A block whose slopes depend on modes (friction that sticks or slides) can lose rank in some of them:
two brakes that lock one shaft. It carries a matrix `completion`, zero as a rule, which the event
iteration sets so that the solution of least norm is found.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca
import numpy as np

from ...base import Flags
from ..flattening.instructions import put_in
from .pantelides import Equation, System

EXPLICIT_SIZE = 8  # torn variables up to which a linear block is solved symbolically
LEAST_SLOPE = 1e-12  # of an equation in a variable for which it is solved


@dataclass(eq=False)
class Torn:
    """A solved block.

    Attributes:
        expressions: variables and what they are, in the order in which they follow.
        algebraic: variables that stay unknown.
        residuals: the equations that determine them.
        matrix: slopes of the torn equations in the torn variables.
        completion: what is added to that matrix.
        torn: the torn variables.
        hybrid: whether the matrix depends on modes.
        labels: the components concerned.
    """

    expressions: list[tuple[int, Any]]
    algebraic: list[int]
    residuals: list[Any]
    matrix: Any
    completion: Any
    torn: list[int]
    hybrid: bool
    labels: list[str]


@dataclass(eq=False)
class _Cell:
    """A variable in an equation: its symbols, whether its slope varies (or is zero), or depends on modes."""

    pattern: tuple[int, ...]
    curved: bool
    hybrid: bool


_Cells = dict[Equation, dict[int, _Cell]]


class ZeroSlopes:
    """Where slopes that parameters alone make are zero as these stand, found once for all of a form."""

    def __init__(self, system: System, symbols: Any) -> None:
        self._system, self._symbols = system, symbols
        self.of_form = cache(self._of_form)

    def _of_form(self, number: int, pattern: tuple[int, ...]) -> Flags:
        """Tell of each equation of a family whether its slope is zero in what a pattern stands for."""
        family, flat = self._system.families[number], self._system.flat
        slope = family.form.slope(pattern)
        slopes = family.evaluate(slope, np.arange(len(family)), self._symbols, flat.time)
        found = ca.Function("slopes", [flat.table.symbols, flat.time], [slopes])(flat.table.defaults, 0.0)
        return np.asarray(np.abs(found.full().ravel()) < LEAST_SLOPE)


def tear(
    system: System, equations: list[Equation], variables: list[int], symbols: Any, zero: ZeroSlopes
) -> Torn:
    """Solve equations for as many variables, explicitly if what is torn is linear and small.

    `symbols` are all variables, as `padded` returns them.
    """
    cells = {e: _cells(system, e, set(variables), zero) for e in equations}
    follow, tears, rest = _order(system, variables, cells)
    assigned = _explicit(system, follow, cells, symbols)
    residuals = [system.residual(e, symbols) for e in rest]
    if assigned:
        targets = symbols[[v for v, _ in assigned]]
        definitions = ca.vertcat(*[x for _, x in assigned])
        _, residuals = put_in(targets, definitions, residuals, system.calls)
    unknown = symbols[tears]
    residual = ca.vertcat(*residuals)
    matrix = ca.jacobian(residual, unknown)
    hybrid = any(cell.hybrid for e in rest for cell in cells[e].values())
    labels = sorted({system.label(e) for e in rest})
    size = len(tears) if hybrid else 0
    completion = ca.SX.sym("completion", size, size)
    completed = matrix + completion if hybrid else matrix
    if len(tears) <= EXPLICIT_SIZE and not ca.depends_on(matrix, unknown):
        offset = ca.substitute(residual, unknown, ca.DM.zeros(len(tears)))
        solved = -ca.solve(ca.densify(completed), offset) if len(tears) > 1 else -offset / completed
        expressions = [*zip(tears, ca.vertsplit(solved), strict=True), *assigned]
        return Torn(expressions, [], [], matrix, completion, tears, hybrid, labels)
    left = ca.vertsplit(residual + (ca.mtimes(completion, unknown) if hybrid else 0))
    return Torn(assigned, tears, left, matrix, completion, tears, hybrid, labels)


def _cells(system: System, equation: Equation, variables: set[int], zero: ZeroSlopes) -> dict[int, _Cell]:
    """Return, for each variable of the block in an equation, how it can be solved for."""
    number, row = equation
    family = system.families[number]
    form = family.form
    found: dict[int, _Cell] = {}
    for variable in variables.intersection(family.columns[row].tolist()):
        pattern = tuple(((family.columns[row] == variable) * family.signs[row]).tolist())
        slope = form.slope(pattern)
        curved = slope is None or (not isinstance(slope, float) and ca.depends_on(slope, form.locals))
        hybrid = slope is not None and form.is_hybrid(slope)
        if not (curved or hybrid or isinstance(slope, float)):
            curved = bool(zero.of_form(number, pattern)[row])
        found[variable] = _Cell(pattern, curved, hybrid)
    return found


def _order(
    system: System, variables: list[int], cells: _Cells
) -> tuple[list[tuple[Equation, int]], list[int], list[Equation]]:
    """Choose torn variables until the others follow; return what follows, tears and residuals."""
    open_cells = {e: set(cells[e]) for e in cells}
    users: dict[int, set[Equation]] = {v: set() for v in variables}
    for e, held in open_cells.items():
        for v in held:
            users[v].add(e)
    follow: list[tuple[Equation, int]] = []
    tears: list[int] = []
    ready = [e for e in cells if len(open_cells[e]) <= 1]

    def know(variable: int) -> None:
        for e in users[variable]:
            if e in open_cells:
                open_cells[e].discard(variable)
                if len(open_cells[e]) <= 1:
                    ready.append(e)
        del users[variable]

    while users:
        if ready:
            e = ready.pop()
            if e not in open_cells or len(open_cells[e]) != 1:
                continue
            variable = next(iter(open_cells[e]))
            if cells[e][variable].hybrid or cells[e][variable].curved:
                continue
            del open_cells[e]
            follow.append((e, variable))
        else:
            variable = _next_tear(system, users, open_cells, cells)
            tears.append(variable)
        know(variable)
    return follow, tears, list(open_cells)


def _next_tear(
    system: System, users: dict[int, set[Equation]], open_cells: dict[Equation, set[int]], cells: _Cells
) -> int:
    """Prefer what a hybrid equation leaves open (a friction force), then what occurs most often."""

    def merit(variable: int) -> tuple[bool, bool, int, int]:
        places = [cells[e][variable] for e in users[variable] if e in open_cells]
        free = variable not in system.held
        hybrid, curved = any(c.hybrid for c in places), any(c.curved for c in places)
        return free and hybrid, free and curved, len(places), -variable

    return max(users, key=merit)


def _explicit(
    system: System, follow: list[tuple[Equation, int]], cells: _Cells, symbols: Any
) -> list[tuple[int, Any]]:
    """Solve each equation for its variable, those of one form at once; keep their order."""
    alike: dict[tuple[int, tuple[int, ...]], list[tuple[int, int]]] = defaultdict(list)
    for place, ((number, row), variable) in enumerate(follow):
        alike[number, cells[number, row][variable].pattern].append((row, place))
    values: list[Any] = [None] * len(follow)
    for (number, pattern), members in alike.items():
        rows, places = zip(*sorted(members), strict=True)
        found = system.families[number].solved(pattern, np.array(rows), symbols, system.flat.time)
        assert found is not None
        for place, value in zip(places, ca.horzsplit(found), strict=True):
            values[place] = value
    return [(variable, value) for (_, variable), value in zip(follow, values, strict=True)]
