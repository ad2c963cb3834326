"""Documentation inside an FMU: what the model is, in a page of HTML, and the licences of its sources."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import astuple
from html import escape
from importlib import metadata
from pathlib import Path

from .model_description import ExportedModel, Rights
from .variables import Scalar

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{name}</title><style>
body {{ font: 15px/1.45 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }}
table {{ border-collapse: collapse; width: 100%; margin-bottom: 2em; }}
th, td {{ text-align: left; padding: .2em .8em .2em 0; border-bottom: 1px solid #ddd; }}
th:nth-child(3), td:nth-child(3) {{ text-align: right; }}
</style></head>
<body>
<h1>{name}</h1>
<p>A network of 1-D mechanics, exported by inertance {version} as FMI {fmi}, for Model Exchange and
Co-Simulation. All numbers are in SI units. {counts}</p>
{rights}
<p>Parameters and start values of states may be set before and during initialization; parameters also at
events and between communication steps. Inputs are held, or go on with the derivatives given for them, over a
communication step. Co-Simulation integrates {stepping}.</p>
{tables}
<p>Licences of the program: <a href="licenses/license.txt">licenses/license.txt</a>.</p>
</body>
</html>
"""
_NOTICE = """This FMU was exported by inertance. Its model is its author's{terms}. Its program is made of:

1. The runtime of inertance (core and FMI functions), BSD-3-Clause: see below.
2. The FMI header files of the Modelica Association Project "FMI" (sources/fmi*.h), 2-Clause BSD: the licence
   stands in each of these files.
3. Expressions of the model written as C by CasADi (sources/model.c), on which CasADi's authors make no claim.
   CasADi itself is under the LGPL, version 3 or later, and is no part of this FMU. What it copies into code
   it generates comes from casadi/core/runtime, under MIT No Attribution (MIT-0), copyright 2010-2023 Joel
   Andersson, Joris Gillis, Moritz Diehl, KU Leuven.

----------------------------------------------------------------------------------------------------------------

"""


def page(model: ExportedModel, fmi_version: str) -> str:
    """Return documentation/index.html."""
    face = model.interface
    groups = {
        "Inputs": [s for s in face.scalars if s.causality == "input"],
        "Outputs": face.outputs,
        "Parameters": [s for s in face.scalars if s.causality == "parameter"],
        "States": face.scalars[face.states.start : face.states.stop],
    }
    stepping = "with error control, at the tolerance of the experiment"
    if model.fixed_step:
        stepping = f"in equal steps of {model.fixed_step:g} s at most, without error control"
    return _PAGE.format(
        name=escape(model.name),
        version=escape(model.version),
        fmi=fmi_version,
        counts=f"{len(face.states)} states, {len(face.indicators)} event indicators.",
        stepping=stepping,
        rights="\n".join(_rights(model.rights)),
        tables="\n".join(_table(title, scalars) for title, scalars in groups.items() if scalars),
    )


def _rights(rights: Rights) -> Iterator[str]:
    names = ("Author", "Version", "Copyright", "Licence of the model")
    for name, text in zip(names, astuple(rights), strict=True):
        if text:
            yield f"<p>{name}: {escape(text)}</p>"


def _table(title: str, scalars: Iterable[Scalar]) -> str:
    head = "<tr><th>name</th><th>what it is</th><th>start</th><th>unit</th></tr>"
    return "\n".join([f"<h2>{title}</h2>\n<table>\n{head}", *map(_row, scalars), "</table>"])


def _row(scalar: Scalar) -> str:
    start = "" if scalar.start is None else f"{scalar.start:.6g}"
    cells = (scalar.name, scalar.doc, start, "" if scalar.unit == "1" else scalar.unit)
    return f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>"


def licences(rights: Rights) -> str:
    """Return documentation/licenses/license.txt: what the program is made of, and on which terms."""
    terms = f", who licenses it under: {rights.license}" if rights.license else ""
    notice = _NOTICE.format(terms=terms)
    beside = Path(__file__).parents[2] / "LICENSE"
    if beside.is_file():
        return notice + beside.read_text(encoding="utf-8")
    own = next(f for f in metadata.files("inertance") or () if f.name == "LICENSE")
    return notice + own.read_text(encoding="utf-8")
