"""The stretches of records in which most of something lies."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ...base import Array
from ..criteria import LOCAL_TIME_SHARE, WINDOW_SECONDS, WINDOWS_GAP_SHARE


def spans(parts: Sequence[tuple[str, Array, Array]]) -> list[dict[str, float | str]]:
    """Return the stretches that hold most of a quantity; all of each record where it is spread out.

    Each is {"record", "from", "to", "share"}, its instants in s.

    Args:
        parts: by record, its name, evenly spaced instants [s], and the quantity there.
    """
    found: list[tuple[int, int, int, float]] = []
    for number, (_, time, amount) in enumerate(parts):
        step = float(time[-1] - time[0]) / (len(time) - 1)
        count = max(1, round(len(amount) * step / WINDOW_SECONDS))
        ends = np.linspace(0, len(amount), count + 1).astype(int)
        found += [(number, a, b, max(float(amount[a:b].sum()), 0.0)) for a, b in pairwise(ends)]
    sizes = np.array([size for *_, size in found])
    order, total = np.argsort(-sizes), float(sizes.sum())
    held = np.cumsum(sizes[order]) / max(total, 1e-300)
    count = int(np.searchsorted(held, WINDOWS_GAP_SHARE)) + 1
    if count < LOCAL_TIME_SHARE * len(sizes):
        found = [found[place] for place in sorted(order[:count].tolist())]
    joined: list[tuple[int, int, int, float]] = []
    for number, a, b, size in found:
        if joined and joined[-1][0] == number and joined[-1][2] == a:
            _, a, _, before = joined.pop()
            size += before
        joined.append((number, a, b, size))
    return [
        {
            "record": parts[number][0],
            "from": round(float(parts[number][1][a]), 4),
            "to": round(float(parts[number][1][min(b, len(parts[number][1]) - 1)]), 4),
            "share": round(size / total, 4) if total else 0.0,
        }
        for number, a, b, size in joined
    ]
