"""Stepper: one compiled integrator over scaled time, used for every segment of a run."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import ceil, inf, log
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...base import Array, ModelError, foreign
from ..evaluation.compiled import Compiled
from .point import Point
from .settings import Tolerance

if TYPE_CHECKING:
    from .bound_dae import BoundDAE


class IntegratorError(Exception):
    """The integrator gave up; the message is its own."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """What one call computed: states (nodes, nx), algebraic unknowns (nodes, nz), steps taken."""

    states: Array
    algebraic: Array
    steps: int

    def end(self, t: float, q: Array) -> Point:
        """Return where the last node lies, at time t."""
        return Point(t, self.states[-1], self.algebraic[-1], q)


class Stepper:
    """Integrates from a point over any duration, with `nodes` equidistant outputs.

    States are scaled by powers of two near their nominal values, so that one absolute tolerance
    serves them all and no value is rounded.
    """

    def __init__(
        self, closed: BoundDAE, solver: str, tolerance: Tolerance, nodes: int, most_steps: int
    ) -> None:
        dae = closed.dae
        if solver == "auto":
            solver = "idas" if dae.z.numel() else "cvodes"
        if solver == "cvodes" and dae.z.numel():
            raise ModelError(
                f"'{dae.name}' keeps {dae.z.numel()} algebraic unknowns, which solver 'cvodes' cannot "
                "handle; use 'idas', 'rosenbrock' or 'auto'"
            )
        if dae.hybrid and solver != "rosenbrock":
            tolerance = tolerance.between_events()
        self.solver, self.nodes, self.most_steps = solver, nodes, most_steps
        self.scale = nominal_sizes(dae, dae.states)
        self.nx = dae.x.numel()
        self._closed, self._tolerance = closed, tolerance
        self._divided = cache(self._build)
        self._compiled = self._divided(1)
        self._stretch = 0.0, 0.0
        function = self._compiled.function
        self._unused = [np.zeros(function.nnz_in(i)) for i in range(3, function.n_in())]

    def _build(self, parts: int) -> Compiled:
        """Return the integrator that takes at least so many steps for a stretch."""
        closed = self._closed
        kind: Any = type(closed.x)
        begin, span, tau = (kind.sym(n) for n in ("begin", "span", "tau"))
        x, scale = closed.x, ca.DM(self.scale)
        ode, alg = closed.close(closed.dae.ode), closed.close(closed.dae.alg)
        plain = bool((self.scale == 1).all())
        if not plain or closed.sampled or ca.depends_on(ca.vertcat(ode, alg), closed.t):
            rates = closed.function("rates", ode, alg)
            ode, alg = rates(x if plain else x * scale, closed.z, closed.q, begin + span * tau)
        if not self.nx:
            x, ode, scale = kind.sym("none"), kind(0), ca.DM(1)
        ode, p = span * (ode if plain else ode / scale), ca.vertcat(closed.q, begin, span)
        options: dict[str, Any] = {
            "reltol": self._tolerance.rtol,
            "abstol": self._tolerance.atol,
            "max_num_steps": self.most_steps + -(-parts // self.nodes),
            "show_eval_warnings": False,
        }
        if parts > 1:
            options["max_step_size"] = 1 / parts
        if self.solver != "rosenbrock":
            options["disable_internal_warnings"] = True
        grid = np.linspace(0, 1, self.nodes + 1)[1:]
        problem = dict(x=x, z=closed.z, p=p, t=tau, ode=ode, alg=alg)
        return Compiled(ca.integrator("run", self.solver, problem, 0.0, grid, options))

    def run(self, point: Point, span: float, max_step: float = inf) -> Stretch:
        """Integrate over (t, t + span], in steps no longer than `max_step`, or a quarter of it."""
        x0 = point.x / self.scale if self.nx else np.zeros(1)
        self._compiled = self._divided(_parts(span, max_step))
        self._stretch = point.t, span
        self._compiled.empty()
        try:
            with foreign():
                results = self._compiled(x0, point.z, np.append(point.q, (point.t, span)), *self._unused)
        except RuntimeError as error:
            raise IntegratorError(str(error)) from error
        stretch = self._stretched(results)
        if not np.isfinite(stretch.states).all():
            raise IntegratorError(f"{self.solver} left the finite numbers")
        return stretch

    def _stretched(self, results: list[Array]) -> Stretch:
        stats = self._compiled.stats()
        states, algebraic = (result.reshape(self.nodes, -1) for result in results[:2])
        steps = int(stats.get("nsteps", stats.get("n_steps", 0)))
        return Stretch(states[:, : self.nx] * self.scale, algebraic, steps)

    def reached(self) -> Stretch:
        """Return what a call that Ctrl-C ended had computed."""
        done = round(self._compiled.filled() * self.nodes)
        if not done:  # perhaps not even begun, when there are no statistics
            return Stretch(np.zeros((0, self.nx)), np.zeros((0, self._closed.z.numel())), 0)
        stretch = self._stretched(self._compiled.results())
        return Stretch(stretch.states[:done], stretch.algebraic[:done], stretch.steps)

    def now(self) -> float:
        """Return the time to which the call under way in another thread has come."""
        t, span = self._stretch
        return t + span * self._compiled.filled()

    def sensitivity(self, point: Point, span: float, max_step: float, seeds: tuple[Array, Array]) -> Array:
        """Return d(states)/d(seeds), (nx, nodes, seeds); seeds are directions (of x, of q)."""
        of_x, of_q = seeds
        count = of_x.shape[1]
        function = self._divided(_parts(span, max_step)).function
        forward = function.forward(count)
        given = {"x0": point.x / self.scale, "z0": point.z, "p": np.append(point.q, (point.t, span))}
        try:
            with foreign():
                given |= {f"out_{name}": value for name, value in function(**given).items()}
                given["fwd_x0"] = of_x / self.scale[:, None]
                given["fwd_p"] = np.vstack([of_q, np.zeros((2, count))])
                result = forward(**{name: given[name] for name in forward.name_in() if name in given})
        except RuntimeError as error:
            raise IntegratorError(str(error)) from error
        by_seed = result["fwd_xf"].full()[: self.nx].reshape(self.nx, count, self.nodes)
        moved: Array = by_seed.transpose(0, 2, 1) * self.scale[:, None, None]
        return moved


def _parts(span: float, max_step: float) -> int:
    """Return how many steps a stretch takes at least: a power of four, so that few kinds are made."""
    return 4 ** ceil(log(span / max_step, 4) - 1e-9) if span > max_step else 1


def nominal_sizes(dae: Any, variables: list[int]) -> Array:
    """Return the powers of two nearest the nominal values of joined variables."""
    nominal = dae.declared.nominal
    sizes = [nominal[s] if s < len(nominal) else 1.0 for s in variables]
    powers: Array = np.exp2(np.round(np.log2(np.array(sizes, dtype=float))))
    return powers
