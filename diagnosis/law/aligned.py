"""Records aligned with each other, where a constant in the missing force of each is known to nobody."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ...components import SimulationError
from ..criteria import ALIGNED_LEVELS, ALIGNED_ROUNDS, FORCE_LAW_STIFFNESS, PART_CHI_SQUARED
from ..effects.effect import Motion
from ..models.force import Force
from .along import Begin, Beside
from .axes import Axis, Grid
from .regression import through
from .search import Settled


@dataclass(frozen=True, eq=False)
class Loose:
    """A record in which a constant force is made up for by where it begins and by zeros of its sensors.

    Attributes:
        run: of it.
        force: that it has.
        place: where the site is.
        start: what changes at its start for each unit of the force.
        shift: by how much the site then is elsewhere throughout.
    """

    run: Beside
    force: Force
    place: Array
    start: Array
    shift: float

    def at(self, level: float) -> tuple[Array, Array]:
        """Return where the site is, and the force, with a constant more in this."""
        return self.place + level * self.shift, self.force.values + level

    def moved(self, level: float) -> tuple[Beside, Force]:
        """Return the run with a constant more in its force, and that force."""
        more = Force(self.force.t, self.force.values + level)
        run = _begun(self.run, level * self.start, more)
        return run, Force(run.t, more.at(run.t))


def aligned(settled: Settled) -> Settled:
    """Return a force whose unknown constants are such that it is one curve over position, as far as it is.

    Which force a record shows where depends on such a constant, and so on next to nothing: a prior, or noise.
    Drawn through records as they come, a ripple is none.
    """
    found = [loose(settled, place) for place in range(len(settled.runs))]
    if sum(one is not None for one in found) < 2:
        return settled
    levels = _levels(settled, found)
    runs, forces = [*settled.runs], [*settled.forces]
    try:
        for place, (one, level) in enumerate(zip(found, levels, strict=True)):
            if one is not None:
                runs[place], forces[place] = one.moved(level)
    except SimulationError:
        return settled
    errors = [Force(run.t, error.at(run.t)) for run, error in zip(runs, settled.errors, strict=True)]
    told = tuple(one is None for one in found)
    return replace(settled, runs=tuple(runs), forces=tuple(forces), errors=tuple(errors), levels_known=told)


def _begun(run: Beside, change: Array, force: Force) -> Beside:
    """Return a run with a force, begun elsewhere."""
    begin = Begin(np.asarray(run.begin.start) + change, run.begin.own)
    return run.bench.run(run.experiment, run.given, begin, run.number, force)


def loose(settled: Settled, place: int) -> Loose | None:
    """Return a record if nothing tells a constant in its force; None if its runs do."""
    run, size = settled.runs[place], settled.rms
    if run.begin.start is None or not size:
        return None
    force, states = settled.forces[place], len(run.begin.start)
    columns, shared, _ = run.columns()
    own = columns[:, :, 1 + shared :]
    offsets = own.shape[2] - len(run.experiment.offset)
    free = own[:, :, [*range(states), *range(offsets, own.shape[2])]]
    answer = run.answers(settled.number, np.ones((len(run.t), 1)))[:, :, 0]
    flat = free.reshape(answer.size, -1)
    scale = np.maximum(np.linalg.norm(flat, axis=0), 1e-300)
    change = -np.linalg.lstsq(flat / scale, answer.ravel(), rcond=1e-8)[0] / scale
    left = answer.ravel() + flat @ change
    if size**2 * float(left @ left) > PART_CHI_SQUARED:
        return None
    start = change[:states]
    try:
        elsewhere = _begun(run, size * start, Force(force.t, force.values + size))
    except SimulationError:
        return None
    there, here = elsewhere.motion(run.number), run.motion(run.number)
    apart = np.interp(here.t, there.t, there.s) - here.s
    return Loose(run, force, here.s, start, float(np.median(apart)) / size)


def _levels(settled: Settled, found: Sequence[Loose | None]) -> list[float]:
    """Return the constants with which forces are most nearly one curve over position."""
    weights = [1 / np.maximum(error.values, 1e-3 * settled.rms) ** 2 for error in settled.errors]
    means = [float(np.average(f.values, weights=w)) for f, w in zip(settled.forces, weights, strict=True)]
    sure = [mean for mean, one in zip(means, found, strict=True) if one is None]
    middle = float(np.mean(sure or means))
    levels = [0.0 if one is None else middle - mean for one, mean in zip(found, means, strict=True)]
    steps = np.linspace(-1.0, 1.0, ALIGNED_LEVELS) * 2 * settled.rms
    for _ in range(ALIGNED_ROUNDS):
        curve, values = _curve(settled, found, levels)
        for place, one in enumerate(found):
            if one is not None:
                tried = [(level, *one.at(level)) for level in (levels[place] + steps).tolist()]
                away = {level: force - curve.basis(where) @ values for level, where, force in tried}
                levels[place] = min(away, key=lambda level: float(weights[place] @ away[level] ** 2))
        steps = steps / 2
    shift = 0.0 if sure else float(np.mean(levels))
    return [level - shift if one is not None else 0.0 for one, level in zip(found, levels, strict=True)]


def _curve(settled: Settled, found: Sequence[Loose | None], levels: Sequence[float]) -> tuple[Axis, Array]:
    """Return a curve over position through forces with constants more, and its values."""
    motions, forces = list[Motion](), list[Array]()
    for place, (one, level) in enumerate(zip(found, levels, strict=True)):
        motion, force = settled.runs[place].motion(settled.number), settled.forces[place].values
        if one is not None:
            where, force = one.at(level)
            motion = replace(motion, s=where)
        motions.append(motion)
        forces.append(force)
    axis = Axis.over("position", motions, pair=False)
    return axis, through(Grid((axis,)), motions, forces, FORCE_LAW_STIFFNESS)
