"""A law, or a missing force, that is like an effect of the list: the effect is named in its place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from ..criteria import CERTAIN_GAP_SHARE, LAW_LEAVES_SHARE
from ..models.study import Study
from ..search.choice import taken
from ..search.model_comparison import Refit, gap_taken
from ..search.revision import Rivals
from ..search.round import Round, go_on
from ..search.score_test import Candidate
from .decide import closed_by, decided, explains
from .verdict import Evidence, Verdict


@dataclass(frozen=True, eq=False)
class Named:
    """What came of fitting some effects to the records of a study.

    Attributes:
        study: the records.
        evidence: what is known of the model without them.
        done: the fits.
        best: the model with the best of them; None if none is clearly better than without.
    """

    study: Study
    evidence: Evidence
    done: Round
    best: Refit | None

    @classmethod
    def of(cls, study: Study, evidence: Evidence, listed: Sequence[Candidate], near: Refit) -> Named:
        """Return it for effects beside a model; records begin where those of the model do that is `near`."""
        base = evidence.refit
        done = Round(base, [*evidence.screened], [], dict(evidence.failed))
        go_on(study, done, listed, near)
        return cls(study, evidence, done, taken(done, base))

    @property
    def explained(self) -> bool:
        """Whether the best explains what is missing."""
        return self.best is not None and explains(self.best, self.evidence.refit, self.study)

    @property
    def misfit(self) -> float:
        """What the best misses, in units of noise."""
        return inf if self.best is None else self.best.misfit

    def stands_for(self, model: Refit) -> bool:
        """Tell whether the best explains what is missing, and leaves about as little as a model."""
        base = self.evidence.refit
        if self.best is None or not self.explained:
            return False
        if self.best.is_noise(self.study.judged):
            return True
        left = 1.0 - closed_by(model, base, self.study)
        return left >= LAW_LEAVES_SHARE * (1.0 - closed_by(self.best, base, self.study))

    def verdict(self, notes: Sequence[str]) -> Verdict | None:
        """Return the verdict that names the best, if it explains what is missing or surely most of it."""
        base = self.evidence.refit
        if self.best is None:
            return None
        if not self.explained and gap_taken(self.best, base) < CERTAIN_GAP_SHARE:
            return None
        return decided(self.study, self.evidence.nominal, base, self.best, [self.done], notes, Rivals())
