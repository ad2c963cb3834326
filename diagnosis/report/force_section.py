"""What is missing as a force: its law, or its course in time, or an effect's curve through it."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from ...components import InertanceError
from ...networks import pretty_unit
from ..effects.hypothesis import told
from ..law.without import Without, without_last
from ..models.study import FMUStudy
from ..verdict.verdict import Verdict
from .figures import Figure
from .law_figures import of_effect, of_law, over_motion, over_time
from .text import number

Shown = tuple[str, Figure]


def force_title(verdict: Verdict) -> str:
    """Return what the section is called."""
    return "The law" if verdict.law is not None else "The missing force"


def force_blocks(verdict: Verdict) -> Iterator[str | Shown]:
    """Yield paragraphs, and figures by name, of what is missing as a force; nothing if there is none."""
    law, sought = verdict.law, verdict.sought
    if law is not None:
        unit = pretty_unit(law.unit)
        yield f"<p>Dots: the force that is missing at {escape(law.site.path)}, by training records, where a "
        yield f"law foresees {law.explained:.1%} of {law.of_what} in stretches that it was not fitted to. "
        yield "Line: the law, fitted to free runs, with a band of two standard errors; "
        span = number(float(law.values.max() - law.values.min()))
        yield f"{escape('; '.join([f'it ranges over {span} {unit}', *law.traits]))}.</p>"
        yield "law", of_law(law)
        return
    seen = _without(verdict)
    if seen is not None:
        named = escape(told(*seen.placed.key))
        yield f"<p>Grey: the force that is missing in the training records without {named}. Red: that "
        yield "effect in the model, along its own run.</p>"
        yield "effect", of_effect(seen)
    if sought is not None:
        beside = " beside what was found" if verdict.effects else ""
        yield f"<p>{escape(sought.active)} {escape(sought.ruled_out)}</p>"
        yield f"<p>The force that is missing{beside}, over time, position and speed:</p>"
        yield "force-time", over_time(sought.missing)
        for variable, figure in over_motion(sought.missing).items():
            yield f"force-{variable}", figure


def _without(verdict: Verdict) -> Without | None:
    """Return what records say of the last effect, if there is time and it is a force in a network."""
    evidence = verdict.evidence
    named = verdict.verdict in ("effect", "ambiguous", "partial") and bool(verdict.effects)
    if not named or evidence.study.late() or isinstance(evidence.study, FMUStudy):
        return None
    try:
        return without_last(evidence.study, evidence.after)
    except InertanceError:
        return None
