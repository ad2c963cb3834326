"""Replay: an FMU run again and again on sampled inputs, with a force of ours at its port if wanted."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ..errors import FMUError
from ..fmu import FMU
from .inputs import chosen_values
from .instance import Values, finite
from .me_integrator import Solver
from .port_force import Load, LoadedInstance
from .unpacked import Unpacked

Array = NDArray[np.float64]


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
    """

    def __init__(self, fmu: FMU, kind: str, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        self.fmu, self.kind, self.inputs, self.outputs = fmu, kind, list(inputs), list(outputs)
        self._files = Unpacked(fmu.path)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
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
        from fmpy.fmi1 import FMICallException

        fmu, variables = self.fmu, self.fmu.variables
        values = chosen_values(fmu, parameters, start or {})
        references = [variables[name].reference for name in self.inputs]
        with LoadedInstance(fmu.path, self.kind, files=self._files) as instance:
            try:
                instance.prepare(fmu, self.inputs, self.outputs, load)
                instance.start(float(time[0]), float(time[-1]), rtol, list(values.values()), references)
                instance.drive(given[0].tolist())
                instance.started()
                if self.kind == "ME":
                    return _exchange(instance, time, given, every, rtol)
                return _communicate(instance, time, given, every)
            except FMICallException as error:
                raise FMUError(f"FMU '{fmu.name}': {error}") from error


def _exchange(instance: LoadedInstance, time: Array, given: Array, every: int, rtol: float) -> Array:
    update = instance.update()
    _going_on(instance, update.terminate, float(time[0]))
    drive, begin = _smooth(time, given), float(time[0])
    name, watched = instance.fmu.name, instance.description.numberOfEventIndicators
    instants = time[::every].tolist()
    longest = float(time[every] - time[0])
    solver = Solver(name, instance, watched, drive, begin, rtol, longest)
    solver.next_event = np.inf if update.next_event is None else update.next_event
    found = [instance.look(begin, solver.x.tolist(), drive(begin), instance.wanted)]
    while len(found) < len(instants):
        piece = solver.step(instants[-1])
        while len(found) < len(instants) and instants[len(found)] <= piece.end:
            t = instants[len(found)]
            found.append(instance.look(t, np.asarray(piece.states(t)).tolist(), drive(t), instance.wanted))
        asked, ended = solver.arrive()
        _going_on(instance, ended, solver.t)
        if piece.event or asked or solver.t >= solver.next_event:
            _going_on(instance, solver.switch().terminate, solver.t)
    return _table(instance, found, instants)


def _smooth(time: Array, given: Array) -> Callable[[float], Values]:
    """Return the inputs as cubic splines through their samples, quick at single instants."""
    from scipy.interpolate import CubicSpline

    pieces = np.moveaxis(CubicSpline(time, given).c, 1, 0).tolist()
    begin, rate, instants = float(time[0]), (len(time) - 1) / float(time[-1] - time[0]), time.tolist()
    last = len(pieces) - 1

    def drive(t: float) -> Values:
        k = min(max(int((t - begin) * rate), 0), last)
        x = t - instants[k]
        return [((a * x + b) * x + c) * x + d for a, b, c, d in zip(*pieces[k], strict=True)]

    return drive


def _communicate(instance: LoadedInstance, time: Array, given: Array, every: int) -> Array:
    if instance.event_mode:
        _going_on(instance, instance.update().terminate, float(time[0]))
    rows, instants, load = given.tolist(), time.tolist(), instance.load
    found, before, force, following = [], None, 0.0, 0.0
    for k, (t, row) in enumerate(zip(instants, rows, strict=True)):
        step = instants[k + 1] - t if k + 1 < len(rows) else t - instants[k - 1]
        if load is not None:
            s, v = instance.moved()
            a = 0.0 if before is None else (v - before) / step
            before = v
            force = load.law(t, s, v, a)
            following = load.law(t + step, s + step * (v + 0.5 * step * a), v + step * a, a)
            row = instance.loaded(row, force)
        if k % every == 0:
            instance.drive(row)
            found.append(instance.get(instance.wanted))
        if k + 1 == len(rows):
            break
        after = rows[k + 1] if load is None else instance.loaded(rows[k + 1], following)
        _advance(instance, t, instants[k + 1], *_held(instance, row, after, step))
    return _table(instance, found, instants[::every])


def _held(instance: LoadedInstance, row: Values, after: Values, step: float) -> tuple[Values, Values]:
    """Return inputs for a communication step, and their rates for an FMU that interpolates.

    An input x beside an input der(x) is given where the step begins, as it follows der(x).
    """
    if instance.interpolates:
        return row, [(b - a) / step for a, b in zip(row, after, strict=True)]
    inputs = [0.5 * (a + b) for a, b in zip(row, after, strict=True)]
    for place in instance.followed:
        inputs[place] = row[place]
    return inputs, [0.0] * len(row)


def _advance(instance: LoadedInstance, t: float, target: float, inputs: Values, rates: Values) -> None:
    """Go to the next communication point, over the events on the way."""
    while t < target:
        stepped = instance.step(t, target - t, inputs, rates)
        t, _ = stepped.landed(instance.name, t, target)
        _going_on(instance, stepped.terminate, t)
        if stepped.event and instance.event_mode:
            instance.enter_events()
            _going_on(instance, instance.update().terminate, t)


def _going_on(instance: LoadedInstance, ended: bool, t: float) -> None:
    if ended:
        raise FMUError(f"FMU '{instance.name}' asked to end at t = {t:.9g} s, before the record does")


def _table(instance: LoadedInstance, found: list[Values], instants: Sequence[float]) -> Array:
    table: Array = np.array(found, dtype=np.float64).reshape(len(instants), -1)
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(wrong):
        finite(instance.name, "an output", instants[wrong[0]], table[wrong[0]].tolist())
    return table
