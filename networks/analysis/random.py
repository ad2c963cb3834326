"""Random response: spectra and root mean squares of a linear system's outputs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError, at_least, demand, finite, instance, number, numbers, shown, whole
from .norms import stable_part
from .statespace import StateSpace

Spectrum = float | Callable[[Array], ArrayLike]


def response_psd(system: StateSpace, f: ArrayLike, input_psd: Spectrum = 1.0) -> Array:
    """Return the one-sided spectra of the outputs, S_y(f) = |G(f)|^2 S_u(f), shape (frequencies, outputs).

    Args:
        system: with one input, or several that are independent and alike.
        f: frequencies [Hz].
        input_psd: one-sided spectrum of the input, a number or a function of f, in its unit squared per Hz.
    """
    demand("response_psd()", system=(system, instance(StateSpace)), f=(f, numbers(finite("Hz"))))
    at = np.asarray(f, dtype=float)
    if at.ndim != 1 or not (at >= 0).all():
        raise ModelError(f"one-sided spectra are at a list of frequencies from 0 Hz, got {shown(f)}")
    given = _spectrum(input_psd, at)
    return np.asarray((np.abs(system.response(at)) ** 2).sum(axis=-1) * given[:, None])


def _spectrum(input_psd: Spectrum, at: Array) -> Array:
    """Return the spectrum of the input at some frequencies."""
    values: Any = input_psd if number(input_psd) else np.full(at.shape, input_psd)
    if callable(input_psd):
        try:
            values = input_psd(at)
        except Exception as error:
            told = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
            raise ModelError(f"input_psd failed for an array of frequencies ({told})") from error
    if numbers(at_least(0))(values) or np.shape(values) != at.shape:
        raise ModelError(
            f"input_psd must be a spectrum of at least 0, a number or a function of frequencies, got "
            f"{shown(values if callable(input_psd) else input_psd)}"
        )
    return np.asarray(values, dtype=float)


def response_rms(
    system: StateSpace, input_psd: Spectrum, low: float, high: float, points: int = 20001
) -> dict[str, float]:
    """Return the rms of each output within a band, by its name.

    For white input without a band, `StateSpace.h2` is exact.

    Args:
        system: with one input, or several that are independent and alike.
        input_psd: one-sided spectrum of the input, as for `response_psd`.
        low: begin of the band [Hz].
        high: end of the band [Hz].
        points: at which the spectrum is taken, spaced geometrically.

    Raises:
        ModelError: for an empty band, or an unstable system, whose motion grows without end.
    """
    from scipy.integrate import simpson

    band = {"low": (low, finite("Hz")), "high": (high, finite("Hz"))}
    demand("response_rms()", system=(system, instance(StateSpace)), **band, points=(points, whole(2)))
    if not 0 < low < high:
        raise ModelError(f"a band goes from low > 0 to a higher frequency, got {low:g} to {high:g} Hz")
    reason = stable_part(system)[1]
    if reason.startswith("unstable"):
        raise ModelError(f"'{system.name}' has no steady random response: {reason}")
    f = np.geomspace(low, high, points)
    power = simpson(response_psd(system, f, input_psd) * f[:, None], x=np.log(f), axis=0)
    return dict(zip(system.outputs, map(float, np.sqrt(power)), strict=True))
