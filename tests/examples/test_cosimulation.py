"""examples/cosimulation.py, with two steps and one of its cuts."""

import shutil
from pathlib import Path
from typing import Any

import pytest

EXAMPLE = "cosimulation"
PAGE = Path(__file__).parents[2] / "docs" / "fmu-cosimulation.md"
needs_compiler = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


def test_cuts(example: Any) -> None:
    found = {name: cut.terminals for name, cut in example.cuts(example.quarter_car()).items()}
    assert found["at the wheel"] == {
        "wheel": {"tyre.flange_b": "force-in"},
        "body": {"strut.flange_a": "motion-in"},
    }
    assert [sorted(t.values()) for t in found["through the strut"].values()] == [
        ["motion-in", "motion-out"]
    ] * 2


@needs_compiler
def test_errors_and_slopes(
    example: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    cut = {"at the wheel": example.cuts(example.quarter_car())["at the wheel"]}
    monkeypatch.setattr(example, "cuts", lambda car: cut)
    studies = example.study(tmp_path, steps=(5e-3, 2.5e-3), versions=["2.0"])
    found = {one.way: (one.errors[-1], one.slopes[-1]) for one in studies}
    assert found["FMI 2.0, held"] == pytest.approx((4.3e-3, 0.97), rel=0.05)
    assert found["FMI 2.0, line"] == pytest.approx((1.0e-4, 1.93), rel=0.05)
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("| at the wheel | held |"))
    for printed, way in zip(lines[first:], ("FMI 2.0, held", "FMI 2.0, line"), strict=False):
        (errors,) = (one.errors for one in studies if one.way == way)
        at_5_and_2_5_ms = [float(cell) for cell in printed.split("|")[4:6]]
        assert errors == pytest.approx(at_5_and_2_5_ms, rel=0.05)
    assert found["FMPy, held"] == pytest.approx((3.5e-3, 0.93), rel=0.05)
    example.print_table(studies)
    assert "at the wheel      FMI 2.0, line" in capsys.readouterr().out
    example.picture(studies).savefig(tmp_path / "cosimulation.png")
