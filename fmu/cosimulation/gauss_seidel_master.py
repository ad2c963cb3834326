"""Gauss-Seidel master: FMUs advance first, and then the network with what they gave, step by step."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ...base import Array
from ...components import ModelError
from ...networks import DAE, Polynomial, Stepwise
from ..errors import FMUError
from ..foreign.instance import Values
from .algebraic_loop import unchanged
from .communication_points import CommunicationPoints
from .components import ForeignComponent
from .coupling import Coupled, CoupledRun
from .impulses import Impulses
from .jacobi_master import advance_together
from .participants import Member, Participant, jumped

NEXT_TO_NOTHING = 1e-9
BEYOND = 1e-6
ROUNDS = 100


class GaussSeidelMaster:
    """Advances the FMUs in a network, and then the network, over the same step; see `cosimulate`.

    Args:
        dae: of the network.
        points: where all exchange.
        inputs: signals of the network's other inputs.
        options: of the network's run.

    Raises:
        ModelError: for a network without FMU.
    """

    def __init__(
        self, dae: DAE, points: CommunicationPoints, inputs: dict[str, Any], options: dict[str, Any]
    ) -> None:
        self.dae, self.points, self.options, self.steps = dae, points, options, 0
        parts = {i.path: i.component for i in dae.flat.instances.values()}
        self.foreign = {p: c for p, c in parts.items() if isinstance(c, ForeignComponent)}
        if not self.foreign:
            raise ModelError(f"'{dae.name}' has no FMU in it; use simulate")
        self.inputs = inputs | {
            f"{path}.{given.name}": Polynomial(1 if given.rate is None else 3)
            for path, component in self.foreign.items()
            for given in component.given
        }
        self._both = f"'{dae.name}': the network and its FMUs"
        self.all: list[Coupled] = []
        self.notes: list[str] = []
        self.network: Stepwise

    @property
    def exchanged(self) -> list[str]:
        """Names of what passes between network and FMUs."""
        return [
            f"{path}.{name}"
            for path, component in self.foreign.items()
            for name in [*(t.name for t in component.taken), *(g.name for g in component.given)]
        ]

    def run(self) -> CoupledRun:
        began = clock.perf_counter()
        try:
            self._instantiate()
            self._agree()
            self._impulses = Impulses(self.network, self.all)
            for one in self.all:
                one.was = one.fmu.begin(self._now(one))
                one.fmu.record()
            for target in self.points.times[1:].tolist():
                while not self._ended() and self._exchange(target) < target:
                    pass
        finally:
            for one in self.all:
                one.fmu.close()
        result = self.network.result()
        stats = {"communication steps": self.steps, "seconds": clock.perf_counter() - began}
        runs = {one.path: one.fmu.run for one in self.all}
        self.notes += [note for one in self.all for note in one.fmu.conclude()]
        return CoupledRun(runs, self.points.step, self.points.order, result, notes=self.notes, stats=stats)

    def _instantiate(self) -> None:
        for path, component in self.foreign.items():
            outputs = [n for g in component.given for n in (g.value, g.rate) if n is not None]
            member = Member(component.fmu, component.kind, component.chosen, component.started)
            taken = [t.input for t in component.taken]
            fmu = Participant(member, taken, outputs, self.points, self.options["rtol"])
            self.all.append(Coupled(path, component, fmu, self.points.order))
        self.all.sort(key=lambda one: not one.fmu.reversible)

    def _agree(self) -> None:
        """Initialise network and FMUs so that they agree on what they exchange."""

        def answer(given: Array) -> Array:
            courses: dict[str, Sequence[float]] = {}
            for one, values in self._shares(given):
                one.was = one.fmu.initial(values)
                courses |= one.courses(one.was)
            begin, stop = self.points.begin, self.points.stop
            self.network = Stepwise(self.dae, begin, stop, self.inputs, courses, **self.options)
            return self._all_now()

        guess = np.array([value for one in self.all for value in one.start_inputs()])
        unchanged(answer, guess, f"{self._both} find no common start")

    def _agree_here(self, guess: Array) -> Array:
        """Let network and FMUs agree on what they exchange where they stand, as events make it jump."""

        def answer(given: Array) -> Array:
            for one, values in self._shares(given):
                one.was = one.fmu.outputs(values)
                self.network.set(one.courses(one.was))
            return self._all_now()

        problem = f"{self._both} find no common values after the event at t = {self.network.time:.9g} s"
        return unchanged(answer, guess, problem)

    def _shares(self, given: Array) -> Iterator[tuple[Coupled, Values]]:
        """Yield each FMU with its share of what all take."""
        ends = np.cumsum([len(one.component.taken) for one in self.all])
        for one, values in zip(self.all, np.split(given, ends[:-1]), strict=True):
            yield one, values.tolist()

    def _all_now(self) -> Array:
        return np.array([value for one in self.all for value in self._now(one)])

    def _observed(self, one: Coupled) -> Array:
        wanted = one.wanted()
        return self.network.observe(wanted) if wanted else np.zeros(0)

    def _now(self, one: Coupled) -> Values:
        return one.course(self._observed(one), 0.0)(0.0)

    def _exchange(self, target: float) -> float:
        """Advance all to `target` or the first event before it; return where."""
        t, jumps, events = self.network.time, self.network.jumps, len(self.network.events)
        courses = [one.course(self._observed(one), t) for one in self.all]
        fmus = {one.path: one.fmu for one in self.all}
        target = self._before_own_event(target)
        reached = advance_together(fmus, target, dict(zip(fmus, courses, strict=True)))
        self.steps += 1
        foreseen = np.array([value for course in courses for value in course(reached)])
        if reached - t > NEXT_TO_NOTHING * self.points.step:
            given: dict[str, Sequence[float]] = {}
            for one, values in self._shares(foreseen):
                given |= one.courses(one.fmu.outputs(values), reached - t)
            self.network.set(given)
            self.network.advance(reached)
        self._settle(foreseen if self.network.jumps > jumps else None)
        self._impulses.check_shocks(self.network.events[events:])
        return reached

    def _before_own_event(self, target: float) -> float:
        """Return `target`, or where the network is foreseen to have an event before, a trifle later."""
        event = self.network.first_event(target)
        if event is None or event > target - 2 * BEYOND * self.points.step:
            return target
        if stiff := [one.fmu.fmu.name for one in self.all if not one.fmu.stepper.flexible]:
            note = (
                f"events of the network, first at t = {event:.9g} s, do not end a communication step, as FMU "
                f"'{stiff[0]}' takes steps of one size only: the error falls with the step, not its square"
            )
            self.notes += [note] if not self.notes else []
            return target
        return event + BEYOND * self.points.step

    def _settle(self, foreseen: Array | None) -> None:
        """Iterate the events that a step ended at until none is left, as each can bring about others.

        Args:
            foreseen: what the FMUs were driven with, if the network had events within the step.
        """
        given = self._all_now()
        for one, values in self._shares(given):
            one.was = one.fmu.outputs(values)
            one.fmu.record()
        gave = [one.was for one in self.all]
        happened = self.network.settle() or foreseen is not None
        happened |= any([one.fmu.settle(values) for one, values in self._shares(given)])
        if not happened or self._ended():
            return
        before = given if foreseen is None else foreseen
        for _ in range(ROUNDS):
            given = self._agree_here(given)
            if not (self.network.settle() | self._jump(before, given)) or self._ended():
                break
            before = given
        else:
            raise FMUError(
                f"'{self.dae.name}': events at t = {self.network.time:.9g} s bring about each other"
            )
        self._impulses.check_jumps(gave)
        self.network.settle(jumped=True)
        for one in self.all:
            one.fmu.record()

    def _jump(self, before: Array, now: Array) -> bool:
        """Iterate the events that jumps of what FMUs take bring about; tell whether there were any."""
        pairs = zip(self._shares(before), self._shares(now), strict=True)
        return any([one.fmu.settle(new, jumped(old, new)) for (_, old), (one, new) in pairs])

    def _ended(self) -> bool:
        return any(one.fmu.ended for one in self.all)
