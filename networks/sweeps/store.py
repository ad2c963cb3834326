"""Where results of a sweep are kept: a .parquet or .csv file, and beside it a journal of the latest ones."""

from __future__ import annotations

import csv
import json
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from ...base import ModelError, claimed, refusal, writing
from ..results.storage import check_table_path
from .work import RESERVED, Row

if TYPE_CHECKING:
    import pandas as pd

FOLDING_SECONDS = 30.0
KEPT = ("key", "values", "results", "error", "seconds")


@contextmanager
def opened(path: Path | None, names: tuple[str, ...], mark: str) -> Iterator[Store]:
    """Give a store that is nobody else's meanwhile; see `Store`."""
    if path is None:
        yield Store(None, names, mark)
        return
    if check_table_path(path) not in (".parquet", ".csv"):
        raise ModelError(f"'{path}': results of a sweep go to .parquet or .csv")
    with claimed(path):
        yield Store(path, names, mark)


class Store:
    """Rows of a sweep by key; each is on the disk before the next is waited for.

    A row is appended to `path`.journal at once. Twice a minute and at the end all rows are written into the
    table, in one step, and the journal starts anew. Whatever is interrupted, table and journal hold all rows.
    Without a path rows are in memory only. A file with the mark of another sweep is refused.
    """

    def __init__(self, path: Path | None, names: tuple[str, ...], mark: str) -> None:
        self.path, self.names, self.mark = path, names, mark
        self.rows: dict[str, Row] = {}
        self._journal: IO[str] | None = None
        self._folded = time.monotonic()
        if path is not None:
            self.journal = path.with_name(f"{path.name}.journal")
            self.rows = {row.key: row for row in (*self._tabled(path), *self._journaled())}
            if self.journal.is_file():
                self.fold()

    def add(self, row: Row) -> None:
        if row.key in self.rows:
            return
        self.rows[row.key] = row
        if self.path is None:
            return
        kept = {name: value for name, value in asdict(row).items() if name in KEPT}
        line = json.dumps({"mark": self.mark, "row": kept})
        try:
            if self._journal is None:
                self._journal = self.journal.open("a", encoding="utf-8")
            self._journal.write(line + "\n")
            self._journal.flush()
        except OSError as error:
            raise refusal(self.journal, error) from error
        if time.monotonic() - self._folded > FOLDING_SECONDS:
            self.fold()

    def fold(self) -> None:
        """Write all rows into the table and begin a new journal."""
        if self.path is None:
            return
        if self._journal is not None:
            journal, self._journal = self._journal, None
            with suppress(OSError):  # what it could not take is in the table
                journal.close()
        if not self.rows:
            return
        table = self.table(self.rows)
        table.insert(0, "key", list(self.rows))
        with writing(self.path) as part:
            if self.path.suffix.lower() == ".parquet":
                table.attrs["sweep"] = self.mark
                table.to_parquet(part, index=False)
            else:
                table.insert(1, "sweep", self.mark)
                table.to_csv(part, index=False, encoding="utf-8")
        self.journal.unlink(missing_ok=True)
        self._folded = time.monotonic()

    def table(self, keys: Iterable[str]) -> pd.DataFrame:
        """Return the rows of some keys as a table: parameters, results, error, seconds."""
        import pandas as pd

        rows = [self.rows[key] for key in keys]
        results = dict.fromkeys(name for row in self.rows.values() for name in row.results)
        columns: dict[str, list[Any]] = {name: [row.values[name] for row in rows] for name in self.names}
        columns |= {name: [row.results.get(name) for row in rows] for name in results}
        columns |= {name: [getattr(row, name) for row in rows] for name in ("error", "seconds")}
        return pd.DataFrame(columns)

    def _journaled(self) -> Iterator[Row]:
        for line in self.journal.read_text(encoding="utf-8").splitlines() if self.journal.is_file() else ():
            with suppress(json.JSONDecodeError):
                entry = json.loads(line)
                self._check(entry["mark"])
                yield Row(**{"values": entry.get("values"), **entry["row"]})

    def _tabled(self, path: Path) -> Iterator[Row]:
        if not path.is_file():
            return
        mark, records = _read(path)
        self._check(mark)
        for record in records:
            results = {n: v for n, v in record.items() if n not in (*self.names, *RESERVED)}
            error = str(record["error"] or "")
            values = {name: record[name] for name in self.names}
            yield Row(str(record["key"]), values, {} if error else results, error, float(record["seconds"]))

    def _check(self, mark: str) -> None:
        if mark != self.mark:
            raise ModelError(
                f"'{self.path}' holds another sweep (of another model, measure, or other parameters); choose "
                "another path, or remove it"
            )


def _read(path: Path) -> tuple[str, list[dict[str, Any]]]:
    """Return the mark of a table and its rows."""
    if path.suffix.lower() == ".parquet":
        import pandas as pd

        table: Any = pd.read_parquet(path)
        return str(table.attrs.get("sweep", "")), table.to_dict("records")
    with path.open(encoding="utf-8", newline="") as file:
        rows: list[dict[str, Any]] = list(csv.DictReader(file))
    mark = rows[0].get("sweep", "") if rows else ""
    texts = ("key", "error")
    return mark, [{n: v if n in texts else _number(v) for n, v in r.items() if n != "sweep"} for r in rows]


def _number(cell: str) -> float | str | None:
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell
