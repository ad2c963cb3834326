"""A law that is like an effect of the list: the effect is named in its place."""

from __future__ import annotations

from collections.abc import Sequence

from ..criteria import LAW_LEAVES_SHARE
from ..models.study import Study
from ..search.choice import taken
from ..search.model_comparison import Refit
from ..search.revision import Rivals
from ..search.round import Round, go_on
from ..search.score_test import Candidate
from .decide import closed_by, decided, explains
from .verdict import Evidence, Verdict


def named(
    study: Study,
    evidence: Evidence,
    listed: Sequence[Candidate],
    near: Refit,
    notes: Sequence[str],
    instead: Refit | None = None,
) -> Verdict | None:
    """Return the verdict that names one of some effects, if it explains what is missing; None if none does.

    Records begin where those of the model do that is `near`. It is to leave about as little as a model that
    it stands for `instead`.
    """
    base = evidence.refit
    done = Round(base, [*evidence.screened], [], dict(evidence.failed))
    go_on(study, done, listed, near)
    best = taken(done, base)
    if best is None or not explains(best, base, study):
        return None
    if instead is not None and not best.is_noise(study.judged):
        left = 1.0 - closed_by(instead, base, study)
        if left < LAW_LEAVES_SHARE * (1.0 - closed_by(best, base, study)):
            return None
    return decided(study, evidence.nominal, base, best, [done], notes, Rivals())
