"""Systems put together from masses, links and inerters, and the places where something may be missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from stepper import NMAX, Array, Element, Row, System

Values = Mapping[str, float]


@dataclass(frozen=True)
class Motion:
    """How two points move against each other, e = b.q + cw w, and all component paths that name it."""

    sites: tuple[str, ...]
    b: tuple[float, ...]
    cw: float = 0.0

    def travel(self) -> Row:
        """Return the elongation as a row."""
        return Row(q=_wide(self.b), w=self.cw)

    def speed(self) -> Row:
        """Return its rate as a row."""
        return Row(v=_wide(self.b), wd=self.cw)


@dataclass(frozen=True)
class Bond:
    """A spring and damper that an effect in series may take the place of."""

    motion: Motion
    k: str | float
    d: str | float
    sites: tuple[str, ...]

    def numbers(self, values: Values) -> tuple[float, float]:
        """Return stiffness and damping."""
        k, d = (values[x] if isinstance(x, str) else x for x in (self.k, self.d))
        return k, d

    def force(self, values: Values) -> Row:
        """Return the linear force as a row."""
        k, d = self.numbers(values)
        b, cw = _wide(self.motion.b), self.motion.cw
        return Row(q=k * b, v=d * b, w=k * cw, wd=d * cw)


class Assembly:
    """Matrices that grow by one element at a time, and the reaction on the prescribed motion."""

    def __init__(self, n: int) -> None:
        self.M, self.C, self.K = (np.zeros((n, n)) for _ in range(3))
        self.gu, self.gw, self.gd = (np.zeros(n) for _ in range(3))
        self.elements: list[Element] = []
        self.reaction = Row(reaction=1.0)

    def mass(self, m: float, *b: float) -> None:
        """Add m/2 (b.v)^2 to the kinetic energy."""
        self.M += m * np.outer(b, b)

    def link(self, motion: Motion, k: float, d: float) -> None:
        """Add a spring and a damper."""
        b = np.array(motion.b)
        self.K += k * np.outer(b, b)
        self.C += d * np.outer(b, b)
        self.gw -= k * motion.cw * b
        self.gd -= d * motion.cw * b
        pull = motion.cw * _wide(motion.b)
        self.reaction.q = self.reaction.q + k * pull
        self.reaction.v = self.reaction.v + d * pull
        self.reaction.w += k * motion.cw**2
        self.reaction.wd += d * motion.cw**2

    def system(self) -> System:
        """Return what the stepper takes."""
        return System(self.M, self.C, self.K, self.gu, self.gw, self.gd, list(self.elements))


@dataclass(frozen=True)
class Rig:
    """A topology: its uncertain parameters, its channels, its places.

    Attributes:
        parameters: nominal values of what is uncertain, by path of the nominal network.
        channels: name -> (path in the nominal network, unit); the first is the input.
        prescribed: whether the input is a motion rather than a force.
        assemble: (values, bond left out, extra mass at a node) -> assembly, and the rows of the outputs.
        motions, bonds, nodes: where effects act; nodes name the paths of what may be heavier than thought.
        loads: motion -> the bond whose force presses on friction there.
        kinds: place -> kinds of the vocabulary that make sense there.
        scale: a usual force.
        amplitude, band: size (rms of displacement, or of force) and frequencies [Hz] of excitations.
        resolution: of the input channel; 0 for that of a 16-bit converter.
        warp: bond, kind, coordinate and turn of a transmission that may run unevenly.
    """

    name: str
    parameters: dict[str, float]
    channels: dict[str, tuple[str, str]]
    prescribed: bool
    assemble: Callable[[Values, str, Mapping[str, float]], tuple[Assembly, list[Row]]]
    motions: dict[str, Motion]
    bonds: dict[str, Bond]
    nodes: dict[str, tuple[str, ...]]
    loads: dict[str, str]
    kinds: dict[str, tuple[str, ...]]
    scale: float
    amplitude: float
    band: tuple[float, float] = (0.5, 15.0)
    resolution: float = 0.0
    warp: tuple[str, str, tuple[float, ...], float] | None = None

    @property
    def input(self) -> str:
        """Channel that drives the rig."""
        return next(iter(self.channels))

    @property
    def outputs(self) -> tuple[str, ...]:
        """Channels that are predicted."""
        return tuple(self.channels)[1:]


def _wide(b: tuple[float, ...]) -> Array:
    return np.pad(np.array(b, float), (0, NMAX - len(b)))
