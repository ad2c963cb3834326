"""`Component`: the declarative base of every element and every composite."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, ClassVar, Self, TypeVar

from ...base.checks import is_number
from ...base.errors import ModelError, UnknownPartError, nearest
from .domain import AnyDomain
from .fields import MISSING, Field, Option, Parameter, Part, Port, RealInput, RealOutput, Variable
from .signatures import Signed

Expression = Any  # of symbols while equations are read; a number or an array anywhere else
Stated = Iterable[Any]  # equations, transitions or connections, as a component yields them
F = TypeVar("F", bound=Field)
CONNECTABLE = (Port, RealInput, RealOutput)
SETTABLE = (Parameter, Option, Variable, RealInput)


@dataclass(slots=True, eq=False)
class PortRef:
    """A port of one component, to be connected."""

    component: Component
    name: str

    @property
    def domain(self) -> AnyDomain | None:
        """Its domain, None if it is a signal."""
        return type(self.component).fields[self.name].domain

    def __repr__(self) -> str:
        return f"<{self.name} of {type(self.component).__name__}>"


class Component:
    """An element (fields and `equations`) or a composite (parts and `connections`), or both.

    Args:
        values: parameters, options, fixed start values of variables, signals of inputs, and parts
            that replace the declared ones, all by name.

    Attributes:
        has_law: whether it stands for a part of the machine, in whose law an effect can hide: not what only
            holds, drives, measures or joins rigidly.
        unsettled: what it means, and what helps, if no set of its modes is consistent.

    Problems with the values are told when the network is assembled, all at once and by path.
    """

    has_law: ClassVar[bool] = True
    unsettled: ClassVar[str] = ""
    fields: ClassVar[dict[str, Field]] = {}
    _by_kind: ClassVar[dict[type[Field], tuple[Any, ...]]] = {}
    _templates: ClassVar[dict[tuple[Any, ...], Any]] = {}
    __signature__ = Signed()
    _conditional: ClassVar[bool] = False

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        for name, value in list(vars(cls).items()):
            if isinstance(value, Component):
                part = Part(doc=type(value).__name__, default=value)
                part.__set_name__(cls, name)
                setattr(cls, name, part)
        cls.fields = {
            name: value
            for klass in reversed(cls.__mro__)
            for name, value in vars(klass).items()
            if isinstance(value, Field)
        }
        cls._by_kind = {}
        cls._templates = {}
        cls._conditional = any(field.when for field in cls.fields.values())

    def __init__(self, **values: Any) -> None:
        self._values: dict[str, Any] = {}
        self._parts: dict[str, Component] = {p.name: p.default.clone() for p in fields_of(self, Part)}
        self._problems: dict[str, str] = {}
        self._owner: Component | None = None
        parts = {name: value for name, value in values.items() if isinstance(value, Component)}
        for name, value in values.items():
            if name not in parts:
                self._set(name, value)
        if type(self).parts is not Component.parts and not self._shapeless:
            self._parts.update(self.parts())
        self._own_parts()
        for name, part in parts.items():
            self._replace(name, part)

    @property
    def _shapeless(self) -> bool:
        """Whether an option is wrong, so that neither parts nor equations can be told."""
        problems = self._problems
        return bool(problems) and any(option.name in problems for option in fields_of(self, Option))

    def _own_parts(self) -> None:
        for component in self._parts.values():
            component._owner = self

    def parts(self) -> dict[str, Component]:
        """Return parts that depend on options (a number of planets); called once, at creation."""
        return {}

    def equations(self) -> Stated:
        """Yield the equations, each `left == right`; those of base classes are added by themselves."""
        return ()

    def transitions(self) -> Stated:
        """Yield the mode transitions, each `self.mode.goes(source, target, when=...)`."""
        return ()

    def connections(self) -> Iterable[tuple[PortRef, ...]]:
        """Yield tuples of ports (own and of parts) that are joined at one node."""
        return ()

    def insertions(self) -> Iterable[tuple[PortRef, PortRef, PortRef]]:
        """Yield (port, near, far): the flanges of an element that stands between a port and its node."""
        return ()

    def clone(self) -> Self:
        """Return an independent copy; its parts are copied too."""
        copy: Self = object.__new__(type(self))
        copy.__dict__.update(self.__dict__)
        copy._values, copy._problems = dict(self._values), dict(self._problems)
        copy._parts = {name: component.clone() for name, component in self._parts.items()}
        copy._own_parts()
        return copy

    def with_values(self, **values: Any) -> Self:
        """Return a copy with some values changed."""
        copy = self.clone()
        shaped = type(self).parts is not Component.parts
        for name, value in values.items():
            if isinstance(value, Component):
                copy._replace(name, value)
            else:
                copy._set(name, value)
                if shaped and isinstance(type(self).fields.get(name), Option):
                    copy._problems[name] = f"{name} shapes its parts; create another one with it"
        return copy

    def _replace(self, name: str, part: Component) -> None:
        if name not in self._parts:
            self._problems[name] = self._unknown(name)
            return
        self._parts[name] = part
        part._owner = self

    def _set(self, name: str, value: Any) -> None:
        field = type(self).fields.get(name)
        problem = field.problem(value) if isinstance(field, SETTABLE) else self._unknown(name)
        self._problems.pop(name, None)
        if problem:
            self._problems[name] = problem
        self._values[name] = value

    def _unknown(self, name: str) -> str:
        fields = type(self).fields.items()
        known = [n for n, f in fields if not isinstance(f, Port | RealOutput)] + list(self._parts)
        return f"has no parameter '{name}'{nearest(name, known)}"

    def problems(self) -> Iterator[str]:
        """Yield what is wrong with this component's own values."""
        yield from self._problems.values()
        for field in fields_of(self, Parameter):
            if field.default is MISSING and field.name not in self._values:
                yield f"{field.name} [{field.unit}] ({field.doc}) must be given"

    def _get(self, field: Field) -> Any:
        if isinstance(field, CONNECTABLE):
            return PortRef(self, field.name)
        if isinstance(field, Part):
            return self._parts[field.name]
        if isinstance(field, Parameter):
            return self._parameter_value(field)
        return self._values.get(field.name, field.default if isinstance(field, Option) else field)

    def _parameter_value(self, field: Parameter) -> Any:
        value = self._values.get(field.name, MISSING)
        if value is MISSING:
            return field.default(self) if callable(field.default) else field.default
        owner = self._owner
        if isinstance(value, Parameter):
            while owner is not None and type(owner).fields.get(value.name) is not value:
                owner = owner._owner
            return value if owner is None else owner._get(value)
        return value(owner) if callable(value) and owner is not None else value

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        elif isinstance(type(self).fields.get(name), SETTABLE):
            self._assign(name, value)
        else:
            self._refuse(name, value)
            object.__setattr__(self, name, value)

    def _assign(self, name: str, value: Any) -> None:
        """Set a value later on; one that cannot be is a ModelError, and the one before is kept."""
        copy = self.with_values(**{name: value})
        if name in copy._problems:
            raise ModelError(f"{type(self).__name__}.{name}: {copy._problems[name]}")
        self._values, self._problems = copy._values, copy._problems

    def _refuse(self, name: str, value: Any) -> None:
        """Raise for what would be set without any effect: parts, ports, and names that are nearly known."""
        fields = type(self).fields
        known = name in fields or name in self.__dict__.get("_parts", {})
        if known or isinstance(value, Component):
            raise ModelError(
                f"{type(self).__name__}.{name} cannot be assigned: parts are given when a component is made, "
                "added to a network by add(), and exchanged by with_values()"
            )
        if is_number(value) and not hasattr(self, name) and nearest(name, fields):
            raise ModelError(f"{type(self).__name__} {self._unknown(name)}")

    def __getattr__(self, name: str) -> Any:
        parts = self.__dict__.get("_parts", {})
        if name in parts:
            return parts[name]
        known = [*type(self).fields, *parts]
        raise UnknownPartError(f"{type(self).__name__} has no '{name}'{nearest(name, known)}")

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in self._values.items())
        return f"{type(self).__name__}({values})"


def fields_of(component: Component, kind: type[F]) -> tuple[F, ...]:
    """Return the fields of one kind that are there; they are looked up once for each class."""
    known = component._by_kind
    if kind not in known:
        known[kind] = tuple(f for f in component.fields.values() if isinstance(f, kind))
    if component._conditional:
        return tuple(f for f in known[kind] if is_there(component, f))
    return known[kind]


def is_there(component: Component, field: Field) -> bool:
    """Return whether a component has a field, which may depend on an option."""
    return not field.when or component._get(component.fields[field.when]) is True


def parts_of(component: Component) -> dict[str, Component]:
    """Return the components inside a component, by name."""
    return component._parts


def values_of(component: Component) -> dict[str, Any]:
    """Return what was given to the fields of a component, by name."""
    return component._values
