"""Tables of elements, read from files."""

from pathlib import Path
from typing import Any

from ...base import ModelError, demand, path_of
from ...base.tables import read_table

Points = tuple[tuple[float, ...], ...]


def load_points(path: str | Path, columns: dict[str, str]) -> Points:
    """Return columns of a .csv, .txt, .parquet, .npz or .mat file as rows of numbers, as tables take them.

    Args:
        path: the file, whose columns have names such as `x` or `x [mm]`.
        columns: the columns wanted, in their order, with the SI unit in which each is wanted.

    Raises:
        ModelError: for a column that is not there, a unit of another quantity, or a cell that is no number.
        MissingFileError: if there is no such file.

    Example:
        >>> from pathlib import Path
        >>> from tempfile import TemporaryDirectory
        >>> from inertance import TabulatedSpring, load_points
        >>> with TemporaryDirectory() as folder:
        ...     path = Path(folder) / "spring.csv"
        ...     _ = path.write_text("x [mm],F [kN]" + chr(10) + "0,0" + chr(10) + "10,2")
        ...     table = load_points(path, {"x": "m", "F": "N"})
        >>> table
        ((0.0, 0.0), (0.01, 2000.0))
        >>> spring = TabulatedSpring(table=table)
    """
    demand("load_points()", columns=(columns, _names_of_columns))
    table = read_table(path_of(path, "a table"))
    taken = {name: table.in_si(name, unit) for name, unit in columns.items()}
    wrong = [told for name, values in taken.items() if (told := table.number_problem(name, values))]
    if wrong:
        raise ModelError("these points cannot be used:", wrong)
    return tuple(tuple(map(float, row)) for row in zip(*taken.values(), strict=True))


def _names_of_columns(given: Any) -> str:
    good = (
        isinstance(given, dict) and given and all(isinstance(t, str) for pair in given.items() for t in pair)
    )
    return "" if good else "must map names of columns to units, such as {'x': 'm', 'F': 'N'}"
