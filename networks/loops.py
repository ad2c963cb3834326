"""Loops: what differences of positions say about each other once the positions are eliminated.

Two elements side by side each state s_rel = s_b - s_a. Where nothing else determines s_a and s_b,
every equation finds an unknown of its own, and yet two s_rel that are states cannot be chosen
freely. So such equations are taken as the edges of a graph whose nodes are the unknowns, and an edge
that closes a loop is replaced by the sum around the loop, in which the unknowns cancel.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from .duplicates import without_duplicates
from .families import Family, Ints
from .index import System
from .union import SignedUnion
from .vectors import column

GROUND = -1
Equation = tuple[int, int]


@dataclass(frozen=True)
class _Edge:
    """An equation `sign_a a + sign_b b + ... = 0` between unknowns a and b (or the ground)."""

    equation: Equation
    a: int
    b: int
    sign_a: int
    sign_b: int

    def seen_from(self, here: int) -> tuple[int, int, int]:
        """Return the other end, the sign of this end and the sign of the other."""
        if here == self.a:
            return self.b, self.sign_a, self.sign_b
        return self.a, self.sign_b, self.sign_a


@dataclass(frozen=True)
class _Reached:
    """An unknown is `share` times its tree's root, less a weighted sum of equations."""

    share: int
    weights: dict[Equation, int]


def close_loops(system: System) -> None:
    """Replace the equations that close loops."""
    highest = system.is_root()
    highest[list(system.derivative)] = False
    highest[list(system.known)] = False
    edges = _in_loops([e for n, family in enumerate(system.families) for e in _edges(n, family, highest)])
    sums = _loop_sums(system, edges)
    for equation, weights in sums.items():
        summed = _summed(system, {**weights, equation: 1}, highest)
        system.families += without_duplicates(summed)
    for number in {number for number, _ in sums}:
        family, gone = system.families[number], [row for n, row in sums if n == number]
        system.families[number] = family.chosen(np.delete(np.arange(len(family)), gone))
    system.next_level += [{} for _ in sums]
    system.level += [0 for _ in sums]


def _edges(number: int, family: Family, highest: NDArray[np.bool_]) -> list[_Edge]:
    """Return the rows that hold one or two unknowns, with slopes of one."""
    unknown = highest[family.columns]
    few = np.flatnonzero(np.isin(unknown.sum(axis=1), (1, 2)))
    if not len(few):
        return []
    slopes = ca.jacobian(family.residual, family.locals)
    slope = np.array([float(s) if s.is_constant() else 0.0 for s in ca.horzsplit(ca.densify(slopes))])
    few = few[~(unknown[few] & (np.abs(slope) != 1)).any(axis=1)]
    places = np.argsort(~unknown[few], axis=1, kind="stable")
    there = np.take_along_axis(unknown[few], places, axis=1)
    columns = np.take_along_axis(family.columns[few], places, axis=1)
    signs = np.take_along_axis((slope * family.signs[few]).astype(int), places, axis=1)
    ends = _two(np.where(there, columns, GROUND), GROUND)
    turned = _two(np.where(there, signs, 1), 1)
    return [
        _Edge((number, row), *end, *turn)
        for row, end, turn in zip(few.tolist(), ends.tolist(), turned.tolist(), strict=True)
        if end[0] != end[1]
    ]


def _two(numbers: Ints, missing: int) -> Ints:
    """Return the first two columns."""
    return np.column_stack([numbers, np.full(len(numbers), missing)])[:, :2]


def _in_loops(edges: list[_Edge]) -> list[_Edge]:
    """Leave out edges that end at an unknown no other edge knows, until none is left of them."""
    ends = np.array([(e.a, e.b) for e in edges], dtype=np.int64).reshape(-1, 2)
    kept = np.arange(len(edges))
    while True:
        count = np.bincount(ends[kept].ravel() + 1)
        lone = ((count[ends[kept] + 1] == 1) & (ends[kept] != GROUND)).any(axis=1)
        if not lone.any():
            return [edges[i] for i in kept]
        kept = kept[~lone]


def _spanning(system: System, edges: list[_Edge]) -> set[Equation]:
    """Return the edges of a tree, those first whose other variables are differentiated most often.

    So a loop that is closed among such edges is told by them alone.
    """
    joined = SignedUnion(max((max(e.a, e.b) for e in edges), default=GROUND) + 2)
    tree = set()
    for edge in sorted(edges, key=lambda e: -_order(system, e)):
        (a, _), (b, _) = joined.find(edge.a + 1), joined.find(edge.b + 1)
        if a != b:
            joined.join(a, b)
            tree.add(edge.equation)
    return tree


def _order(system: System, edge: _Edge) -> float:
    """Return how often the least differentiated of an edge's other variables is differentiated."""
    number, row = edge.equation
    least = np.inf
    for variable in system.families[number].columns[row].tolist():
        count = 0
        if variable in (edge.a, edge.b) or variable in system.known:
            continue
        while variable in system.derivative:
            variable, count = system.derivative[variable][0], count + 1
        least = min(least, count)
    return least


def _reach(edges: list[_Edge], tree: set[Equation]) -> dict[int, _Reached]:
    """Write every unknown in terms of its tree's root."""
    at: dict[int, list[_Edge]] = defaultdict(list)
    for edge in edges:
        if edge.equation in tree:
            at[edge.a].append(edge)
            at[edge.b].append(edge)
    reached: dict[int, _Reached] = {}
    for start in sorted(at):
        if start in reached:
            continue
        reached[start] = _Reached(0 if start == GROUND else 1, {})
        todo = [start]
        while todo:
            here = todo.pop()
            for edge in at[here]:
                there, sign_here, sign = edge.seen_from(here)
                if there not in reached:
                    turned = -sign * sign_here
                    weights = {e: turned * w for e, w in reached[here].weights.items()}
                    weights[edge.equation] = sign
                    reached[there] = _Reached(turned * reached[here].share, weights)
                    todo.append(there)
    return reached


def _loop_sums(system: System, edges: list[_Edge]) -> dict[Equation, dict[Equation, int]]:
    """Return, for each edge that closes a loop, the other equations in the sum around it."""
    tree = _spanning(system, edges)
    reached = _reach(edges, tree)
    sums = {}
    for edge in edges:
        if edge.equation in tree:
            continue
        a, b = reached[edge.a], reached[edge.b]
        if edge.sign_a * a.share + edge.sign_b * b.share == 0:
            around = {e: -edge.sign_a * w for e, w in a.weights.items()}
            for e, w in b.weights.items():
                around[e] = around.get(e, 0) - edge.sign_b * w
            sums[edge.equation] = {e: w for e, w in around.items() if w}
    return sums


def _summed(system: System, weights: dict[Equation, int], highest: NDArray[np.bool_]) -> Family:
    """Return the weighted sum of equations as one equation; its unknowns cancel and are left out."""
    time = ca.SX.sym("time")
    residual = ca.SX(0)
    locals_, given, modes, arguments = [], [], [], []
    columns: list[int] = []
    signs: list[int] = []
    for (number, row), weight in weights.items():
        family = system.families[number]
        stays = ~highest[family.columns[row]]
        own = ca.SX.sym("local", family.locals.numel())
        own_given = ca.SX.sym("given", family.given.numel())
        function = ca.Function(
            "row", [family.locals, family.given, family.time], [family.residual, family.modes]
        )
        value, own_modes = function(own * ca.DM(stays.astype(float)), own_given, time)
        residual += weight * value
        locals_ += [own[i] for i in np.flatnonzero(stays).tolist()]
        given.append(own_given)
        modes.append(own_modes)
        arguments.append(family.arguments[:, row])
        columns += family.columns[row, stays].tolist()
        signs += family.signs[row, stays].tolist()
    labels = sorted({system.label(equation) for equation in weights})
    return Family(
        residual,
        column(locals_),
        column(given),
        time,
        _row(columns),
        _row(signs),
        column(arguments),
        lambda _: ", ".join(labels),
        column(modes),
    )


def _row(numbers: list[int]) -> Ints:
    return np.array(numbers, dtype=np.int64).reshape(1, -1)
