"""What a notebook shows of a network and of a result: compact HTML with inline SVG."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from ...base.html import MUTED_STYLE, folded, listed_notes, more, page, table, table_of_texts
from ...components.language import (
    MISSING,
    Component,
    Field,
    Option,
    Parameter,
    RealInput,
    Variable,
    parts_of,
    values_of,
)
from .chart import line_chart
from .network_drawing import svg_sketch
from .plotting import pretty_unit
from .summary import EVENT_HEADERS, STATE_HEADERS, event_rows, state_rows

if TYPE_CHECKING:
    from ..network import Network
    from .result import Result

MOST_STATES = 12
MOST_CHARTS = 4
MOST_ROWS = 40


def result_html(result: Result) -> str:
    """Return a run as HTML: charts of its states, statistics, start values, events and notes."""
    stats = result.stats
    title = (
        f"{result.time[0]:g} to {result.time[-1]:g} s · {len(result.time)} points · {stats['solver']} · "
        f"{stats['steps']} steps · {stats['events']} events · {stats['seconds']:.3g} s"
    )
    return page(
        result.name,
        title,
        f'<div style="display:flex;flex-wrap:wrap;gap:12px">{"".join(_charts(result))}</div>',
        listed_notes(result.notes),
        _rows("states", STATE_HEADERS, state_rows(result), len(result.initial)),
        _rows("events", EVENT_HEADERS, event_rows(result), len(result.events)),
    )


def network_html(network: Network) -> str:
    """Return a network as HTML: a sketch of what is joined, and its components with their values."""
    parts = parts_of(network)
    too_many = f'<span style="{MUTED_STYLE}">(no sketch of so many)</span>' if parts else ""
    return page(
        network.name,
        f"{len(parts)} components",
        f'<div style="overflow-x:auto">{svg_sketch(network) or too_many}</div>',
        _components(network),
    )


def _charts(result: Result) -> Iterator[str]:
    by_unit: dict[str, list[str]] = {}
    for name in result.dae.state_names[:MOST_STATES]:
        by_unit.setdefault(result.unit(name), []).append(name)
    for unit, names in list(by_unit.items())[:MOST_CHARTS]:
        yield line_chart(result.time, {name: result[name] for name in names}, pretty_unit(unit))


def _rows(what: str, headers: Sequence[str], rows: Sequence[Sequence[str]], count: int) -> str:
    """Return rows that fold away, with the number of those that are left out."""
    shown = table_of_texts(headers, rows) + more(count - len(rows))
    return folded(f"{count} {what}", shown) if rows else ""


def _components(*owners: Component) -> str:
    """Return the parts of the last owner as a table; the others enclose it."""
    parts = list(parts_of(owners[-1]).items())
    rows = [_component_row(name, part, owners) for name, part in parts[:MOST_ROWS]]
    return table(("name", "component", "values"), rows) + more(len(parts) - len(rows))


def _component_row(name: str, part: Component, owners: tuple[Component, ...]) -> tuple[str, str, str]:
    values = "; ".join(_values(part, owners))
    problems = "".join(f'<div style="color:#cc3311">{escape(problem)}</div>' for problem in part.problems())
    inside = folded(f"{len(parts_of(part))} parts", _components(*owners, part)) if parts_of(part) else ""
    return f"<b>{escape(name)}</b>", escape(type(part).__name__), values + problems + inside


def _values(part: Component, owners: tuple[Component, ...]) -> Iterator[str]:
    for name, field in type(part).fields.items():
        own = values_of(part).get(name, getattr(field, "default", None))
        value = _followed(own, owners)
        if value is MISSING or not (name in values_of(part) or isinstance(field, Parameter)):
            continue
        shown = f"{escape(name)} = {escape(_told(field, value))}"
        plain = name in values_of(part) and value is own
        yield shown if plain else f'<span style="{MUTED_STYLE}">{shown}</span>'


def _followed(value: Any, owners: tuple[Component, ...]) -> Any:
    """Return the value of a parameter that is bound to one of an enclosing component."""
    for owner in reversed(owners):
        if isinstance(value, Parameter) and type(owner).fields.get(value.name) is value:
            value = values_of(owner).get(value.name, value.default)
    return value


def _told(field: Field, value: Any) -> str:
    unit = pretty_unit(field.unit)
    if isinstance(field, Option):
        return repr(value)
    if isinstance(value, int | float):
        start = " at the start" if isinstance(field, Variable) else ""
        return f"{value:g} {unit}".rstrip() + start
    if isinstance(field, RealInput):
        return "function of time" if callable(value) else type(value).__name__
    return "follows from others" if callable(value) else repr(value)
