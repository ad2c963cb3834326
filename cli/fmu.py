"""`inertance fmu`: networks as FMUs, FMUs checked and looked into."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from ..base import write_text, writing
from ..components import ModelError
from ..networks import Network
from .arguments import GivenInputs, Model, StartValues, load_network, pairs, told
from .data import Inputs, driven, given_inputs, read_inputs
from .failure import FAILED, WRONG_USE, clean, fail, failing
from .outputs import JSON, expect
from .terminal import progress

EXAMPLES = """\b
Examples:
  inertance fmu export car.py:build car.fmu --fmi 3.0
  inertance fmu export car.py:build car.fmu --stop 10 --step 0.01 --output 'body.*'
  inertance fmu export car.py:build car.fmu --platform x86_64-windows --platform native
  inertance fmu check car.py:build --stop 2
  inertance fmu check car.py:build --input road.csv
  inertance fmu check pump.fmu
  inertance fmu info pump.fmu
  inertance fmu import-test pump.fmu --stop 5 --input speed=150 --out pump.csv
  inertance fmu import-test pump.fmu --input record.csv

MODEL is path/to/file.py:function that returns a Network. Values are in SI units.
`inertance docs fmu` and `inertance docs fmu-import` tell more."""

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    epilog=EXAMPLES,
    context_settings={"help_option_names": ["-h", "--help"]},
)
File = Annotated[Path, typer.Argument(metavar="FILE", help="An .fmu file.")]
Timeout = Annotated[float, typer.Option(help="Longest time [s] that the FMU may take for a call or section.")]


def export(
    model: Model,
    out: Annotated[Path, typer.Argument(metavar="FILE", help="The .fmu file to write.")],
    fmi: Annotated[str, typer.Option(help="FMI version: 2.0 or 3.0.")] = "2.0",
    output: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="An output; * stands for any part of a name.")
    ] = None,
    data: Annotated[
        list[str] | None,
        typer.Option("--input", metavar="NAME", help="An input that has a signal, to be given from outside."),
    ] = None,
    start: StartValues = None,
    terminal: Annotated[
        list[str] | None,
        typer.Option(metavar="FLANGE=CAUSALITY", help="Publish a flange: force-in or motion-in."),
    ] = None,
    platform: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="native, x86_64-linux, aarch64-linux, x86_64-windows, ..."),
    ] = None,
    stop: Annotated[float, typer.Option(help="End of the default experiment [s].")] = 1.0,
    step: Annotated[float, typer.Option(help="Communication step that suits the model [s].")] = 1e-3,
    tolerance: Annotated[float, typer.Option(help="Of Co-Simulation, where the tool gives none.")] = 1e-6,
    fixed_step: Annotated[float | None, typer.Option(help="Own step of Co-Simulation [s].")] = None,
    sources: Annotated[bool, typer.Option(help="Whether the C sources go along.")] = True,
    author: Annotated[str, typer.Option(help="Whose model it is.")] = "",
    version: Annotated[str, typer.Option(help="Of the model.")] = "",
    copyright: Annotated[str, typer.Option(help="Notice of the model.")] = "",
    license: Annotated[str, typer.Option(help="Of the model: proprietary, CC-BY-4.0, ...")] = "",
) -> None:
    """Write the network that a function of a Python file returns as an FMU."""
    from ..fmu import export_fmu as write

    if out.suffix != ".fmu":
        fail(f"an FMU is written to a file that ends in '.fmu', got '{out}'", WRONG_USE)
    expect("FILE", out, ())
    network = load_network(model)
    with failing(WRONG_USE, ModelError):
        write(
            network, out, fmi_version=fmi, outputs=output or None, inputs=data or (), stop=stop, step=step,
            start=pairs("--start", start),
            terminals=dict(_texts("--terminal", terminal)), platforms=platform or ["native"], sources=sources,
            tolerance=tolerance, fixed_step=fixed_step, author=author, version=version, copyright=copyright,
            license=license,
        )  # fmt: skip
    typer.echo(f"wrote {out} ({out.stat().st_size / 1e3:.0f} kB)")


def check(
    subject: Annotated[
        str, typer.Argument(metavar="MODEL|FILE", help="path/to/file.py:function, or an .fmu file.")
    ],
    stop: Annotated[float | None, typer.Option(help="End time [s]; 1 s, or what the FMU suggests.")] = None,
    step: Annotated[float | None, typer.Option(help="Output and communication step [s].")] = None,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance of Co-Simulation.")] = 1e-6,
    limit: Annotated[
        float | None, typer.Option(help="How far variables may differ, as a share of their size.")
    ] = None,
    start: StartValues = None,
    data: GivenInputs = None,
    fmi: Annotated[list[str] | None, typer.Option(help="Versions to check a network as; both.")] = None,
    isolated: Annotated[bool, typer.Option(help="Run the binary of a file in a process of its own.")] = True,
    timeout: Timeout = 300.0,
    report: Annotated[Path | None, typer.Option("--json", help="Write the findings as JSON.")] = None,
) -> None:
    """Check a network against its FMUs, or any FMU against itself; the exit code tells.

    A table of --input becomes the signals of a network, in its FMUs as well; an FMU alone takes constants.
    """
    from ..fmu import VERSIONS
    from ..fmu import check_fmu as look

    starts = pairs("--start", start)
    expect("--json", report, JSON)
    model: Path | Network
    if subject.endswith(".fmu"):
        if tables := [text for text in data or () if "=" not in text]:
            fail(
                f"--input {tables[0]}: an FMU alone is checked under constants, NAME=VALUE; "
                f"`inertance fmu import-test {subject} --input {tables[0]}` runs it on a table",
                WRONG_USE,
            )
        model, inputs = Path(subject), pairs("--input", data)
    else:
        model = load_network(subject)
        with failing(WRONG_USE, ModelError):
            inputs, end = driven(model, data or ())
        stop = end if stop is None else stop
    with failing(WRONG_USE, ModelError):
        result = look(
            model, stop, step=step, tolerance=tolerance, limit=limit, start=starts, inputs=inputs,
            versions=fmi or VERSIONS, isolated=isolated, timeout=timeout,
            found=lambda one: typer.echo(f"{one.word:<7} {one.subject} {one.check}", err=True),
        )  # fmt: skip
    if report is not None:
        write_text(report, json.dumps(result.to_dict(), indent=1))
    typer.echo(result)
    if not result.passed:
        raise typer.Exit(FAILED)


def info(file: File) -> None:
    """Tell what an FMU says of itself; nothing of it is run."""
    from ..fmu import FMU

    typer.echo(FMU(file, validate=False).info())


def import_test(
    file: File,
    stop: Annotated[float | None, typer.Option(help="End time [s]; what the FMU suggests.")] = None,
    step: Annotated[float | None, typer.Option(help="Output and communication step [s].")] = None,
    kind: Annotated[str | None, typer.Option(help="ME or CS; ME first if it has both.")] = None,
    data: GivenInputs = None,
    values: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Set a parameter.")
    ] = None,
    isolated: Annotated[bool, typer.Option(help="Run the binary in a process of its own.")] = True,
    timeout: Timeout = 60.0,
    validate: Annotated[
        bool, typer.Option(help="Whether to refuse a description that its schema does not allow.")
    ] = True,
    out: Annotated[Path | None, typer.Option(help="Write outputs and states to a .csv file.")] = None,
) -> None:
    """Run an FMU alone, as it would run within a network, and tell what came of it."""
    from ..fmu import FMU

    expect("--out", out, [".csv"])
    fmu = FMU(file, isolated=isolated, timeout=timeout, validate=validate)
    parameters = pairs("--set", values)
    with failing(WRONG_USE, ModelError):
        constant, table = given_inputs(data or (), Inputs.of_fmu(fmu))
        recorded = {} if table is None else read_inputs(table, Inputs.of_fmu(fmu), others=constant)
    times = [signal.time for signal in recorded.values()]
    begin = float(times[0][0]) if times else None
    end = float(times[0][-1]) if times and stop is None else stop
    with progress("reading") as tell:
        tell(f"running {fmu!r}")
        run = fmu.simulate(
            end, begin=begin, step=step, kind=kind, inputs=constant | recorded, parameters=parameters
        )
    if out is not None:
        with writing(out) as part:
            run.to_dataframe().to_csv(part, encoding="utf-8")
    typer.echo(f"{fmu!r}: to {run.time[-1]:g} s in {run.stats['seconds']:.2g} s, {len(run.events)} events")
    for name in run.names():
        if name != "time":
            signal, unit = run[name], run.unit(name)
            span = f"{signal.min():.6g} to {signal.max():.6g}, at the end {signal[-1]:.6g}"
            typer.echo(f"  {name}: {span}{unit and f' {unit}'}")
    for note in (*fmu.notes, *run.notes):
        typer.echo(f"  note: {note}")
    if out is not None:
        typer.echo(f"wrote {out}")


def _texts(option: str, texts: Iterable[str] | None) -> Iterable[tuple[str, str]]:
    for text in texts or ():
        name, equals, value = text.partition("=")
        if not equals:
            fail(f"{option} takes FLANGE=CAUSALITY, got '{text}'", WRONG_USE)
        yield name.strip(), value.strip()


app.command("export", epilog=told("fmu"))(clean(export))
app.command("check", epilog=told("fmu"))(clean(check))
app.command("info", epilog=told("fmu-import"))(clean(info))
app.command("import-test", epilog=told("fmu-import"))(clean(import_test))
