"""Where measured and published data lie, and what the validation tests share."""

import os
from collections.abc import Callable
from pathlib import Path

import inertance as ia
import pytest

BESIDE = Path(__file__).resolve().parents[3] / "shared"

Switches = Callable[[ia.Result, str], list[tuple[float, str]]]


@pytest.fixture(scope="session")
def msl_references() -> Path:
    """Folder of the MSL reference results: data/msl in INERTANCE_SHARED or in ../shared."""
    folder = Path(os.environ.get("INERTANCE_SHARED", BESIDE)) / "data" / "msl"
    if not folder.is_dir():
        pytest.skip(f"comparison with the MSL reference results: no folder {folder} (see INERTANCE_SHARED)")
    return folder


@pytest.fixture(scope="session")
def switches() -> Switches:
    """Return what a mode switched to, and when."""
    return lambda run, mode: [(event.time, event.target) for event in run.events if event.mode == mode]
