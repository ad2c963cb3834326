"""The benchmark of intervals: its machines are the library's, to what the library cannot tell."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture(scope="module")
def benchmark() -> Iterator[Any]:
    """The benchmark, which is no package."""
    sys.path.insert(0, str(BENCHMARKS))
    try:
        yield importlib.import_module("intervals")
    finally:
        sys.path.remove(str(BENCHMARKS))


@pytest.mark.parametrize("name", ["oscillator", "storeys", "slide"])
def test_its_machines_move_as_the_models_with_the_true_parameters(benchmark: Any, name: str) -> None:
    """A run of the model under the same drive parts from what it integrates by a thirtieth of the noise."""
    bench, draw = benchmark.BENCHES[name], np.random.default_rng(5)
    drive, at = bench.drive(draw), np.arange(0.0, 4.0, 1 / benchmark.RATE)
    truth = {path: 1.1 * value for path, value in bench.nominal.items()}
    values = bench.course(truth, drive, lambda t: 0.0 * t, 0.0, at)
    channels = dict(zip(bench.channels, values.values(), strict=True))
    (driven,) = [told["input"] for told in bench.channels.values() if "input" in told]
    before = np.arange(-benchmark.BEGIN, at[-1] + 5e-3, 1e-3)
    run = bench.model().simulate(
        float(at[-1]),
        begin=-benchmark.BEGIN,
        step=5e-3,
        inputs={driven: ia.Sampled(before, drive(before))},
        parameters=truth,
    )
    place = np.searchsorted(run.time, at + 1e-6, side="right") - 1
    for channel, told in bench.channels.items():
        if "output" in told:
            missed = run[told["output"]][place] - channels[channel]
            assert np.std(missed[400:]) < benchmark.NOISE_SHARE / 30 * np.std(channels[channel])


def test_what_holds_is_counted_with_its_interval(benchmark: Any) -> None:
    row = {"low": 1.0, "high": 3.0, "truth": 2.0, "value": 2.5, "error": 0.1}
    case = {"machine": "slide", "disturbance": "white noise", "parameters": [row, {**row, "truth": 4.0}]}
    told = benchmark.table([case])
    assert "| white noise | 1 | 2 | 50.0% (9.5% to 90.5%) | 0.0% (0.0% to 65.8%) |" in told
    assert "coloured" not in told.partition("\n")[2]
