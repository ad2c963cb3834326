"""Small helpers for CasADi vectors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...base import Symbolic


def pick(vector: Any, places: Sequence[int]) -> Any:
    """Return some entries as a dense column, (0, 1) if there are none.

    Asked for as nonzeros they cost half of what plain indexing does.
    """
    if not len(places):
        return type(vector)(0, 1)
    dense = vector if vector.is_dense() else ca.densify(vector)
    return dense.nz[list(places)]


def pick_matrix(vector: Any, places: NDArray[np.int64]) -> Any:
    """Return the SX entries at (columns, rows) of places as a dense matrix (rows, columns)."""
    columns, rows = places.shape
    return ca.SX(ca.Sparsity.dense(rows, columns), pick(vector, places.ravel().tolist()))


def stacked(*columns: Any) -> Symbolic:
    """Return dense SX columns or rows as one column; far cheaper than `ca.vertcat` for few or long ones."""
    ends = np.cumsum([0, *(part.numel() for part in columns)]).tolist()
    whole = ca.SX.zeros(ends[-1])
    for part, begin, end in zip(columns, ends, ends[1:], strict=False):
        whole[begin:end] = part
    return whole


def column(entries: Sequence[Any]) -> Any:
    """Return SX scalars and columns as one column, (0, 1) if there are none."""
    return ca.vertcat(*entries) if entries else ca.SX(0, 1)
