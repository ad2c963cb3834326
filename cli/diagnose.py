"""`inertance diagnose`: say what parts the data of a campaign and its model."""

from __future__ import annotations

import os
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base import Processes
from ..components import InertanceError, ModelError
from .failure import FAILED, INTERRUPTED, WRONG_USE, fail, failing
from .outputs import JSON, PAGES, expect
from .terminal import CommandConsole, progress, table_of

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
    budget: Annotated[float | None, typer.Option(help="Seconds after which nothing new is begun.")] = None,
    validate: Annotated[
        bool, typer.Option(help="Whether to refuse an FMU whose description its schema does not allow.")
    ] = True,
) -> None:
    """Say what parts measured data and model: where, why, and how much of the gap closes."""
    from ..diagnosis import DiagnosisInterruptedError, read_model, write_report
    from ..diagnosis import diagnose as run_diagnosis
    from ..identification import Campaign

    expect("--json", json, JSON)
    expect("--report", report, PAGES)
    if jobs < 0:
        raise typer.BadParameter(f"--jobs must be at least 0, got {jobs}")
    with failing(WRONG_USE, ModelError):
        loaded = Campaign.load(campaign, validate=validate, reader=read_model)
    count = jobs or os.cpu_count() or 1
    with failing(FAILED, InertanceError), failing(WRONG_USE, ModelError), progress("reading") as tell:
        try:
            with Processes(count, "spawn") if count > 1 else nullcontext() as pool:
                verdict = run_diagnosis(loaded, executor=pool, solver=solver, budget=budget, report=tell)
        except DiagnosisInterruptedError as interrupt:
            verdict = interrupt.verdict
    wrote = []
    if json is not None:
        wrote.append(verdict.save(json))
    if report is not None:
        wrote.append(write_report(verdict, report))
    show(verdict)
    for path in wrote:
        typer.echo(f"wrote {path}")
    if verdict.verdict == "interrupted":
        fail("interrupted before the end", INTERRUPTED)


def show(verdict: Verdict) -> None:
    """Print a verdict: the sentence, the gap, the ranking and the lines that correct the model."""
    console = CommandConsole()
    console.print(f"[bold]{verdict.verdict}[/bold]: {verdict.sentence}")
    gaps = ("channel", "nominal", "refitted", "with effect", "noise")
    table = table_of(f"gap on the {verdict.evidence.judged}, NRMSE", gaps, words=("channel",))
    for name, gap in verdict.gap.items():
        table.add_row(name, *(f"{value:.4g}" for value in (gap.nominal, gap.refit, gap.after, gap.floor)))
    console.print(table)
    if verdict.ranking:
        ranks = ("effect", "site", "test gain", "p")
        table = table_of("effects fitted", ranks, words=("effect", "site"))
        for ranked in verdict.ranking:
            table.add_row(ranked.kind, ranked.site, f"{ranked.test_gain:.1%}", f"{ranked.p:.2g}")
        console.print(table)
    _show_parameters(console, verdict)
    told = [
        f"{placed.label}: the same motion as at {', '.join(placed.site.same)}, which no data part"
        for placed in verdict.effects
        if placed.site.same
    ]
    told += [f"  {line}" for line in verdict.lines]
    told += [f"note: {note}" for note in (*verdict.evidence.campaign.notes, *verdict.notes)]
    for line in told:
        console.print(line, highlight=False, markup=False)


def _show_parameters(console: CommandConsole, verdict: Verdict) -> None:
    """Print what the parameters of the network and of the effects were fitted to."""
    campaign, refitted = verdict.evidence.campaign, verdict.evidence.refit.parameters
    headings = ("parameter", "before", "refitted", "with effect", "unit", "prior deviations")
    table = table_of("parameters", headings, words=("parameter", "unit"), overflow="fold")
    for name, value in verdict.parameters.items():
        prior = campaign.priors[name]
        numbers = (f"{number:.5g}" for number in (campaign.start[name], refitted[name], value))
        moved = f"{prior.moved(value):.2g}" if prior.sd < float("inf") else "bounds only"
        table.add_row(name, *numbers, campaign.machine.unit(name), moved)
    for placed in verdict.effects:
        for name, unit in placed.units(campaign).items():
            table.add_row(f"{placed.name}.{name}", "", "", f"{placed.values[name]:.5g}", unit, "")
    if table.row_count:
        console.print(table)
