"""Runs without events: as few calls of the integrator as progress allows."""

from __future__ import annotations

from .point import Point
from .progress import Progress
from .run import Run, integrate
from .sensitivity import Sensitivities
from .stepper import Array, Stepper

MOST_NODES = 1024
MOST_STEPS = 20_000


def smooth_pieces(outputs: int) -> tuple[int, int]:
    """Return how many outputs one call covers, so that calls are equal, and the most steps for each."""
    chunks = -(-outputs // MOST_NODES)
    return -(-outputs // chunks), MOST_STEPS


def run_smooth(
    run: Run, stepper: Stepper, outputs: Array, progress: Progress, follow: Sensitivities | None
) -> None:
    """Integrate in equal chunks; the last one starts early so that all outputs are nodes."""
    count, nodes = len(outputs) - 1, stepper.nodes
    span = (outputs[-1] - outputs[0]) / count * nodes
    done = 0
    while done < count:
        begin = min(done, count - nodes)
        segment = run.segments[-1]
        x, z = segment.state(begin)
        if follow is not None:
            follow.advance(stepper, Point(outputs[begin], x, z, run.point.q), span, begin)
        with progress.watching(stepper.now):
            stretch = integrate(run, stepper, Point(outputs[begin], x, z, run.point.q), span)
        new = slice(done - begin, nodes)
        run.record(outputs[done + 1 : begin + nodes + 1], stretch.states[new], stretch.algebraic[new])
        done = begin + nodes
        last = stretch.states[-1], stretch.algebraic[-1]
        run.point = Point(float(outputs[done]), *last, run.point.q)
        progress.at(run.point.t)
