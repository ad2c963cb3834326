"""A network against its FMUs: the native run, and FMI 2.0 and 3.0, Model Exchange and Co-Simulation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from ...base import Array
from ...networks import DAE, Result, simulate
from ..errors import FMUError
from ..export.export import export_fmu
from .agreement import (
    EVENTS,
    Reference,
    bisected_finding,
    events_finding,
    modes_finding,
    motion_findings,
    outputs_finding,
)
from .derivatives import Derivatives
from .probe import Subject
from .report import Finding
from .runs import DENSE, Course, Experiment, communicate, exchange
from .sections import sizes
from .states import state_findings
from .xml_schema import xml_findings

SAME_INSTANT = 0.1 * EVENTS


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
    asked: _Native | None = _Native(dae, experiment, start, experiment.rtol)
    for version in versions:
        with TemporaryDirectory(prefix="inertance-") as folder:
            path = export_fmu(
                dae, Path(folder) / "checked.fmu", fmi_version=version, outputs=chosen, start=start,
                stop=experiment.stop, step=experiment.step, tolerance=experiment.rtol,
                sources=version == "3.0",
            )  # fmt: skip
            yield from xml_findings(f"FMI {version}", path)
            with Subject(path) as subject:
                if asked is not None:
                    yield _told(asked, native, subject)
                    yield from motion_findings(
                        "native", native.course(_names(subject)), native.sizes(subject)
                    )
                    asked = None
                yield from _exchanged(subject, native, limit)
                yield from _communicated(subject, native, limit)
                for kind in ("ME", "CS"):
                    yield from state_findings(subject, kind, experiment)


class _Native:
    """The native run, which all kinds are compared with."""

    def __init__(
        self, dae: DAE, experiment: Experiment, start: Mapping[str, float], rtol: float | None = None
    ) -> None:
        self.experiment, self.rtol = experiment, experiment.accurate if rtol is None else rtol
        self.run: Result = simulate(
            dae, experiment.stop, begin=experiment.begin, step=experiment.step, start=start,
            inputs=dict(experiment.inputs), rtol=self.rtol, atol=1e-2 * self.rtol, progress=False,
        )  # fmt: skip

    def reference(self, names: list[str], nominals: Array) -> Reference:
        """Return the values of variables on the grid of output, and how large they get."""
        largest = sizes(self._table(names), nominals)
        return Reference(self.course(names), largest)

    def sizes(self, subject: Subject) -> Array:
        """Return how large outputs and states are."""
        names = _names(subject)
        return sizes(self._table(names), subject.nominals(names))

    def course(self, names: list[str]) -> Course:
        """Return the values of variables on the grid of output."""
        grid = self.experiment.grid
        near = np.searchsorted(self.run.time, grid + 1e-9 * self.experiment.step, side="right") - 1
        return Course(names, grid, self._table(names)[near], self.events)

    def _table(self, names: list[str]) -> Array:
        columns = [self.run[name] for name in names]
        return np.column_stack(columns) if columns else np.zeros((len(self.run.time), 0))

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
        table = self._table(names)
        return table[first], table[last]


def _told(asked: _Native, native: _Native, subject: Subject) -> Finding:
    """Tell how far the native run at the tolerance asked for is from the one that FMUs are compared with."""
    names = _names(subject)
    reference = native.reference(names, subject.nominals(names))
    found = outputs_finding("native", asked.course(names), reference, np.inf)
    told = f"{found.told}; not judged, FMUs are compared with rtol {native.rtol:.0e}"
    return Finding("native", f"rtol {asked.rtol:.0e}", None, found.error, told=told)


def _names(subject: Subject) -> list[str]:
    """Return what is compared by size: outputs and states."""
    modes = set(subject.discrete())
    return [name for name in subject.shown() if name not in modes]


def _rates(subject: Subject) -> list[str]:
    """Return the rates of states, unless there are very many."""
    states = subject.fmu.states
    return [f"der({name})" for name in states] if subject.discrete() and len(states) <= DENSE else []


def _all(subject: Subject) -> list[str]:
    return [*_names(subject), *_rates(subject), *subject.discrete()]


def _exchanged(subject: Subject, native: _Native, limit: float) -> Iterator[Finding]:
    label = subject.label("ME")
    derivatives = Derivatives(subject)
    try:
        course = exchange(subject, _all(subject), native.experiment, derivatives)
    except FMUError as error:
        yield Finding(label, "run", False, told=str(error))
        return
    yield from _compared(label, subject, course, native, limit)
    yield from derivatives.findings()


def _communicated(subject: Subject, native: _Native, limit: float) -> Iterator[Finding]:
    label, names = subject.label("CS"), _all(subject)
    able = subject.fmu.capable("CS", "hasEventMode")
    try:
        course = communicate(subject, names, native.experiment, able)
        yield from _compared(label, subject, course, native, limit)
        if course.events is None and len(native.events):
            reference = native.reference(names, subject.nominals(names))
            yield bisected_finding(subject, native.experiment, reference, *native.sides(names))
    except FMUError as error:
        yield Finding(label, "run", False, told=str(error))


def _compared(
    label: str, subject: Subject, course: Course, native: _Native, limit: float
) -> Iterator[Finding]:
    yield outputs_finding(label, *_against(subject, course, native, _names(subject)), limit)
    modes = subject.discrete()
    if modes:
        whole = _against(subject, course, native, [*_names(subject), *_rates(subject)])
        yield modes_finding(label, (course.of(modes), native.course(modes)), *whole, limit)
    if course.events is not None:
        yield events_finding(label, course.events, native.events)


def _against(subject: Subject, course: Course, native: _Native, names: list[str]) -> tuple[Course, Reference]:
    return course.of(names), native.reference(names, subject.nominals(names))
