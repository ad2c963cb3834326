"""`inertance diagnose`: say what parts the data of a campaign and its model."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from ..components import InertanceError, ModelError
from .failure import FAILED, WRONG_USE, failing

if TYPE_CHECKING:
    from ..diagnosis import Verdict

EXAMPLES = """\b
Examples:
  inertance diagnose campaign.toml
  inertance diagnose campaign.toml --json gap.json --report gap.html
  inertance diagnose campaign.toml --jobs 4 --solver compiled

A campaign names the model, the channels of its data files, the uncertain parameters, and the records to fit
([[train]]) and to judge by ([[test]]): see docs/diagnosis.md."""


def diagnose(
    campaign: Annotated[Path, typer.Argument(help="A campaign file (TOML).")],
    json: Annotated[Path | None, typer.Option("--json", help="Write the verdict as JSON.")] = None,
    report: Annotated[Path | None, typer.Option("--report", help="Write a report as one HTML file.")] = None,
    jobs: Annotated[int, typer.Option(help="Processes that fit candidates; 0 for all cores.")] = 0,
    solver: Annotated[str, typer.Option(help="Solver, as for `inertance run`.")] = "auto",
) -> None:
    """Say what parts measured data and model: where, why, and how much of the gap closes."""
    from ..diagnosis import diagnose as run_diagnosis
    from ..identification import Campaign

    for path in (json, report):
        if path is not None and not path.resolve().parent.is_dir():
            raise typer.BadParameter(f"there is no folder '{path.resolve().parent}'; make it first")
    if jobs < 0:
        raise typer.BadParameter(f"--jobs must be at least 0, got {jobs}")
    with failing(WRONG_USE, ModelError):
        loaded = Campaign.load(campaign)
    count = jobs or os.cpu_count() or 1
    console = Console(stderr=True)
    with failing(FAILED, InertanceError), console.status("reading") as status:
        if count > 1:
            os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # with a process a core, threads only queue
            with ProcessPoolExecutor(count, mp_context=get_context("spawn")) as pool:
                verdict = run_diagnosis(loaded, executor=pool, solver=solver, report=status.update)
        else:
            verdict = run_diagnosis(loaded, solver=solver, report=status.update)
    show(verdict)
    if json is not None:
        typer.echo(f"wrote {verdict.save(json)}")
    if report is not None:
        typer.echo(f"wrote {verdict.report(report)}")


def show(verdict: Verdict) -> None:
    """Print a verdict: the sentence, the gap, the ranking and the lines that correct the model."""
    console = Console()
    console.print(f"[bold]{verdict.verdict}[/bold]: {verdict.sentence}")
    table = Table(title=f"gap on the {verdict.evidence.judged}, NRMSE")
    for heading in ("channel", "nominal", "refitted", "with effect", "noise"):
        table.add_column(heading, justify="left" if heading == "channel" else "right")
    for name, gap in verdict.gap.items():
        table.add_row(name, *(f"{value:.4g}" for value in (gap.nominal, gap.refit, gap.after, gap.floor)))
    console.print(table)
    if verdict.ranking:
        table = Table(title="effects fitted")
        for heading in ("effect", "site", "test gain", "p"):
            table.add_column(heading, justify="left" if heading in ("effect", "site") else "right")
        for ranked in verdict.ranking:
            table.add_row(ranked.kind, ranked.site, f"{ranked.test_gain:.1%}", f"{ranked.p:.2g}")
        console.print(table)
    for line in verdict.lines:
        console.print(f"  {line}", highlight=False, markup=False)
    for note in verdict.notes:
        console.print(f"note: {note}", highlight=False, markup=False)
