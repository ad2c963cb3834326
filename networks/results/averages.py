"""Averages and peaks over time, of one signal, or of all that a pattern means."""

from __future__ import annotations

from collections.abc import Callable
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError, UnknownNameError, demand, listed, nearest, number, optional, shown
from .pieces import Pieces

if TYPE_CHECKING:
    import pandas as pd

TIME_SLACK = 1e-6
Names = list[str] | tuple[str, ...] | set[str]


def is_pattern(name: Any) -> bool:
    """Return whether a name stands for all in which something stands for its `*`."""
    return isinstance(name, str) and "*" in name


def several(name: Any) -> tuple[Any, ...] | None:
    """Return the names that are meant if these may be several, None of one."""
    if is_pattern(name):
        return (name,)
    return tuple(name) if isinstance(name, list | tuple | set) else None


class Averages:
    """Averages over time of whatever has signals over time; see `OverTime`."""

    if TYPE_CHECKING:  # what every kind of it brings along

        @property
        def name(self) -> str: ...
        @property
        def time(self) -> Array: ...
        def __getitem__(self, name: str) -> Array: ...
        def unit(self, name: str) -> str: ...
        def names(self) -> list[str]: ...
        def _course(self, name: str, begin: float, end: float) -> Pieces: ...

    def values_of(self, name: str) -> tuple[str, ...]:
        """Return what the values 0, 1, ... of a mode are called; nothing for any other signal."""
        return ()

    @overload
    def mean(self, name: str, *, begin: float | None = None, end: float | None = None) -> float: ...
    @overload
    def mean(self, name: Names, *, begin: float | None = None, end: float | None = None) -> pd.Series: ...
    def mean(self, name: Any, *, begin: float | None = None, end: float | None = None) -> Any:
        """Return the average of a signal over time; of several, or of a pattern (`mass.*`), a Series by name.

        Type checkers take what a pattern returns for one number; in a list, `mean(["mass.*"])`, they know it.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one, or a pattern that matches none.
            ModelError: for a window outside the run, or a mode, which has no mean (patterns leave it out).
        """
        return self._each(name, lambda one: self._moment(one, begin, end, 1, 0.0))

    @overload
    def rms(self, name: str, *, begin: float | None = None, end: float | None = None) -> float: ...
    @overload
    def rms(self, name: Names, *, begin: float | None = None, end: float | None = None) -> pd.Series: ...
    def rms(self, name: Any, *, begin: float | None = None, end: float | None = None) -> Any:
        """Return the root of the average over time of a signal's square; names and errors as for `mean`."""
        return self._each(name, lambda one: float(np.sqrt(self._moment(one, begin, end, 2, 0.0))))

    @overload
    def std(self, name: str, *, begin: float | None = None, end: float | None = None) -> float: ...
    @overload
    def std(self, name: Names, *, begin: float | None = None, end: float | None = None) -> pd.Series: ...
    def std(self, name: Any, *, begin: float | None = None, end: float | None = None) -> Any:
        """Return the rms over time of a signal's distance from its mean; names and errors as for `mean`."""

        def deviation(one: str) -> float:
            mean = self._moment(one, begin, end, 1, 0.0)
            return float(np.sqrt(self._moment(one, begin, end, 2, mean)))

        return self._each(name, deviation)

    @overload
    def peak(self, name: str, *, begin: float | None = None, end: float | None = None) -> float: ...
    @overload
    def peak(self, name: Names, *, begin: float | None = None, end: float | None = None) -> pd.Series: ...
    def peak(self, name: Any, *, begin: float | None = None, end: float | None = None) -> Any:
        """Return the largest size |y| of a signal, also between points; names and errors as for `mean`."""
        return self._each(name, lambda one: self._peak(one, begin, end))

    def _peak(self, name: str, begin: float | None, end: float | None) -> float:
        first, last = self._window(name, begin, end)
        self._refuse_mode(name, "peak")
        points = self[name]
        if first == last:
            return float(abs(points[-1]))
        return float(np.abs(self._course(name, first, last).extremes(first, last)).max())

    @overload
    def share(
        self, name: str, value: str | float | None = None,
        *, begin: float | None = None, end: float | None = None,
    ) -> float: ...  # fmt: skip
    @overload
    def share(
        self, name: Names, value: str | float | None = None,
        *, begin: float | None = None, end: float | None = None,
    ) -> pd.Series: ...  # fmt: skip
    def share(
        self, name: Any, value: str | float | None = None,
        *, begin: float | None = None, end: float | None = None,
    ) -> Any:  # fmt: skip
        """Return the share of time for which a mode has a value, or a signal of zeros and ones is one.

        Args:
            name: of a mode, `brake.mode`, or of a signal of whole numbers. Several names, or a pattern
                (`*.mode`, without the modes that cannot have the value), give a Series by name.
            value: by name ("stuck") or number; 1 if the signal is 0 or 1 and none is given.
            begin: where the window begins [s].
            end: where it ends [s].

        Raises:
            UnknownNameError: for an unknown name, with the nearest one, or a pattern that matches none.
            ModelError: for a value that the mode does not have, for any other signal, for a window outside
                the run.
        """

        def has_it(one: str) -> bool:
            called = self.values_of(one)
            return value in (called if isinstance(value, str) else range(len(called)))

        return self._each(name, lambda one: self._share(one, value, begin, end), has_it)

    def _share(self, name: str, value: str | float | None, begin: float | None, end: float | None) -> float:
        wanted = self._wanted(name, value)
        first, last = self._window(name, begin, end)
        if first == last:
            return float(self[name][-1] == wanted)
        return self._course(name, first, last).lasting(lambda y: y == wanted, first, last) / (last - first)

    def _moment(self, name: str, begin: float | None, end: float | None, power: int, about: float) -> float:
        first, last = self._window(name, begin, end)
        self._refuse_mode(name, "mean")
        if first == last:
            return float((self[name][-1] - about) ** power)
        course = self._course(name, first, last)
        return course.integral(lambda y: (y - about) ** power, first, last) / (last - first)

    def _wanted(self, name: str, value: str | float | None) -> float:
        """Return a value as a number, if the signal can have it."""
        points, called = self[name], self.values_of(name)
        told = f"'{name}' of '{self.name}'"
        if called and value is None:
            raise ModelError(f"{told} is {', '.join(called)}; say which: share('{name}', '{called[0]}')")
        if isinstance(value, str) and value in called:
            return float(called.index(value))
        if isinstance(value, str) or (called and value not in range(len(called))):
            is_one = f"only {', '.join(called)}" if called else "but a number"
            raise ModelError(f"{told} is never {value!r}, {is_one}{nearest(str(value), called)}")
        whole = np.isin(points, (0.0, 1.0)) if value is None else points == np.round(points)
        if not whole.all():
            raise ModelError(
                f"{told} goes from {points.min():g} to {points.max():g} {self.unit(name)}; share() is of "
                "modes and of signals that are 0 or 1"
            )
        return 1.0 if value is None else float(value)

    def _refuse_mode(self, name: str, what: str) -> None:
        if called := self.values_of(name):
            raise ModelError(
                f"'{name}' of '{self.name}' is a mode ({', '.join(called)}), which has no {what}; ask "
                f"share('{name}', '{called[0]}')"
            )

    def _each(
        self, name: Any, measure: Callable[[str], Any], suits: Callable[[str], bool] | None = None
    ) -> Any:
        """Return a measure of a signal; of several, or of what suits it of a pattern, a Series by name."""
        given = several(name)
        if given is None:
            return measure(name)
        import pandas as pd

        return pd.Series(
            {one: measure(one) for one in self._matching(given, suits or self._is_no_mode)}, dtype=float
        )

    def _is_no_mode(self, name: str) -> bool:
        return not self.values_of(name)

    def _matching(self, names: tuple[str, ...], suits: Callable[[str], bool] = bool) -> list[str]:
        """Return the names behind names and patterns, of these what suits, each once, in order."""
        chosen: dict[str, None] = {}
        for name in listed("names", names):
            matches = [name]
            if is_pattern(name):
                matches = [known for known in self.names()[1:] if fnmatchcase(known, name) and suits(known)]
            if not matches:
                raise UnknownNameError(f"'{self.name}' has no variable like '{name}'")
            chosen |= dict.fromkeys(matches)
        return list(chosen)

    def _instants(self, name: str, time: ArrayLike) -> Array:
        try:
            times = np.asarray(time, dtype=float)
        except (TypeError, ValueError, OverflowError):
            raise ModelError(f"'{name}' is asked for at instants [s], got {shown(time)}") from None
        first, last = self._ends
        outside = ~(np.abs(times - (first + last) / 2) <= (last - first) * (0.5 + TIME_SLACK))
        if outside.any():
            raise ModelError(
                f"'{name}' of '{self.name}': t = {times[outside].flat[0]:g} s is outside the run, {first:g} "
                f"to {last:g} s; run longer"
            )
        return np.asarray(np.clip(times, first, last))

    def _window(self, name: str, begin: float | None, end: float | None) -> tuple[float, float]:
        """Return begin and end of a window of the run, checked."""
        demand(f"a window of '{name}'", begin=(begin, optional(number)), end=(end, optional(number)))
        first, last = self._ends
        window = [edge if given is None else given for given, edge in ((begin, first), (end, last))]
        low, high = (float(t) for t in self._instants(name, window))
        if not (low < high or first == last):
            told = "got begin = {:g} s, end = {:g} s".format(*window)
            raise ModelError(f"a window of '{name}' ends after it begins; {told}")
        return low, high

    @property
    def _ends(self) -> tuple[float, float]:
        """First and last instant [s]."""
        return float(self.time[0]), float(self.time[-1])
