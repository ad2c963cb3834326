"""Runs of a checked FMU through FMPy: Model Exchange under its CVODE, Co-Simulation step by step."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from ...base import Array, heed, interruptible
from ..errors import FMUError
from .probe import Probe, Subject

DENSE = 300
ACCURATE = 1e-5
FINEST = 1e-12
PARTS = 1, 30, 1000  # of an interval of output, where CVODE takes too many steps for one
TOO_FEW = "mxstep"


@dataclass(frozen=True)
class Experiment:
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
        return max(ACCURATE * self.rtol, FINEST)

    @property
    def grid(self) -> Array:
        """The instants of output."""
        count = max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)


@dataclass(frozen=True, eq=False)
class Course:
    """What a run gave: values of `names` at the instants of output, and the instants of events.

    An FMU may end a run: what came before counts.
    """

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


def exchange(
    subject: Subject, names: Sequence[str], experiment: Experiment, visit: Visit | None = None
) -> Course:
    """Run Model Exchange; `visit` is called with the probe at instants of output and events.

    FMPy integrates with CVODE, which begins anew with order 1 after each event, so its tolerance is a tenth
    of that of the native run, or the same where rounding errors keep it from a tenth. It takes 500 steps from
    one output to the next at most: where those are too few, outputs are put between. Its Jacobian is dense:
    beyond 300 states LSODA integrates, as in `FMU.simulate`, and `visit` sees the start only.
    """
    if len(subject.fmu.states) > DENSE:
        return _exchange_large(subject, names, experiment, visit)
    for parts in PARTS:
        problem = None
        for rtol in (max(0.1 * experiment.accurate, FINEST), experiment.accurate):
            try:
                return _exchange_by_cvode(subject, names, experiment, visit, rtol, parts)
            except FMUError as error:
                if "CVode error" not in str(error):
                    raise
                problem = error
                if TOO_FEW in str(error):
                    break
        else:
            raise problem or AssertionError
    return _exchange_large(subject, names, experiment, visit)


def _exchange_by_cvode(
    subject: Subject,
    names: Sequence[str],
    experiment: Experiment,
    visit: Visit | None,
    rtol: float,
    parts: int,
) -> Course:
    from fmpy import simulate_fmu

    with subject.probe("ME") as probe:
        problems: list[Exception] = []

        def finished(time: float, _: object) -> bool:
            heed()
            try:
                if visit is not None:
                    visit(probe, time)
            except Exception as error:
                problems.append(error)
            return not problems

        try:
            with interruptible():  # CVODE calls back into Python, which would lose Ctrl-C there
                run = simulate_fmu(
                    str(subject.files.folder), validate=False, fmi_type="ModelExchange",
                    start_time=experiment.begin, stop_time=experiment.stop,
                    output_interval=experiment.step / parts, relative_tolerance=rtol,
                    start_values=dict(experiment.inputs),
                    output=list(names), model_description=probe.description, fmu_instance=probe.instance,
                    step_finished=finished,
                )  # fmt: skip
        except Exception as error:
            raise FMUError(f"FMU '{probe.name}': {error}") from error
        if problems:
            raise problems[0]
    return _sampled(
        names, run["time"], [run[name].astype(float) for name in names], experiment, f"CVODE, rtol {rtol:.0e}"
    )


def _exchange_large(
    subject: Subject, names: Sequence[str], experiment: Experiment, visit: Visit | None
) -> Course:
    if visit is not None:
        with subject.probe("ME") as probe:
            probe.begin(experiment.begin, experiment.stop, experiment.rtol, experiment.inputs)
            visit(probe, experiment.begin)
            visit(probe, experiment.begin)
    run = subject.fmu.simulate(
        experiment.stop, begin=experiment.begin, step=experiment.step, rtol=experiment.accurate, kind="ME",
        inputs=dict(experiment.inputs), record=names,
    )  # fmt: skip
    return _sampled(
        names, run.time, [run[name] for name in names], experiment, f"LSODA, rtol {experiment.accurate:.0e}"
    )


def _sampled(
    names: Sequence[str], time: Array, columns: list[Array], experiment: Experiment, solver: str
) -> Course:
    """Return the values at the instants of output, after events; two points of one time make an event."""
    grid = experiment.grid[experiment.grid <= time[-1] + 1e-9 * (1 + abs(time[-1]))]
    near = np.searchsorted(time, grid + 1e-9 * experiment.step, side="right") - 1
    values = np.column_stack([column[near] for column in columns]) if columns else np.zeros((len(grid), 0))
    return Course(names, grid, values, np.unique(time[1:][np.diff(time) == 0]), solver)


def communicate(subject: Subject, names: Sequence[str], experiment: Experiment, events: bool) -> Course:
    """Run Co-Simulation, with event mode if `events`; the communication step is that of output."""
    grid, rows, found = experiment.grid, list[Array](), list[float]()
    with subject.probe("CS", events) as probe:
        probe.begin(experiment.begin, experiment.stop, experiment.rtol, experiment.inputs)
        rows.append(probe.values(names))
        for begin, target in pairwise(grid.tolist()):
            arrived, ended = _communicated(probe, begin, target, found)
            if arrived:
                rows.append(probe.values(names))
            if ended:
                break
    instants = np.unique(found) if events else None
    solver = f"the FMU's own, rtol {experiment.rtol:.0e}"
    return Course(names, grid[: len(rows)], np.array(rows), instants, solver)


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
