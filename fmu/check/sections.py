"""Sections: what is looked at in an FMU, one after another, each on its own feet."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..errors import FMUError
from ..fmu import FMU
from .agreement import Reference, motion_findings, outputs_finding
from .derivatives import Derivatives
from .other_process import OtherProcess
from .probe import CheckedFMU
from .report import Finding
from .runs import Course, Scenario, communicate, exchange
from .states import state_findings
from .xml_schema import xml_findings


@dataclass(frozen=True)
class Plan:
    """What a check of a file does: the scenario, as far as it is given, and what may differ."""

    stop: float | None
    step: float | None
    rtol: float
    limit: float
    inputs: dict[str, float]

    def scenario(self, fmu: FMU) -> Scenario:
        """Return what is run, filled up with what the FMU suggests."""
        begin = fmu.defaults.get("start", 0.0)
        stop = fmu.defaults.get("stop", begin + 1.0) if self.stop is None else self.stop
        suggested = fmu.defaults.get("step", 0.0)
        step = suggested if suggested > 0 and (stop - begin) / suggested <= 5000 else (stop - begin) / 500
        return Scenario(begin, stop, self.step or step, self.rtol, self.inputs)


Section = Callable[[CheckedFMU, Plan], Iterator[Finding]]


def runs(fmu: CheckedFMU, plan: Plan) -> Iterator[Finding]:
    """Yield whether each kind runs, whether they agree, and what its derivatives are worth."""
    scenario, names = plan.scenario(fmu), fmu.shown()
    references: dict[str, Reference] = {}
    looks: list[Derivatives] = []
    if not fmu.kinds:
        yield Finding("FMU", "run", None, told="it is neither for Model Exchange nor for Co-Simulation")
    for kind in fmu.kinds:
        label = fmu.label(kind)
        try:
            if kind == "ME":
                looks.append(Derivatives(fmu))
                course = exchange(fmu, names, scenario, looks[-1])
            else:
                course = communicate(fmu, names, scenario)
        except FMUError as error:
            yield Finding(label, "run", False, told=str(error))
            continue
        yield _finite(label, course, scenario.stop)
        references[kind] = Reference.of(course, fmu.nominals(names))
        yield from motion_findings(label, references[kind])
    if len(references) == 2:
        yield _agreement(fmu, references["ME"].course, references["CS"].course, scenario, plan.limit)
    for derivatives in looks:
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


def _agreement(
    fmu: CheckedFMU, exchanged: Course, communicated: Course, scenario: Scenario, limit: float
) -> Finding:
    """Hold Co-Simulation against Model Exchange, as far as both went."""
    label, ends = fmu.label("CS"), (exchanged.time[-1], communicated.time[-1])
    if max(ends) - min(ends) > 1.5 * scenario.step:
        told = f"ME ends at {ends[0]:.6g} s, CS at {ends[1]:.6g} s"
        return Finding(label, "outputs against ME", False, told=told)
    before = 0.5 * scenario.step if min(ends) < scenario.stop * (1 - 1e-9) else 0.0
    reference = Reference.of(exchanged.until(min(ends) - before), fmu.nominals(exchanged.names))
    found = outputs_finding(label, communicated.until(min(ends) - before), reference, limit)
    return replace(found, check="outputs against ME")


def states(kind: str, fmu: CheckedFMU, plan: Plan) -> Iterator[Finding]:
    """Yield what is found about states and instances of a kind."""
    if kind in fmu.kinds:
        with OtherProcess() as other:
            yield from state_findings(fmu, kind, plan.scenario(fmu), other)


SECTIONS: dict[str, Section] = {
    "description": lambda fmu, _: xml_findings(f"FMI {fmu.version}", fmu.path),
    "runs": runs,
    "states and instances of ME": partial(states, "ME"),
    "states and instances of CS": partial(states, "CS"),
}
