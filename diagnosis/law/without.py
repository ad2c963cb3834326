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
    own, motions = _own(study, model, number)
    numbers, sizes = search.movable()
    if number not in numbers or not own:
        return None
    at = numbers.index(number)
    (_, _, rough), *_ = search.rank(search.nominal, [number], sizes[at : at + 1])
    settled = search.settled(number, rough)
    fitted = np.array([model.parameters[name] for name in search.bench.names])
    forces = settled.beside((fitted - search.bench.centers) / search.bench.scales)
    variable = min(DRAWN, key=lambda name: _scatter(motions, own, name))
    return Without(
        placed,
        variable,
        [(along(run.motion(number), variable), f) for run, f in zip(settled.runs, forces, strict=True)],
        [(along(motion, variable), f) for motion, f in zip(motions, own, strict=True)],
    )


def _own(study: Study, model: Refit, number: int) -> tuple[list[Array], list[Motion]]:
    """Return the force of the last effect, and how its site moves, in each training record."""
    bench, placed = Bench(study, [*model.parameters], model.effects), model.effects[-1]
    forces, motions = [], []
    for experiment, start in zip(study.campaign.training, model.starts, strict=False):
        begin = bench.begin(experiment, model.parameters, start)
        run = bench.run(experiment, model.parameters, begin)
        name = f"{placed.name}.{placed.site.mechanics.through}"
        if name not in run.found.run:
            return [], []
        forces.append(run.found.run[name])
        motions.append(run.motion(number))
    return forces, motions


def _scatter(motions: Sequence[Motion], forces: Sequence[Array], variable: str) -> float:
    """Return how far a force goes up and down along a variable: least where it is a plain curve."""
    x = np.concatenate([along(motion, variable) for motion in motions])
    return float(np.abs(np.diff(np.concatenate(forces)[np.argsort(x)])).sum())
