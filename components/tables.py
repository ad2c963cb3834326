"""Tables: values given over speed, in between by straight lines."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import casadi as ca

from .base import ModelError

Table = tuple[tuple[float, ...], ...]


def interpolated(table: Table, at: Any, column: int = 1) -> Any:
    """Return a column of a table at a value of its first column, its ends extrapolated.

    A table of one row is constant.

    Raises:
        ModelError: if rows differ in length or the first column does not increase from 0.
    """
    heads = [float(row[0]) for row in table]
    increasing = all(a < b for a, b in pairwise(heads))
    if len({len(row) for row in table}) != 1 or heads[0] != 0 or not increasing:
        raise ModelError(f"a table needs rows of one length whose first column increases from 0, got {table}")
    values = [float(row[column]) for row in table]
    if len(table) == 1:
        return values[0] + 0 * at
    return ca.pw_lin(ca.SX(at), ca.DM(heads), ca.DM(values))
