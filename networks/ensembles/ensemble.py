"""`ensemble`: one model many times, side by side in the lanes of one processor, and on many."""

from __future__ import annotations

import time as clock
from collections.abc import Iterable
from math import inf
from typing import TYPE_CHECKING, Any, Never

from ...base import (
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
from ..csource.members import Members, Told
from ..dae import DAE
from ..given import dae_of
from ..lanes.asked import Asked
from ..lanes.signals import Inputs
from ..lanes.starts import Starts
from ..lanes.table import Columns, check_no_options, columns_of, member_count
from ..lanes.table import spread as spread_out
from ..simulation.progress import Progress
from ..simulation.settings import ATOL, RTOL, Settings
from ..sweeps.design import Design
from .blocks import spread
from .result import Ensemble, ensemble_of

if TYPE_CHECKING:
    from ..network import Network


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
        executor: what computes blocks of members: an executor of `concurrent.futures` (threads serve as well
            as processes), a `dask.distributed.Client`, or None for processes of its own.
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
        asked, varied = _asked(dae, settings, names, parameters, starts, inputs)
        members, told = asked.members(), asked.task.blank(asked.count)
    show = Progress(dae.name, 0, asked.count, progress, "members")

    def so_far() -> Ensemble:
        return ensemble_of(asked, varied, told, clock.perf_counter() - began)

    def go(members: Members, told: Told) -> None:
        if executor is None and workers == 0:
            with interruptible():
                asked.task.run(members, told, bar.at)
        else:
            spread(asked.task, members, told, executor, workers, bar.at)

    try:
        with show as bar:
            asked.run(members, told, go)
    except KeyboardInterrupt:
        kept = so_far()
        text = f"'{dae.name}': interrupted: {kept.done} of {asked.count} members are done"
        raise RunInterruptedError(f"{text}, and in the error's `result`", kept) from None
    found = so_far()
    if len(found.errors) == asked.count:
        first = next(iter(found.errors.values()))
        raise SimulationError(f"none of {asked.count} members could be run; the first: {first}", found)
    return found


def _asked(
    dae: DAE, settings: Settings, signals: tuple[str, ...], parameters: Any, starts: Any, inputs: Any
) -> tuple[Asked, Design | Columns]:
    """Check what is given for members, and gather it; return with it what is varied."""
    design = parameters if isinstance(parameters, Design) else None
    if design is not None:
        parameters = dict(zip(design.names, zip(*design.points, strict=True), strict=True))
    changed, begun, fed = columns_of("parameters", parameters), columns_of("starts", starts), Inputs(inputs)
    check_no_options(dae, changed)
    lengths = {f"parameters '{name}'": len(values) for name, values in changed.items()}
    lengths |= {f"starts '{name}'": len(values) for name, values in begun.items()}
    count = member_count(lengths | fed.lengths)
    rows = dae.parameters.rows(spread_out(changed, count), count)
    asked = Asked(dae, settings, signals, count, rows, Starts(dae, spread_out(begun, count)), fed)
    return asked, design or changed
