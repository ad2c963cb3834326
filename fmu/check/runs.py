"""Runs of a checked FMU through FMPy: Model Exchange under its CVODE, Co-Simulation step by step."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from ...base import Array, heed, interruptible
from ..errors import FMUError
from .probe import CheckedFMU, Probe

DENSE_JACOBIAN_STATES = 300
OWN_TOLERANCE_SHARE = 1e-5
FINEST = 1e-12
OUTPUT_SUBDIVISIONS = 1, 30, 1000  # where CVODE takes too many steps for one interval of output
TOO_MANY_STEPS = "mxstep"  # as CVODE says it


@dataclass(frozen=True)
class Scenario:
    """What is run: from `begin` to `stop`, looked at every `step`, with constant inputs.

    Attributes:
        rtol: the tolerance asked of FMUs that integrate themselves.
    """

    begin: float
    stop: float
    step: float
    rtol: float
    inputs: Mapping[str, float] = field(default_factory=dict)

    @property
    def accurate(self) -> float:
        """The tolerance of integrators that are not the FMU's, so that their errors do not count."""
        return max(OWN_TOLERANCE_SHARE * self.rtol, FINEST)

    @property
    def grid(self) -> Array:
        """The instants of output."""
        count = max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)


@dataclass(frozen=True, eq=False)
class Course:
    """What a run gave, as far as it went: `names` at the instants of output, and the instants of events."""

    names: Sequence[str]
    time: Array
    values: Array
    events: Array | None
    solver: str = ""

    def until(self, time: float) -> Course:
        """Return the part up to an instant."""
        count = int((self.time <= time).sum())
        return replace(self, time=self.time[:count], values=self.values[:count])

    def of(self, names: Sequence[str]) -> Course:
        """Return the course of some of the names."""
        places = [list(self.names).index(name) for name in names]
        return Course(names, self.time, self.values[:, places], self.events, self.solver)


Visit = Callable[[Probe, float], None]


def exchange(fmu: CheckedFMU, names: Sequence[str], scenario: Scenario, visit: Visit) -> Course:
    """Run Model Exchange; `visit` is called with the probe at instants of output and events.

    FMPy integrates with CVODE, which begins anew with order 1 after each event, so its tolerance is a tenth
    of that of the native run, or the same where rounding errors keep it from a tenth. It takes 500 steps from
    one output to the next at most: where those are too few, outputs are put between. Its Jacobian is dense:
    beyond 300 states LSODA integrates, as in `FMU.simulate`, and `visit` sees the start only.
    """
    if len(fmu.states) > DENSE_JACOBIAN_STATES:
        return _exchange_large(fmu, names, scenario, visit)
    for parts in OUTPUT_SUBDIVISIONS:
        for rtol in (max(0.1 * scenario.accurate, FINEST), scenario.accurate):
            try:
                return _exchange_by_cvode(fmu, names, scenario, visit, rtol, parts)
            except FMUError as error:
                if "CVode error" not in str(error):
                    raise
                problem = error
                if TOO_MANY_STEPS in str(error):
                    break
        else:
            raise problem
    return _exchange_large(fmu, names, scenario, visit)


def _exchange_by_cvode(
    fmu: CheckedFMU, names: Sequence[str], scenario: Scenario, visit: Visit, rtol: float, parts: int
) -> Course:
    from fmpy import simulate_fmu

    with Probe(fmu, "ME") as probe:
        problems: list[Exception] = []

        def finished(time: float, _: object) -> bool:
            heed()
            try:
                visit(probe, time)
            except Exception as error:
                problems.append(error)
            return not problems

        try:
            with interruptible():  # CVODE calls back into Python, which would lose Ctrl-C there
                run = simulate_fmu(
                    str(fmu.files.folder), validate=False, fmi_type="ModelExchange",
                    start_time=scenario.begin, stop_time=scenario.stop,
                    output_interval=scenario.step / parts, relative_tolerance=rtol,
                    start_values=dict(scenario.inputs),
                    output=list(names), model_description=probe.description, fmu_instance=probe.instance,
                    step_finished=finished,
                )  # fmt: skip
        except Exception as error:
            raise FMUError(f"FMU '{probe.name}': {error}") from error
        if problems:
            raise problems[0]
    course = sampled(names, run["time"], [run[name].astype(float) for name in names], scenario)
    return replace(course, solver=f"CVODE, rtol {rtol:.0e}")


def _exchange_large(fmu: CheckedFMU, names: Sequence[str], scenario: Scenario, visit: Visit) -> Course:
    with Probe(fmu, "ME") as probe:
        probe.begin(scenario.begin, scenario.stop, scenario.rtol, scenario.inputs)
        visit(probe, scenario.begin)
        visit(probe, scenario.begin)
    run = fmu.simulate(
        scenario.stop, begin=scenario.begin, step=scenario.step, rtol=scenario.accurate, kind="ME",
        inputs=dict(scenario.inputs), record=names,
    )  # fmt: skip
    course = sampled(names, run.time, [run[name] for name in names], scenario)
    return replace(course, solver=f"LSODA, rtol {scenario.accurate:.0e}")


def sampled(names: Sequence[str], time: Array, columns: list[Array], scenario: Scenario) -> Course:
    """Return the values at the instants of output, after events; two points of one time make an event."""
    grid = scenario.grid[scenario.grid <= time[-1] + 1e-9 * (1 + abs(time[-1]))]
    near = np.searchsorted(time, grid + 1e-9 * scenario.step, side="right") - 1
    values = np.column_stack([column[near] for column in columns]) if columns else np.zeros((len(grid), 0))
    return Course(names, grid, values, np.unique(time[1:][np.diff(time) == 0]))


def communicate(fmu: CheckedFMU, names: Sequence[str], scenario: Scenario) -> Course:
    """Run Co-Simulation, with event mode where the FMU has it; the communication step is that of output."""
    grid, rows, found = scenario.grid, list[Array](), list[float]()
    able = fmu.capable("CS", "hasEventMode")
    with Probe(fmu, "CS", able) as probe:
        probe.begin(scenario.begin, scenario.stop, scenario.rtol, scenario.inputs)
        rows.append(probe.values(names))
        for begin, target in pairwise(grid.tolist()):
            arrived, ended = _communicated(probe, begin, target, found)
            if arrived:
                rows.append(probe.values(names))
            if ended:
                break
    solver = f"the FMU's own, rtol {scenario.rtol:.0e}"
    return Course(names, grid[: len(rows)], np.array(rows), np.unique(found) if able else None, solver)


def _communicated(probe: Probe, t: float, target: float, found: list[float]) -> tuple[bool, bool]:
    """Go on to an instant, noting events in event mode; tell whether it was reached, and the run ended."""
    arrived = ended = False
    while not (arrived or ended):
        stepped = probe.step(t, target - t, [], [])
        ended = stepped.terminate
        t, arrived = stepped.landed(probe.name, t, target)
        if stepped.event and probe.event_mode and not ended:
            found.append(t)
            probe.enter_events()
            ended = probe.update().terminate
    return arrived, ended
