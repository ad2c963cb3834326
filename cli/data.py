"""Inputs as they are given to commands: constants, and the columns of a file as signals."""

from __future__ import annotations

import fnmatch
from collections.abc import Callable, Collection, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..base import Array, ModelError
from ..base.tables import Table, read_table
from ..components import Sampled, nearest
from ..networks import DAE, Network
from .arguments import pairs

if TYPE_CHECKING:
    from ..fmu import FMU


@dataclass(frozen=True)
class Inputs:
    """The inputs of a model.

    Attributes:
        names: of all.
        needed: those that have no other signal, with their units.
        values: returns a column of a table in the unit in which the model takes it.
    """

    names: Collection[str]
    needed: Mapping[str, str]
    values: Callable[[Table, str], Array]

    @classmethod
    def of_network(cls, dae: DAE) -> Inputs:
        """Return those of a network, in SI units."""
        units = {declared.path: declared.unit for declared in dae.inputs if not declared.order}
        free = {i.path: i.unit for i in dae.inputs if not i.order and i.signal is None}
        return cls(units, free, lambda table, name: table.in_si(name, units[name]))

    @classmethod
    def of_fmu(cls, fmu: FMU) -> Inputs:
        """Return those of an FMU, in its own units."""
        own = {name: fmu.variable(name) for name in fmu.inputs}

        def values(table: Table, name: str) -> Array:
            column, unit = table.column(name), table.units.get(name)
            return np.asarray(fmu.converted(own[name], (column, unit) if unit else column))

        return cls(own, {}, values)


def given_inputs(texts: Iterable[str], inputs: Inputs) -> tuple[dict[str, float], Path | None]:
    """Return what was given for the inputs of a model, as NAME=VALUE or as a file: constants, and the file.

    Raises:
        ModelError: for unknown inputs and for a second file.
    """
    texts = list(texts)
    files = [text for text in texts if "=" not in text or Path(text).exists()]
    constant = pairs("--input", (text for text in texts if text not in files))
    for name in constant:
        if name not in inputs.names:
            raise ModelError(f"--input {name}: there is no such input{_known(name, inputs.names)}")
    if len(files) > 1:
        raise ModelError(f"--input takes one file, got {' and '.join(files)}; put all columns into one table")
    return constant, Path(files[0]) if files else None


def driven(network: Network, texts: Iterable[str]) -> tuple[dict[str, float], float | None]:
    """Give a network the signals of a file as its own; return the constants, and the end of the file [s].

    Raises:
        ModelError: as `given_inputs` and `read_inputs` do.
    """
    inputs = Inputs.of_network(network.dae())
    constant, path = given_inputs(texts, inputs)
    if path is None:
        return constant, None
    signals = read_inputs(path, inputs, others=constant)
    for name, signal in signals.items():
        *owners, own = name.split(".")
        setattr(reduce(getattr, owners, network), own, signal)
    return constant, float(next(iter(signals.values())).time[-1])


def read_inputs(
    path: Path, inputs: Inputs, held: Sequence[str] = (), others: Container[str] = ()
) -> dict[str, Sampled]:
    """Return the signals that a file holds for the inputs of a model, all columns checked.

    Those whose names match one of `held`, in which a * stands for any part, keep each sample until the next;
    through the rest goes a spline. Inputs among the `others` have their signal from elsewhere.

    Raises:
        ModelError: with file, line and column of what is wrong.
        MissingFileError: if there is no such file.
    """
    table = read_table(path)
    time = table.in_si(table.time_name, "s")
    names = [name for name in table.columns if name != table.time_name]
    _check_names(table, names, inputs.names)
    for name in names:
        if name in others:
            raise ModelError(f"{table.at(name)}: '{name}' has a value given by --input, too")
    missing = [name for name in sorted(inputs.needed) if name not in names and name not in others]
    if missing:
        told = " nor ".join(f"'{name}' [{inputs.needed[name]}]" for name in missing)
        raise ModelError(f"{path}, line 1: no column {told}, an input that has no other signal")
    if not names:
        raise ModelError(f"{path}, line 1: '{table.time_name}' is the only column; name the inputs, too")
    columns = {name: inputs.values(table, name) for name in names}
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


def _check_names(table: Table, names: list[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise ModelError(f"{table.at(name)}: there is no such input{_known(name, known)}")


def _known(name: str, inputs: Collection[str]) -> str:
    """Return the input that was meant, or all there are."""
    listed = ", ".join(inputs)
    return nearest(name, inputs) or (f"; the inputs are {listed}" if listed else "; there are none")
