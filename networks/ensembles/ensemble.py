"""`ensemble`: one model many times, side by side in the lanes of one processor, and on many."""

from __future__ import annotations

import time as clock
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING, Any, Never
from weakref import WeakKeyDictionary

import numpy as np

from ...base import (
    Array,
    ModelError,
    RunInterruptedError,
    SimulationError,
    boolean,
    check_keywords,
    demand,
    interruptible,
    listed,
    optional,
    whole,
)
from ..csource.crew import CrewProgram, crew_program
from ..csource.members import Integers, Members, Status, Told
from ..dae import DAE
from ..flattening.flat import Flat
from ..given import dae_of
from ..simulation.blame import with_remedies
from ..simulation.input_signals import SignalKey
from ..simulation.progress import Progress
from ..simulation.settings import ATOL, RTOL, Settings
from ..simulation.starting import Start
from ..sweeps.design import Design
from .blocks import Task
from .result import Ensemble
from .signals import Inputs, legs_of_members
from .starts import Starts
from .table import Columns, check_no_options, columns_of, member_count, spread

if TYPE_CHECKING:
    from ..network import Network

_PROGRAMS: WeakKeyDictionary[Flat, dict[Any, CrewProgram]] = WeakKeyDictionary()
UNFINISHED = "not done when the ensemble was interrupted"
MOST_PROGRAMS = 8  # of one network that are kept


def ensemble(
    network: Network | DAE,
    stop: float,
    *,
    signals: str | Iterable[str],
    parameters: Any = None,
    starts: Any = None,
    inputs: Any = None,
    begin: float = 0.0,
    step: float | None = None,
    rtol: float = RTOL,
    atol: float = ATOL,
    max_step: float = inf,
    executor: Any = None,
    workers: int | None = 0,
    progress: bool | None = None,
    **unknown: Never,
) -> Ensemble:
    """Run one network many times with different numbers, and return its signals as one array.

    Members run by solver "compiled", as many side by side as the processor's vectors hold (8 with AVX-512,
    else 4), each with steps, events and modes of its own, and within tolerance of what `simulate` computes
    one by one. Where a member ends, the next one takes its lane. The first ensemble of a network compiles it.

    Args:
        network: a `Network`, or its equations.
        stop: end time [s].
        signals: names of what is to be computed.
        parameters: changed parameters by name: a number, or an array with an entry for each member; also a
            table of pandas, or a `Design` of `inertance.sweeps`.
        starts: fixed start values by name, likewise.
        inputs: signals by name as for `simulate`, or a list (an array of numbers) with one for each member;
            these must be numbers or data, as formulas are compiled.
        begin: start time [s].
        step: output interval [s]; a 500th of the run if not given.
        rtol: relative tolerance.
        atol: absolute tolerance, times the nominal value of each state.
        max_step: longest step of the integrator [s].
        executor: what computes blocks of members: an executor of `concurrent.futures` with processes, a
            `dask.distributed.Client`, or None for processes of its own.
        workers: how many processes of its own; as many as there are processors if None, 0 for this one.
        progress: show progress; by default on ensembles that last over a second on a terminal.
        unknown: refused, with the nearest argument that there is.

    Raises:
        ModelError: for unknown names or arguments, values out of range by their members, lengths that differ,
            choices that shape the equations, and tolerances or steps that no run can keep to.
        ToolchainError: if there is no C compiler.
        SimulationError: if all members fail; if some do, that is told in `errors`, and their values are NaN
            from there. Its `result` is the ensemble.
        RunInterruptedError: on Ctrl-C; its `result` likewise.

    Limits: events at the start itself are not listed. Models with over 32 unknowns in the matrix of a step,
    or equations of over 3000 operations, run one by one.

    Example:
        >>> import numpy as np
        >>> from inertance import Damper, Fixed, Mass, Network, Spring, ensemble, parallel
        >>> strut = parallel(Spring(k=1.0), Damper(d=0.1))
        >>> net = Network("swing", wall=Fixed(), strut=strut, mass=Mass(m=1.0))
        >>> _ = net.connect(net.wall.flange, net.strut.flange_a)
        >>> _ = net.connect(net.strut.flange_b, net.mass.flange)
        >>> many = ensemble(
        ...     net, 10.0, signals="mass.s", starts={"mass.v": 1.0},
        ...     parameters={"strut.damper.d": np.array([0.1, 0.2, 0.4])},
        ... )
        >>> many["mass.s"].max(axis=1).round(2).tolist()
        [0.93, 0.86, 0.76]
    """
    check_keywords("ensemble()", unknown, ensemble)
    demand("ensemble()", workers=(workers, optional(whole(0))), progress=(progress, optional(boolean)))
    settings = Settings(begin, stop, step, rtol, atol, "compiled", progress, None, max_step)
    began, dae, names = clock.perf_counter(), dae_of(network), listed("signals", signals)
    if not names:
        raise ModelError("an ensemble computes signals that are named: signals=['mass.s']")
    for name in names:
        dae.expression(name)
    with interruptible():
        asked = _asked(dae, settings, names, parameters, starts, inputs)
        members, told = asked.members(), asked.task.blank(asked.count)
    show = Progress(dae.name, 0, asked.count, progress, "members")
    try:
        with show as bar:
            asked.run(members, told, executor, workers, bar)
    except KeyboardInterrupt:
        so_far = asked.result(told, clock.perf_counter() - began)
        text = f"'{dae.name}': interrupted: {so_far.done} of {asked.count} members are done"
        raise RunInterruptedError(f"{text}, and in the error's `result`", so_far) from None
    found = asked.result(told, clock.perf_counter() - began)
    if len(found.errors) == asked.count:
        first = next(iter(found.errors.values()))
        raise SimulationError(f"none of {asked.count} members could be run; the first: {first}", found)
    return found


def _asked(
    dae: DAE, settings: Settings, signals: tuple[str, ...], parameters: Any, starts: Any, inputs: Any
) -> _Asked:
    """Check what is given for members, and gather it."""
    changed, begun, fed = columns_of("parameters", parameters), columns_of("starts", starts), Inputs(inputs)
    check_no_options(dae, changed)
    lengths = {f"parameters '{name}'": len(values) for name, values in changed.items()}
    lengths |= {f"starts '{name}'": len(values) for name, values in begun.items()}
    count = member_count(lengths | fed.lengths)
    rows = dae.parameters.rows(spread(changed, count), count)
    varied = parameters if isinstance(parameters, Design) else changed
    return _Asked(dae, settings, signals, count, varied, rows, Starts(dae, spread(begun, count)), fed)


@dataclass(eq=False)
class _Asked:
    """What is asked of an ensemble."""

    dae: DAE
    settings: Settings
    signals: tuple[str, ...]
    count: int
    varied: Design | Columns
    parameters: Array
    starts: Starts
    inputs: Inputs

    def __post_init__(self) -> None:
        self.choices, self.chosen = self.inputs.choices(self.dae, self.settings, self.count)

    @cached_property
    def program(self) -> CrewProgram:
        """The program that all members share."""
        first, begin = self.choices[0], self.settings.begin
        start = self.starts.sought(first, self.parameters[0], begin)
        if start is None:
            nothing = np.zeros(0)
            start = Start(self.dae, nothing, nothing, nothing, nothing, [], [], [], [])
        known = _PROGRAMS.setdefault(self.dae.flat, {})
        key = SignalKey(first.formulas()), self.signals, self._form(start)
        if key not in known:
            known[key] = crew_program(self.dae, first.formulas(), self.signals, start)
            if len(known) > MOST_PROGRAMS:
                del known[next(iter(known))]
        return known[key]

    @staticmethod
    def _form(start: Start) -> tuple[Any, ...]:
        aims = tuple((aim.name, aim.fixed) for aim in start.aims)
        return aims, tuple(start.led), tuple(start.free), start.z.tobytes()

    @cached_property
    def task(self) -> Task:
        """What is done with members."""
        settings = self.settings
        return Task(self.program, settings.outputs, (settings.rtol, settings.atol))

    def members(self) -> Members:
        """Return what differs between members."""
        settings = self.settings
        legs, legs_of = legs_of_members(self.choices, self.chosen, self.parameters, settings)
        signals = [choice.data(self.program.free) for choice in self.choices]
        begun = self.starts.rows(self.choices, self.chosen, self.parameters, settings.begin)
        return Members(self.parameters, *begun, signals, legs, self.chosen, legs_of)

    def run(self, members: Members, told: Told, executor: Any, workers: int | None, bar: Progress) -> None:
        """Run all members."""
        if executor is None and workers == 0:
            with interruptible():
                self.task.run(members, told, bar.at)
        else:
            self.task.spread(members, told, executor, workers, bar.at)
        unstarted = np.flatnonzero(told.status == Status.UNSTARTED)
        if len(unstarted):
            with interruptible():
                self._run_otherwise_started(members, unstarted, told)

    def _run_otherwise_started(self, members: Members, places: Integers, told: Told) -> None:
        """Run those for which the program finds no start from where Python does, if it does."""
        found = dict[int, tuple[Array, Array]]()
        for member in places.tolist():
            closed = self.choices[self.chosen[member]].closed
            run = self.starts.found(member, closed, self.parameters[member], self.settings)
            if isinstance(run, str):
                told.messages[member] = run
            else:
                point = run.point
                found[member] = np.concatenate([point.x, point.z]), point.q[: self.dae.constants.numel()]
        if not found:
            return
        there = np.array([*found], dtype=np.int64)
        points, constants = map(np.array, zip(*found.values(), strict=True))
        again = self.task.blank(len(found))
        self.task.run(replace(members.some(there), found=(points, constants)), again)
        told.take_over(there, again)

    def result(self, told: Told, seconds: float) -> Ensemble:
        """Return what came of members so far."""
        open_ = np.flatnonzero(told.status == Status.WAITING).tolist()
        failed = {member: self._told(member, text) for member, text in told.messages.items()}
        errors = dict(sorted({**dict.fromkeys(open_, UNFINISHED), **failed}.items()))
        stats = {
            "members": self.count,
            "failed": len(errors),
            "lanes": told.lanes,
            "lane efficiency": told.tried / max(1, told.rounds * told.lanes),
            "steps": int(told.steps.sum()),
            "rejected": int(told.rejected.sum()),
            "seconds": seconds,
        }
        events = sorted(told.events, key=lambda what: what[:2])
        outputs = self.settings.outputs
        return Ensemble(self.dae, outputs, self.signals, told.values, errors, stats, events, self.varied)

    def _told(self, member: int, text: str) -> str:
        named = f"'{self.dae.name}': "
        return f"{named}member {member}: {with_remedies(self.dae, text.removeprefix(named))}"
