"""What is measured on answered cases of either generation: hits, alarms, shares with their intervals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf, sqrt
from typing import Any

Answer = tuple[str, str]
CONFIDENCES = 0.0, 0.6, 0.9, 0.99, 0.9999, inf  # that are told apart


@dataclass(frozen=True)
class Scored:
    """A case with its label, and what was answered.

    Attributes:
        label: the truth.
        verdict: the verdict's JSON; empty if there is none.
        seconds: run time, None if not known.
    """

    label: dict[str, Any]
    verdict: dict[str, Any]
    seconds: float | None = None

    @property
    def said(self) -> str:
        """The verdict's word."""
        return str(self.verdict.get("verdict", "failed"))

    @property
    def first(self) -> Answer | None:
        """The effect named first."""
        named = self.named
        return named[0] if named else None

    @property
    def named(self) -> list[Answer]:
        """Effects that the verdict names."""
        effects = self.verdict.get("effects") or []
        return [_answer(effect) for effect in effects]

    @property
    def members(self) -> list[Answer]:
        """The equivalence class: what is named, and what the data cannot tell from it."""
        others = self.verdict.get("equivalent") or []
        flat = [entry for member in others for entry in (member if isinstance(member, list) else [member])]
        return list(dict.fromkeys([*self.named, *(_answer(entry) for entry in flat)]))

    def is_right(self, answer: Answer | None, effect: dict[str, Any] | None = None) -> bool:
        """Tell whether an answer is the true effect, or one of them."""
        effects = [effect] if effect else self.label["effects"]
        return answer is not None and any(list(answer) in e["answers"] for e in effects)

    @property
    def hit(self) -> bool:
        """Whether kind and site of all effects are named, none too many."""
        effects = self.label["effects"]
        found = [any(self.is_right(answer, effect) for answer in self.named) for effect in effects]
        return all(found) and len(self.named) == len(effects)


def wilson(hits: int, count: int, z: float = 1.959964) -> tuple[float, float]:
    """Return the 95 % interval of a share.

    Source: E. B. Wilson, J. Amer. Statist. Assoc. 22 (1927) 209-212.
    """
    if count == 0:
        return 0.0, 1.0
    p, spread = hits / count, z**2 / count
    middle = (p + spread / 2) / (1 + spread)
    half = z * sqrt(p * (1 - p) / count + spread / (4 * count)) / (1 + spread)
    return max(0.0, middle - half), min(1.0, middle + half)


def share(
    measure: str, cases: Sequence[Scored], hit: Callable[[Scored], bool], target: str
) -> tuple[str, str, str]:
    return measure, _figure([hit(c) for c in cases]), target


def _figure(hits: Sequence[bool]) -> str:
    """Return a share with its interval, and of how many."""
    if not hits:
        return "-"
    low, high = wilson(sum(hits), len(hits))
    return f"{sum(hits) / len(hits):6.1%}  [{low:.1%}, {high:.1%}]  {sum(hits)}/{len(hits)}"


def is_outside(case: Scored) -> bool:
    """Tell whether it is seen that something outside the list acts; a stop is a static law of its site."""
    stops = {site for e in case.label["effects"] if e["kind"] == "impacts" for site in e["sites"]}
    return case.said in ("partial", "unknown") or (
        case.said == "law" and case.verdict["law"]["site"] in stops
    )


def null_cases(cases: Sequence[Scored]) -> list[Scored]:
    """Return those without an effect."""
    return [c for c in cases if c.label["group"] in ("none", "parameters")]


def alarm(case: Scored) -> bool:
    return case.said in ("effect", "ambiguous", "partial", "law", "unknown")


def reliability(cases: Sequence[Scored]) -> list[tuple[str, str, str]]:
    """Return how many of the effects that are named are there, by how sure of them verdicts are."""
    told = [
        (float(effect["confidence"]), case.is_right(answer))
        for case in cases
        for effect, answer in zip(case.verdict.get("effects") or [], case.named, strict=True)
        if effect.get("confidence") is not None
    ]
    rows = []
    for low, high in pairwise(CONFIDENCES):
        some = [(sure, right) for sure, right in told if low <= sure < high]
        if some:
            mean = sum(sure for sure, _ in some) / len(some)
            name = f"confidence {low:.4g} to {min(high, 1.0):.4g}"
            rows.append((name, _figure([right for _, right in some]), f"{mean:.4g} told"))
    return rows


def _answer(effect: dict[str, Any]) -> Answer:
    return str(effect.get("kind")), str(effect.get("site"))
