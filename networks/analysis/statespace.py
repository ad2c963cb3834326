"""`StateSpace`: a linear system whose states, inputs and outputs have names and units."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, Complex, Ints, ModelError, between, demand, listed, numbers, shown, text
from ...base.html import listed_notes, more, page, table_of_texts

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .modes import Mode
    from .norms import Norm
    from .operating import OperatingPoint

MOST_POLES = 20  # that a notebook shows


@dataclass(frozen=True, eq=False)
class StateSpace:
    """A linear system x' = A x + B u, y = C x + D u + D_s[0] u' + D_s[1] u'' + ...

    Attributes:
        A, B, C, D: matrices.
        D_s: what multiplies the derivatives of the inputs; empty for a proper system.
        states, inputs, outputs: names; `state_units`, `input_units`, `output_units`: their units.
        notes: what is to be known: what holds, what was left out, what is free.
        point: the operating point it was linearised at.
        slopes: for each parameter that was `Varied`, the derivatives of A, B, C, D in it.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    D_s: tuple[Array, ...] = ()
    name: str = "system"
    states: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    state_units: tuple[str, ...] = ()
    input_units: tuple[str, ...] = ()
    output_units: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    point: OperatingPoint | None = None
    slopes: Mapping[str, StateSpace] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in "ABCD":
            object.__setattr__(self, name, _matrix(name, getattr(self, name)))
        given: Any = self.D_s
        several = given if isinstance(given, list | tuple) else (given,)
        object.__setattr__(self, "D_s", tuple(_matrix("D_s", D) for D in several))
        demand("this system", name=(self.name, text))
        n, m, p = len(self.A), self.B.shape[1], len(self.C)
        shapes = {letter: getattr(self, letter).shape for letter in "ABCD"}
        if list(shapes.values()) != [(n, n), (n, m), (p, n), (p, m)]:
            told = ", ".join(f"{letter} {shape}" for letter, shape in shapes.items())
            raise ModelError(f"'{self.name}': matrices do not fit each other: {told}")
        if not all(np.isfinite(M).all() for M in (self.A, self.B, self.C, self.D, *self.D_s)):
            raise ModelError(f"'{self.name}': matrices must be of finite numbers")
        for kind, letter, count in (("state", "x", n), ("input", "u", m), ("output", "y", p)):
            defaults = numbered(letter, count), ("1",) * count
            for attribute, default in zip((f"{kind}s", f"{kind}_units"), defaults, strict=True):
                labels = listed(attribute, getattr(self, attribute))
                if labels and len(labels) != count:
                    told = f"there are {count} {kind}s, but {len(labels)} {attribute}"
                    raise ModelError(f"'{self.name}': {told}")
                object.__setattr__(self, attribute, labels or default)

    @property
    def proper(self) -> bool:
        """Whether no output contains a derivative of an input."""
        return not self.D_s

    @property
    def poles(self) -> Complex:
        """Poles [rad/s], slowest first."""
        poles = np.linalg.eigvals(self.A).astype(np.complex128)
        return poles[slowest_first(poles)]

    @property
    def zeros(self) -> Complex:
        """Transmission zeros [rad/s], slowest first; a `ModelError` unless proper and square."""
        from .modes import transmission_zeros

        return transmission_zeros(self)

    @property
    def stable(self) -> bool:
        """Whether every pole lies left of the imaginary axis."""
        return bool((self.poles.real < 0).all())

    def __call__(self, s: ArrayLike) -> Complex:
        """Return the transfer matrix at complex frequencies [rad/s], shape (..., outputs, inputs).

        Raises:
            ModelError: at a pole, where it is infinite.
        """
        at = np.asarray(s, dtype=np.complex128) if _are_numbers(s) else np.array(np.nan)
        if not (np.abs(at) < 1e60).all():
            raise ModelError(f"'{self.name}': a transfer function is taken at finite numbers, got {shown(s)}")
        eye = np.eye(len(self.A))
        matrices = at[..., None, None] * eye - self.A
        try:
            resolved: Any = np.linalg.solve(matrices, np.broadcast_to(self.B, (*at.shape, *self.B.shape)))
        except np.linalg.LinAlgError:
            ranks = ((p, np.linalg.matrix_rank(p * eye - self.A)) for p in at.ravel())
            pole = next((p for p, rank in ranks if rank < len(self.A)), at.ravel()[0])
            raise ModelError(
                f"'{self.name}': s = {pole:.6g} rad/s ({abs(pole) / (2 * math.pi):.6g} Hz) is a pole, where "
                "the response is infinite: nothing holds or damps that motion; leave that frequency out"
            ) from None
        value: Any = self.C @ resolved + self.D
        for order, D in enumerate(self.D_s, start=1):
            value = value + at[..., None, None] ** order * D
        return np.asarray(value, dtype=np.complex128)

    def response(self, f: ArrayLike) -> Complex:
        """Return the frequency response at frequencies [Hz], shape (..., outputs, inputs).

        Raises:
            ModelError: at a pole, where it is infinite.
        """
        demand("response()", f=(f, numbers(between(-1e60, 1e60, "Hz"))))
        return self(2j * math.pi * np.asarray(f, dtype=float))

    def __getitem__(self, pair: tuple[str | Sequence[str], str | Sequence[str]]) -> StateSpace:
        """Return the part from some inputs to some outputs: `system[outputs, inputs]`, by name."""
        from .composition import part_of

        return part_of(self, pair)

    def then(self, after: StateSpace, output: int | str = 0, name: str = "") -> StateSpace:
        """Return the system with one of its outputs passed through another system of one input and output.

        Args:
            after: a proper system.
            output: which one, by number or name.
            name: what it is called then.

        Raises:
            ModelError: if one of both is improper.
        """
        from .composition import chained

        return chained(self, after, output, name)

    def minimal(self, tolerance: float = 1e-9) -> StateSpace:
        """Return the part that inputs reach and outputs show; what is left out is told in `notes`.

        Args:
            tolerance: size, against the largest entry, below which a coupling counts as none.
        """
        from .minimal import minimal

        demand("minimal()", tolerance=(tolerance, between(0, 1)))
        return minimal(self, tolerance)

    def h2(self) -> Norm:
        """Return the H2 norm, exact (Lyapunov equation); infinite with a reason where it does not exist.

            ||G||2^2 = 1/(2 pi) integral tr G(jw)* G(jw) dw

        The rms of the outputs for white inputs of two-sided spectral density 1 per rad/s.
        """
        from .norms import h2

        return h2(self)

    def hinf(self, tolerance: float = 1e-10) -> Norm:
        """Return the H-infinity norm, the greatest gain over all frequencies, and where it is.

        Args:
            tolerance: relative error.

        Source: Bruinsma & Steinbuch, Systems & Control Letters 14 (1990) 287-293.
        """
        from .norms import hinf

        demand("hinf()", tolerance=(tolerance, between(1e-15, 0.1)))
        return hinf(self, tolerance)

    def modes(self) -> list[Mode]:
        """Return the modes: frequency, damping ratio, shape in the outputs; slowest first."""
        from .modes import modes

        return modes(self)

    def to_ss(self) -> Any:
        """Return the system as `control.StateSpace` of python-control, names kept.

        Raises:
            ModelError: for an improper system, or if python-control is not installed.
        """
        from .interop import to_control

        return to_control(self)

    def to_scipy(self) -> Any:
        """Return the system as `scipy.signal.StateSpace`.

        Raises:
            ModelError: for an improper system.
        """
        from .interop import to_scipy

        return to_scipy(self)

    @classmethod
    def from_ss(cls, system: Any, name: str = "system") -> StateSpace:
        """Return a system of python-control or SciPy (state space or transfer function) as a `StateSpace`."""
        from .interop import from_other

        demand("from_ss()", name=(name, text))
        return from_other(system, name)

    def plot_bode(self, f: ArrayLike | None = None) -> Figure:
        """Draw gain and phase over frequency [Hz], one column an input; return the figure."""
        from .bode import plot_bode

        return plot_bode(self, f)

    def plot_nyquist(self, f: ArrayLike | None = None) -> Figure:
        """Draw the frequency response in the complex plane; return the figure."""
        from .bode import plot_nyquist

        return plot_nyquist(self, f)

    def __repr__(self) -> str:
        improper = "" if self.proper else f", improper of order {len(self.D_s)}"
        ways = f"{', '.join(self.inputs)} -> {', '.join(self.outputs)}"
        return f"<StateSpace '{self.name}': {ways}, {len(self.states)} states{improper}>"

    def _repr_html_(self) -> str:
        poles = [pole for pole in self.poles if pole.imag >= 0]
        first = poles[:MOST_POLES]
        ratios = (f"{-pole.real / abs(pole):.3g}" if pole else "-" for pole in first)
        sizes = (f"{abs(pole) / (2 * np.pi):.4g}" for pole in first)
        rows = zip((f"{pole:.5g}" for pole in first), sizes, ratios, strict=True)
        return page(
            self.name,
            f"{', '.join(self.inputs)} → {', '.join(self.outputs)} · {len(self.states)} states",
            table_of_texts(("pole [rad/s]", "frequency [Hz]", "damping ratio"), rows),
            more(len(poles) - len(first)),
            listed_notes(self.notes),
        )


def slowest_first(values: Complex) -> Ints:
    """Return the order in which poles or zeros are told."""
    return np.asarray(np.lexsort((values.imag, np.abs(values))))


def numbered(letter: str, count: int) -> tuple[str, ...]:
    """Return names such as x1, x2, ... for what has none of its own."""
    return tuple(f"{letter}{k + 1}" for k in range(count))


def _are_numbers(values: Any) -> bool:
    try:
        return bool(np.issubdtype(np.asarray(values).dtype, np.number))
    except ValueError:
        return False


def _matrix(name: str, given: Any) -> Any:
    if not _are_numbers(given) or np.ndim(given) != 2:
        raise ModelError(f"{name} must be a matrix of numbers, got {shown(given)}")
    return np.asarray(given)
