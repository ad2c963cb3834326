"""From a component class to symbols: its equations are read once and shared by all its instances.

While `equations` and `transitions` run, `self` is a `Scope`: every declared variable, parameter and
mode is a CasADi SX symbol there. What they yield becomes a `Template`: residuals over a list of
local symbols, and the plain equalities between variables (aliases) apart from them.
"""

from __future__ import annotations

import types
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import casadi as ca

from .component import Component
from .errors import ModelError, nearest
from .fields import (
    Field,
    Impulse,
    Mode,
    Option,
    Part,
    Port,
    RealInput,
    RealOutput,
    Variable,
)

_reading: ContextVar[Template] = ContextVar("template being read")


@dataclass(frozen=True)
class Shock:
    """An impulse that sets a velocity at once: (impulse, velocity, velocity afterwards)."""

    impulse: Any
    velocity: Any
    after: Any


@dataclass(frozen=True)
class Transition:
    """A change of mode that happens when `indicator` rises above zero."""

    mode: str
    source: int
    target: int
    indicator: Any
    allowed: Any = None
    reset: dict[str, Any] = field(default_factory=dict)
    shock: Shock | None = None


@dataclass
class Template:
    """The equations of one component class in its own local symbols."""

    owner: type[Component]
    variables: dict[str, Any] = field(default_factory=dict)
    derivatives: dict[str, str] = field(default_factory=dict)
    parameters: dict[str, Any] = field(default_factory=dict)
    modes: dict[str, Any] = field(default_factory=dict)
    impulses: dict[str, Any] = field(default_factory=dict)
    time: Any = field(default_factory=lambda: ca.SX.sym("time"))
    residuals: list[Any] = field(default_factory=list)
    aliases: list[tuple[str, str, int]] = field(default_factory=list)
    transitions: list[Transition] = field(default_factory=list)
    choices: list[tuple[Any, str, dict[int, Any]]] = field(default_factory=list)
    held: list[tuple[str, str, int]] = field(default_factory=list)

    @cached_property
    def place(self) -> dict[str, int]:
        """Number of each variable by name; asked for once the equations are read."""
        return {name: number for number, name in enumerate(self.variables)}

    def variable(self, name: str) -> Any:
        """Return the symbol of a variable, made when it is first asked for."""
        if name not in self.variables:
            self.variables[name] = ca.SX.sym(name)
        return self.variables[name]

    def derivative(self, name: str) -> Any:
        """Return the symbol of a variable's time derivative."""
        self.derivatives[name] = f"der({name})"
        return self.variable(self.derivatives[name])

    def name_of(self, symbol: Any) -> str | None:
        """Return the local name of a symbol, or None if it is no variable."""
        name = symbol.name() if isinstance(symbol, ca.SX) and symbol.is_symbolic() else ""
        known = self.variables.get(name)
        return name if known is not None and ca.is_equal(known, symbol) else None


def der(variable: Any) -> Any:
    """Return the time derivative of a variable, inside `equations`."""
    template = _reading.get(None)
    name = template.name_of(variable) if template else None
    if template is None or name is None:
        raise ModelError(
            f"der() takes one variable of the component, got {variable}; "
            "declare a variable for it and yield their equality"
        )
    return template.derivative(name)


class Scope:
    """What `self` is while a component states its equations."""

    def __init__(self, template: Template, component: Component, prefix: str = "") -> None:
        self._template, self._component, self._prefix = template, component, prefix

    @property
    def time(self) -> Any:
        """Time [s]."""
        return self._template.time

    def __getattr__(self, name: str) -> Any:
        template, component = self._template, self._component
        field_ = type(component).fields.get(name)
        if name in component._parts:
            return Scope(template, component._parts[name], f"{self._prefix}{name}.")
        if field_ is None:
            return self._plain_attribute(name)
        path = self._prefix + name
        if isinstance(field_, Variable | RealInput | RealOutput):
            return template.variable(path)
        if isinstance(field_, Port):
            return _PortScope(template, path, field_)
        if isinstance(field_, Option):
            return component._get(field_)
        return self._own_symbol(field_)

    def _own_symbol(self, field_: Field) -> Any:
        if self._prefix:
            raise ModelError(f"equations cannot use {field_.kind} '{field_.name}' of a part")
        template, name = self._template, field_.name
        if isinstance(field_, Mode):
            symbol = template.modes.setdefault(name, ca.SX.sym(name))
            return _ModeScope(template, field_, symbol)
        table = template.impulses if isinstance(field_, Impulse) else template.parameters
        return table.setdefault(name, ca.SX.sym(name))

    def _plain_attribute(self, name: str) -> Any:
        owner = type(self._component)
        try:
            value = getattr(owner, name)
        except AttributeError:
            known = [*owner.fields, *self._component._parts]
            raise ModelError(f"{owner.__name__} declares no '{name}'{nearest(name, known)}") from None
        if isinstance(value, property) and value.fget:
            return value.fget(self)
        return types.MethodType(value, self) if isinstance(value, types.FunctionType) else value


class _PortScope:
    def __init__(self, template: Template, path: str, port: Port) -> None:
        self._template, self._path, self._port = template, path, port

    def __getattr__(self, name: str) -> Any:
        if name not in (self._port.across, self._port.through):
            raise ModelError(
                f"{type(self._port).__name__} '{self._path}' has no '{name}', "
                f"only '{self._port.across}' and '{self._port.through}'"
            )
        return self._template.variable(f"{self._path}.{name}")


class _ModeScope:
    def __init__(self, template: Template, mode: Mode, symbol: Any) -> None:
        self._template, self._mode, self._symbol = template, mode, symbol

    def _index(self, value: str) -> int:
        if value not in self._mode.values:
            raise ModelError(f"mode '{self._mode.name}' has no '{value}', only {self._mode.values}")
        return self._mode.values.index(value)

    def is_(self, *values: str) -> Any:
        """Return a condition: the mode is one of these."""
        conditions = [self._symbol == self._index(value) for value in values]
        return conditions[0] if len(conditions) == 1 else ca.logic_or(*conditions)

    def choose(self, **cases: Any) -> Any:
        """Return the expression of the present mode; one for each mode."""
        if set(cases) != set(self._mode.values):
            raise ModelError(f"choose() of '{self._mode.name}' needs exactly {self._mode.values}")
        *others, last = self._mode.values
        expression = cases[last]
        for value in reversed(others):
            expression = ca.if_else(self._symbol == self._index(value), cases[value], expression)
        indexed = {self._index(value): ca.SX(case) for value, case in cases.items()}
        self._template.choices.append((expression, self._mode.name, indexed))
        return expression

    def goes(
        self,
        source: str,
        target: str,
        *,
        when: Any,
        allowed: Any = None,
        reset: dict[str, Any] | None = None,
        shock: Shock | None = None,
    ) -> Transition:
        """Return a transition from one mode to another.

        Args:
            source: the mode it leaves.
            target: the mode it enters (the same one for a shock only).
            when: `left > right` or `left < right`; it fires as this becomes true.
            allowed: a further condition that is looked at only then.
            reset: new values of variables, by name.
            shock: an impulse that acts at this instant.
        """
        indicator = _relation(when)
        indices = self._index(source), self._index(target)
        return Transition(self._mode.name, *indices, indicator, allowed, reset or {}, shock)


def _relation(when: Any) -> Any:
    if not isinstance(when, ca.SX) or when.op() not in (ca.OP_LT, ca.OP_LE):
        raise ModelError(f"when= takes a relation such as `self.f > self.f_max`, got {when}")
    return when.dep(1) - when.dep(0)


_templates: dict[Any, Template] = {}


def template_of(component: Component) -> Template:
    """Return the template of a component, read once per class and choice of options."""
    key = (type(component), tuple(component._get(option) for option in type(component)._options))
    try:
        known = _templates.get(key)
    except TypeError:
        return _read(component)
    if known is None:
        known = _templates[key] = _read(component)
    return known


def _read(component: Component) -> Template:
    template = Template(type(component))
    scope: Any = Scope(template, component)
    for name, field_ in type(component).fields.items():
        if isinstance(field_, Variable | RealInput | RealOutput):
            template.variable(name)
        elif isinstance(field_, Port):
            template.variable(f"{name}.{field_.across}")
            template.variable(f"{name}.{field_.through}")
        elif not isinstance(field_, Option | Part):
            getattr(scope, name)
    token = _reading.set(template)
    try:
        for method in _stated(type(component), "equations"):
            for equation in method(scope):
                _add_equation(template, equation)
        for method in _stated(type(component), "transitions"):
            template.transitions.extend(method(scope))
    finally:
        _reading.reset(token)
    return template


def _stated(owner: type, name: str) -> Iterator[Any]:
    for klass in reversed(owner.__mro__):
        if name in vars(klass):
            yield vars(klass)[name]


def _add_equation(template: Template, equation: Any) -> None:
    name = template.owner.__name__
    if not isinstance(equation, ca.SX) or equation.op() != ca.OP_EQ:
        raise ModelError(
            f"{name}: `{equation}` is not an equation. Yield `left == right` between different "
            "expressions of the component's variables (`x == x` says nothing)"
        )
    left, right = equation.dep(0), equation.dep(1)
    plain = _signed_name(template, left), _signed_name(template, right)
    if plain[0] and plain[1] and plain[0][0] != plain[1][0]:
        template.aliases.append((plain[0][0], plain[1][0], plain[0][1] * plain[1][1]))
        return
    for symbol in ca.symvar(equation):
        known = [*template.parameters.values(), *template.modes.values(), template.time]
        known += [*template.impulses.values(), *template.variables.values()]
        if not any(ca.is_equal(symbol, other) for other in known):
            raise ModelError(f"{name}: `{equation}` uses '{symbol}', which the component does not declare")
    _note_held(template, left, right)
    template.residuals.append(left - right)


def _note_held(template: Template, left: Any, right: Any) -> None:
    """Remember variables that an equation sets to zero in some mode, so that they are exactly zero."""
    for expression, mode, cases in template.choices:
        if right.is_zero() and ca.is_equal(expression, left):
            names = {value: template.name_of(case) for value, case in cases.items()}
            template.held += [(name, mode, value) for value, name in names.items() if name]


def _signed_name(template: Template, expression: Any) -> tuple[str, int] | None:
    sign = 1
    if not expression.is_symbolic() and expression.op() == ca.OP_NEG:
        expression, sign = expression.dep(0), -1
    name = template.name_of(expression)
    return (name, sign) if name else None
