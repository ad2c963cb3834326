"""Filters without phase, applied alike to what is measured and to what is simulated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import Array, above, between, demand, finite, number, numbers, shown, text, whole
from ...components import ModelError


@dataclass(frozen=True)
class Filter:
    """A Butterworth filter that runs forward and backward, so that nothing is delayed.

    Args:
        cutoff: where a pass falls by 3 dB [Hz]; two values make a band.
        order: of one pass.
        kind: "lowpass", "highpass" or "bandpass".

    Example:
        >>> import numpy as np
        >>> from inertance.identification import Filter
        >>> slow = Filter(cutoff=0.5, order=6)
        >>> t = np.arange(0, 20, 1e-3)
        >>> bool(abs(slow.apply(np.sin(2 * np.pi * 5 * t), rate=1000)[5000:-5000]).max() < 1e-3)
        True
    """

    cutoff: float | tuple[float, float]
    order: int = 4
    kind: str = "lowpass"

    def __post_init__(self) -> None:
        order = self.order, whole(1)
        demand("a Filter", cutoff=(self.cutoff, numbers(number)), order=order, kind=(self.kind, text))
        demand("a Filter", order=(self.order, between(1, 20)))
        edges = np.atleast_1d(np.asarray(self.cutoff, dtype=float))
        problems = []
        if self.kind not in ("lowpass", "highpass", "bandpass"):
            problems.append(f"kind is 'lowpass', 'highpass' or 'bandpass', got '{self.kind}'")
        if len(edges) != (2 if self.kind == "bandpass" else 1):
            problems.append(f"a {self.kind} has {'two cutoffs' if self.kind == 'bandpass' else 'one cutoff'}")
        if not (edges > 0).all() or (np.diff(edges) <= 0).any():
            problems.append(f"cutoff must be above 0 Hz and increasing, got {self.cutoff}")
        if problems:
            raise ModelError("this filter cannot be made:", problems)

    def apply(self, values: Array, rate: float) -> Array:
        """Return values filtered along their first axis.

        Args:
            values: one column a signal.
            rate: samples a second [Hz].
        """
        from scipy.signal import sosfiltfilt

        demand("apply()", values=(values, numbers(finite())))
        if np.ndim(values) not in (1, 2) or len(values) < 2:
            raise ModelError(f"apply() filters columns of at least 2 numbers, got {shown(values)}")
        sections = self._sections(rate)
        padding = min(len(values) - 1, round(3 * rate / float(np.min(self.cutoff))))
        return np.asarray(sosfiltfilt(sections, values, axis=0, padlen=padding))

    def share(self, rate: float) -> float:
        """Return the share of the power of white noise that passes."""
        from scipy.signal import sosfreqz

        _, response = sosfreqz(self._sections(rate), worN=1 << 16)
        return float(np.mean(np.abs(response) ** 4))

    def check(self, rate: float) -> None:
        """Raise if the filter cannot be made for a sampling rate [Hz]."""
        demand("this filter", rate=(rate, above(0, "Hz")))
        demand("this filter", rate=(rate, between(0, 1e6 * float(np.min(self.cutoff)), "Hz")))
        if np.max(self.cutoff) >= rate / 2:
            raise ModelError(
                f"filter: cutoff {np.max(self.cutoff):g} Hz is not below half the sampling rate, {rate:g} Hz"
            )

    def _sections(self, rate: float) -> Any:
        from scipy.signal import butter

        self.check(rate)
        return butter(self.order, self.cutoff, btype=self.kind, fs=rate, output="sos")
