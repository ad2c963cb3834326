"""`inertance fit`: estimate the parameters of a campaign."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.processes import Processes
from ..components import ModelError
from .arguments import SOLVER_NAMES
from .failure import INTERRUPTED, WRONG_USE, fail, failing
from .outputs import JSON, PICTURES, draw, expect
from .terminal import progress

if TYPE_CHECKING:
    from ..identification import Campaign, Fit

EXAMPLES = """\b
Examples:
  inertance fit campaign.toml
  inertance fit campaign.toml --json fit.json --plot fit.png
  inertance fit campaign.toml --starts 8 --workers 2
  inertance fit campaign.toml --intervals

campaign.toml says which model, channels, parameters and records: see `inertance docs identification`.
`inertance new campaign DIR` writes one to begin with.
Ctrl-C ends the fit and keeps the best parameters until then."""


def fit(
    campaign: Annotated[Path, typer.Argument(metavar="CAMPAIGN", help="The TOML file of the campaign.")],
    json: Annotated[Path | None, typer.Option(help="Write values, errors and warnings to a file.")] = None,
    plot: Annotated[
        Path | None, typer.Option(help="Draw measured and predicted into a .png, .pdf or .svg file.")
    ] = None,
    channel: Annotated[str | None, typer.Option(help="The channel to draw; the first output.")] = None,
    starts: Annotated[int, typer.Option(min=1, help="Number of starts, drawn from the priors.")] = 1,
    workers: Annotated[int, typer.Option(min=1, help="Processes for the starts.")] = 1,
    intervals: Annotated[
        bool, typer.Option("--intervals", help="Tell 95 % intervals, too: by profiles of the misfit.")
    ] = False,
    solver: Annotated[str, typer.Option(help=SOLVER_NAMES)] = "auto",
) -> None:
    """Fit the uncertain parameters of a campaign to its training records."""
    from ..identification import Campaign

    expect("--json", json, JSON)
    expect("--plot", plot, PICTURES)
    with failing(WRONG_USE, ModelError):
        read = Campaign.load(campaign)
    if channel is not None and channel not in read.outputs:
        fail(f"there is no output channel '{channel}'; there are {', '.join(read.outputs)}", WRONG_USE)
    with failing(WRONG_USE, ModelError):
        found = _fitted(read, starts, workers, solver, 0.95 if intervals else None)
    wrote = []
    if json is not None:
        wrote.append(found.to_json(json))
    if plot is not None and found.comparisons:
        wrote.append(draw(found.plot(channel), plot))
    typer.echo(found.table())
    for path in wrote:
        typer.echo(f"wrote {path}")
    if found.interrupted:
        fail("interrupted before the end", INTERRUPTED)


def _fitted(campaign: Campaign, starts: int, workers: int, solver: str, intervals: float | None) -> Fit:
    from ..identification import FitInterruptedError
    from ..identification import fit as fitted

    with progress("fitting") as tell:
        try:
            with Processes(workers, "spawn") if min(workers, starts) > 1 else nullcontext() as executor:
                return fitted(
                    campaign,
                    starts=starts,
                    executor=executor,
                    solver=solver,
                    intervals=intervals,
                    report=tell,
                )
        except FitInterruptedError as interrupt:
            return interrupt.fit
