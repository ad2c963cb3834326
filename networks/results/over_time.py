"""`OverTime`: values, averages and peaks over time of whatever has signals over time."""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike

from ...base import (
    Array,
    ModelError,
    UnknownNameError,
    above,
    demand,
    finite,
    instance,
    listed,
    nearest,
    number,
    optional,
    shown,
)
from .pieces import Pieces

if TYPE_CHECKING:
    import pandas as pd

TIME_SLACK, MOST_ROWS = 1e-6, 1e8


class OverTime:
    """What has signals over time: the result of a run, or a table of them.

    Its points stand where an integrator, events or a recorder put them, closer in one place than in
    another, so that an average over points says little. Averages here are over time, mean = 1/T int y dt,
    rms = sqrt(1/T int y^2 dt), std = sqrt(1/T int (y - mean)^2 dt): over all of it, or from `begin` to `end`
    [s]. Jumps take no time. Of what lasts no time they are those of its last point.
    """

    if TYPE_CHECKING:  # what every kind of it brings along

        @property
        def name(self) -> str: ...
        @property
        def time(self) -> Array: ...
        def __getitem__(self, name: str) -> Array: ...
        def unit(self, name: str) -> str: ...
        def names(self) -> list[str]: ...
        def to_dataframe(self) -> pd.DataFrame: ...

    def course(self, name: str, begin: float, end: float) -> Pieces:
        """Return a signal between the points, at least from `begin` to `end` [s].

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
            ModelError: for instants that are no finite numbers.
        """
        demand("course()", begin=(begin, finite("s")), end=(end, finite("s")))
        return self._course(name, begin, end)

    def _course(self, name: str, begin: float, end: float) -> Pieces:
        """Return it: straight lines here."""
        return Pieces.lines(self.time, np.asarray(self[name], dtype=float))

    def values_of(self, name: str) -> tuple[str, ...]:
        """Return what the values 0, 1, ... of a mode are called; nothing for any other signal."""
        return ()

    @overload
    def at(self, name: str, time: float) -> float: ...
    @overload
    def at(self, name: str, time: ArrayLike) -> Any: ...
    def at(self, name: str, time: ArrayLike) -> Any:
        """Return a signal at one instant or at an array of them [s]; after the event if there is one.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
            ModelError: for an instant outside the run.
        """
        points, times = self[name], self._instants(name, time)
        if not times.size:
            return times
        found = np.full(times.shape, float(points[-1]))
        before = times < self.time[-1]
        if before.any():
            course = self._course(name, float(times[before].min()), float(times[before].max()))
            found[before] = course.at(times[before])
        return found if found.ndim else float(found)

    def _matching(self, names: tuple[str, ...]) -> list[str]:
        """Return the names behind names and patterns, each once, in order."""
        chosen: dict[str, None] = {}
        for name in listed("names", names):
            matches = [name]
            if "*" in name:
                matches = [known for known in self.names()[1:] if fnmatchcase(known, name)]
            if not matches:
                raise UnknownNameError(f"'{self.name}' has no variable like '{name}'")
            chosen |= dict.fromkeys(matches)
        return list(chosen)

    def resample(self, step: float, *names: str) -> pd.DataFrame:
        """Return signals at equal steps, as a pandas DataFrame indexed by time, units in `attrs["units"]`.

        The first instant is the first of the run, the last one the last that still falls into it. At an event
        it is the value after it.

        Args:
            step: between two instants [s].
            names: signals or patterns (`mass.*`); those of `to_dataframe()` if none are given.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one, or a pattern that matches none.
            ModelError: for a step that is not above 0 s, or so short that the table has over 1e8 rows.
        """
        import pandas as pd

        times = self._equal_steps(step)
        chosen = self._matching(names) if names else list(self.to_dataframe().columns)
        table = pd.DataFrame({n: self.at(n, times) for n in chosen}, index=pd.Index(times, name="time"))
        table.attrs["units"] = {name: self.unit(name) for name in chosen}
        return table

    def compare(self, other: OverTime, *names: str) -> pd.DataFrame:
        """Return how far signals are from those of the same names of another run, or of what was measured.

        A row for each signal: its unit, its rms over the time that both have, the rms of the difference (the
        other's less this one's), the largest difference and when, at the points of both.

        Args:
            other: a `Result`, a `Recorded` or anything else that is `OverTime`.
            names: signals or patterns (`mass.*`); those of `to_dataframe()` if none are given.

        Raises:
            UnknownNameError: for a name that one of them does not have, or a pattern that matches none.
            ModelError: if they have no time in common, or a signal is in two units.

        Example:
            >>> from inertance import Fixed, Mass, Network, Spring
            >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0, s=0.1))
            >>> net = net.connect(net.wall.flange, net.spring.flange_a)
            >>> net = net.connect(net.spring.flange_b, net.mass.flange)
            >>> softer = net.simulate(1.0, parameters={"spring.k": 99.0})
            >>> table = net.simulate(1.0).compare(softer, "mass.s")
            >>> round(float(table.loc["mass.s", "rms of difference"]), 4)
            0.0019
        """
        from .comparing import compared

        demand("compare()", other=(other, instance(OverTime)))
        chosen = self._matching(names) if names else list(self.to_dataframe().columns)
        return compared(self, other, chosen)

    def mean(self, name: str, *, begin: float | None = None, end: float | None = None) -> float:
        """Return the average of a signal over time.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
            ModelError: for a window outside the run, or a mode, which has no mean.
        """
        return self._moment(name, begin, end, 1, 0.0)

    def rms(self, name: str, *, begin: float | None = None, end: float | None = None) -> float:
        """Return the root of the average over time of a signal's square; errors as for `mean`."""
        return float(np.sqrt(self._moment(name, begin, end, 2, 0.0)))

    def std(self, name: str, *, begin: float | None = None, end: float | None = None) -> float:
        """Return the rms over time of a signal's distance from its mean; errors as for `mean`."""
        mean = self._moment(name, begin, end, 1, 0.0)
        return float(np.sqrt(self._moment(name, begin, end, 2, mean)))

    def peak(self, name: str, *, begin: float | None = None, end: float | None = None) -> float:
        """Return the largest size |y| of a signal, also between points; errors as for `mean`."""
        first, last = self._window(name, begin, end)
        self._refuse_mode(name, "peak")
        points = self[name]
        if first == last:
            return float(abs(points[-1]))
        return float(np.abs(self._course(name, first, last).extremes(first, last)).max())

    def share(
        self,
        name: str,
        value: str | float | None = None,
        *,
        begin: float | None = None,
        end: float | None = None,
    ) -> float:
        """Return the share of time for which a mode has a value, or a signal of zeros and ones is one.

        Args:
            name: of a mode, `brake.mode`, or of a signal of whole numbers.
            value: by name ("stuck") or number; 1 if the signal is 0 or 1 and none is given.
            begin: where the window begins [s].
            end: where it ends [s].

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
            ModelError: for a value that the mode does not have, for any other signal, for a window outside
                the run.
        """
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

    def _equal_steps(self, step: Any) -> Array:
        """Return the instants that are a step apart, from the first on."""
        demand("resample()", step=(step, above(0, "s")))
        first, last = self._ends
        steps = (last - first) / float(step) * (1 + 1e-12) + 1e-9
        if steps > MOST_ROWS:
            raise ModelError(
                f"'{self.name}' lasts {last - first:g} s; at a step of {step:g} s that is {steps:.2g} rows, "
                f"more than {MOST_ROWS:g}; give a longer step"
            )
        return np.asarray(np.minimum(first + float(step) * np.arange(int(steps) + 1), last))

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
