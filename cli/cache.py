"""`inertance cache`: the compiled models that are kept for later runs."""

from __future__ import annotations

from typing import Annotated

import typer

from ..base.kept_files import MOST_BYTES, kept_files

MEGABYTE = 2**20
EXAMPLES = """\b
Examples:
  inertance cache                          where they are, how many, and how large
  inertance cache --clear                  remove them; runs that need one compile it again
  XDG_CACHE_HOME=/scratch inertance run model.py:build    keep them elsewhere

\b
A model that runs for long or often is compiled to a library of some 80 kB, after a core that models
of its size share. It is known by its C, by the compiler and its flags, and serves every process
that runs the same model: also with other parameters, start values and records. Those used longest
ago go first where all become larger than 128 MB. Nothing else is kept, and nothing is lost but time
if the folder is removed. `inertance docs networks` tells when models are compiled."""


def cache(
    clear: Annotated[bool, typer.Option("--clear", help="Remove the compiled models.")] = False,
) -> None:
    """Show where compiled models are kept for later runs, how many and how large; or remove them."""
    kept = kept_files()
    if kept.path is None:
        typer.echo(
            "nothing is kept: no folder can be written to by its owner alone; set XDG_CACHE_HOME to one"
        )
        return
    files = kept.files()
    size = sum(path.stat().st_size for path in files) / MEGABYTE
    told = f"{len(files)} compiled file{'' if len(files) == 1 else 's'}, {size:.1f} MB"
    if clear:
        kept.clear()
        typer.echo(f"removed {told} from {kept.path}")
    else:
        typer.echo(f"{told} of at most {MOST_BYTES / MEGABYTE:.0f} MB, in {kept.path}")
