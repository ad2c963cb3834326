"""Where members start: what is sought, by the program itself, and in Python for those it finds none for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array, InitialConditionError, ModelError, SimulationError
from ..dae import DAE
from ..simulation.bound_dae import BoundDAE
from ..simulation.consistent_start import started
from ..simulation.initialization import StartValues, following, guessed, start_values
from ..simulation.run import Run
from ..simulation.settings import Settings
from ..simulation.starting import Aim, Start, search
from .table import Columns


@dataclass(eq=False)
class Starts:
    """Start values of members by name, a column each; those of the components hold otherwise.

    Raises:
        ModelError: for unknown names, and values that are no finite numbers.
    """

    dae: DAE
    columns: Columns

    def __post_init__(self) -> None:
        problems = [
            f"start value of '{name}' of member {member} must be a finite number, got {values[member]}"
            for name, values in self.columns.items()
            for member in np.flatnonzero(~np.isfinite(values))[:1].tolist()
        ]
        if problems:
            raise ModelError("these start values cannot be set:", problems)
        self._first = self._wanted(0)
        if len({self.dae.root(name)[0] for name in self.columns}) < len(self.columns):
            for member in range(len(next(iter(self.columns.values())))):
                self._wanted(member)  # which refuses contradictions

    def _wanted(self, member: int) -> StartValues:
        own = {name: float(values[member]) for name, values in self.columns.items()}
        return start_values(self.dae, own, {})

    def sought(self, closed: BoundDAE, parameters: Array, begin: float) -> Start | None:
        """Return what members seek, as the first one does; None if that is too much for a program."""
        dae = self.dae
        wanted = following(closed, closed.blank(parameters), begin, self._first)
        found = search(dae, wanted)
        if found is None:
            return None
        aims = [replace(aim, value=0.0) for aim in found[0]]
        modes, names = np.zeros(dae.modes.numel()), [name for name, _ in wanted.fixed.values()]
        x, z = guessed(dae, wanted)
        return Start(dae, np.zeros_like(x), z, modes, np.ones_like(x), aims, names, *found[1:])

    def row(self, closed: BoundDAE, parameters: Array, begin: float) -> tuple[Array, Array]:
        """Return from where members with some signals seek their states, and what they aim at."""
        wanted = following(closed, closed.blank(parameters), begin, self._first)
        found = search(self.dae, wanted)
        aims = found[0] if found else []
        return guessed(self.dae, wanted)[0], np.array([aim.value for aim in aims])

    def fill(self, guesses: Array, aims: Array, sought: Sequence[Aim]) -> None:
        """Put in the start values that members have of their own."""
        dae, aimed = self.dae, [aim.variable for aim in sought]
        for name, values in self.columns.items():
            root, sign = dae.root(name)
            if root in dae.states:
                guesses[:, dae.states.index(root)] = sign * values
            if root in aimed:
                place = aimed.index(root)
                aims[:, place] = sign * dae.root(sought[place].name)[1] * values

    def found(self, member: int, closed: BoundDAE, parameters: Array, settings: Settings) -> Run | str:
        """Return where a member starts, as a run on its own would, or why it cannot."""
        try:
            return started(closed, settings, closed.blank(parameters), self._wanted(member))
        except (InitialConditionError, SimulationError) as error:
            return str(error)
