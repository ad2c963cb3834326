"""Jumps: what a network makes of signals that jump or bend while their derivatives are needed.

Index reduction differentiates what prescribes a motion. Where that jumps, its derivative has an impulse,
which the reduced equations do not hold. So each such signal is given a course: what is added to it and to
its derivatives while it jumps.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce
from typing import Any

import casadi as ca

from ...components.language import RealInput
from ..flattening.families import Family
from ..flattening.flat import Flat, Instance
from ..flattening.forms import Form
from ..flattening.vectors import column, pick, stacked
from .pantelides import Equation, System

MOTIONS = {"m", "m/s", "m/s2", "rad", "rad/s", "rad/s2"}
THROUGH_VARIABLES = ("flange.f", "flange.tau")


@dataclass(frozen=True, eq=False)
class Signal:
    """An input, or what an equation determines, with the derivatives of it that are needed.

    Attributes:
        name: what a message calls it.
        course: SX, what is added to it and each derivative while it jumps.
        reads: for it and each derivative, the variables that tell how far it jumps.
        signs: of an input and its derivatives, against the variables.
        missed: by how much an equation and its derivatives are not met, SX in all variables.
    """

    name: str
    course: Any
    reads: list[list[int]]
    signs: list[int]
    missed: Any = None


@dataclass(frozen=True, eq=False)
class PrescribedMotion:
    """A component that a signal moves, and the signal it takes."""

    component: str
    reference: str


@dataclass(frozen=True, eq=False)
class Jumps:
    """The equations of a network while signals jump.

    Attributes:
        signals: the signals.
        courses: SX vector of what is added to them.
        reads: the variables that tell how far they jump; `before` and `after` are their symbols.
        jump: by how much signals and derivatives jump, `size`: how large what they are told by is.
        watched: what tells when they jump, be it that the equations hold nothing but derivatives.
        ode: rates of the states; alg: residuals; forces: what motions exert on what they drive.
        motions: the components that exert them.
    """

    signals: list[Signal]
    courses: Any
    reads: list[int]
    before: Any
    after: Any
    jump: Any
    size: Any
    watched: Any
    ode: Any
    alg: Any
    forces: Any
    motions: list[PrescribedMotion]


def jumping_signals(system: System, values: Any) -> list[Signal]:
    """Return the signals that may jump though their derivatives are needed, and add courses to equations."""
    return [*_inputs(system), *_equations(system, values)]


def _inputs(system: System) -> list[Signal]:
    places: dict[str, list[tuple[int, int, int]]] = {}
    for number, (path, order, sign) in system.known.items():
        places.setdefault(path, []).append((order, number, sign))
    signals = []
    for path, found in sorted(places.items()):
        _, reads, signs = zip(*sorted(found), strict=True)
        if len(found) > 1:
            course = ca.SX.sym("jump", len(found))
            signals.append(Signal(f"input '{path}'", course, [[r] for r in reads], [*signs]))
    return signals


def _equations(system: System, values: Any) -> list[Signal]:
    """Return the signals of equations that are differentiated and in which modes or time stand."""
    signals = []
    added: dict[int, dict[int, Any]] = {}
    for number, family in enumerate(system.families):
        if system.level[number] or not system.next_level[number] or not _moved_from_outside(family.form):
            continue
        for row in sorted(system.next_level[number]):
            chain = _chain(system, number, row)
            course = ca.SX.sym("jump", len(chain))
            missed, reads = [], []
            for k, (n, r) in enumerate(chain):
                missed.append(system.residual((n, r), values))
                reads.append(sorted(set(system.families[n].columns[r].tolist())))
                added.setdefault(n, {})[r] = course[k]
            signals.append(Signal(family.label(row), course, reads, [1] * len(chain), column(missed)))
    for number, courses in added.items():
        system.families[number] = _with_courses(system.families[number], courses)
    return signals


def _moved_from_outside(form: Form) -> bool:
    return form.is_hybrid(form.residual) or bool(ca.depends_on(form.residual, form.time))


def _chain(system: System, number: int, row: int) -> list[Equation]:
    chain = [(number, row)]
    while (later := system.next_level[chain[-1][0]].get(chain[-1][1])) is not None:
        chain.append(later)
    return chain


def _with_courses(family: Family, courses: dict[int, Any]) -> Family:
    """Return a family to whose residuals courses are added."""
    form, course = family.form, ca.SX.sym("course")
    rows = ca.horzcat(*[courses.get(k, ca.SX(0)) for k in range(len(family))])
    moved = replace(form, residual=form.residual + course, given=ca.vertcat(form.given, course))
    return replace(family, form=moved, arguments=ca.vertcat(family.arguments, rows))


def jumps_of(
    system: System, signals: list[Signal], values: Any, symbols: Any, ode: Any, alg: Any
) -> Jumps | None:
    """Return the equations while signals jump, None if no signal moves anything by its derivatives.

    `values` is every variable in terms of states, inputs and courses, as are `ode` and `alg`.
    """
    if not signals:
        return None
    motions, through = _motions(system.flat)
    pushes = -pick(values, [root for root, _ in through]) * ca.DM([sign for _, sign in through])
    moving: Any = [ode, alg, pushes]
    inputs = [signal for signal in signals if signal.missed is None]
    if inputs:
        known = pick(symbols, [level[0] for signal in inputs for level in signal.reads])
        moving = ca.substitute(moving, [known], [known + ca.vertcat(*[s.course for s in inputs])])
    harmless = [s for s in signals if not ca.depends_on(ca.vertcat(*moving), s.course[1:])]
    signals = [s for s in signals if s not in harmless]
    if not signals:
        return None
    if harmless:
        still = ca.vertcat(*[s.course for s in harmless])
        moving = ca.substitute(moving, [still], [ca.SX.zeros(still.numel())])
    courses = ca.vertcat(*[signal.course for signal in signals])
    ode, alg, forces = moving
    pushed = sorted(set(ca.jacobian_sparsity(forces, courses).row()))
    chosen = [motions[k] for k in pushed]
    return Jumps(signals, courses, *_measured(signals, symbols), ode, alg, pick(forces, pushed), chosen)


def _measured(signals: list[Signal], symbols: Any) -> tuple[list[int], Any, Any, Any, Any, Any]:
    """Return how jumps are measured: `Jumps.reads` to `Jumps.watched`."""
    reads = sorted({v for signal in signals for level in signal.reads for v in level})
    place = {variable: k for k, variable in enumerate(reads)}
    before, after = ca.SX.sym("before", len(reads)), ca.SX.sym("after", len(reads))
    jumps, sizes = [], []
    for signal in signals:
        first = [place[level[0]] for level in signal.reads]
        missed = signal.missed
        jumps.append(pick(after, first) - pick(before, first) if missed is None else missed)
        for level in signal.reads:
            seen = [ca.fabs(part[place[v]]) for v in level for part in (before, after)]
            sizes.append(reduce(ca.fmax, seen))
    given = [v for signal in signals if signal.missed is None for [v] in signal.reads[:-1]]
    missed = column([signal.missed for signal in signals if signal.missed is not None])
    jump, missed = ca.substitute([ca.vertcat(*jumps), missed], [pick(symbols, reads)], [before])
    return reads, before, after, jump, column(sizes), stacked(pick(symbols, given), missed)


def _motions(flat: Flat) -> tuple[list[PrescribedMotion], list[tuple[int, int]]]:
    """Return the components that take a motion as a signal and drive one flange, and the force there."""
    motions, through = [], []
    for instance in flat.instances.values():
        reference = _reference(instance)
        name = next((name for name in THROUGH_VARIABLES if name in instance.template.place), None)
        if reference and name:
            motions.append(PrescribedMotion(str(instance), f"{instance.path}.{reference}"))
            through.append(flat.joined.find(instance.index(name)))
    return motions, through


def _reference(instance: Instance) -> str:
    fields = type(instance.component).fields.items()
    return next((n for n, f in fields if isinstance(f, RealInput) and f.unit in MOTIONS), "")
