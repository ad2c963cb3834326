"""`Result`: named signals of a run, its events and its statistics."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, UnknownNameError, path_of
from ..evaluation.jacobians import Points, Slopes
from ..flattening.vectors import pick
from .averages import is_pattern
from .over_time import OverTime
from .pieces import Pieces

if TYPE_CHECKING:
    import pandas as pd

    from ..dae import DAE
    from ..simulation.bound_dae import BoundDAE
    from ..simulation.dense_output import DenseOutput
    from ..simulation.events.switcher import Event
    from ..simulation.initialization import StartReport
    from .animation import Motion
    from .energy import EnergyBook


@dataclass(eq=False)
class Segment:
    """The points between two events; what is constant among them."""

    q: Array
    times: list[Array] = field(default_factory=list)
    states: list[Array] = field(default_factory=list)
    algebraic: list[Array] = field(default_factory=list)

    def extend(self, times: Array, states: Array, algebraic: Array) -> None:
        """Append points."""
        self.times.append(times)
        self.states.append(states)
        self.algebraic.append(algebraic)

    def __len__(self) -> int:
        return sum(map(len, self.times))

    @property
    def begin(self) -> float:
        """Its first instant [s]."""
        return float(self.times[0][0])

    def point(self, number: int) -> tuple[float, Array, Array, Array]:
        """Return instant, states, algebraic unknowns and what is constant of a point; the last for -1."""
        k = number if number >= 0 else len(self) + number
        for times, states, algebraic in zip(self.times, self.states, self.algebraic, strict=True):
            if k < len(times):
                return float(times[k]), states[k], algebraic[k], self.q
            k -= len(times)
        raise IndexError(number)


@dataclass(eq=False, repr=False)
class Result(OverTime):
    """What a run computed; signals are evaluated by name when they are asked for.

    Attributes:
        closed: the equations, with the inputs of the run put in.
        segments: the points between events.
        events: the changes of mode and the shocks, in order.
        initial: how every start value was decided.
        notes: what the run wants to be known (forces that are not unique).

    At an event two points share one time: before and after.

    Example:
        >>> from inertance import Fixed, Inerter, Mass, Network, Spring
        >>> net = Network("example", wall=Fixed(), spring=Spring(k=1.0), mass=Mass(m=1.0, s=1.0))
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange)
        >>> run = net.simulate(1.0)
        >>> run["mass.s"].shape
        (501,)
    """

    closed: BoundDAE
    segments: list[Segment]
    events: list[Event]
    _figures: dict[str, Any]
    initial: StartReport
    notes: list[str]
    _followed: Callable[[Result], dict[str, Array]]
    _limiting: Callable[[], str]
    _dense_output: Callable[[Points], DenseOutput]
    _bookkeeping: Callable[[Result, DenseOutput], EnergyBook]

    def __post_init__(self) -> None:
        self.dae = self.closed.dae
        self._signals: dict[str, Array] = {}
        self._time: Array = np.concatenate([t for s in self.segments for t in s.times])

    @property
    def name(self) -> str:
        """Name of the network."""
        return self.dae.name

    @property
    def time(self) -> Array:
        """Instants of the points [s]."""
        return self._time

    @cached_property
    def stats(self) -> dict[str, Any]:
        """Steps, events by component, the state that limited the steps, seconds."""
        return {**self._figures, "limiting state": self._limiting()}

    def __getitem__(self, name: str) -> Array:
        """Return a signal by its full name, in SI units.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        self.dae.flat.check_name(name)
        if name == "time":
            return self.time
        if name not in self._signals:
            found = self._state(name)
            if found is None:
                found = self.closed.signal(name)(*self.points.arguments)[0].ravel()
            self._signals[name] = found
        return self._signals[name]

    @property
    def asked_for(self) -> frozenset[str]:
        """Names of the signals that were computed so far."""
        return frozenset(self._signals)

    def _state(self, name: str) -> Array | None:
        """Return what was recorded, if a name stands for a state."""
        dae = self.dae
        if name in dae.switching.mode_names or dae.parameters.field(name) is not None:
            return None
        if dae.derived.unit(name) is not None:
            return None
        root, sign = self.dae.root(name)
        if root not in self.dae.states:
            return None
        place = self.dae.states.index(root)
        return sign * np.concatenate([states[:, place] for s in self.segments for states in s.states])

    @cached_property
    def points(self) -> Points:
        """All points of the run, events included."""
        return Points.of(self.closed, self.segments)

    def __contains__(self, name: str) -> bool:
        try:
            self.dae.expression(name)
        except KeyError:
            return False
        return True

    def names(self) -> list[str]:
        """Return the names of all signals."""
        return ["time", *self.dae.names(), *self.dae.switching.mode_names, *self.dae.derived.names()]

    def unit(self, name: str) -> str:
        """Return the unit of a signal."""
        return self.dae.unit(name)

    def _course(self, name: str, begin: float, end: float) -> Pieces:
        """Return cubics through values and rates; where points are too far apart, follow the run again."""
        return self._follow_again.course(name, self[name], begin, end)

    def values_of(self, name: str) -> tuple[str, ...]:
        """Return what the values 0, 1, ... of a mode are called; nothing for any other signal.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        modes = self.dae.switching
        if name in modes.mode_names:
            return modes.mode_values[modes.mode_names.index(name)]
        self.dae.expression(name)
        return ()

    @cached_property
    def _follow_again(self) -> DenseOutput:
        return self._dense_output(self.points)

    @cached_property
    def _sensitivities(self) -> dict[str, Array]:
        return self._followed(self)

    def sensitivity(self, name: str, parameter: str) -> Array:
        """Return d(signal)/d(parameter) along a run asked for with `sensitivities=`.

        Raises:
            UnknownNameError: if the parameter's sensitivities were not asked for.
        """
        self.dae.field(parameter)
        if parameter not in self._sensitivities:
            raise UnknownNameError(f"run again with sensitivities=['{parameter}']")
        column = pick(self.dae.p, [self.dae.parameters.index[parameter]])
        of_x, of_p, _ = Slopes(self.dae, self.dae.expression(name), column)(self.points)
        return np.ravel(of_x @ self._sensitivities[parameter][:, :, None] + of_p)

    @cached_property
    def _energy(self) -> EnergyBook:
        return self._bookkeeping(self, self._follow_again)

    def energy(self) -> EnergyBook:
        """Return what was stored, dissipated and supplied, element by element, and how far that closes.

        Raises:
            ModelError: where a prescribed position jumps against a force that grows with speed.
        """
        return self._energy

    def to_dataframe(self, *names: str) -> pd.DataFrame:
        """Return signals as a pandas DataFrame indexed by time; the states if no names are given.

        Args:
            names: signals or patterns (`mass.*`).

        Raises:
            UnknownNameError: for an unknown signal, with the nearest one, or a pattern that matches none.
        """
        import pandas as pd

        chosen = matching_signals(self.dae, names or self.dae.state_names)
        table = pd.DataFrame({name: self[name] for name in chosen}, index=pd.Index(self.time, name="time"))
        table.attrs["units"] = {name: self.unit(name) for name in chosen}
        return table

    def summary(self) -> str:
        """Return states with their start values, events, statistics and notes as text."""
        from .summary import summary

        return summary(self)

    def to_dict(self, *names: str) -> dict[str, Any]:
        """Return span, events, statistics and notes as plain values, such as JSON holds.

        Of states and of what is named (`mass.*` for several) first, least, largest and last value, and unit.
        """
        from .summary import figures

        return figures(self, matching_signals(self.dae, names))

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Plot signals over time, one panel a unit and one a mode, and return the matplotlib figure.

        Args:
            names: signals or patterns (`mass.*`); the first four states if none are given.
            axes: matplotlib axes to draw on, as many as there are panels; a new figure if None.

        Raises:
            UnknownNameError: for an unknown signal, with the nearest one.
            ModelError: if there is nothing to draw, or not as many axes as panels.
        """
        from .plotting import plot_result

        return plot_result(self, names or tuple(self.dae.state_names[:4]), axes)

    def plot_phase(self, x: str, y: str, axes: Any = None) -> Any:
        """Plot one signal over another, such as velocity over position; return the matplotlib figure.

        Args:
            x: the signal across.
            y: the signal up; a ring marks the start.
            axes: matplotlib axes to draw on; a new figure if None.

        Raises:
            UnknownNameError: for an unknown signal, with the nearest one.
        """
        from .plotting import plot_phase

        return plot_phase(self, x, y, axes)

    def animate(self, frames: int = 100, *, slower: float = 1.0) -> Motion:
        """Return the machine in motion: its sketch, in which bodies slide and discs turn as they did.

        What slides moves about the middle of its range, all at one scale. A notebook plays it;
        `.save("run.gif")` keeps it as a picture, `.save("run.html")` as a page that needs nothing else.

        Args:
            frames: number of pictures, evenly over the run.
            slower: how many times slower than in reality it is shown.

        Raises:
            ModelError: if nothing slides or turns, or more than 60 components would have to be drawn.
        """
        from .animation import animated

        return animated(self, frames, slower)

    def save(self, path: str | Path, *names: str) -> Path:
        """Write signals (`mass.*` for several) to .csv, .parquet or .npz, which `load_table` reads back.

        Raises:
            UnknownNameError: for an unknown signal, with the nearest one.
            ModelError: for another ending.
            OutputError: for a file that cannot be written; a `FileNotFoundError`, too, without its folder.
            MissingPackageError: for .parquet without pyarrow.
        """
        from .storage import save_result

        return save_result(self, path_of(path, "a table"), names)

    def __repr__(self) -> str:
        stats = self.stats
        return (
            f"<Result of '{self.name}': {self.time[0]:g} to {self.time[-1]:g} s, {len(self.time)} points, "
            f"{len(self.dae.states)} states, {stats['steps']} steps, {stats['events']} events>"
        )

    def _repr_html_(self) -> str:
        from .notebook import result_html

        return result_html(self)


def matching_signals(dae: DAE, names: Iterable[str]) -> list[str]:
    """Return the full names behind names and patterns, in which `*` stands for anything, each once, in order.

    Raises:
        UnknownNameError: for an unknown signal, with the nearest one, or a pattern that matches none.
    """
    chosen: dict[str, None] = {}
    for name in names:
        matches = [name]
        if is_pattern(name):
            known = (*dae.names(), *dae.switching.mode_names, *dae.derived.names())
            matches = [other for other in known if fnmatchcase(other, name)]
            if not matches:
                raise UnknownNameError(f"'{dae.name}' has no variable like '{name}'")
        else:
            dae.expression(name)
        chosen |= dict.fromkeys(matches)
    return list(chosen)
