"""Tables: the columns of a file of measurements, whatever its format."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import text_of, there_is_file
from ...components import ModelError, nearest

Array = NDArray[np.float64]
TIMES = ("time", "t", "zeit", "timestamp", "time_s")


@dataclass(frozen=True, eq=False)
class Table:
    """Columns by name, their units where the file tells them, and the line of the first row (0 if none)."""

    path: Path
    columns: dict[str, Array]
    units: dict[str, str]
    first_line: int

    def place(self, row: int) -> str:
        """Return where a row stands in the file."""
        return f"line {self.first_line + row}" if self.first_line else f"row {row + 1}"

    def column(self, name: str) -> Array:
        """Return a column.

        Raises:
            ModelError: if there is none of that name, with the nearest one.
        """
        if name not in self.columns:
            known = nearest(name, self.columns) or f"; its columns are {', '.join(self.columns)}"
            raise ModelError(f"{self.path}: there is no column '{name}'{known}")
        return self.columns[name]

    @property
    def time_name(self) -> str:
        """Name of the column of time.

        Raises:
            ModelError: if there is none.
        """
        for name in self.columns:
            if name.lower() in TIMES:
                return name
        raise ModelError(
            f"{self.path}: there is no column of time among {', '.join(self.columns)}; name one 'time' or 't'"
        )


def read_table(path: Path) -> Table:
    """Return the table in a .csv, .txt, .parquet, .mat or .npz file.

    Raises:
        ModelError: for a missing file, another ending, and what is no table of numbers.
    """
    if path.suffix.lower() not in READERS:
        raise ModelError(f"'{path}' ends in '{path.suffix}'; measurements end in {', '.join(READERS)}")
    there_is_file(path)
    try:
        return READERS[path.suffix.lower()](path)
    except ModelError:
        raise
    except Exception as error:  # every library that reads a format has errors of its own
        raise ModelError(f"{path}: cannot be read as a {path.suffix} file ({error})") from error


def _headed(header: str) -> tuple[str, str]:
    """Return name and unit of headers such as `x [mm]` or `x (mm)`."""
    found = re.fullmatch(r"(.*?)\s*[\[(]([^\[\]()]*)[\])]", header.strip())
    return (found[1], found[2]) if found else (header.strip(), "")


def _read_csv(path: Path) -> Table:
    lines = text_of(path).splitlines()
    header = next(
        (n for n, line in enumerate(lines) if line.strip() and not line.startswith(("#", "%"))), None
    )
    if header is None:
        raise ModelError(f"{path}: the file is empty")
    mark = next((m for m in (";", "\t", ",") if m in lines[header]), ",")
    headed = [_headed(cell) for cell in lines[header].split(mark)]
    names = [name for name, _ in headed]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ModelError(f"{path}, line {header + 1}: two columns are called '{twice[0]}'; rename one")
    if all(_is_number(name) for name in names):
        raise ModelError(
            f"{path}, line {header + 1}: numbers instead of names; put a line of column names on top"
        )
    while lines and not lines[-1].strip():
        lines.pop()
    cells = [line.split(mark) for line in lines[header + 1 :]]
    for number, row in enumerate(cells):
        if len(row) != len(names):
            told = f"{len(row)} cells under {len(names)} names"
            raise ModelError(f"{path}, line {header + 2 + number}: {told}; complete or cut the line")
    decimal = "," if mark != "," else ""
    columns = {
        name: _numbers(path, name, [row[n] for row in cells], header + 2, decimal)
        for n, name in enumerate(names)
    }
    return Table(path, columns, dict(headed), header + 2)


def _numbers(path: Path, name: str, cells: list[str], line: int, decimal: str) -> Array:
    if decimal:
        cells = [cell.replace(decimal, ".") for cell in cells]
    try:
        return np.array(cells, dtype=float)
    except ValueError:
        pass
    values = np.full(len(cells), np.nan)
    for number, cell in enumerate(cells):
        if _is_number(cell):
            values[number] = float(cell)
        elif cell.strip():
            told = f"'{cell.strip()}' is no number; correct or remove it"
            raise ModelError(f"{path}, line {line + number}, column '{name}': {told}")
    return values


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _read_parquet(path: Path) -> Table:
    if find_spec("pyarrow") is None:
        raise ModelError(
            f"'{path}': .parquet needs pyarrow; run `pip install 'inertance[parquet]'` or use .csv"
        )
    import pandas as pd

    table = pd.read_parquet(path)
    if table.index.name:
        table = table.reset_index()
    columns = {str(name): table[name].to_numpy(dtype=float) for name in table.columns}
    return Table(path, *_split(columns), 0)


def _read_npz(path: Path) -> Table:
    with np.load(path) as stored:
        if {"time", "values", "names"} <= set(stored.files):
            columns = dict(zip(stored["names"].tolist(), stored["values"].T, strict=True))
            return Table(path, {"time": stored["time"], **columns}, {}, 0)
        arrays = {name: stored[name] for name in stored.files}
    return Table(path, *_split(_vectors(path, arrays)), 0)


def _read_mat(path: Path) -> Table:
    from scipy.io import loadmat

    try:
        stored = loadmat(path)
    except NotImplementedError as error:
        raise ModelError(
            f"{path}: MAT files of version 7.3 are HDF5; save it with `save('{path.stem}.mat', '-v7')`"
        ) from error
    arrays = {name: value for name, value in stored.items() if not name.startswith("__")}
    return Table(path, *_split(_vectors(path, arrays)), 0)


def _vectors(path: Path, arrays: dict[str, Any]) -> dict[str, Array]:
    """Return the arrays that are columns of one table: numeric vectors as long as the longest."""
    vectors = {
        name: np.asarray(value, dtype=float).ravel()
        for name, value in arrays.items()
        if np.issubdtype(np.asarray(value).dtype, np.number)
        and np.size(value) == max(np.shape(value), default=1)
    }
    longest = max(map(len, vectors.values()), default=0)
    columns = {name: value for name, value in vectors.items() if len(value) == longest}
    if longest < 2:
        raise ModelError(
            f"{path}: there are no columns of numbers in it, only {', '.join(arrays) or 'nothing'}"
        )
    return columns


def _split(columns: dict[str, Array]) -> tuple[dict[str, Array], dict[str, str]]:
    """Part the units from the names of columns."""
    headed = {name: _headed(name) for name in columns}
    return {headed[n][0]: v for n, v in columns.items()}, dict(headed.values())


READERS: dict[str, Callable[[Path], Table]] = {
    ".csv": _read_csv, ".txt": _read_csv, ".parquet": _read_parquet, ".npz": _read_npz, ".mat": _read_mat,
}  # fmt: skip
