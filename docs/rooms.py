"""Tell how the rooms are built: boxes, floors, arrows and circles of each, from the imports.

python docs/rooms.py [--checkout DIR] [--draw FILE] [ROOM ...]

A box is a file or a folder that stands in a room. An arrow tells that something in one box imports something
in another, other than for types alone. A box stands one floor above the highest that it imports. Boxes in a
circle reach each other, and share a floor; of rooms that are named they are told import by import.

Needs `import-linter`.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

import grimp
import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.sparse.csgraph import connected_components

PACKAGE = "inertance"
NO_ROOMS = {"benchmarks", "build", "docs", "examples", "tests"}
Arrows = dict[tuple[str, str], list[tuple[str, str]]]


def inside(graph: grimp.ImportGraph, room: str) -> tuple[list[str], Arrows]:
    """Return the boxes of a room, and by arrow the imports that make it."""
    prefix = f"{PACKAGE}.{room}." if room else f"{PACKAGE}."
    modules = sorted(m for m in graph.modules if m.startswith(prefix))
    arrows: Arrows = {}
    for module in modules:
        for other in graph.find_modules_directly_imported_by(module):
            ends = box(module, prefix), box(other, prefix)
            if other.startswith(prefix) and ends[0] != ends[1]:
                arrows.setdefault(ends, []).append((module, other))
    return sorted({box(m, prefix) for m in modules}), arrows


def box(module: str, prefix: str) -> str:
    """Return the box in which a module is."""
    return module.removeprefix(prefix).partition(".")[0]


def circles(boxes: list[str], arrows: Iterable[tuple[str, str]]) -> list[list[str]]:
    """Return the groups of boxes that reach each other."""
    joined = np.zeros((len(boxes), len(boxes)))
    for end in arrows:
        joined[boxes.index(end[0]), boxes.index(end[1])] = 1
    count, group = connected_components(joined, connection="strong")
    groups = [[b for b, g in zip(boxes, group, strict=True) if g == k] for k in range(count)]
    return [names for names in groups if len(names) > 1]


def floors(boxes: list[str], arrows: Iterable[tuple[str, str]]) -> dict[str, int]:
    """Return on which floor each box of a room stands; the lowest is 1."""
    leader = {b: b for b in boxes} | {b: names[0] for names in circles(boxes, arrows) for b in names}
    below: dict[str, set[str]] = {name: set() for name in leader.values()}
    for upper, lower in arrows:
        if leader[upper] != leader[lower]:
            below[leader[upper]].add(leader[lower])
    floor: dict[str, int] = {}

    def level(name: str) -> int:
        if name not in floor:
            floor[name] = 1 + max(map(level, below[name]), default=0)
        return floor[name]

    return {box: level(leader[box]) for box in boxes}


def draw(rooms: dict[str, dict[str, int]], path: Path) -> None:
    """Draw rooms, given from the top, and the floors of their boxes."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    from matplotlib.patches import Rectangle

    heights = [max(room.values(), default=1) for room in rooms.values()]
    figure, axes = plt.subplots(figsize=(11, 0.42 * sum(heights) + 1.2))
    top = 0.0
    for (name, room), height in zip(rooms.items(), heights, strict=True):
        axes.add_patch(Rectangle((0, top - height), 100, height, facecolor="#f4f1ea", edgecolor="#8a8577"))
        axes.text(1, top - height / 2, name, va="center", fontsize=11, weight="bold")
        for floor in range(1, height + 1):
            told = "    ".join(box for box, level in room.items() if level == floor)
            axes.text(57, top - height + floor - 0.5, told, ha="center", va="center", fontsize=8.5)
        top -= height + 0.35
    axes.set(xlim=(-0.2, 100.2), ylim=(top, 0.2))
    axes.axis("off")
    figure.savefig(path, bbox_inches="tight", dpi=100)
    plt.close(figure)


def main() -> None:
    """Read the imports and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--checkout", type=Path, default=Path(__file__).parents[1], help="of the package")
    parser.add_argument("--draw", type=Path, help="a picture of the rooms that is to be written")
    parser.add_argument("rooms", nargs="*", metavar="ROOM")
    given = parser.parse_args()
    sys.path.insert(0, str(given.checkout.resolve().parent))
    graph = grimp.build_graph(PACKAGE, exclude_type_checking_imports=True, cache_dir=None)
    _, between = inside(graph, "")
    order = floors(sorted({end for ends in between for end in ends}), between)
    rooms = sorted(order, key=lambda room: (-order[room], room))
    drawn = {}
    table = Table("room", "files", "boxes", "floors", "arrows", "in circles")
    for room in rooms:
        if room in NO_ROOMS or not graph.find_children(f"{PACKAGE}.{room}"):
            continue
        boxes, arrows = inside(graph, room)
        files = sum(m.startswith(f"{PACKAGE}.{room}.") for m in graph.modules)
        caught, drawn[room] = circles(boxes, arrows), floors(boxes, arrows)
        told = "; ".join(", ".join(names) for names in caught) or "none"
        table.add_row(
            room,
            *(str(n) for n in (files, len(boxes), max(floors(boxes, arrows).values()), len(arrows))),
            told,
        )
        if room in given.rooms:
            for (upper, lower), imports in arrows.items():
                if any({upper, lower} <= set(names) for names in caught):
                    print(f"{upper} -> {lower}: " + ", ".join(f"{a} imports {b}" for a, b in imports[:4]))
    Console(width=150).print(table)
    if given.draw:
        draw(drawn, given.draw)


if __name__ == "__main__":
    main()
