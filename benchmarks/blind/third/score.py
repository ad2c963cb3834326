"""The measures of the third generation: is it seen that a law is missing, where, and which one."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median

import numpy as np
from measures import Scored, share
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

Array = NDArray[np.float64]
WITHIN = 0.1  # [range of the law] by which nine of ten forces may be off
CLOSED = 0.9
Rows = list[tuple[str, str, str]]


def table(cases: Sequence[Scored]) -> Rows:
    """Return rows of (measure, figure, target)."""
    laws = [c for c in cases if c.label["verdict"] == "law"]
    others = [c for c in cases if c.label["verdict"] != "law"]
    drawn = [c for c in laws if c.said == "law"]
    off = [error(c) for c in drawn]
    rows = [
        share("called a law, or an effect at its site", laws, lambda c: c.said == "law" or listed(c), ""),
        share("  called a law", laws, lambda c: c.said == "law", ""),
        share("  called an effect of the list, at its site", laws, listed, ""),
        share("site right, of those called a law", drawn, sited, ">= 90 %"),
        share("site right, of all", laws, lambda c: sited(c) or listed(c), ">= 90 %"),
        share("law within 10 % of its range, of those", drawn, lambda c: error(c) <= WITHIN, ">= 80 %"),
        share("closed >= 0.9, of those", drawn, lambda c: float(c.verdict["closed"]) >= CLOSED, ""),
        ("off, of its range, of those", f"median {median(off):.3f}" if off else "-", ""),
        share("not called a law where none acts", others, lambda c: c.said != "law", ">= 90 %"),
        share("no verdict", cases, lambda c: c.said == "failed", "0 %"),
    ]
    seconds = [c.seconds for c in cases if c.seconds is not None]
    if seconds:
        rows.append(("run time", f"median {median(seconds):.1f} s, most {max(seconds):.1f} s", ""))
    return rows


def by_kind(cases: Sequence[Scored]) -> Rows:
    """Return the share of laws right in site and course, and of others not called a law, by kind."""
    kinds = dict.fromkeys(c.label["kind"] for c in cases)
    return [share(kind, [c for c in cases if c.label["kind"] == kind], right, "") for kind in sorted(kinds)]


def right(case: Scored) -> bool:
    """Tell whether a law is named where it acts, within a tenth of its range; or none where none acts."""
    if case.label["verdict"] != "law":
        return case.said not in ("law", "failed")
    return case.said == "law" and sited(case) and error(case) <= WITHIN


def listed(case: Scored) -> bool:
    """Tell whether effects of the list are named, one of them where the law acts."""
    return case.said in ("effect", "ambiguous") and any(site in case.label["sites"] for _, site in case.named)


def sited(case: Scored) -> bool:
    """Tell whether a law is said to act where it does."""
    return case.said == "law" and case.verdict["law"]["site"] in case.label["sites"]


def error(case: Scored) -> float:
    """Return by how much nine of ten forces are off at most, over the range of the law where it was visited.

    What constants of the same joint are off is a part of it.
    """
    law, label = case.verdict["law"], case.label
    s, v, force = np.array(label["visited"]).T
    fitted = label["nominal"] | case.verdict["parameters"]
    for name, moved in ((label["joint"]["k"], s), (label["joint"]["d"], v)):
        if name:
            force = force + (label["values"][name] - fitted[name]) * moved
    found = _values(law, {"position": s - law["origin"], "speed": v})
    return float(np.quantile(np.abs(found - force), 0.9) / np.ptp(force))


def _values(law: dict[str, object], moved: dict[str, Array]) -> Array:
    """Return the force of a law, given by points, at positions and speeds."""
    rows, names = np.array(law["table"]), list(law["variables"])  # type: ignore[call-overload]
    axes = [np.unique(rows[:, number]) for number in range(len(names))]
    values = rows[:, -1].reshape([len(axis) for axis in axes])
    at = [np.clip(moved[name], axis[0], axis[-1]) for name, axis in zip(names, axes, strict=True)]
    return np.asarray(RegularGridInterpolator(axes, values)(np.column_stack(at)))
