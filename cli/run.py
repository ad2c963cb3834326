"""`inertance run`: simulate the network of a Python file."""

from __future__ import annotations

from json import dumps
from pathlib import Path
from typing import Annotated, Any

import typer

from ..base import write_text
from ..components import ModelError, RunInterruptedError, SimulationError
from ..networks import DAE, Result, check_table_path, matching_signals, simulate
from .arguments import SOLVER_NAMES, GivenInputs, Model, StartValues, load_network, pairs
from .data import Inputs, given_inputs, read_inputs
from .failure import FAILED, INTERRUPTED, WRONG_USE, fail, failing
from .outputs import JSON, PICTURES, draw, expect

DEFAULT_STOP = 10.0
EXAMPLES = """\b
Examples:
  inertance run car.py:build --stop 5
  inertance run car.py:build --set strut.damper.d=300 --start body.s=0.01
  inertance run car.py:build --input road.csv --out run.csv --signals 'body.*,strut.f'
  inertance run car.py:build --input road.s_ref=0 --start body.v=0.1 --json run.json
  inertance run car.py:build --plot body.s,body.a

NAMES are separated by commas; a * stands for any part of a name. Values are in SI units.

A file for --input has a header such as "time,road.s_ref" (or "time [s],road.s_ref [m]") and lines of
numbers; its time increases. Through them goes a smooth curve; what a digital controller
sends and holds is named in --hold, '*' for all.

`inertance docs networks` tells more."""


def run(
    model: Model,
    stop: Annotated[float | None, typer.Option(help="End time [s]; the end of the data, or 10 s.")] = None,
    step: Annotated[float | None, typer.Option(help="Output interval [s]; a 500th of the run.")] = None,
    rtol: Annotated[float, typer.Option(help="Relative tolerance.")] = 1e-6,
    solver: Annotated[str, typer.Option(help=SOLVER_NAMES)] = "auto",
    data: GivenInputs = None,
    hold: Annotated[
        str | None,
        typer.Option(metavar="NAMES", help="Inputs of the table that keep each sample until the next."),
    ] = None,
    values: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a parameter.")
    ] = None,
    start: StartValues = None,
    out: Annotated[Path | None, typer.Option(help="Write signals to a .csv, .parquet or .npz file.")] = None,
    signals: Annotated[
        str | None, typer.Option(metavar="NAMES", help="What --out and --json tell; the states if not given.")
    ] = None,
    json: Annotated[
        Path | None, typer.Option(help="Write states, events, statistics and notes to a .json file.")
    ] = None,
    plot: Annotated[
        str | None, typer.Option(metavar="NAMES", help="Draw signals into a .png beside the results.")
    ] = None,
) -> None:
    """Run the network that a function of a Python file returns."""
    for name, value in {"--step": step, "--rtol": rtol}.items():
        if value is not None and not value > 0:
            fail(f"{name} must be above 0, got {value:g}", WRONG_USE)
    parameters, starts = pairs("--set", values), pairs("--start", start)
    if out is not None:
        with failing(WRONG_USE, ValueError, ImportError):
            check_table_path(out)
        if any(out.resolve() == Path(given).resolve() for given in data or ()):
            fail(f"--out {out} would overwrite what --input reads; choose another name", WRONG_USE)
    elif signals is not None and json is None:
        fail(
            "--signals says what --out writes and --json tells; give --out FILE or --json FILE, too",
            WRONG_USE,
        )
    expect("--json", json, JSON)
    picture = out.with_suffix(".png") if out else Path(f"{Path(model.rpartition(':')[2]).name}.png")
    if plot is not None:
        expect("--plot", picture, PICTURES)
    dae = load_network(model).dae()
    wanted, drawn = _signals(dae, signals), _signals(dae, plot)
    arguments = _span_and_inputs(dae, data or [], stop, _parts(hold)) | {
        "step": step, "rtol": rtol, "solver": solver, "parameters": parameters, "start": starts,
    }  # fmt: skip
    with failing(WRONG_USE, ModelError):
        result, failure, code = _simulated(dae, arguments)
    wrote = [] if out is None else [result.save(out, *wanted)]
    if json is not None:
        wrote.append(
            write_text(json, dumps(result.to_dict(*wanted) | {"failure": failure or None}, indent=1) + "\n")
        )
    if drawn:
        wrote.append(draw(result.plot(*drawn), picture))
    typer.echo(result.summary())
    for path in wrote:
        typer.echo(f"wrote {path}")
    if failure:
        fail(failure, code)


def _simulated(dae: DAE, arguments: dict[str, Any]) -> tuple[Result, str, int]:
    """Return what was computed, why it was not finished, and the exit code."""
    try:
        return simulate(dae, **arguments), "", 0
    except SimulationError as error:
        if not isinstance(error.result, Result):
            raise
        return error.result, str(error), FAILED
    except RunInterruptedError as error:
        return error.result, str(error), INTERRUPTED


def _signals(dae: DAE, names: str | None) -> list[str]:
    with failing(WRONG_USE, KeyError):
        return matching_signals(dae, _parts(names))


def _parts(names: str | None) -> list[str]:
    """Return names that are separated by commas."""
    return [name.strip() for name in (names or "").split(",") if name.strip()]


def _span_and_inputs(dae: DAE, data: list[str], stop: float | None, held: list[str]) -> dict[str, Any]:
    with failing(WRONG_USE, ValueError, ImportError):
        inputs = Inputs.of_network(dae)
        constant, table = given_inputs(data, inputs)
        recorded = {} if table is None else read_inputs(table, inputs, held, constant)
    if table is None:
        if held:
            fail("--hold says which inputs of a table are held; give --input FILE too", WRONG_USE)
        unbound = sorted(inputs.needed.keys() - constant)
        if unbound:
            told = ", ".join(f"'{name}' [{inputs.needed[name]}]" for name in unbound)
            header = ",".join(["time", *unbound])
            fail(
                f"no signal for {told}; give --input FILE.csv with the header {header}, "
                f"or --input {unbound[0]}=VALUE",
                WRONG_USE,
            )
        return {"stop": DEFAULT_STOP if stop is None else stop, "inputs": constant}
    time = next(iter(recorded.values())).time
    if stop is not None and stop > time[-1]:
        fail(f"--stop {stop:g} s is after the last sample of {table}, {time[-1]:g} s", WRONG_USE)
    end = float(time[-1]) if stop is None else stop
    return {"begin": float(time[0]), "stop": end, "inputs": constant | recorded}
