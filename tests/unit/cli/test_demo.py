"""`inertance demo`, on two short tests and a short random one."""

from pathlib import Path

import pytest
from inertance.cli import app, demo, demo_runs
from inertance.machines import RandomDisplacement, Sinusoid
from inertance.networks import ToolchainError
from PIL import Image
from typer.testing import CliRunner


def test_demo_prints_tables_and_draws_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demo, "TESTS", (Sinusoid(0.01, 3.0), Sinusoid(0.0015, 10.0)))
    monkeypatch.setattr(demo_runs, "RANDOM", (RandomDisplacement(seed=1, period=2.0),))
    done = CliRunner().invoke(app, ["demo", "--out", str(tmp_path / "new")])
    assert done.exit_code == 0
    for told in ("9.752e-04 kg.m2", "385 kg", "0.802 kg", "17.7%", "10 mm, 3 Hz", "389.8"):
        assert told in done.output
    for name in ("sinusoidal_tests", "frequency_response", "design_map"):
        with Image.open(tmp_path / "new" / f"{name}.png") as picture:
            assert min(picture.size) > 500
            assert len(set(picture.convert("L").resize((100, 100)).tobytes())) > 20


def test_without_a_compiler_long_runs_go_without() -> None:
    def simulated(solver: str = "auto") -> str:
        if solver == "compiled":
            raise ToolchainError("no C compiler was found")
        return solver

    assert demo_runs.by_c(simulated) == "auto"
