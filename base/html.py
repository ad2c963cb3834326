"""HTML that a notebook shows of an object: a heading, tables, what folds away."""

from collections.abc import Iterable, Sequence
from html import escape

CELL = 'style="text-align:left;vertical-align:top;padding:1px 8px"'
MUTED_STYLE = "opacity:0.65"


def page(name: str, title: str, *blocks: str) -> str:
    """Return blocks of HTML under a name and a title."""
    heading = f'<b>{escape(name)}</b> <span style="{MUTED_STYLE}">{escape(title)}</span>'
    return f'<div style="font:13px sans-serif">{heading}{"".join(blocks)}</div>'


def table(headers: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return rows of cells, which are HTML, as a table."""
    head = "".join(f"<th {CELL}>{escape(header)}</th>" for header in headers)
    body = "".join(f"<tr>{''.join(f'<td {CELL}>{cell}</td>' for cell in row)}</tr>" for row in rows)
    return f'<table style="font:inherit"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'


def table_of_texts(headers: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return rows of texts as a table."""
    return table(headers, ([escape(cell) for cell in row] for row in rows))


def listed_notes(notes: Iterable[str]) -> str:
    """Return notes as a list, empty if there are none."""
    items = "".join(f"<li>{escape(note)}</li>" for note in notes)
    return f"<ul>{items}</ul>" if items else ""


def folded(title: str, content: str) -> str:
    """Return what opens by a click on its title."""
    return f"<details><summary>{escape(title)}</summary>{content}</details>"


def more(count: int) -> str:
    """Tell how many are left out, if any are."""
    return f'<span style="{MUTED_STYLE}">and {count} more</span>' if count > 0 else ""
