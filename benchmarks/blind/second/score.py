"""The measures of the second generation, and what goes wrong by how records were taken."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import mean, median, quantiles
from typing import Any

from measures import Scored, alarm, is_outside, null_cases, share

Rows = list[tuple[str, str, str]]
GROUPS = ("effect", "pair", "twice", "triple", "none", "parameters", "unknown")
SAID = ("effect", "ambiguous")
LEAST = 0.1  # of the square of noise: a gap that can be closed


def table(cases: Sequence[Scored]) -> Rows:
    """Return rows of (measure, figure, target)."""
    groups = {name: [c for c in cases if c.label["group"] == name] for name in GROUPS}
    single, outside, null = groups["effect"], groups["unknown"], null_cases(cases)
    listed = [c for c in cases if c.label["group"] != "unknown"]
    shown = [c for c in single if c.label["severity"] >= 3 and c.said in SAID]
    two = [c for c in cases if len(c.label["effects"]) == 2]
    sizes = [len(c.members) for c in shown]
    return [
        *(
            share(f"kind and site, gap-to-noise {s:g}", at, lambda c: c.hit, target)
            for s, target in ((10.0, ">= 90 %"), (3.0, ">= 80 %"), (1.0, ""))
            for at in [[c for c in single if c.label["severity"] == s]]
        ),
        share("all of two effects, no other", two, lambda c: c.hit, ">= 70 %"),
        share("the same kind twice", groups["twice"], lambda c: c.hit, ""),
        share("all of three effects, no other", groups["triple"], lambda c: c.hit, ""),
        share("false alarms", null, alarm, "<= 2 %"),
        share("a named effect that is not there", cases, stray, "<= 3 %"),
        share("  where the list has all that acts", listed, stray, ""),
        share("class holds the truth", shown, lambda c: any(map(c.is_right, c.members)), ">= 95 %"),
        ("mean size of a class", f"{mean(sizes):.2f}" if sizes else "-", "<= 2"),
        share("unknown or partial, outside the list", outside, right, ">= 90 %"),
        _closed(single),
        _times(cases),
        share("no verdict", cases, lambda c: c.said == "failed", "0 %"),
    ]


def stray(case: Scored) -> bool:
    """Tell whether a verdict names an effect that is not there, and in no class that holds the truth."""
    if case.said in ("ambiguous", "partial") and any(map(case.is_right, case.members)):
        return False
    return any(not case.is_right(answer) for answer in case.named)


def right(case: Scored) -> bool:
    """Tell whether a verdict is right in every way that is scored."""
    group = case.label["group"]
    if group == "unknown":
        return is_outside(case)
    return case.hit if case.label["effects"] else not alarm(case) and case.said != "failed"


def closed(case: Scored) -> float | None:
    """Return how much of what the true law closes a verdict closes, None if that is nothing to speak of.

    1 - sum((after/left)^2 - 1)/sum((refit/left)^2 - 1) over channels, `left` being what the records part from
    the law that made them, with the true parameters: noise, quantisation, filters.
    """
    gap: dict[str, Any] = case.verdict.get("gap") or {}
    left: dict[str, float] = case.label["left"]
    told = [(gap[name]["refit"] / x, gap[name]["after"] / x) for name, x in left.items() if name in gap]
    before = sum(refit**2 - 1 for refit, _ in told)
    then = sum(after**2 - 1 for _, after in told)
    return 1 - max(then, 0.0) / before if before > LEAST else None


def by_cause(cases: Sequence[Scored]) -> Rows:
    """Return the share of right verdicts by how the records were taken and how strong their effects are."""
    told = [c for c in cases if c.label["severity"] != 1]
    return [
        share(f"{title}: {value}", [c for c in told if key(c) == value], right, "")
        for title, key in CAUSES.items()
        for value in sorted({key(c) for c in told})
    ]


def _logged(name: str) -> Callable[[Scored], str]:
    return lambda case: str(case.label["logger"][name])


CAUSES: dict[str, Callable[[Scored], str]] = {
    "group": lambda c: str(c.label["group"]),
    "rig": lambda c: str(c.label["rig"]),
    "begins": _logged("begin"),
    "filter": _logged("filtered"),
    "bits": lambda c: "fine" if c.label["logger"]["bits"] == 16 else "coarse",
    "gap": _logged("gap"),
    "zeros unknown": lambda c: str(bool(c.label["logger"]["offset"])),
    "noise": lambda c: f"{c.label['noise']:g}",
    "time from 0": lambda c: str(not c.label["logger"]["clock"]),
}


def _closed(cases: Sequence[Scored]) -> tuple[str, str, str]:
    told = [closed(c) for c in cases if c.label["severity"] >= 3 and c.said in SAID]
    shares = [x for x in told if x is not None]
    figure = f"median {median(shares):.3f}, mean {mean(shares):.3f}, {len(shares)} cases" if shares else "-"
    return "closed, of what the true law closes", figure, ">= 0.95"


def _times(cases: Sequence[Scored]) -> tuple[str, str, str]:
    seconds = sorted(c.seconds for c in cases if c.seconds is not None)
    if len(seconds) < 2:
        return "time for five records", "-", "<= 20 s, <= 60 s"
    last = quantiles(seconds, n=20, method="inclusive")[-1]
    return "time for five records", f"median {median(seconds):.1f} s, 95 % {last:.1f} s", "<= 20 s, <= 60 s"
