"""Reading a component class: what it yields becomes a `Template` of residuals and aliases."""

from collections.abc import Iterable, Iterator
from contextvars import ContextVar
from typing import Any

import casadi as ca

from ...base.errors import ModelError
from ...base.quiet import numpy_on_symbols
from .component import Component, fields_of, is_there
from .derived import Derived
from .fields import Option, Part, Port, RealInput, RealOutput, Variable
from .scope import Scope
from .template import Template

MOST_TEMPLATES = 256  # of a class that are kept, one for each choice of options

_reading: ContextVar[Template] = ContextVar("template being read")


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


def template_of(component: Component) -> Template:
    """Return the template of a component, read once per class and options; the last ones are kept."""
    known = type(component)._templates
    options = tuple(component._get(option) for option in fields_of(component, Option))
    try:
        hash(options)
    except TypeError:
        return _read(component)
    known[options] = template = known.pop(options, None) or _read(component)
    if len(known) > MOST_TEMPLATES:
        known.pop(next(iter(known)), None)
    return template


def declared_template(component: Component) -> Template:
    """Return a template of the declarations alone, which stands in for one that cannot be read."""
    template = Template(type(component))
    scope: Any = Scope(template, component)
    for name, field_ in type(component).fields.items():
        if not is_there(component, field_):
            continue
        if isinstance(field_, Variable | RealInput | RealOutput):
            template.variable(name)
        elif isinstance(field_, Port):
            template.variable(f"{name}.{field_.across}")
            template.variable(f"{name}.{field_.through}")
        elif not isinstance(field_, Option | Part | Derived):
            getattr(scope, name)
    return template


def _read(component: Component) -> Template:
    template = declared_template(component)
    scope = Scope(template, component)
    token = _reading.set(template)
    try:
        with numpy_on_symbols():
            equations = [*_stated(scope, type(component), "equations")]
            for equation in equations:
                _add_equation(template, equation)
            _check_declared(template, equations)
            template.transitions.extend(_stated(scope, type(component), "transitions"))
            _derive(template, scope, component)
    finally:
        _reading.reset(token)
    return template


def _derive(template: Template, scope: Any, component: Component) -> None:
    """Note what follows from the variables, none of which may be new."""
    derivatives = set(template.derivatives)
    for field_ in fields_of(component, Derived):
        template.derived[field_.name] = ca.SX(field_.law(scope))
        new = template.derivatives.keys() - derivatives
        if new:
            raise ModelError(
                f"{field_.name} uses der({min(new)}), which no equation has; declare a variable for it"
            )
    _check_declared(template, [*template.derived.values()])


def _stated(scope: Scope, owner: type, name: str) -> Iterator[Any]:
    for klass in reversed(owner.__mro__):
        if name in vars(klass):
            stated = vars(klass)[name](scope)
            if isinstance(stated, ca.SX) or not isinstance(stated, Iterable):
                raise ModelError(f"{name}() of {klass.__name__} must yield, got {stated}")
            yield from stated


def _add_equation(template: Template, equation: Any) -> None:
    if not isinstance(equation, ca.SX) or equation.op() != ca.OP_EQ:
        raise ModelError(
            f"`{equation}` is not an equation; yield `left == right` between different expressions of "
            "the component's variables (`x == x` says nothing)"
        )
    left, right = equation.dep(0), equation.dep(1)
    plain = _signed_name(template, left), _signed_name(template, right)
    if plain[0] and plain[1] and plain[0][0] != plain[1][0]:
        template.aliases.append((plain[0][0], plain[1][0], plain[0][1] * plain[1][1]))
        return
    _note_held(template, left, right)
    template.residuals.append(left - right)


def _check_declared(template: Template, equations: list[Any]) -> None:
    """Raise for symbols in equations that the component does not declare."""
    declared = (template.parameters, template.modes, template.impulses, template.variables)
    known = {symbol.element_hash() for group in declared for symbol in group.values()}
    known.add(template.time.element_hash())
    for symbol in ca.symvar(ca.vertcat(*equations)) if equations else ():
        if symbol.element_hash() not in known:
            equation = next(e for e in equations if ca.depends_on(e, symbol))
            raise ModelError(
                f"`{equation}` uses '{symbol}', which the component does not declare; use its own fields"
            )


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
