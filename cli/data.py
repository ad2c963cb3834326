"""Measured inputs: the columns of a file as signals of a network."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..components import Sampled, nearest
from ..networks import DAE, load_table

if TYPE_CHECKING:
    import pandas as pd


def read_inputs(path: Path, dae: DAE) -> dict[str, Sampled]:
    """Return the signals that a file holds for the inputs of a network, all columns checked.

    Raises:
        ValueError: with file, line and column of what is wrong.
        FileNotFoundError: if there is no such file.
    """
    table = load_table(path)
    units = {declared.path: declared.unit for declared in dae.inputs if not declared.order}
    _check_columns(path, table, units)
    missing = unbound_inputs(dae) - set(table.columns)
    if missing:
        told = " nor ".join(f"'{name}' [{units[name]}]" for name in sorted(missing))
        raise ValueError(f"{path}, line 1: no column {told}, an input that has no other signal")
    time = table.index.to_numpy(dtype=float)
    _check_finite(path, "time", time)
    _check_increasing(path, time)
    for name in table.columns:
        _check_finite(path, name, table[name].to_numpy())
    if len(time) < 4:
        raise ValueError(f"{path}: {len(time)} rows; at least 4 are needed for a smooth signal")
    return {name: Sampled(time, table[name].to_numpy()) for name in table.columns}


def unbound_inputs(dae: DAE) -> set[str]:
    """Return the inputs that neither a connection nor the model itself gives a signal."""
    return {declared.path for declared in dae.inputs if not declared.order and declared.signal is None}


def _check_columns(path: Path, table: pd.DataFrame, units: dict[str, str]) -> None:
    for name in table.columns:
        where = f"{path}, line 1, column '{name}'"
        if name not in units:
            known = f"; the inputs are {', '.join(units)}" if units else "; the network has no inputs"
            raise ValueError(f"{where}: there is no such input{nearest(name, units) or known}")
        given = table.attrs["units"][name]
        if given and given != units[name]:
            raise ValueError(f"{where}: the input is in {units[name]}, the column in {given}")


def _check_finite(path: Path, name: str, values: np.ndarray[tuple[int], np.dtype[np.float64]]) -> None:
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise ValueError(
            f"{path}, line {wrong[0] + 2}, column '{name}': {values[wrong[0]]} is no usable number "
            f"({len(wrong)} such in this column); fill it or cut it out"
        )


def _check_increasing(path: Path, time: np.ndarray[tuple[int], np.dtype[np.float64]]) -> None:
    wrong = np.flatnonzero(np.diff(time) <= 0)
    if len(wrong):
        row = wrong[0] + 1
        raise ValueError(
            f"{path}, line {row + 2}, column 'time': {time[row]:g} s comes after {time[row - 1]:g} s; "
            "time must increase from line to line"
        )
