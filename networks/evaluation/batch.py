"""`Batch`: a compiled function at many points at once."""

from __future__ import annotations

from collections.abc import Sequence
from threading import Lock
from typing import Any

import numpy as np

from ...base import Array
from .compiled import Compiled

CHUNK = 512


class Batch:
    """A CasADi function of columns, evaluated at many points, some hundred by some hundred."""

    def __init__(self, function: Any) -> None:
        self._shapes = [function.size_out(i) for i in range(function.n_out())]
        self._mapped = Compiled(function.map(CHUNK))
        self._free = Lock()

    def __call__(self, *columns: Array) -> list[Array]:
        """Return one array a result, (points, rows, columns).

        Args:
            columns: what the function takes, (points, entries) each.
        """
        pieces = [
            self._chunk([values[begin : begin + CHUNK] for values in columns])
            for begin in range(0, len(columns[-1]), CHUNK)
        ]
        if not pieces:
            return [np.zeros((0, *shape)) for shape in self._shapes]
        return [np.concatenate(parts) for parts in zip(*pieces, strict=True)]

    def _chunk(self, given: Sequence[Array]) -> list[Array]:
        count = len(given[-1])
        if count < CHUNK:
            given = [np.resize(values, (CHUNK, values.shape[1])) for values in given]
        with self._free:
            found = self._mapped(*given)
        return [
            m.reshape(CHUNK, columns, rows)[:count].transpose(0, 2, 1)
            for m, (rows, columns) in zip(found, self._shapes, strict=True)
        ]
