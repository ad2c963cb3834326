"""Measured inputs: the columns of a file as signals of a network."""

from __future__ import annotations

import fnmatch
from collections.abc import Sequence
from pathlib import Path

from ..base import ModelError
from ..base.tables import Table, read_table
from ..components import Sampled, nearest
from ..networks import DAE


def read_inputs(path: Path, dae: DAE, held: Sequence[str] = ()) -> dict[str, Sampled]:
    """Return the signals that a file holds for the inputs of a network, all columns checked, in SI units.

    Those whose names match one of `held`, in which a * stands for any part, keep each sample until the next;
    through the others goes a spline.

    Raises:
        ModelError: with file, line and column of what is wrong.
        MissingFileError: if there is no such file.
    """
    table = read_table(path)
    time = table.in_si(table.time_name, "s")
    units = {declared.path: declared.unit for declared in dae.inputs if not declared.order}
    names = [name for name in table.columns if name != table.time_name]
    _check_names(table, names, units)
    missing = unbound_inputs(dae) - set(names)
    if missing:
        told = " nor ".join(f"'{name}' [{units[name]}]" for name in sorted(missing))
        raise ModelError(f"{path}, line 1: no column {told}, an input that has no other signal")
    columns = {name: table.in_si(name, units[name]) for name in names}
    wrong = [table.number_problem(name, values) for name, values in columns.items()]
    for told in filter(None, (table.time_problem(table.time_name, time), *wrong)):
        raise ModelError(told)
    strange = [pattern for pattern in held if not fnmatch.filter(names, pattern)]
    if strange:
        told = nearest(strange[0], names) or f"; the columns are {', '.join(names)}"
        raise ModelError(f"{path}: no column '{strange[0]}' is there to be held{told}")
    steps = {name for pattern in held for name in fnmatch.filter(names, pattern)}
    if len(time) < 4 and set(names) - steps:
        raise ModelError(f"{path}: {len(time)} rows; at least 4 are needed for a smooth signal")
    kinds = {name: "hold" if name in steps else "cubic" for name in names}
    return {name: Sampled(time, values, interpolation=kinds[name]) for name, values in columns.items()}


def unbound_inputs(dae: DAE) -> set[str]:
    """Return the inputs that neither a connection nor the model itself gives a signal."""
    return {declared.path for declared in dae.inputs if not declared.order and declared.signal is None}


def _check_names(table: Table, names: list[str], units: dict[str, str]) -> None:
    for name in names:
        if name not in units:
            known = f"; the inputs are {', '.join(units)}" if units else "; the network has no inputs"
            raise ModelError(f"{table.at(name)}: there is no such input{nearest(name, units) or known}")
