"""Whole results of members, made from what their lanes have written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from typing import Any

import numpy as np

from ...base import Array
from ..csource.native import event_of
from ..results.result import Result, Segment
from ..simulation.bound_dae import BoundDAE
from ..simulation.consistent_start import started
from ..simulation.coverage import data_notes
from ..simulation.dense_output import DenseOutput
from ..simulation.energy import energy_book
from ..simulation.events.switcher import Event
from ..simulation.initialization import StartReport, start_values
from ..simulation.legs import Leg
from ..simulation.resolution import resolution_notes
from ..simulation.run import Run, limiting_state
from ..simulation.run_asked import RunAsked
from ..simulation.settings import Tolerance


class MemberResult(Result):
    """What a run computed that went beside others, as if it had gone alone.

    What no one asks for is not made: start values are looked for again when their report, or the events with
    which a run begins, are wanted.

    Args:
        asked: the run.
        closed: its equations.
        legs: the parts of it between which inputs switch.
        rows: an instant a row: (rows, constants) and (rows, states, algebraic unknowns and further signals).
        begins: the rows where a segment begins.
        signals: names of the further signals.
        happened: rows of instant, change, whether it stays, impulse.
        figures: for `stats`.
        tolerance: to which it went.
    """

    def __init__(
        self,
        asked: RunAsked,
        closed: BoundDAE,
        legs: list[Leg],
        rows: tuple[Array, Array, Array],
        begins: Sequence[int],
        signals: Sequence[str],
        happened: Array,
        figures: Mapping[str, Any],
        tolerance: Tolerance,
    ) -> None:
        self.closed, self.dae, self._asked, self._told = closed, closed.dae, asked, figures
        self._legs, self._happened, self._tolerance = legs, happened, tolerance
        self._time, constants, values = rows
        nx, nz = self.dae.x.numel(), self.dae.z.numel()
        ends = [*begins[1:], len(self._time)]
        self.segments = [
            Segment(q, [self._time[a:b]], [values[a:b, :nx]], [values[a:b, nx : nx + nz]])
            for a, b, q in zip(begins, ends, constants, strict=True)
        ]
        self._signals = {name: values[:, nx + nz + k] for k, name in enumerate(signals)}
        self._followed = lambda _: {}
        self._limiting = self._limiting_state
        self._dense_output = partial(DenseOutput, legs, "compiled", tolerance)
        self._bookkeeping = energy_book

    @cached_property
    def _run(self) -> Run:
        """The run where it begins."""
        asked, closed = self._asked, self.closed
        q = closed.blank(self.dae.parameters.values(asked.parameters))
        return started(closed, asked.settings, q, start_values(self.dae, asked.start, asked.guess))

    @cached_property
    def events(self) -> list[Event]:  # type: ignore[override]
        """The changes of mode and the shocks, in order."""
        begins = self._run.events if self.dae.hybrid or self.dae.blocks else []
        later = self._happened.tolist()
        return [*begins, *(event_of(self.dae, t, int(n), bool(s), j) for t, n, s, j in later)]

    @cached_property
    def initial(self) -> StartReport:  # type: ignore[override]
        """How every start value was decided."""
        return self._run.initial

    @cached_property
    def notes(self) -> list[str]:  # type: ignore[override]
        """What the run wants to be known."""
        settings = self._asked.settings
        notes = list(self._run.switcher.notes if self._run.switcher else [])
        notes += data_notes(self.dae.inputs, self.closed.signals, settings.begin, settings.stop)
        if self.dae.states:
            states = np.vstack([block for segment in self.segments for block in segment.states])
            notes += resolution_notes(self.dae, states, settings.tolerance)
        return notes

    @cached_property
    def _figures(self) -> dict[str, Any]:  # type: ignore[override]
        by_component = dict(Counter(event.component for event in self.events))
        return {**self._told, "events": len(self.events), "events by component": by_component}

    def _limiting_state(self) -> str:
        run = self._run
        run.segments = self.segments
        return limiting_state(run)
