"""What is wrong with the entries of a campaign, gathered so that all of it is told at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...base import counting, is_number
from ...components import InertanceError, ModelError, nearest


@dataclass(frozen=True)
class Kind:
    """What a key takes, in words, and whether a value is that."""

    told: str
    takes: Callable[[Any], bool]


def _is_list(value: Any, of: Callable[[Any], bool]) -> bool:
    return isinstance(value, list | tuple) and len(value) > 0 and all(map(of, value))


TEXT = Kind("a text in quotes", lambda v: isinstance(v, str))
FILE = Kind("the name of a file in quotes", lambda v: isinstance(v, str | Path) and bool(str(v)))
NUMBER = Kind("a finite number", is_number)
COUNT = Kind("a whole number, at least 1", lambda v: not counting(v))
NUMBERS = Kind("a number or two in brackets", lambda v: is_number(v) or _is_list(v, is_number))
TEXTS = Kind('texts in brackets, such as ["a", "b"]', lambda v: _is_list(v, TEXT.takes))
COUNTS = Kind("whole numbers in brackets, from 1", lambda v: _is_list(v, COUNT.takes))
INTERVAL = Kind(
    "[from, to] in s, from before to", lambda v: _is_list(v, is_number) and len(v) == 2 and v[0] < v[1]
)
TABLE = Kind("a table in braces", lambda v: isinstance(v, Mapping))


class Problems:
    """Everything that is wrong, told at once."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.found: list[str] = []

    def add(self, *problems: str) -> None:
        self.found += problems

    def none(self, where: str, problems: Iterable[str]) -> bool:
        """Return whether an entry has no problems; note those it has."""
        before = len(self.found)
        self.found += [f"{where}: {problem}" if where else problem for problem in problems]
        return len(self.found) == before

    def sound(self, where: str, entry: Any, kinds: Mapping[str, Kind]) -> bool:
        """Return whether an entry is a table of these keys with what they take; note what is wrong."""
        return self.none(where, _unsound(entry, kinds))

    @contextmanager
    def of(self, where: str) -> Iterator[None]:
        """Note what the library refuses within, as a problem of an entry."""
        try:
            yield
        except InertanceError as error:
            listed = getattr(error, "problems", None) or [str(error)]
            prefix = "" if str(listed[0]).startswith(where) else f"{where}: "
            self.found += [f"{prefix}{problem}" for problem in listed]
        except KeyError as error:
            self.add(f"{where}: {error.args[0]}")

    def stop(self) -> None:
        if self.found:
            raise ModelError(f"{self.source} cannot be used:", self.found)


def _unsound(entry: Any, kinds: Mapping[str, Kind]) -> Iterator[str]:
    if not isinstance(entry, Mapping):
        yield f"a table of {', '.join(kinds)} is needed, got {entry!r}"
        return
    for key, value in entry.items():
        if key not in kinds:
            known = nearest(str(key), kinds) or f"; known are {', '.join(kinds)}"
            yield f"there is no key '{key}'{known}"
        elif not kinds[key].takes(value):
            yield f"{key} must be {kinds[key].told}, got {value!r}"
