"""A measure of each member, as the table of a sweep."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from ..sweeps.design import Design
from ..sweeps.store import Store
from ..sweeps.sweep import Sweep
from ..sweeps.work import Row, named


def swept(design: Design, errors: Mapping[int, str], measure: Callable[[int], Any]) -> Sweep:
    """Return a sweep: for each member its parameters, and its measure or its error."""
    store = Store(None, design.names, "")
    for member, point in enumerate(design.points):
        store.add(_row(member, dict(zip(design.names, point, strict=True)), errors, measure))
    table = store.table(str(member) for member in range(len(design)))
    return Sweep(design, table.set_axis(range(len(design)), axis=0).rename_axis("point"), 0)


def _row(
    member: int, values: dict[str, Any], errors: Mapping[int, str], measure: Callable[[int], Any]
) -> Row:
    began, results, error = time.perf_counter(), dict[str, Any](), errors.get(member, "")
    if not error:
        try:
            results = named(measure(member))
        except Exception as problem:
            error = f"{type(problem).__name__}: {problem}"
    return Row(str(member), values, results, error, time.perf_counter() - began)
