"""The measures of the needles: is the effect named, where it is, by kind."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median

from measures import Scored, share

Rows = list[tuple[str, str, str]]


def table(cases: Sequence[Scored]) -> Rows:
    """Return rows of (measure, figure, target)."""
    kinds = sorted({str(c.label["kind"]) for c in cases})
    rows = [share(f"named: {k}", [c for c in cases if c.label["kind"] == k], named, ">= 80 %") for k in kinds]
    rows += [
        share("named, or drawn as a law at its site", cases, lambda c: named(c) or drawn(c), ""),
        share("another effect named", cases, lambda c: c.said == "effect" and not named(c), ""),
        share("no verdict", cases, lambda c: c.said == "failed", "0 %"),
    ]
    seconds = [c.seconds for c in cases if c.seconds is not None]
    if seconds:
        rows.append(("run time", f"median {median(seconds):.1f} s, most {max(seconds):.1f} s", ""))
    return rows


def named(case: Scored) -> bool:
    """Tell whether the effect is named at its site, and no other."""
    if case.said not in ("effect", "ambiguous") or len(case.named) != 1:
        return False
    ((kind, site),) = case.named
    return kind in case.label["kinds"] and site in case.label["sites"]


def drawn(case: Scored) -> bool:
    """Tell whether a law is said to act where the effect does."""
    return case.said == "law" and case.verdict["law"]["site"] in case.label["sites"]
