"""`inertance new`: a commented template that runs."""

from __future__ import annotations

from pathlib import Path
from shutil import copyfile
from typing import Annotated

import numpy as np
import typer

from ..base import check_output, write_text
from ..components import ModelError, Sampled
from ..networks import load_model
from .arguments import told
from .failure import WRONG_USE, clean, fail, failing

TEMPLATES = Path(__file__).with_name("templates")
EXAMPLES = """\b
Examples:
  inertance new rig car           a network: elements, nodes, a run
  inertance new campaign bench    measurements of a rig, to be fitted and diagnosed
  inertance new component strut   an element of your own, tried and checked

Files that are there already are left alone.

`inertance docs tutorials` tells more."""

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    epilog=EXAMPLES,
    context_settings={"help_option_names": ["-h", "--help"]},
)
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="The folder to write to; it is made if need be.")]


def rig(folder: Folder) -> None:
    """Write a network to begin with."""
    _write("rig", folder)
    _next(f"inertance run {folder / 'rig.py'}:build")


def component(folder: Folder) -> None:
    """Write an element of your own to begin with, and a network that tries it."""
    _write("component", folder)
    _next(f"inertance run {folder / 'component.py'}:build")


def campaign(folder: Folder) -> None:
    """Write a model, records that stand in for yours, and the campaign that compares them."""
    _write("campaign", folder, "train.csv", "test.csv")
    for name, seed in {"train.csv": 1, "test.csv": 2}.items():
        typer.echo(f"wrote {write_text(folder / name, _record(folder, seed))}")
    _next(f"inertance fit {folder / 'campaign.toml'}")


def _write(template: str, folder: Path, *further: str) -> None:
    """Copy the files of a template, unless one of them, or of the further ones, is there."""
    names = sorted(path.name for path in (TEMPLATES / template).iterdir() if path.is_file())
    for name in (*names, *further):
        if (folder / name).exists():
            fail(f"{folder / name} is there already; name another folder", WRONG_USE)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"'{folder}' cannot be made: {(error.strerror or str(error)).lower()}", WRONG_USE)
    for name in names:
        check_output(folder / name)
        copyfile(TEMPLATES / template / name, folder / name)
        typer.echo(f"wrote {folder / name}")


def _next(command: str) -> None:
    typer.echo(f"\nnow try: {command}")


def _record(folder: Path, seed: int) -> str:
    """Return a record of the model with another spring and another damper, with noise, as text."""
    random = np.random.default_rng(seed)
    time = np.arange(0.0, 10.0, 0.01)
    waves = [np.sin(2 * np.pi * (f * time + random.random())) / f for f in (0.5, 1.1, 1.7, 2.3, 3.1)]
    motion = np.round(3.0 * np.sum(waves, axis=0) * np.minimum(time, 1.0), 4)  # mm
    with failing(WRONG_USE, ModelError):
        run = load_model(f"{folder / 'rig.py'}:build").simulate(
            time[-1], step=0.01, inputs={"shaker.s_ref": Sampled(time, motion / 1e3)},
            parameters={"spring.k": 1150.0, "damper.d": 14.0}, progress=False,
        )  # fmt: skip
    measured = np.interp(time, run.time, run["body.a"]) + 0.02 * random.standard_normal(len(time))
    rows = (f"{t:.2f},{x:.4f},{a:.4f}" for t, x, a in zip(time, motion, measured, strict=True))
    return "\n".join(["time,x [mm],a [m/s2]", *rows, ""])


app.command("rig", epilog=told("networks"))(clean(rig))
app.command("campaign", epilog=told("identification"))(clean(campaign))
app.command("component", epilog=told("write-your-own-component"))(clean(component))
