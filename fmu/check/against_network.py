"""A network against its FMUs: the native run, and FMI 2.0 and 3.0, Model Exchange and Co-Simulation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from ...base import Array
from ...networks import DAE, Result, simulate
from ..errors import FMUError
from ..export.export import export_fmu
from . import agreement
from .agreement import Reference, sizes
from .derivatives import Derivatives
from .other_process import OtherProcess
from .probe import CheckedFMU
from .report import Finding
from .runs import DENSE_JACOBIAN_STATES, Scenario, communicate, exchange, sampled
from .states import state_findings
from .xml_schema import xml_findings

SAME_INSTANT = 0.1 * agreement.EVENT_TOLERANCE


def network_findings(
    dae: DAE,
    scenario: Scenario,
    start: Mapping[str, float],
    outputs: Iterable[str] | None,
    versions: Iterable[str],
    limit: float,
) -> Iterator[Finding]:
    """Yield what is found of a network's FMUs, version by version."""
    chosen = None if outputs is None else list(outputs)
    native = _NativeRun(dae, scenario, start, scenario.accurate)
    asked = _NativeRun(dae, scenario, start, scenario.rtol)
    with OtherProcess() as other:
        for k, version in enumerate(versions):
            with TemporaryDirectory(prefix="inertance-") as folder:
                path = export_fmu(
                    dae, Path(folder) / "checked.fmu", fmi_version=version, outputs=chosen, start=start,
                    stop=scenario.stop, step=scenario.step, tolerance=scenario.rtol, sources=version == "3.0",
                )  # fmt: skip
                yield from xml_findings(f"FMI {version}", path)
                with CheckedFMU(path) as fmu:
                    if k == 0:
                        yield _told(asked, native, fmu)
                        yield from agreement.motion_findings("native", native.reference(fmu, _sized(fmu)))
                    for kind in ("ME", "CS"):
                        yield from _run_findings(kind, fmu, native, limit)
                    for kind in ("ME", "CS"):
                        yield from state_findings(fmu, kind, scenario, other)


class _NativeRun:
    """A run of the network itself, which all kinds are compared with."""

    def __init__(self, dae: DAE, scenario: Scenario, start: Mapping[str, float], rtol: float) -> None:
        self.scenario, self.rtol = scenario, rtol
        self.run: Result = simulate(
            dae, scenario.stop, begin=scenario.begin, step=scenario.step, start=start,
            inputs=dict(scenario.inputs), rtol=rtol, atol=1e-2 * rtol, progress=False,
        )  # fmt: skip
        times = np.unique([event.time for event in self.run.events])
        times = times[times > scenario.begin + SAME_INSTANT]
        self.events = times[np.diff(times, prepend=-np.inf) > SAME_INSTANT]  # each once

    def reference(self, fmu: CheckedFMU, names: Sequence[str]) -> Reference:
        """Return the values of variables on the grid of output, and how large they get on the way."""
        table = self._table(names)
        course = sampled(names, self.run.time, [*table.T], self.scenario)
        return Reference(replace(course, events=self.events), sizes(table, fmu.nominals(names)))

    def sides(self, names: Sequence[str]) -> tuple[Array, Array]:
        """Return values right before and right after each event."""
        time = self.run.time
        places = np.abs(time[None, :] - self.events[:, None]) <= SAME_INSTANT
        first, last = places.argmax(axis=1), len(time) - 1 - places[:, ::-1].argmax(axis=1)
        table = self._table(names)
        return table[first], table[last]

    def _table(self, names: Sequence[str]) -> Array:
        columns = np.array([self.run[name] for name in names])
        return columns.reshape(len(names), len(self.run.time)).T


def _told(asked: _NativeRun, native: _NativeRun, fmu: CheckedFMU) -> Finding:
    """Tell how far the native run at the tolerance asked for is from the one that FMUs are compared with."""
    reference, course = (run.reference(fmu, _sized(fmu)) for run in (native, asked))
    found = agreement.outputs_finding("native", course.course, reference, np.inf)
    told = f"{found.told}; not judged, FMUs are compared with rtol {native.rtol:.0e}"
    return Finding("native", f"rtol {asked.rtol:.0e}", None, found.error, told=told)


def _sized(fmu: CheckedFMU) -> list[str]:
    """Return what is compared by size: outputs and states."""
    modes = set(fmu.discrete())
    return [name for name in fmu.shown() if name not in modes]


def _run_findings(kind: str, fmu: CheckedFMU, native: _NativeRun, limit: float) -> Iterator[Finding]:
    """Yield how a kind's outputs, modes, events and derivatives compare."""
    label, derivatives = fmu.label(kind), Derivatives(fmu)
    outputs, modes, states = _sized(fmu), fmu.discrete(), fmu.states
    rates = [f"der({name})" for name in states] if modes and len(states) <= DENSE_JACOBIAN_STATES else []
    moving = [*outputs, *rates]
    names = [*moving, *modes]
    try:
        if kind == "ME":
            course = exchange(fmu, names, native.scenario, derivatives)
        else:
            course = communicate(fmu, names, native.scenario)
        yield agreement.outputs_finding(label, course.of(outputs), native.reference(fmu, outputs), limit)
        if modes:
            pair = course.of(modes), native.reference(fmu, modes).course
            reference = native.reference(fmu, moving)
            yield agreement.modes_finding(label, pair, course.of(moving), reference, limit)
        if course.events is not None:
            yield agreement.events_finding(label, course.events, native.events)
        elif len(native.events):
            reference, sides = native.reference(fmu, names), native.sides(names)
            yield agreement.bisected_finding(fmu, native.scenario, reference, native.events, *sides)
        if kind == "ME":
            yield from derivatives.findings()
    except FMUError as error:
        yield Finding(label, "run", False, told=str(error))
