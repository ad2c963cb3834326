"""The energy book of a run: powers integrated between its points, and what shocks take."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np

from ...base import Array, Flags, ModelError
from ...components.language import (
    KINETIC,
    LOSS_POWER,
    POTENTIAL,
    SUPPLY_POWER,
    Domain,
    Port,
    fields_of,
    parts_of,
)
from ..evaluation.compiled import Batch, dense
from ..evaluation.jacobians import Points
from ..flattening.derived import SUMMED
from ..flattening.flat import Instance
from ..results.energy import NEGLIGIBLE_SHARE, EnergyBook
from .dense_output import ULPS, DenseOutput, Gaps
from .shock_losses import ContactShocks, contact_shocks, shocks_at

if TYPE_CHECKING:
    from ..results.result import Result
    from .events.switcher import Event

NODES, WEIGHTS = (each / 2 for each in np.polynomial.legendre.leggauss(3))  # exact for force times speed
JUMP_SHARE = 1e-9  # of how far a flange moves in all, below which it does not jump
BEND_SHARE = 1e-4  # of a range, and in energy of all that is turned over: what bends more is followed again


@dataclass(frozen=True, eq=False)
class _Worked:
    """An element whose work is that of its flanges, and where these stand among the flanges of all."""

    instance: Instance
    flanges: dict[str, int]

    @property
    def supplies(self) -> bool:
        """Whether it is a source: what it takes is what it supplies, turned round."""
        return not self.instance.component.has_law


def energy_book(result: Result, dense_output: DenseOutput) -> EnergyBook:
    """Return the book of a run.

    Raises:
        ModelError: where a prescribed position jumps against a force that grows with speed.
    """
    dae, table, points = result.dae, result.dae.derived, result.points
    stores = {name: table.declaring(name) for name in (KINETIC, POTENTIAL)}
    powers = {name: table.declaring(name) for name in (LOSS_POWER, SUPPLY_POWER)}
    worked = _worked(result)
    signals = _Signals(points, powers, worked, dense_output)
    powered, work = signals.integrals()
    columns = iter(powered.T)
    dissipated, fed = ({i.path: next(columns) for i in found} for found in powers.values())
    clusters, numbers = _clusters(points.t), np.arange(len(points.t))
    shocks = {shock.first: shock for shock in contact_shocks(result, clusters)}
    for shock in shocks.values():
        for path in dissipated.keys() & shock.losses.keys():
            dissipated[path] = dissipated[path] + shock.losses[path] * (numbers >= shock.last)
    for first, last in clusters:
        work[last:] += signals.shock_work(result, first, last, shocks.get(first))
    taken = {w.instance.path: work[:, [*w.flanges.values()]].sum(axis=1) for w in worked}
    values = [ca.densify(table.row(name, found, dae.variables)) for name, found in stores.items()]
    rows = Batch(ca.Function("stored", dae.arguments(), values))(*points.arguments)
    kinetic, potential = (
        {i.path: row[:, 0, k] for k, i in enumerate(found)}
        for row, found in zip(rows, stores.values(), strict=True)
    )
    supplied = fed | {w.instance.path: -taken[w.instance.path] for w in worked if w.supplies}
    others = {w.instance.path: taken[w.instance.path] for w in worked if not w.supplies}
    book = EnergyBook(dae.name, points.t, kinetic, potential, dissipated, supplied, others)
    least = NEGLIGIBLE_SHARE * book.turnover
    told = {path: work for path, work in others.items() if np.abs(work).max() > least}
    moved = {path: work for path, work in supplied.items() if np.abs(work).max() > 0}
    return EnergyBook(dae.name, points.t, kinetic, potential, dissipated, moved, told)


def _worked(result: Result) -> list[_Worked]:
    """Return the elements that declare nothing, with their flanges."""
    found, count = [], 0
    for instance in result.dae.flat.instances.values():
        declares = SUMMED.keys() & instance.template.derived.keys()
        ports = _flanges(instance)
        if ports and not declares and not parts_of(instance.component):
            found.append(_Worked(instance, {port.name: count + k for k, port in enumerate(ports)}))
            count += len(ports)
    return found


def _flanges(instance: Instance) -> list[Port]:
    """Return the ports of a component through which work is done."""
    return [port for port in fields_of(instance.component, Port) if isinstance(port.domain, Domain)]


class _Signals:
    """Powers that elements declare, and forces and positions of flanges, with their rates, at points."""

    def __init__(
        self,
        points: Points,
        declared: dict[str, list[Instance]],
        worked: list[_Worked],
        dense_output: DenseOutput,
    ) -> None:
        closed, dae = points.closed, points.closed.dae
        self._points, self._dense_output = points, dense_output
        powers = ca.horzcat(*(dae.derived.row(name, i, dae.variables) for name, i in declared.items())).T
        flanges = [(w.instance, port) for w in worked for port in _flanges(w.instance)]
        forces, positions = (
            ca.vertcat(
                ca.SX(0, 1), *(dae.expression(f"{i.full(p.name)}.{getattr(p, kind)}") for i, p in flanges)
            )
            for kind in ("through", "across")
        )
        self.powers, self.flanges = powers.numel(), len(flanges)
        values = closed.close(ca.densify(ca.vertcat(powers, forces, positions)))
        self._driven = {w.instance.path: w.flanges for w in worked if w.supplies and "flange" in w.flanges}
        passed = ca.jacobian(forces, dae.impulses)
        if dae.z.numel():
            yielding = ca.solve(ca.jacobian(dae.alg, dae.z), ca.jacobian(dae.alg, dae.impulses))
            passed = passed - ca.mtimes(ca.jacobian(forces, dae.z), yielding)
        self._passed = Batch(closed.function("passed", *dense(closed.close(passed))))
        self._batch = Batch(closed.function("powers", *dense(values, closed.rate(values))))
        self.values, self.rates = self.at(points)
        self._ranges = np.ptp(self.values, axis=0)
        self._ranges[: self.powers] = self._ranges[: self.powers].max(initial=0.0)
        self._turned = self._least_turned()

    def _least_turned(self) -> float:
        """Return what the power or work that does most turns over at least, without spikes between points."""
        least = np.minimum(np.abs(self.values[1:]), np.abs(self.values[:-1]))
        energy = least[:, self.part("power")] * np.diff(self._points.t)[:, None]
        moved = np.abs(np.diff(self.values[:, self.part("position")], axis=0))
        turned = np.hstack([energy, least[:, self.part("force")] * moved])
        return float(turned.sum(axis=0).max(initial=0.0))

    def at(self, points: Points) -> tuple[Array, Array]:
        """Return values and rates at points, (points, signals) each."""
        values, rates = self._batch(points.x, points.z, points.q, points.t[:, None])
        return values[:, :, 0], rates[:, :, 0]

    def part(self, which: str) -> slice:
        """Return where powers, forces or positions stand among the signals."""
        begin = {"power": 0, "force": self.powers, "position": self.powers + self.flanges}[which]
        return slice(begin, begin + (self.powers if which == "power" else self.flanges))

    def integrals(self) -> tuple[Array, Array]:
        """Return the energy of declared powers and the work on flanges, from the first point to each."""
        begin, found = self._dense_output.integrals(self._over)
        t = self._points.t
        place = np.searchsorted(t, begin, side="right")  # the first point after a piece has begun
        gained = np.zeros((len(t), found.shape[1]))
        np.add.at(gained, np.minimum(place, len(t) - 1), found)
        force, position = self.values[:, self.part("force")], self.values[:, self.part("position")]
        jumps = np.diff(t) <= ULPS * np.spacing(np.abs(t[1:]))
        moved = (force[1:] + force[:-1]) / 2 * np.diff(position, axis=0) * jumps[:, None]
        gained[1:, self.powers :] += moved
        total = np.cumsum(gained, axis=0)
        return total[:, : self.powers], total[:, self.powers :]

    def _over(self, gaps: Gaps) -> tuple[Array, Flags]:
        """Return integrals over pieces, and which of them are doubtful."""
        (y0, s0), (y1, s1) = self.at(gaps.first), self.at(gaps.last)
        h = gaps.length[:, None]
        a, b = h * s0 - (y1 - y0), h * s1 - (y1 - y0)
        a, b = (np.where(np.isfinite(a) & np.isfinite(b), each, 0.0) for each in (a, b))
        powers, force, position = (self.part(name) for name in ("power", "force", "position"))
        gained = h * ((y0 + y1) / 2 + (a - b) / 12)[:, powers]
        work = np.zeros((len(h), self.flanges))
        for node, weight in zip(NODES + 0.5, WEIGHTS, strict=True):
            value = y0 + node * (y1 - y0 + (1 - node) * (a * (1 - node) - b * node))
            slope = y1 - y0 + a * (1 - node) * (1 - 3 * node) - b * node * (2 - 3 * node)
            work += weight * value[:, force] * slope[:, position]
        bend = (np.abs(a) + np.abs(b)) / 12
        unsure = np.hstack([h * bend[:, powers], np.abs((y1 - y0)[:, position]) * bend[:, force]])
        doubtful = np.any(bend > BEND_SHARE * self._ranges + 1e-300, axis=1)
        doubtful |= np.any(unsure > BEND_SHARE * self._turned + 1e-300, axis=1)
        return np.hstack([gained, work]), doubtful

    def shock_work(self, result: Result, first: int, last: int, shock: ContactShocks | None) -> Array:
        """Return the work on flanges by what is struck between two points of one instant.

        Raises:
            ModelError: where a prescribed position jumps against a force that grows with speed.
        """
        speeds = (self.rates[first] + self.rates[last])[self.part("position")] / 2
        impulses = np.zeros(self.flanges)
        if shock is not None:
            p = shock.during
            passed = self._passed(p.x[None], p.z[None], p.q[None], np.array([[p.t]]))[0][0]
            impulses = passed @ shock.impulses
        for event in shocks_at(result, first):
            driven = self._driven.get(event.mode.rpartition(".")[0])
            if driven and event.impulse is not None:
                self._check_finite(event, driven, first, last)
                impulses[driven["flange"]] = -event.impulse
                if "support" in driven:
                    impulses[driven["support"]] = event.impulse
        return np.asarray(impulses * speeds)

    def _check_finite(self, event: Event, driven: dict[str, int], first: int, last: int) -> None:
        places = self.part("position").start + np.array([*driven.values()])
        jump = float(np.abs(self.values[last, places] - self.values[first, places]).max())
        if jump > JUMP_SHARE * self._ranges[places].max() and event.impulse:
            raise ModelError(
                f"at t = {event.time:.9g} s {event.component} jumps by {jump:.4g} against a force that grows "
                "with speed, which takes more energy the faster it is; give a ramp instead of the jump"
            )


def _clusters(t: Array) -> list[tuple[int, int]]:
    """Return the first and the last of the points that share an instant, wherever several do."""
    same = np.concatenate([[False], np.diff(t) <= ULPS * np.spacing(np.abs(t[1:])), [False]])
    edges = np.flatnonzero(np.diff(same.astype(int)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
