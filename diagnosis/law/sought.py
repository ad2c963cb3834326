"""A law of its own, where nothing listed explains what a model misses: sought, polished and judged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any

from ...base import computing
from ...components import InertanceError
from ..criteria import (
    LAW_CHANGING_SHARE,
    LAW_CLOSED_SHARE,
    LAW_FINER_SHARE,
    LAW_FORESEEN_SHARE,
    LAW_RESOLVED,
    LAW_SITES,
    LOST_LEAST,
)
from ..models.study import Study
from ..search.model_comparison import Refit, is_clear
from .drawing import Drawing
from .law import STATIC, Law
from .missing_force import MissingForce, force_of
from .polish import Polished, polished
from .shown import Showing

ALL_OF_IT, SPANS_TOLD = 0.99, 3  # [1] of a force's square that is all of it, stretches told in a sentence


@dataclass(frozen=True, eq=False)
class Sought:
    """What came of looking for a static law beside a model.

    Attributes:
        before: the model.
        missing: the force that explains what it misses, where the least suffices or a law foresees most.
        foreseen: by site, the most of what is missing that a law of position, speed or both foresees there,
            in stretches that it was not fitted to.
        found: the law, fitted to free runs; None where none foresees enough.
        refused: why it is none of this machine; "" if it is one.
    """

    before: Refit
    missing: MissingForce = field(repr=False)
    foreseen: Mapping[str, float]
    found: Polished | None = field(repr=False)
    refused: str

    @property
    def law(self) -> Law | None:
        """The law, if it holds."""
        return self.found.law if self.found is not None and not self.refused else None

    @property
    def model(self) -> Refit | None:
        """The model with the law, if it holds."""
        return self.found.model if self.found is not None and not self.refused else None

    @property
    def follows(self) -> bool:
        """Whether free runs with the law follow the training records, be it refused or not."""
        return self.found is not None and self.found.left <= LAW_RESOLVED

    @property
    def ruled_out(self) -> str:
        """What it rules out that no law holds, in words."""
        most, sites = max(0.0, *self.foreseen.values()), " or ".join(self.foreseen)
        if most >= LAW_FORESEEN_SHARE:
            return f"The best static law of position and speed at {sites} {self.refused}."
        return f"No static law of position and speed at {sites} foresees more than {most:.0%} of it."

    @property
    def active(self) -> str:
        """Where the missing force acts, and when, in words."""
        missing, spans = self.missing, self.missing.active
        force = f"The force that would explain it acts at {missing.site.path}, {missing.told} rms"
        held = sum(float(span["share"]) for span in spans)
        if held > ALL_OF_IT:
            return f"{force}, throughout the records."
        when = ", ".join(f"{s['record']} {s['from']:g} to {s['to']:g} s" for s in spans[:SPANS_TOLD])
        more = f" and {len(spans) - SPANS_TOLD} more stretches" if len(spans) > SPANS_TOLD else ""
        return f"{force}, {held:.0%} of its square in {when}{more}."

    def to_dict(self) -> dict[str, Any]:
        """Return it as in the JSON file of a verdict, where no law holds."""
        return {
            "foreseen": {site: round(share, 4) for site, share in self.foreseen.items()},
            "refused": self.refused,
            "force": {
                "site": self.missing.site.path,
                "rms": self.missing.settled.rms,
                "unit": self.missing.unit,
                "leaves": self.missing.misfit,
                "windows": self.missing.active,
            },
        }


def sought(study: Study, model: Refit) -> Sought | None:
    """Return what comes of looking for a static law beside a model; None where no force can be found.

    Sites other than the likeliest are tried if no law there foresees enough. Where free runs with a law fail
    or miss more than noise, those are tried, too, that the force shows, the plainest first.
    """
    try:
        missing = force_of(study, model)
        if missing.misfit > missing.before:
            return None
        missing, law, foreseen = best_law(study, model, missing)
    except InertanceError:
        return None
    if not law.is_foreseen:
        return Sought(model, missing, foreseen, None, "foresees too little of it")
    tried = list[Sought]()
    for likely in likely_laws(missing, law):
        tried.append(judged(study, model, missing, likely, foreseen))
        found = tried[-1].found
        if tried[-1].follows or (found is not None and found.left >= LOST_LEAST and not likely.shown):
            break
    return min(tried, key=lambda one: (inf if one.model is None else one.model.misfit, not one.follows))


def likely_laws(missing: MissingForce, law: Law) -> Iterator[Law]:
    """Yield a law, then those that the force shows: the plainest, and one of two variables if that pays."""
    yield law
    shown = law if law.shown else missing.shown()
    if shown is not law and shown.is_foreseen:
        yield shown
    richer = Showing(missing.site, missing.settled).law(among=STATIC)
    if richer.is_foreseen and richer.variables != shown.variables:
        yield richer


def judged(
    study: Study, model: Refit, missing: MissingForce, law: Law, foreseen: Mapping[str, float]
) -> Sought:
    """Return what comes of a law in free runs, beside a model without it."""
    if study.late():
        return Sought(model, missing, foreseen, None, "was not tried in free runs: the time ended")
    try:
        found = _polished(study, law)
    except InertanceError:
        return Sought(model, missing, foreseen, None, "cannot be run in the model")
    return Sought(model, missing, foreseen, _drawn(missing, found), refusal(model, found))


def _polished(study: Study, law: Law) -> Polished:
    """Return a law fitted to free runs, with more points while that pays, unless these are lost."""
    found = polished(study, law)
    while LAW_RESOLVED < found.left < LOST_LEAST and not study.late():
        finer = found.law.finer()
        if finer is found.law:
            break
        closer = polished(study, finer)
        if closer.left > LAW_FINER_SHARE * found.left:
            break
        found = closer
    return found


def _drawn(missing: MissingForce, found: Polished) -> Polished:
    """Return a law with the missing force as that is beside the parameters that it was polished with."""
    forces = missing.settled.beside(missing.search.bench.away(found.model.parameters))
    return replace(found, law=replace(found.law, forces=tuple(forces)))


@computing("the search for a law")
def best_law(study: Study, model: Refit, missing: MissingForce) -> tuple[MissingForce, Law, dict[str, float]]:
    """Return the force where a static law foresees most of it, the law, and by site how much that is.

    The likeliest site for a force is kept if a law there foresees enough. Where none does at any site, it is
    the law that the force shows, if it shows one.
    """
    law = Drawing(missing.site, missing.settled).law(among=STATIC)
    first, sites = missing.site.path, missing.search.bench.sites
    foreseen = {first: law.explained}
    if law.explained >= LAW_FORESEEN_SHARE:
        return missing, law, foreseen
    others = [one.site for one in missing.ranking if one.site not in (*missing.alike, first)]
    for path in others[: LAW_SITES - 1]:
        number = next(n for n, site in enumerate(sites) if site.path == path)
        foreseen[path] = Drawing(sites[number], missing.settled, number).foreseen()
    best = max(foreseen, key=lambda path: foreseen[path])
    if best != first and foreseen[best] >= LAW_FORESEEN_SHARE:
        missing = force_of(study, model, best)
        law = Drawing(missing.site, missing.settled).law(among=STATIC)
    if not law.is_foreseen:
        shown = missing.shown()
        law = shown if shown.is_foreseen else law
    return missing, law, foreseen


def refusal(model: Refit, found: Polished) -> str:
    """Return why a law does not hold on the test runs."""
    closed = (model.misfit - found.model.misfit) / max(model.misfit - 1.0, 1e-9)
    if not is_clear(model, found.model) or closed < LAW_CLOSED_SHARE:
        return f"closes {max(closed, 0.0):.0%} of the gap in free runs"
    if found.changing > LAW_CHANGING_SHARE:
        takes = f"{found.changing:.0%} off the square of what it leaves"
        return f"would have to change with time, which takes {takes}"
    return ""
