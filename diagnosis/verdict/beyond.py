"""Beyond the list: a verdict that leaves something unexplained, with the law of its own that explains it."""

from __future__ import annotations

from dataclasses import replace

from ..law.sought import sought
from ..models.study import FMUStudy, Study
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
    model = found.model
    return replace(
        verdict,
        verdict="law",
        windows={},
        gap=gaps(study, evidence.nominal, evidence.refit, model),
        closed=closed_by(model, evidence.refit, study),
        parameters=model.parameters,
        evidence=replace(evidence, after=model),
        counterfactual=tuple(counterfactuals(Foretold(evidence.study), evidence.refit, model)),
        sought=found,
    )
