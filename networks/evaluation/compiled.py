"""Compiled functions called on NumPy arrays without conversions: at one point, or at many at once."""

from __future__ import annotations

from collections.abc import Sequence
from threading import Lock
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from ...base import Array

MOST_POINTS, BATCH_ENTRIES = 512, 65536  # points of a batch; entries of the arguments at all of its points
FEWEST = 2  # points of a batch: of one alone, arguments would be vectors
FEW, MOST_FEWS = 16, 8  # share of them that a small batch takes, and of which at most so many are taken


class Compiled:
    """A CasADi function on preallocated buffers; a call costs microseconds. Not for several threads.

    A column is passed and returned as a vector, a matrix transposed: one row an instant, so that a
    run's states, (instants, states), stay as they are.
    """

    def __init__(self, function: Any) -> None:
        self.function = function
        self._arguments = [_buffer(function.size_in(i)) for i in range(function.n_in())]
        self._results = [_buffer(function.size_out(i)) for i in range(function.n_out())]
        self._buffer, self._evaluate = function.buffer()
        for i, argument in enumerate(self._arguments):
            self._buffer.set_arg(i, memoryview(argument.ravel()))  # type: ignore[arg-type]
        for i, result in enumerate(self._results):
            self._buffer.set_res(i, memoryview(result.ravel()))  # type: ignore[arg-type]

    def __call__(self, *values: ArrayLike) -> list[Array]:
        """Evaluate and return copies of the results.

        Raises:
            RuntimeError: if the function reports a failure, as an integrator may.
        """
        for argument, value in zip(self._arguments, values, strict=True):
            argument[...] = value
        self._evaluated()
        return self.results()

    def at_some(self, columns: Sequence[Array]) -> list[Array]:
        """Evaluate at some points, at most as many as a mapped function takes; the others are of before.

        What is returned is overwritten by the next call.
        """
        for argument, values in zip(self._arguments, columns, strict=True):
            argument[: len(values)] = values
        self._evaluated()
        return self._results

    def _evaluated(self) -> None:
        self._evaluate()
        if self._buffer.ret():
            raise RuntimeError(f"'{self.function.name()}' could not be evaluated")

    def results(self) -> list[Array]:
        """Return copies of what the results hold."""
        return [result.copy() for result in self._results]

    def empty(self) -> None:
        """Let `filled` tell how far the next call has come."""
        self._first_column()[:] = np.nan

    def filled(self) -> float:
        """Return the share of the first result's rows that a call under way in another thread has written."""
        return 1.0 - float(np.isnan(self._first_column()).mean())

    def _first_column(self) -> Array:
        return self._results[0].reshape(self.function.size2_out(0), -1)[:, 0]

    def stats(self) -> dict[str, Any]:
        """Return the statistics of the last call."""
        return dict(self._buffer.stats())


class Batch:
    """A CasADi function of columns, evaluated at many points, up to some hundred at once."""

    def __init__(self, function: Any) -> None:
        self._shapes = [function.size_out(i) for i in range(function.n_out())]
        most = max(FEWEST, min(MOST_POINTS, BATCH_ENTRIES // max(1, function.nnz_in())))
        self._many = most, Compiled(function.map(most))
        few = max(FEWEST, most // FEW)
        self._few = few, Compiled(function.map(few))
        self._free = Lock()

    def __call__(self, *columns: Array) -> list[Array]:
        """Return one array a result, (points, rows, columns), of arguments (points, entries)."""
        points = len(columns[-1])
        found = [np.empty((points, *shape)) for shape in self._shapes]
        begin = 0
        while begin < points:
            left = points - begin
            size, mapped = self._many if left > MOST_FEWS * self._few[0] else self._few
            end = min(begin + size, points)
            with self._free:
                parts = mapped.at_some([values[begin:end] for values in columns])
                for whole, part, (rows, wide) in zip(found, parts, self._shapes, strict=True):
                    by_point = part.reshape(size, wide, rows)[: end - begin]
                    whole[begin:end] = by_point.transpose(0, 2, 1)
            begin = end
        return found


def _buffer(size: tuple[int, int]) -> Array:
    rows, columns = size
    return np.zeros(rows) if columns == 1 else np.zeros((columns, rows))


def dense(*expressions: Any) -> list[Any]:
    """Return expressions as full matrices, so that results fill their buffers."""
    return [ca.densify(expression) for expression in expressions]
