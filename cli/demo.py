"""`inertance demo`: the planetary flywheel inerter end to end, against a disk of equal inertance."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table
from rich.text import Text

from ..machines import ge_wang
from .demo_runs import INERTERS, TESTS, Cycle, Responses, last_cycle, random_tests
from .failure import WRONG_USE, fail
from .outputs import JSON, expect
from .terminal import CommandConsole, table_of

EXAMPLES = """\b
Examples:
  inertance demo
  inertance demo --out pictures

`inertance docs machines` tells more."""


def demo(
    out: Annotated[Path, typer.Option(help="Directory for the pictures.")] = Path("inertance-demo"),
) -> None:
    """Test a planetary flywheel inerter against a disk inerter, and say what the model of a rig lacks."""
    from .demo_diagnosis import diagnose_withheld
    from .demo_pictures import draw_cycles, draw_design_map, draw_responses

    console = CommandConsole()
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"--out: there can be no folder '{out}': {(error.strerror or str(error)).lower()}", WRONG_USE)
    expect("--out", out / "withheld.json", JSON)
    console.print(design_table())
    with console.status("Four sinusoidal tests of two inerters ..."):
        cycles = {name: [last_cycle(make, test) for test in TESTS] for name, make in INERTERS.items()}
    console.print(cycles_table(cycles))
    with console.status("Random displacement, 0.5 to 15 Hz ..."):
        responses = random_tests()
    console.print(responses_table(responses))
    for picture in (
        draw_cycles(out / "sinusoidal_tests.png", TESTS, cycles),
        draw_responses(out / "frequency_response.png", responses),
        draw_design_map(out / "design_map.png", ge_wang.GEOMETRY),
    ):
        console.print(f"wrote {picture}")
    diagnose_withheld(console, out)


def design_table() -> Table:
    """Return what the prototype's tables say about it."""
    mass = ge_wang.M_BRACKET + 4 * ge_wang.M_PLANET
    table = Table(title="Prototype of Ge & Wang", show_header=False)
    for row in (
        ("equivalent inertia J_e, eq. (7)", f"{ge_wang.J_E:.3e} kg.m2"),
        ("inertance b, eq. (2)", f"{ge_wang.B:.0f} kg"),
        ("mass of bracket and planets", f"{mass:.3f} kg"),
        ("saving against the disk of the source", f"{1 - mass / ge_wang.M_DISK:.1%}"),
        ("inertia per mass against a disk, eq. (15)", f"{ge_wang.GEOMETRY.gain:.3f}"),
    ):
        table.add_row(*row)
    return table


def cycles_table(cycles: dict[str, list[Cycle]]) -> Table:
    """Return force, inertance, energy and sticking of every test."""
    table = Table(
        title="Sinusoidal tests, one cycle",
        caption="Equivalent inertance is the force in phase with acceleration; – where friction prevails.",
    )
    table.add_column("displacement", no_wrap=True)
    table.add_column("inerter")
    for heading in ("greatest\nforce [N]", "equivalent\ninertance [kg]", "dissipated\n[J]", "stuck\n[%]"):
        table.add_column(Text(heading), justify="right")
    for i, test in enumerate(TESTS):
        for name, found in cycles.items():
            c = found[i]
            table.add_row(
                f"{1e3 * test.amplitude:g} mm, {test.frequency:g} Hz",
                name,
                f"{c.force:.0f}",
                f"{c.inertance:.1f}" if c.inertial else "–",
                f"{c.energy:.2f}",
                f"{100 * c.stuck:.1f}",
                end_section=name == "disk",
            )
    return table


def responses_table(responses: Responses) -> Table:
    """Return how far the planetary inerter's gain exceeds the disk's, by band."""
    headings = ("band, Hz", "least", "mean", "greatest")
    table = table_of("Gain |H|, planetary over disk", headings, words=("band, Hz",))
    for low, high in ((0.5, 1), (1, 2), (2, 5), (5, 15)):
        ratio = responses.ratio[(responses.f >= low) & (responses.f <= high)]
        figures = (ratio.min(), ratio.mean(), ratio.max())
        table.add_row(f"{low:g} to {high:g}", *(f"{value:.3f}" for value in figures))
    return table
