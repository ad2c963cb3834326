"""Causalise: solve the index-1 equations block by block, explicitly where that is possible.

The block-lower-triangular form (CasADi's Dulmage-Mendelsohn decomposition) orders the unknowns.
Single linear equations are solved at once; blocks are torn, and solved explicitly when what remains
is linear and small. What is left over stays algebraic (`z`).
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from .families import Ints
from .index import System
from .tearing import Block, Torn, tear
from .vectors import column

SMALL = 8


@dataclass(eq=False)
class Solution:
    """Every unknown in terms of states, inputs, parameters, modes and the algebraic `z`."""

    values: Any
    symbols: Any
    states: list[int]
    algebraic: list[int]
    residuals: list[Any]
    blocks: list[Torn]
    completion: Any
    also: Any


def causalise(system: System, states: list[int], symbols: Any, also: Any) -> Solution:
    """Solve all equations for what is neither a state nor an input.

    Args:
        system: the index-1 equations.
        states: the variables that are states.
        symbols: SX vector of all variables.
        also: further expressions of them to be written in terms of the states.
    """
    equations = list(system.equations())
    is_unknown = np.zeros(system.size, dtype=bool)
    for family in system.families:
        is_unknown[family.columns.ravel()] = True
    is_unknown[[upper for upper, _ in system.derivative.values()]] = True
    is_unknown[states] = False
    is_unknown[list(system.known)] = False
    unknowns = np.flatnonzero(is_unknown)
    blocks = _triangular(system, equations, unknowns)
    order: list[int] = []
    algebraic: list[int] = []
    expressions: dict[int, Any] = {}
    torn: list[Torn] = []
    _solve_single(system, blocks, symbols, expressions)
    for block in blocks:
        if len(block.variables) == 1 and block.variables[0] in expressions:
            order.append(block.variables[0])
            continue
        result = tear(system, block, symbols, SMALL)
        torn.append(result)
        for variable, expression in result.expressions:
            expressions[variable] = expression
            order.append(variable)
        algebraic += result.algebraic
    return _substituted(system, states, symbols, order, expressions, algebraic, torn, also)


def _triangular(
    system: System, equations: list[tuple[int, int]], unknowns: Ints
) -> list[Block]:
    number = np.full(system.size, -1, dtype=np.int64)
    number[unknowns] = np.arange(len(unknowns))
    rows, columns, start = [], [], 0
    for family in system.families:
        cells = number[family.columns]
        r, c = np.nonzero(cells >= 0)
        rows.append(r + start)
        columns.append(cells[r, c])
        start += len(family)
    pattern = ca.Sparsity.triplet(
        len(equations),
        len(unknowns),
        np.concatenate(rows).tolist() if rows else [],
        np.concatenate(columns).tolist() if columns else [],
    )
    count, row_order, column_order, row_cut, column_cut, *_ = pattern.btf()
    return [
        Block(
            [equations[i] for i in row_order[row_cut[b] : row_cut[b + 1]]],
            [int(unknowns[j]) for j in column_order[column_cut[b] : column_cut[b + 1]]],
        )
        for b in range(count)
    ]


def _solve_single(
    system: System, blocks: list[Block], symbols: Any, expressions: dict[int, Any]
) -> None:
    """Solve the single linear equations, all instances of one form at once."""
    by_family: dict[int, tuple[list[int], list[int]]] = defaultdict(lambda: ([], []))
    for block in blocks:
        if len(block.variables) == 1:
            number, row = block.equations[0]
            by_family[number][0].append(row)
            by_family[number][1].append(block.variables[0])
    for number, (rows, variables) in by_family.items():
        family = system.families[number]
        chosen, targets = np.array(rows), np.array(variables)
        marks = (family.columns[chosen] == targets[:, None]) * family.signs[chosen]
        patterns, kind = np.unique(marks, axis=0, return_inverse=True)
        for k, pattern in enumerate(patterns):
            solved = family.solved(tuple(int(m) for m in pattern))
            members = np.flatnonzero(kind.ravel() == k)
            if solved is None or family.is_hybrid(solved[0]):
                continue
            slope, offset = solved
            result = family.evaluate(-offset / slope, chosen[members], symbols, system.flat.time)
            for variable, expression in zip(targets[members], ca.horzsplit(result), strict=True):
                expressions[int(variable)] = expression


def _substituted(
    system: System,
    states: list[int],
    symbols: Any,
    order: list[int],
    expressions: dict[int, Any],
    algebraic: list[int],
    torn: list[Torn],
    also: Any,
) -> Solution:
    """Put the solved unknowns into each other, in one pass."""
    for variable, conditions in system.held.items():
        if variable in expressions:
            for condition in conditions:
                expressions[variable] = ca.if_else(condition, 0, expressions[variable])
    residuals = [residual for block in torn for residual in block.residuals]
    matrices = [block.matrix for block in torn]
    targets = [symbols[order]] if order else []
    definitions = [ca.vertcat(*[expressions[v] for v in order])] if order else []
    solved, others = ca.substitute_inplace(targets, definitions, [*residuals, *matrices, also])
    values = ca.SX(symbols)
    if order:
        values[order] = solved[0]
    count = len(residuals)
    for block, matrix in zip(torn, others[count:-1], strict=True):
        block.matrix = matrix
    completion = column([ca.vec(block.completion) for block in torn])
    return Solution(values, symbols, states, algebraic, others[:count], torn, completion, others[-1])
