"""Runs without events: as few calls of the integrator as progress and the legs of the run allow."""

from __future__ import annotations

import numpy as np

from ...base import Array, SimulationError
from .integrator import Stepper
from .point import Point
from .progress import Progress
from .run import Run, enter_next_leg, integrate, record_here
from .sensitivity import Sensitivities

FEW_NODES, MOST_NODES = 64, 1024
MOST_STEPS = 20_000


def run_smooth(run: Run, outputs: Array, progress: Progress, follow: Sensitivities | None) -> None:
    """Integrate to the last output, in equal chunks if nothing that is given switches on the way."""
    (_in_chunks if len(run.legs) == 1 else _in_legs)(run, outputs, progress, follow)


def smooth_stepper(run: Run, outputs: Array) -> Stepper:
    """Return the integrator for a run that is one leg, or for the many outputs of a long one."""
    count = len(outputs) - 1
    chunks = -(-count // MOST_NODES)
    return _stepper(run, -(-count // chunks) if len(run.legs) == 1 else FEW_NODES)


def _stepper(run: Run, nodes: int) -> Stepper:
    return run.closed.stepper(run.settings.solver, run.settings.tolerance, nodes, MOST_STEPS)


def _in_chunks(run: Run, outputs: Array, progress: Progress, follow: Sensitivities | None) -> None:
    """Integrate in equal chunks; the last one starts early so that all outputs are nodes."""
    stepper = smooth_stepper(run, outputs)
    count, nodes = len(outputs) - 1, stepper.nodes
    span = (outputs[-1] - outputs[0]) / count * nodes
    done = 0
    while done < count:
        begin = min(done, count - nodes)
        _, x, z, _ = run.segments[-1].point(begin)
        start = Point(outputs[begin], x, z, run.point.q)
        if follow is not None:
            follow.advance(stepper, start, span, run.max_step, np.arange(nodes), begin)
        with progress.watching(stepper.now):
            stretch = integrate(run, stepper, start, span)
        new = slice(done - begin, nodes)
        run.record(outputs[done + 1 : begin + nodes + 1], stretch.states[new], stretch.algebraic[new])
        done = begin + nodes
        run.point = stretch.end(float(outputs[done]), run.point.q)
        progress.at(run.point.t)


def _in_legs(run: Run, outputs: Array, progress: Progress, follow: Sensitivities | None) -> None:
    """Integrate from instant to instant at which what is given switches.

    On the way 2^n outputs at once are nodes of a stretch. Where sensitivities are followed, every such
    instant is recorded.
    """
    done = 1
    while done < len(outputs):
        point = run.point
        if point.t >= run.leg.end:
            _enter_leg(run, follow is not None)
            if outputs[done] <= run.point.t:
                record_here(run)
                done += 1
            if follow is not None:
                record_here(run)
                follow.repeat(sum(map(len, run.segments)))
            continue
        ahead = int(np.searchsorted(outputs, run.leg.end, "right")) - done
        intervals = 2 ** (min(ahead, MOST_NODES).bit_length() - 1) if ahead > 0 else 0
        if outputs[done - 1] != point.t:
            intervals = min(intervals, 1)
        end = float(outputs[done + intervals - 1]) if intervals else run.leg.end
        stepper = _stepper(run, MOST_NODES if intervals > FEW_NODES else FEW_NODES)
        kept = np.arange(1, intervals + 1) * (stepper.nodes // max(1, intervals)) - 1
        if follow is not None:
            chosen = kept if intervals else np.array([stepper.nodes - 1])
            follow.advance(stepper, point, end - point.t, run.max_step, chosen)
        with progress.watching(stepper.now):
            stretch = integrate(run, stepper, point, end - point.t)
        if intervals:
            run.record(outputs[done : done + intervals], stretch.states[kept], stretch.algebraic[kept])
        done += intervals
        run.point = stretch.end(end, point.q)
        progress.at(end)


def _enter_leg(run: Run, followed: bool) -> None:
    """Go on to the next leg; where sensitivities are followed, nothing may jump there."""
    if followed:
        record_here(run)
    enter_next_leg(run)
    if followed and run.events:
        raise SimulationError(
            f"{run.events[0].component} jumps at t = {run.point.t:.9g} s, and sensitivities are not "
            "followed through its shock; give a ramp instead of the jump, or exact=False"
        )
