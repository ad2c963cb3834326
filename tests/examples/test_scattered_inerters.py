"""examples/scattered_inerters.py: members scatter about the machine that is built as it is drawn."""

from pathlib import Path
from typing import Any

import inertance as ia
import pytest
from inertance.networks import ToolchainError
from inertance.networks.csource import compiler

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

EXAMPLE = "scattered_inerters"


def test_forces_scatter_about_that_of_the_nominal_machine(example: Any, tmp_path: Path) -> None:
    many = example.run(40)
    assert not many.errors
    nominal = ia.simulate(many.dae, many.time[-1], start=example.rolling(many.dae), step=5e-4)
    low, _, middle, _, high = example.table(many)[example.PEAK]
    assert low < nominal.peak(example.FORCE) < high
    assert middle == pytest.approx(nominal.peak(example.FORCE), rel=0.1)
    assert high - low < 0.3 * middle
    example.draw(many, tmp_path / "scatter.png")
    assert (tmp_path / "scatter.png").stat().st_size > 10_000
