"""A rig that tests inerters: housing on a frame, rod on an actuator that prescribes its motion."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...base import Array, ModelError, above, at_least, demand, finite, function, instance, shown, whole
from ...components import Backlash, Component, Fixed, Planet, Position
from ...components.language import parts_of
from ..network import Network
from ..results.result import Result

LINE_LIMIT = 100_000


@dataclass(frozen=True)
class Sinusoid:
    """Displacement x = amplitude sin(2 pi frequency t).

    Args:
        amplitude: [m].
        frequency: [Hz].
    """

    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        demand(
            "a Sinusoid", amplitude=(self.amplitude, finite("m")), frequency=(self.frequency, finite("Hz"))
        )

    def __call__(self, t: Any) -> Any:
        return self.amplitude * ca.sin(2 * pi * self.frequency * t)


@dataclass(frozen=True)
class RandomDisplacement:
    """Displacement of white velocity within a band: power spectral density G(f) = level/f^2.

    A sum of sines at the multiples of 1/period within the band, with random phases.

    Args:
        seed: of the phases.
        period: time after which it repeats [s].
        low, high: the band [Hz].
        level: [m2.Hz].

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (31).
    """

    seed: int
    period: float = 10.0
    low: float = 0.5
    high: float = 15.0
    level: float = 6.4e-6

    def __post_init__(self) -> None:
        demand(
            "a RandomDisplacement",
            seed=(self.seed, whole(0)),
            period=(self.period, above(0, "s")),
            low=(self.low, above(0, "Hz")),
            high=(self.high, above(0, "Hz")),
            level=(self.level, above(0, "m2.Hz")),
        )
        if not 1 <= (self.high - self.low) * self.period <= LINE_LIMIT or not len(self.lines):
            raise ModelError(
                f"a RandomDisplacement is of 1 to {LINE_LIMIT:.0e} lines, 1/period apart, from low to high, "
                f"got {self.low:g} to {self.high:g} Hz with a period of {self.period:g} s"
            )

    @property
    def lines(self) -> NDArray[np.int64]:
        """Numbers of the harmonics of 1/period it is made of."""
        first, last = np.ceil(self.low * self.period), np.floor(self.high * self.period)
        return np.arange(int(first), int(last) + 1)

    def __call__(self, t: Any) -> Any:
        f = self.lines / self.period
        amplitudes = np.sqrt(2 * self.level / self.period) / f
        phases = np.random.default_rng(self.seed).uniform(0, 2 * pi, len(f))
        return ca.dot(ca.DM(amplitudes), ca.sin(ca.DM(2 * pi * f) * t + ca.DM(phases)))


def inerter_rig(inerter: Component, displacement: Callable[[Any], Any]) -> Network:
    """Return the network of `frame`, `actuator` and `inerter`, the rod moving as prescribed [m]."""
    demand("inerter_rig()", inerter=(inerter, instance(Component)), displacement=(displacement, function))
    net = Network("rig", frame=Fixed(), actuator=Position(s_ref=displacement), inerter=inerter)
    net.connect(net.actuator.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.frame.flange)
    return net


def run_on_rig(inerter: Component, displacement: Callable[[Any], Any], stop: float, **options: Any) -> Result:
    """Run an inerter on the rig from a rolling start: every contact unstretched and at one speed.

    From any other start the screw rings on its axial stiffness for seconds.

    Args:
        inerter: with `flange_a` on the rod and `flange_b` on the housing.
        displacement: of the rod over time, x1(t) [m].
        stop: end time [s].
        options: for `simulate`.

    Returns:
        The run; the force on the rod is `inerter.flange_a.f`.
    """
    demand("run_on_rig()", inerter=(inerter, instance(Component)))
    rolling = {f"{path}.{x}": 0.0 for path in _contacts(inerter, "inerter") for x in ("s_rel", "v_rel")}
    return inerter_rig(inerter, displacement).simulate(stop, start=rolling, **options)


def _contacts(component: Component, path: str) -> Iterator[str]:
    if isinstance(component, Backlash | Planet):
        yield path
    for name, part in parts_of(component).items():
        yield from _contacts(part, f"{path}.{name}")


def rig_response(
    inerter: Component, displacements: Sequence[RandomDisplacement], settle: float = 2.0, **options: Any
) -> tuple[Array, NDArray[np.complex128]]:
    """Return frequencies [Hz] and H(f) = G_xF/G_xx [N/m] under random displacements of one period.

    Args:
        inerter: what is tested, anew for each displacement.
        displacements: realisations over which the spectra are averaged.
        settle: time left out before the period that is evaluated [s].
        options: for `simulate`.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (32).
    """
    demand("rig_response()", inerter=(inerter, instance(Component)), settle=(settle, at_least(0, "s")))
    given: Any = displacements
    if not (isinstance(given, Sequence) and given and all(isinstance(d, RandomDisplacement) for d in given)):
        raise ModelError(f"displacements are RandomDisplacements of one band, got {shown(displacements)}")
    lines, period = displacements[0].lines, displacements[0].period
    cross, power = np.zeros((2, len(lines)), dtype=np.complex128)
    for displacement in displacements:
        run = run_on_rig(inerter.clone(), displacement, period, begin=-settle, step=1e-3, **options)
        x, F = (_spectrum(run, name, period)[lines] for name in ("actuator.s_ref", "inerter.flange_a.f"))
        cross += x.conj() * F
        power += x.conj() * x
    return lines / period, cross / power


def _spectrum(run: Result, name: str, period: float) -> NDArray[np.complex128]:
    """Return the Fourier coefficients of a signal over one period."""
    times = np.arange(0, period, 1e-3)
    return np.fft.rfft(np.interp(times, run.time, run[name])) / len(times)
