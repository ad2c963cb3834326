"""`inertance modelica`: a network as Modelica text."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..base import check_output, write_text
from ..components import InertanceError, ModelError
from .arguments import Model, StartValues, load_network, pairs
from .failure import FAILED, WRONG_USE, fail, failing

EXAMPLES = """\b
Examples:
  inertance modelica car.py:build --out car.mo
  inertance modelica car.py:build --no-msl --stop 10 --out car.mo
  inertance modelica car.py:build --start body.v=1

MODEL is path/to/file.py:function that returns a Network. Values are in SI units.
`inertance docs modelica` tells more."""


def modelica(
    model: Model,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="The .mo file; else it is printed.")
    ] = None,
    msl: Annotated[
        bool, typer.Option(help="Take what it has from the Modelica Standard Library, or need no library.")
    ] = True,
    start: StartValues = None,
    stop: Annotated[float, typer.Option(help="End of the experiment that the text suggests [s].")] = 1.0,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance that it suggests.")] = 1e-6,
) -> None:
    """Write the network that a function of a Python file returns as one Modelica model."""
    from ..modelica import to_modelica

    if out is not None and out.suffix != ".mo":
        fail(f"a Modelica model is written to a file that ends in '.mo', got '{out}'", WRONG_USE)
    if out is not None:
        with failing(WRONG_USE, ModelError):
            check_output(out)
    network = load_network(model)
    with failing(FAILED, InertanceError), failing(WRONG_USE, ModelError):
        text = to_modelica(network, msl=msl, start=pairs("--start", start), stop=stop, tolerance=tolerance)
    if out is None:
        typer.echo(text, nl=False)
        return
    with failing(FAILED, ModelError):
        write_text(out, text)
    typer.echo(f"wrote {out} ({len(text.splitlines())} lines)")
