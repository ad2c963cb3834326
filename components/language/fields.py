"""What a component declares: parameters, variables, ports, modes, parts.

Each declaration is a class attribute. On a component it gives the value that was set (a number, a
port to connect, a part); inside `equations` it gives the symbol.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

from ...base.checks import is_number, number
from ...base.errors import ModelError
from .domain import AnyDomain, Domain, OtherDomain
from .sampled import Sampled

if TYPE_CHECKING:
    from .component import Component

MISSING: Any = type("Missing", (), {"__repr__": lambda _: "required"})()


@dataclass(eq=False)
class Field:
    """One declared name of a component; a port or an input may be there `when` an option is True only."""

    domain: ClassVar[AnyDomain | None] = None
    unit: str = ""
    doc: str = ""
    name: str = field(default="", init=False)
    when: str = field(default="", kw_only=True)

    @property
    def kind(self) -> str:
        """What it is, in a word, such as parameter or input."""
        word = type(self).__name__.removeprefix("Real").removesuffix("Field")
        return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", word).lower()

    def __set_name__(self, owner: type, name: str) -> None:
        self.__dict__["name"] = name

    def __setattr__(self, attribute: str, value: Any) -> None:
        if self.__dict__.get("name"):
            raise ModelError(
                f"{self.kind} '{self.name}' is declared once for all elements of its kind; set it on one: "
                f"element.{self.name} = ..., or when that is made"
            )
        super().__setattr__(attribute, value)

    def __get__(self, instance: Component | None, owner: type) -> Any:
        return self if instance is None else instance._get(self)


@dataclass(eq=False)
class Parameter(Field):
    """A number that stays constant during a run."""

    default: Any = MISSING
    min: float | None = None
    above: float | None = None
    max: float | None = None
    nonzero: bool = False

    def problem(self, value: Any) -> str:
        """Say what is wrong with a value, or return an empty string."""
        if type(value) is not float:
            if isinstance(value, Parameter) or callable(value):
                return ""
            if number(value):
                return f"{self.name} must be a number [{self.unit}], got {value!r}"
            value = float(value)
        unit = f" {self.unit}" if self.unit not in ("", "1") else ""
        if not abs(value) < float("inf"):
            return f"{self.name} must be a finite number{unit and f' [{self.unit}]'}, got {value}"
        if self.min is not None and value < self.min:
            return f"{self.name} must be at least {self.min:g}{unit}, got {value}"
        if self.above is not None and value <= self.above:
            return f"{self.name} must be above {self.above:g}{unit}, got {value}"
        if self.max is not None and value > self.max:
            return f"{self.name} must be at most {self.max:g}{unit}, got {value}"
        return f"{self.name} must not be 0{unit}" if self.nonzero and value == 0 else ""


@dataclass(eq=False)
class Option(Field):
    """A choice that shapes the equations themselves, fixed when the network is assembled."""

    default: Any = None
    choices: tuple[Any, ...] | None = None
    check: Callable[[Any], str] | None = None

    def problem(self, value: Any) -> str:
        """Say what is wrong with a value, or return an empty string."""
        alike = [c for c in self.choices or () if type(value) is type(c)]
        if self.choices is not None and value not in alike:
            return f"{self.name} must be one of {self.choices}, got {value!r}"
        told = self.check(value) if self.check else ""
        return f"{self.name} {told}, got {value!r}" if told else ""


@dataclass(eq=False)
class Variable(Field):
    """A quantity that moves."""

    start: float = 0.0
    nominal: float = float("nan")
    state: str = "default"
    follows: str = ""

    def problem(self, value: Any) -> str:
        """Say what is wrong with a start value, or return an empty string."""
        return "" if is_number(value) else f"start value of {self.name} must be a number, got {value!r}"


class RealInput(Field):
    """A signal that comes in: connected, bound to a function of time or data, or left to the run."""

    def problem(self, value: Any) -> str:
        """Say what is wrong with a signal, or return an empty string."""
        good = is_number(value) or isinstance(value, Sampled) or callable(value)
        told = f"{self.name} takes a number, a function of time or Sampled data, got {value!r}"
        return "" if good else told


class BooleanInput(RealInput):
    """A signal that comes in and is 0 for off, 1 for on; left to the run, it is a Boolean of an FMU."""


class RealOutput(Field):
    """A signal that goes out."""


class BooleanOutput(RealOutput):
    """A signal that goes out, is 0 for off or 1 for on, and changes at events only."""


class IntegerOutput(RealOutput):
    """A signal that goes out, is a whole number, and changes at events only."""


@dataclass(eq=False)
class Port(Field):
    """A connection point: an across and a through variable, which its `domain` names.

    A subclass with a `domain` of its own, an `OtherDomain`, is all that a new kind of port takes.

    Args:
        doc: what it is, in a few words.
        optional: whether it is a support, which is held at zero when it is left unconnected.
        free: whether it may be left unconnected because what stands there moves by itself (a body): nothing
            acts on it then.
    """

    domain: ClassVar[AnyDomain]  # pyright: ignore[reportIncompatibleVariableOverride]
    unit: str = field(default="", init=False)
    optional: bool = False
    free: bool = False

    def __post_init__(self) -> None:
        self.across, self.through = self.domain.across, self.domain.through
        self.units = self.domain.motion_units[0], self.domain.through_unit


class TranslationalFlange(Port):
    """A flange that slides: position `s` [m] across, force `f` [N] through (into the component)."""

    domain = Domain.TRANSLATIONAL


class RotationalFlange(Port):
    """A flange that turns: angle `phi` [rad] across, torque `tau` [N.m] through."""

    domain = Domain.ROTATIONAL


class HeatPort(Port):
    """A port for heat: temperature `T` [K] across, heat flow `Q_flow` [W] through."""

    domain = OtherDomain("thermal", across=("T", "K"), through=("Q_flow", "W"))


@dataclass(eq=False)
class ModeField(Field):
    """A discrete state of a component; constant between events."""

    values: tuple[str, ...] = ()
    in_shock: dict[str, str] = field(default_factory=dict)


class Impulse(Field):
    """The integral of a through variable over a shock; zero except at the shock itself."""


@dataclass(eq=False)
class Part(Field):
    """A component inside a component."""

    default: Any = None


def parameter(
    unit: str,
    doc: str,
    *,
    default: Any = MISSING,
    min: float | None = None,
    above: float | None = None,
    max: float | None = None,
    nonzero: bool = False,
) -> Any:
    """Declare a parameter.

    Args:
        unit: SI unit, `"1"` if it has none.
        doc: what it is, in a few words.
        default: its value when none is given; without one it must be given. A function of the
            component (`lambda self: ...`) computes it from other parameters.
        min: the least value allowed.
        above: a value it must exceed.
        max: the largest value allowed.
        nonzero: whether 0 is refused, where either sign is meant.
    """
    return Parameter(unit, doc, default, min, above, max, nonzero)


def option(
    doc: str,
    *,
    default: Any,
    choices: tuple[Any, ...] | None = None,
    check: Callable[[Any], str] | None = None,
) -> Any:
    """Declare a structural choice: a plain Python value, also inside `equations`.

    Args:
        doc: what it is, in a few words.
        default: its value when none is given.
        choices: the values allowed.
        check: a function that says what a value must be (`"must be above 0"`) if it is not.
    """
    return Option("", doc, default, choices, check)


def variable(
    unit: str,
    doc: str,
    *,
    start: float = 0.0,
    nominal: float = float("nan"),
    state: str = "default",
    follows: str = "",
) -> Any:
    """Declare a variable.

    Args:
        unit: SI unit.
        doc: what it is.
        start: the guess of its start value; a user's own start value is fixed, this one never is.
        nominal: its usual size, which scales the absolute tolerance (1 if nothing is said).
        state: `"prefer"`, `"default"` or `"avoid"` when states are chosen.
        follows: an input of the component at which it starts if nobody says otherwise.
    """
    return Variable(unit, doc, start, nominal, state, follows)


def mode(*values: str, doc: str = "mode", in_shock: dict[str, str] | None = None) -> Any:
    """Declare a discrete mode; the first value is the one a run starts from.

    Args:
        values: the names of the modes.
        doc: what it distinguishes.
        in_shock: the mode that stands in for another while an impulse acts: friction that sticks
            cannot transmit an impulse, so `{"stuck": "forward"}`.
    """
    return ModeField("1", doc, values, in_shock or {})


def impulse(unit: str, doc: str) -> Any:
    """Declare an impulse, which stands beside its force in the equations and acts in shocks only."""
    return Impulse(unit, doc)
