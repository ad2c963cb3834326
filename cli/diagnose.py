"""`inertance diagnose`: say what parts the data of a campaign and its model."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from time import monotonic
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated

import typer
from rich.markup import escape

from ..base.processes import Processes
from ..components import InertanceError, ModelError
from .arguments import SOLVER_NAMES
from .failure import FAILED, INTERRUPTED, WRONG_USE, fail, failing
from .outputs import JSON, PAGES, expect
from .terminal import CommandConsole, progress, table_of

if TYPE_CHECKING:
    from ..diagnosis import Ranked, Verdict
    from ..identification import Interval

LONGEST_LINE = 400  # characters of a line that corrects the model
EXAMPLES = """\b
Examples:
  inertance diagnose campaign.toml
  inertance diagnose campaign.toml --json gap.json --report gap.html
  inertance diagnose campaign.toml --intervals
  inertance diagnose campaign.toml --jobs 4 --solver compiled

A campaign names the model, the channels of its data files, the uncertain parameters, and the records to fit
([[train]]) and to judge by ([[test]]): see `inertance docs diagnosis`."""


def diagnose(
    campaign: Annotated[Path, typer.Argument(help="A campaign file (TOML).")],
    json: Annotated[Path | None, typer.Option("--json", help="Write the verdict as JSON.")] = None,
    report: Annotated[Path | None, typer.Option("--report", help="Write a report as one HTML file.")] = None,
    jobs: Annotated[int, typer.Option(help="Processes that fit candidates; 0 for all cores.")] = 0,
    solver: Annotated[str, typer.Option(help=SOLVER_NAMES)] = "auto",
    budget: Annotated[float | None, typer.Option(help="Seconds after which nothing new is begun.")] = None,
    intervals: Annotated[
        bool,
        typer.Option("--intervals", help="Tell 95 % intervals, too: by profiles of the misfit."),
    ] = False,
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
    with failing(FAILED, InertanceError), failing(WRONG_USE, ModelError), progress("reading") as show_line:
        tell = partial(_tell, show_line, monotonic(), budget)
        try:
            with Processes(count, "spawn") if count > 1 else nullcontext() as pool:
                verdict = run_diagnosis(loaded, executor=pool, solver=solver, budget=budget, report=tell)
                stopped = False
        except DiagnosisInterruptedError as interrupt:
            verdict, stopped = interrupt.verdict, True
        known: dict[str, Interval] = {}
        none = "not of what was interrupted, nor beside a law, which may do what they do"
        try:
            known = verdict.intervals(report=tell) if intervals else known
        except KeyboardInterrupt:
            stopped = True
        except InertanceError as error:
            none = str(error)
    wrote = []
    if json is not None:
        wrote.append(verdict.save(json))
    if report is not None:
        wrote.append(write_report(verdict, report))
    show(verdict, known)
    if intervals and not known:
        typer.echo(f"no intervals: {none}")
    for path in wrote:
        typer.echo(f"wrote {path}")
    if stopped:
        fail("interrupted before the end", INTERRUPTED)


def _tell(show_line: Callable[[str], object], begun: float, budget: float | None, line: str) -> None:
    """Show a line of progress, with the time that it took until there and what is left of the budget."""
    passed = monotonic() - begun
    left = f", {max(budget - passed, 0.0):.0f} s left" if budget is not None else ""
    show_line(f"{line} ({passed:.0f} s{left})")


def _print(console: CommandConsole, line: str, soft_wrap: bool = False) -> None:
    """Print a line as it is."""
    console.print(line, highlight=False, markup=False, soft_wrap=soft_wrap)


def show(verdict: Verdict, known: Mapping[str, Interval] = MappingProxyType({})) -> None:
    """Print a verdict: the sentence, the gap, the ranking and the lines that correct the model."""
    console = CommandConsole()
    console.print(f"[bold]{verdict.verdict}[/bold]: {escape(verdict.sentence)}", highlight=False)
    for name, gap in verdict.gap.items():
        _print(console, f"left of {name}: {gap.left}")
    if verdict.effects:
        _print(console, f"confidence: {verdict.assurance}")
    gaps = ("channel", "nominal", "refitted", "after", "noise")
    table = table_of(f"gap on the {verdict.evidence.judged}, NRMSE", gaps, words=("channel",))
    for name, gap in verdict.gap.items():
        table.add_row(name, *(f"{value:.4g}" for value in (gap.nominal, gap.refit, gap.after, gap.floor)))
    console.print(table)
    _show_counterfactual(console, verdict)
    off = f"by what they take off the squared residual of the {verdict.evidence.judged}"
    _show_ranking(console, f"effects fitted, {off}", verdict.ranking)
    _show_ranking(console, "effects fitted on top of what was found", verdict.further)
    _show_parameters(console, verdict)
    _show_intervals(console, known)
    told = [verdict.remainder] if verdict.remainder else []
    if verdict.law is not None:
        told.append(str(verdict.law))
    elif verdict.sought is not None:
        told.append(verdict.sought.active)
    told += [
        f"{placed.label}: the same motion as at {', '.join(placed.site.same)}, which no data part"
        for placed in verdict.effects
        if placed.site.same
    ]
    for line in told:
        _print(console, line)
    for line in verdict.lines:
        _print(console, f"  {_shortened(line)}", soft_wrap=True)
    for note in (*verdict.evidence.campaign.notes, *verdict.notes):
        _print(console, f"note: {note}")


def _shortened(line: str) -> str:
    """Return a line without the middle of a table, which the report and the JSON file hold."""
    if len(line) <= LONGEST_LINE:
        return line
    half = LONGEST_LINE // 2
    return f"{line[:half]} ... (all of it in the report) ... {line[-half:]}"


def _show_counterfactual(console: CommandConsole, verdict: Verdict) -> None:
    """Print how well the machine is predicted after its changes."""
    headings = ("record", "channel", "change", "refitted", "after", "noise", "after/noise")
    title = "the machine after a change, NRMSE of its prediction"
    table = table_of(title, headings, words=("record", "channel", "change"), overflow="fold")
    for one in verdict.counterfactual:
        values = (one.refit, one.after, one.floor, one.over_noise)
        numbers = ("-" if value is None else f"{value:.4g}" for value in values)
        table.add_row(one.record, one.channel, one.change, *numbers)
    if table.row_count:
        console.print(table)
    for problem in dict.fromkeys(f"{o.record}: {o.problem}" for o in verdict.counterfactual if o.problem):
        _print(console, problem)


def _show_ranking(console: CommandConsole, title: str, ranking: Sequence[Ranked]) -> None:
    """Print what effects do for the test runs, and what they were fitted to."""
    headings = ("effect", "site", "gain", "p", "parameters")
    table = table_of(title, headings, words=("effect", "site", "parameters"), overflow="fold")
    for column in table.columns[:2]:
        column.no_wrap = True
    for one in ranking:
        table.add_row(one.kind, one.site, f"{one.test_gain:.1%}", f"{one.p:.1g}", one.parameters)
    if table.row_count:
        console.print(table)


def _show_parameters(console: CommandConsole, verdict: Verdict) -> None:
    """Print what parameters and effects were fitted to, and how well that is known."""
    campaign, refitted = verdict.evidence.campaign, verdict.evidence.refit.parameters
    headings = ("parameter", "before", "refitted", "after", "±", "unit", "moved")
    title = "parameters, standard errors, and by how many deviations of the prior they moved"
    table = table_of(title, headings, words=("parameter", "unit"), overflow="fold")

    def row(name: str, numbers: Sequence[str], value: float, unit: str, moved: str) -> None:
        error = verdict.standard_errors.get(name)
        told = "" if error is None else f"{error:.2g}"
        table.add_row(name, *numbers, f"{value:.5g}", told, unit, moved)

    for name, value in verdict.parameters.items():
        prior = campaign.priors[name]
        numbers = [f"{number:.5g}" for number in (campaign.start[name], refitted[name])]
        moved = f"{prior.moved(value):.2g}" if prior.sd < float("inf") else "bounds only"
        row(name, numbers, value, campaign.machine.unit(name), moved)
    for own in verdict.evidence.own_values:
        row(f"{own.parameter} of {own.record}", ("", ""), own.value, own.unit, "")
    for placed in verdict.effects:
        for name, unit in placed.units(campaign).items():
            row(f"{placed.name}.{name}", ("", ""), placed.values[name], unit, "")
    if table.row_count:
        console.print(table)
    for line in verdict.ties:
        _print(console, line)


def _show_intervals(console: CommandConsole, known: Mapping[str, Interval]) -> None:
    """Print where parameters and effects may be."""
    table = table_of("95 % intervals", ("parameter", "from", "to"), words=("parameter",), overflow="fold")
    for name, interval in known.items():
        table.add_row(name, f"{interval.low:.5g}", f"{interval.high:.5g}")
    if table.row_count:
        console.print(table)
    for line in (line for name, interval in known.items() for line in interval.told(name)):
        _print(console, line)
