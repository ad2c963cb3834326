"""`sweep`: a measure of a network at many parameter values, in many processes, resumable."""

from __future__ import annotations

import inspect
import json
from collections import Counter
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import closing
from dataclasses import dataclass, field, replace
from hashlib import sha256
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...base import ModelError, SimulationError, boolean, demand, nearest, optional, path_of, whole
from ...base.html import more, page, table_of_texts
from ..dae import DAE
from ..lanes.gatherer import Gatherer
from ..simulation.progress import Progress
from .design import Design, grid
from .store import Store, opened
from .work import Model, Row, Values, Work, bequeath, equations, packed

if TYPE_CHECKING:
    import pandas as pd


MOST_ROWS = 20  # that a notebook shows


class SweepInterruptedError(KeyboardInterrupt):
    """Ctrl-C during a sweep; `sweep` holds what was done by then."""

    def __init__(self, message: str, sweep: Sweep) -> None:
        self.sweep = sweep
        super().__init__(message)


@dataclass(frozen=True, eq=False)
class Sweep:
    """What came of a sweep.

    Attributes:
        design: the points asked for.
        table: a row for each point that was done, in their order: parameters, results, `error` (empty if all
            went well) and `seconds`; its index counts the points of the design.
        resumed: how many of them were in the file already.
        runs: how runs of the others went, and how many: side by side in lanes, or why alone.
    """

    design: Design
    table: pd.DataFrame
    resumed: int
    runs: Mapping[str, int] = field(default_factory=dict)

    @property
    def failed(self) -> pd.DataFrame:
        """The rows with an error."""
        return self.table.query("error != ''")

    def __repr__(self) -> str:
        return f"<Sweep: {self._told()}>"

    def _told(self) -> str:
        return f"{len(self.table)} of {len(self.design)} points, {len(self.failed)} failed"

    def _repr_html_(self) -> str:
        first = self.table.head(MOST_ROWS)
        rows = ([f"{v:.5g}" if isinstance(v, float) else str(v) for v in row] for row in first.values)
        shown = table_of_texts([str(column) for column in first.columns], rows)
        return page("sweep", self._told(), shown, more(len(self.table) - len(first)))


def sweep(
    model: Model,
    parameters: Design | Mapping[str, Iterable[Any]],
    measure: Callable[..., Any],
    *,
    executor: Any = None,
    workers: int | None = None,
    path: str | Path | None = None,
    progress: bool | None = None,
) -> Sweep:
    """Return a measure of a network at many points.

    Every point gets one row: its results, or the message of its error. A process that dies is replaced and
    its points are done again. Runs that measures ask for by `simulate` go side by side in lanes, as those of
    an ensemble, where they are alike and that pays; `runs` of the sweep tells. With a `path`, rows are on
    the disk as they come; the same call goes on where an interrupted one stopped. Ctrl-C keeps what is done.

    Args:
        model: a network; a function that returns one; "path/to/file.py:function"; or None, if the measure
            builds its own. It is assembled once a process.
        parameters: the points: a `Design` (`grid`, `monte_carlo`, `latin_hypercube`, `sobol_sequence`,
            `saltelli`), or values by name for a grid.
        measure: `measure(dae, values)`, or `measure(values)` without a model: returns a number, or numbers by
            name. `values` are the parameters of the point, as `simulate(dae, parameters=values)` takes them.
        executor: None for processes of its own; an executor of `concurrent.futures`; a
            `dask.distributed.Client`.
        workers: how many processes of its own; 0 computes in this one.
        path: a .parquet or .csv file for the results.
        progress: show progress and time left; by default if it takes over a second on a terminal.

    Raises:
        ModelError: for unknown parameters, a model that cannot be assembled, or a file of another sweep.
        SimulationError: if no point could be computed; its `result` is the sweep.
        SweepInterruptedError: on Ctrl-C.

    Limits: on systems that start processes anew (Windows, macOS), a script that sweeps needs
    `if __name__ == "__main__":`; functions defined in a notebook need cloudpickle there.

    Example:
        >>> from inertance import Damper, Fixed, Mass, Network, Spring, parallel, simulate
        >>> from inertance.sweeps import sweep
        >>> strut = parallel(Spring(k=1.0), Damper(d=0.1))
        >>> net = Network("swing", wall=Fixed(), strut=strut, mass=Mass(m=1.0))
        >>> _ = net.connect(net.wall.flange, net.strut.flange_a)
        >>> _ = net.connect(net.strut.flange_b, net.mass.flange)
        >>> def peak(dae, values):
        ...     return simulate(dae, 10.0, parameters=values, start={"mass.v": 1.0})["mass.s"].max()
        >>> done = sweep(net, {"strut.damper.d": [0.1, 0.2, 0.4]}, peak, workers=0)
        >>> [round(value, 2) for value in done.table["value"]]
        [0.93, 0.86, 0.76]
    """
    demand("sweep()", workers=(workers, optional(whole(0))), progress=(progress, optional(boolean)))
    if not callable(measure):
        raise ModelError(f"a measure is a function of the equations and the values, got {measure!r}")
    design = parameters if isinstance(parameters, Design) else grid(parameters)
    dae = equations(model)
    if dae is not None:
        _check_names(dae, design)
    values = [dict(zip(design.names, point, strict=True)) for point in design.points]
    keys = [_digest(v) for v in values]
    asked = dict(zip(keys, values, strict=True))
    mark = _mark(dae, design, measure)
    title = dae.name if dae is not None else "sweep"
    with opened(None if path is None else path_of(path, "the table of a sweep"), design.names, mark) as store:
        for key in asked.keys() & store.rows.keys():
            store.rows[key] = replace(store.rows[key], values=asked[key])
        points = {key: v for key, v in asked.items() if key not in store.rows}
        rows = _rows(model, Work(measure, dae, Gatherer(len(points))), points, executor, workers)
        return _gathered(design, keys, store, rows, Progress(title, 0, len(points), progress, "points"))


def _gathered(design: Design, keys: list[str], store: Store, rows: Generator[Row], show: Progress) -> Sweep:
    """Keep rows as they come, and return the sweep."""
    resumed = sum(key in store.rows for key in keys)

    def done() -> Sweep:
        there = [n for n, key in enumerate(keys) if key in store.rows]
        table = store.table(keys[n] for n in there).set_axis(there, axis=0).rename_axis("point")
        return Sweep(design, table, resumed, dict(runs.most_common()))

    runs = Counter[str]()
    try:
        with show as bar, closing(rows):
            for count, row in enumerate(rows, start=1):
                store.add(row)
                runs.update(row.runs)
                bar.at(count)
    except KeyboardInterrupt:
        so_far = done()
        kept = f"kept in '{store.path}'" if store.path is not None else "in the error's `sweep`"
        told = f"interrupted: {len(so_far.table)} of {len(design)} points are done, {kept}"
        raise SweepInterruptedError(told, so_far) from None
    finally:
        if len(store.rows) > resumed:
            store.fold()
    found = done()
    if len(found.failed) == len(design):
        first = found.table["error"].iloc[0]
        told = f"'{show.name}': none of the {len(design)} points could be computed; the first: {first}"
        raise SimulationError(told, found)
    return found


def _rows(
    model: Model, here: Work, points: Mapping[str, Values], executor: Any, workers: int | None
) -> Generator[Row]:
    if not points:
        return
    if workers == 0 and executor is None:
        yield from here.rows([*points.items()])
        return
    from .pool import Pool, processes_of

    expected = ceil(len(points) / processes_of(executor, workers))
    blob = packed(model, here.measure, expected)
    if executor is None:
        bequeath(blob, replace(here, gatherer=Gatherer(expected)))
    yield from Pool(executor, workers, blob).rows(points.items())


def _check_names(dae: DAE, design: Design) -> None:
    known = dae.parameter_values
    told = [f"there is no parameter '{n}'{nearest(n, known)}" for n in design.names if n not in known]
    if told:
        raise ModelError(f"'{dae.name}' cannot be swept:", told)


def _digest(content: Any) -> str:
    return sha256(json.dumps(content, default=repr).encode()).hexdigest()[:20]


def _mark(dae: DAE | None, design: Design, measure: Callable[..., Any]) -> str:
    """Return what tells this sweep from one of another model, measure, or other parameters."""
    function = inspect.unwrap(getattr(measure, "func", measure))
    try:
        source = inspect.getsource(function)
    except (OSError, TypeError):
        source = getattr(function, "__qualname__", type(function).__qualname__)
    bound = [getattr(measure, "args", ()), getattr(measure, "keywords", {})]
    about: list[Any] = [design.names, source, bound]
    if dae is not None:
        fixed = {name: v for name, v in dae.parameter_values.items() if name not in design.names}
        about += [dae.name, fixed, dae.state_names, str(dae.ode)]
    return _digest(about)
