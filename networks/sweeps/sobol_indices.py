"""Sobol indices: how much of a measure's variance is due to each parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import ModelError, demand, instance, nearest, text, whole
from .design import salib, unit_problem
from .sweep import Sweep

if TYPE_CHECKING:
    import pandas as pd


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
    _, analysis = salib()
    found: Any = analysis.analyze(
        unit_problem(design.names), values, calc_second_order=design.second_order, seed=seed
    )
    columns = {name: np.asarray(found[name], dtype=float) for name in ("S1", "S1_conf", "ST", "ST_conf")}
    table = pd.DataFrame(columns, index=pd.Index(design.names, name="parameter"))
    if design.second_order:
        table.attrs["S2"] = pd.DataFrame(found["S2"], index=design.names, columns=design.names)
    return table
