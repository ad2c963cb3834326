"""Reduction: the matrix that a step solves with, without the states that merely follow another one.

Where x_i' = x_j, the row of x_i says x_i = g (b_i + x_j), g being the step times a number of the method. Put
into the other rows, that halves the matrix of a mechanical network (Hairer, Wanner, Solving Ordinary
Differential Equations II, IV.8, equations of second order).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca

from ..dae import DAE


@dataclass(frozen=True, eq=False)
class Reduction:
    """Slopes of the motion in the unknowns (x, z), and the smaller matrix made of them."""

    dae: DAE

    @cached_property
    def slopes(self) -> Any:
        """Sparsity of the slopes, the diagonal of x included."""
        motion, y = ca.vertcat(self.dae.ode, self.dae.alg), ca.vertcat(self.dae.x, self.dae.z)
        size, states = y.numel(), self.dae.x.numel()
        diagonal = ca.Sparsity.triplet(size, size, list(range(states)), list(range(states)))
        return ca.jacobian_sparsity(motion, y) + diagonal

    @cached_property
    def led_by(self) -> dict[int, int]:
        """The state x_j by each x_i of x_i' = x_j that is left out."""
        states: list[Any] = self.dae.x.elements()
        rates: list[Any] = self.dae.ode.elements()
        place = {symbol.element_hash(): k for k, symbol in enumerate(states)}
        led: dict[int, int] = {}
        leaders: set[int] = set()
        for i, rate in enumerate(rates):
            j = place.get(rate.element_hash()) if rate.is_symbolic() else None
            if j is not None and j != i and j not in led and i not in leaders:
                led[i] = j
                leaders.add(j)
        return led

    @cached_property
    def kept(self) -> list[int]:
        """Unknowns that are left."""
        return [k for k in range(self.slopes.size1()) if k not in self.led_by]

    @cached_property
    def targets(self) -> list[tuple[int, int] | None]:
        """Where each slope goes in the smaller matrix, if it does."""
        place = {k: number for number, k in enumerate(self.kept)}
        stands = [place[self.led_by.get(k, k)] for k in range(self.slopes.size1())]
        rows, columns = self.slopes.get_triplet()
        return [
            (place[row], stands[at]) if row in place else None for row, at in zip(rows, columns, strict=True)
        ]

    @cached_property
    def pattern(self) -> Any:
        """Sparsity of the smaller matrix."""
        size, filled = len(self.kept), sorted({target for target in self.targets if target})
        return ca.Sparsity.triplet(size, size, [row for row, _ in filled], [at for _, at in filled])

    @cached_property
    def places(self) -> list[int]:
        """Number of the nonzero of the smaller matrix to which each slope is added; -1 if to none."""
        number = {place: k for k, place in enumerate(zip(*self.pattern.get_triplet(), strict=True))}
        return [number[target] if target else -1 for target in self.targets]
