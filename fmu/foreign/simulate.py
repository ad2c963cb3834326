"""Running an FMU alone."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...base import text
from ...components import UnknownNameError, nearest
from ...networks import OverTime
from ..cosimulation.communication_steps import StepSizes, followed_inputs, given, untaken
from ..errors import FMUError
from ..fmu import FMU
from .description import ForeignVariable
from .inputs import Inputs, chosen_inputs, chosen_values, groups
from .instance import Instance, Values, finite
from .me_integrator import Chatter, Solver

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]
ALIKE = 1e-6


@dataclass(frozen=True)
class ForeignEvent:
    """An event of an FMU: "state", "time", "step" (asked for by the FMU) or "input"."""

    time: float
    cause: str


@dataclass(eq=False)
class ForeignRun(OverTime):
    """What an FMU gave along a run, in the units it declares.

    At an event two points share one time: before and after.

    Attributes:
        fmu: its name.
        events: its events, in order.
        stats: solver, steps, evaluations, seconds.
        notes: what is to be known, such as an end that the FMU asked for.
    """

    fmu: str
    units: dict[str, str]
    events: list[ForeignEvent] = field(default_factory=list)
    stats: dict[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    _times: list[float] = field(default_factory=list)
    _rows: list[Values] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the FMU."""
        return self.fmu

    def record(self, t: float, values: Values) -> None:
        """Append a point."""
        self._times.append(t)
        self._rows.append(values)

    @property
    def time(self) -> Array:
        """Instants of the points [s]."""
        return np.array(self._times)

    def names(self) -> list[str]:
        """Return the names of what was recorded."""
        return ["time", *self.units]

    def __contains__(self, name: str) -> bool:
        return name == "time" or name in self.units

    def __getitem__(self, name: str) -> Array:
        """Return a variable along the run.

        Raises:
            UnknownNameError: if it was not recorded, with the nearest name.
        """
        if name == "time":
            return self.time
        place = list(self.units).index(self._known(name))
        return np.array([row[place] for row in self._rows])

    def unit(self, name: str) -> str:
        """Return the unit of a variable; errors as for its values."""
        return "s" if name == "time" else self.units[self._known(name)]

    def _known(self, name: str) -> str:
        if not text(name) and name in self.units:
            return name
        raise UnknownNameError(
            f"'{name}' of '{self.name}' was not recorded (record=[...]){nearest(name, self.units)}"
        )

    def to_dataframe(self) -> pd.DataFrame:
        """Return everything as a pandas DataFrame indexed by time."""
        import pandas as pd

        rows = np.array(self._rows, dtype=float).reshape(len(self._rows), len(self.units))
        table = pd.DataFrame(rows, columns=list(self.units), index=pd.Index(self.time, name="time"))
        table.attrs["units"] = dict(self.units)
        return table


def recorded_variables(fmu: FMU, extra: tuple[str, ...]) -> list[ForeignVariable]:
    """Return what a run records: outputs, states, and what is asked for besides."""
    names = [*fmu.outputs, *fmu.states, *extra]
    variables = [fmu.variable(name) for name in dict.fromkeys(names)]
    return [v for v in variables if v.type not in ("String", "Binary", "Clock")]


def begin_run(
    fmu: FMU, instance: Instance, begin: float, stop: float, rtol: float, inputs: Inputs,
    parameters: Mapping[str, Any], start: Mapping[str, Any],
) -> list[str]:  # fmt: skip
    """Set values and inputs in initialization mode, and stay there; return notes on what was not taken."""
    values = chosen_values(fmu, parameters, start)
    instance.start(begin, stop, rtol, list(values.values()), inputs.references)
    inputs.hold(instance, begin)
    instance.drive(inputs.at(begin))
    return untaken(fmu, instance, values)


def simulate_alone(
    fmu: FMU, kind: str, begin: float, stop: float, step: float | None, rtol: float,
    signals: Mapping[str, Any], parameters: Mapping[str, Any], start: Mapping[str, Any],
    record: tuple[str, ...],
) -> ForeignRun:  # fmt: skip
    """Run an FMU; see `FMU.simulate`."""
    if not stop > begin or not (step is None or 0 < step < np.inf) or not 0 < rtol < 1:
        raise FMUError(
            f"FMU '{fmu.name}' cannot run from {begin:g} s to {stop:g} s with step={step} and rtol={rtol:g}"
        )
    began = clock.perf_counter()
    inputs = chosen_inputs(fmu, signals, begin, stop)
    variables = recorded_variables(fmu, record)
    run = ForeignRun(fmu.name, {c: v.unit for v in variables for c in v.columns})
    count = max(1, round((stop - begin) / (step or (stop - begin) / 500)))
    outputs = np.linspace(begin, stop, count + 1)
    with fmu.instantiate(kind) as instance:
        run.notes += begin_run(fmu, instance, begin, stop, rtol, inputs, parameters, start)
        alone = _Alone(run, instance, inputs, groups(variables), outputs)
        if kind == "ME":
            alone.exchange(rtol, fmu.description.numberOfEventIndicators)
        else:
            alone.communicate(StepSizes(fmu), step)
    run.stats["seconds"] = clock.perf_counter() - began
    return run


@dataclass(eq=False)
class _Alone:
    run: ForeignRun
    instance: Instance
    inputs: Inputs
    wanted: list[Any]
    outputs: Array

    def __post_init__(self) -> None:
        self.chatter = Chatter(self.run.name, float(self.outputs[-1] - self.outputs[0]), [])

    def exchange(self, rtol: float, watched: int) -> None:
        """Integrate a Model Exchange FMU."""
        t, stop = float(self.outputs[0]), float(self.outputs[-1])
        self.instance.started()
        update = self.instance.update()
        if update.terminate:
            raise FMUError(f"FMU '{self.run.name}' asked to end at its start")
        longest = min(float(self.outputs[1] - t), self.inputs.pace)
        solver = Solver(self.run.name, self.instance, watched, self.inputs.at, t, rtol, longest)
        solver.next_event = np.inf if update.next_event is None else update.next_event
        self._look(solver, t)
        following, ended = 1, False
        while solver.t < stop and not ended:
            jump = self.inputs.next_jump(solver.t)
            wake = self.inputs.next_wake(solver.t)
            piece = solver.step(min(stop, jump, wake))
            while following < len(self.outputs) and self.outputs[following] <= piece.end:
                output = float(self.outputs[following])
                self._look(solver, output, np.asarray(piece.states(output)))
                following += 1
            asked, ended = solver.arrive()
            causes = {
                "state": piece.event, "time": solver.t >= solver.next_event,
                "input": solver.t >= jump, "step": asked,
            }  # fmt: skip
            cause = next((name for name, true in causes.items() if true), None)
            if solver.t >= wake:
                solver.restart()
            if cause and not ended:
                ended = self._switch(solver, cause)
        self.run.stats |= {"solver": "LSODA", "steps": solver.steps, "evaluations": solver.evaluations}
        self._tell(ended, solver.t)

    def _switch(self, solver: Solver, cause: str) -> bool:
        if self.run._times[-1] < solver.t:
            self._look(solver, solver.t)
        self.instance.enter_events()
        self.inputs.hold(self.instance, solver.t)
        ended = solver.updated().terminate
        self.run.events.append(ForeignEvent(solver.t, cause))
        self.chatter.happened(solver.t)
        if not ended:
            self._look(solver, solver.t)
        return ended

    def _look(self, solver: Solver, t: float, x: Array | None = None) -> None:
        states: Array = solver.x if x is None else x
        found = self.instance.look(t, states.tolist(), self.inputs.at(t), self.wanted)
        self.run.record(t, list(finite(self.run.name, "a variable", t, found)))

    def _tell(self, ended: bool, t: float) -> None:
        if ended:
            self.run.notes.append(f"the FMU asked to end at t = {t:.9g} s")

    def communicate(self, sizes: StepSizes, asked: float | None) -> None:
        """Advance a Co-Simulation FMU from communication point to communication point."""
        t, stop = float(self.outputs[0]), float(self.outputs[-1])
        self.instance.started()
        modes, followed = self.instance.event_mode, followed_inputs(list(self.inputs.driven))
        self._tell_steps(sizes, asked)
        ended = modes and self.instance.update().terminate
        self._read(t)
        following, steps, arrived = 1, 0, True
        while following < len(self.outputs) and not ended:
            jump = self.inputs.next_jump(t)
            target = min(float(self.outputs[following]), jump if sizes.flexible else np.inf)
            if arrived:
                sizes.check(t, target - t)
            inputs, rates = given(self.inputs.at, t, target - t, self.instance.interpolates, followed)
            stepped = self.instance.step(t, target - t, inputs, rates)
            steps += 1
            t, arrived = stepped.landed(self.run.name, t, target)
            self.instance.drive(self.inputs.at(t))
            self._read(t)
            if not modes:
                self.inputs.hold(self.instance, t)
            elif stepped.event or jump <= t:
                ended = self._event_mode(t, "state" if stepped.event else "input")
            ended = ended or stepped.terminate
            following += t >= self.outputs[following]
        self.run.stats |= {"solver": "the FMU's own", "steps": steps}
        self._tell(ended, min(t, stop))

    def _tell_steps(self, sizes: StepSizes, asked: float | None) -> None:
        """Note steps that are others than asked, and jumps that come too late."""
        step = float(self.outputs[1] - self.outputs[0])
        if asked is not None and abs(step - asked) > ALIKE * asked:
            self.run.notes.append(
                f"communication steps are {step:.9g} s, as {asked:g} s do not divide the run"
            )
        inside = [jump for jump in self.inputs.jumps if self.outputs[0] < jump < self.outputs[-1]]
        late = [jump for jump in inside if np.abs(self.outputs - jump).min() > ALIKE * step]
        if late and not sizes.flexible:
            self.run.notes.append(
                f"inputs that jump at {', '.join(f'{jump:g}' for jump in late[:3])} s do so at the "
                "communication point after that, as the FMU takes steps of one size only"
            )

    def _event_mode(self, t: float, cause: str) -> bool:
        self.instance.enter_events()
        self.inputs.hold(self.instance, t)
        update = self.instance.update()
        self.run.events.append(ForeignEvent(t, cause))
        self.chatter.happened(t)
        if not update.terminate:
            self._read(t)
        return update.terminate

    def _read(self, t: float) -> None:
        self.run.record(t, list(finite(self.run.name, "a variable", t, self.instance.get(self.wanted))))
