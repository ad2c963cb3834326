"""The signature of a component: what it is made with, in the words of its fields."""

from __future__ import annotations

from inspect import Parameter as Argument
from inspect import Signature, signature
from typing import TYPE_CHECKING, Annotated, Any

from .fields import MISSING, Field, Option, Parameter, Part, RealInput, Variable

if TYPE_CHECKING:
    from .component import Component

GIVEN = (Parameter, Option, Variable, RealInput, Part)


class Signed:
    """What `inspect.signature` shows of a class of components: its fields with units, ranges and defaults."""

    def __set_name__(self, owner: type[Component], name: str) -> None:
        self.base = owner

    def __get__(self, instance: object, owner: type[Component]) -> Signature:
        if instance is not None:
            raise AttributeError("__signature__")
        fields = given_fields(owner)
        if fields and owner.__init__ is self.base.__init__:
            return Signature([_argument(field) for field in fields])
        own = signature(owner.__init__)
        return own.replace(parameters=list(own.parameters.values())[1:])


def given_fields(kind: type[Component]) -> list[Field]:
    """Return the fields that are given a value when a component is made: needed ones first, starts last."""
    given = [field for field in kind.fields.values() if isinstance(field, GIVEN)]
    return sorted(given, key=lambda field: (not is_required(field), isinstance(field, Variable)))


def is_required(field: Field) -> bool:
    """Return whether a component cannot be used before a field has a value."""
    return isinstance(field, Parameter) and field.default is MISSING


def told(field: Field) -> str:
    """Return what a field means, with its unit and its range, on one line."""
    unit = f" [{field.unit}]" if field.unit not in ("", "1") else ""
    rest = []
    if isinstance(field, Parameter):
        bounds = {"at least": field.min, "above": field.above, "at most": field.max}
        rest += [f"{word} {bound:g}" for word, bound in bounds.items() if bound is not None]
        rest += ["not 0"] if field.nonzero else []
    elif isinstance(field, Variable):
        rest += ["fixed start value"]
    elif isinstance(field, RealInput):
        rest += ["a number, a function of time or Sampled data"]
    return ", ".join([f"{field.doc}{unit}", *rest])


class _Shown:
    """A default that is no value: shown by a word."""

    def __init__(self, word: str) -> None:
        self.word = word

    def __repr__(self) -> str:
        return f"<{self.word}>"


FREE, COMPUTED = _Shown("free"), _Shown("computed")


def _argument(field: Field) -> Argument:
    default: Any = getattr(field, "default", FREE)
    if isinstance(field, Part):
        default = _Shown(type(default).__name__)
    elif is_required(field):
        default = Argument.empty
    elif callable(default):
        default = COMPUTED
    kind: Any = float if isinstance(field, Parameter | Variable) else Any
    shown = Annotated[kind, told(field)]
    return Argument(field.name, Argument.KEYWORD_ONLY, default=default, annotation=shown)
