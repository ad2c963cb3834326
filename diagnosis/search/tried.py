"""`Tried`: models that were fitted while effects were held against others, so that none is fitted twice."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from math import inf

from ...components import InertanceError
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .crew import Crew
from .fit import Fit
from .joint_fit import JointFit
from .model_comparison import Refit


class Tried:
    """The models of a study that were fitted beside those of its rounds, by who fits them."""

    def __init__(self, study: Study) -> None:
        self.study, self.crew = study, Crew(study)
        self._models: dict[frozenset[str], Refit | str] = {}  # by labels of effects, or why there is none
        self._less: dict[tuple[Refit, str], Callable[[], Refit | None]] = {}  # by what it is without

    def made(self, fits: Sequence[Fit]) -> list[Refit | str]:
        """Return what comes of fits, which are made side by side unless they were before."""
        keys = [frozenset((*fit.base.labels, fit.placed.label)) for fit in fits]
        fresh = {key: fit for key, fit in zip(keys, fits, strict=True) if key not in self._models}
        begun = {key: self.crew.begin(fit) for key, fit in fresh.items()}
        self._models.update({key: outcome() for key, outcome in begun.items()})
        return [self._models[key] for key in keys]

    def begin(self, model: Refit, effects: Sequence[Hypothesis]) -> None:
        """Begin to fit a model without each of some of its effects."""
        for placed in effects:
            if (model, placed.label) not in self._less:
                outcome = self.crew.ask(without, placed, model, model.cost)
                self._less[model, placed.label] = cache(outcome)

    def without(self, placed: Hypothesis, model: Refit) -> Refit | None:
        """Return a model without one of its effects, as `without` does."""
        self.begin(model, [placed])
        return self._less[model, placed.label]()


def without(study: Study, placed: Hypothesis, model: Refit, known: float = inf) -> Refit | None:
    """Return a model without one of its effects, fitted again from where it is; None if it cannot be run.

    The fit ends early where it cannot come to a `known` cost.
    """
    others = [p for p in model.effects if p is not placed]
    sites = study.sites
    others = [p.beside([other for other in others if other is not p], sites) for p in others]
    starts = [(model.parameters, p.values) for p in others[-1:]]
    joined = [p.joined(placed) for p in others[-1:]]
    starts += [(model.parameters, values) for values in joined if values is not None]
    try:
        return JointFit(study, model.parameters, others, model).fitted(starts, known)
    except InertanceError:
        return None
