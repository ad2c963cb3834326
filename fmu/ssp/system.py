"""System structures: several FMUs with their connections, as a file of the SSP standard."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ...base import Unit
from ...components import nearest
from ..cosimulation.adaptive_master import AdaptiveMaster
from ..cosimulation.jacobi_master import JacobiMaster, Link
from ..cosimulation.participants import CommunicationPoints, Member, Signal
from ..cosimulation.step_error import compare
from ..errors import FMUError
from ..fmu import FMU
from ..foreign.variable import ForeignVariable
from .run import SystemRun

FINEST_TOLERANCE, COARSEST_TOLERANCE = 1e-8, 0.1
LONGEST_STEPS = 20  # at least, in a run that keeps a tolerance


@dataclass(frozen=True)
class Connection:
    """An output that goes to an input, each as "component.variable".

    input = factor * output + offset, in the unit of the input, into which the output is converted first
    (SSP's LinearTransformation); `convert=False` suppresses the conversion.
    """

    start: str
    end: str
    factor: float = 1.0
    offset: float = 0.0
    convert: bool = True


@dataclass(eq=False)
class SystemStructure:
    """Several FMUs and what joins them; runs them, and is written to and read from .ssp files.

    Attributes:
        name: of the system.
        components: FMUs by name; the names have no dot.
        connections: from outputs to inputs.
        parameters: values by component and name, in the FMU's unit or as (value, unit): parameters, start
            values, and constant values of inputs that nothing is connected to.
        begin, stop: the default experiment [s].

    Example:
        >>> from inertance.fmu import SystemStructure, read_ssp
        >>> system = read_ssp("quarter_car.ssp")                  # doctest: +SKIP
        >>> run = system.simulate(2.0, communication_step=1e-3)   # doctest: +SKIP
        >>> run["body.body.s"], run.step_error                    # doctest: +SKIP
    """

    name: str
    components: dict[str, FMU]
    connections: list[Connection] = field(default_factory=list)
    parameters: dict[str, dict[str, Any]] = field(default_factory=dict)
    begin: float = 0.0
    stop: float = 1.0

    def variable(self, path: str) -> tuple[str, ForeignVariable]:
        """Return component and variable of a path.

        Raises:
            FMUError: for an unknown one, with the nearest name.
        """
        component, _, name = path.partition(".")
        if component not in self.components:
            known = nearest(component, self.components)
            raise FMUError(f"system '{self.name}' has no component '{component}' ('{path}'){known}")
        return component, self.components[component].variable(name)

    def check(self) -> None:
        """Refuse what cannot run.

        Raises:
            FMUError: for unknown components and variables, two connections to one input, wrong directions,
                types and units; all are told.
        """
        problems = [
            f"a component cannot be called '{name}'; its name is part of paths and has none of . / : \\"
            for name in self.components
            if not name or set(name) & set("./:\\\0")
        ]
        problems += [p for connection in self.connections for p in self._problems(connection)]
        ends = [connection.end for connection in self.connections]
        problems += [
            f"'{end}' is the end of two connections" for end in sorted({e for e in ends if ends.count(e) > 1})
        ]
        for component, values in self.parameters.items():
            for path in (f"{component}.{name}" for name in values):
                problems += self._unknown(path) or [f"'{path}' is connected and set"] * (path in ends)
        if problems:
            raise FMUError("\n  - ".join([f"system '{self.name}' cannot be:", *problems]))

    def _unknown(self, path: str) -> list[str]:
        try:
            self.variable(path)
        except FMUError as error:
            return [str(error)]
        return []

    def _problems(self, connection: Connection) -> list[str]:
        unknown = self._unknown(connection.start) + self._unknown(connection.end)
        if unknown:
            return unknown
        source, target = (self.variable(path)[1] for path in (connection.start, connection.end))
        told = f"'{connection.start}' to '{connection.end}'"
        if source.causality != "output" or target.causality != "input":
            return [f"{told}: goes from {source.causality} to {target.causality}, not from output to input"]
        if not (source.real and target.real) or source.size * target.size != 1:
            return [f"{told}: only single real numbers are exchanged, got {source.type} to {target.type}"]
        units = self._units(connection)
        if units and not units[0].fits(units[1]):
            return [f"{told}: {source.unit} does not convert to {target.unit}"]
        return []

    def _units(self, connection: Connection) -> list[Unit]:
        """Return the units from which and to which a connection converts, none if it does not."""
        ends = [self.variable(path) for path in (connection.start, connection.end)]
        if not connection.convert or not all(variable.unit for _, variable in ends):
            return []
        return [self.components[name].measure(variable) for name, variable in ends]

    def free_inputs(self) -> list[str]:
        """Return the inputs that nothing is connected to."""
        ends = {connection.end for connection in self.connections}
        every = [f"{name}.{i}" for name, fmu in self.components.items() for i in fmu.inputs]
        return [path for path in every if path not in ends]

    def write(self, path: str | Path, *, groups: Mapping[str, Iterable[str]] | None = None) -> Path:
        """Write an .ssp file (SSP 1.0) with the FMUs inside.

        Inputs that nothing is connected to become inputs of the system, called "component:variable".

        Args:
            path: of the file.
            groups: components that stand in a system inside the system, by its name, or its path, as
                `{"chassis.axle": ["wheel"]}`. A component that is called after its system, "axle_wheel", has
                the rest as its name there.

        Raises:
            FMUError: if the system cannot be.
            ModelError: if the file cannot be written.
        """
        from .write import write_ssp

        self.check()
        return write_ssp(self, Path(path), groups or {})

    def simulate(
        self,
        stop: float | None = None,
        *,
        communication_step: float | None = None,
        tolerance: float | None = None,
        order: int = 1,
        halving: bool = True,
        inputs: Mapping[str, Any] | None = None,
        kind: str = "CS",
        rtol: float = 1e-6,
    ) -> SystemRun:
        """Run the system: all FMUs advance side by side over the same communication step (Jacobi).

        What an FMU takes is extrapolated from the last exchanges: held (order 0: the error falls with the
        step) or along the line through two (order 1: with its square). An FMI 2 FMU that interpolates gets
        the slope; another Co-Simulation FMU the mean over the step, held; an input x whose derivative
        der(x) is an input, too, follows that. Events that end a step early end it for all.

        Args:
            stop: end time [s]; that of the default experiment if not given.
            communication_step: time between exchanges [s]; with a tolerance the longest, a twentieth of the
                run if not given.
            tolerance: error asked for, as a share of how far each signal goes: steps are then as long as that
                allows, and each is made once whole and once in halves. FMUs must save their states.
                `step_error` has the sum of what all steps were estimated to add, and `stats` what it cost.
            order: of the extrapolation, 0 or 1.
            halving: without a tolerance, run again with half the step, to tell what the step costs
                (`step_error`).
            inputs: numbers or functions of time by "component.input", for inputs without connection.
            kind: "CS" or "ME", where an FMU has both.
            rtol: relative tolerance of the FMUs; with a tolerance it is a thousandth of that.

        Raises:
            FMUError: if the system cannot be, an FMU fails, or half the step makes another run of it.
        """
        self.check()
        stop = self.stop if stop is None else stop
        span = stop - self.begin
        if communication_step is None and tolerance is None:
            raise FMUError(f"system '{self.name}' needs a communication_step [s] or a tolerance to run")
        if tolerance is not None and not FINEST_TOLERANCE <= tolerance <= COARSEST_TOLERANCE:
            told = f"between {FINEST_TOLERANCE:g} and {COARSEST_TOLERANCE:g}"
            raise FMUError(f"system '{self.name}': tolerance must lie {told}, got {tolerance}")
        step = span / LONGEST_STEPS if communication_step is None else communication_step
        if not 0 < step <= span < np.inf or order not in (0, 1):
            raise FMUError(
                f"system '{self.name}' cannot run from {self.begin:g} s to {stop:g} s with "
                f"communication_step={step:g} and order={order} (0 or 1)"
            )
        members = self._members(dict(inputs or {}), kind)
        links = [self._link(connection) for connection in self.connections]

        def run(points: CommunicationPoints) -> SystemRun:
            master = JacobiMaster(members, links, points, rtol)
            fmus = master.march()
            return SystemRun(fmus, points.step, order, self.name, notes=master.notes, stats=master.stats)

        points = CommunicationPoints(self.begin, stop, step, order)
        if tolerance is not None:
            return self._kept(AdaptiveMaster(members, links, points, tolerance))
        result = run(points)
        if halving:
            compare(result, run(points.halved), [connection.start for connection in self.connections])
        return result

    def _kept(self, master: AdaptiveMaster) -> SystemRun:
        """Return a run that keeps a tolerance, with what its steps were estimated to add."""
        points, fmus = master.points, master.march()
        run = SystemRun(fmus, points.step, points.order, self.name, notes=master.notes, stats=master.stats)
        for connection, cost in zip(self.connections, master.costs.tolist(), strict=True):
            factor = abs(self._link(connection).factor)
            run.step_error[connection.start] = cost / factor if factor else 0.0
        return run

    def _members(self, inputs: dict[str, Any], kind: str) -> dict[str, Member]:
        free = self.free_inputs()
        for path in inputs:
            if path not in free:
                raise FMUError(f"system '{self.name}' has no free input '{path}'{nearest(path, free)}")
        found = {}
        for name, fmu in self.components.items():
            given = self.parameters.get(name, {})
            signals = {n: fmu.converted(fmu.variables[n], v) for n, v in given.items() if n in fmu.inputs}
            signals |= {p.removeprefix(f"{name}."): s for p, s in inputs.items() if p.startswith(f"{name}.")}
            found[name] = Member(
                fmu, kind if kind in fmu.kinds else fmu.kind(),
                {n: v for n, v in given.items() if n in fmu.parameters},
                {n: v for n, v in given.items() if n not in fmu.parameters and n not in fmu.inputs},
                {n: _signal(s) for n, s in signals.items()},
            )  # fmt: skip
        return found

    def _link(self, connection: Connection) -> Link:
        (a, source), (b, target) = self.variable(connection.start), self.variable(connection.end)
        factor, offset = connection.factor, connection.offset
        if units := self._units(connection):
            zero, one = (units[1].from_si(units[0].to_si(value)) for value in (0.0, 1.0))
            factor, offset = factor * (one - zero), offset + factor * zero
        return Link((a, source.name), (b, target.name), factor, offset)


def _signal(given: float | Signal) -> Signal:
    if callable(given):
        return given
    value = float(given)
    return lambda t: value
