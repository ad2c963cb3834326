"""Effects of the list, screened along the motion that the missing force makes."""

from __future__ import annotations

from dataclasses import replace

from ...base import computing
from ..criteria import HOPELESS_GAIN_RATIO
from ..models.study import Study
from ..search.model_comparison import Refit
from ..search.score_test import Candidate, screen
from ..search.whitened_record import Forced
from .along import Beside
from .missing_force import force_of


@computing("the screening of effects along the missing force")
def screened_along(study: Study, model: Refit) -> tuple[list[Candidate], Refit]:
    """Return what explains most of the missing force of a model, and the model with where its records begin.

    Along its own runs a model is screened where it moves, along these where the machine does, which is
    elsewhere if ripple holds it in its valleys.
    """
    study = study.unsettled
    missing = force_of(study, model)
    settled = missing.search.resized(missing.settled)
    runs = settled.runs
    starts = [_start(run) for run in runs]
    forced = [
        Forced(missing.site.path, run.force, start, run.begin.own)
        for run, start in zip(runs, starts, strict=True)
        if run.force is not None
    ]
    found = screen(study, settled.given, model.effects, forced)
    least = HOPELESS_GAIN_RATIO * max((candidate.gain for candidate in found), default=0.0)
    found = [candidate for candidate in found if candidate.gain > least]
    return found, replace(model, starts=[*starts, *model.starts[len(starts) :]])


def _start(run: Beside) -> dict[str, float]:
    """Return the states at the start of a run by name; none at rest."""
    if run.begin.start is None:
        return {}
    names = run.bench.predictor.dae.state_names
    return dict(zip(names, run.begin.start.tolist(), strict=True))
