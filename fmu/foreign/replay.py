"""Replay: an FMU run again and again on sampled inputs, with a force of ours at its port if wanted."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self

import numpy as np

from ...base import Array
from ..errors import FMUError
from .communication_steps import CoSimulation
from .description import FMUDescription
from .initialization import STEPPERS, enter_initialization
from .inputs import groups
from .instance import Group, Values, finite
from .port_force import Load, LoadedInstance
from .time_stepping import Stepping, TimeStepper
from .unpacked import Unpacked

Samples = list[tuple[float, Values]]


class Replay:
    """An FMU whose files are unpacked once, to be run on samples many times; use it with `with`.

    Model Exchange takes cubic splines through the samples, with the load inside its equations.
    Co-Simulation takes their mean over each communication step, from sample to sample, or their rate if it
    interpolates; the load is extrapolated over the step. What it says of acceleration is half a step late,
    so that an inertia above the one that it is joined to makes the run unstable.

    Args:
        fmu: which.
        kind: "ME" or "CS".
        inputs: names of what is driven.
        outputs: names of what is wanted.
        held: inputs that keep each sample until the next.
    """

    def __init__(
        self,
        fmu: FMUDescription,
        kind: str,
        inputs: Sequence[str],
        outputs: Sequence[str],
        held: Sequence[str] = (),
    ) -> None:
        self.fmu, self.kind, self.inputs, self.outputs = fmu, kind, list(inputs), list(outputs)
        self._held = [self.inputs.index(name) for name in held]
        self._files = Unpacked(fmu.path)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Remove the files."""
        self._files.remove()

    def run(
        self, time: Array, given: Array, parameters: Mapping[str, Any],
        start: Mapping[str, Any] | None = None, load: Load | None = None, every: int = 1, rtol: float = 1e-6,
    ) -> Array:  # fmt: skip
        """Return the outputs, one column each, at every so many samples.

        Args:
            time: instants of the samples, evenly spaced [s].
            given: samples of the inputs, one column each.
            parameters: changed parameters by name.
            start: changed start values by name.
            load: what else acts at the port.
            every: samples from one row of the outputs to the next.
            rtol: relative tolerance.

        Raises:
            FMUError: if the FMU fails, ends early or returns no finite numbers.
        """
        fmu, longest = self.fmu, float(time[every] - time[0])
        stepping = Stepping(float(time[0]), float(time[-1]), rtol, self.inputs, longest)
        course = _spline(time, given, self._held) if self.kind == "ME" else lambda t: given[0].tolist()
        wanted = groups(fmu.variables[name] for name in self.outputs)
        with LoadedInstance(fmu, self.kind, self._files, self.inputs, load) as instance:
            enter_initialization(instance, fmu, stepping, parameters, start or {})
            instance.drive(given[0].tolist())
            stepper = STEPPERS[self.kind](instance, fmu, course, stepping)
            _switch(stepper)
            if isinstance(stepper, CoSimulation):
                samples = list(zip(time.tolist(), given.tolist(), strict=True))
                found = _communicated(stepper, instance, wanted, samples, every, self._held)
            else:
                found = _integrated(stepper, wanted, time[::every].tolist())
        return _table(fmu.name, found, time[::every])


def _integrated(stepper: TimeStepper, wanted: list[Group], instants: list[float]) -> list[Values]:
    found = [stepper.look(wanted)]

    def look_back() -> None:
        while len(found) < len(instants) and instants[len(found)] <= stepper.t:
            found.append(stepper.look(wanted, instants[len(found)]))

    while len(found) < len(instants):
        stepper.step(instants[-1], look_back)
        _switch(stepper)
    return found


def _spline(time: Array, given: Array, held: list[int]) -> Callable[[float], Values]:
    """Return the inputs as cubic splines through their samples, `held` as steps, quick at single instants."""
    from scipy.interpolate import CubicSpline

    powers = CubicSpline(time, given).c
    powers[:, :, held] = 0.0
    powers[3, :, held] = given[:-1, held].T
    pieces = np.moveaxis(powers, 1, 0).tolist()
    begin, rate, instants = float(time[0]), (len(time) - 1) / float(time[-1] - time[0]), time.tolist()
    last = len(pieces) - 1

    def drive(t: float) -> Values:
        k = min(max(int((t - begin) * rate), 0), last)
        x = t - instants[k]
        return [((a * x + b) * x + c) * x + d for a, b, c, d in zip(*pieces[k], strict=True)]

    return drive


def _communicated(
    stepper: CoSimulation,
    instance: LoadedInstance,
    wanted: list[Group],
    samples: Samples,
    every: int,
    held: list[int],
) -> list[Values]:
    found = []
    for k, (t, row) in enumerate(samples):
        end, after = samples[k + 1] if k + 1 < len(samples) else (2 * t - samples[k - 1][0], row)
        after = [row[place] if place in held else value for place, value in enumerate(after)]
        force, following = instance.extrapolated(t, end - t)
        row, after = instance.loaded(row, force), instance.loaded(after, following)
        if k % every == 0:
            stepper.hold(row)
            found.append(stepper.look(wanted))
        mean = [0.5 * (a + b) for a, b in zip(row, after, strict=True)]
        inputs, rates = stepper.step_inputs(row, mean, after, end - t)
        while k + 1 < len(samples) and stepper.t < end:
            stepper.communicate(end, inputs, rates)
            _switch(stepper)
    return found


def _switch(stepper: TimeStepper) -> None:
    """Iterate the event that the last step ended at, if at any; refuse an end before that of the record."""
    if stepper.event and not stepper.ended:
        stepper.switch()
    if stepper.ended:
        raise FMUError(f"FMU '{stepper.name}' asked to end at t = {stepper.t:.9g} s, before the record does")


def _table(name: str, found: list[Values], instants: Array) -> Array:
    table: Array = np.array(found, dtype=np.float64).reshape(len(instants), -1)
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(wrong):
        finite(name, "an output", float(instants[wrong[0]]), table[wrong[0]].tolist())
    return table
