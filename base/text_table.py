"""Tables as lines of text."""

from collections.abc import Collection, Iterator, Sequence


def aligned(rows: Sequence[tuple[str, ...]], right: Collection[int] = ()) -> Iterator[str]:
    """Return a line for each row, columns under each other; those numbered in `right` are flush right."""
    columns = enumerate(zip(*rows, strict=True))
    layout = "  ".join(f"{{:{'>' if i in right else '<'}{max(map(len, cells))}}}" for i, cells in columns)
    return (layout.format(*row).rstrip() for row in rows)
