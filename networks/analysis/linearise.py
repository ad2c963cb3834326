"""Linearise: from the equations of a network to x' = A x + B u, y = C x + D u with names and units."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any
from weakref import WeakKeyDictionary

import casadi as ca
import numpy as np

from ...base import Array, ModelError, listed, named, nearest
from ..dae import DAE
from ..given import dae_of
from ..network import Network
from ..results.result import Result
from .operating import OperatingPoint, operating_point
from .realise import Channel, drop_held, realised
from .resting import HOLDING
from .statespace import StateSpace
from .varied import Varied

STEP = 1e-100
INCONSISTENT = 1e-6
_KNOWN: WeakKeyDictionary[DAE, dict[tuple[tuple[str, ...], ...], Linearisation]] = WeakKeyDictionary()


def linearise(
    network: Network | DAE,
    inputs: str | Iterable[str] | None = None,
    outputs: str | Iterable[str] | None = None,
    *,
    at: str | Result = "equilibrium",
    time: float = 0.0,
    start: Mapping[str, float] | None = None,
    signals: Mapping[str, Any] | None = None,
    parameters: Mapping[str, float] | None = None,
) -> StateSpace:
    """Return a network as a linear system about an operating point.

        x' = A x + B u,   y = C x + D u (+ D1 u' + D2 u'' + ... where the network differentiates an input)

    Args:
        network: a network, or its `DAE` (which keeps what it compiled).
        inputs: what drives it: inputs ("road.s_ref"), their derivatives ("der(road.s_ref)", whose integral
            becomes a state), or parameters ("weight.f_constant"). All inputs if None.
        outputs: any variables by name. The states if None.
        at: "equilibrium", looked for from the start values; "start"; or a `Result`, at `time`.
        time: instant [s], of a run or of the signals.
        start: start values by name.
        signals: constant parts of the inputs by name; 0 if not given.
        parameters: changed parameters by name.

    Raises:
        ModelError: for unknown names, or if there is no equilibrium.

    Limits: friction and stops are linear only in the mode they are in; what holds is told in `notes`, and
    the motions it holds are no states. A law with a corner has the slope of one side of it.

    Example:
        >>> from inertance import Damper, Fixed, Force, Mass, Network, Spring
        >>> from inertance.analysis import linearise
        >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0), push=Force())
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)
        >>> system = linearise(net, ["push.f"], ["mass.s"])
        >>> round(abs(system(0j).item()), 6)
        0.01
    """
    dae = dae_of(network)
    driven = listed("inputs", dae.input_names if inputs is None else inputs)
    seen = listed("outputs", dae.state_names if outputs is None else outputs)
    changed = named("parameters", parameters)
    compiled = _compiled(dae, driven, seen)
    by = parameters.by if isinstance(parameters, Varied) and at == "equilibrium" else ()
    if by and compiled.linear:
        return compiled.anywhere(dae.parameters.values(changed), by)
    point = operating_point(dae, at, time=time, start=start, inputs=signals, parameters=parameters)
    return compiled.at(point, by)


def _compiled(dae: DAE, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> Linearisation:
    """Return the slopes of a network's equations, compiled once as long as the `DAE` lives."""
    known = _KNOWN.setdefault(dae, {})
    if (inputs, outputs) not in known:
        known[inputs, outputs] = Linearisation(dae, inputs, outputs)
    return known[inputs, outputs]


class Linearisation:
    """The slopes of a network's equations, compiled once and evaluated at any operating point.

    Args:
        dae: the equations.
        inputs, outputs: names as for `linearise`.
    """

    def __init__(self, dae: DAE, inputs: Iterable[str], outputs: Iterable[str]) -> None:
        self.dae = dae
        self.inputs = [_channel(dae, name) for name in inputs]
        self.outputs = list(outputs)
        self._h = ca.vertcat(ca.SX(0, 1), *[_expression(dae, name) for name in self.outputs])

    @cached_property
    def _slopes(self) -> Any:
        dae = self.dae
        all_ = ca.vertcat(dae.ode, dae.alg, self._h)
        symbols = [dae.x, dae.z, dae.u, dae.p]
        return ca.Function("slopes", dae.arguments(), [ca.densify(ca.jacobian(all_, s)) for s in symbols])

    @cached_property
    def _motions(self) -> dict[str, Any]:
        """For each mode, how the quantities of its component whose derivatives exist depend on the states."""
        dae = self.dae
        found = {}
        for mode in dae.switching.mode_names:
            path = mode.rpartition(".")[0]
            own = [n for n in dae.names() if n.rpartition(".")[0] == path and _differentiated(dae, n)]
            values = ca.vertcat(ca.SX(0, 1), *[dae.expression(n) for n in own])
            slopes = [ca.densify(ca.jacobian(values, s)) for s in (dae.x, dae.u)]
            found[mode] = ca.Function("motions", dae.arguments(), slopes)
        return found

    @cached_property
    def linear(self) -> bool:
        """Whether the slopes are the same at all points, so that none need be looked for."""
        dae = self.dae
        if dae.switching.mode_names or any(c.parameter is not None for c in self.inputs):
            return False
        all_ = ca.vertcat(dae.ode, dae.alg, self._h)
        slopes = ca.vertcat(*[ca.vec(ca.jacobian(all_, s)) for s in (dae.x, dae.z, dae.u)])
        return not ca.depends_on(slopes, ca.vertcat(dae.x, dae.z, dae.u, dae.time))

    @cached_property
    def _tangents(self) -> Any:
        """How the slopes change along a direction of states, algebraic unknowns and parameters."""
        dae = self.dae
        all_ = ca.vertcat(dae.ode, dae.alg, self._h)
        moved = ca.vertcat(dae.x, dae.z, dae.p)
        along = ca.SX.sym("along", moved.numel())
        slopes = [ca.densify(ca.jacobian(all_, s)) for s in (dae.x, dae.z, dae.u, dae.p)]
        changes = [ca.reshape(ca.densify(ca.jtimes(ca.vec(s), moved, along)), s.shape) for s in slopes]
        return ca.Function("tangents", [*dae.arguments(), along], changes)

    def at(self, point: OperatingPoint, by: Iterable[str] = ()) -> StateSpace:
        """Return the linear system about a point, with slopes in parameters `by` unless something holds."""
        place = (point.x, point.z, point.u, point.q, point.t)
        matrices = [m.full() for m in self._slopes(*place)]
        held = self._held_rows(point)
        system = self._system(matrices, list(point.notes), held, point)
        return system if len(held) else replace(system, slopes=self._varied(place, matrices, by))

    def anywhere(self, numbers: Array, by: Iterable[str]) -> StateSpace:
        """Return the system of linear equations for some parameters, with slopes in those of `by`."""
        dae = self.dae
        constants = np.concatenate([numbers, np.zeros(dae.constants.numel() - len(numbers))])
        place = (0.0, 0.0, 0.0, constants, 0.0)
        matrices = [m.full() for m in self._slopes(*place)]
        system = self._system(matrices, [], np.zeros((0, dae.x.numel())), None)
        return replace(system, slopes=self._varied(place, matrices, by))

    def _varied(
        self, place: tuple[Any, ...], matrices: list[Array], by: Iterable[str]
    ) -> dict[str, StateSpace]:
        """Return the derivatives of the system in parameters, by complex steps of its matrices.

        The point moves along: for an equilibrium 0 = f(y, p), dy/dp = -(df/dy)^-1 df/dp.
        """
        dae, found = self.dae, {}
        rows = slice(0, dae.x.numel() + dae.z.numel())
        rest = np.hstack([m[rows] for m in matrices[:2]])
        for name in by:
            _check_parameter(dae, name)
            k = dae.parameters.index[name]
            along = np.zeros(dae.p.numel())
            along[k] = 1.0
            moved: Any = np.zeros(rest.shape[1])
            if not self.linear:
                moved = np.linalg.lstsq(rest, -matrices[3][rows, k], rcond=1e-12)[0]
            changes = self._tangents(*place, np.concatenate([moved, along]))
            stepped = [m + 1j * STEP * change.full() for m, change in zip(matrices, changes, strict=True)]
            system = self._system(stepped, [], np.zeros((0, dae.x.numel())), None)
            parts: Any = {n: getattr(system, n).imag / STEP for n in "ABCD"}
            found[name] = replace(system, **parts, D_s=tuple(D.imag / STEP for D in system.D_s))
        return found

    def _system(
        self, matrices: list[Any], notes: list[str], held: Array, point: OperatingPoint | None
    ) -> StateSpace:
        """Return the linear system of slopes in states, algebraic unknowns, inputs and parameters."""
        of_x, of_z, of_u, of_p = matrices
        n, m = of_x.shape[1], of_z.shape[1]
        states, algebraic, outputs = np.split(np.arange(len(of_x)), [n, n + m])
        whole = np.hstack([of_x, of_u, of_p])
        follow = _following(of_z[algebraic], whole[algebraic], notes)
        self._check_followed(of_z[algebraic], whole[algebraic], follow)
        whole[np.r_[states, outputs]] += of_z[np.r_[states, outputs]] @ follow
        of_x, of_u, of_p = np.split(whole, [n, n + of_u.shape[1]], axis=1)
        A, C = of_x[states], of_x[outputs]
        names, units = self.dae.state_names, [self.dae.unit(name) for name in self.dae.state_names]
        keep: Any = states
        kept = drop_held(A, of_u[states], held) if len(held) else None
        if kept is not None:
            keep, restore = kept
            notes.append(f"held, and therefore no states: {', '.join(np.delete(names, keep))}")
            A, C = A[keep] @ restore, C @ restore
            names, units = [names[k] for k in keep], [units[k] for k in keep]
        rows = np.concatenate([keep, outputs]).astype(int)
        of_u, of_p = of_u[rows], of_p[rows]
        channels = [self._columns(c, of_u, of_p) for c in self.inputs]
        inputs = [c.name for c in self.inputs], [c.unit for c in self.inputs]
        told = [self.dae.unit(name) for name in self.outputs]
        return realised(
            self.dae.name, (A, C), channels, (names, units), inputs, (self.outputs, told), notes, point
        )

    def _check_followed(self, of_z: Any, of_others: Any, follow: Any) -> None:
        """Raise where an algebraic unknown would have to move at an infinite rate."""
        left = np.abs((of_z @ follow + of_others).real).max(axis=1, initial=0.0)
        stiff = np.flatnonzero(left > INCONSISTENT * np.abs(of_others.real).max(axis=1, initial=0.0))
        if len(stiff):
            names = ", ".join(self.dae.name_of(self.dae.algebraic[k]) for k in stiff)
            raise ModelError(
                f"'{self.dae.name}' is not linear here: what balances {names} has no slope, as a "
                "clearance or a quadratic damper at rest; linearise elsewhere (at=, start=, signals=), "
                "or put a little stiffness or damping beside it"
            )

    def _columns(self, channel: Channel, of_u: Array, of_p: Array) -> tuple[Channel, dict[int, Array]]:
        """Return the slopes in a channel and its derivatives, by order."""
        if channel.parameter is not None:
            return channel, {0: of_p[:, channel.parameter]}
        columns: dict[int, Array] = {}
        for k, declared in enumerate(self.dae.inputs):
            if declared.path == channel.path:
                columns[declared.order] = columns.get(declared.order, 0.0) + declared.sign * of_u[:, k]
        return channel, columns

    def _held_rows(self, point: OperatingPoint) -> Array:
        rows = [np.zeros((0, len(point.x)))]
        for mode, value in point.modes.items():
            if value in HOLDING:
                of_x, of_u = (
                    m.full() for m in self._motions[mode](point.x, point.z, point.u, point.q, point.t)
                )
                rows.append(of_x[~of_u.any(axis=1)])
        return np.vstack(rows)


def _following(of_z: Any, of_others: Any, notes: list[str]) -> Any:
    """Return how algebraic unknowns follow all others, of complex matrices up to the first order of steps."""
    if not len(of_z):
        return np.zeros((0, of_others.shape[1]))
    scale = np.abs(of_z.real).max(axis=1)
    scale[scale == 0] = 1.0
    follow, _, rank, _ = np.linalg.lstsq(
        of_z.real / scale[:, None], -of_others.real / scale[:, None], rcond=1e-13
    )
    if np.iscomplexobj(of_z):
        rest = of_others.imag + of_z.imag @ follow
        follow = (
            follow - 1j * np.linalg.lstsq(of_z.real / scale[:, None], rest / scale[:, None], rcond=1e-13)[0]
        )
    if rank < len(of_z):
        notes.append(
            f"{len(of_z) - rank} algebraic unknowns are not determined here; the least ones are taken"
        )
    return follow


def _channel(dae: DAE, name: str) -> Channel:
    path, order = name, 0
    while path.startswith("der(") and path.endswith(")"):
        path, order = path[4:-1], order + 1
    table = dae.parameters
    if path in dae.input_names:
        unit = next(i.unit for i in dae.inputs if i.path == path)
        return Channel(name, path, order, unit, None)
    if path in table.index and not order:
        return Channel(name, path, 0, dae.unit(path), table.index[path])
    known = [*dae.input_names, *table.index]
    raise ModelError(f"'{dae.name}' has no input '{path}'{nearest(path, known)}")


def _check_parameter(dae: DAE, name: str) -> None:
    known = dae.parameter_values
    if name not in known:
        raise ModelError(f"'{dae.name}' has no parameter '{name}' to be varied{nearest(name, known)}")


def _expression(dae: DAE, name: str) -> Any:
    try:
        return dae.expression(name)
    except KeyError as error:
        raise ModelError(f"'{dae.name}' has no output '{name}': {error.args[0]}") from None


def _differentiated(dae: DAE, name: str) -> bool:
    return dae.root(name)[0] in dae.derivative
