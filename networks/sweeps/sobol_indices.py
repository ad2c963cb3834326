"""Sobol indices: how much of a measure's variance is due to each parameter."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import MissingPackageError, ModelError, boolean, demand, instance, nearest, text, whole
from .design import Design, Ranges, check, check_power_of_two, drawn
from .sweep import Sweep

if TYPE_CHECKING:
    import pandas as pd


def saltelli(ranges: Ranges, count: int, *, second_order: bool = False, seed: int = 0) -> Design:
    """Return the points that `sobol_indices` needs: count (n + 2) of them, or count (2 n + 2).

    Args:
        ranges: as for `monte_carlo`, for n parameters.
        count: base points, a power of 2.
        second_order: whether interactions of pairs are wanted, too.
        seed: of the random numbers.

    Raises:
        MissingPackageError: without SALib: `pip install "inertance[sensitivity]"`.

    Source: A. Saltelli, Comput. Phys. Commun. 145 (2002) 280-297.
    """
    check(ranges, count, seed)
    check_power_of_two(count)
    demand("saltelli()", second_order=(second_order, boolean))
    sample: Any = _salib("sample").sample
    unit = sample(_unit_problem(ranges), count, calc_second_order=second_order, seed=seed)
    return drawn(ranges, unit, second_order)


def sobol_indices(done: Sweep, measure: str = "value", *, seed: int = 0) -> pd.DataFrame:
    """Return Sobol indices of a measure, a row for each parameter.

        S1 = var(E(y | x))/var(y),   ST = 1 - var(E(y | all but x))/var(y)

    S1 is the share of a parameter alone, ST with all its interactions; S1_conf and ST_conf are half widths of
    their 95 % intervals. `attrs["S2"]` holds the shares of pairs, if the design has points for them.

    Args:
        done: a sweep over a design of `saltelli`.
        measure: a column of its table.
        seed: of the intervals' resampling.

    Raises:
        ModelError: for another design, an unknown measure, or points that failed.
        MissingPackageError: without SALib: `pip install "inertance[sensitivity]"`.

    Source: A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259-270; computed by SALib.
    """
    import pandas as pd

    demand("sobol_indices()", done=(done, instance(Sweep)), measure=(measure, text), seed=(seed, whole(0)))
    design = done.design
    if design.second_order is None:
        raise ModelError("Sobol indices need a sweep over the points of saltelli(ranges, count)")
    if measure not in done.table:
        raise ModelError(f"there is no measure '{measure}'{nearest(measure, done.table.columns)}")
    values = done.table[measure].to_numpy(dtype=float)
    wrong = len(design) - int(np.isfinite(values).sum())
    if wrong:
        raise ModelError(f"{wrong} of {len(design)} points have no '{measure}'; Sobol indices need all")
    analyze: Any = _salib("analyze").analyze
    problem = _unit_problem(design.names)
    found = analyze(problem, values, calc_second_order=design.second_order, seed=seed)
    columns = {name: np.asarray(found[name], dtype=float) for name in ("S1", "S1_conf", "ST", "ST_conf")}
    table = pd.DataFrame(columns, index=pd.Index(design.names, name="parameter"))
    if design.second_order:
        table.attrs["S2"] = pd.DataFrame(found["S2"], index=design.names, columns=design.names)
    return table


def _unit_problem(names: Iterable[str]) -> dict[str, Any]:
    """Return what SALib calls a problem: parameters between 0 and 1."""
    known = list(names)
    return {"num_vars": len(known), "names": known, "bounds": [[0.0, 1.0]] * len(known)}


def _salib(part: str) -> Any:
    try:
        return import_module(f"SALib.{part}.sobol")
    except ImportError as error:
        told = 'Sobol indices need SALib: pip install "inertance[sensitivity]"'
        raise MissingPackageError(told) from error
