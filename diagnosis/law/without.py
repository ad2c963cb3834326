"""The force that is missing without an effect, beside the effect's own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from ..search.model_comparison import Refit
from .along import Bench
from .axes import along
from .search import Search

DRAWN = "position", "speed", "load"  # what the force of an effect may be drawn over


@dataclass(frozen=True, eq=False)
class Without:
    """What training records say of the last effect of a model.

    Attributes:
        placed: the effect.
        variable: what its force depends on most plainly.
        missing: by record, that variable and the force that is missing without the effect.
        own: by record, that variable and the force of the effect in the model.
    """

    placed: Hypothesis
    variable: str
    missing: Sequence[tuple[Array, Array]]
    own: Sequence[tuple[Array, Array]]


def without_last(study: Study, model: Refit) -> Without | None:
    """Return what records say of the last effect of a model; None if it is no force across a site.

    Raises:
        SimulationError: if the model cannot be run without it.
    """
    placed = model.effects[-1]
    search = Search(study, replace(model, effects=model.effects[:-1]))
    number = next((n for n, s in enumerate(search.bench.sites) if s.path == placed.site.path), None)
    if number is None or placed.effect.place not in ("across", "loaded"):
        return None
    own, motions = forces_of(study, model, [placed], number)
    numbers, sizes = search.movable()
    if number not in numbers or not own:
        return None
    at = numbers.index(number)
    (_, _, rough), *_ = search.rank(search.nominal, [number], sizes[at : at + 1])
    settled = search.settled(number, rough)
    forces = settled.beside(search.bench.away(model.parameters))
    variable = plainest(DRAWN, motions, own)
    return Without(
        placed,
        variable,
        [(along(run.motion(number), variable), f) for run, f in zip(settled.runs, forces, strict=True)],
        [(along(motion, variable), f) for motion, f in zip(motions, own, strict=True)],
    )


def forces_of(
    study: Study, model: Refit, parts: Sequence[Hypothesis], number: int
) -> tuple[list[Array], list[Motion]]:
    """Return what effects of a model at a site do together, and how it moves, in each training record.

    Both are empty where an effect is no force of its own.
    """
    bench = Bench(study, [*model.parameters], model.effects)
    forces, motions = [], []
    for experiment, start in zip(study.campaign.training, model.starts, strict=False):
        begin = bench.begin(experiment, model.parameters, start)
        run = bench.run(experiment, model.parameters, begin)
        names = [f"{placed.name}.{placed.site.mechanics.through}" for placed in parts]
        if any(name not in run.found.run for name in names):
            return [], []
        forces.append(np.sum([run.found.run[name] for name in names], axis=0))
        motions.append(run.motion(number))
    return forces, motions


def plainest(variables: Sequence[str], motions: Sequence[Motion], forces: Sequence[Array]) -> str:
    """Return along which variable a force goes up and down least: it is a plain curve of that."""

    def scatter(variable: str) -> float:
        x = np.concatenate([along(motion, variable) for motion in motions])
        return float(np.abs(np.diff(np.concatenate(forces)[np.argsort(x)])).sum())

    return min(variables, key=scatter)
