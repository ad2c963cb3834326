"""What is done with members, here or elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...base import Array
from ..csource.crew import CrewProgram
from ..csource.members import Members, Told


@dataclass(frozen=True, eq=False)
class Task:
    """What is done with members."""

    program: CrewProgram
    outputs: Array
    tolerance: tuple[float, float]

    def blank(self, members: int, crossings: bool = False) -> Told:
        """Return what is told of members that have not begun."""
        return self.program.blank(members, self.outputs, crossings)

    def run(self, members: Members, told: Told, at: Callable[[int], None] = lambda _: None) -> None:
        """Run members in this process."""
        self.program.run(members, self.outputs, self.tolerance, told, at)
