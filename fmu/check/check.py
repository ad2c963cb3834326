"""Check: a network against its FMUs, or an FMU against what its standard and itself promise."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from ...base import ModelError, above, boolean, demand, named, nearest, number, optional
from ...networks import DAE, Network, dae_of
from ..export.export import VERSIONS
from ..fmu import FMU
from .against_network import network_findings
from .isolated import isolated_findings
from .probe import CheckedFMU
from .report import CheckReport, Finding
from .runs import Scenario
from .sections import SECTIONS, Plan

FILE_LIMIT = 1e-2


def check_fmu(
    model: Network | DAE | str | Path,
    stop: float | None = None,
    *,
    step: float | None = None,
    tolerance: float = 1e-6,
    start: Mapping[str, float] | None = None,
    inputs: Mapping[str, float] | None = None,
    outputs: Iterable[str] | None = None,
    versions: Iterable[str] = VERSIONS,
    limit: float | None = None,
    isolated: bool = True,
    timeout: float = 300.0,
    found: Callable[[Finding], object] | None = None,
) -> CheckReport:
    """Check that FMUs do what they should.

    A network is exported, FMI 2.0 and 3.0, and each run as Model Exchange and as Co-Simulation through FMPy,
    against the native run: all outputs, states and modes, and the instants of events, to 1e-6 s. Any .fmu
    file is held against itself: Model Exchange against Co-Simulation. Both are validated; derivatives are
    compared with differences, to 1e-6, in every mode of the run; states are saved and restored, here and in
    another process; instances are reset, repeated, made a hundred at once and run in two threads, all equal
    to the last bit.

    Args:
        model: a network, its equations, or the path of an .fmu file.
        stop: end of the run [s]; 1 s, or what the FMU suggests.
        step: output interval and communication step [s]; a 500th of the run, or what the FMU suggests.
        tolerance: relative tolerance asked of Co-Simulation. Integrators that are not the FMU's, of the
            native run and under Model Exchange, get a hundred-thousandth of it and less, down to 1e-12, so
            that their errors do not count; the report says which got what.
        start: fixed start values of a network, as for `simulate`.
        inputs: constant values of inputs, 0 if not given.
        outputs: of a network, as for `export_fmu`.
        versions: which of FMI "2.0" and "3.0" a network is exported as.
        limit: how far variables may differ, as a share of their size; 10 tolerances for a network, 0.01
            for a file.
        isolated: run the binary of a file in a process of its own, so that a crash is a finding.
        timeout: longest time of each of the four sections of a check of a file, if isolated [s].
        found: called with every finding as soon as it is made.

    Raises:
        ModelError: for unknown names and numbers out of range.
        FMUError: for a file that is no FMU.

    Example:
        >>> from inertance import Fixed, Mass, Network, Spring
        >>> from inertance.fmu import check_fmu
        >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0, s=0.1))
        >>> net = net.connect(net.wall.flange, net.spring.flange_a)
        >>> net = net.connect(net.spring.flange_b, net.mass.flange)
        >>> check_fmu(net, 1.0, versions=["3.0"]).passed  # doctest: +SKIP
        True
    """
    _check_numbers(stop, step, tolerance, limit)
    demand("check_fmu()", isolated=(isolated, boolean), timeout=(timeout, above(0, "s")))
    if isinstance(model, str | Path):
        fmu = FMU(model, validate=False)
        plan = Plan(stop, step, tolerance, limit or FILE_LIMIT, named("inputs", inputs))
        for name in plan.inputs:
            fmu.variable(name, fmu.inputs)
        report = CheckReport(fmu.name)
        findings = isolated_findings(fmu.path, plan, timeout) if isolated else _here(fmu.path, plan)
    else:
        dae = dae_of(model)
        end = 1.0 if stop is None else stop
        scenario = Scenario(0.0, end, step or end / 500, tolerance, _inputs(dae, inputs or {}))
        report, chosen = CheckReport(dae.name), _versions(versions)
        findings = network_findings(dae, scenario, start or {}, outputs, chosen, limit or 10 * tolerance)
    for finding in findings:
        report.findings.append(finding)
        if found is not None:
            found(finding)
    return report


def _here(path: Path, plan: Plan) -> Iterator[Finding]:
    with CheckedFMU(path) as fmu:
        for section in SECTIONS.values():
            yield from section(fmu, plan)


def _check_numbers(stop: float | None, step: float | None, tolerance: float, limit: float | None) -> None:
    given = {"stop": (stop, 1e-6, " s"), "step": (step, 1e-9, " s"), "limit": (limit, 1e-16, "")}
    numbers = {name: (value, optional(number)) for name, (value, _, _) in given.items()}
    demand("check_fmu()", tolerance=(tolerance, number), **numbers)
    problems = [
        f"{name} must be finite and at least {least:g}{unit}, got {value:g}{unit}"
        for name, (value, least, unit) in given.items()
        if value is not None and not least <= value < math.inf
    ]
    if not 1e-9 <= tolerance < 1:
        problems.append(f"tolerance must lie between 1e-9 and 1, got {tolerance:g}")
    if problems:
        raise ModelError("this cannot be checked:", problems)


def _versions(versions: Iterable[str]) -> list[str]:
    chosen = [versions] if isinstance(versions, str) else list(versions)
    unknown = [v for v in chosen if v not in VERSIONS]
    if unknown or not chosen:
        raise ModelError(f"versions are of {', '.join(VERSIONS)}, got {chosen}")
    return chosen


def _inputs(dae: DAE, inputs: Mapping[str, float]) -> dict[str, float]:
    """Return the values of all free inputs."""
    free = [i.path for i in dae.inputs if i.signal is None and i.order == 0]
    unknown = [f"there is no free input '{name}'{nearest(name, free)}" for name in inputs if name not in free]
    if unknown:
        raise ModelError(f"'{dae.name}':", unknown)
    return {name: float(inputs.get(name, 0.0)) for name in free}
