"""`OverTime`: values, averages and peaks over time of whatever has signals over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError, above, demand, finite, instance
from .averages import Averages, Names, several
from .pieces import Pieces

if TYPE_CHECKING:
    import pandas as pd

MOST_ROWS = 1e8


class OverTime(Averages):
    """What has signals over time: the result of a run, or a table of them.

    Its points stand where an integrator, events or a recorder put them, closer in one place than in
    another, so that an average over points says little. Averages here are over time, mean = 1/T int y dt,
    rms = sqrt(1/T int y^2 dt), std = sqrt(1/T int (y - mean)^2 dt): over all of it, or from `begin` to `end`
    [s]. Jumps take no time. Of what lasts no time they are those of its last point.
    """

    if TYPE_CHECKING:  # what every kind of it brings along

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

    @overload
    def at(self, name: str, time: float) -> float: ...
    @overload
    def at(self, name: Names, time: float) -> pd.Series: ...
    @overload
    def at(self, name: str | Names, time: ArrayLike) -> Any: ...
    def at(self, name: Any, time: ArrayLike) -> Any:
        """Return a signal at one instant or at an array of them [s]; after the event if there is one.

        Of several signals, or of a pattern (`mass.*`), it is a pandas Series by name, of an array of instants
        a DataFrame. Type checkers take what a pattern returns for one signal; in a list they know it.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one, or a pattern that matches none.
            ModelError: for an instant outside the run.
        """
        given = several(name)
        if given is None:
            return self._at(name, time)
        import pandas as pd

        found = {one: self._at(one, time) for one in self._matching(given)}
        return pd.DataFrame(found, index=pd.Index(time, name="time")) if np.ndim(time) else pd.Series(found)

    def _at(self, name: str, time: ArrayLike) -> Any:
        points, times = self[name], self._instants(name, time)
        if not times.size:
            return times
        found = np.full(times.shape, float(points[-1]))
        before = times < self.time[-1]
        if before.any():
            course = self._course(name, float(times[before].min()), float(times[before].max()))
            found[before] = course.at(times[before])
        return found if found.ndim else float(found)

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
