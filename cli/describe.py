"""Everything about one component, as tables on the terminal."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from operator import attrgetter
from typing import Any

import casadi as ca
from rich.table import Table
from rich.text import Text

from ..components import Component
from ..components.language import (
    MISSING,
    Derived,
    Impulse,
    ModeField,
    Option,
    Parameter,
    Part,
    Port,
    RealInput,
    RealOutput,
    Variable,
)
from .catalogue import all_names, first_line, full_name, is_base, namesakes
from .sketch import sketch
from .terminal import CommandConsole
from .usage import usage

Rows = list[tuple[str, ...]]
FieldRow = Callable[[Any], tuple[str, ...]]


def describe(full: str) -> None:
    """Print the equation, ports, parameters, variables, modes and an example of a component."""
    kind = all_names()[full]
    console = CommandConsole(highlight=False, markup=False)
    console.print(Text(full, style="bold"))
    console.print(inspect.getdoc(kind) or "")
    console.print(Text(f"\n{sketch(kind)}\n"))
    for base in kind.__mro__[1:]:
        if issubclass(base, Component) and base is not Component and not base.__name__.startswith("_"):
            console.print(Text(f"builds on {base.__name__}: {first_line(base)}", style="dim"))
    for title, headers, field_kind, row in SECTIONS:
        fields = [f for f in kind.fields.values() if isinstance(f, field_kind)]
        if fields:
            console.print(_table(title, headers, [row(field) for field in fields]))
    if is_base(kind):
        console.print("\nA base: derive an element from it and yield the equations it lacks.")
    else:
        console.print(Text("\nexample", style="bold"))
        console.print(usage(kind), soft_wrap=True)
    if others := namesakes(full):
        console.print(Text(f"\nsee also {', '.join(others)}", style="dim"))


def _table(title: str, headers: tuple[str, ...], rows: Rows) -> Table:
    table = Table(
        title=f"\n{title}", title_justify="left", title_style="bold", box=None, pad_edge=False,
        header_style="dim",
    )  # fmt: skip
    for header in headers:
        table.add_column(header, overflow="fold", no_wrap=header == "name")
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    return table


def _port(port: Port) -> tuple[str, ...]:
    across, through = (
        f"{name} [{unit}]" for name, unit in zip((port.across, port.through), port.units, strict=True)
    )
    left_open = (
        " (grounded when left unconnected)" if port.optional else " (may stay free)" if port.free else ""
    ) + _with(port)
    return port.name, port.domain, across, through, port.doc + left_open


def _with(field: Port | RealInput) -> str:
    return f" (with {field.when}=True)" if field.when else ""


def _parameter(parameter: Parameter) -> tuple[str, ...]:
    return parameter.name, parameter.unit, _default(parameter), _range(parameter), parameter.doc


def _option(option: Option) -> tuple[str, ...]:
    choices = "any" if option.choices is None else ", ".join(map(repr, option.choices))
    return option.name, repr(option.default), choices, option.doc


def _part(part: Part) -> tuple[str, ...]:
    return part.name, full_name(type(part.default)), first_line(type(part.default))


def _default(parameter: Parameter) -> str:
    if parameter.default is MISSING:
        return "required"
    if not callable(parameter.default):
        return f"{parameter.default:g}"
    try:
        return str(parameter.default(_Symbols()))
    except (TypeError, AttributeError):
        return "follows from others"


class _Symbols:
    """A component as the formula of a default sees it: every name a symbol."""

    def __getattr__(self, name: str) -> Any:
        return ca.SX.sym(name)


def _range(parameter: Parameter) -> str:
    bounds = ((parameter.min, "≥"), (parameter.above, ">"), (parameter.max, "≤"))
    return ", ".join(f"{sign} {bound:g}" for bound, sign in bounds if bound is not None) or "any"


_signal, _variable = attrgetter("name", "unit", "kind", "doc"), attrgetter("name", "unit", "doc")
SECTIONS: tuple[tuple[str, tuple[str, ...], Any, FieldRow], ...] = (
    ("ports", ("name", "kind", "across", "through", ""), Port, _port),
    ("signals", ("name", "unit", "kind", ""), RealInput | RealOutput, _signal),
    ("parameters", ("name", "unit", "default", "range", ""), Parameter, _parameter),
    ("options", ("name", "default", "choices", ""), Option, _option),
    ("variables", ("name", "unit", ""), Variable, _variable),
    ("derived", ("name", "unit", ""), Derived, _variable),
    ("modes", ("name", "values", ""), ModeField, lambda mode: (mode.name, ", ".join(mode.values), mode.doc)),
    ("impulses", ("name", "unit", ""), Impulse, _variable),
    ("parts", ("name", "component", ""), Part, _part),
)
