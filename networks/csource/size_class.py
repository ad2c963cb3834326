"""Size class: one core in C serves all models whose sizes stay below some, so that it is compiled once."""

from __future__ import annotations

from collections.abc import Mapping

SWITCHES = ("MODEL_SPARSE", "MODEL_JUMPS")  # sizes by which a core is another program
FACTORS = (1, 2, 4, 8)
LEAST_ROOM = 8
ROOMS = {
    "NP": 32, "NG": 16, "NE": 32, "NSLOPE": 64, "NREDUCED": 64, "NRESPONSE": 32, "NVELOCITY": 32,
    "MODEL_ARGS": 16, "MODEL_WORK": 32,
}  # fmt: skip


def most_of_class(sizes: Mapping[str, int]) -> dict[str, int] | None:
    """Return the most of each size in the smallest class for some; None if they are too large for any."""
    if sizes["MODEL_SPARSE"]:
        return None
    for factor in FACTORS:
        most = {name: factor * ROOMS.get(name, LEAST_ROOM) for name in sizes if name not in SWITCHES}
        if all(sizes[name] <= room for name, room in most.items()):
            return most
    return None
