"""`inertance docs`: the pages that come with the package."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.markdown import Markdown

from ..components import nearest
from .failure import WRONG_USE, fail
from .terminal import CommandConsole

FOLDER = Path(__file__).parents[1] / "docs"
TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
EXAMPLES = """\b
Examples:
  inertance docs                     the pages there are
  inertance docs networks            how elements join, and what a run returns
  inertance docs identification > identification.md"""


def docs(
    page: Annotated[
        str | None, typer.Argument(metavar="PAGE", help="One of the pages; all if left out.")
    ] = None,
) -> None:
    """List the pages of the documentation, or print one: for a terminal, or as Markdown to a file."""
    pages = {path.stem: path for path in sorted(FOLDER.glob("*.md"))}
    if page is None:
        for name, path in pages.items():
            found = TITLE.search(path.read_text(encoding="utf-8"))
            typer.echo(f"{name:<26}{found[1] if found else ''}")
        typer.echo(f"\n`inertance docs PAGE` prints one; they stand in {FOLDER}")
        return
    name = page.removesuffix(".md")
    if name not in pages:
        told = nearest(name, pages) or f"; there are {', '.join(pages)}"
        fail(f"there is no page '{page}'{told}", WRONG_USE)
    text = pages[name].read_text(encoding="utf-8")
    if sys.stdout.isatty():
        CommandConsole().print(Markdown(text))
    else:
        typer.echo(text, nl=False)
