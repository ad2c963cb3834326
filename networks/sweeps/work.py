"""The work of a sweep: what a process does for its points."""

from __future__ import annotations

import pickle
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from ...base import InertanceError, ModelError
from ..dae import DAE
from ..lanes.gatherer import Gatherer
from ..model_file import UserCodeError, load_model
from ..network import Network

Values = dict[str, Any]
Model = Network | str | Callable[[], Network] | None
RESERVED = ("key", "error", "seconds")
_ASSEMBLED: dict[bytes, Work] = {}


@dataclass(frozen=True)
class Row:
    """What came of a point, the values of parameters: results, or an error; `key` says which point.

    Attributes:
        at_once: how many points whoever computed it would take at once.
        runs: how runs of its block went, and how many: side by side, or why alone.
    """

    key: str
    values: Values
    results: dict[str, Any]
    error: str
    seconds: float
    at_once: int = 1
    runs: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Work:
    """A measure and the equations it is taken from, assembled once a process."""

    measure: Callable[..., Any]
    dae: DAE | None
    gatherer: Gatherer

    def rows(self, points: Sequence[tuple[str, Values]]) -> Iterator[Row]:
        """Yield what comes of points; those whose runs go side by side share the time that takes."""
        began = time.perf_counter()
        for block in self.gatherer.blocks([partial(self.row, *point) for point in points]):
            now = time.perf_counter()
            runs, self.gatherer.told = dict(self.gatherer.told), Counter()
            for row in block:
                yield replace(
                    row, seconds=(now - began) / len(block), at_once=self.gatherer.at_once, runs=runs
                )
                runs = {}
            began = time.perf_counter()

    def row(self, key: str, values: Values) -> Row:
        started = time.perf_counter()
        results: dict[str, Any] = {}
        error = ""
        try:
            equations = () if self.dae is None else (self.dae,)
            results = named(self.measure(*equations, dict(values)))
        except Exception as problem:
            error = f"{type(problem).__name__}: {problem}"
        return Row(key, values, results, error, time.perf_counter() - started)


def packed(model: Model, measure: Callable[..., Any], expected: int) -> bytes:
    """Return model and measure as bytes for other processes, each of which gets as many points as `expected`.

    Raises:
        ModelError: if they cannot be sent.
    """
    try:
        import cloudpickle as pickler  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        pickler = pickle
    if isinstance(model, str):
        file, _, function = model.rpartition(":")
        model = f"{Path(file).resolve()}:{function}"
    try:
        return bytes(pickler.dumps((model, measure, expected)))
    except Exception as error:
        raise ModelError(
            f"model and measure cannot be sent to other processes ({error}); define functions at the top "
            "of a module, install cloudpickle, or give workers=0"
        ) from error


def bequeath(blob: bytes, work: Work) -> None:
    """Keep the equations for further points, and for processes that are forked from this one."""
    _ASSEMBLED.clear()
    _ASSEMBLED[blob] = work


def work(blob: bytes, points: list[tuple[str, Values]]) -> list[Row]:
    """Return what comes of some points; runs in another process."""
    if blob not in _ASSEMBLED:
        model, measure, expected = pickle.loads(blob)
        bequeath(blob, Work(measure, equations(model), Gatherer(expected)))
    return [*_ASSEMBLED[blob].rows(points)]


def equations(model: Model) -> DAE | None:
    """Return the equations of a network, of what a function returns, or of "path/to/file.py:function"."""
    if model is None:
        return None
    network: Any = model
    if isinstance(model, str):
        network = load_model(model)
    elif callable(model):
        network = _called(model)
    if not isinstance(network, Network):
        raise ModelError(f"a sweep is over a Network, or what returns one, got {network!r}")
    return network.dae()


def _called(model: Callable[[], Network]) -> Any:
    name = getattr(model, "__name__", repr(model))
    try:
        return model()
    except Exception as error:
        kind = "" if isinstance(error, InertanceError) else f"{type(error).__name__}: "
        raise UserCodeError(f"model '{name}': {kind}{error}") from error


def named(found: Any) -> dict[str, float | str | None]:
    """Return results by name as plain numbers; a single one is called `value`."""
    given = found if isinstance(found, dict) else {"value": found}
    for name, value in given.items():
        if name in RESERVED:
            raise TypeError(f"a measure cannot be called '{name}'")
        if not (value is None or isinstance(value, str)) and getattr(value, "size", 1) != 1:
            raise TypeError(f"measure '{name}' is {type(value).__name__}, but must be one number")
    return {name: v if v is None or isinstance(v, str) else float(v) for name, v in given.items()}
