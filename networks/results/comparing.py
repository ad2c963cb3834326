"""How far two runs, or a run and what was measured, are apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base import Array, ModelError

if TYPE_CHECKING:
    import pandas as pd

    from .over_time import OverTime


def compared(first: OverTime, second: OverTime, names: list[str]) -> pd.DataFrame:
    """Return a row for each signal; see `OverTime.compare`."""
    import pandas as pd

    begin, end = max(first.time[0], second.time[0]), min(first.time[-1], second.time[-1])
    if not begin < end:
        raise ModelError(f"'{first.name}' and '{second.name}' have no time in common")
    times = np.union1d(first.time, second.time)
    times = times[(begin <= times) & (times <= end)]
    rows = {name: _row(first, second, name, times) for name in names}
    columns = ["unit", "rms", "rms of difference", "largest difference", "at [s]"]
    return pd.DataFrame.from_dict(rows, orient="index", columns=columns).rename_axis("signal")


def _row(
    first: OverTime, second: OverTime, name: str, times: Array
) -> tuple[str, float, float, float, float]:
    if (units := [one.unit(name) for one in (first, second)])[0] != units[1] and all(units):
        raise ModelError(f"'{name}' is in {units[0]} in '{first.name}' and in {units[1]} in '{second.name}'")
    values = np.asarray(first.at(name, times), dtype=float)
    apart = np.asarray(second.at(name, times), dtype=float) - values
    worst = int(np.abs(apart).argmax())
    return max(units), _rms(values, times), _rms(apart, times), float(apart[worst]), float(times[worst])


def _rms(values: Array, times: Array) -> float:
    """Return the root of the mean square over time of what is straight between the instants."""
    a, b = values[:-1], values[1:]
    return float(np.sqrt(np.sum((a * a + a * b + b * b) / 3 * np.diff(times)) / (times[-1] - times[0])))
