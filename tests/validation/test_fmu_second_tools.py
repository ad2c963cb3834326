"""Our FMUs in tools that are not ours: ecos, libcosim and PathSim run a block that sticks and slips.

They are optional; each test says what it skips.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest

STEP, COUNT = 0.01, 200
EXAMPLES = Path(__file__).parents[2] / "examples"
START = {"rub.v_rel": 0.0}


def module(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec
    assert spec.loader
    found = sys.modules[name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


@pytest.fixture(scope="module")
def dae() -> ia.DAE:
    found: ia.DAE = module("fmu_models").stick_slip().dae()
    return found


def run(
    tool: str, dae: ia.DAE, version: str, folder: Path, kind: str = "CS"
) -> tuple[np.ndarray, np.ndarray]:
    """Return instants, and where the block is, as a tool found it."""
    importers = module("fmu_importers")
    if not importers.IMPORTERS[tool].version:
        pytest.skip(f"{tool} is not installed")
    path = ia.export_fmu(
        dae,
        folder / "it.fmu",
        fmi_version=version,
        outputs=["block.s"],
        start=START,
        tolerance=1e-9,
        step=STEP,
    )
    try:
        times, found = importers.imported(tool, path, version, kind, STEP, COUNT)
    except importers.ImporterError as error:
        if "libtbb" in str(error):
            pytest.skip("ecospy finds no libtbb.so.12: pip install tbb")
        raise
    assert times[-1] == pytest.approx(STEP * COUNT, abs=1.5 * STEP)
    return times, found[:, 0]


def native(dae: ia.DAE, times: np.ndarray) -> np.ndarray:
    """Return where the block is at given instants, from points close together."""
    result = ia.simulate(dae, STEP * (COUNT + 1), step=STEP / 50, start=START, rtol=1e-9, atol=1e-11)
    wanted: np.ndarray = np.interp(times, result.time, result["block.s"])
    return wanted


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_ecos_agrees(dae: ia.DAE, version: str, tmp_path: Path) -> None:
    times, found = run("ecos", dae, version, tmp_path)
    assert found == pytest.approx(native(dae, times), abs=1e-6)


def test_libcosim_agrees(dae: ia.DAE, tmp_path: Path) -> None:
    times, found = run("libcosim", dae, "2.0", tmp_path)
    assert found == pytest.approx(native(dae, times), abs=1e-6)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_pathsim_agrees(dae: ia.DAE, version: str, kind: str, tmp_path: Path) -> None:
    times, found = run("PathSim", dae, version, tmp_path, kind)
    assert found == pytest.approx(native(dae, times), abs=1e-5)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_fmu_manipulation_toolbox_finds_nothing_wrong(dae: ia.DAE, version: str, tmp_path: Path) -> None:
    if importlib.util.find_spec("fmu_manipulation_toolbox") is None:
        pytest.skip("fmu-manipulation-toolbox is not installed")
    path = ia.export_fmu(dae, tmp_path / "it.fmu", fmi_version=version, start=START, platforms=[])
    command = "from fmu_manipulation_toolbox.cli.fmutool import fmutool; fmutool()"
    words = [sys.executable, "-c", command, "-input", str(path), "-check"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    told = done.stdout + done.stderr
    assert done.returncode == 0, told
    assert f"compliant with FMI-{version}" in told
    assert f"No semantic error against the FMI-{version[0]} standard" in told
