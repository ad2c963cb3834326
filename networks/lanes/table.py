"""Tables of what differs between members: a column a name, a row a member."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ...base import Array, ModelError, named, shown
from ...components.language import Option, Sampled
from ..dae import DAE

Columns = dict[str, Array]


def columns_of(what: str, given: Any) -> Columns:
    """Return numbers by name as arrays, of one entry where all members share it.

    Args:
        what: the argument, for errors.
        given: a mapping, or a table of pandas.
    """
    if hasattr(given, "columns") and hasattr(given, "to_numpy"):
        given = {str(name): given[name].to_numpy() for name in given.columns}
    return {name: _column(f"{what} '{name}'", values) for name, values in named(what, given).items()}


def _column(what: str, given: Any) -> Array:
    try:
        values = np.atleast_1d(np.asarray(given, dtype=float))
    except (TypeError, ValueError):
        raise ModelError(f"{what} takes numbers, one for each member, got {shown(given)}") from None
    if values.ndim != 1 or not len(values):
        raise ModelError(f"{what} takes one number for each member, got an array of shape {values.shape}")
    return values


def member_count(lengths: Mapping[str, int]) -> int:
    """Return how many members there are, by what has more than one entry.

    Raises:
        ModelError: where lengths differ.
    """
    several = {what: length for what, length in lengths.items() if length != 1}
    if len(set(several.values())) > 1:
        told = [f"{what}: {length}" for what, length in several.items()]
        raise ModelError("what is given for members has different lengths:", told)
    return next(iter(several.values()), 1)


def spread(columns: Columns, count: int) -> Columns:
    """Return columns with an entry for each member."""
    return {name: np.broadcast_to(values, count) for name, values in columns.items()}


def check_no_options(dae: DAE, names: Iterable[str]) -> None:
    """Refuse what shapes the equations themselves."""
    problems = []
    for name in names:
        owner, _, field = name.rpartition(".")
        instance = dae.flat.instances.get(owner)
        if instance is not None and isinstance(type(instance.component).fields.get(field), Option):
            problems.append(
                f"'{name}' shapes the equations themselves; assemble a network for each choice of it, and "
                "run an ensemble of each"
            )
    if problems:
        raise ModelError(f"'{dae.name}': these are no parameters of one set of equations:", problems)


def several_signals(given: Any) -> Sequence[Any] | None:
    """Return the signals of an input, one for each member, if that is what was given."""
    if isinstance(given, np.ndarray):
        return [float(value) for value in given] if given.ndim == 1 else None
    return given if isinstance(given, list) else None


def check_data(path: str, signals: Sequence[Any]) -> None:
    """Refuse formulas that differ between members, as these are compiled."""
    for member, signal in enumerate(signals):
        if callable(signal) and not isinstance(signal, Sampled):
            raise ModelError(
                f"input '{path}' of member {member} is a function of time; members share functions, or have "
                "their own numbers or Sampled(time, values)"
            )
