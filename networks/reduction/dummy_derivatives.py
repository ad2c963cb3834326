"""State selection: which derivatives the constraints determine.

Every differentiated equation turns one derivative into an ordinary unknown (a dummy derivative); the
variables whose derivatives remain are the states.
Source: S. Mattsson, G. Soderlind, SIAM J. Sci. Comput. 14 (1993) 677-692.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import groupby
from operator import itemgetter

import casadi as ca
import numpy as np

from ...base import Array, ModelError
from ..flattening.families import padded
from .pantelides import Equation, System
from .singular import closed_loop, grouped

INDEPENDENT = 1e-9  # share of an equation's greatest slope below which a derivative does not solve it
DEPENDENT = 1e-6  # share of an equation in what makes it and others say the same
_Cells = dict[Equation, list[int]]  # the derivatives in each equation that may be chosen
_Wishes = dict[int, tuple[float, int]]


def select_states(system: System) -> list[int]:
    """Return the variables that are states, in the order of their numbers."""
    lower = {upper: variable for variable, (upper, _) in system.derivative.items()}
    previous = {
        later: (number, row) for number, table in enumerate(system.next_level) for row, later in table.items()
    }
    equations = [
        (n, row) for n, row in system.equations() if system.level[n] and row not in system.next_level[n]
    ]
    dummies: set[int] = set()
    candidates = lower.keys() - system.derivative.keys()
    while equations:
        chosen = _choose(system, equations, candidates - system.known.keys(), lower)
        dummies |= chosen
        candidates = {lower[v] for v in chosen if lower[v] in lower}
        equations = [e for e in (previous[e] for e in equations) if system.level[e[0]]]
    return sorted(
        variable
        for variable, (upper, _) in system.derivative.items()
        if variable not in system.known and upper not in dummies
    )


def _choose(
    system: System, equations: list[Equation], candidates: set[int], lower: dict[int, int]
) -> set[int]:
    """Choose one derivative per equation, the least wanted as states first."""
    columns = {(n, row): system.families[n].columns[row].tolist() for n, row in equations}
    cells = {equation: [*candidates.intersection(held)] for equation, held in columns.items()}
    users: dict[int, set[Equation]] = defaultdict(set)
    for equation, variables in cells.items():
        for variable in variables:
            users[variable].add(equation)
    wish = {variable: _wish(system, variable, lower) for variable in users}
    chosen = _peel(cells, users, wish)
    for coupled in grouped(sorted(cells), cells.__getitem__):
        chosen |= _eliminate(system, coupled, cells, wish)
    return chosen


def _wish(system: System, variable: int, lower: dict[int, int]) -> tuple[float, int]:
    """Rank how much the variables below a derivative are wanted as states."""
    below, wanted = variable, -1.0
    while (below := lower.get(below, -1)) >= 0:
        if below < len(system.names.state):
            wanted = max(wanted, float(system.names.state[below]))
    return wanted, variable


def _peel(cells: _Cells, users: dict[int, set[Equation]], wish: _Wishes) -> set[int]:
    """Take the derivatives that are least wanted in their equation and stand in no other."""
    chosen = set()
    todo = list(cells)
    while todo:
        equation = todo.pop()
        candidates = cells.get(equation, [])
        lone = [v for v in candidates if len(users[v]) == 1]
        best = min(lone, key=wish.__getitem__, default=None)
        if best is None or wish[best][0] > min(wish[v][0] for v in candidates):
            continue
        chosen.add(best)
        del cells[equation]
        for variable in candidates:
            users[variable].discard(equation)
            todo.extend(users[variable])
    return chosen


def _eliminate(system: System, equations: list[Equation], cells: _Cells, wish: _Wishes) -> set[int]:
    """Choose a nonsingular set of columns by elimination, least wanted first."""
    variables = sorted({v for e in equations for v in cells[e]}, key=wish.__getitem__)
    slopes = _slopes(system, equations, variables)
    scale = np.abs(slopes).max(axis=1, keepdims=True)
    matrix = slopes = slopes / np.where(scale > 0, scale, 1)
    chosen: set[int] = set()
    free = np.ones(len(equations), dtype=bool)
    for column, variable in enumerate(variables):
        if not free.any():
            break
        strength = np.abs(matrix[:, column]) * free
        pivot = int(strength.argmax())
        if strength[pivot] < INDEPENDENT:
            continue
        factors = np.where(free, matrix[:, column] / matrix[pivot, column], 0.0)
        factors[pivot] = 0.0
        matrix = matrix - np.outer(factors, matrix[pivot])
        free[pivot] = False
        chosen.add(variable)
    if free.any():
        dependent = np.linalg.svd(slopes)[0][:, -1]
        names = sorted({system.label(equations[i]) for i in np.flatnonzero(np.abs(dependent) > DEPENDENT)})
        raise ModelError(f"'{system.flat.name}' is singular:", [closed_loop(names)])
    return chosen


def _slopes(system: System, equations: list[Equation], variables: list[int]) -> Array:
    """Return the equations' slopes in these derivatives, at the start values and slightly off."""
    flat, unknowns = system.flat, ca.SX.sym("v", system.size)
    residuals, values = [], padded(unknowns)
    for number, members in groupby(equations, key=itemgetter(0)):
        family, rows = system.families[number], np.array([row for _, row in members])
        residuals.append(family.evaluate(family.form.residual, rows, values, flat.time).T)
    slopes = ca.jacobian(ca.vertcat(*residuals), unknowns[variables])
    given = [unknowns, flat.table.symbols, flat.mode_symbols, flat.impulse_symbols, flat.time]
    start = np.random.default_rng(0).uniform(-0.01, 0.01, system.size)
    start[: len(system.names.start)] += system.names.start
    numbers = ca.Function("slopes", given, [slopes])(
        start, flat.table.defaults, [0] * len(flat.modes), [0] * len(flat.impulses), 0.1
    )
    found: Array = numbers.full()
    return found
