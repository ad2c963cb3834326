"""Dependencies: what rates and other variables depend on, as `ModelStructure` tells it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from ...networks import DAE, Start

Kinds = dict[int, str]


@dataclass(frozen=True)
class Dependencies:
    """By value reference of an unknown: references of its knowns and the kind of dependency.

    Attributes:
        running: on states, inputs and time.
        starting: on start values of states, inputs, parameters and time.
    """

    running: dict[int, Kinds]
    starting: dict[int, list[int]]


def dependencies(
    dae: DAE,
    start: Start,
    free: Sequence[int],
    variables: Sequence[str],
    first: Sequence[int],
    aims: Sequence[int],
) -> Dependencies:
    """Return the dependencies of rates and variables, references counted from `first`, `aims` given."""
    results = ca.vertcat(dae.ode, *[dae.expression(name) for name in variables])
    unknowns = [*range(first[1], first[2]), *range(first[4], first[5])]
    moving = ca.vertcat(dae.x, dae.u, dae.time)
    inputs = np.zeros(len(dae.inputs), dtype=int)  # those that are bound are functions of time
    inputs[list(free)] = np.arange(first[2], first[2] + len(free))
    known = np.concatenate([np.arange(first[0], first[1]), inputs, [0]])
    parameters = np.arange(first[3], first[4])
    through = _pattern(dae, results, moving)
    tuned = _pattern(dae, results, dae.p)
    kinds = {} if dae.z.numel() else _kinds(dae, results, moving)
    running: dict[int, Kinds] = {}
    starting: dict[int, list[int]] = {}
    for row, unknown in enumerate(unknowns):
        found: Kinds = {}
        for column in _columns(through, row):
            reference = int(known[column])
            kind = kinds.get((row, column), "dependent") if reference else "dependent"
            found[reference] = kind if found.get(reference, kind) == kind else "dependent"
        running[unknown] = dict(sorted(found.items()))
        starting[unknown] = sorted({*found, *parameters[_columns(tuned, row)].tolist()})
    sought = {first[0] + k for k in start.moved}
    if sought:
        together = _together(start, known, parameters, aims) - sought
        starting |= {unknown: sorted(together) for unknown in sought}
        for unknown, found_there in starting.items():
            if sought.intersection(found_there):
                starting[unknown] = sorted({*found_there, *together} - sought)
    return Dependencies(running, starting)


def _together(start: Start, known: Any, parameters: Any, aims: Sequence[int]) -> set[int]:
    """Return what start values that are sought depend on, all of them alike."""
    dae = start.dae
    sought = ca.vertcat(*[dae.expression(aim.name) for aim in start.aims])
    sought = ca.vertcat(ca.SX(0, 1), sought, dae.alg)
    moving = ca.vertcat(dae.x, dae.u, dae.time)
    by_motion, by_parameters = (
        np.unique(ca.jacobian_sparsity(sought, s).get_col()).astype(int) for s in (moving, dae.p)
    )
    return {*aims, *known[by_motion].tolist(), *parameters[by_parameters].tolist()}


def _pattern(dae: DAE, results: Any, symbols: Any) -> Any:
    """Return what results depend on, also through the algebraic unknowns."""
    from scipy import sparse

    direct = _sparse(ca.jacobian_sparsity(results, symbols))
    if not dae.z.numel():
        return direct
    loop, size = _sparse(ca.jacobian_sparsity(dae.alg, dae.z)), dae.z.numel()
    both = sparse.bmat([[None, loop], [loop.T, None]])
    groups, label = sparse.csgraph.connected_components(both, directed=False)
    rows, unknowns = label[:size], label[size:]
    entered = sparse.csr_array((np.ones(size), (rows, np.arange(size))), (groups, size))
    through = (entered @ _sparse(ca.jacobian_sparsity(dae.alg, symbols)))[unknowns]
    total = (direct + _sparse(ca.jacobian_sparsity(results, dae.z)) @ through).tocsr()
    total.sort_indices()
    return total


def _kinds(dae: DAE, results: Any, symbols: Any) -> dict[tuple[int, int], str]:
    """Return how results depend on each symbol: the slope tells, by what it depends on itself."""
    slopes = ca.jacobian(results, symbols)
    switched = dae.constants[dae.p.numel() :]
    entries = ca.vertcat(ca.SX(0, 1), slopes.nz[:]) if slopes.nnz() else ca.SX(0, 1)
    moved, discrete, tunable = (
        np.diff(_sparse(ca.jacobian_sparsity(entries, s)).indptr) > 0 for s in (symbols, switched, dae.p)
    )
    told = np.select([moved, discrete, tunable], ["dependent", "discrete", "tunable"], "constant")
    places = zip(slopes.sparsity().row(), slopes.sparsity().get_col(), strict=True)
    return {place: str(kind) for place, kind in zip(places, told, strict=True)}


def _columns(matrix: Any, row: int) -> list[int]:
    found: list[int] = matrix.indices[matrix.indptr[row] : matrix.indptr[row + 1]].tolist()
    return found


def _sparse(pattern: Any) -> Any:
    from scipy import sparse

    rows, columns = pattern.get_triplet()
    found = sparse.csr_array((np.ones(len(rows)), (rows, columns)), pattern.shape)
    found.sort_indices()
    return found
