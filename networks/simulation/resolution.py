"""Resolution: whether what moved in a run was large enough for its tolerance to follow it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...base import Array
from ..dae import DAE
from .integrator import nominal_sizes
from .settings import FINEST, Tolerance

LOST_SHARE = 3e-4  # share of a motion that the tolerance of one step may be ...
RTOL_FACTOR = 10.0  # ... or so many times the relative tolerance, if that is more
ROUNDING = 1e3 * np.finfo(float).eps
AT_REST = 1e-25


def resolution_notes(dae: DAE, states: Array, tolerance: Tolerance) -> Iterator[str]:
    """Yield what the tolerance of a run did not follow: all motion of one unit, by the state that moved most.

    The states are those at all points of the run, (points, states).
    """
    sizes, moved = np.abs(states).max(axis=0), np.ptp(states, axis=0)
    off = tolerance.of(sizes, nominal_sizes(dae, dae.states))
    moves = moved > np.maximum(ROUNDING * sizes, AT_REST)
    lost = moves & (off > max(LOST_SHARE, RTOL_FACTOR * tolerance.rtol) * moved)
    if not lost.any():
        return
    facts = dae.declared.facts
    units = np.array([facts[v].unit if v < len(facts) else dae.unit(dae.name_of(v)) for v in dae.states])
    for unit in dict.fromkeys(units[lost].tolist()):
        group = np.flatnonzero(units == unit)
        most = int(group[np.argmax(moved[group])])
        if not lost[most]:
            continue
        name, size, motion = dae.name_of(dae.states[most]), float(sizes[most]), float(moved[most])
        far, remedy = "", f"atol={tolerance.rtol * motion:.1g}"
        if tolerance.rtol * size > off[most] / 2:
            far, finer = f" about {size:.3g} {unit}", LOST_SHARE * motion / size / 2
            remedy = f"rtol={finer:.1g}" if finer > FINEST else f"{name} counted from where it rests"
        yield (
            f"{name} moves by no more than {motion:.3g} {unit}{far}, and the tolerances of this run are "
            f"{off[most]:.2g} {unit}: if that motion matters, run it with {remedy}"
        )
