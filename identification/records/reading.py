"""`read_record`: a record from a file, its columns checked, in SI units, over evenly spaced time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import ceil
from pathlib import Path

import numpy as np

from ...base import Array, path_of, unit_for
from ...base.tables import Table, read_table
from ...components import ModelError
from .columns import number_problems, time_problems, value_problems
from .record import Channel, Record, rows_within

EVEN_TOLERANCE = 1e-4  # of a step
ROUNDING_TOLERANCE = 1e-2


def read_record(
    path: str | Path,
    channels: Mapping[str, Channel],
    window: tuple[float, float] | None = None,
    temperature: str | None = None,
) -> Record:
    """Read a record and check it.

    Args:
        path: .csv, .txt, .parquet, .npz, .mat (to version 7) or .at2; a column 'time' or 't' is needed.
        channels: the columns wanted.
        window: the part of it that counts [s].
        temperature: the column of a temperature.

    Raises:
        ModelError: telling all that is wrong, with file, line, column and remedy.
    """
    path = path_of(path, "a record")
    table = read_table(path)
    problems: list[str] = []
    time = _time(table, window, problems)
    columns = _columns(table, channels, temperature, problems)
    if problems:
        raise ModelError(f"record {path.name} cannot be used:", problems)
    rows = rows_within(str(path), time, window)
    part = replace(table, first_line=table.first_line and table.first_line + int(np.argmax(rows)))
    for name, channel in channels.items():
        others = [columns[other][rows] for other in channels if other != name]
        if channel.driven and channel.held:
            problems += number_problems(part, name, columns[name][rows])
        else:
            problems += value_problems(part, name, columns[name][rows], others)
    if temperature is not None:
        problems += number_problems(part, temperature, columns[temperature][rows])
    if window is not None:
        problems += time_problems(part, table.time_name, time[rows])
    if problems:
        raise ModelError(f"record {path.name} cannot be used:", problems)
    values = {name: unit_for(c.unit, c.si).to_si(columns[name][rows]) for name, c in channels.items()}
    kinds = {name: channel.interpolation for name, channel in channels.items()}
    found = _even(path.name, time[rows], values, kinds, columns[temperature][rows] if temperature else None)
    return found if window is None else replace(found, began=float(np.nanmin(time)))


def _time(table: Table, window: tuple[float, float] | None, problems: list[str]) -> Array:
    name = table.time_name
    time = table.in_si(name, "s")
    told = list(time_problems(table, name, time))
    if window is None or not np.isfinite(time).all() or (np.diff(time) <= 0).any():
        problems += told
    return time


def _columns(
    table: Table, channels: Mapping[str, Channel], temperature: str | None, problems: list[str]
) -> dict[str, Array]:
    """Return the columns wanted; note what is missing, or in another unit than the campaign says."""
    columns: dict[str, Array] = {}
    for name in [*channels, *([temperature] if temperature else [])]:
        try:
            columns[name] = table.column(name)
        except ModelError as error:
            problems.append(str(error))
            continue
        written = table.units.get(name, "")
        if name in channels and written and channels[name].unit:
            problems += _clash(table, name, written, channels[name])
    return columns


def _clash(table: Table, name: str, written: str, channel: Channel) -> list[str]:
    try:
        said, given = (unit_for(unit, channel.si) for unit in (written, channel.unit))
    except ModelError as error:
        return [f"{table.at(name)}: {error}"]
    same = np.allclose([said.factor, said.offset], [given.factor, given.offset], atol=0.0)
    told = f"the file says [{written}], the campaign unit = '{channel.unit}'; correct one"
    return [] if same else [f"{table.at(name)}: {told}"]


def _at(instants: Array, time: Array, values: Array, kind: str) -> Array:
    """Return a column at other instants near its own: the nearest sample if it is held, or stands still."""
    from scipy.interpolate import make_interp_spline

    nearest_one = np.searchsorted(0.5 * (time[1:] + time[:-1]), instants)
    if kind == "hold":
        return values[nearest_one]
    if kind == "linear":
        return np.interp(instants, time, values)
    same = np.diff(values) == 0
    still = np.append(True, same) & np.append(same, True)
    course = make_interp_spline(time, values, k=3)(instants)
    return np.where(still[nearest_one], values[nearest_one], course)


def _even(
    name: str, time: Array, values: dict[str, Array], kinds: Mapping[str, str], temperature: Array | None
) -> Record:
    """Return a record on evenly spaced instants; small jitter is evened out and told."""
    even = np.linspace(time[0], time[-1], len(time))
    step = even[1] - even[0]
    worst = float(np.abs(time - even).max())
    if worst <= ROUNDING_TOLERANCE * step:
        told = () if worst <= EVEN_TOLERANCE * step else ("instants rounded to even steps",)
        return Record(name, even, values, told, temperature)
    tenths = ceil(10 * worst / step) / 10
    note = f"instants jitter by less than {tenths:g} of a step; values are interpolated onto even ones"
    values = {key: _at(even, time, v, kinds[key]) for key, v in values.items()}
    temperature = None if temperature is None else np.interp(even, time, temperature)
    return Record(name, even, values, (note,), temperature)
