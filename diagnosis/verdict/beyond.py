"""Beyond the list: a verdict that leaves something unexplained, with the law of its own that explains it."""

from __future__ import annotations

from dataclasses import replace

from ..law.sought import Sought, sought
from ..models.study import FMUStudy, Study
from ..search.model_comparison import Refit
from ..search.tried import without
from .counterfactual import Foretold, counterfactuals
from .decide import OPEN_END, closed_by
from .gap import gaps
from .verdict import Verdict


def beyond_the_list(study: Study, verdict: Verdict) -> Verdict:
    """Return a verdict that knows of a static law of its own, or of the force that none explains.

    It is looked for where something stays unexplained, if there is time and the model's equations are known.
    """
    if verdict.verdict not in OPEN_END or study.late() or isinstance(study, FMUStudy):
        return verdict
    study.tell("looking for a law of its own")
    evidence = verdict.evidence
    found = sought(evidence.study.displaced(evidence.after.effects), evidence.after)
    if found is None or found.model is None:
        return replace(verdict, sought=found)
    found = _alone(evidence.study, found) or found
    model, before = found.model, found.before
    assert model is not None
    kept = [number for number, placed in enumerate(verdict.effects) if placed.label in before.labels]
    return replace(
        verdict,
        verdict="law",
        effects=tuple(before.effects),
        confidence=tuple(verdict.confidence[number] for number in kept),
        equivalent=verdict.equivalent if len(kept) == len(verdict.effects) else (),
        windows={},
        gap=gaps(study, evidence.nominal, evidence.refit, model),
        closed=closed_by(model, evidence.refit, study),
        parameters=model.parameters,
        evidence=replace(evidence, after=model),
        counterfactual=tuple(counterfactuals(Foretold(evidence.study), evidence.refit, model)),
        sought=found,
    )


def _alone(study: Study, found: Sought) -> Sought | None:
    """Return the law in place of effects at its site that are laws like it, if it holds so, too."""
    assert found.law is not None
    site = found.law.site
    here = site.path, *site.same
    parts = [p for p in found.before.effects if p.effect.is_static and p.site.path in here]
    less: Refit | None = found.before
    for placed in parts:
        less = less and without(study, next(p for p in less.effects if p.label == placed.label), less)
    if not parts or less is None:
        return None
    study.tell(f"looking for it in place of {' and '.join(placed.label for placed in parts)}")
    alone = sought(study.displaced(less.effects), less)
    return alone if alone and alone.law and alone.law.site.path == site.path else None
