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
from .realise import Drive, drop_held, realised
from .resting import HOLDING_MODES
from .statespace import StateSpace

Place = tuple[Any, ...]
COMPLEX_STEP = 1e-100
IMBALANCE = 1e-6  # relative to the slopes that must be balanced
_COMPILED: WeakKeyDictionary[DAE, dict[tuple[tuple[str, ...], ...], Linearisation]] = WeakKeyDictionary()


class Varied(dict[str, float]):
    """Changed parameters by name, of which `by` are those in which slopes are wanted.

    `linearise(..., parameters=Varied(...))` returns a system with `slopes`, whose norms have a `gradient`.
    """

    def __init__(self, parameters: Mapping[str, float], by: Iterable[str] | None = None) -> None:
        super().__init__(parameters)
        self.by = tuple(parameters if by is None else by)


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
    known = _COMPILED.setdefault(dae, {})
    if (driven, seen) not in known:
        known[driven, seen] = Linearisation(dae, driven, seen)
    compiled = known[driven, seen]
    by = parameters.by if isinstance(parameters, Varied) and at == "equilibrium" else ()
    if by and compiled.linear:
        return compiled.anywhere(dae.parameters.values(changed), by)
    point = operating_point(dae, at, time=time, start=start, inputs=signals, parameters=parameters)
    return compiled.at(point, by)


class Linearisation:
    """The slopes of a network's equations, compiled once and evaluated at any operating point.

    Args:
        dae: the equations.
        inputs, outputs: names as for `linearise`.
    """

    def __init__(self, dae: DAE, inputs: Iterable[str], outputs: Iterable[str]) -> None:
        self.dae = dae
        self.inputs = [_drive(dae, name) for name in inputs]
        self.outputs = list(outputs)
        seen = [_expression(dae, name) for name in self.outputs]
        equations = ca.vertcat(dae.ode, dae.alg, ca.SX(0, 1), *seen)
        self._jacobians = [ca.densify(ca.jacobian(equations, s)) for s in (dae.x, dae.z, dae.u, dae.p)]
        self._slopes = ca.Function("slopes", dae.arguments(), self._jacobians)

    @cached_property
    def _motions(self) -> dict[str, Any]:
        """For each mode, how the quantities of its component whose derivatives exist depend on the states."""
        dae = self.dae
        found = {}
        for mode in dae.switching.mode_names:
            path = mode.rpartition(".")[0]
            own = [name for name in dae.names() if name.rpartition(".")[0] == path]
            moving = [dae.expression(name) for name in own if dae.root(name)[0] in dae.derivative]
            values = ca.vertcat(ca.SX(0, 1), *moving)
            slopes = [ca.densify(ca.jacobian(values, s)) for s in (dae.x, dae.u)]
            found[mode] = ca.Function("motions", dae.arguments(), slopes)
        return found

    @cached_property
    def linear(self) -> bool:
        """Whether the slopes are the same at all points, so that none need be looked for."""
        dae = self.dae
        if dae.switching.mode_names or any(drive.parameter is not None for drive in self.inputs):
            return False
        slopes = ca.vertcat(*map(ca.vec, self._jacobians[:3]))
        return not ca.depends_on(slopes, ca.vertcat(dae.x, dae.z, dae.u, dae.time))

    @cached_property
    def _tangents(self) -> Any:
        """How the slopes change along a direction of states, algebraic unknowns and parameters."""
        dae = self.dae
        moved = ca.vertcat(dae.x, dae.z, dae.p)
        along = ca.SX.sym("along", moved.numel())
        rates = [ca.densify(ca.jtimes(ca.vec(slope), moved, along)) for slope in self._jacobians]
        changes = [ca.reshape(r, slope.shape) for r, slope in zip(rates, self._jacobians, strict=True)]
        return ca.Function("tangents", [*dae.arguments(), along], changes)

    def at(self, point: OperatingPoint, by: Iterable[str] = ()) -> StateSpace:
        """Return the linear system about a point, with slopes in parameters `by` unless something holds."""
        return self._about((point.x, point.z, point.u, point.q, point.t), by, point)

    def anywhere(self, numbers: Array, by: Iterable[str]) -> StateSpace:
        """Return the system of linear equations for some parameters, with slopes in those of `by`."""
        constants = np.concatenate([numbers, np.zeros(self.dae.constants.numel() - len(numbers))])
        return self._about((0.0, 0.0, 0.0, constants, 0.0), by)

    def _about(self, place: Place, by: Iterable[str], point: OperatingPoint | None = None) -> StateSpace:
        """Return the linear system about what the equations depend on, with slopes in parameters `by`."""
        held, notes = (self._held_rows(point), point.notes) if point else (None, ())
        matrices = [m.full() for m in self._slopes(*place)]
        system = self._system(matrices, notes, held)
        slopes = self._varied(place, matrices, by) if held is None else {}
        return replace(system, slopes=slopes, point=point)

    def _varied(self, place: Place, matrices: list[Array], by: Iterable[str]) -> dict[str, StateSpace]:
        """Return the derivatives of the system in parameters, by complex steps of its matrices.

        The point moves along: for an equilibrium 0 = f(y, p), dy/dp = -(df/dy)^-1 df/dp.
        """
        dae, found, known = self.dae, {}, self.dae.parameter_values
        rows = slice(0, dae.x.numel() + dae.z.numel())
        rest = np.hstack([m[rows] for m in matrices[:2]])
        for name in by:
            if name not in known:
                raise ModelError(f"'{dae.name}' has no parameter '{name}' to be varied{nearest(name, known)}")
            k = dae.parameters.index[name]
            along = np.zeros(dae.p.numel())
            along[k] = 1.0
            moved: Any = np.zeros(rest.shape[1])
            if not self.linear:
                moved = np.linalg.lstsq(rest, -matrices[3][rows, k], rcond=1e-12)[0]
            changes = self._tangents(*place, np.concatenate([moved, along]))
            system = self._system(
                [m + 1j * COMPLEX_STEP * change.full() for m, change in zip(matrices, changes, strict=True)]
            )
            parts: Any = {n: getattr(system, n).imag / COMPLEX_STEP for n in "ABCD"}
            found[name] = replace(system, **parts, D_s=tuple(D.imag / COMPLEX_STEP for D in system.D_s))
        return found

    def _system(
        self, matrices: list[Any], notes: Iterable[str] = (), held: Array | None = None
    ) -> StateSpace:
        """Return the linear system of slopes in states, algebraic unknowns, inputs and parameters."""
        of_x, of_z, of_u, of_p = matrices
        n, m, told = of_x.shape[1], of_z.shape[1], list(notes)
        states, algebraic, outputs = np.split(np.arange(len(of_x)), [n, n + m])
        whole = np.hstack([of_x, of_u, of_p])
        follow = _following(of_z[algebraic], whole[algebraic], told)
        self._check_followed(of_z[algebraic], whole[algebraic], follow)
        rows: Any = np.r_[states, outputs]
        whole[rows] += of_z[rows] @ follow
        of_x, of_u, of_p = np.split(whole, [n, n + of_u.shape[1]], axis=1)
        A, C, names = of_x[states], of_x[outputs], self.dae.state_names
        keep, restore = drop_held(A, of_u[states], held) if held is not None else (list(states), None)
        if len(keep) < n:
            told.append(f"held, and therefore no states: {', '.join(np.delete(names, keep))}")
            A, C = A[keep] @ restore, C @ restore
            names, rows = [names[k] for k in keep], np.r_[keep, outputs].astype(int)
        of_u, of_p = of_u[rows], of_p[rows]
        driven = [(drive, self._columns(drive, of_u, of_p)) for drive in self.inputs]
        units = {name: self.dae.unit(name) for name in names}
        seen = tuple(self.outputs)
        made = realised((A, C), units, driven, told)
        return StateSpace(
            **made, name=self.dae.name, outputs=seen, output_units=tuple(map(self.dae.unit, seen))
        )

    def _check_followed(self, of_z: Any, of_others: Any, follow: Any) -> None:
        """Raise where an algebraic unknown would have to move at an infinite rate."""
        left = np.abs((of_z @ follow + of_others).real).max(axis=1, initial=0.0)
        stiff = np.flatnonzero(left > IMBALANCE * np.abs(of_others.real).max(axis=1, initial=0.0))
        if len(stiff):
            names = ", ".join(self.dae.name_of(self.dae.algebraic[k]) for k in stiff)
            raise ModelError(
                f"'{self.dae.name}' is not linear here: what balances {names} has no slope, as a "
                "clearance or a quadratic damper at rest; linearise elsewhere (at=, start=, signals=), "
                "or put a little stiffness or damping beside it"
            )

    def _columns(self, drive: Drive, of_u: Array, of_p: Array) -> dict[int, Array]:
        """Return the slopes in what drives and in its derivatives, by order."""
        if drive.parameter is not None:
            return {0: of_p[:, drive.parameter]}
        columns: dict[int, Array] = {}
        for k, declared in enumerate(self.dae.inputs):
            if declared.path == drive.path:
                columns[declared.order] = columns.get(declared.order, 0.0) + declared.sign * of_u[:, k]
        return columns

    def _held_rows(self, point: OperatingPoint) -> Array | None:
        """Return how what holds depends on the states, one row a motion, if anything does."""
        rows = [np.zeros((0, len(point.x)))]
        for mode, value in point.modes.items():
            if value in HOLDING_MODES:
                found = self._motions[mode](point.x, point.z, point.u, point.q, point.t)
                of_x, of_u = (m.full() for m in found)
                rows.append(of_x[~of_u.any(axis=1)])
        held = np.vstack(rows)
        return held if len(held) else None


def _following(of_z: Any, of_others: Any, notes: list[str]) -> Any:
    """Return how algebraic unknowns follow all others, of complex matrices up to the first order of steps."""
    if not len(of_z):
        return np.zeros((0, of_others.shape[1]))
    scale = np.abs(of_z.real).max(axis=1)
    scale[scale == 0] = 1.0
    slopes = of_z.real / scale[:, None]
    follow, _, rank, _ = np.linalg.lstsq(slopes, -of_others.real / scale[:, None], rcond=1e-13)
    if np.iscomplexobj(of_z):
        rest = of_others.imag + of_z.imag @ follow
        follow = follow - 1j * np.linalg.lstsq(slopes, rest / scale[:, None], rcond=1e-13)[0]
    if rank < len(of_z):
        notes.append(
            f"{len(of_z) - rank} algebraic unknowns are not determined here; the least ones are taken"
        )
    return follow


def _drive(dae: DAE, name: str) -> Drive:
    path, order = name, 0
    while path.startswith("der(") and path.endswith(")"):
        path, order = path[4:-1], order + 1
    place = dae.parameters.index
    if path in dae.input_names:
        unit = next(i.unit for i in dae.inputs if i.path == path)
        return Drive(name, path, order, unit, None)
    if path in place and not order:
        return Drive(name, path, 0, dae.unit(path), place[path])
    raise ModelError(f"'{dae.name}' has no input '{path}'{nearest(path, [*dae.input_names, *place])}")


def _expression(dae: DAE, name: str) -> Any:
    try:
        return dae.expression(name)
    except KeyError as error:
        raise ModelError(f"'{dae.name}' has no output '{name}': {error.args[0]}") from None
