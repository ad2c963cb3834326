"""Measured inputs: the columns of a file as signals of a network."""

from __future__ import annotations

import fnmatch
from collections.abc import Collection, Container, Iterable, Sequence
from pathlib import Path

from ..base import ModelError
from ..base.tables import Table, read_table
from ..components import Sampled, nearest
from ..networks import DAE
from .arguments import pairs


def given_inputs(texts: Iterable[str], dae: DAE) -> tuple[dict[str, float], Path | None]:
    """Return what was given for the inputs of a network, as NAME=VALUE or as a file: constants, and the file.

    Raises:
        ModelError: for unknown inputs and for a second file.
    """
    texts = list(texts)
    files = [text for text in texts if "=" not in text or Path(text).exists()]
    constant = pairs("--input", (text for text in texts if text not in files))
    for name in constant:
        if name not in dae.input_names:
            raise ModelError(f"--input {name}: there is no such input{_known(name, dae.input_names)}")
    if len(files) > 1:
        raise ModelError(f"--input takes one file, got {' and '.join(files)}; put all columns into one table")
    return constant, Path(files[0]) if files else None


def read_inputs(
    path: Path, dae: DAE, held: Sequence[str] = (), others: Container[str] = ()
) -> dict[str, Sampled]:
    """Return the signals that a file holds for the inputs of a network, all columns checked, in SI units.

    Those whose names match one of `held`, in which a * stands for any part, keep each sample until the next;
    through the rest goes a spline. Inputs among the `others` have their signal from elsewhere.

    Raises:
        ModelError: with file, line and column of what is wrong.
        MissingFileError: if there is no such file.
    """
    table = read_table(path)
    time = table.in_si(table.time_name, "s")
    units = {declared.path: declared.unit for declared in dae.inputs if not declared.order}
    names = [name for name in table.columns if name != table.time_name]
    _check_names(table, names, units)
    for name in names:
        if name in others:
            raise ModelError(f"{table.at(name)}: '{name}' has a value given by --input, too")
    missing = {name for name in unbound_inputs(dae) - set(names) if name not in others}
    if missing:
        told = " nor ".join(f"'{name}' [{units[name]}]" for name in sorted(missing))
        raise ModelError(f"{path}, line 1: no column {told}, an input that has no other signal")
    if not names:
        raise ModelError(f"{path}, line 1: '{table.time_name}' is the only column; name the inputs, too")
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
            raise ModelError(f"{table.at(name)}: there is no such input{_known(name, units)}")


def _known(name: str, inputs: Collection[str]) -> str:
    """Return the input that was meant, or all there are."""
    listed = ", ".join(inputs)
    return nearest(name, inputs) or (
        f"; the inputs are {listed}" if listed else "; the network has no inputs"
    )
