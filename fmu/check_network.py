"""A network against its FMUs: the native run, and FMI 2.0 and 3.0, Model Exchange and Co-Simulation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from ..networks import DAE, Result
from .check_agreement import Reference, bisected_finding, events_finding, outputs_finding
from .check_derivatives import Derivatives
from .check_probe import Subject
from .check_report import Finding
from .check_runs import Course, Experiment, communicate, exchange
from .check_sections import sizes
from .check_states import state_findings
from .check_xml import xml_findings
from .errors import FMUError
from .export import export

Array = NDArray[np.float64]
SAME_INSTANT = 1e-9


def network_findings(
    dae: DAE,
    experiment: Experiment,
    start: Mapping[str, float],
    outputs: Iterable[str] | None,
    versions: Iterable[str],
    limit: float,
) -> Iterator[Finding]:
    """Yield what is found of a network's FMUs, version by version."""
    chosen = None if outputs is None else list(outputs)
    native = _Native(dae, experiment, start)
    for version in versions:
        with TemporaryDirectory(prefix="inertance-") as folder:
            path = export(
                dae, Path(folder) / "checked.fmu", fmi_version=version, outputs=chosen, start=start,
                stop=experiment.stop, step=experiment.step, tolerance=experiment.rtol, sources=version == "3.0",
            )  # fmt: skip
            yield from xml_findings(f"FMI {version}", path)
            with Subject(path) as subject:
                yield from _exchanged(subject, native, limit)
                yield from _communicated(subject, native, limit)
                for kind in ("ME", "CS"):
                    yield from state_findings(subject, kind, experiment)


class _Native:
    """The native run, which all kinds are compared with."""

    def __init__(self, dae: DAE, experiment: Experiment, start: Mapping[str, float]) -> None:
        self.experiment = experiment
        self.run: Result = dae.simulate(
            experiment.stop, begin=experiment.begin, step=experiment.step, start=start,
            inputs=dict(experiment.inputs), rtol=experiment.rtol, atol=1e-2 * experiment.rtol, progress=False,
        )  # fmt: skip

    def reference(self, names: list[str]) -> Reference:
        """Return the values of variables on the grid of output."""
        grid = self.experiment.grid
        near = np.searchsorted(self.run.time, grid + 1e-9 * self.experiment.step, side="right") - 1
        columns = [self.run[name] for name in names]
        course = Course(names, grid, np.column_stack([column[near] for column in columns]), self.events)
        return Reference(course, sizes(np.column_stack(columns)))

    @property
    def events(self) -> Array:
        """Instants of events, each once; what happens at the very start is none."""
        times = np.unique([event.time for event in self.run.events])
        times = times[times > self.experiment.begin + SAME_INSTANT]
        return times[np.diff(times, prepend=-np.inf) > SAME_INSTANT]

    def sides(self, names: list[str]) -> tuple[Array, Array]:
        """Return values right before and right after each event."""
        time = self.run.time
        places = np.abs(time[None, :] - self.events[:, None]) <= SAME_INSTANT
        first, last = places.argmax(axis=1), len(time) - 1 - places[:, ::-1].argmax(axis=1)
        table = np.column_stack([self.run[name] for name in names])
        return table[first], table[last]


def _names(subject: Subject) -> list[str]:
    """Return what is compared: outputs, states and modes."""
    return list(dict.fromkeys([*subject.shown(), *subject.discrete()]))


def _exchanged(subject: Subject, native: _Native, limit: float) -> Iterator[Finding]:
    label, names = subject.label("ME"), _names(subject)
    derivatives = Derivatives(subject)
    try:
        course = exchange(subject, names, native.experiment, derivatives)
    except FMUError as error:
        yield Finding(label, "run", False, told=str(error))
        return
    yield outputs_finding(label, course, native.reference(names), limit)
    if course.events is not None:
        yield events_finding(label, course.events, native.events)
    yield from derivatives.findings()


def _communicated(subject: Subject, native: _Native, limit: float) -> Iterator[Finding]:
    label, names = subject.label("CS"), _names(subject)
    able = subject.fmu.capable("CS", "hasEventMode")
    try:
        course = communicate(subject, names, native.experiment, able)
        yield outputs_finding(label, course, native.reference(names), limit)
        if course.events is not None:
            yield events_finding(label, course.events, native.events)
        elif len(native.events):
            before, after = native.sides(names)
            yield bisected_finding(subject, names, native.experiment, before, after, native.events)
    except FMUError as error:
        yield Finding(label, "run", False, told=str(error))
