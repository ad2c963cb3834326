"""Tables of numbers in files, whatever their format: columns by name, with their units."""

import csv
import re
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import Array
from .errors import InertanceError, MissingPackageError, ModelError, nearest
from .files import text_of, there_is_file
from .units import G, unit_for

TIMES = ("time", "t", "zeit", "timestamp", "time_s")


@dataclass(frozen=True, eq=False)
class Table:
    """Columns by name, their units where the file tells them, and the line of the first row (0 if none).

    Cells that are empty are no numbers (NaN).
    """

    path: Path
    columns: dict[str, Array]
    units: dict[str, str]
    first_line: int

    def at(self, column: str, row: int = -1) -> str:
        """Return where a cell stands, or the name of a column."""
        place = f"line {self.first_line + row}" if self.first_line else f"row {row + 1}" if row >= 0 else ""
        return ", ".join(filter(None, (str(self.path), place, f"column '{column}'")))

    def column(self, name: str) -> Array:
        """Return a column; raise a ModelError if there is none of that name, with the nearest one."""
        if name not in self.columns:
            known = nearest(name, self.columns) or f"; its columns are {', '.join(self.columns)}"
            raise ModelError(f"{self.path}: there is no column '{name}'{known}")
        return self.columns[name]

    @property
    def time_name(self) -> str:
        """Name of the column of time; a ModelError is raised if there is none."""
        for name in self.columns:
            if name.lower() in TIMES:
                return name
        raise ModelError(
            f"{self.path}: there is no column of time among {', '.join(self.columns)}; name one 'time' or 't'"
        )

    def in_si(self, name: str, wanted: str) -> Array:
        """Return a column in an SI unit, which it has unless the file says another of the same quantity."""
        values, unit = self.column(name), self.units.get(name, "")
        try:
            return values if unit in ("", wanted) else unit_for(unit, wanted).to_si(values)
        except ModelError as error:
            raise ModelError(f"{self.at(name)}: {error}") from error

    def number_problem(self, name: str, values: Array) -> str:
        """Say where the values of a column are no finite numbers; nothing if they all are."""
        wrong = np.flatnonzero(~np.isfinite(values))
        if not len(wrong):
            return ""
        told = f"{values[wrong[0]]} is no usable number ({len(wrong)} such in this column)"
        return f"{self.at(name, int(wrong[0]))}: {told}; fill or cut it out"

    def time_problem(self, name: str, time: Array) -> str:
        """Say where the values of a column do not increase from row to row; nothing if they do."""
        step = np.diff(time)
        wrong = self.number_problem(name, time)
        if wrong or (step > 0).all():
            return wrong
        row = int(np.argmax(step < 0 if (step < 0).any() else step == 0)) + 1
        if step[row - 1] < 0:
            told = f"{time[row]:g} comes after {time[row - 1]:g}; sort the lines by time"
        else:
            same = np.count_nonzero(step == 0)
            told = f"{time[row]:g} stands there twice ({same} such); keep one line of each instant"
        return f"{self.at(name, row)}: {told}"


def read_table(path: Path) -> Table:
    """Return the table in a .csv, .txt, .parquet, .npz, .mat or .at2 file.

    Text has one line of names, such as `x`, `x [mm]` or `x (mm)`, and columns parted by commas; or by
    semicolons or tabs, and then decimal commas, too. An .at2 file of the PEER ground motion database is a
    column `acceleration` [m/s2].
    What is no table of numbers raises a ModelError with file, line and column.
    """
    ending = path.suffix.lower()
    if ending not in READERS:
        raise ModelError(f"'{path}' ends in '{path.suffix}'; tables end in {', '.join(READERS)}")
    there_is_file(path)
    try:
        return READERS[ending](path)
    except InertanceError:
        raise
    except Exception as error:  # every library that reads a format has errors of its own
        raise ModelError(f"{path}: cannot be read as a {ending} file ({error})") from error


def need_pyarrow(path: Path) -> None:
    """Raise a MissingPackageError if there is nothing to read or write a .parquet file with."""
    if find_spec("pyarrow") is None:
        raise MissingPackageError(
            f"'{path}': .parquet needs pyarrow; run `pip install 'inertance[parquet]'` or use .csv"
        )


def _headed(header: str) -> tuple[str, str]:
    """Return name and unit of headers such as `x [mm]` or `x (mm)`."""
    found = re.fullmatch(r"(.*?)\s*(?:\[([^\[\]]*)\]|\(([^()]*)\))", header.strip())
    return (found[1], found[2] or found[3] or "") if found else (header.strip(), "")


def _read_text(path: Path) -> Table:
    lines = text_of(path).rstrip(" \r\n").splitlines()
    header = next(
        (n for n, line in enumerate(lines) if line.strip() and not line.startswith(("#", "%"))), None
    )
    if header is None:
        raise ModelError(f"{path}: the file is empty")
    mark = next((m for m in (";", "\t") if m in lines[header]), ",")
    head, *rows = csv.reader(lines[header:], delimiter=mark, skipinitialspace=True)
    headed = [_headed(cell) for cell in head]
    names = [name for name, _ in headed]
    _check_names(f"{path}, line {header + 1}", names)
    for line, row in enumerate(rows, start=header + 2):
        if len(row) != len(names):
            told = f"{len(row)} cells under {len(names)} names"
            raise ModelError(f"{path}, line {line}: {told}; complete or cut the line")
    table = Table(path, {}, dict(headed), header + 2)
    for name, cells in zip(names, zip(*rows, strict=True) if rows else [()] * len(names), strict=True):
        table.columns[name] = _numbers(table, name, cells, "," if mark != "," else ".")
    return table


def _check_names(where: str, names: list[str]) -> None:
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ModelError(f"{where}: two columns are called '{twice[0]}'; rename one")
    if all(_is_number(name) for name in names):
        raise ModelError(f"{where}: numbers instead of names; put a line of column names on top")


def _numbers(table: Table, name: str, cells: tuple[str, ...], decimal: str = ".") -> Array:
    spelt = [cell.strip().replace(decimal, ".") or "nan" for cell in cells]
    try:
        return np.array(spelt, dtype=float)
    except ValueError:
        row = next(row for row, cell in enumerate(spelt) if not _is_number(cell))
        raise ModelError(
            f"{table.at(name, row)}: '{cells[row].strip()}' is no number; correct or remove it"
        ) from None


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _read_parquet(path: Path) -> Table:
    need_pyarrow(path)
    import pandas as pd

    frame = pd.read_parquet(path)
    units = frame.attrs.get("units", {})
    if frame.index.name:
        frame = frame.reset_index()
    table = _split(path, {str(name): frame[name].to_numpy(dtype=float) for name in frame.columns})
    return Table(path, table.columns, {**table.units, **units}, 0)


def _read_npz(path: Path) -> Table:
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files}
    if not {"time", "values", "names"} <= arrays.keys():
        return _split(path, _vectors(path, arrays))
    names = arrays["names"].tolist()
    columns = dict(zip(names, arrays["values"].T, strict=True))
    units = dict(zip(names, arrays["units"].tolist(), strict=True)) if "units" in arrays else {}
    return Table(path, {"time": arrays["time"], **columns}, units, 0)


def _read_mat(path: Path) -> Table:
    from scipy.io import loadmat

    try:
        stored = loadmat(path)
    except NotImplementedError as error:
        raise ModelError(
            f"{path}: MAT files of version 7.3 are HDF5; save it with `save('{path.stem}.mat', '-v7')`"
        ) from error
    return _split(path, _vectors(path, {n: value for n, value in stored.items() if not n.startswith("__")}))


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


def _split(path: Path, columns: dict[str, Array]) -> Table:
    """Part the units from the names of columns."""
    headed = {name: _headed(name) for name in columns}
    return Table(path, {headed[n][0]: v for n, v in columns.items()}, dict(headed.values()), 0)


def _read_peer(path: Path) -> Table:
    lines = text_of(path).splitlines()
    facts = dict(re.findall(r"(NPTS|DT)\s*=\s*([\d.eE+-]+)", lines[3].upper())) if len(lines) > 4 else {}
    if "DT" not in facts:
        raise ModelError(f"{path}, line 4: no 'DT=' as the PEER format has it")
    rows = [
        _numbers(Table(path, {}, {}, line), "acceleration", (cell,))
        for line, text in enumerate(lines[4:], start=5)
        for cell in text.split()
    ]
    if len(rows) != int(facts.get("NPTS", len(rows))):
        raise ModelError(f"{path}: line 4 says {facts['NPTS']} values, there are {len(rows)}")
    time: Array = float(facts["DT"]) * np.arange(len(rows), dtype=float)
    acceleration: Array = G * np.array(rows, dtype=float).ravel()
    units = {"time": "s", "acceleration": "m/s2"}
    return Table(path, {"time": time, "acceleration": acceleration}, units, 0)


READERS: dict[str, Callable[[Path], Table]] = {
    ".csv": _read_text, ".txt": _read_text, ".parquet": _read_parquet, ".npz": _read_npz, ".mat": _read_mat,
    ".at2": _read_peer,
}  # fmt: skip
