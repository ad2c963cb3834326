"""`Weighing`: what the samples of an output weigh, within the band that a filter has left as it was."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import sqrt

import numpy as np

from ...base import Array, Flags
from .noise import NoiseFloor

UNTOUCHED_SHARE = 0.5  # of the band that a filter passes, in which it changes next to nothing
KERNEL_PERIODS = 4  # of the highest frequency that is compared, in what is averaged
FEWEST_KERNELS = 5  # in a record, or what a filter has changed is compared, too


@dataclass(frozen=True, eq=False)
class Weighing:
    """What the samples of an output weigh: in units of noise, as far as a filter has left them alone.

    A logger's filter rounds the steps that friction makes, and no model knows of it. What it has changed lies
    at the upper end of the band that it passes; below, model and record are compared as if there were none,
    each without phase.

    Attributes:
        floor: the noise of the output.
        counted: which samples count.
        rate: of samples [Hz].
    """

    floor: NoiseFloor
    counted: Flags
    rate: float

    @cached_property
    def sigma(self) -> float:
        """What a sample weighs: the standard deviation of white noise of the density that is there."""
        return self.floor.white(self.rate)

    @property
    def share(self) -> float:
        """The number of independent samples over that of samples."""
        if self._kernel is None:
            return self.floor.share(self.rate)
        return float(np.sum(self._kernel**2))

    @property
    def noise(self) -> float:
        """The standard deviation of the noise in what is compared."""
        return self.sigma * sqrt(self.share)

    @cached_property
    def alone(self) -> Array:
        """What each sample weighs where it is compared alone, filter or not."""
        return self.counted / self.sigma

    def __call__(self, columns: Array) -> Array:
        """Return what is compared of columns, one value a sample, in units of noise."""
        return self._scaled(self._passed(self._scaled(columns, self.counted)), self._levels)

    def back(self, columns: Array) -> Array:
        """Return the transposed of that: what each sample contributes to weighed ones."""
        return self._scaled(self._passed(self._scaled(columns, self._levels)), self.counted)

    @property
    def highest(self) -> float:
        """Up to which frequency model and record are compared [Hz]."""
        return UNTOUCHED_SHARE * self.floor.passed

    @property
    def is_whole(self) -> bool:
        """Whether all of what was measured is compared."""
        return self._kernel is None

    @cached_property
    def _kernel(self) -> Array | None:
        from scipy.signal import firwin

        if self.highest >= 0.5 * self.rate:
            return None
        half = round(0.5 * KERNEL_PERIODS * self.rate / self.highest)
        if len(self.counted) < FEWEST_KERNELS * 2 * half:
            return None
        return np.asarray(firwin(2 * half + 1, self.highest, fs=self.rate), dtype=float)

    @cached_property
    def _levels(self) -> Array:
        """What samples count once averaged: as much noise is left in each, at the ends, too."""
        if self._kernel is None:
            return self.alone
        left = _averaged(self.counted.astype(float), self._kernel**2)
        return np.where(self.counted, np.sqrt(self.share / np.maximum(left, 1e-12)), 0.0) / self.sigma

    def _passed(self, columns: Array) -> Array:
        return columns if self._kernel is None else _averaged(columns, self._kernel)

    @staticmethod
    def _scaled(columns: Array, rows: Array | Flags) -> Array:
        return np.asarray(columns * rows.reshape(-1, *[1] * (columns.ndim - 1)), dtype=float)


def _averaged(columns: Array, kernel: Array) -> Array:
    from scipy.signal import oaconvolve

    if not columns.size:
        return columns
    return np.asarray(oaconvolve(columns, kernel.reshape(-1, *[1] * (columns.ndim - 1)), mode="same", axes=0))
