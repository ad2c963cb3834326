"""Beyond the list: a verdict that leaves something unexplained, with the law of its own that explains it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..criteria import (
    LAW_LEAVES_SHARE,
    LAW_MANY_PARTS,
    LOST_LEAST,
    LOST_STANDARD_DEVIATIONS,
    PIECE_FITS,
)
from ..effects.hypothesis import Hypothesis
from ..law.in_pieces import InPieces, likest, refitted
from ..law.in_place import in_place
from ..law.likened import likened
from ..law.sought import Sought, sought
from ..models.study import FMUStudy, Study
from ..search.model_comparison import Refit
from ..search.score_test import Candidate
from ..search.tried import without
from .counterfactual import Foretold, counterfactuals
from .decide import OPEN_END, closed_by
from .gap import gaps
from .named import Named
from .verdict import Evidence, Verdict


def beyond_the_list(study: Study, verdict: Verdict, known: Sought | None = None) -> Verdict:
    """Return a verdict that knows of a static law of its own, or of the force that none explains.

    It is looked for where something stays unexplained, or where several static effects at one site leave
    more than noise, if there is time and the model's equations are known. What came of it beside a model may
    be known.
    """
    if study.late() or isinstance(study, FMUStudy):
        return verdict
    if verdict.verdict not in OPEN_END:
        return _in_place(study, verdict, several=2)
    found = _in_whole(study, verdict, known)
    if _is_near(verdict) or (found.verdict not in OPEN_END and not _is_lost(found)):
        return found
    inner = _in_pieces(study, replace(verdict, sought=found.sought))
    return inner if inner.verdict not in OPEN_END or len(inner.effects) > len(found.effects) else found


def _is_near(verdict: Verdict) -> bool:
    """Tell whether free runs with effects that are named follow records: in pieces they would do no more."""
    return bool(verdict.effects) and verdict.evidence.after.misfit < LOST_LEAST


def _is_lost(verdict: Verdict) -> bool:
    """Tell whether free runs with a law part from records that it was fitted to."""
    found = None if verdict.sought is None else verdict.sought.found
    return found is not None and found.left > LOST_STANDARD_DEVIATIONS


def _in_pieces(study: Study, verdict: Verdict) -> Verdict:
    """Return the verdict with what holds in pieces of the records, where no free run follows them."""
    if study.late():
        return verdict
    study.tell("looking for what holds in pieces of the records")
    evidence, known = verdict.evidence, verdict.sought
    of_refit = known is not None and not known.before.effects
    inside = InPieces.of(evidence.study, evidence.refit, known if of_refit else None)
    if inside is None:
        return verdict
    listed = _listed_in_pieces(verdict, inside)
    if listed is not None and listed.verdict not in OPEN_END:
        return listed
    law = _law_in_pieces(verdict, inside)
    if listed is not None and law is not None:
        return law if _leaves_less(law.closed, listed.closed) else listed
    return law or listed or verdict


def _leaves_less(closed: float, by_effects: float) -> bool:
    """Tell whether a law that closes so much of a gap leaves so little that it stands in place of effects."""
    return 1.0 - closed <= LAW_LEAVES_SHARE * (1.0 - by_effects)


def _listed_in_pieces(verdict: Verdict, inside: InPieces) -> Verdict | None:
    """Return the verdict that names an effect of the list which holds in pieces of records.

    What is like the force is tried first: it is told in seconds, what is like a law in pieces in minutes.
    Beside noise the force that a play makes may be likelier at a damper next to it.
    """
    found = _fitted_in_pieces(verdict, inside, inside.in_series)
    spring = None if found is not None else inside.at_spring()
    if spring is not None:
        found = _fitted_in_pieces(verdict, spring, spring.in_series)
    if found is None or not found.explained:
        found = _nearer(found, _fitted_in_pieces(verdict, inside, inside.as_drawn))
        if found is None or not found.explained or found.misfit > LOST_LEAST:
            found = _nearer(found, _fitted_in_pieces(verdict, inside, inside.across))
    return None if found is None else found.verdict([_told(inside.study, found.study)])


def _fitted_in_pieces(verdict: Verdict, inside: InPieces, likely: Sequence[Candidate]) -> Named | None:
    """Return what came of fitting effects to pieces of records.

    These are cut once more by what is in series, or explains too little: a nearer model follows farther.
    """
    chosen, found = likest(likely, inside.model), None
    listed = {one.label: one for one in likely}
    for _ in range(PIECE_FITS):
        pieces = None if chosen is None else inside.cut_by_effect(chosen)
        if pieces is None:
            break
        evidence = _evidence_in(pieces, inside, verdict)
        tried = Named.of(pieces, evidence, [*listed.values()], replace(evidence.refit, starts=()))
        if tried.best is None:
            break
        found = _nearer(found, tried)
        last, given = tried.best.effects[-1], tried.best.parameters
        if (tried.explained and last.effect.is_static) or last.values == listed[last.label].values:
            break
        chosen = replace(listed[last.label], values=dict(last.values), parameters=given, sized=True)
        listed[last.label] = chosen
    return found


def _nearer(one: Named | None, other: Named | None) -> Named | None:
    """Return what explains what is missing, and of two that do or do not, what misses less."""
    there = [named for named in (one, other) if named is not None]
    return min(there, key=lambda named: (not named.explained, named.misfit), default=None)


def _law_in_pieces(verdict: Verdict, inside: InPieces) -> Verdict | None:
    """Return the verdict with a law that holds in pieces of records."""
    pieces = inside.cut_by_law()
    if pieces is None:
        return None
    evidence = _evidence_in(pieces, inside, verdict)
    found = inside.sought(pieces, evidence.refit)
    if found is None or found.model is None:
        return None
    notes = *verdict.notes, _told(inside.study, pieces)
    inner = replace(verdict, evidence=evidence, effects=(), confidence=(), notes=notes)
    return _with_law(pieces, inner, found)


def _evidence_in(pieces: Study, inside: InPieces, verdict: Verdict) -> Evidence:
    start, base = refitted(pieces, inside.model)
    return replace(verdict.evidence, study=pieces, nominal=start, refit=base, after=base)


def _told(study: Study, pieces: Study) -> str:
    parts, whole = len(pieces.campaign.experiments), len(study.campaign.experiments)
    return (
        f"judged by {parts} pieces of {whole} records, {pieces.pieces:.3g} s long at most, each from where "
        "the machine was: no free run follows it through all of them"
    )


def _in_whole(study: Study, verdict: Verdict, known: Sought | None) -> Verdict:
    """Return the verdict with a law that holds in free runs of whole records."""
    evidence, found = verdict.evidence, known
    if known is None or not _is_enough(known, evidence.after):
        study.tell("looking for a law of its own")
        found = sought(evidence.study.displaced(evidence.after.effects), evidence.after)
    if found is None or found.model is None:
        told = replace(verdict, sought=found)
        return told if found is not None and found.follows else _in_place(study, told, several=1)
    found = _alone(evidence.study, found) or found
    return _in_its_place(verdict, found) or _with_law(study, verdict, found)


def _is_enough(known: Sought, model: Refit) -> bool:
    """Tell whether no law need be looked for beside a model, by what came of it beside another one.

    A law that follows the training records leaves nothing to a second one.
    """
    law = known.model
    return known.before is model or (known.follows and (law is None or law.misfit < model.misfit))


def _in_its_place(verdict: Verdict, found: Sought) -> Verdict | None:
    """Return the verdict that names an effect of the list in place of a law that is like it."""
    evidence, law, model = verdict.evidence, found.law, found.model
    if found.before.effects or law is None or model is None:
        return None
    listed = likened(found.missing, law, evidence.refit)
    if not listed:
        return None
    near = replace(evidence.refit, starts=model.starts)
    tried = Named.of(evidence.study, evidence, listed, near)
    return tried.verdict(()) if tried.stands_for(model) else None


def _with_law(study: Study, verdict: Verdict, found: Sought) -> Verdict:
    """Return a verdict with the law that was found."""
    evidence, model, before = verdict.evidence, found.model, found.before
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


def _in_place(study: Study, verdict: Verdict, several: int) -> Verdict:
    """Return one law in place of so many static effects at a site, if they leave much more than it does.

    Each of them may be but a part of the curve that is there, as far as its form allows. Where many of them
    are, a law of one variable need but leave as little.
    """
    evidence, after = verdict.evidence, verdict.evidence.after
    parts = max(_by_site(after), key=len, default=[])
    many = len(parts) >= LAW_MANY_PARTS
    if len(parts) < several or (after.is_noise(evidence.study.judged) and not many):
        return verdict
    found = _sought_without(evidence.study, after, parts)
    if found is None or found.law is None or found.model is None:
        return verdict
    closed, by_parts = (closed_by(m, evidence.refit, study) for m in (found.model, after))
    alike = many and len(found.law.variables) == 1 and found.model.misfit <= after.misfit
    return _with_law(study, verdict, found) if alike or _leaves_less(closed, by_parts) else verdict


def _by_site(model: Refit) -> list[list[Hypothesis]]:
    """Return the static effects of a model, those of one motion together."""
    found: list[list[Hypothesis]] = []
    for placed in (p for p in model.effects if p.effect.is_static):
        alike = next((parts for parts in found if _is_at(placed, parts[0])), None)
        if alike is None:
            found.append([placed])
        else:
            alike.append(placed)
    return found


def _is_at(placed: Hypothesis, other: Hypothesis) -> bool:
    return placed.site.path in (other.site.path, *other.site.same)


def _alone(study: Study, found: Sought) -> Sought | None:
    """Return the law in place of effects at its site that are laws like it, if it holds so, too."""
    assert found.law is not None
    site = found.law.site
    here = site.path, *site.same
    parts = [p for p in found.before.effects if p.effect.is_static and p.site.path in here]
    return _sought_without(study, found.before, parts) if parts else None


def _sought_without(study: Study, model: Refit, parts: Sequence[Hypothesis]) -> Sought | None:
    """Return the law at the site of some effects of a model that takes their place; None if none stands."""
    less: Refit | None = model
    for placed in parts:
        less = less and without(study, next(p for p in less.effects if p.label == placed.label), less)
    if less is None:
        return None
    study.tell(f"looking for a law in place of {' and '.join(placed.label for placed in parts)}")
    found = in_place(study, model, parts, less)
    return found if found is not None and found.model is not None else None
