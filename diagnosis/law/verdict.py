"""Where no known effect explains what is missing: a law of its own, if one does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...components import InertanceError
from ..criteria import CLEAR_STANDARD_ERRORS, LAW_GAP_SHARE
from ..models.study import FMUStudy, Study
from ..search.model_comparison import clearness
from ..verdict.gap import gaps
from ..verdict.verdict import Verdict
from .law import STATIC, Drawing
from .missing_force import MissingForce, force_of
from .polish import placed, polished


def with_law(verdict: Verdict, study: Study) -> Verdict:
    """Return an "unknown" or "partial" verdict with the missing force, a "law" where one explains it.

    The law is fitted to the training records, and judged by the test records as any effect is.
    """
    if verdict.verdict not in ("unknown", "partial") or study.late() or isinstance(study, FMUStudy):
        return verdict
    study.tell("looking for a law of its own")
    try:
        missing = force_of(study, verdict.evidence.refit)
        told = replace(verdict, missing=missing)
        return _judged(told, missing, study)
    except InertanceError as error:
        first = str(error).partition("\n")[0]
        return replace(verdict, notes=(*verdict.notes, f"no law of its own was found: {first}"))


def _judged(verdict: Verdict, missing: MissingForce, study: Study) -> Verdict:
    """Return the verdict with the law that does most, if that is enough."""
    from scipy.stats import norm

    evidence, base = verdict.evidence, verdict.evidence.refit
    law, found = polished(study, Drawing(missing.site, missing.settled).law(among=STATIC))
    closed = (base.misfit - found.misfit) / max(base.misfit - 1.0, 1e-9)
    clear = clearness(evidence.after, found)
    if closed < max(LAW_GAP_SHARE, verdict.closed) or clear < CLEAR_STANDARD_ERRORS:
        over = " and ".join(law.variables)
        note = (
            f"no law of position and speed at {law.site.path} explains it: over {over} it closes {closed:.0%}"
        )
        return replace(verdict, notes=(*verdict.notes, note))
    return replace(
        verdict,
        verdict="law",
        effects=(placed(law, law.values),),
        confidence=(float(norm.cdf(clear)),),
        windows={},
        gap=gaps(study, evidence.nominal, base, found),
        closed=float(np.clip(closed, 0.0, 1.0)),
        parameters=found.parameters,
        evidence=replace(evidence, after=found),
        law=law,
    )
