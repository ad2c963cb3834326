"""Sections: what is looked at in an FMU, one after another, each on its own feet."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ..errors import FMUError
from ..fmu import FMU
from .agreement import Reference, motion_findings, outputs_finding
from .derivatives import Derivatives
from .probe import Subject
from .report import Finding
from .runs import Course, Experiment, communicate, exchange
from .states import state_findings
from .xml_schema import xml_findings


@dataclass(frozen=True)
class Plan:
    """What a check of a file does: the experiment, as far as it is given, and what may differ."""

    stop: float | None
    step: float | None
    rtol: float
    limit: float
    inputs: dict[str, float]

    def experiment(self, fmu: FMU) -> Experiment:
        """Return the experiment, filled up with what the FMU suggests."""
        begin = fmu.defaults.get("start", 0.0)
        stop = fmu.defaults.get("stop", begin + 1.0) if self.stop is None else self.stop
        suggested = fmu.defaults.get("step", 0.0)
        step = suggested if suggested > 0 and (stop - begin) / suggested <= 5000 else (stop - begin) / 500
        return Experiment(begin, stop, self.step or step, self.rtol, self.inputs)


Section = Callable[[Subject, Plan], Iterator[Finding]]


def description(subject: Subject, plan: Plan) -> Iterator[Finding]:
    """Yield what is found in the files that describe the FMU."""
    yield from xml_findings(f"FMI {subject.fmu.version}", subject.fmu.path)


def runs(subject: Subject, plan: Plan) -> Iterator[Finding]:
    """Yield whether each kind runs, whether they agree, and what its derivatives are worth."""
    experiment, names = plan.experiment(subject.fmu), subject.shown()
    courses: dict[str, Course] = {}
    if not subject.fmu.kinds:
        yield Finding("FMU", "run", None, told="it is neither for Model Exchange nor for Co-Simulation")
    derivatives = Derivatives(subject) if "ME" in subject.fmu.kinds else None
    for kind in subject.fmu.kinds:
        label = subject.label(kind)
        try:
            if kind == "ME":
                courses[kind] = exchange(subject, names, experiment, derivatives)
            else:
                able = subject.fmu.capable("CS", "hasEventMode")
                courses[kind] = communicate(subject, names, experiment, able)
        except FMUError as error:
            yield Finding(label, "run", False, told=str(error))
            continue
        yield _finite(label, courses[kind], experiment.stop)
        size = sizes(courses[kind].values, subject.nominals(names))
        yield from motion_findings(label, courses[kind], size)
    if len(courses) == 2:
        ends = [course.time[-1] for course in courses.values()]
        before = 0.5 * experiment.step if min(ends) < experiment.stop * (1 - 1e-9) else 0.0
        exchanged, communicated = (courses[kind].until(min(ends) - before) for kind in ("ME", "CS"))
        reference = Reference(exchanged, sizes(exchanged.values, subject.nominals(names)))
        found = outputs_finding(subject.label("CS"), communicated, reference, plan.limit)
        if max(ends) - min(ends) > 1.5 * experiment.step:
            told = f"ME ends at {courses['ME'].time[-1]:.6g} s, CS at {courses['CS'].time[-1]:.6g} s"
            found = Finding(subject.label("CS"), "outputs against ME", False, told=told)
        yield replace(found, check="outputs against ME")
    if derivatives is not None:
        yield from derivatives.findings()


def _finite(label: str, course: Course, stop: float) -> Finding:
    bad = ~np.isfinite(course.values)
    if bad.any():
        row, column = np.argwhere(bad)[0]
        told = f"{course.names[column]} is {course.values[row, column]} at {course.time[row]:.6g} s"
        return Finding(label, "run", False, told=told)
    events = "" if course.events is None else f", {len(course.events)} events"
    ended = ", where the FMU ended it" if course.time[-1] < stop * (1 - 1e-9) else ""
    return Finding(label, "run", True, told=f"to {course.time[-1]:g} s{ended}, by {course.solver}{events}")


def states_of(kind: str) -> Section:
    """Return the section about states and instances of a kind."""

    def section(subject: Subject, plan: Plan) -> Iterator[Finding]:
        if kind in subject.fmu.kinds:
            yield from state_findings(subject, kind, plan.experiment(subject.fmu))

    return section


SECTIONS: dict[str, Section] = {
    "description": description,
    "runs": runs,
    "states and instances of ME": states_of("ME"),
    "states and instances of CS": states_of("CS"),
}


def sizes(values: Array, nominals: Array) -> Array:
    """Return how large each variable gets, at least a ten-thousandth of what is nominal."""
    found: Array = np.maximum(np.abs(values).max(axis=0, initial=0.0), 1e-4 * nominals)
    return found
