"""Contenders: which of what was screened is worth a fit, in which order, and what was overlooked."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from .. import criteria
from .model_comparison import Refit
from .score_test import Candidate


def promising(waiting: Sequence[Candidate], kept: float, fitted: Sequence[Refit]) -> list[Candidate]:
    """Return those that may be best, by the best promise that was kept, and their special cases.

    Screening underrates what is in series, and what generalises the best fit so far by a shape of its own.
    """
    least = criteria.HOPELESS_GAIN_RATIO * kept
    best = min(fitted, key=lambda model: model.cost, default=None)
    good = [
        c
        for c in waiting
        if (c.effect.place == "series" and not c.effect.plain)
        or c.gain > least
        or (best and c.generalises(best.effects[-1]))
    ]
    return [c for c in waiting if c in good or any(other.generalises(c) for other in good)]


def ready(waiting: Sequence[Candidate], under_way: Sequence[Candidate]) -> Candidate | None:
    """Return the first candidate that does not start from what a fit to come or under way will give."""
    first = (c for c in waiting if not any(c.generalises(other) for other in (*under_way, *waiting)))
    return next(first, None)


def leading(candidates: Sequence[Candidate], found: Collection[str]) -> list[Candidate]:
    """Return the candidates worth a fit, one for each motion and kind, whose site is the same for all kinds.

    What was found, by its label, is not looked for again; special cases go before what generalises them.
    """
    chosen: list[Candidate] = []
    for candidate in candidates:
        if candidate.gain < criteria.LEAST_CHI_SQUARED_GAIN or len(chosen) >= criteria.CONTENDERS_PER_ROUND:
            break
        if candidate.label in found:
            continue
        alike = next((n for n, other in enumerate(chosen) if same_motion(candidate, other)), None)
        if alike is None:
            chosen.append(candidate)
        else:
            chosen[alike] = _named(chosen[alike], candidate)
    special = [c for c in candidates if c.label not in found]
    ordered = [one for c in chosen for one in (*(p for p in special if c.generalises(p)), c)]
    return list(dict.fromkeys(ordered))


def _named(one: Candidate, other: Candidate) -> Candidate:
    """Return of two that are one motion the whole rather than its part, or whose name says most."""
    if one.site.holds(other.site) or other.site.holds(one.site):
        return one if one.site.holds(other.site) else other
    return max(one, other, key=lambda c: (c.site.rank, c.site.path))


def reserve(
    candidates: Sequence[Candidate], early: Sequence[Candidate], tried: Sequence[Candidate], away: bool
) -> list[Candidate]:
    """Return what may have been overlooked: effects in series, and those that a large one hid.

    Parameters that were fitted without a large effect go far off, and there it looks like another: what was
    screened `early`, where they were given, is fitted from there, if they went far `away` once more.
    """
    worth = (c for c in candidates if c.effect.place == "series" and c.gain > criteria.LEAST_CHI_SQUARED_GAIN)
    series = [c for c in worth if not any(c is other or same_motion(c, other) for other in tried)]
    labels = set[str]() if away else {c.label for c in tried}
    hidden = [c for c in leading(early, ()) if c.label not in labels]
    return [*series[: criteria.RESERVES_PER_ROUND], *hidden[: criteria.RESERVES_PER_ROUND]]


def same_motion(one: Candidate, other: Candidate) -> bool:
    """Tell whether two candidates are one effect seen from two sites of one motion; channels have none.

    What is in series is the same anywhere in a line, in which all bears one force. A friction that is loaded
    by what it leaves is none that is loaded by what comes, however small both are.
    """
    moved = "channel" not in one.site.places and other.gain > 0
    close = abs(one.gain - other.gain) <= criteria.SAME_MOTION_GAIN_TOLERANCE * other.gain
    in_line = one.effect.place == "series" and one.site.path in other.site.line
    pressed = bool(one.site.load) == bool(other.site.load)
    return moved and one.effect.kind == other.effect.kind and (close or in_line) and pressed
