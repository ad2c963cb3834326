"""Fits that would tell nothing: of what is explained already, and of what the model has as a parameter."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from ...components import Component
from ...components.language import Option, Parameter, RealInput, fields_of
from ...identification import Campaign
from ..criteria import EXCESS_DEVIATIONS, NOISE_MISFIT
from ..effects.edits import AddPart
from ..effects.hypothesis import Hypothesis
from ..effects.sites import walk
from ..models.study import Study
from .model_comparison import Refit


def needless(study: Study, placed: Hypothesis, base: Refit, fitted: Sequence[Refit]) -> str:
    """Return why an effect need not be fitted on top of a model beside those that are, nothing if it must."""
    for plain in fitted:
        special = plain.effects[-1]
        if study.noise_is_sure and placed.generalises(special) and leaves_chance(study, plain):
            return f"{special.label}, a special case of it, leaves nothing but noise"
    shared = _shared(study.campaign, placed, base)
    return f"the model has it, and {' and '.join(shared)} were fitted" if shared else ""


def leaves_chance(study: Study, model: Refit) -> bool:
    """Tell whether what a model leaves is noise, and of the training records no more than that by chance."""
    count = sum(experiment.independent for experiment in study.campaign.training)
    return model.misfit <= NOISE_MISFIT and model.cost <= count + EXCESS_DEVIATIONS * sqrt(2 * count)


def _shared(campaign: Campaign, placed: Hypothesis, base: Refit) -> list[str]:
    """Return the fitted parameters of a component that is at the site and has the effect's own law."""
    beside = placed.effect.place in ("across", "node")
    own = [e.component for e in placed.edits if beside and isinstance(e, AddPart) and e.name == placed.name]
    if not own or fields_of(own[0], RealInput):
        return []
    sizes, parts = [quantity.name for quantity in placed.quantities], dict(walk(campaign.network, ""))
    for path in (placed.site.path, *placed.site.same):
        part, paths = parts.get(path), [f"{path}.{name}" for name in sizes]
        if (
            part is not None
            and _same_law(part, own[0], sizes)
            and all(_free(campaign, p, base) for p in paths)
        ):
            return paths
    return []


def _same_law(one: Component, other: Component, sizes: Sequence[str]) -> bool:
    """Tell whether two components differ in nothing but some parameters."""
    declared = (*fields_of(one, Parameter), *fields_of(one, Option))
    rest = [field.name for field in declared if field.name not in sizes]
    return type(one) is type(other) and all(getattr(one, name) == getattr(other, name) for name in rest)


def _free(campaign: Campaign, path: str, base: Refit) -> bool:
    """Tell whether a parameter was fitted, and ended at no bound."""
    prior = campaign.priors.get(path)
    return prior is not None and prior.min < base.parameters[path] < prior.max
