"""Gauss-Seidel master: FMUs advance first, and then the network with what they gave, step by step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ...base import Array
from ...components import ModelError
from ...networks import DAE, Polynomial, Stepwise
from ..foreign.instance import Values
from .components import ForeignComponent
from .coupling import CoupledRun, Coupling, Impulses
from .master import Master
from .participants import CommunicationPoints, Member, Participant

LEAST_STEP_SHARE = 1e-9
BEYOND_EVENT_SHARE = 1e-6


class GaussSeidelMaster(Master):
    """Advances the FMUs in a network, and then the network, over the same step; see `cosimulate`.

    Of the network are its `dae`, the signals of its other `inputs` and the `options` of its run.
    """

    network: Stepwise

    def __init__(
        self, dae: DAE, points: CommunicationPoints, inputs: dict[str, Any], options: dict[str, Any]
    ) -> None:
        super().__init__(f"'{dae.name}': the network and its FMUs", points)
        self.dae, self.options = dae, options
        parts = {i.path: i.component for i in dae.flat.instances.values()}
        self._couplings = {
            path: Coupling(path, part, points.order)
            for path, part in parts.items()
            if isinstance(part, ForeignComponent)
        }
        if not self._couplings:
            raise ModelError(f"'{dae.name}' has no FMU in it; use simulate")
        self.inputs = inputs | {
            f"{path}.{given.name}": Polynomial(2 * len(given.variables) - 1)
            for path, coupling in self._couplings.items()
            for given in coupling.component.given
        }

    @property
    def exchanged(self) -> list[str]:
        """Names of what passes between network and FMUs."""
        return [name for coupling in self._couplings.values() for name in coupling.exchanged]

    def run(self) -> CoupledRun:
        """Run from the first point to the last."""
        runs, points = self.march(), self.points
        return CoupledRun(
            runs, points.step, points.order, self.network.result(), notes=self.notes, stats=self.stats
        )

    def _begin(self) -> None:
        for path, coupling in self._couplings.items():
            part = coupling.component
            member = Member(part.fmu, part.kind, part.chosen, part.started)
            outputs = [name for given in part.given for name in given.variables]
            taken = [taken.input for taken in part.taken]
            self.everyone[path] = Participant(member, taken, outputs, self.points, self.options["rtol"])
        self._leave_initialization(
            (path, taken.input) for path, one in self._couplings.items() for taken in one.component.taken
        )
        self._impulses = Impulses(self.network, self._couplings)
        self._record()

    def _answered(self) -> Array:
        courses: dict[str, Sequence[float]] = {}
        for path, coupling in self._couplings.items():
            courses |= coupling.courses(self.given[path])
        if self._initializing:
            begin, stop = self.points.begin, self.points.stop
            self.network = Stepwise(self.dae, begin, stop, self.inputs, courses, **self.options)
        else:
            self.network.set(courses)
        return self._all_now()

    def _shares(self, exchanged: Array) -> Iterator[tuple[str, Values]]:
        ends = np.cumsum([len(coupling.component.taken) for coupling in self._couplings.values()])
        for path, values in zip(self._couplings, np.split(exchanged, ends[:-1]), strict=True):
            yield path, values.tolist()

    def _all_now(self) -> Array:
        """Return what all FMUs take from the network where it stands."""
        courses = [one.course(self.network, 0.0) for one in self._couplings.values()]
        return np.array([value for course in courses for value in course(0.0)])

    def _step(self, target: float) -> None:
        t, jumps, events = self.network.time, self.network.jumps, len(self.network.events)
        courses = {path: coupling.course(self.network, t) for path, coupling in self._couplings.items()}
        self._advance(self._before_own_event(target), courses)
        foreseen = np.array([value for course in courses.values() for value in course(self.time)])
        if self.time - t > LEAST_STEP_SHARE * self.points.step:
            given: dict[str, Sequence[float]] = {}
            for path, values in self._shares(foreseen):
                now = self.everyone[path].outputs(values)
                given |= self._couplings[path].courses_between(self.given[path], now, self.time - t)
            self.network.set(given)
            self.network.advance(self.time)
        self._exchange(foreseen if self.network.jumps > jumps else None)
        self._impulses.check_shocks(self.network.events[events:])

    def _before_own_event(self, target: float) -> float:
        """Return `target`, or where the network is foreseen to have an event before, a trifle later."""
        event, beyond = self.network.first_event(target), BEYOND_EVENT_SHARE * self.points.step
        if event is None or event > target - 2 * beyond:
            return target
        if stiff := [one.fmu.name for one in self.everyone.values() if not one.stepper.flexible]:
            note = (
                f"events of the network, first at t = {event:.9g} s, do not end a communication step, as FMU "
                f"'{stiff[0]}' takes steps of one size only: the error falls with the step, not its square"
            )
            self.notes += [note] if not self.notes else []
            return target
        return event + beyond

    def _exchange(self, foreseen: Array | None) -> None:
        """Exchange what there is now, and iterate the events that the step ended at.

        If the network had events within the step, the FMUs were driven with what had been `foreseen`.
        """
        taken = self._all_now()
        for path, values in self._shares(taken):
            self.given[path] = self.everyone[path].outputs(values)
        self._record()
        gave = dict(self.given)
        happened = self._settled(taken, taken) or foreseen is not None
        if not happened or self._ended():
            return
        self._settled_jumps(taken if foreseen is None else foreseen, taken)
        self._impulses.check_jumps(gave, self.given)
        self.network.settle(jumped=True)
        self._record()

    def _settled(self, before: Array, now: Array) -> bool:
        return self.network.settle() | super()._settled(before, now)
