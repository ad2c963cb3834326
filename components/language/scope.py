"""`Scope`: what `self` is while equations are read; variables, parameters and modes are SX symbols."""

import types
from functools import reduce
from typing import Any

import casadi as ca

from ...base.errors import ModelError, nearest
from .component import Component
from .derived import Derived
from .fields import Field, Impulse, ModeField, Option, Port, RealInput, RealOutput, Variable
from .template import Shock, Template, Transition


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
        if isinstance(field_, Derived):
            return field_.law(self)
        return self._own_symbol(field_)

    def _own_symbol(self, field_: Field) -> Any:
        if self._prefix:
            raise ModelError(f"equations cannot use {field_.kind} '{field_.name}' of a part")
        template, name = self._template, field_.name
        if isinstance(field_, ModeField):
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
            told = nearest(name, known) or "; declare it with parameter() or variable()"
            where = f"part '{self._prefix[:-1]}'" if self._prefix else "it"
            raise ModelError(f"{where} declares no '{name}'{told}") from None
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
    def __init__(self, template: Template, mode: ModeField, symbol: Any) -> None:
        self._template, self._mode, self._symbol = template, mode, symbol

    def _index(self, value: str) -> int:
        if value not in self._mode.values:
            raise ModelError(f"mode '{self._mode.name}' has no '{value}', only {self._mode.values}")
        return self._mode.values.index(value)

    def is_(self, *values: str) -> Any:
        """Return a condition: the mode is one of these."""
        conditions = [self._symbol == self._index(value) for value in values]
        return reduce(ca.logic_or, conditions)

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
    if isinstance(when, bool) or (isinstance(when, ca.SX) and when.is_constant()):
        return ca.SX(1.0 if when else -1.0)
    if not isinstance(when, ca.SX) or when.op() not in (ca.OP_LT, ca.OP_LE):
        raise ModelError(f"when= takes a relation such as `self.f > self.f_max`, got {when}")
    return when.dep(1) - when.dep(0)
