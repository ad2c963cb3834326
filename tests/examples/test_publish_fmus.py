"""examples/publish_fmus.py: an FMU in the layout of the cross-check, with what the native run says of it."""

import shutil
import sys
from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.validation import validate_fmu

EXAMPLE = "publish_fmus"
FOLDER = str(Path(__file__).parents[2] / "examples")
pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


@pytest.fixture(scope="module", autouse=True)
def neighbours() -> Any:
    """Let the example find those it takes from, as where it is started."""
    sys.path.insert(0, FOLDER)
    yield
    sys.path.remove(FOLDER)


def test_a_machine_is_published_with_its_reference(example: Any, tmp_path: Path) -> None:
    file = example.publish(tmp_path, "tid_quarter_car", "2.0")
    for kind in ("me", "cs"):
        place = (
            tmp_path / "fmus/2.0" / kind / fmpy.platform / "inertance" / ia.__version__ / "tid_quarter_car"
        )
        header, *rows = (place / "tid_quarter_car_ref.csv").read_text().splitlines()
        assert header.startswith('"time","body')
        assert len(rows) == 501
        options = dict(
            line.split(", ") for line in (place / "tid_quarter_car_ref.opt").read_text().splitlines()
        )
        assert {"StartTime", "StopTime", "StepSize", "RelTol"} <= options.keys()
        assert (place / "tid_quarter_car_in.csv").read_text().splitlines() == [
            '"time","wind.f"',
            "0,-50",
            "2,-50",
        ]
        assert validate_fmu(str(place / "tid_quarter_car.fmu")) == []
    found = list(example.tried(tmp_path, file, ["FMPy"]))
    assert [one.kind for one in found] == ["ME", "CS"]
    assert all(one.off < 1e-5 for one in found)
    passed = list((tmp_path / "results").rglob("passed"))
    assert len(passed) == 2
    assert "| FMPy |" in example.report(found)


def test_what_is_off_or_ends_early_is_seen(example: Any, tmp_path: Path) -> None:
    run = ia.Network("free", mass=ia.Mass(m=1.0, v=1.0)).simulate(1.0, step=0.1)
    file = example.Published("free", "2.0", tmp_path, 0.1, run, ("mass.s",))
    values = run["mass.s"][:, None]
    assert file.off(run.time, values) == 0
    assert file.off(run.time, values + 0.01) == pytest.approx(0.01)
    assert file.off(run.time[:5], values[:5]) == np.inf
