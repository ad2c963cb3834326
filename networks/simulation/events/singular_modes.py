"""Completion: what makes blocks of equations regular that the present modes leave singular."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from ....base import Array, SimulationError
from ..bound_dae import BoundDAE
from ..point import Point
from .constants import BLOCK_LOOSE, BLOCK_REGULAR, BLOCK_WEAK


@dataclass(eq=False)
class Completion:
    """Keeps the blocks of a run solvable, with notes on loads that are shared in no determined way.

    Attributes:
        adrift: components whose acceleration nothing determines in the present modes.
    """

    closed: BoundDAE
    notes: list[str] = field(default_factory=list)
    adrift: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        dae = self.closed.dae
        self._begin = sum(part.numel() for part in (dae.p, dae.modes, dae.impulses))

    def update(self, point: Point) -> None:
        """Set the completion of blocks that the present modes leave singular.

        Raises:
            SimulationError: if the equations of a block are not finite.
        """
        if not self.closed.dae.blocks:
            return
        functions = self.closed.switch_functions
        slopes = functions.slopes(point.x, point.z, point.q, point.t)[0]
        self.adrift = []
        start = 0
        for block in self.closed.dae.blocks:
            size = len(block.torn)
            part = slice(start, start + size**2)
            if not np.isfinite(slopes[part]).all():
                told = ", ".join(block.labels)
                raise SimulationError(f"equations of {told} are not finite; is a parameter out of range?")
            completion, singular = _completion(slopes[part].tobytes(), size)
            point.q[self._begin :][part] = completion
            start = part.stop
            if singular:
                freed = np.abs(completion.reshape(size, size, order="F")).max(axis=0)
                loose = freed > BLOCK_LOOSE * freed.max()
                if functions.is_rate[block.torn][loose].any():
                    self.adrift += block.labels
                else:
                    self.tell_shared(block.labels)

    def check_adrift(self, t: float) -> None:
        """Raise if nothing determines an acceleration in the present modes."""
        if self.adrift:
            raise SimulationError(
                f"at t = {t:.9g} s nothing with inertia moves with {', '.join(self.adrift)}, which no "
                "longer holds; join a Mass (or an Inertia) where it slides, or, if a spring is in series "
                "with it, take a Jenkins for both"
            )

    def tell_shared(self, labels: list[str]) -> None:
        """Note that components share a load in a way no equation tells."""
        self.note(
            f"{', '.join(labels)}: in some mode these hold a motion that is already held; their forces "
            "are then not unique and the ones of least norm are taken"
        )

    def note(self, note: str) -> None:
        """Keep a note on a run's modes, once."""
        if note not in self.notes:
            self.notes.append(note)


@lru_cache(maxsize=256)
def _completion(entries: bytes, size: int) -> tuple[Array, bool]:
    """Return what makes a singular matrix regular such that solutions have least norm, by columns."""
    matrix = np.frombuffer(entries).reshape(size, size, order="F")
    scale = np.abs(matrix).max(axis=1, initial=0.0)
    scale[scale == 0] = 1.0
    if abs(np.linalg.det(matrix / scale[:, None])) > BLOCK_REGULAR:
        return np.zeros(size**2), False
    left, strength, right = np.linalg.svd(matrix / scale[:, None])
    weak = strength <= BLOCK_WEAK * max(strength.max(initial=0.0), 1.0)
    if not weak.any():
        return np.zeros(size**2), False
    completion = scale[:, None] * (left[:, weak] @ right[weak])
    return completion.ravel(order="F"), True
