"""Variations: how a run answers to small changes of parameters and start values, events included."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import casadi as ca
import numpy as np

from ...base import (
    Array,
    ModelError,
    demand,
    finite,
    instance,
    interruptible,
    listed,
    named,
    nearest,
    numbers,
    shown,
    text,
)
from ..dae import DAE
from ..evaluation.compiled import Batch, dense
from ..evaluation.jacobians import Slopes
from ..evaluation.linearised import Line, held, linearised
from ..evaluation.saltation import SaltationMatrices
from ..flattening.vectors import pick
from ..results.result import Result
from ..simulation.events.switcher import Point
from ..simulation.initialization import start_values
from ..simulation.sensitivity import start_slopes
from .forced import Forced


class Variations:
    """Slopes of signals in parameters and start values of the states along runs of one `DAE`.

    Along a run, with algebraic unknowns eliminated,

        d(dx)/dt = A dx + B dp,   dy = C dx + D dp,

    integrated from point to point by the exponential of the mean of A (where it is stiff, as Radau IIA of
    order 5 does), with B dp straight between the points. Where modes switch at g = 0, the instant moves by
    dt = -dg/g', and with R the slope of the reset the state by

        dx+ = R (dx- + x'- dt) - x'+ dt.

    Args:
        dae: the equations.
        signals: the variables whose slopes are wanted.
        parameters: the parameters in which.

    Raises:
        ModelError: for unknown parameters, and for networks with shocks; later for runs in which a prescribed
            motion jumps.
        UnknownNameError: for unknown signals, with the nearest name.

    Limits: as accurate as the points of the run resolve what happens between them.

    Source: I. A. Hiskens, M. A. Pai, Trajectory sensitivity analysis of hybrid systems, IEEE Trans. Circuits
    Syst. I 47 (2000) 204-220.

    Example:
        >>> from inertance import Fixed, Mass, Network, Spring, Variations, simulate
        >>> net = Network("swing", wall=Fixed(), spring=Spring(k=1.0), mass=Mass(m=1.0, s=0.1))
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange)
        >>> dae = net.dae()
        >>> slopes = Variations(dae, ["mass.s"], ["spring.k"]).along(simulate(dae, 1.0))
        >>> slopes.shape
        (501, 1, 3)
    """

    @interruptible()
    def __init__(self, dae: DAE, signals: Sequence[str], parameters: Sequence[str]) -> None:
        demand("Variations", dae=(dae, instance(DAE)))
        signals, parameters = listed("signals", signals), listed("parameters", parameters)
        known = dae.parameters.index
        told = [f"there is no parameter '{n}'{nearest(n, known)}" for n in parameters if n not in known]
        if told:
            raise ModelError("variations cannot be computed:", told)
        if dae.impulses.numel():
            raise ModelError(f"'{dae.name}' has shocks, whose variations are not known; compare runs instead")
        self.dae, self.signals, self.parameters = dae, list(signals), list(parameters)
        columns = pick(dae.p, [known[name] for name in parameters])
        wanted = [dae.expression(name) for name in signals]
        self._values = Batch(ca.Function("values", dae.arguments(), dense(ca.vertcat(*wanted))))
        self._slopes = Slopes(dae, ca.vertcat(dae.ode, *wanted), columns)
        self._saltation = SaltationMatrices(dae, columns)
        self._line: Line | None = None

    def values(self, result: Result, at: Any) -> Array:
        """Return the signals themselves at some of the points of a run, (points, signals)."""
        demand("Variations", result=(result, instance(Result)))
        rows = np.arange(len(result.time))
        try:
            chosen = np.ravel(rows[at])
        except (IndexError, TypeError, ValueError):
            told = f"points of a run are numbers from 0 to {len(rows) - 1}"
            raise ModelError(f"{told}, got {shown(at)}") from None
        return self._values(*result.points.only(chosen).arguments)[0][:, :, 0]

    def along(self, result: Result, start: Array | None = None) -> Array:
        """Return d(signals)/d(parameters, states at the start), (points, signals, directions).

        Args:
            result: a run of the `DAE`.
            start: d(states at the start)/d(parameters), (states, parameters); zero if not given.
        """
        nx, count = self.dae.x.numel(), len(self.parameters)
        demand("Variations", result=(result, instance(Result)))
        if start is not None and (
            np.shape(start) != (nx, count) or (nx * count and numbers(finite())(start))
        ):
            raise ModelError(f"start is an array of numbers of shape {(nx, count)}, got {shown(start)}")
        moved = np.hstack([np.zeros((nx, count)) if start is None else start, np.eye(nx)])
        line = self._linearised(result)
        added = np.zeros((len(line.steps.own), nx, count + nx))
        added[:, :, :count] = line.steps.own
        slopes = line.to_x[:, nx:] @ line.steps.carry(held(self.dae, result.segments[0], moved), added)
        slopes[:, :, :count] += line.to_p[:, nx:]
        return slopes

    def pushed(self, result: Result, changes: Mapping[str, Array]) -> Array:
        """Return what small changes of inputs change in the signals, (points, signals, columns).

        Args:
            result: a run of the `DAE`.
            changes: by input, its changes at the points of the run, (points, columns); their derivatives are
                taken where the network uses them.

        Raises:
            ModelError: for unknown inputs.
        """
        nx, known = self.dae.x.numel(), self.dae.input_names
        demand("Variations", result=(result, instance(Result)))
        if not named("changes", changes):
            raise ModelError(
                f"changes are of at least one input; the inputs are {', '.join(known) or 'none'}"
            )
        told = [f"there is no input '{name}'{nearest(name, known)}" for name in changes if name not in known]
        if told:
            raise ModelError("their changes cannot be followed:", told)
        line = self._linearised(result)
        rows, weights = self._pushes(line, changes)
        by_u = line.to_u[:, :, rows]
        forcing = by_u[:, :nx] @ weights
        added = line.steps.here @ forcing[:-1] + line.steps.there @ forcing[1:]
        if len(line.switched):
            added[line.switched] = line.crossed_by_u[:, :, rows] @ weights[line.switched]
        states = line.steps.carry(np.zeros((nx, weights.shape[2])), added)
        return np.asarray(line.to_x[:, nx:] @ states + by_u[:, nx:] @ weights)

    def forced(self, result: Result, names: Sequence[str]) -> Forced:
        """Return what changes of states, and of some inputs, become from point to point along a run.

        Raises:
            ModelError: for unknown inputs, and for those whose derivatives the network uses.
        """
        nx, known = self.dae.x.numel(), self.dae.input_names
        demand("Variations", result=(result, instance(Result)))
        names = listed("names", names)
        told = [f"there is no input '{name}'{nearest(name, known)}" for name in names if name not in known]
        told += [
            f"the derivatives of '{declared.path}' act, too"
            for declared in self.dae.inputs
            if declared.path in names and declared.order
        ]
        if told:
            raise ModelError("their changes cannot be followed:", told)
        line = self._linearised(result)
        row_of = {declared.path: row for row, declared in enumerate(self.dae.inputs)}
        rows = [row_of[name] for name in names]
        signs = np.array([self.dae.inputs[row].sign for row in rows])
        by_u = line.to_u[:, :, rows] * signs
        here, there = line.steps.here @ by_u[:-1, :nx], line.steps.there @ by_u[1:, :nx]
        if len(line.switched):
            here[line.switched] = line.crossed_by_u[:, :, rows] * signs
        return Forced(line.steps.map, here, there, line.to_x[:, nx:], by_u[:, nx:])

    def adjoint(self, result: Result, weights: Array, name: str) -> Array | None:
        """Return d(sum of weights times signals)/d(an input at the points), (points,): `pushed`, transposed.

        Args:
            result: a run of the `DAE`.
            weights: of the signals at the points of the run, (points, signals).
            name: of the input; None is returned for one whose derivatives the network uses.

        Raises:
            ModelError: for an unknown input, or weights that are not one for each signal and point.
        """
        nx, known = self.dae.x.numel(), self.dae.input_names
        demand("Variations", result=(result, instance(Result)), name=(name, text))
        if name not in known:
            raise ModelError(f"there is no input '{name}'{nearest(name, known)}")
        shape = len(result.time), len(self.signals)
        if np.shape(weights) != shape or numbers(finite())(weights):
            raise ModelError(f"weights are an array of numbers of shape {shape}, got {shown(weights)}")
        row = next(i for i, declared in enumerate(self.dae.inputs) if declared.path == name)
        if any(declared.path == name and declared.order for declared in self.dae.inputs):
            return None
        line = self._linearised(result)
        by_u = line.to_u[:, :, row]
        seen = np.einsum("ksx,ks->kx", line.to_x[:, nx:], weights)[:, :, None]
        back = line.steps.reversed().carry(seen[-1], seen[-2::-1])[::-1][1:, :, 0]
        forced = np.zeros((len(by_u), nx))
        forced[:-1] += np.einsum("kij,ki->kj", line.steps.here, back)
        forced[1:] += np.einsum("kij,ki->kj", line.steps.there, back)
        found = np.einsum("kx,kx->k", by_u[:, :nx], forced) + np.einsum("ks,ks->k", by_u[:, nx:], weights)
        if len(line.switched):
            crossed = line.crossed_by_u[:, :, row]
            found[line.switched] += np.einsum("kx,kx->k", crossed, back[line.switched])
        return np.asarray(self.dae.inputs[row].sign * found)

    def start_slopes(self, result: Result, start: Mapping[str, float]) -> Array:
        """Return d(states at the start)/d(parameters) where start values follow from fixed ones.

        Args:
            result: a run that began with
            start: these fixed values.
        """
        demand("Variations", result=(result, instance(Result)))
        start = named("start", start)
        place, point = self.dae.parameters.index, Point(*result.segments[0].point(0))
        of_q = np.zeros((len(point.q), len(self.parameters)))
        of_q[[place[name] for name in self.parameters], range(len(self.parameters))] = 1.0
        return start_slopes(result.closed, point, start_values(self.dae, start, {}), of_q)

    def _linearised(self, result: Result) -> Line:
        """Return the slopes along a run; those of the last run are kept."""
        if self._line is None or self._line.result is not result:
            self._check_jumps(result)
            self._line = linearised(result, self._slopes, self._saltation)
        return self._line

    def _check_jumps(self, result: Result) -> None:
        """Raise where a prescribed motion jumps, which moves states by what has no slopes here."""
        for event in result.events:
            if event.mode not in self.dae.switching.mode_names:
                raise ModelError(
                    f"'{self.dae.name}': {event.component} jumps at t = {event.time:.9g} s, and variations "
                    "are not known through its shock; give a ramp instead of the jump, or exact=False, or "
                    "compare runs"
                )

    def _pushes(self, line: Line, changes: Mapping[str, Array]) -> tuple[list[int], Array]:
        """Return the rows of u that changes of inputs change, and by how much, (points, rows, columns)."""
        rows = [i for i, declared in enumerate(self.dae.inputs) if declared.path in changes]
        columns = []
        for declared in (self.dae.inputs[i] for i in rows):
            change = np.asarray(changes[declared.path], dtype=float)
            for _ in range(declared.order):
                change = _differentiated(change, line.result.time, line.edges + 1)
            columns.append(declared.sign * change)
        return rows, np.stack(columns, axis=1)


def _differentiated(values: Array, time: Array, edges: Any) -> Array:
    """Return derivatives in time, segment by segment."""
    pieces = zip(np.split(values, edges), np.split(time, edges), strict=True)
    return np.concatenate([np.gradient(v, t, axis=0) if len(t) > 1 else np.zeros_like(v) for v, t in pieces])
