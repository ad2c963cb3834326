"""Small helpers for CasADi vectors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca


def pick(vector: Any, places: Sequence[int]) -> Any:
    """Return some entries as a column, (0, 1) if there are none (indexing a scalar gives (1, 0))."""
    return vector[list(places)] if len(places) else type(vector)(0, 1)


def column(entries: Sequence[Any]) -> Any:
    """Return SX scalars and columns as one column, (0, 1) if there are none."""
    return ca.vertcat(ca.SX(0, 1), *entries)
