"""State selection: which derivatives the constraints determine.

Every differentiated equation turns one derivative into an ordinary unknown (a dummy derivative); the
variables whose derivatives remain are the states.
Source: S. Mattsson, G. Soderlind, SIAM J. Sci. Comput. 14 (1993) 677-692.
"""

from __future__ import annotations

from collections import defaultdict

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...base import ModelError
from ..flattening.families import padded
from .pantelides import System
from .singular import closed_loop

Equation = tuple[int, int]


def select_states(system: System) -> list[int]:
    """Return the variables that are states, in the order of their numbers."""
    lower = {upper: variable for variable, (upper, _) in system.derivative.items()}
    dummies: set[int] = set()
    levels = _levels(system)
    candidates: set[int] | None = None
    while levels:
        equations = [equation for equation, level in levels.items() if level > 0]
        if not equations:
            break
        chosen = _choose(system, equations, candidates, lower)
        dummies |= chosen
        candidates = {lower[v] for v in chosen if lower[v] in lower}
        levels = _one_level_down(system, equations)
    return sorted(
        variable
        for variable, (upper, _) in system.derivative.items()
        if variable not in system.known and upper not in dummies
    )


def _levels(system: System) -> dict[Equation, int]:
    """Return the highest version of every differentiated equation and how often it was."""
    return {
        (number, row): system.level[number]
        for number, family in enumerate(system.families)
        if system.level[number] > 0
        for row in range(len(family))
        if row not in system.next_level[number]
    }


def _one_level_down(system: System, equations: list[Equation]) -> dict[Equation, int]:
    previous = {
        later: (number, row) for number, table in enumerate(system.next_level) for row, later in table.items()
    }
    below = [previous[equation] for equation in equations]
    return {equation: system.level[equation[0]] for equation in below}


def _choose(
    system: System, equations: list[Equation], allowed: set[int] | None, lower: dict[int, int]
) -> set[int]:
    """Choose one derivative per equation, the least wanted as states first."""
    cells: dict[Equation, list[int]] = {}
    users: dict[int, set[Equation]] = defaultdict(set)
    for equation in equations:
        number, row = equation
        found = {int(v) for v in system.families[number].columns[row]}
        cells[equation] = [
            v for v in found
            if v in lower and v not in system.known and (allowed is None or v in allowed)
            and (allowed is not None or v not in system.derivative)
        ]  # fmt: skip
        for variable in cells[equation]:
            users[variable].add(equation)
    wish = {variable: _wish(system, variable, lower) for variable in users}
    chosen = _peel(cells, users, wish)
    for component in _components(cells):
        chosen |= _eliminate(system, component, cells, wish)
    return chosen


def _wish(system: System, variable: int, lower: dict[int, int]) -> tuple[float, int]:
    """Rank how much the variables below a derivative are wanted as states."""
    below = lower[variable]
    wanted = -1.0
    while True:
        if below < len(system.names.state):
            wanted = max(wanted, float(system.names.state[below]))
        if below not in lower:
            return wanted, variable
        below = lower[below]


def _peel(
    cells: dict[Equation, list[int]],
    users: dict[int, set[Equation]],
    wish: dict[int, tuple[float, int]],
) -> set[int]:
    """Take the derivatives that are least wanted in their equation and stand in no other."""
    chosen = set()
    todo = list(cells)
    while todo:
        equation = todo.pop()
        if equation not in cells:
            continue
        candidates = cells[equation]
        lone = [v for v in candidates if len(users[v]) == 1]
        if not lone:
            continue
        best = min(lone, key=wish.__getitem__)
        if wish[best][0] > min(wish[v][0] for v in candidates):
            continue
        chosen.add(best)
        del cells[equation]
        for variable in candidates:
            users[variable].discard(equation)
            todo.extend(users[variable])
    return chosen


def _components(cells: dict[Equation, list[int]]) -> list[list[Equation]]:
    """Split equations into groups that share no candidate."""
    leader: dict[int, Equation] = {}
    group: dict[Equation, list[Equation]] = {}
    home: dict[Equation, Equation] = {}
    for equation, variables in cells.items():
        home[equation] = equation
        group[equation] = [equation]
        for variable in variables:
            other = leader.setdefault(variable, equation)
            a, b = home[other], home[equation]
            if a != b:
                for member in group[b]:
                    home[member] = a
                group[a] += group.pop(b)
        for variable in variables:
            leader[variable] = equation
    return list(group.values())


def _eliminate(
    system: System,
    equations: list[Equation],
    cells: dict[Equation, list[int]],
    wish: dict[int, tuple[float, int]],
) -> set[int]:
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
        if strength[pivot] < 1e-9:
            continue
        factors = np.where(free, matrix[:, column] / matrix[pivot, column], 0.0)
        factors[pivot] = 0.0
        matrix = matrix - np.outer(factors, matrix[pivot])
        free[pivot] = False
        chosen.add(variable)
    if free.any():
        dependent = np.linalg.svd(slopes)[0][:, -1]
        names = sorted({system.label(equations[i]) for i in np.flatnonzero(np.abs(dependent) > 1e-6)})
        raise ModelError(f"'{system.flat.name}' is singular:", [closed_loop(names)])
    return chosen


def _slopes(system: System, equations: list[Equation], variables: list[int]) -> NDArray[np.float64]:
    """Return the equations' slopes in these derivatives, at the start values and slightly off."""
    unknowns = ca.SX.sym("v", system.size)
    by_family: dict[int, list[int]] = defaultdict(list)
    for place, (number, _) in enumerate(equations):
        by_family[number].append(place)
    rows: list[int] = []
    residuals, values = [], padded(unknowns)
    for number, places in by_family.items():
        family = system.families[number]
        places.sort(key=lambda place: equations[place][1])
        chosen = np.array([equations[p][1] for p in places], dtype=np.int64)
        residuals.append(family.evaluate(family.form.residual, chosen, values, system.flat.time).T)
        rows += places
    slopes = ca.jacobian(ca.vertcat(*residuals), unknowns[variables])
    flat = system.flat
    given = [unknowns, flat.table.symbols, flat.mode_symbols, flat.impulse_symbols, flat.time]
    random = np.random.default_rng(0)
    start = random.uniform(-0.01, 0.01, system.size)
    start[: len(system.names.start)] += system.names.start
    values = ca.Function("slopes", given, [slopes])(
        start, flat.table.defaults, [0] * len(flat.modes), [0] * len(flat.impulses), 0.1
    )
    matrix = np.zeros((len(equations), len(variables)))
    matrix[rows] = values.full()
    return matrix
