"""Elements: what a component declares and states, as lines of a Modelica class."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import casadi as ca

from ..base import ModelError
from ..components import Component
from ..components.language import (
    Field,
    ModeField,
    Parameter,
    Port,
    RealInput,
    RealOutput,
    Template,
    Transition,
    Variable,
    is_there,
)
from .expressions import Printer
from .names import identifier, quoted, reference, unit

ROUNDING = 1e-9  # [m/s, rad/s]


@dataclass
class Lines:
    """Declarations and equations of a class, and the kinds of connectors it has."""

    declarations: list[str] = field(default_factory=list)
    equations: list[str] = field(default_factory=list)
    connectors: dict[str, Port | RealInput | RealOutput] = field(default_factory=dict)


def element_lines(component: Component, template: Template, where: str) -> Lines:
    """Return the lines of a component's own fields and equations; of its parts, none."""
    if any(transition.shock is not None for transition in template.transitions):
        raise ModelError(
            f"{where} lets a shock act, an impulse through all that is rigidly joined, which Modelica has no "
            "equation for; take an element that gives way (ElastoGap, Backlash), or export an FMU"
        )
    lines = Lines()
    moving = {transition.mode for transition in template.transitions}
    moving |= {name for transition in template.transitions for name in transition.reset}
    for name, declared in type(component).fields.items():
        if is_there(component, declared):
            lines.declarations += _declared(declared, identifier(name), name in moving, lines)
    printer = _printer(template)
    lines.equations += [
        f"{reference(a)} = {'-' * (sign < 0)}{reference(b)};" for a, b, sign in template.aliases
    ]
    lines.equations += [f"{printer.equation(residual)};" for residual in template.residuals]
    for mode in template.modes:
        lines.equations += _whens(template, mode, printer)
    return lines


def connector_kind(declared: Port | RealInput | RealOutput) -> str:
    """Return which connector it is; signals are numbers, those that are on or off as well."""
    signals = (kind for kind in (RealInput, RealOutput) if isinstance(declared, kind))
    return next(signals, type(declared)).__name__


def _declared(declared: Field, name: str, moves: bool, lines: Lines) -> Iterator[str]:
    told, measure = quoted(declared.doc), unit(declared.unit)
    if isinstance(declared, Port | RealInput | RealOutput):
        kind = connector_kind(declared)
        lines.connectors[kind] = declared
        yield f"{kind} {name}{f'({measure})' if measure and not isinstance(declared, Port) else ''} {told};"
    elif isinstance(declared, Parameter):
        yield f"parameter Real {name}{f'({measure})' if measure else ''} {told};"
    elif isinstance(declared, Variable):
        choice = "always" if moves else declared.state  # what is set at events must be a state
        preference = f"stateSelect=StateSelect.{choice}" if choice != "default" else ""
        attributes = ", ".join(filter(None, (measure, preference)))
        yield f"Real {name}{f'({attributes})' if attributes else ''} {told};"
    elif isinstance(declared, ModeField):
        values = ", ".join(f"{k}: {value}" for k, value in enumerate(declared.values))
        if moves:
            yield f"Integer {name}(start=0, fixed=true) {quoted(values)};"
        else:
            yield f"parameter Integer {name} = 0 {quoted(values)};"


def _printer(template: Template) -> Printer:
    symbols = {**template.variables, **template.parameters, **template.modes}
    names = {symbol.element_hash(): reference(name) for name, symbol in symbols.items()}
    names[template.time.element_hash()] = "time"
    names |= {symbol.element_hash(): "0" for symbol in template.impulses.values()}
    return Printer(names, frozenset(symbol.element_hash() for symbol in template.modes.values()))


def _whens(template: Template, mode: str, printer: Printer) -> Iterator[str]:
    """Yield the transitions of one mode, the first that is due goes first."""
    name, word = identifier(mode), "when"
    for transition in template.transitions:
        if transition.mode != mode:
            continue
        indicator = transition.indicator - _rounding(template, transition)
        conditions = [f"pre({name}) == {transition.source}", f"({_positive(indicator, printer)})"]
        if transition.allowed is not None:
            conditions.append(f"({printer.truth(transition.allowed)})")
        yield f"{word} {' and '.join(conditions)} then"
        yield f"  {name} = {transition.target};"
        for variable, value in transition.reset.items():
            yield f"  reinit({reference(variable)}, {printer.number(value)});"
        word = "elsewhen"
    if word == "elsewhen":
        yield "end when;"


def _rounding(template: Template, transition: Transition) -> float:
    """Return by how much a variable must leave zero in a mode whose equations keep it there.

    What is exactly zero in a native run is zero but for rounding where another tool integrates its rate.
    """
    x = transition.indicator
    x = x.dep(0) if x.n_dep() and x.op() == ca.OP_NEG else x
    rate = template.derivatives.get(template.name_of(x) or "", "")
    known = {rate} | {name for a, b, _ in template.aliases if rate in (a, b) for name in (a, b)}
    place = transition.mode, transition.source
    held = {name for name, *where in template.held if tuple(where) == place}
    return ROUNDING if known & held else 0.0


def _positive(indicator: Any, printer: Printer) -> str:
    if indicator.n_dep() and indicator.op() == ca.OP_NEG:
        return f"{printer.number(indicator.dep(0))} < 0"
    left, _, right = printer.equation(indicator).rpartition(" = ")
    return f"{left} > {right}"
