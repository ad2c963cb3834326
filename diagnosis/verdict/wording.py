"""A verdict in words: what is certain, what is left, and what came closest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..criteria import WINDOW_SHARE_TOLD, WINDOWS_TOLD
from ..effects.hypothesis import told
from .gap import Gap

if TYPE_CHECKING:
    from .verdict import Verdict

ALONE = {
    "none": "Nothing is missing: the model explains the data down to the noise.",
    "parameters": "No effect is missing; parameters were wrong.",
    "unknown": "Something is missing that no known effect explains.",
    "interrupted": "The diagnosis was stopped before its end; no effect had been accepted by then.",
}
NAMED = {
    "partial": "Part of what is missing is {}; what is left stays unexplained.",
    "interrupted": "The diagnosis was stopped before its end; what had been accepted by then is {}.",
}


def sentence_of(verdict: Verdict) -> str:
    """Return a verdict in a sentence or two."""
    law = [verdict.law.told] if verdict.law is not None else []
    named = " and ".join([*(told(*placed.key) for placed in verdict.effects), *law])
    closing = f"{verdict.closed:.0%} of the gap, from {_fall(verdict.gap)}"
    words = ALONE | NAMED if named else ALONE
    if verdict.verdict in words:
        sentence = words[verdict.verdict].format(f"{named}, which closes {closing}") + _others(verdict)
        return sentence + closest_of(verdict) + _no_law(verdict) if verdict.windows else sentence
    if law:
        return f"Nothing listed explains it alone: what is missing is {named}; adding it closes {closing}."
    return f"What is missing is {named}; adding it closes {closing}.{_others(verdict)}"


def _no_law(verdict: Verdict) -> str:
    """Return what it rules out that no static law of its own holds."""
    return f" {verdict.sought.ruled_out}" if verdict.sought is not None else ""


def _others(verdict: Verdict) -> str:
    """Return what the data cannot tell from what was found, and what only a counterfactual tells from it."""
    return _alike(verdict) + "".join(f" {one.told}." for one in verdict.parted)


def foretold(verdict: Verdict) -> Iterator[str]:
    """Yield how well the machine is predicted after its changes, or why it is not, by record."""
    for record in dict.fromkeys(one.record for one in verdict.counterfactual):
        own = [one for one in verdict.counterfactual if one.record == record]
        missed = ", ".join(
            f"{one.channel} to {one.over_noise:.3g} times the noise"
            for one in own
            if one.over_noise is not None
        )
        told = f"predicts {missed}" if missed else "does not predict it"
        problem = f" ({own[0].problem})" if own[0].problem else ""
        yield f"{record}, {own[0].change}: the verdict's network {told}{problem}"


def _alike(verdict: Verdict) -> str:
    """Return what the data cannot tell from what was found."""
    others = ", ".join(told(*key) for key in verdict.equivalent)
    if len(verdict.effects) > 1 and others:
        return f" In the place of one of these, the data would allow {others} as well."
    return f" These data cannot tell it from {others}." if others else ""


def left_of(gaps: Mapping[str, Gap]) -> str:
    """Return what is left, by channel."""
    return "; ".join(f"{name}: {gap.left}" for name, gap in gaps.items())


def closest_of(verdict: Verdict) -> str:
    """Return what came closest to explaining what is left, and why it was not accepted."""
    closest = verdict.closest
    if closest is None:
        return ""
    square = "what is left" if verdict.effects else "the gap"
    return (
        f" Closest comes {closest.told}: it takes {closest.test_gain:.1%} off the square of {square} on the "
        f"{verdict.evidence.judged}, which {closest.refused}."
    )


def _fall(gaps: Mapping[str, Gap]) -> str:
    """Return from where to where the misfit of the channel falls that had most of the gap."""
    name = max(gaps, key=lambda one: gaps[one].refit / gaps[one].floor)
    gap, of = gaps[name], f"of {name}" if len(gaps) > 1 else "of the signal"
    return f"{100 * gap.refit:.2g}% to {100 * gap.after:.2g}% {of}"


def remainder_of(windows: Mapping[str, Any]) -> str:
    """Return when, in which band and in which motion most of what is left lies."""
    if not windows:
        return ""
    band = "{:.3g} and {:.3g} Hz".format(*windows["band"])
    regime = windows.get("regime", "any")
    motion = "in any regime of motion" if regime == "any" else f"most at {regime}"
    return f"What is left lies in {', '.join(_spans(windows['windows']))}; between {band}; {motion}."


def _spans(windows: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Yield the stretches of records that hold what is left; of many, what each record holds."""
    windows = [w for w in windows if w["share"] >= WINDOW_SHARE_TOLD] or windows
    if len(windows) <= WINDOWS_TOLD:
        yield from (f"{w['record']} {w['from']:g} to {w['to']:g} s ({w['share']:.0%})" for w in windows)
        return
    for record in dict.fromkeys(w["record"] for w in windows):
        own = [w["share"] for w in windows if w["record"] == record]
        yield f"{len(own)} stretches of {record} ({sum(own):.0%})"
