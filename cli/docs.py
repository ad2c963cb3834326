"""`inertance docs`: the pages that come with the package."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Annotated

import typer

from ..components import nearest
from .failure import WRONG_USE, fail
from .terminal import CommandConsole

FOLDER = Path(__file__).parents[1] / "docs"
TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
EXAMPLES = """\b
Examples:
  inertance docs                     the pages there are
  inertance docs networks            how elements join, and what a run returns
  inertance docs identification > identification.md
  inertance docs --site site         all of them and the reference in a browser, with search, offline"""


def docs(
    page: Annotated[
        str | None, typer.Argument(metavar="PAGE", help="One of the pages; all if left out.")
    ] = None,
    folder: Annotated[
        Path | None,
        typer.Option("--site", metavar="DIR", help="Build the site there if it is not, and open it."),
    ] = None,
) -> None:
    """List the pages of the documentation, print one, for a terminal or as Markdown, or open the site."""
    pages = {path.stem: path for path in sorted(FOLDER.glob("*.md"))}
    if page is None and folder is None:
        for name, path in pages.items():
            found = TITLE.search(path.read_text(encoding="utf-8"))
            typer.echo(f"{name:<26}{found[1] if found else ''}")
        typer.echo(f"\n`inertance docs PAGE` prints one; they stand in {FOLDER}")
        return
    name = (page or "index").removesuffix(".md")
    if name not in pages and page is not None:
        told = nearest(name, pages) or f"; there are {', '.join(pages)}"
        fail(f"there is no page '{page}'{told}", WRONG_USE)
    if folder is not None:
        _open(folder, name)
        return
    text = pages[name].read_text(encoding="utf-8")
    if sys.stdout.isatty():
        from rich.markdown import Markdown

        CommandConsole().print(Markdown(text))
    else:
        typer.echo(text, nl=False)


def _open(folder: Path, name: str) -> None:
    import webbrowser

    from .site import site

    if not (folder / "index.html").exists():
        typer.echo("building the site, some 15 s", err=True)
    place = site(folder).resolve() / f"{name}.html"
    typer.echo(place)
    webbrowser.open(place.as_uri())
