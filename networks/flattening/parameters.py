"""The parameters of a network: one symbol each, and what depends on them."""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array, ModelError, Symbolic, nearest, number, numpy_on_symbols, shown, text
from ...components.language import MISSING, Component, Option, Parameter, fields_of, parts_of, values_of
from .flat import FatalProblem, Instance
from .vectors import column, pick_matrix

MOST_TOLD = 3  # members whose values are wrong


class ParameterTable:
    """Numbers that can be set, and expressions of them for the parameters that follow from others."""

    def __init__(self, instances: dict[str, Instance], problems: list[str]) -> None:
        self.instances = instances
        self.index: dict[str, int] = {}
        self.fields: list[Parameter] = []
        self.defaults: list[float] = []
        self._bound: dict[str, Any] = {}
        for instance in instances.values():
            declared = fields_of(instance.component, Parameter)
            instance.given = [self._enter(instance, field) for field in declared]
        self.symbols = ca.SX.sym("p", len(self.defaults))
        self._dependent = self._read_dependent(problems)
        if not problems:
            problems += self._out_of_range(self.defaults)

    def _enter(self, instance: Instance, field: Parameter) -> int:
        """Note a parameter and return its number, negative if it follows from others."""
        given = values_of(instance.component).get(field.name, MISSING)
        value = field.default if given is MISSING else given
        path = instance.full(field.name)
        if isinstance(value, Parameter) or callable(value):
            self._bound[path] = (instance if given is MISSING else instance.parent, value)
            return -1
        entry = self.index[path] = len(self.defaults)
        self.fields.append(field)
        usable = value is not MISSING and not number(value)
        self.defaults.append(float(value) if usable else np.nan)
        return entry

    def expression(self, instance: Instance, name: str) -> Any:
        """Return a parameter as an expression of the symbols."""
        path = instance.full(name)
        if path in self.index:
            return self.symbols[self.index[path]]
        scope, value = self._bound[path]
        if isinstance(value, Parameter):
            while scope is not None and type(scope.component).fields.get(value.name) is not value:
                scope = scope.parent
            if scope is None:
                raise ModelError(f"{instance}: {name} refers to a parameter of no enclosing component")
            return self.expression(scope, value.name)
        if scope is None:
            raise ModelError(f"{instance}: {name} is a function, but no component encloses it")
        with numpy_on_symbols():
            return ca.SX(value(_View(self, scope)))

    def at(self, path: str) -> Symbolic | None:
        """Return a parameter by its full name as an expression of the symbols, None if there is none."""
        if text(path) or (path not in self.index and path not in self._bound):
            return None
        owner, _, name = path.rpartition(".")
        found: Symbolic = self.expression(self.instances[owner], name)
        return found

    def field(self, path: str) -> Parameter | None:
        """Return the declaration of a parameter by its full name, None if there is none."""
        if text(path) or (path not in self.index and path not in self._bound):
            return None
        owner, _, name = path.rpartition(".")
        return type(self.instances[owner].component).fields[name]  # type: ignore[return-value]

    def matrix(self, group: list[Instance]) -> Any:
        """Return the parameters of like instances, (parameters, instances)."""
        names = list(group[0].template.parameters)
        if not names:
            return ca.SX(0, len(group))
        numbers = np.array([instance.given for instance in group])
        values = ca.SX(len(names), len(group))
        if self.defaults:
            values = pick_matrix(self.symbols, np.maximum(numbers, 0))
        for place, line in np.argwhere(numbers < 0).tolist():
            values[line, place] = self.expression(group[place], names[line])
        return values

    def values(self, changed: dict[str, float]) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Return all numbers, some of them changed by name.

        Raises:
            ModelError: listing unknown names and values out of range.
        """
        numbers = np.array(self.defaults)
        problems = []
        for path, value in changed.items():
            if path in self._bound:
                problems.append(f"parameter '{path}' follows from others; change those")
            elif path not in self.index:
                problems.append(f"there is no parameter '{path}'{nearest(str(path), self.index)}")
            else:
                field = self.fields[self.index[path]]
                problem = f"{field.name} must be a number [{field.unit}], got {shown(value)}"
                if not number(value):
                    problem = field.problem(float(value))
                problems += [f"'{path}': {problem}"] if problem else []
                numbers[self.index[path]] = np.nan if problem else value
        if changed and not problems:
            problems += self._out_of_range(numbers)
        if problems:
            raise ModelError("these parameters cannot be set:", problems)
        return numbers

    def rows(self, changed: Mapping[str, Array], count: int) -> Array:
        """Return all numbers of `count` members, (members, numbers), some of them changed by name.

        Raises:
            ModelError: listing unknown names, and values out of range by their members.
        """
        numbers = np.tile(np.array(self.defaults), (count, 1))
        unknown = [path for path in changed if path not in self.index]
        if unknown:
            self.values({path: float("nan") for path in unknown})
        problems = []
        for path, column_ in changed.items():
            field = self.fields[self.index[path]]
            numbers[:, self.index[path]] = column_
            problems += [f"'{path}' of {told}" for told in _out_of_range(field, column_)]
        if changed and not problems:
            dependent = self._dependent(numbers.T).full() if self._bound else []
            for path, values in zip(self._bound, dependent, strict=True):
                declared = self.field(path)
                assert declared is not None
                problems += [f"'{path}' of {told}" for told in _out_of_range(declared, values)]
        if problems:
            raise ModelError("these parameters cannot be set:", problems)
        return numbers

    def _read_dependent(self, problems: list[str]) -> Any:
        """Return the parameters that follow from others, as a function of the numbers."""
        expressions = []
        for path in self._bound:
            try:
                expressions.append(self.at(path))
            except ModelError as error:
                problems.append(FatalProblem(error))
            except Exception as error:
                owner, _, name = path.rpartition(".")
                told = f"cannot be computed: {type(error).__name__}: {str(error).partition(chr(10))[0]}"
                if isinstance(error, RecursionError):
                    told = "depends on itself; give it a number"
                problems.append(FatalProblem(f"{self.instances[owner]}: {name} {told}"))
        return ca.Function("dependent", [self.symbols], [column(expressions)])

    def _out_of_range(self, numbers: Any) -> Iterator[str]:
        values = self._dependent(numbers).full().ravel()
        for path, value in zip(self._bound, values, strict=True):
            declared = self.field(path)
            problem = declared.problem(float(value)) if declared else ""
            if problem:
                yield f"{self.instances[path.rpartition('.')[0]]}: {problem}"


def _out_of_range(field: Parameter, values: Array) -> Iterator[str]:
    """Yield what is wrong with the first members whose values are out of range, and how many more are."""
    good = np.isfinite(values) & ~(field.nonzero & (values == 0))
    for bound, beyond in ((field.min, np.less), (field.above, np.less_equal), (field.max, np.greater)):
        if bound is not None:
            good &= ~beyond(values, bound)
    wrong = np.flatnonzero(~good).tolist()
    for member in wrong[:MOST_TOLD]:
        yield f"member {member}: {field.problem(float(values[member]))}"
    if len(wrong) > MOST_TOLD:
        yield f"{len(wrong) - MOST_TOLD} more members: likewise"


class _View:
    """A component as a formula of a dependent parameter sees it."""

    def __init__(self, table: ParameterTable, instance: Instance) -> None:
        self._table, self._instance = table, instance

    @property
    def _owner(self) -> _View:
        """What encloses it."""
        assert self._instance.parent is not None
        return _View(self._table, self._instance.parent)

    def __getattr__(self, name: str) -> Any:
        component: Component = self._instance.component
        field = type(component).fields.get(name)
        if isinstance(field, Parameter):
            return self._table.expression(self._instance, name)
        if isinstance(field, Option):
            return component._get(field)
        if name in parts_of(component):
            return _View(self._table, self._table.instances[self._instance.full(name)])
        value = getattr(type(component), name, None)
        if isinstance(value, property) and value.fget:
            return value.fget(self)
        if isinstance(value, types.FunctionType):
            return types.MethodType(value, self)
        raise ModelError(f"{self._instance} has no parameter '{name}'")
