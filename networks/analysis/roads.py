"""Excitations: ISO 8608 roads, bumps, and records of earthquakes and wind."""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError, above, between, demand, finite, numbers, optional, path_of, text, whole
from ...base.tables import read_table
from ...components.language import Sampled

N_0 = 0.1
G_D: dict[str, float] = {letter: 16e-6 * 4.0**k for k, letter in enumerate("ABCDEFGH")}
MOST_WAVES = 1e7


def road_spectrum(road_class: str, n: ArrayLike) -> Array:
    """Return the displacement spectrum of a road: G_d(n) = G_d(n_0) (n/n_0)^-2 [m3], one-sided.

    Args:
        road_class: "A" (motorway) to "H"; G_d at n_0 = 0.1 cycle/m is 16e-6 m3 for A and 4 times more each.
        n: spatial frequency [cycle/m].

    Source: ISO 8608:2016, geometric means of the classes.
    """
    for check in (above(0, "cycle/m"), between(1e-100, 1e100, "cycle/m")):
        demand("road_spectrum()", n=(n, numbers(check)))
    return np.asarray(_class(road_class) * (np.asarray(n, dtype=float) / N_0) ** -2.0)


def roughness(road_class: str) -> float:
    """Return kappa [m3/cycle] of the two-sided spectrum kappa/n^2 that J1 and J3 use: G_d(n_0) n_0^2/2."""
    return _class(road_class) * N_0**2 / 2


def road_profile(
    road_class: str, speed: float, duration: float, seed: int = 0, *, low: float = 0.011, high: float = 2.83
) -> Sampled:
    """Return the height of a random road under a wheel over time [m], Gaussian, from 0 at the start.

    A sum of sines with random phases at the multiples of 1/length, with the class's spectrum.

    Args:
        road_class: "A" to "H".
        speed: of the vehicle [m/s].
        duration: [s].
        seed: of the phases.
        low: least spatial frequency [cycle/m].
        high: greatest spatial frequency [cycle/m].

    Raises:
        ModelError: for an unknown class, a road shorter than its longest wave, or one of over 1e7 waves.
    """
    demand(
        "road_profile()",
        speed=(speed, above(0, "m/s")),
        duration=(duration, above(0, "s")),
        seed=(seed, whole(0)),
        low=(low, above(0, "cycle/m")),
    )
    demand("road_profile()", high=(high, above(low, "cycle/m")))
    length = speed * duration
    if not length * high <= MOST_WAVES:
        raise ModelError(
            f"a road of {length:g} m has over {MOST_WAVES:.0e} waves up to {high:g} cycle/m; drive a "
            "shorter one"
        )
    if not length * low >= 1.0:
        raise ModelError(
            f"a road of {length:g} m holds no wave of {low:g} cycle/m; drive over {1 / (low * speed):g} s"
        )
    lines = np.arange(int(np.ceil(low * length)), int(high * length) + 1)
    count = 8 * int(2 ** np.ceil(np.log2(lines[-1])))
    amplitudes = np.sqrt(2 * road_spectrum(road_class, lines / length) / length)
    phases = np.random.default_rng(seed).uniform(0, 2 * pi, len(lines))
    spectrum = np.zeros(count // 2 + 1, dtype=complex)
    spectrum[lines] = amplitudes * np.exp(1j * phases) * count / 2
    height = np.fft.irfft(spectrum, count)
    return Sampled(np.linspace(0.0, duration, count + 1), np.r_[height, height[0]] - height[0])


def bump(height: float, length: float, speed: float, begin: float = 0.0) -> Callable[[Any], Any]:
    """Return a bump shaped as one wave of a cosine, height (1 - cos(2 pi x/length))/2, as a function of time.

    Args:
        height: [m]; negative for a pothole.
        length: [m].
        speed: of the vehicle [m/s].
        begin: when the wheel meets it [s].

    Raises:
        ModelError: for a length or speed that is not above 0.
    """
    demand(
        "bump()",
        height=(height, finite("m")),
        length=(length, above(0, "m")),
        speed=(speed, above(0, "m/s")),
        begin=(begin, finite("s")),
    )

    def profile(t: Any) -> Any:
        x = speed * (t - begin)
        wave = height / 2 * (1 - ca.cos(2 * pi * x / length))
        return ca.if_else(ca.logic_and(x > 0, x < length), wave, 0.0)

    return profile


def load_signal(
    path: str | Path, column: str | None = None, *, time: str = "time", scale: float = 1.0
) -> Sampled:
    """Return a measured signal from a file, such as the acceleration of the ground or the force of wind.

    Args:
        path: .csv or another table, as of `load_table`; or .at2 of the PEER ground motion database, whose g
            become m/s2.
        column: of the signal; the first beside `time` if None.
        time: column of the instants [s].
        scale: factor to SI units.

    Raises:
        ModelError: for a missing file or column, or what is no finite number or out of order, with its line.
    """
    file = path_of(path, "a record")
    demand("load_signal()", scale=(scale, finite()), time=(time, text), column=(column, optional(text)))
    table = read_table(file)
    instants = table.in_si(time, "s")
    wanted = column or next((name for name in table.columns if name != time), "")
    values = table.column(wanted)
    wrong = table.time_problem(time, instants) or table.number_problem(wanted, values)
    if wrong:
        raise ModelError(wrong)
    return Sampled(instants, scale * values)


def _class(road_class: str) -> float:
    if text(road_class) or road_class not in G_D:
        raise ModelError(f"road classes are A to H (ISO 8608), got {road_class!r}")
    return G_D[road_class]
