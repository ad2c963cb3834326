"""Causalise: solve the index-1 equations block by block, explicitly where that is possible.

The block-lower-triangular form (CasADi's Dulmage-Mendelsohn decomposition) orders the unknowns.
Single linear equations are solved at once; blocks are torn, and solved explicitly when what remains
is linear and small. What is left over stays algebraic (`z`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from ...base import Flags, Ints
from ...components.language import calls
from ..flattening.instructions import put_in
from ..flattening.vectors import column, pick, stacked
from .pantelides import System, counted
from .tearing import Torn, ZeroSlopes, tear

_Solved = list[tuple[Ints, Ints, Any]]  # blocks, their variables and what these are, in any order


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

    def without(self, symbols: list[Any]) -> None:
        """Put zero for symbols in all expressions."""
        if symbols:
            left_out, count = ca.vertcat(*symbols), len(self.residuals)
            given = [self.values, self.also, *self.residuals, *(block.matrix for block in self.blocks)]
            zeros = ca.SX.zeros(left_out.numel())
            self.values, self.also, *others = ca.substitute(given, [left_out], [zeros])
            self.residuals = others[:count]
            for block, matrix in zip(self.blocks, others[count:], strict=True):
                block.matrix = matrix


def causalise(system: System, states: list[int], symbols: Any, values: Any, also: Any) -> Solution:
    """Solve the index-1 equations for what is neither a state nor an input.

    `symbols` are all variables, `values` the same as `padded` returns them; `also` are further expressions
    to be written in terms of the states.
    """
    equations, unknowns, cuts = _triangular(system, states)
    solved: _Solved = []
    done = _solve_single(system, equations, unknowns, cuts, values, solved)
    torn: list[Torn] = []
    every, zero = system.equations(), ZeroSlopes(system, values)
    for block in np.flatnonzero(~done):
        span = slice(cuts[block], cuts[block + 1])
        result = tear(system, [every[e] for e in equations[span]], unknowns[span].tolist(), values, zero)
        torn.append(result)
        if result.expressions:
            variables, found = zip(*result.expressions, strict=True)
            solved.append((np.full(len(variables), block), np.array(variables), ca.vertcat(*found)))
    return _substituted(system, states, symbols, solved, torn, also)


def _triangular(system: System, states: list[int]) -> tuple[Ints, Ints, Ints]:
    """Return equations and unknowns in block-lower-triangular order, and where blocks begin."""
    is_unknown = np.zeros(system.size, dtype=bool)
    for family in system.families:
        is_unknown[family.columns.ravel()] = True
    is_unknown[[upper for upper, _ in system.derivative.values()]] = True
    is_unknown[states] = False
    is_unknown[list(system.known)] = False
    _, row_order, column_order, cuts, *_ = system.incidence(counted(is_unknown)).btf()
    unknowns = np.flatnonzero(is_unknown)[np.array(column_order, dtype=np.int64)]
    return np.array(row_order, dtype=np.int64), unknowns, np.array(cuts, dtype=np.int64)


def _solve_single(
    system: System, equations: Ints, unknowns: Ints, cuts: Ints, values: Any, solved: _Solved
) -> Flags:
    """Solve the single linear equations, all of one form at once; tell which blocks are solved."""
    done = np.zeros(len(cuts) - 1, dtype=bool)
    single = np.flatnonzero(np.diff(cuts) == 1)
    chosen, targets = equations[cuts[single]], unknowns[cuts[single]]
    starts = system.family_starts()
    family_of = np.searchsorted(starts, chosen, side="right") - 1
    for number in sorted(set(family_of.tolist())):
        family = system.families[number]
        members = np.flatnonzero(family_of == number)
        members = members[np.argsort(chosen[members])]
        rows = chosen[members] - starts[number]
        marks = (family.columns[rows] == targets[members][:, None]) * family.signs[rows]
        for pattern, alike in _patterns(marks):
            found = family.solved(pattern, rows[alike], values, system.flat.time)
            if found is not None:
                solved.append((single[members[alike]], targets[members[alike]], found))
                done[single[members[alike]]] = True
    return done


def _patterns(marks: Ints) -> Iterator[tuple[tuple[int, ...], Any]]:
    """Yield rows that differ and where they are."""
    if (marks == marks[0]).all():
        yield tuple(marks[0].tolist()), slice(None)
        return
    patterns, kind = np.unique(marks, axis=0, return_inverse=True)
    for k, pattern in enumerate(patterns.tolist()):
        yield tuple(pattern), kind.ravel() == k


def _in_order(solved: _Solved) -> tuple[list[int], Any]:
    """Return variables and their expressions in the order of the blocks."""
    if not solved:
        return [], ca.SX(0, 1)
    blocks, variables, values = zip(*solved, strict=True)
    order = np.argsort(np.concatenate(blocks), kind="stable").tolist()
    return np.concatenate(variables)[order].tolist(), pick(stacked(*values), order)


def _substituted(
    system: System, states: list[int], symbols: Any, solved: _Solved, torn: list[Torn], also: Any
) -> Solution:
    """Put the solved unknowns into each other, in one pass."""
    order, definitions = _in_order(solved)
    place = {variable: i for i, variable in enumerate(order)} if system.held else {}
    for variable in system.held.keys() & place.keys():
        for condition in system.held[variable]:
            definitions[place[variable]] = ca.if_else(condition, 0, definitions[place[variable]])
    residuals = [residual for block in torn for residual in block.residuals]
    matrices = [block.matrix for block in torn]
    values, others = symbols[:], [*residuals, *matrices, also]
    if order:
        calling = system.calls or calls(also)
        values.nz[order], others = put_in(pick(symbols, order), definitions, others, calling)
    count = len(residuals)
    for block, matrix in zip(torn, others[count:-1], strict=True):
        block.matrix = matrix
    completion = column([ca.vec(block.completion) for block in torn])
    algebraic = [variable for block in torn for variable in block.algebraic]
    return Solution(values, symbols, states, algebraic, others[:count], torn, completion, others[-1])
