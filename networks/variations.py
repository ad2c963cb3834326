"""Variations: how a run answers to small changes of parameters and start values, events included."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ..components.base import ModelError, nearest
from .closed import Closed
from .compiled import dense
from .dae import DAE
from .events import Point
from .initial import wishes
from .passages import Passage, passages
from .result import Result, Segment
from .sensitivity import start_slopes
from .vectors import pick

Array = NDArray[np.float64]
CHUNK = 2048
GRAZING = 1e-9
PARTS = 32
UNEVEN = 0.01


class Variations:
    """Slopes of signals in parameters and start values of the states along runs of one `DAE`.

    Along a run, with algebraic unknowns eliminated,

        d(dx)/dt = A dx + B dp,   dy = C dx + D dp,

    integrated from point to point with the means of A and B (Radau IIA of order 5). Where modes switch at
    g = 0, the instant moves by dt = -dg/g', and with R the slope of the reset the state by

        dx+ = R (dx- + x'- dt) - x'+ dt.

    Args:
        dae: the equations.
        signals: the variables whose slopes are wanted.
        parameters: the parameters in which.

    Raises:
        ModelError: for unknown parameters, and for networks with shocks.
        KeyError: for unknown signals, with the nearest name.

    Limits: as accurate as the points of the run resolve what happens between them.

    Source: I. A. Hiskens, M. A. Pai, Trajectory sensitivity analysis of hybrid systems, IEEE Trans. Circuits
    Syst. I 47 (2000) 204-220.

    Example:
        >>> from inertance import Fixed, Mass, Network, Spring, Variations
        >>> net = Network("swing", wall=Fixed(), spring=Spring(k=1.0), mass=Mass(m=1.0, s=0.1))
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange)
        >>> dae = net.dae()
        >>> slopes = Variations(dae, ["mass.s"], ["spring.k"]).along(dae.simulate(1.0))
        >>> slopes.shape
        (501, 1, 3)
    """

    def __init__(self, dae: DAE, signals: Sequence[str], parameters: Sequence[str]) -> None:
        table = dae.system.flat.table
        unknown = [name for name in parameters if name not in table.index]
        if unknown:
            told = [f"there is no parameter '{name}'{nearest(name, table.index)}" for name in unknown]
            raise ModelError("variations cannot be computed:", told)
        if dae.impulses.numel():
            raise ModelError(f"'{dae.name}' has shocks, whose variations are not known; compare runs instead")
        self.dae, self.signals, self.parameters = dae, list(signals), list(parameters)
        columns = pick(dae.p, [table.index[name] for name in parameters])
        wanted = [dae.expression(name) for name in signals]
        self._slopes = _Slopes(dae, ca.vertcat(dae.ode, *wanted), columns)
        self._switching = _Slopes(dae, dae.switching.expressions, columns)
        roots = sorted({reset[0] for change in dae.switching.changes for reset in change.resets})
        self._rows = {root: row for row, root in enumerate(roots)}
        self._reset = _Slopes(dae, pick(dae.variables, roots), columns)
        self._line: _Line | None = None

    def along(self, result: Result, start: Array | None = None) -> Array:
        """Return d(signals)/d(parameters, states at the start), (points, signals, directions).

        Args:
            result: a run of the `DAE`.
            start: d(states at the start)/d(parameters), (states, parameters); zero if not given.
        """
        nx, count = self.dae.x.numel(), len(self.parameters)
        moved = np.hstack([np.zeros((nx, count)) if start is None else start, np.eye(nx)])
        line = self._linearised(result)
        steps = self._steps(line, line.to_p[:, :nx])
        slopes = line.to_x[:, nx:] @ self._carried(line, moved, steps)
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
        told = [f"there is no input '{name}'{nearest(name, known)}" for name in changes if name not in known]
        if told:
            raise ModelError("their changes cannot be followed:", told)
        push = _Push(self.dae, result, changes)
        line = self._linearised(result)
        by_u = line.to_u[:, :, push.rows]
        states = self._carried(
            line, np.zeros((nx, push.weights.shape[2])), self._forced(line, by_u[:, :nx] @ push.weights), push
        )
        answer: Array = line.to_x[:, nx:] @ states + by_u[:, nx:] @ push.weights
        return answer

    def _linearised(self, result: Result) -> _Line:
        """Return the slopes along a run; those of the last run are kept."""
        if self._line is None or self._line.result is not result:
            points = _points(result._segments)
            to_x, to_p, to_u = self._slopes(result._closed, points)
            passed = list(passages(result))
            ends = _Points(*(np.array([p.before[k] for p in passed]) for k in (3, 0, 1, 2)))
            at_events = [s(result._closed, ends) if passed else () for s in (self._switching, self._reset)]
            self._line = _Line(result, points, to_x, to_p, to_u, passed, at_events[0], at_events[1])
        return self._line

    def _carried(self, line: _Line, moved: Array, steps: _Steps, push: _Push | None = None) -> Array:
        """Return the changes of the states at all points, (points, states, columns)."""
        segments = line.result._segments
        moved = self._held(segments[0], moved)
        lengths = [sum(map(len, segment.times)) for segment in segments]
        states = np.empty((sum(lengths), *moved.shape))
        begin = 0
        for number, length in enumerate(lengths):
            if number and line.passages[number - 1].changes:
                moved = self._passed(line, number - 1, moved, push.at(begin - 1) if push else None)
            steps.carry(moved, states[begin : begin + length], begin)
            begin += length
            moved = states[begin - 1]
        return states

    def _forced(self, line: _Line, b: Array) -> _Steps:
        """Return what carries changes from point to point under a forcing."""
        if self._slopes.still:
            return self._steps(line, b)
        A = line.to_x[:, : self.dae.x.numel()]
        whole = np.broadcast_to(np.diag(_balance(A).ravel()), A.shape)
        return self._steps(line, whole).forced(b)

    def _steps(self, line: _Line, B: Array) -> _Steps:
        """Return what carries slopes from point to point; in small steps where A jumps, as at a clearance."""
        points, closed = line.points, line.result._closed
        A = line.to_x[:, : self.dae.x.numel()]
        scale = _balance(A)
        if self._slopes.still:
            return _Steps(scale, _repeated(points, A, scale)).forced(B)
        steps = _Steps(scale, _matrices(np.diff(points.t), A, B, scale))
        uneven = np.flatnonzero(_jumps(A, scale, np.diff(points.t)) & (np.diff(points.t) > 0))
        if len(uneven):
            finer = points.within(uneven, self._rates(closed, points, uneven))
            to_x, to_p, _ = self._slopes(closed, finer)
            nx, count = len(scale), len(uneven)
            whole = np.broadcast_to(B[0], (len(finer.t), *B.shape[1:]))
            of_p = to_p if B is line.to_p or B.base is line.to_p else whole
            A, B = (m[:, :nx].reshape(count, PARTS + 1, nx, m.shape[2]) for m in (to_x, of_p))
            t = finer.t.reshape(count, PARTS + 1)
            steps.matrices[uneven] = _chained(t, A, B, scale)
        return steps

    def _rates(self, closed: Closed, points: _Points, at: Any) -> tuple[Array, Array]:
        """Return the rates of the states at both ends of some intervals."""
        motion = closed.evaluator(self.dae.ode)
        ends = []
        for n in (at, at + 1):
            q = points.q[at]
            ends.append(motion(points.x[n].T, points.z[n].T, q.T, points.t[None, n]).full().T)
        return ends[0], ends[1]

    def start_slopes(self, result: Result, start: Mapping[str, float]) -> Array:
        """Return d(states at the start)/d(parameters) where start values follow from fixed ones.

        Args:
            result: a run that began with
            start: these fixed values.
        """
        table, segment = self.dae.system.flat.table, result._segments[0]
        of_q = np.zeros((len(segment.q), len(self.parameters)))
        of_q[[table.index[name] for name in self.parameters], range(len(self.parameters))] = 1.0
        point = Point(float(segment.times[0][0]), segment.states[0][0], segment.algebraic[0][0], segment.q)
        return start_slopes(result._closed, point, wishes(self.dae, start, {}), of_q)

    def _held(self, segment: Segment, moved: Array) -> Array:
        """Take out changes of what the modes hold at the start, such as the speed of what sticks."""
        modes = segment.q[self.dae.p.numel() :]
        for change in self.dae.switching.changes:
            roots = [reset[0] for reset in change.resets if reset[0] in self.dae.states]
            if modes[change.mode] == change.target and roots:
                rows = [self.dae.states.index(root) for root in roots]
                moved[[row for row in rows if segment.states[0][0][row] == 0.0]] = 0.0
        return moved

    def _passed(self, line: _Line, number: int, moved: Array, push: tuple[list[int], Array] | None) -> Array:
        """Carry slopes of the states over an instant at which modes switch."""
        passage, functions = line.passages[number], line.result._closed.switch_functions
        values, rates = functions.watch(*passage.before)
        switching = tuple(m[number] for m in line.switching)
        fired = [min(alike, key=lambda n: abs(values[n])) for alike in passage.changes]
        changes = [self.dae.switching.changes[n] for n in fired]
        g = _total(switching, moved, push)[changes[0].indicator]
        rate = float(rates[fired[0]])
        later = -g / rate if abs(rate) > GRAZING else np.zeros_like(g)
        moved = moved + functions.motion(*passage.before)[0][:, None] * later
        resets = {reset[0]: reset for change in changes for reset in change.resets}
        if resets:
            everything = _total(switching, moved, push)
            rows = [self._rows[root] for root in resets]
            own = tuple(m[number][rows] for m in line.reset)
            new = np.array([sign * everything[place] for _, sign, place in resets.values()])
            moved = moved + np.linalg.lstsq(own[0], new - _total(own, moved, push), rcond=1e-10)[0]
        answer: Array = moved - functions.motion(*passage.after)[0][:, None] * later
        return answer


@dataclass(frozen=True, eq=False)
class _Points:
    """Points of a run: instants, states, algebraic unknowns, and what is constant in each one's segment."""

    t: Array
    x: Array
    z: Array
    q: Array

    def only(self, which: Any) -> _Points:
        """Return some of the points."""
        return _Points(self.t[which], self.x[which], self.z[which], self.q[which])

    def within(self, intervals: Any, rates: tuple[Array, Array]) -> _Points:
        """Return points in equal parts of some intervals, ends included, by cubic interpolation."""
        first, last = intervals, intervals + 1
        share = np.linspace(0.0, 1.0, PARTS + 1)[None, :, None]
        step, change = (self.t[last] - self.t[first])[:, None], self.x[last] - self.x[first]
        a, b = (np.clip(step * rate, -3 * np.abs(change), 3 * np.abs(change))[:, None] for rate in rates)
        cubic = share**2 * (3 - 2 * share) * change[:, None]
        cubic = cubic + share * (1 - share) ** 2 * a - share**2 * (1 - share) * b
        x = (self.x[first][:, None] + cubic).reshape(-1, self.x.shape[1])
        z = (self.z[first][:, None] + share * (self.z[last] - self.z[first])[:, None]).reshape(len(x), -1)
        t = (self.t[first][:, None] + share[:, :, 0] * step).ravel()
        return _Points(t, x, z, np.repeat(self.q[first], PARTS + 1, axis=0))


def _points(segments: Sequence[Segment]) -> _Points:
    t = np.concatenate([part for segment in segments for part in segment.times])
    x = np.concatenate([part for segment in segments for part in segment.states])
    z = np.concatenate([part for segment in segments for part in segment.algebraic])
    lengths = [sum(map(len, segment.times)) for segment in segments]
    return _Points(t, x, z, np.repeat([segment.q for segment in segments], lengths, axis=0))


@dataclass(frozen=True, eq=False)
class _Line:
    """A run with the slopes along it, and where modes switch those of switching expressions and resets."""

    result: Result
    points: _Points
    to_x: Array
    to_p: Array
    to_u: Array
    passages: list[Passage]
    switching: tuple[Array, ...]
    reset: tuple[Array, ...]


class _Slopes:
    """Slopes of expressions in states, parameters and inputs, algebraic unknowns eliminated.

    Attributes:
        still: whether slopes in the states are constant within a segment; one point of each then tells all.
    """

    def __init__(self, dae: DAE, expressions: Any, columns: Any) -> None:
        moving = ca.vertcat(dae.x, dae.z, dae.u, dae.time)
        own, driven = (
            [ca.jacobian(e, symbol) for e in (expressions, dae.alg) for symbol in symbols]
            for symbols in ((dae.x, dae.z), (columns, dae.u))
        )
        self.still = not any(ca.depends_on(m, moving) for m in own if m.nnz())
        self._own = ca.Function("own", dae.arguments(), dense(*own))
        self._driven = ca.Function("driven", dae.arguments(), dense(*driven))

    def __call__(self, closed: Closed, points: _Points) -> tuple[Array, Array, Array]:
        """Return slopes in x, in the parameters and in u at points."""
        if self.still and len(points.t) > 1:
            first, lengths = _segments(points)
            few = (np.repeat(m, lengths, axis=0) for m in _mapped(self._own, closed, points.only(first)))
            to_x, to_z, alg_x, alg_z = few
        else:
            to_x, to_z, alg_x, alg_z = _mapped(self._own, closed, points)
        to_p, to_u, alg_p, alg_u = _mapped(self._driven, closed, points)
        if not points.z.shape[1]:
            return to_x, to_p, to_u
        gain = to_z @ np.linalg.inv(alg_z)
        return to_x - gain @ alg_x, to_p - gain @ alg_p, to_u - gain @ alg_u


def _segments(points: _Points) -> tuple[Any, Any]:
    """Return the first point of each stretch in which nothing discrete changes, and their lengths."""
    changed = np.any(np.diff(points.q, axis=0) != 0, axis=1)
    first = np.concatenate([[0], np.flatnonzero(changed) + 1])
    return first, np.diff(np.append(first, len(points.t)))


def _mapped(function: Any, closed: Closed, points: _Points) -> tuple[Array, ...]:
    """Return matrices at all points, each (points, rows, columns)."""
    pieces = []
    for begin in range(0, len(points.t), CHUNK):
        part = points.only(slice(begin, begin + CHUNK))
        times = part.t[None]
        found = function(part.x.T, part.z.T, closed.input_values(times), part.q.T, times)
        count = times.size
        pieces.append(
            [m.full().reshape(m.shape[0], count, m.shape[1] // count).transpose(1, 0, 2) for m in found]
        )
    return tuple(np.concatenate(matrices) for matrices in zip(*pieces, strict=True))


class _Push:
    """Changes of inputs, and of their derivatives that the network uses, at the points of a run."""

    def __init__(self, dae: DAE, result: Result, changes: Mapping[str, Array]) -> None:
        self.rows = [i for i, declared in enumerate(dae.inputs) if declared.path in changes]
        lengths = [sum(map(len, segment.times)) for segment in result._segments]
        edges = np.cumsum(lengths)[:-1]
        columns = []
        for i in self.rows:
            declared = dae.inputs[i]
            change = np.asarray(changes[declared.path], dtype=float)
            for _ in range(declared.order):
                change = _differentiated(change, result.time, edges)
            columns.append(declared.sign * change)
        self.weights = np.stack(columns, axis=1)

    def at(self, point: int) -> tuple[list[int], Array]:
        """Return the rows of u that change, and by how much at a point."""
        return self.rows, self.weights[point]


def _differentiated(values: Array, time: Array, edges: Any) -> Array:
    """Return derivatives in time, segment by segment."""
    pieces = zip(np.split(values, edges), np.split(time, edges), strict=True)
    return np.concatenate([np.gradient(v, t, axis=0) if len(t) > 1 else np.zeros_like(v) for v, t in pieces])


def _total(slopes: tuple[Array, ...], moved: Array, push: tuple[list[int], Array] | None) -> Array:
    """Return the whole change of expressions: by the states, and by the parameters or the inputs."""
    to_x, to_p, to_u = slopes
    total: Array = to_x @ moved
    if push is None:
        total[:, : to_p.shape[1]] += to_p
    else:
        total += to_u[:, push[0]] @ push[1]
    return total


@dataclass(frozen=True, eq=False)
class _Steps:
    """What carries slopes of the states from point to point, in scaled states."""

    scale: Array
    matrices: Array
    forcing: Array | None = None

    def forced(self, b: Array) -> _Steps:
        """Return steps that add what a forcing of the states, given at the points, adds."""
        n = len(self.scale)
        mean = 0.5 * (b[1:] + b[:-1]) / self.scale
        return _Steps(self.scale, self.matrices[:, :, :n], self.matrices[:, :, n:] @ mean)

    def carry(self, moved: Array, states: Array, begin: int) -> None:
        """Fill in the slopes at the points of a segment, of which the first is number `begin`."""
        n = len(moved)
        count = self.matrices.shape[2] - n
        states[0] = moved
        scaled = moved / self.scale
        end = begin + len(states) - 1
        if self.forcing is not None:
            width = self.forcing.shape[2]
            for number in range(begin, end):
                scaled = self.matrices[number] @ scaled
                scaled[:, :width] += self.forcing[number]
                states[number - begin + 1] = scaled
        else:
            for number, step in enumerate(self.matrices[begin:end], start=1):
                scaled = step[:, :n] @ scaled
                scaled[:, :count] += step[:, n:]
                states[number] = scaled
        states[1:] *= self.scale


def _balance(A: Array) -> Array:
    """Return sizes of the states that make the slopes of their rates comparable."""
    from scipy.linalg import matrix_balance

    if not A.shape[1]:
        return np.ones((0, 1))
    scaling = matrix_balance(np.abs(A).mean(axis=0), permute=False, separate=True)[1][0]
    return np.asarray(scaling, dtype=np.float64)[:, None]


def _jumps(A: Array, scale: Array, lengths: Array) -> Any:
    """Tell over which intervals slopes change by more than a little, for the length of the interval."""
    change = np.abs(np.diff(A * scale.T / scale, axis=0)).max(axis=(1, 2), initial=0.0)
    return change * lengths > UNEVEN


def _matrices(lengths: Array, A: Array, B: Array, scale: Array) -> Array:
    """Return exp(Z) and its integral times B for all steps, by a rational approximation of order 5."""
    return _single(lengths, 0.5 * (A[1:] + A[:-1]), 0.5 * (B[1:] + B[:-1]), scale)


def _repeated(points: _Points, A: Array, scale: Array) -> Array:
    """Return exp(Z) and its integral where A is constant in each segment: few differ."""
    n, lengths = len(scale), np.diff(points.t)
    segment = np.cumsum(np.any(np.diff(points.q, axis=0) != 0, axis=1))
    rounded = np.round(lengths / max(float(lengths.max(initial=0.0)), 1e-300), 9)
    kinds = np.column_stack([segment, rounded])
    _, first, kind = np.unique(kinds, axis=0, return_index=True, return_inverse=True)
    whole = np.broadcast_to(np.diag(scale.ravel()), (len(first), n, n))
    few: Array = _single(lengths[first], A[first + 1], whole, scale)[kind.ravel()]
    return few


def _single(lengths: Array, A: Array, B: Array, scale: Array) -> Array:
    """Return these matrices for steps within each of which A and B are constant."""
    h = lengths[:, None, None]
    Z, b = h * A * scale.T / scale, h * B / scale
    one, Z2 = np.eye(len(scale)), Z @ Z
    Z3 = Z2 @ Z
    left = one - 0.6 * Z + 0.15 * Z2 - Z3 / 60
    right = np.concatenate([one + 0.4 * Z + 0.05 * Z2, (one - 0.1 * Z + Z2 / 60) @ b], axis=2)
    return np.asarray(np.linalg.solve(left, right), dtype=float)


def _chained(t: Array, A: Array, B: Array, scale: Array) -> Array:
    """Return the matrices of several intervals, each chained from its parts."""
    n = len(scale)
    total = None
    for k in range(t.shape[1] - 1):
        h = t[:, k + 1] - t[:, k]
        step = _single(h, A[:, k : k + 2].mean(axis=1), B[:, k : k + 2].mean(axis=1), scale)
        if total is None:
            total = step
        else:
            total = step[:, :, :n] @ total
            total[:, :, n:] += step[:, :, n:]
    assert total is not None
    return total
