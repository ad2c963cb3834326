"""What all tests share: they run alike however, and wherever, they were started."""

import gc
import os
import signal
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from inertance.networks.simulation.solver_choice import Account

os.environ.setdefault("CFLAGS", "-O0")  # small programs compile sooner than they are optimised
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of two processes on two cores, threads only queue
os.environ["MPLBACKEND"] = "Agg"
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # as in the background, for all processes begun there
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def interpreted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let solver "auto" hang neither on what this machine has compiled before, nor on its speed."""
    monkeypatch.setattr(Account, "told", lambda self, closed: (False, "it is tested"))
    monkeypatch.setattr(Account, "_begin", lambda self, closed: None)


def pytest_collection_finish() -> None:
    """Let the collector pass over what stays to the end: modules, tests, and their parameters."""
    gc.collect()
    gc.freeze()


@pytest.fixture(autouse=True, scope="session")
def whole_arrays_are_compared() -> Iterator[None]:
    """Let `approx` of an array pass what is near as a whole; pytest takes 10 us for each number."""
    approx = type(pytest.approx(np.zeros(1)))
    one_by_one = approx.__eq__

    def near(self: Any, actual: Any) -> bool:
        return _all_near(self, actual) or one_by_one(self, actual)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(approx, "__eq__", near)
        yield


def _all_near(wanted: Any, actual: Any) -> bool:
    """Tell whether arrays are surely as near as `approx` asks: |a - b| <= max(rel |b|, abs), b finite."""
    expected = wanted.expected
    if not all(isinstance(each, np.ndarray) and each.dtype.kind == "f" for each in (actual, expected)):
        return False
    relative = wanted.rel if wanted.rel is not None else 1e-6 if wanted.abs is None else 0.0
    absolute = wanted.abs if wanted.abs is not None else 1e-12
    if actual.shape != expected.shape or not (relative >= 0 and absolute >= 0):
        return False
    near = np.abs(actual - expected) <= np.maximum(relative * np.abs(expected), absolute)
    return bool((near & np.isfinite(expected)).all())
