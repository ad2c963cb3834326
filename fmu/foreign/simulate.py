"""Running an FMU alone."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import FMUError
from .description import FMUDescription
from .initialization import STEPPERS, enter_initialization
from .inputs import Inputs, chosen_inputs
from .instance import Group, Instance, finite
from .run import ForeignEvent, ForeignRun, empty_run
from .time_stepping import Stepping, TimeStepper

SAME_STEP = 1e-6


@dataclass(frozen=True)
class RunSettings:
    """How an FMU is run; see `FMU.simulate`."""

    begin: float
    stop: float
    step: float | None
    rtol: float
    inputs: Mapping[str, Any]
    parameters: Mapping[str, Any]
    start: Mapping[str, Any]
    record: tuple[str, ...]

    @property
    def outputs(self) -> list[float]:
        """Instants of output [s]."""
        span = self.stop - self.begin
        count = max(1, round(span / (self.step or span / 500)))
        return list(map(float, np.linspace(self.begin, self.stop, count + 1)))


def simulate_alone(
    fmu: FMUDescription, kind: str, settings: RunSettings, instantiate: Callable[[str], Instance]
) -> ForeignRun:
    """Run an FMU; see `FMU.simulate`."""
    begin, stop, step, rtol = settings.begin, settings.stop, settings.step, settings.rtol
    if not stop > begin or not (step is None or 0 < step < np.inf) or not 0 < rtol < 1:
        raise FMUError(
            f"FMU '{fmu.name}' cannot run from {begin:g} s to {stop:g} s with step={step} and rtol={rtol:g}"
        )
    began = clock.perf_counter()
    inputs = chosen_inputs(fmu, settings.inputs, begin, stop)
    run, wanted = empty_run(fmu, settings.record)
    outputs = settings.outputs
    longest = min(outputs[1] - outputs[0], inputs.longest_step)
    stepping = Stepping(begin, stop, rtol, list(inputs.continuous), longest)
    with instantiate(kind) as instance:
        run.notes += enter_initialization(instance, fmu, stepping, settings.parameters, settings.start)
        inputs.set_discrete(instance, begin)
        instance.drive(inputs.at(begin))
        stepper = STEPPERS[kind](instance, fmu, inputs.at, stepping)
        if not stepper.dense:
            run.notes += _step_notes(settings, inputs, stepper.flexible)
        _Alone(run, stepper, inputs, wanted, outputs).run_through()
    run.stats |= {**stepper.stats, "seconds": clock.perf_counter() - began}
    return run


def _step_notes(settings: RunSettings, inputs: Inputs, flexible: bool) -> list[str]:
    """Return notes on communication steps that are others than asked, and jumps that come too late."""
    notes, outputs = [], np.array(settings.outputs)
    step = float(outputs[1] - outputs[0])
    if settings.step is not None and abs(step - settings.step) > SAME_STEP * settings.step:
        notes.append(f"communication steps are {step:.9g} s, as {settings.step:g} s do not divide the run")
    inside = [jump for jump in inputs.jumps if settings.begin < jump < settings.stop]
    late = [jump for jump in inside if np.abs(outputs - jump).min() > SAME_STEP * step]
    if late and not flexible:
        notes.append(
            f"inputs that jump at {', '.join(f'{jump:g}' for jump in late[:3])} s do so at the "
            "communication point after that, as the FMU takes steps of one size only"
        )
    return notes


@dataclass(eq=False)
class _Alone:
    run: ForeignRun
    stepper: TimeStepper
    inputs: Inputs
    wanted: list[Group]
    outputs: list[float]
    following: int = 1

    def run_through(self) -> None:
        """Step to the last output, or to where the FMU asks to end."""
        stepper, stop = self.stepper, self.outputs[-1]
        self._record()
        while stepper.t < stop and not stepper.ended:
            jump, bend = self.inputs.next_changes(stepper.t)
            if stepper.dense:
                limit = min(stop, jump, bend)
            else:
                limit = min(self.outputs[self.following], jump if stepper.flexible else np.inf)
            stepper.step(limit, self._record_outputs)
            if stepper.t >= bend:
                stepper.follow(self.inputs.at)
            self._arrived(jump <= stepper.t)
        if stepper.ended:
            self.run.notes.append(f"the FMU asked to end at t = {stepper.t:.9g} s")

    def _record_outputs(self) -> None:
        while self.following < len(self.outputs) and self.outputs[self.following] <= self.stepper.t:
            self._record(self.outputs[self.following])
            self.following += 1

    def _arrived(self, jumped: bool) -> None:
        """Record where outputs did not, and switch at an event or where a discrete input jumps."""
        stepper, cause = self.stepper, self.stepper.event
        if jumped and cause not in ("state", "time"):
            cause = "input"
        switching = bool(cause) and not stepper.ended
        if (switching or not stepper.dense) and self.run.last < stepper.t:
            self._record()
        if switching and stepper.switches:
            stepper.switch(self._set_discrete)
            self.run.events.append(ForeignEvent(stepper.t, cause))
            if not stepper.ended:
                self._record()
        elif switching:
            self._set_discrete()

    def _set_discrete(self) -> None:
        self.inputs.set_discrete(self.stepper.instance, self.stepper.t)

    def _record(self, t: float | None = None) -> None:
        values, at = self.stepper.look(self.wanted, t), self.stepper.t if t is None else t
        self.run.record(at, list(finite(self.run.name, "a variable", at, values)))
