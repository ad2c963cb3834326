"""Operating points: where a network is looked at, in which modes, and how the point was found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array, ModelError, between, check_keywords, demand, finite, named, text, whole
from ..dae import DAE
from ..given import dae_of
from ..network import Network
from ..results.result import Result
from ..simulation.bound_dae import BoundDAE, bound
from ..simulation.consistent_start import begun
from ..simulation.coverage import check_covered
from ..simulation.initialization import start_values
from ..simulation.point import Point
from .resting import HOLDING_MODES, mode_values, settle


@dataclass(eq=False)
class OperatingPoint:
    """States, algebraic unknowns, inputs and constants at one instant, and what is to be known about them.

    Attributes:
        notes: free directions, other equilibria, friction that holds.
    """

    dae: DAE
    t: float
    x: Array
    z: Array
    u: Array
    q: Array
    notes: list[str] = field(default_factory=list)

    @property
    def values(self) -> dict[str, float]:
        """States by name."""
        return dict(zip(self.dae.state_names, map(float, self.x), strict=True))

    @property
    def modes(self) -> dict[str, str]:
        """Name of each mode's present value."""
        return mode_values(self.dae, self.q)


def operating_point(
    dae: Network | DAE,
    at: str | Result = "equilibrium",
    *,
    time: float = 0.0,
    start: Mapping[str, float] | None = None,
    inputs: Mapping[str, Any] | None = None,
    parameters: Mapping[str, float] | None = None,
) -> OperatingPoint:
    """Return where a network stands still, where it starts, or where a run was.

    Args:
        dae: the equations, or their network.
        at: "equilibrium" (nearest to the start), "start", or a `Result` to look at.
        time: instant [s], of a run or of the signals.
        start: start values by name, from which the equilibrium is looked for.
        inputs: signals by name; 0 where an input has none. At an equilibrium they keep their value at `time`.
        parameters: changed parameters by name.

    Raises:
        ModelError: for an unknown `at`, or if there is no equilibrium.
    """
    dae = dae_of(dae)
    demand("operating_point()", time=(time, finite("s")))
    if isinstance(at, Result):
        return _of_run(at, time)
    if text(at) or at not in ("equilibrium", "start"):
        raise ModelError(f"'{dae.name}': at is 'equilibrium', 'start' or a Result, got {at!r}")
    signals = inputs_at_rest(dae) | named("inputs", inputs)
    check_covered(dae.name, bound(dae, signals).signals, time, time)
    if at == "equilibrium":
        signals = _held(dae, signals, time)
    closed = bound(dae, signals)
    q = closed.blank(dae.parameters.values(named("parameters", parameters)))
    run = begun(closed, q, time, start_values(dae, named("start", start), {}))
    notes = list(run.switcher.notes) if run.switcher else []
    if at == "equilibrium":
        notes += settle(closed, run.point, run.switcher)
    return _point(closed, run.point, notes)


def equilibria(
    dae: Network | DAE, starts: int = 30, spread: float = 1.0, *, seed: int = 0, **options: Any
) -> list[OperatingPoint]:
    """Return the equilibria that a search from several starts finds, each once, nearest first.

    Args:
        dae: the equations, or their network.
        starts: number of random starts.
        spread: their standard deviation about the start, in the SI unit of each state.
        seed: of the random starts.
        options: `inputs`, `parameters`, `start` as for `operating_point`.

    Raises:
        ModelError: if none is found.
    """
    dae = dae_of(dae)
    sizes = {"starts": (starts, whole(0)), "seed": (seed, whole(0))}
    demand("equilibria()", spread=(spread, between(0, 1e100)), **sizes)
    check_keywords("equilibria()", options, operating_point)
    begin = named("start", options.pop("start", None))
    rng = np.random.default_rng(seed)
    first = operating_point(dae, "start", start=begin, **options)
    tries = [first.x, *(first.x + spread * rng.standard_normal(len(first.x)) for _ in range(starts))]
    found: list[OperatingPoint] = []
    problem: ModelError | None = None
    for tried in tries:
        try:
            values = dict(zip(dae.state_names, tried, strict=True)) | begin
            point = operating_point(dae, start=values, **options)
        except ModelError as error:
            problem = error
            continue
        if not any(np.allclose(point.x, other.x, rtol=1e-6, atol=1e-8) for other in found):
            found.append(point)
    if not found and problem:
        raise problem
    return found


def inputs_at_rest(dae: DAE) -> dict[str, Any]:
    """Return 0 for every input that has no signal of its own."""
    return {i.path: 0.0 for i in dae.inputs if i.order == 0 and i.signal is None}


def _held(dae: DAE, signals: dict[str, Any], time: float) -> dict[str, Any]:
    """Return every signal's value at an instant, as a constant."""
    values = _inputs(bound(dae, signals), time)
    return {i.path: float(i.sign * v) for i, v in zip(dae.inputs, values, strict=True) if i.order == 0}


def _of_run(run: Result, time: float) -> OperatingPoint:
    points = run.points
    begin, end = points.t[0], points.t[-1]
    if not begin <= time <= end:
        raise ModelError(f"'{run.name}' ran from {begin:g} s to {end:g} s, not to {time:g} s")
    k = int(np.searchsorted(points.t, time))
    near = points.only(slice(max(k - 1, 0), k + 1))
    x, z = (np.array([np.interp(time, near.t, column) for column in m.T]) for m in (near.x, near.z))
    return _point(run.closed, Point(time, x, z, points.q[k].copy()), [])


def _point(closed: BoundDAE, point: Point, notes: list[str]) -> OperatingPoint:
    found = OperatingPoint(closed.dae, point.t, point.x, point.z, _inputs(closed, point.t), point.q, notes)
    holding = [f"{name} is '{value}'" for name, value in found.modes.items() if value in HOLDING_MODES]
    notes += [f"{told}: linear only while it holds" for told in holding]
    return found


def _inputs(closed: BoundDAE, time: float) -> Array:
    """Return the values of the inputs and their derivatives at an instant."""
    return np.asarray(ca.Function("inputs", [closed.t], [closed.u])(time).full().ravel())
