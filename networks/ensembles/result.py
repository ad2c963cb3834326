"""`Ensemble`: signals of many runs of one network as one array, and the events of each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...base import Array, Ints, ModelError, UnknownNameError, nearest, number, shown
from ...base.html import page, table_of_texts
from ..csource.members import Status, Told
from ..csource.native import event_of
from ..dae import DAE
from ..lanes.asked import Asked
from ..lanes.table import Columns, spread
from ..results.recorded import Recorded
from ..simulation.blame import with_remedies
from ..simulation.events.switcher import Event
from ..sweeps.design import Design
from ..sweeps.sweep import Sweep
from .measures import swept

UNFINISHED = "not done when the ensemble was interrupted"


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """What came of many runs of one network.

    Attributes:
        dae: the equations.
        time: instants of the outputs [s], the same for all members.
        signals: names of what was computed.
        values: (members, instants, signals), in SI units; at an instant with an event, what is true after it;
            NaN from where a member failed.
        errors: why members failed, by number.
        stats: `members`, `failed`, `lanes` (members side by side), `lane efficiency` (share of the lanes'
            steps that members took), `steps` and `rejected` of all members, `seconds`.
    """

    dae: DAE
    time: Array
    signals: tuple[str, ...]
    values: Array
    errors: Mapping[int, str]
    stats: Mapping[str, Any]
    _happened: Array
    _varied: Design | Columns

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, name: str) -> Array:
        """Return a signal of all members, (members, instants).

        Raises:
            UnknownNameError: for what was not computed, with the nearest name that was.
        """
        if name not in self.signals:
            raise UnknownNameError(
                f"this ensemble has no signal {shown(name)}{nearest(str(name), self.signals)}; "
                "what an ensemble computes is named by signals=[...]"
            )
        found: Array = self.values[:, :, self.signals.index(name)]
        return found

    @property
    def done(self) -> int:
        """How many members came to the end."""
        return len(self) - len(self.errors)

    @property
    def event_counts(self) -> Ints:
        """How many events each member had after its start."""
        return np.diff(self._places)

    @cached_property
    def _places(self) -> Ints:
        """Where the events of each member begin, and where the last ones end."""
        return np.searchsorted(self._happened[:, 0], np.arange(len(self) + 1))

    def _check(self, member: Any) -> None:
        if number(member) or member not in range(len(self)):
            raise ModelError(f"there are members 0 to {len(self) - 1}, and none of number {shown(member)}")

    def events(self, member: int) -> list[Event]:
        """Return the changes of mode and the shocks of a member after its start, in order.

        Raises:
            ModelError: for the number of no member.
        """
        self._check(member)
        rows = self._happened[self._places[member] : self._places[member + 1], 1:]
        return [event_of(self.dae, t, int(n), bool(stays), impulse) for t, n, stays, impulse in rows.tolist()]

    def member(self, number: int) -> Recorded:
        """Return the signals of a member over time, with averages as a run has them.

        Raises:
            ModelError: for the number of no member.
        """
        import pandas as pd

        self._check(number)
        table = pd.DataFrame(self.values[number], index=self.time, columns=list(self.signals))
        table.attrs["units"] = {name: self.dae.unit(name) for name in self.signals}
        return Recorded(table, f"{self.dae.name}, member {number}")

    def sweep(self, measure: Callable[[Recorded], Any]) -> Sweep:
        """Return a measure of each member as a sweep of the parameters would, for Sobol indices and tables.

        Args:
            measure: of a member (see `member`): returns a number, or numbers by name.

        Raises:
            ModelError: for what is no function, and of an ensemble without parameters of its own.
        """
        if not self._varied:
            raise ModelError("a sweep is over parameters, and this ensemble has none: give parameters={...}")
        if not callable(measure):
            raise ModelError(f"a measure is a function of a member, got {shown(measure)}")
        design = self._varied
        if not isinstance(design, Design):
            rows = zip(*(values.tolist() for values in spread(design, len(self)).values()), strict=True)
            design = Design(tuple(design), tuple(rows))
        return swept(design, self.errors, lambda number: measure(self.member(number)))

    def __repr__(self) -> str:
        return f"<Ensemble '{self.dae.name}': {self._told()}>"

    def _told(self) -> str:
        told = f"{len(self.time)} instants of {len(self.signals)} signals"
        return f"{len(self)} members, {len(self.errors)} failed, {told}"

    def _repr_html_(self) -> str:
        rows = [
            (name, f"{value:.4g}" if isinstance(value, float) else str(value))
            for name, value in self.stats.items()
        ]
        return page(self.dae.name, self._told(), table_of_texts(("", ""), rows))


def ensemble_of(asked: Asked, varied: Design | Columns, told: Told, seconds: float) -> Ensemble:
    """Return what came of members so far."""
    dae, open_ = asked.dae, np.flatnonzero(told.status == Status.WAITING).tolist()
    failed = {member: _failure(dae, member, text) for member, text in told.messages.items()}
    errors = dict(sorted({**dict.fromkeys(open_, UNFINISHED), **failed}.items()))
    stats = {
        "members": asked.count,
        "failed": len(errors),
        "lanes": told.lanes,
        "lane efficiency": told.tried / max(1, told.rounds * told.lanes),
        "steps": int(told.steps.sum()),
        "rejected": int(told.rejected.sum()),
        "seconds": seconds,
    }
    events = np.concatenate([np.zeros((0, 5)), *told.events])
    events = events[np.argsort(events[:, 0], kind="stable")]
    return Ensemble(dae, asked.settings.outputs, asked.signals, told.values, errors, stats, events, varied)


def _failure(dae: DAE, member: int, text: str) -> str:
    named = f"'{dae.name}': "
    return f"{named}member {member}: {with_remedies(dae, text.removeprefix(named))}"
