"""Realise: derivatives of inputs and held motions, brought into the form A, B, C, D."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array, ModelError, rate_unit
from .statespace import StateSpace

if TYPE_CHECKING:
    from .operating import OperatingPoint

Named = tuple[list[str], list[str]]


@dataclass(frozen=True)
class Channel:
    """What drives a linear system: an input, the `order`-th derivative of one, or a parameter."""

    name: str
    path: str
    order: int
    base_unit: str
    parameter: int | None

    @property
    def unit(self) -> str:
        """Its unit."""
        return rate_unit(self.base_unit, self.order)


def drop_held(A: Array, B: Array, rows: Array) -> tuple[list[int], Array] | None:
    """Return the states to keep when some motions are held, and all states from those kept.

    A row h holds if h x stays as it is whatever the inputs do: h A is zero up to what is held already.
    """
    import scipy.linalg

    n = len(A)
    held = np.zeros((0, n))
    whole = np.hstack([A, B])
    for _ in range(2):
        for h in rows:
            rate = h @ whole
            size = np.abs(h) @ np.abs(whole)
            rest = rate[:n] - (rate[:n] @ np.linalg.pinv(held)) @ held if len(held) else rate[:n]
            still = np.abs(rest).max(initial=0.0) <= 1e-10 * max(size[:n].max(initial=0.0), 1.0)
            if still and np.abs(rate[n:]).max(initial=0.0) <= 1e-10 * max(size[n:].max(initial=0.0), 1e-300):
                grown = np.vstack([held, h])
                if np.linalg.matrix_rank(grown, tol=1e-10) > len(held):
                    held = grown
    if not len(held):
        return None
    pivots = scipy.linalg.qr(held, pivoting=True, mode="economic")[-1]
    gone = sorted(int(k) for k in pivots[: len(held)])
    keep = [k for k in range(n) if k not in gone]
    restore = np.zeros((n, len(keep)))
    restore[keep] = np.eye(len(keep))
    restore[gone] = -np.linalg.solve(held[:, gone], held[:, keep])
    return keep, restore


def realised(
    name: str,
    matrices: tuple[Array, Array],
    channels: list[tuple[Channel, dict[int, Array]]],
    states: Named,
    inputs: Named,
    outputs: Named,
    notes: list[str],
    point: OperatingPoint | None,
) -> StateSpace:
    """Return x' = A x + sum B_k u^(k), y = C x + sum D_k u^(k) without derivatives in the first equation.

    Where a channel is a derivative u^(n), the lower ones become states. Where derivatives are left,
    x = w + E u + F u' + ... with E, F such that they leave w' = A w + (B_0 + A B_1 + A^2 B_2 + ...) u.
    """
    A, C = matrices
    names, units = list(states[0]), list(states[1])
    size, count = len(A), len(C)
    left: list[dict[int, Array]] = []
    for number, (channel, columns) in enumerate(channels):
        rest = {order - channel.order: c for order, c in columns.items() if order >= channel.order}
        lower = [columns.get(order, np.zeros(size + count)) for order in range(channel.order)]
        if channel.order:
            A, C, left, rest = _integrators(A, C, left, rest, lower)
            path = channel.path
            for order in range(channel.order):
                names.append(f"{'der(' * order}{path}{')' * order}")
                units.append(rate_unit(channel.base_unit, order))
            size = len(A)
        left.append(rest)
        notes += [] if columns else [f"nothing depends on {inputs[0][number]}"]
    return _without_derivatives(
        StateSpace(
            A, np.zeros((size, len(left))), C, np.zeros((count, len(left))),
            name=name, states=tuple(names), inputs=tuple(inputs[0]), outputs=tuple(outputs[0]),
            state_units=tuple(units), input_units=tuple(inputs[1]), output_units=tuple(outputs[1]),
            notes=tuple(notes), point=point,
        ),
        left,
    )  # fmt: skip


def _integrators(
    A: Array, C: Array, left: list[dict[int, Array]], rest: dict[int, Array], lower: list[Array]
) -> tuple[Array, Array, list[dict[int, Array]], dict[int, Array]]:
    """Append the integrals of a channel as states; earlier channels do not touch them."""
    size, more = len(A), len(lower)
    block = np.stack(lower, axis=1)
    grown = np.zeros((size + more, size + more), block.dtype)
    grown[:size, :size], grown[:size, size:] = A, block[:size]
    for k in range(more - 1):
        grown[size + k, size + k + 1] = 1.0

    def pad(column: Array) -> Array:
        return np.concatenate([column[:size], np.zeros(more), column[size:]])

    rest = {order: pad(column) for order, column in rest.items()}
    own = rest.setdefault(0, np.zeros(size + more + len(C)))
    own[size + more - 1] = 1.0
    return grown, np.hstack([C, block[size:]]), [{o: pad(c) for o, c in r.items()} for r in left], rest


def _without_derivatives(system: StateSpace, left: list[dict[int, Array]]) -> StateSpace:
    A, C, n = system.A, system.C, len(system.A)
    highest = max((order for columns in left for order in columns), default=0)
    B = np.zeros((highest + 1, n, len(left)), A.dtype)
    D = np.zeros((highest + 1, len(C), len(left)), A.dtype)
    for k, columns in enumerate(left):
        for order, column in columns.items():
            B[order, :, k], D[order, :, k] = column[:n], column[n:]
    shifted = bool(B[1:].any())
    for order in range(highest, 0, -1):
        D[order - 1] += C @ B[order]
        B[order - 1] += A @ B[order]
    size = np.abs(D).max(initial=0.0)
    above = [D[order] for order in range(1, highest + 1)]
    while above and np.abs(above[-1]).max(initial=0.0) <= 1e-14 * size:
        above.pop()
    notes = list(system.notes)
    if shifted:
        notes.append("states are less what follows an input at once, so that no derivative of it drives them")
    if above:
        notes.append(f"improper: outputs contain derivatives of inputs up to order {len(above)}")
    return replace(system, B=B[0], D=D[0], D_s=tuple(above), notes=tuple(notes))


def chained(system: StateSpace, after: StateSpace, row: int, name: str) -> StateSpace:
    """Return a system with one output passed through another; see `StateSpace.then`."""
    if not (system.proper and after.proper):
        raise ModelError(f"'{system.name}': only proper systems are chained; take a derivative as the input")
    n, added = len(system.A), len(after.A)
    A = np.zeros((n + added, n + added))
    A[:n, :n], A[n:, n:], A[n:, :n] = system.A, after.A, after.B @ system.C[[row]]
    B = np.vstack([system.B, after.B @ system.D[[row]]])
    C, D = np.hstack([system.C, np.zeros((len(system.C), added))]), system.D.copy()
    C[row] = np.hstack([after.D @ system.C[[row]], after.C])
    D[row] = after.D @ system.D[[row]]
    still = replace(after, A=np.zeros_like(after.A), C=np.zeros_like(after.C))
    slopes = {by: chained(slope, still, row, name) for by, slope in system.slopes.items()}
    outputs, units = list(system.outputs), list(system.output_units)
    outputs[row], units[row] = (
        name,
        units[row] if after.output_units == after.input_units else after.output_units[0],
    )
    return replace(
        system, A=A, B=B, C=C, D=D, outputs=tuple(outputs), output_units=tuple(units),
        states=(*system.states, *(f"{name}.{state}" for state in after.states)),
        state_units=(*system.state_units, *after.state_units), slopes=slopes,
    )  # fmt: skip
