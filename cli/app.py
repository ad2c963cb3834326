"""The commands and what they have in common."""

from __future__ import annotations

from typing import Annotated

import typer

from . import cache, components, demo, design, diagnose, docs, fit, fmu, modelica, new, run
from .failure import clean

EXAMPLES = """\b
Examples:
  inertance new rig DIR                    a network to begin with
  inertance docs                           the documentation
  inertance demo                           the planetary flywheel inerter, end to end
  inertance components                     what there is to build with
  inertance components Spring              its equation, ports, parameters, an example
  inertance run model.py:build --stop 5    run the network that build() returns
  inertance fmu export model.py:build a.fmu  the network for other tools
  inertance fmu check model.py:build       is the FMU what the network is?
  inertance modelica model.py:build --out a.mo  as Modelica text
  inertance diagnose campaign.toml         what parts measurement and model
  inertance design campaign.toml --out next.csv  the experiment that tells most
  inertance run --help                     data in, results and plots out
  inertance cache                          the compiled models that are kept

\b
Exit codes: 0 good, 1 a check or a run failed, 2 wrong use, 130 interrupted."""

app = typer.Typer(
    name="inertance",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    epilog=EXAMPLES,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command(epilog=demo.EXAMPLES)(clean(demo.demo))
app.command(epilog=components.EXAMPLES)(clean(components.components))
app.command(epilog=run.EXAMPLES)(clean(run.run))
app.command(epilog=fit.EXAMPLES)(clean(fit.fit))
app.command(epilog=diagnose.EXAMPLES)(clean(diagnose.diagnose))
app.command(epilog=design.EXAMPLES)(clean(design.design))
app.command(epilog=modelica.EXAMPLES)(clean(modelica.modelica))
app.command(epilog=docs.EXAMPLES)(clean(docs.docs))
app.command(epilog=cache.EXAMPLES)(clean(cache.cache))
app.add_typer(new.app, name="new", help="A commented template that runs: a rig, a campaign, a component.")
app.add_typer(fmu.app, name="fmu", help="FMUs: export, check, look into, run.")


def _print_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"inertance {version('inertance')}")
        raise typer.Exit


@app.callback()
def main(
    version: Annotated[
        bool,
        typer.Option("--version", help="Print the version.", is_eager=True, callback=_print_version),
    ] = False,
) -> None:
    """Acausal 1-D mechanics: join elements at flanges, run the machine."""
