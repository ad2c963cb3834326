"""`inertance components`: what there is to build with."""

from __future__ import annotations

from typing import Annotated

import typer

from .failure import WRONG_USE, failing

EXAMPLES = """\b
Examples:
  inertance components
  inertance components Spring
  inertance components --search friction
  inertance components rotational.Inertia

`inertance docs components` tells more."""


def components(
    name: Annotated[
        str | None,
        typer.Argument(metavar="NAME", help="A component: Spring, rotational.Spring, signals.Gain."),
    ] = None,
    search: Annotated[
        str | None,
        typer.Option(
            "--search", metavar="WORDS", help="List what has these words in its name or description."
        ),
    ] = None,
) -> None:
    """List the components by family, search them, or tell everything about one."""
    if name is None or search is not None:
        _list(f"{name or ''} {search or ''}".replace("-", " ").split())
        return
    from .catalogue import find
    from .describe import describe

    with failing(WRONG_USE, KeyError):
        full = find(name)
    describe(full)


def _list(words: list[str]) -> None:
    """List the components that have all of some words, none asking for all, by family."""
    from .catalogue import by_family, first_line, is_base, mentions

    listed = [
        (title, {name: kind for name, kind in names.items() if all(mentions(name, kind, w) for w in words)})
        for title, names in by_family()
    ]
    width = max((len(name) for _, names in listed for name in names), default=0)
    if not width:
        typer.echo(
            f"no component mentions '{' '.join(words)}'; `inertance components` lists them all", err=True
        )
        raise typer.Exit(WRONG_USE)
    for title, names in listed:
        if names:
            typer.secho(title, bold=True)
            for name, kind in sorted(names.items(), key=lambda item: is_base(item[1])):
                typer.echo(f"  {name:<{width}}  {'(base) ' * is_base(kind)}{first_line(kind)}")
            typer.echo()
    typer.echo("`inertance components NAME` tells equation, picture, ports, parameters and an example.")
    typer.echo("A (base) is for deriving your own elements from.")
