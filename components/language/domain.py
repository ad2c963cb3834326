"""Domains: sliding or turning, and what each calls its quantities; and any other kind of port."""

from enum import StrEnum
from typing import Self

from ...base import rate_unit


class Domain(StrEnum):
    """A kind of motion: its name, which knows the names and SI units of the quantities, and two parameters.

    Attributes:
        across, speed, through: position, velocity and force.
        stiffness, inertia: what elements call theirs.
        motion_units: of position, velocity and acceleration.
        through_unit: of force.
    """

    across: str
    speed: str
    through: str
    stiffness: str
    inertia: str
    motion_units: tuple[str, str, str]
    through_unit: str

    TRANSLATIONAL = "translational", "s", "v", "f", "k", "m", "m", "N"
    ROTATIONAL = "rotational", "phi", "w", "tau", "c", "J", "rad", "N.m"

    def __new__(cls, name: str, *names: str) -> Self:
        self = str.__new__(cls, name)
        self._value_ = name
        self.across, self.speed, self.through, self.stiffness, self.inertia, unit, self.through_unit = names
        self.motion_units = unit, rate_unit(unit), rate_unit(unit, 2)
        return self


class OtherDomain(str):
    """A kind of port beside sliding and turning, by its name, such as "thermal".

    What flows into a component through its ports sums to zero at a node, what is across is equal there.

    Args:
        name: what it is called in messages.
        across: name and SI unit of what is equal, `("T", "K")`.
        through: name and SI unit of what flows in, `("Q_flow", "W")`.
    """

    across: str
    through: str
    motion_units: tuple[str, ...]
    through_unit: str

    def __new__(cls, name: str, *, across: tuple[str, str], through: tuple[str, str]) -> Self:
        self = str.__new__(cls, name)
        self.across, unit = across
        self.motion_units = (unit,)
        self.through, self.through_unit = through
        return self


AnyDomain = Domain | OtherDomain
