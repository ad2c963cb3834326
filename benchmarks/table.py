"""Tables of ratios."""

from __future__ import annotations

from collections.abc import Iterable

from measure import Ratio
from rich.console import Console
from rich.table import Table


def show(title: str, ratios: Iterable[Ratio], notes: Iterable[str] = ()) -> None:
    """Print the cost of the library over that of each contender: median (least to most) of the rounds."""
    table = Table(title=f"{title}: library over ...", title_justify="left")
    for heading in ("", "CPU time", "wall time", "target", "met", ""):
        table.add_column(heading, justify="left")
    for ratio in ratios:
        target = ratio.contender.target
        row = (ratio.contender.name, str(ratio.cpu), str(ratio.wall))
        table.add_row(*row, "" if target is None else f"<= {target:g}", ratio.met, ratio.contender.remark)
    console = Console(width=max(Console().width, 110))
    console.print(table)
    for note in notes:
        console.print(f"  {note}")
    console.print()
