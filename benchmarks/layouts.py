"""J1 of S1 to S8, each tuned at several static stiffnesses, from the same starts within the same bounds.

Measured: the whole table, from networks to numbers, so the library's assembly is in it. The peer writes each
car down as a state space by hand, solves the Lyapunov equation with SciPy and minimises with L-BFGS-B in
logarithms, its derivatives by differences or from the adjoint Lyapunov equation. Excess: of J1 over the least
of all contenders, at the worst place of the table.
"""

from __future__ import annotations

import inertance as ia
import numpy as np
from measure import Contender, compare, once
from peers import layouts_scipy as peer
from table import show


def table() -> dict[tuple[str, float], float]:
    return {(layout, k): tuned(layout, k) for layout in peer.LAYOUTS for k in peer.STIFFNESS}


def tuned(layout: str, k: float) -> float:
    start = peer.START
    strut = ia.machines.suspension(
        layout, k, start["d"], start["b"], start["k_b"], start["k_1"], start["k_2"]
    )
    car = ia.machines.quarter_car(strut, m_s=peer.M_S, m_u=peer.M_U, k_t=peer.K_T).dae()
    known = car.parameter_values
    names = {key: name for key in peer.LAYOUTS[layout] if (name := _path(key, known))}
    bounds = {name: peer.BOUNDS[key[0]] for key, name in names.items()}
    begin = {name: start[key] for key, name in names.items()}
    return float(ia.analysis.tune(car, ia.analysis.ride_j1, bounds, start=begin, starts=1).value)


ENDS = {"d": (".damper.d", "rest.d"), "b": (".inerter.b",), "k_b": (".relaxation.k",)}


def _path(key: str, known: dict[str, float]) -> str:
    ends = ENDS.get(key, (f"{'upper' if key == 'k_1' else 'lower'}.centring.k",))
    return next(name for name in known if name.startswith("strut.rest") and name.endswith(ends))


def main(rounds: int) -> None:
    tables = {"library": table(), **{name: go() for name, go in peer.TABLES.items()}}
    best = {point: min(t[point] for t in tables.values()) for point in tables["library"]}
    told = {n: f"worst excess {max(t[p] / best[p] - 1 for p in best):.1e}" for n, t in tables.items()}
    ours = Contender("library", once(table), told["library"])
    peers = [Contender(name, once(go), told[name]) for name, go in peer.TABLES.items()]
    notes = [f"J1 at {k / 1e3:g} kN/m: {row(tables['library'], k)}" for k in peer.STIFFNESS]
    show(f"Table of J1 of S1 to S8 ({told['library']})", compare(ours, peers, rounds), notes)


def row(values: dict[tuple[str, float], float], k: float) -> str:
    return "  ".join(f"{layout} {np.round(values[layout, k], 4)}" for layout in peer.LAYOUTS)


if __name__ == "__main__":
    main(3)
