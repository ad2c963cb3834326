"""`Domain`: sliding or turning, and what each calls its quantities."""

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
