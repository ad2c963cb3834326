"""Results as files: .csv, .parquet and .npz, with the unit of every column."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import MissingPackageError, ModelError, check_output, path_of, text_of, there_is_file, writing
from .signals import chosen_signals

if TYPE_CHECKING:
    import pandas as pd

    from .result import Result

ENDINGS = (".csv", ".parquet", ".npz")


def save_result(result: Result, path: Path, names: Sequence[str]) -> Path:
    """Write signals of a run to a file and return its path.

    Args:
        result: the run.
        path: the file; its ending says the format: .csv, .parquet or .npz.
        names: signals or patterns (`mass.*`); the states if there are none.

    Raises:
        UnknownNameError: for an unknown signal, with the nearest one.
        OutputError: for another ending, a folder that does not exist, or a file that cannot be written.
        MissingPackageError: for .parquet without pyarrow.
    """
    ending = check_table_path(path)
    table = result.to_dataframe(*chosen_signals(result.dae, names))
    with writing(path) as part:
        _write(table, part, ending)
    return path


def _write(table: pd.DataFrame, path: Path, ending: str) -> None:
    units = table.attrs["units"]
    if ending == ".csv":
        table.columns = [_headed(name, units[name]) for name in table.columns]
        table.to_csv(path, index_label=_headed("time", "s"), encoding="utf-8")
    elif ending == ".parquet":
        table.to_parquet(path)
    else:
        columns = list(table.columns)
        with path.open("wb") as file:  # by its name NumPy would add an ending
            np.savez_compressed(
                file,
                time=table.index.to_numpy(),
                values=table.to_numpy(),
                names=np.array(columns, dtype=str),
                units=np.array([units[name] for name in columns], dtype=str),
            )


def load_table(path: str | Path) -> pd.DataFrame:
    """Return the table in a .csv, .parquet or .npz file.

    Its index is the time [s]; `attrs["units"]` holds the unit of every column. A .csv file has one
    line of headers, `time` or `time [s]` among them; a column without `[unit]` has the unit "".

    Args:
        path: a file written by `Result.save`, or a .csv file of measurements.

    Raises:
        ModelError: for another ending, or for what is no table of numbers over time, with file,
            line and column.
        MissingFileError: if there is no such file.

    Example:
        >>> from tempfile import TemporaryDirectory
        >>> from inertance import Fixed, Mass, Network, Spring, load_table
        >>> net = Network("swing", wall=Fixed(), spring=Spring(k=1.0), mass=Mass(m=1.0, s=0.1))
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange)
        >>> with TemporaryDirectory() as folder:
        ...     table = load_table(net.simulate(1.0).save(f"{folder}/run.csv", "mass.a"))
        >>> table.attrs["units"]
        {'mass.a': 'm/s2'}
    """
    path = path_of(path, "a table")
    ending = _ending(path)
    there_is_file(path)
    if ending == ".csv":
        return _read_csv(path)
    if ending == ".parquet":
        _need_pyarrow(path)
    try:
        stored = _read_parquet(path) if ending == ".parquet" else _read_npz(path)
    except ModelError as error:
        raise ModelError(f"{path}: {error}") from None
    except Exception as error:  # every library that reads a format has errors of its own
        raise ModelError(f"{path}: cannot be read ({error})") from error
    return stored


def check_table_path(path: Path) -> str:
    """Return the ending of a file to be written, or raise what `save_result` would raise."""
    ending = _ending(path)
    check_output(path)
    if ending == ".parquet":
        _need_pyarrow(path)
    return ending


def _ending(path: Path) -> str:
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise ModelError(f"'{path}' ends in '{path.suffix}'; tables end in {', '.join(ENDINGS)}")
    return ending


def _need_pyarrow(path: Path) -> None:
    if find_spec("pyarrow") is None:
        raise MissingPackageError(
            f"'{path}': .parquet needs pyarrow; run `pip install 'inertance[parquet]'` or use .csv"
        )


def _headed(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _table(columns: dict[str, Any], time: Any, units: dict[str, str]) -> pd.DataFrame:
    import pandas as pd

    table = pd.DataFrame(columns, index=pd.Index(time, name="time"))
    table.attrs["units"] = units
    return table


def _read_npz(path: Path) -> pd.DataFrame:
    with np.load(path) as stored:
        missing = {"time", "values", "names", "units"} - set(stored.files)
        if missing:
            raise ModelError(f"no array {', '.join(sorted(missing))}; not a saved result")
        names, units = stored["names"].tolist(), stored["units"].tolist()
        columns = dict(zip(names, stored["values"].T, strict=True))
        return _table(columns, stored["time"], dict(zip(names, units, strict=True)))


def _read_parquet(path: Path) -> pd.DataFrame:
    import pandas as pd

    table = pd.read_parquet(path)
    if table.index.name != "time":
        if "time" not in table.columns:
            raise ModelError(f"no column 'time' among {', '.join(table.columns)}")
        table = table.set_index("time")
    table.attrs.setdefault("units", dict.fromkeys(table.columns, ""))
    return table


def _read_csv(path: Path) -> pd.DataFrame:
    lines = text_of(path).rstrip().splitlines()
    rows = csv.reader(lines, skipinitialspace=True)
    headers = [_split(header) for header in next(rows, [])]
    units = dict(headers)
    _check_headers(path, [name for name, _ in headers], units)
    numbers = [_numbers(path, line, row, list(units)) for line, row in enumerate(rows, start=2)]
    columns = dict(zip(units, np.array(numbers, ndmin=2).reshape(-1, len(units)).T, strict=True))
    del units["time"]
    return _table(columns, columns.pop("time"), units)


def _split(header: str) -> tuple[str, str]:
    found = re.fullmatch(r"(.*?)\s*\[([^\[\]]*)\]", header.strip())
    return (found[1], found[2]) if found else (header.strip(), "")


def _check_headers(path: Path, names: list[str], units: dict[str, str]) -> None:
    where = f"{path}, line 1"
    if "time" not in units:
        raise ModelError(
            f"{where}: no column 'time' among {', '.join(names)}; name one 'time' or 'time [s]', and "
            "separate columns by commas"
        )
    if units["time"] not in ("", "s"):
        raise ModelError(f"{where}, column 'time': the unit must be s, got {units['time']}")
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ModelError(f"{where}: column '{twice[0]}' is there twice")


def _numbers(path: Path, line: int, row: list[str], names: list[str]) -> list[float]:
    if len(row) != len(names):
        raise ModelError(f"{path}, line {line}: {len(row)} cells, but {len(names)} columns")
    try:
        return [float(cell) for cell in row]
    except ValueError:
        column = next(i for i, cell in enumerate(row) if not _is_number(cell))
        raise ModelError(
            f"{path}, line {line}, column '{names[column]}': '{row[column]}' is no number"
        ) from None


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
