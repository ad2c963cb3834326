"""`inertance design`: the next experiment."""

from __future__ import annotations

import os
from contextlib import nullcontext
from math import exp, log
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.processes import Processes
from ..components import InertanceError, ModelError
from .arguments import SOLVER_NAMES
from .failure import FAILED, WRONG_USE, failing
from .outputs import JSON, PICTURES, TABLES, draw, expect
from .terminal import CommandConsole, progress, table_of

if TYPE_CHECKING:
    from ..diagnosis import Design

MOST_LOG_ODDS = log(1e6)  # that are told
EXAMPLES = """\b
Examples:
  inertance diagnose campaign.toml --json gap.json          "ambiguous": two effects fit alike
  inertance design campaign.toml --verdict gap.json --out next.csv --plot next.png
                                                            the input that parts them most
  inertance design campaign.toml --out next.csv             the same, diagnosing first
  inertance design campaign.toml --parameters --out next.csv
                                                            to identify parameters, also before any rig exists

\b
What the rig bears stands in the campaign; without it, what was measured bounds the experiment:
  [limits]
  duration = 20                                             s
  x = { travel = 8, speed = "60 mm/s", band = [0.2, 5] }    an input: its unit, or a text with its own; Hz
  F = { force = "1.5 kN" }                                  an output: held by the model

\b
next.csv holds the time and the inputs, in the units of the campaign. Play it twice, add one run as
[[train]], the other as [[test]], and diagnose again: see `inertance docs design`. Exit code 1: no input
within the limits tells the hypotheses apart; the message says what else to measure."""


def design(
    campaign: Annotated[Path, typer.Argument(help="A campaign file (TOML).")],
    out: Annotated[Path | None, typer.Option("--out", help="Write what to play as a table (.csv).")] = None,
    verdict: Annotated[
        Path | None, typer.Option("--verdict", help="The JSON of a diagnosis; it is made first if not given.")
    ] = None,
    parameters: Annotated[
        bool, typer.Option("--parameters", help="To identify parameters, not to tell hypotheses apart.")
    ] = False,
    json: Annotated[Path | None, typer.Option("--json", help="Write what it is expected to tell.")] = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw inputs and what is foreseen (.png, .pdf or .svg).")
    ] = None,
    jobs: Annotated[int, typer.Option(min=0, help="Processes that fit models; 0 for all cores.")] = 0,
    solver: Annotated[str, typer.Option(help=SOLVER_NAMES)] = "auto",
) -> None:
    """Design the next experiment: what parts hypotheses, or tells parameters, best within limits."""
    from ..diagnosis import design as designed
    from ..diagnosis import read_model
    from ..identification import Campaign

    for option, path, endings in (("--out", out, TABLES), ("--json", json, JSON), ("--plot", plot, PICTURES)):
        expect(option, path, endings)
    if parameters and verdict is not None:
        raise typer.BadParameter("--verdict names hypotheses to tell apart; leave it out, or --parameters")
    count = jobs or os.cpu_count() or 1
    with failing(FAILED, InertanceError), failing(WRONG_USE, ModelError):
        read = Campaign.load(campaign, reader=read_model, planned=True)
        with progress("reading") as tell, Processes(count, "spawn") if count > 1 else nullcontext() as pool:
            found = designed(read, verdict, parameters=parameters, executor=pool, solver=solver, report=tell)
    wrote = [found.save(out)] if out is not None else []
    if json is not None:
        wrote.append(found.to_json(json))
    if plot is not None:
        wrote.append(draw(found.plot(), plot))
    show(found)
    for path in wrote:
        typer.echo(f"wrote {path}")


def show(found: Design) -> None:
    """Print what is played, and what it is expected to tell."""
    console = CommandConsole()
    console.print(
        f"{found.told}, {found.time[-1]:.4g} s at {found.rate:.4g} Hz", highlight=False, markup=False
    )
    table = table_of(
        "expected after it", ("one", "other", "apart [sd]", "odds", "right"), ("one", "other"), "fold"
    )
    for pair in found.odds:
        odds = f"{exp(pair.log_odds):.2g} : 1" if pair.log_odds < MOST_LOG_ODDS else "> 1e6 : 1"
        table.add_row(pair.one, pair.other, f"{pair.distance:.3g}", odds, f"{min(pair.right, 0.995):.1%}")
    if table.row_count:
        console.print(table)
    heads = ("parameter", "value", "unit", "sd before", "sd after")
    learnt = table_of("how well parameters will be known", heads, ("parameter", "unit"), "fold")
    for one in found.parameters:
        numbers = (f"{number:.3g}" for number in (one.before, one.after))
        learnt.add_row(one.parameter, f"{one.value:.5g}", one.unit, *numbers)
    if learnt.row_count:
        console.print(learnt)
    for note in found.notes:
        console.print(f"note: {note}", highlight=False, markup=False)
