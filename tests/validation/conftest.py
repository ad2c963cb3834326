"""What the MSL examples are compared by: reference results and the histories of modes."""

import os
from collections.abc import Callable
from pathlib import Path

import inertance as ia
import numpy as np
import pytest
from numpy.typing import NDArray

BESIDE = Path(__file__).resolve().parents[3] / "shared"

Array = NDArray[np.float64]
History = list[tuple[float, int]]
Switches = Callable[[ia.Result, str], list[tuple[float, str]]]


class Reference:
    """A reference result: its signals by name, and the names of those that count, by kind."""

    def __init__(self, folder: Path, name: str) -> None:
        path = folder / f"{name}.csv"
        with path.open(encoding="utf-8") as file:
            heads = file.readline().replace('"', "").strip().split(",")
        table = np.loadtxt(path, delimiter=",", skiprows=1)
        self.signals: dict[str, Array] = dict(zip(heads, table.T, strict=True))
        self.time = self.signals["time"]
        counted = (folder / f"{name}.signals.txt").read_text(encoding="utf-8").split()
        self.modes = [c for c in counted if c.endswith(".mode")]
        self.starts = [c for c in counted if c.endswith((".startForward", ".startBackward"))]
        self.motions = [c for c in counted if c not in ("time", *self.modes, *self.starts)]

    @property
    def between_events(self) -> NDArray[np.bool_]:
        """Rows away from events: at an event two rows share one time."""
        step = np.diff(self.time) > 0
        rows: NDArray[np.bool_] = np.append(True, step) & np.append(step, True)
        return rows

    def history(self, name: str) -> History:
        """Return the values a discrete signal takes, and from when."""
        values = self.signals[name]
        changed = np.flatnonzero(np.diff(values, prepend=values[0] - 1))
        return [(float(self.time[i]), int(values[i])) for i in changed]


@pytest.fixture(scope="session")
def reference() -> Callable[[str], Reference]:
    """Return the reader of MSL's reference results in data/msl of INERTANCE_SHARED or of ../shared."""
    folder = Path(os.environ.get("INERTANCE_SHARED", BESIDE)) / "data" / "msl"
    if not folder.is_dir():
        pytest.skip(f"comparison with the MSL reference results: no folder {folder} (see INERTANCE_SHARED)")
    return lambda name: Reference(folder, name)


@pytest.fixture(scope="session")
def switches() -> Switches:
    """Return what a mode switched to, and when."""
    return lambda run, mode: [(event.time, event.target) for event in run.events if event.mode == mode]
