"""Results as files: .csv, .parquet and .npz, with the unit of every column."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import ModelError, check_output, path_of, writing
from ...base.tables import need_pyarrow, read_table

if TYPE_CHECKING:
    import pandas as pd

    from .result import Result

ENDINGS = (".csv", ".parquet", ".npz")


def save_result(result: Result, path: Path, names: Sequence[str]) -> Path:
    """Write signals of a run to a file and return its path; see `Result.save`."""
    ending = check_table_path(path)
    table = result.to_dataframe(*names)
    with writing(path) as part:
        _write(table, part, ending)
    return path


def _write(table: pd.DataFrame, path: Path, ending: str) -> None:
    names = list(table.columns)
    units = [table.attrs["units"][name] for name in names]
    if ending == ".csv":
        table.columns = [f"{n} [{unit}]" if unit else n for n, unit in zip(names, units, strict=True)]
        table.to_csv(path, index_label="time [s]", encoding="utf-8")
    elif ending == ".parquet":
        table.to_parquet(path)
    else:
        time, values = table.index.to_numpy(), table.to_numpy()
        labels: Any = {"names": np.array(names, dtype=str), "units": np.array(units, dtype=str)}
        with path.open("wb") as file:  # by its name NumPy would add an ending
            np.savez_compressed(file, time=time, values=values, **labels)


def load_table(path: str | Path) -> pd.DataFrame:
    """Return the table in a .csv, .txt, .parquet, .npz, .mat or .at2 file.

    Its index is the time [s]; `attrs["units"]` holds the unit of every column, "" if the file tells none.
    Text has one line of names, such as `x` or `x [mm]`, and columns parted by commas; or by semicolons or
    tabs, and then decimal commas, too. Empty cells are NaN.

    Args:
        path: a file written by `Result.save`, or one of measurements.

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
    import pandas as pd

    table = read_table(path_of(path, "a table"))
    columns = {name: column for name, column in table.columns.items() if name != table.time_name}
    frame = pd.DataFrame(columns, index=pd.Index(table.in_si(table.time_name, "s"), name="time"))
    frame.attrs["units"] = {name: table.units.get(name, "") for name in columns}
    return frame


def check_table_path(path: Path) -> str:
    """Return the ending of a file to be written, or raise what `save_result` would raise."""
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise ModelError(f"'{path}' ends in '{path.suffix}'; tables end in {', '.join(ENDINGS)}")
    check_output(path)
    if ending == ".parquet":
        need_pyarrow(path)
    return ending
