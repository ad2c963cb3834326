"""Stepped sine: frequency responses measured on the simulated network, true friction and stops included."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import (
    Array,
    Complex,
    ModelError,
    SimulationError,
    above,
    check_keywords,
    demand,
    listed,
    named,
    numbers,
    whole,
)
from ...components import FAMILIES, Component, Domain, signals
from ...components.language import PortRef, values_of
from ..given import element_of, network_of
from ..network import Network
from ..results.result import Result
from ..simulation.simulate import simulate
from .orbits import drive_amplitude, drive_frequency, harmonics_of
from .probing import port

POINTS_A_PERIOD = 256
PERIODS_A_RUN = 4
HARMONICS = 10
DRIVE = "stepped_sine"


@dataclass(frozen=True, eq=False)
class SteppedSine:
    """Steady vibration at each frequency.

    Attributes:
        frequency: [Hz], in the order they were stepped through.
        harmonics: of each output, complex amplitudes against the drive's sine, (frequencies, harmonics).
        settled: whether the motion repeated itself within the tolerance.
    """

    frequency: Array
    harmonics: dict[str, Complex]
    settled: NDArray[np.bool_]
    drive: float

    def amplitude(self, output: str, harmonic: int = 1) -> Array:
        """Return amplitudes of a harmonic of an output."""
        return np.abs(harmonics_of(self.harmonics, output, harmonic)[:, harmonic])

    def response(self, output: str) -> Complex:
        """Return the first harmonic of an output over the drive: what a linear system calls its response."""
        return np.asarray(harmonics_of(self.harmonics, output)[:, 1] / self.drive)


def stepped_sine(
    network: Network,
    driven: str,
    amplitude: float,
    frequencies: ArrayLike,
    outputs: Sequence[str],
    *,
    tolerance: float = 1e-4,
    most: int = 200,
    inputs: Mapping[str, Any] | None = None,
    start: Mapping[str, float] | None = None,
    **options: Any,
) -> SteppedSine:
    """Return the steady response to amplitude sin(2 pi f t), stepped through frequencies by simulation.

    Each frequency starts from the motion of the last, so that up and down part where the curve folds.

    Args:
        network: any, with or without modes.
        driven: the input, such as "push.f".
        amplitude: of its sine, in its unit.
        frequencies: [Hz], in the order wanted.
        outputs: what is looked at, by name.
        tolerance: relative change from one period to the next below which a motion counts as steady.
        most: periods after which it is taken as it is.
        inputs: signals of other inputs.
        start: start values of the first run.
        options: for `simulate`: `rtol`, `atol`, `solver`, `parameters`.

    Raises:
        ModelError: for an unknown input.
    """
    demand(
        "stepped_sine()",
        amplitude=(amplitude, drive_amplitude),
        frequencies=(frequencies, numbers(drive_frequency)),
        tolerance=(tolerance, above(0)),
        most=(most, whole(1)),
    )
    check_keywords("stepped_sine()", options, simulate)
    dae = _with_drive(network_of(network), driven, amplitude).dae()
    wanted = listed("outputs", outputs)
    if not wanted:
        raise ModelError("stepped_sine() looks at one output at least, got none")
    state, inputs = named("start", start), named("inputs", inputs)
    parameters = named("parameters", options.pop("parameters", None))
    steps = np.ravel(np.asarray(frequencies, dtype=float))
    lines = np.zeros((len(steps), len(wanted), HARMONICS), dtype=complex)
    settled = np.zeros(len(steps), dtype=bool)
    for number, f in enumerate(steps):
        last: Complex | None = None
        for _ in range(max(1, most // PERIODS_A_RUN)):
            run = simulate(
                dae, PERIODS_A_RUN / f, start=state, inputs=inputs, step=1.0 / f / POINTS_A_PERIOD,
                progress=False, parameters=parameters | {f"{DRIVE}.f": float(f)}, **options,
            )  # fmt: skip
            state = {name: float(run[name][-1]) for name in dae.state_names}
            before, now = (_harmonics(run, wanted, f, PERIODS_A_RUN - k) for k in (2, 1))
            change = _change(before, now)
            if last is not None:
                change = np.maximum(change, _change(last, now) / PERIODS_A_RUN)
            last = lines[number] = now
            settled[number] = (change < tolerance).all()
            if settled[number]:
                break
    harmonics = {name: lines[:, k] for k, name in enumerate(wanted)}
    return SteppedSine(steps, harmonics, settled, amplitude)


def _change(before: Complex, now: Complex) -> Array:
    """Return by how much the harmonics of each output differ, against the greatest of them."""
    return np.asarray(np.abs(now - before).max(axis=1) / np.maximum(np.abs(now).max(axis=1), 1e-300))


def describing_function(
    element: Component, amplitude: float, frequency: float = 1.0, **options: Any
) -> complex:
    """Return the force of an element over its motion in the first harmonic, F_1/X_1 [N/m or N.m/rad].

    It is driven by amplitude sin(2 pi f t): the real part is a stiffness, the imaginary one w times a
    damping constant.

    Args:
        element: with two flanges.
        amplitude: of its relative motion [m or rad].
        frequency: [Hz].
        options: as for `stepped_sine`.

    Source: Gelb & Vander Velde, Multiple-Input Describing Functions (1968), chapter 2.
    """
    if not {"flange_a", "flange_b"} <= type(element_of(element)).fields.keys():
        raise ModelError(
            f"a describing function is of an element with flange_a and flange_b, not of {element!r}"
        )
    domain = PortRef(element, "flange_a").domain or Domain.TRANSLATIONAL
    family = FAMILIES[domain]
    parts = {"drive": family.Position(), "wall": family.Fixed(), "element": element.clone()}
    net = Network("describing function", **parts)
    net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.drive.flange)
    driven, force = f"drive.{domain.across}_ref", f"element.flange_b.{domain.through}"
    found = stepped_sine(net, driven, amplitude, [frequency], [force], **options)
    if not found.settled[0]:
        raise SimulationError(f"the force of {element!r} does not settle within most= periods")
    return complex(found.response(force)[0])


def _with_drive(network: Network, driven: str, amplitude: float) -> Network:
    net = network.clone()
    into = port(net, driven)
    values_of(into.component).pop(into.name, None)
    net.add(**{DRIVE: signals.Sine(f=1.0, amplitude=amplitude)})
    try:
        return net.connect(getattr(net, DRIVE).y, into)
    except ModelError as error:
        raise ModelError(f"'{network.name}' has no input '{driven}'") from error


def _harmonics(run: Result, names: Sequence[str], f: float, period: int) -> Complex:
    """Return complex amplitudes against sine over one period, (signals, harmonics)."""
    times = (period + np.arange(POINTS_A_PERIOD) / POINTS_A_PERIOD) / f
    values = np.array([np.interp(times, run.time, run[name]) for name in names])
    lines: Complex = 2j * np.fft.rfft(values, axis=1)[:, :HARMONICS] / POINTS_A_PERIOD
    lines[:, 0] /= 2j
    return lines
