"""Loops: what differences of positions say about each other once the positions are eliminated.

Two elements side by side each state s_rel = s_b - s_a. Where nothing else determines s_a and s_b,
every equation finds an unknown of its own, and yet two s_rel that are states cannot be chosen
freely. So such equations are taken as the edges of a graph whose nodes are the unknowns, and an edge
that closes a loop is replaced by the sum around the loop, in which the unknowns cancel.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from ...base import Flags, Ints
from ..flattening.families import Family, without_duplicates
from ..flattening.forms import Form
from ..flattening.union import SignedUnion
from ..flattening.vectors import column
from .pantelides import Equation, System

GROUND = -1


@dataclass(frozen=True)
class _Edge:
    """An equation `sign_a a + sign_b b + ... = 0` between unknowns a and b (or the ground)."""

    equation: Equation
    a: int
    b: int
    sign_a: int
    sign_b: int


@dataclass(frozen=True)
class _Reached:
    """An unknown is `share` times its tree's root, less a weighted sum of equations."""

    share: int
    weights: dict[Equation, int]


def close_loops(system: System) -> None:
    """Replace the equations that close loops."""
    highest = system.highest()
    edges = _edges(system, highest)
    sums = _loop_sums(system, edges)
    for equation, weights in sums.items():
        system.families += without_duplicates(_summed(system, {**weights, equation: 1}, highest))
    for number in {number for number, _ in sums}:
        family, gone = system.families[number], [row for n, row in sums if n == number]
        system.families[number] = family.chosen(np.delete(np.arange(len(family)), gone))
    system.next_level += [{} for _ in sums]
    system.level += [0] * len(sums)


def _edges(system: System, highest: Flags) -> list[_Edge]:
    """Return the equations that hold one or two unknowns, with slopes of one, and may close loops."""
    numbers, rows, ends = (np.concatenate(part) for part in zip(*_ends(system, highest), strict=True))
    edges = []
    for i in _in_loops(ends):
        number, row, (a, b) = int(numbers[i]), int(rows[i]), ends[i].tolist()
        family = system.families[number]
        slopes = dict(zip(family.columns[row].tolist(), family.form.numbers * family.signs[row], strict=True))
        signs = [slopes.get(end, 1) for end in (a, b)]
        if set(signs) <= {-1, 1}:
            edges.append(_Edge((number, row), a, b, *map(int, signs)))
    return [edges[i] for i in _in_loops(np.array([(e.a, e.b) for e in edges], dtype=np.int64).reshape(-1, 2))]


def _ends(system: System, highest: Flags) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Yield, of the equations that hold one or two unknowns, family, row and unknowns, ground for none."""
    yield np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2), np.int64)
    for number, family in enumerate(system.families):
        unknown = highest[family.columns]
        count = unknown.sum(axis=1)
        rows = np.flatnonzero((count == 1) | (count == 2))
        found = np.where(unknown[rows], family.columns[rows], GROUND)
        first = found.max(axis=1, initial=GROUND)
        last = np.where(found == first[:, None], GROUND, found).max(axis=1, initial=GROUND)
        apart = (count[rows] == 1) | (last != GROUND)
        yield np.full(apart.sum(), number), rows[apart], np.column_stack([first, last])[apart]


def _in_loops(ends: Ints) -> Ints:
    """Leave out edges that end at an unknown no other edge knows, until none is left of them."""
    kept = np.arange(len(ends))
    while True:
        count = np.bincount(ends[kept].ravel() + 1)
        lone = ((count[ends[kept] + 1] == 1) & (ends[kept] != GROUND)).any(axis=1)
        if not lone.any():
            return kept
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
    others = set(system.families[number].columns[row].tolist()) - {edge.a, edge.b} - system.known.keys()
    return min((_times(system, variable) for variable in others), default=np.inf)


def _times(system: System, variable: int) -> int:
    upper = system.derivative.get(variable)
    return 1 + _times(system, upper[0]) if upper else 0


def _reach(edges: list[_Edge], tree: set[Equation]) -> dict[int, _Reached]:
    """Write every unknown in terms of its tree's root."""
    at: dict[int, list[tuple[Equation, int, int, int]]] = defaultdict(list)
    for edge in edges:
        if edge.equation in tree:
            at[edge.a].append((edge.equation, edge.b, edge.sign_a, edge.sign_b))
            at[edge.b].append((edge.equation, edge.a, edge.sign_b, edge.sign_a))
    reached: dict[int, _Reached] = {}
    for start in sorted(at):
        if start in reached:
            continue
        reached[start] = _Reached(0 if start == GROUND else 1, {})
        todo = [start]
        while todo:
            here = todo.pop()
            for equation, there, sign_here, sign in at[here]:
                if there not in reached:
                    turned = -sign * sign_here
                    weights = {e: turned * w for e, w in reached[here].weights.items()}
                    weights[equation] = sign
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


def _summed(system: System, weights: dict[Equation, int], highest: Flags) -> Family:
    """Return the weighted sum of equations as one equation; its unknowns cancel and are left out."""
    time, residual = ca.SX.sym("time"), ca.SX(0)
    parts: list[tuple[Any, ...]] = []
    for (number, row), weight in weights.items():
        family = system.families[number]
        form, stays = family.form, ~highest[family.columns[row]]
        own, kept = ca.SX.zeros(form.locals.numel()), ca.SX.sym("local", int(stays.sum()))
        own.nz[np.flatnonzero(stays).tolist()] = kept
        given = ca.SX.sym("given", form.given.numel())
        value, modes = form.function(form.residual, form.modes)(own, given, time)
        residual += weight * value
        stands_for = family.columns[row, stays], family.signs[row, stays]
        parts.append((kept, given, modes, family.arguments[:, row], *stands_for))
    *symbols, columns, signs = zip(*parts, strict=True)
    locals_, given, modes, arguments = map(column, symbols)
    told = ", ".join(sorted({system.label(equation) for equation in weights}))
    form = Form(residual, locals_, given, modes, time)
    return Family(form, np.hstack(columns)[None], np.hstack(signs)[None], arguments, lambda _: told)
