"""Tearing: solve a block of coupled equations for few unknowns, the rest following one by one.

A block whose slopes depend on modes (friction that sticks or slides) can lose rank in some of them:
two brakes that lock one shaft. It carries a matrix `completion`, zero as a rule, which the event
iteration sets so that the solution of least norm is found.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from .pantelides import System

Equation = tuple[int, int]
_Cells = dict[tuple[int, int], dict[int, "_Cell | None"]]


@dataclass(eq=False)
class Block:
    """Equations that must be solved together for as many variables."""

    equations: list[Equation]
    variables: list[int]


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
    pattern: tuple[int, ...]
    plain: bool
    hybrid: bool


def tear(system: System, block: Block, symbols: Any, small: int) -> Torn:
    """Solve a block, explicitly if its torn part is linear and no larger than `small`.

    `symbols` are all variables, as `padded` returns them.
    """
    cells = {e: _cells(system, e, set(block.variables)) for e in block.equations}
    follow, tears, rest = _order(system, block, cells)
    assigned = _explicit(system, follow, cells, symbols)
    residuals = [_residual(system, e, symbols) for e in rest]
    if assigned:
        targets = symbols[[v for v, _ in assigned]]
        definitions = ca.vertcat(*[x for _, x in assigned])
        _, residuals = ca.substitute_inplace([targets], [definitions], residuals)
    unknown = symbols[tears]
    residual = ca.vertcat(*residuals)
    matrix = ca.jacobian(residual, unknown)
    hybrid = any(cell is not None and cell.hybrid for e in rest for cell in cells[e].values())
    labels = sorted({system.label(e) for e in rest})
    shape = (len(tears), len(tears)) if hybrid else (0, 0)
    completion = ca.SX.sym("completion", *shape)
    completed = matrix + completion if hybrid else matrix
    explicit = not ca.depends_on(matrix, unknown) and len(tears) <= small
    if explicit:
        offset = ca.substitute(residual, unknown, ca.DM.zeros(len(tears)))
        solved = -ca.solve(ca.densify(completed), offset) if len(tears) > 1 else -offset / completed
        expressions = [*zip(tears, ca.vertsplit(solved), strict=True), *assigned]
        return Torn(expressions, [], [], matrix, completion, tears, hybrid, labels)
    left = ca.vertsplit(residual + (ca.mtimes(completion, unknown) if hybrid else 0))
    return Torn(assigned, tears, left, matrix, completion, tears, hybrid, labels)


def _cells(system: System, equation: Equation, variables: set[int]) -> dict[int, _Cell | None]:
    """Return, for each variable of the block in an equation, how it can be solved for."""
    number, row = equation
    family = system.families[number]
    form = family.form
    found: dict[int, _Cell | None] = {}
    for variable in {int(v) for v in family.columns[row]} & variables:
        marks = (family.columns[row] == variable) * family.signs[row]
        pattern = tuple(marks.tolist())
        slope = form.slope(pattern)
        if slope is None:
            found[variable] = None
            continue
        plain = isinstance(slope, float) or not ca.depends_on(slope, form.locals)
        found[variable] = _Cell(pattern, plain, form.is_hybrid(slope))
    return found


def _order(
    system: System, block: Block, cells: _Cells
) -> tuple[list[tuple[Equation, int]], list[int], list[Equation]]:
    """Choose torn variables until the others follow; return what follows, tears and residuals."""
    open_cells = {e: set(cells[e]) for e in block.equations}
    users: dict[int, set[Equation]] = {v: set() for v in block.variables}
    for e, variables in open_cells.items():
        for v in variables:
            users[v].add(e)
    follow: list[tuple[Equation, int]] = []
    tears: list[int] = []
    rest: list[Equation] = []
    ready = [e for e in block.equations if len(open_cells[e]) <= 1]

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
            cell = cells[e][variable]
            if cell is None or cell.hybrid or not cell.plain:
                continue
            del open_cells[e]
            follow.append((e, variable))
        else:
            variable = _next_tear(system, users, open_cells, cells)
            tears.append(variable)
        know(variable)
    rest = list(open_cells)
    return follow, tears, rest


def _next_tear(
    system: System,
    users: dict[int, set[Equation]],
    open_cells: dict[Equation, set[int]],
    cells: _Cells,
) -> int:
    """Prefer what a hybrid equation leaves open (a friction force), then what occurs most often."""

    def merit(variable: int) -> tuple[bool, bool, int, int]:
        places = [cells[e][variable] for e in users[variable] if e in open_cells]
        hybrid = any(c is not None and c.hybrid for c in places)
        curved = any(c is None or not c.plain for c in places)
        held = variable in system.held
        return hybrid and not held, curved and not held, len(places), -variable

    return max(users, key=merit)


def _explicit(
    system: System, follow: list[tuple[Equation, int]], cells: _Cells, symbols: Any
) -> list[tuple[int, Any]]:
    """Solve each equation for its variable, those of one form at once; keep their order."""
    alike: dict[tuple[int, tuple[int, ...]], list[tuple[int, int]]] = defaultdict(list)
    for place, ((number, row), variable) in enumerate(follow):
        cell = cells[number, row][variable]
        assert cell is not None
        alike[number, cell.pattern].append((row, place))
    values: list[Any] = [None] * len(follow)
    for (number, pattern), members in alike.items():
        rows, places = zip(*sorted(members), strict=True)
        found = system.families[number].solved(pattern, np.array(rows), symbols, system.flat.time)
        assert found is not None
        for place, value in zip(places, ca.horzsplit(found), strict=True):
            values[place] = value
    return [(variable, value) for (_, variable), value in zip(follow, values, strict=True)]


def _residual(system: System, equation: Equation, symbols: Any) -> Any:
    family, row = system.families[equation[0]], np.array(equation[1:])
    return family.evaluate(family.form.residual, row, symbols, system.flat.time)
