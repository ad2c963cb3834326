"""What was fitted with other noise in mind, held against the records with the noise that is known since."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import log

from ...components import InertanceError
from ...identification import Campaign
from .. import criteria
from ..models.study import Study
from .choice import is_worth_it
from .crew import Crew
from .joint_fit import JointFit
from .model_comparison import Refit, best_of
from .round import Round


def reweighed(
    before: Study, study: Study, start: Refit, base: Refit, chosen: Refit, rounds: Sequence[Round]
) -> tuple[Refit, Refit, Refit, list[Round]] | None:
    """Return models and rounds of a study with what its records weigh since; None if a model cannot be run.

    The model that was chosen and what generalises it are fitted on from where they are, and chosen of anew;
    the others stay as they are. What is compared of the records may be the same as `before`: what models
    missed that are but held against others is scaled.
    """
    crew = Crew(study)
    richer = [model for model in rounds[-1].fitted if model.effects[-1].generalises(chosen.effects[-1])]
    fitted = [chosen, *richer]
    needed = [start, base, chosen, *(done.base for done in rounds)]
    others = [model for done in rounds for model in done.fitted]
    run = [*needed, *(richer if _compare_alike(before.campaign, study.campaign) else others)]
    begun = {model: crew.ask(_weighed, model, model in fitted) for model in dict.fromkeys(run)}
    found = {model: weighed for model, outcome in begun.items() if (weighed := outcome()) is not None}
    if not {*needed} <= {*found}:
        return None
    found |= {model: _scaled(before, study, model) for model in dict.fromkeys(others) if model not in run}
    again = [
        replace(done, base=found[done.base], fitted=[found[m] for m in done.fitted if m in found])
        for done in rounds
    ]
    run_on = [found[model] for model in richer if model in found]
    better = [model for model in run_on if is_worth_it(found[chosen], model)]
    return found[start], found[base], best_of(better or [found[chosen]]), again


def _compare_alike(before: Campaign, after: Campaign) -> bool:
    """Tell whether the same is compared of all records, and only its noise is other."""
    pairs = zip(before.experiments, after.experiments, strict=True)
    floors = ((old.floors[n], new.floors[n]) for old, new in pairs for n in before.outputs)
    return all(old.passed == new.passed and old.cutoff == new.cutoff for old, new in floors)


def _scaled(before: Study, study: Study, model: Refit) -> Refit:
    """Return a model with what it missed in units of the noise that is known since."""
    pairs = zip(before.campaign.experiments, study.campaign.experiments, strict=True)
    ratios = [{n: old.weights[n].sigma / new.weights[n].sigma for n in old.weights} for old, new in pairs]
    left = [
        {name: ratio[name] * missed for name, missed in record.items()}
        for ratio, record in zip(ratios, model.left, strict=True)
    ]
    train, test = left[: len(model.train)], left[len(model.train) :]
    cost = model.strain + sum(float(r @ r) for record in train for r in record.values())
    independent = sum(experiment.independent for experiment in study.judged)
    return replace(model, train=train, test=test, cost=cost, independent=independent)


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
