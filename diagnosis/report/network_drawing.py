"""The network of a verdict, drawn with what is guilty marked."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from ...components.language import parts_of
from ...networks import svg_sketch
from ..criteria import SITE_SHARE_TOLD
from ..effects.edits import part_at
from ..verdict.verdict import Verdict, moved_parameters


def drawings(verdict: Verdict) -> Iterator[str]:
    """Yield what is known of the place, and the corrected network, outermost first."""
    if verdict.where:
        large = {site: share for site, share in verdict.where.items() if share >= SITE_SHARE_TOLD}
        shares = ", ".join(f"{escape(site)} {share:.0%}" for site, share in large.items())
        yield f"<p>What the best effect at each site would explain, as shares: {shares}.</p>"
    for placed in verdict.effects:
        if placed.site.same:
            same = escape(", ".join(placed.site.same))
            yield f"<p>{escape(placed.site.path)} shares its motion with {same}: one site to these data.</p>"
    if verdict.remainder:
        yield f"<p>{escape(verdict.remainder)}</p>"
    network, marks = verdict.corrected(), marks_of(verdict)
    for owner in _owners(marks):
        composite = part_at(network, owner) if owner else network
        here = _within(marks, owner)
        title = f"Inside {owner}" if owner else network.name
        marked = "; ".join(f"{escape(name)}: {escape(told)}" for name, told in here.items())
        listed = f"<p>{len(parts_of(composite))} components, too many to draw. {marked}</p>"
        drawn = svg_sketch(composite, here) or listed
        yield f'<figure class="wide"><figcaption class="faint">{escape(title)}</figcaption>{drawn}</figure>'


def marks_of(verdict: Verdict) -> dict[str, str]:
    """Return path of a component -> what it is marked with."""
    study = verdict.evidence.study
    channels = study.campaign.measured
    marks: dict[str, str] = {}

    def mark(path: str, told: str) -> None:
        if path in channels:
            path, told = study.part(channels[path].path), f"{path}: {told}"
        if path:
            marks[path] = f"{marks[path]}, {told}" if path in marks else told

    for placed in verdict.effects:
        mark(placed.site.path, placed.effect.kind.replace("_", " "))
        if placed.edits:
            mark(placed.name, "added")
    if verdict.law is not None:
        mark(verdict.law.site.path, f"law of {' and '.join(verdict.law.variables)}")
        mark(verdict.missing[-1].name, "added")
    for kind, site in verdict.equivalent if verdict.effects else ():
        mark(site, f"or {kind.replace('_', ' ')}")
    if verdict.verdict == "unknown" and verdict.where:
        mark(next(iter(verdict.where)), "most of the gap")
    if verdict.verdict == "parameters":
        for name in moved_parameters(study.campaign, verdict.parameters):
            path = study.part(name)
            mark(path, name.removeprefix(f"{path}."))
    return marks


def _owners(marks: dict[str, str]) -> list[str]:
    """Return the composites that hold something marked, the network ("") first."""
    owners = {""}
    for path in marks:
        names = path.split(".")
        owners |= {".".join(names[:depth]) for depth in range(len(names))}
    return sorted(owners, key=lambda owner: (owner.count(".") + bool(owner), owner))


def _within(marks: dict[str, str], owner: str) -> dict[str, str]:
    """Return the marks of a composite's parts; a part takes those of what is in it."""
    here: dict[str, str] = {}
    prefix = f"{owner}." if owner else ""
    for path, told in marks.items():
        if path.startswith(prefix):
            name, _, inner = path.removeprefix(prefix).partition(".")
            here[name] = told if not inner or name in here else f"in {inner}"
    return here
