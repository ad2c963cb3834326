"""Tables as lines of text."""

from collections.abc import Collection, Iterator, Sequence


def aligned(rows: Sequence[tuple[str, ...]], right: Collection[int] = ()) -> Iterator[str]:
    """Yield a line for each row, columns under each other; those numbered in `right` are flush right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = zip(row, widths, range(len(row)), strict=True)
        yield "  ".join(
            cell.rjust(width) if i in right else cell.ljust(width) for cell, width, i in cells
        ).rstrip()
