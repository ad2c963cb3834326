"""Rivals: the fitted models that a verdict cannot tell apart."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ...base import is_number, path_of, text_of, there_is_file
from ...components import ModelError, nearest
from ..effects.effect import effect_of
from ..effects.hypothesis import told
from ..models.study import Study
from ..search.crew import Crew
from ..search.fit import Fit
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.score_test import Candidate, screen

Key = tuple[str, str]
NOTHING = (
    "it names no effects that could be told apart; to learn the parameters better, design with --parameters "
    "(in Python, parameters=True)"
)


@dataclass(frozen=True)
class Named:
    """An effect at a site as a verdict names it, with its values if it tells them."""

    kind: str
    site: str
    values: Mapping[str, float]

    @property
    def key(self) -> Key:
        """Kind and site."""
        return self.kind, self.site


@dataclass(frozen=True)
class Question:
    """What a verdict leaves open: the effects that it found, and those that may stand for one of them.

    Without effects that were found, the `others` are rivals of each other.
    """

    found: tuple[Named, ...]
    others: tuple[Named, ...]
    parameters: Mapping[str, float]


def question_of(verdict: Mapping[str, Any], source: str) -> Question:
    """Return what a verdict leaves open: its class of equivalents, or else the two that lead its ranking.

    Raises:
        ModelError: for what is no verdict, and for one that names no two effects.
    """
    try:
        lists = {key: [_named(e) for e in verdict[key]] for key in ("effects", "equivalent", "ranking")}
        parameters = {str(n): float(v) for n, v in dict(verdict.get("parameters", {})).items()}
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ModelError(
            f"{source}: this is no verdict of `inertance diagnose --json` ({type(error).__name__}: {error})"
        ) from error
    values = {one.key: one.values for one in lists["ranking"]}
    found, others = lists["effects"], lists["equivalent"]
    others = [replace(one, values=values.get(one.key, one.values)) for one in others]
    if not others:
        taken = {one.key for one in found}
        others = [one for one in lists["ranking"] if one.key not in taken]
        others = others[: 1 if found else 2]
    if len(found[:1]) + len(others) < 2:
        raise ModelError(f"{source}: the verdict is '{verdict.get('verdict')}': {NOTHING}")
    return Question(tuple(found), tuple(others), parameters)


def read_question(path: str | Path) -> Question:
    """Return what the verdict in a JSON file leaves open."""
    path = path_of(path, "a verdict")
    there_is_file(path)
    try:
        verdict = json.loads(text_of(path))
    except json.JSONDecodeError as error:
        raise ModelError(f"{path}: this is not JSON ({error})") from error
    return question_of(verdict, str(path))


def _named(entry: Mapping[str, Any]) -> Named:
    effect_of(entry["kind"])
    values = {str(name): value for name, value in entry.get("parameters", {}).items() if is_number(value)}
    return Named(str(entry["kind"]), str(entry["site"]), values)


def rivals(study: Study, question: Question) -> list[Refit]:
    """Return the models that a question is about, fitted to the training records.

    Raises:
        ModelError: for a site that the model has not, and if fewer than two can be fitted.
    """
    given = {n: question.parameters.get(n, v) for n, v in study.campaign.start.items()}
    study.tell("refitting the parameters")
    base = JointFit(study, given).fitted()
    study.tell("screening effects")
    known = {candidate.key: candidate for candidate in screen(study, base.parameters)}
    for one in (*question.found, *question.others):
        if one.key not in known:
            names = [site for _, site in known]
            near = nearest(one.site, names) or f"; it may be at {', '.join(dict.fromkeys(names))}"
            raise ModelError(f"{told(*one.key)}: the model has no such site{near}")
    models, failed = list[Refit](), list[str]()
    for sets in _alternatives(question):
        tried = [_fitted(study, base, known, named, models) for named in sets]
        fitted = [model for model in tried if isinstance(model, Refit)]
        failed += [f"{told(*sets[0][-1].key)}: {why}" for why in tried if isinstance(why, str)]
        if fitted:
            models.append(min(fitted, key=lambda model: model.cost))
    if len(models) < 2:
        raise ModelError("fewer than two of the models can be fitted:", failed)
    return models


def _alternatives(question: Question) -> list[list[tuple[Named, ...]]]:
    """Return for each model the sets of effects that it may be: with another for any of those found."""
    found = question.found
    sets = [[found]] if found else []
    for other in question.others:
        places = range(len(found)) if found else range(1)
        sets.append([(*(p for n, p in enumerate(found) if n != place), other) for place in places])
    return sets


def _fitted(
    study: Study, base: Refit, known: Mapping[Key, Candidate], named: Sequence[Named], models: Sequence[Refit]
) -> Refit | str:
    """Return a model with effects, fitted one on top of the other, or why there is none."""
    crew = Crew(study)
    for one in named:
        candidate = known[one.key]
        study.tell(f"fitting {candidate.label}")
        fit = Fit.of(candidate, base, models)
        if set(one.values) == {quantity.name for quantity in _quantities(candidate)}:
            fit = replace(fit, starts=[(base.parameters, dict(one.values)), *fit.starts])
        found = crew.begin(replace(fit, known=float("inf")))()
        if isinstance(found, str):
            return found
        base = found
    return base


def _quantities(candidate: Candidate) -> Sequence[Any]:
    return candidate.effect.quantities[candidate.site.domain]
