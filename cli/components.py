"""`inertance components`: what there is to build with."""

from __future__ import annotations

from typing import Annotated

import typer

from .failure import WRONG_USE, failing

EXAMPLES = """\b
Examples:
  inertance components
  inertance components Spring
  inertance components rotational.Inertia"""


def components(
    name: Annotated[
        str | None,
        typer.Argument(metavar="NAME", help="A component: Spring, rotational.Spring, signals.Gain."),
    ] = None,
) -> None:
    """List the components, or tell everything about one."""
    if name is None:
        _list_all()
        return
    from .catalogue import find
    from .describe import describe

    with failing(WRONG_USE, KeyError):
        full = find(name)
    describe(full)


def _list_all() -> None:
    from .catalogue import catalogue, first_line, is_base

    families = catalogue()
    width = max(len(name) for names in families.values() for name in names)
    for family, names in families.items():
        typer.secho(family, bold=True)
        for name, kind in sorted(names.items(), key=lambda item: is_base(item[1])):
            typer.echo(f"  {name:<{width}}  {'(base) ' * is_base(kind)}{first_line(kind)}")
        typer.echo()
    typer.echo("`inertance components NAME` tells equation, ports, parameters and an example.")
    typer.echo("A (base) is for deriving your own elements from.")
