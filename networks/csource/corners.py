"""Corners: where the greater or the lesser of two expressions changes hands, as modes.

Where an integrator steps over a corner, Newton's method goes to and fro between its two sides. With modes
each side is smooth, and the corner is an event.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import casadi as ca

from ..dae import DAE
from ..flattening.instructions import Instruction, instructions, replayed
from ..flattening.vectors import column, pick
from ..reduction.transitions import Change

VALUES = ("below", "above")
NAME = "corner"
CORNERS = (ca.OP_FMAX, ca.OP_FMIN)
LIMITED = (
    ca.OP_POW, ca.OP_CONSTPOW, ca.OP_SQRT, ca.OP_LOG, ca.OP_LOG1P, ca.OP_INV, ca.OP_ASIN, ca.OP_ACOS,
    ca.OP_ACOSH, ca.OP_ATANH,
)  # fmt: skip


def corners_as_modes(dae: DAE) -> DAE:
    """Return a DAE in which max(a, b) and min(a, b) are chosen by a mode that says whether a is above b.

    A step may lead a little beyond a corner before it is noticed. So what goes into powers, roots, logarithms
    and denominators, which may know no beyond, stays as it is; so do bounds of parameters alone, and the
    values that events give, which are of one instant. The new modes follow the others.
    """
    matrices = [block.matrix for block in dae.blocks]
    watched = sorted({change.indicator for change in dae.switching.changes})
    parts = [dae.ode, dae.alg, dae.variables, pick(dae.switching.expressions, watched), *matrices]
    known = ca.Function("known", dae.arguments(), parts, {"cse": True, "allow_free": True})
    chosen = _without_limits(known)
    if not chosen:
        return dae
    corners = _Corners(dae, known, chosen)
    ode, alg, variables, indicators, *matrices = corners.results
    switching, expressions = dae.switching, ca.densify(ca.SX(dae.switching.expressions))
    if watched:
        expressions[watched] = indicators
    names = [f"{NAME}[{k + 1}]" for k in range(len(corners.modes))]
    first, modes = expressions.numel(), len(switching.mode_names)
    changes = [
        Change(name, modes + k, source, 1 - source, first + 2 * k + source)
        for k, name in enumerate(names)
        for source in (0, 1)
    ]
    return replace(
        dae,
        modes=ca.vertcat(dae.modes, *corners.modes),
        ode=ode,
        alg=alg,
        variables=variables,
        switching=replace(
            switching,
            changes=[*switching.changes, *changes],
            expressions=column([expressions, *corners.differences]),
            mode_names=[*switching.mode_names, *names],
            mode_values=[*switching.mode_values, *[VALUES] * len(names)],
            in_shock=[*switching.in_shock, *({} for _ in names)],
        ),
        blocks=[replace(block, matrix=m) for block, m in zip(dae.blocks, matrices, strict=True)],
        bindings={},
        timed={},
    )


def is_corner(mode: str) -> bool:
    """Tell whether a mode is one that `corners_as_modes` made."""
    return mode.startswith(f"{NAME}[")


def _without_limits(known: Any) -> set[int]:
    """Return the places of max and min whose values go into nothing that ends at a corner."""
    behind: dict[int, frozenset[int]] = {}
    found: set[int] = set()
    for instruction in instructions(known):
        operation, of = instruction.operation, instruction.of
        if operation in (ca.OP_INPUT, ca.OP_CONST, ca.OP_PARAMETER):
            behind[instruction.into[0]] = frozenset()
        elif operation != ca.OP_OUTPUT:
            passed: frozenset[int] = frozenset().union(*(behind[place] for place in of))
            if operation in LIMITED:
                found -= passed
            elif operation == ca.OP_DIV:
                found -= behind[of[1]]
            elif operation in CORNERS:
                found.add(instruction.number)
                passed |= {instruction.number}
            behind.update(dict.fromkeys(instruction.into, passed))
    return found


class _Corners:
    """Writes a function anew, operation by operation."""

    def __init__(self, dae: DAE, known: Any, chosen: set[int]) -> None:
        self.modes: list[Any] = []
        self.differences: list[Any] = []
        self._moving = ca.vertcat(dae.x, dae.z, dae.u, dae.time)
        self._chosen = chosen
        self.results = replayed(known, dae.arguments(), self._applied)

    def _applied(self, instruction: Instruction, operands: Sequence[Any]) -> list[Any]:
        if instruction.number not in self._chosen:
            return instruction.applied(operands)
        return [self._by_mode(instruction.operation, *operands)]

    def _by_mode(self, operation: int, a: Any, b: Any) -> Any:
        if not ca.depends_on(a - b, self._moving):
            return ca.SX.binary(operation, a, b)
        above = ca.SX.sym(NAME)
        self.modes.append(above)
        self.differences += [a - b, b - a]
        greater, lesser = (a, b) if operation == ca.OP_FMAX else (b, a)
        return ca.if_else(above, greater, lesser)
