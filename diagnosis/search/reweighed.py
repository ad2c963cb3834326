"""What was fitted with other noise in mind, held against the records with the noise that is known since."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import log

from ...components import InertanceError
from ...identification import Campaign
from .. import criteria
from ..models.study import Study
from .crew import Crew
from .joint_fit import JointFit
from .model_comparison import Refit
from .round import Round


def reweighed(
    study: Study, start: Refit, base: Refit, chosen: Refit, rounds: Sequence[Round]
) -> tuple[Refit, Refit, Refit, list[Round]] | None:
    """Return models and rounds of a study with what its records weigh since; None if a model cannot be run.

    The model that was chosen is fitted on from where it is, the others stay as they are.
    """
    crew = Crew(study)
    models = dict.fromkeys([start, base, *(m for done in rounds for m in (done.base, *done.fitted))])
    begun = {model: crew.ask(_weighed, model, model is chosen) for model in models}
    found = {model: weighed for model, outcome in begun.items() if (weighed := outcome()) is not None}
    if not {start, base, chosen, *(done.base for done in rounds)} <= {*found}:
        return None
    again = [
        replace(done, base=found[done.base], fitted=[found[m] for m in done.fitted if m in found])
        for done in rounds
    ]
    return found[start], found[base], found[chosen], again


def _weighed(study: Study, model: Refit, fitted: bool) -> Refit | None:
    try:
        joint = JointFit(study, model.parameters, model.effects, model)
        return joint.fitted() if fitted else joint.seen(joint.start)
    except InertanceError:
        return None


def is_slight(before: Campaign, after: Campaign) -> bool:
    """Tell whether other noise changes so little what samples weigh that what was fitted stays."""
    pairs = zip(before.experiments, after.experiments, strict=True)
    changes = (abs(log(new.sigma[n] / old.sigma[n])) for old, new in pairs for n in before.outputs)
    return max(changes) < log(criteria.SLIGHT_NOISE_RATIO)
