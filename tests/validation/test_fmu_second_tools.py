"""Our FMUs in tools that are not ours: ecos, libcosim and PathSim run a block that sticks and slips.

They are optional; each test says what it skips.
"""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import fmpy
import inertance as ia
import numpy as np
import pytest

STEP, COUNT = 0.01, 200
MACHINES = Path(__file__).parents[2] / "examples" / "fmu_models.py"
START = {"rub.v_rel": 0.0}
ECOS = """
import sys
import ctypes, glob
for library in glob.glob(sys.prefix + "/lib/libtbb.so.12"):
    ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
from ecospy import EcosSimulation, EcosSimulationStructure
structure = EcosSimulationStructure()
structure.add_model("it", path)
run = EcosSimulation(structure=structure, step_size=step)
run.init()
for _ in range(count):
    run.step()
    found.append(run.get_real("it::block.s"))
run.terminate()
"""
COSIM = """
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave
run = CosimExecution.from_step_size(step_size=step * 1e9)
slave = CosimLocalSlave(fmu_path=path, instance_name="it")
number = run.add_local_slave(local_slave=slave)
seen = CosimObserver.create_last_value()
run.add_observer(observer=seen)
for _ in range(count):
    run.step()
    found += list(seen.last_real_values(slave_index=number, variable_references=[reference]))
"""
PATHSIM = """
from pathsim import Connection, Simulation
from pathsim.blocks import Scope
from pathsim.solvers import RKCK54
from pathsim_fmi.blocks import CoSimulationFMU, ModelExchangeFMU
block = CoSimulationFMU(path, dt=step) if kind == "CS" else ModelExchangeFMU(path)
scope = Scope()
solver = {"Solver": RKCK54, "tolerance_lte_rel": 1e-9, "tolerance_lte_abs": 1e-11} if kind == "ME" else {}
run = Simulation([block, scope], [Connection(block[0], scope[0])], dt=step, log=False, **solver)
run.run(step * count, adaptive=kind == "ME")
times, (found,) = scope.read()
times, found = list(times), list(found)
"""


@pytest.fixture(scope="module")
def dae() -> ia.DAE:
    spec = importlib.util.spec_from_file_location("fmu_models", MACHINES)
    assert spec
    assert spec.loader
    module = sys.modules["fmu_models"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    found: ia.DAE = module.stick_slip().dae()
    return found


def run(
    script: str, needs: str, dae: ia.DAE, version: str, folder: Path, kind: str = "CS"
) -> dict[str, object]:
    """Return what a tool found, in a process of its own."""
    if importlib.util.find_spec(needs) is None:
        pytest.skip(f"{needs} is not installed")
    path = ia.export_fmu(
        dae,
        folder / "it.fmu",
        fmi_version=version,
        outputs=["block.s"],
        start=START,
        tolerance=1e-9,
        step=STEP,
    )
    variables = fmpy.read_model_description(str(path)).modelVariables
    given = {
        "path": str(path),
        "kind": kind,
        "step": STEP,
        "count": COUNT,
        "reference": next(v.valueReference for v in variables if v.name == "block.s"),
    }
    told = f"globals().update({given!r})\nfound, times = [], []\n{script}\nimport json\n"
    told += f"json.dump([times, found], open({str(folder / 'found.json')!r}, 'w'))\n"
    done = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=False)
    if "libtbb" in done.stderr:
        pytest.skip("ecospy finds no libtbb.so.12: pip install tbb")
    assert done.returncode == 0, done.stderr[-2000:]
    times, found = json.loads((folder / "found.json").read_text())
    return {"times": np.array(times), "found": np.array(found)}


def native(dae: ia.DAE, times: np.ndarray) -> np.ndarray:
    """Return where the block is at given instants, from points close together."""
    result = ia.simulate(dae, STEP * (COUNT + 1), step=STEP / 50, start=START, rtol=1e-9, atol=1e-11)
    wanted: np.ndarray = np.interp(times, result.time, result["block.s"])
    return wanted


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_ecos_agrees(dae: ia.DAE, version: str, tmp_path: Path) -> None:
    seen = run(ECOS, "ecospy", dae, version, tmp_path)
    wanted = native(dae, STEP * np.arange(1, COUNT + 1))
    assert seen["found"] == pytest.approx(wanted, abs=1e-6)


def test_libcosim_agrees(dae: ia.DAE, tmp_path: Path) -> None:
    seen = run(COSIM, "libcosimpy", dae, "2.0", tmp_path)
    wanted = native(dae, STEP * np.arange(1, COUNT + 1))
    assert seen["found"] == pytest.approx(wanted, abs=1e-6)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_pathsim_agrees(dae: ia.DAE, version: str, kind: str, tmp_path: Path) -> None:
    seen = run(PATHSIM, "pathsim_fmi", dae, version, tmp_path, kind)
    # PathSim takes a first step of Co-Simulation at its start, and is a communication step ahead from then on
    ahead = STEP if kind == "CS" else 0.0
    wanted = native(dae, np.asarray(seen["times"], dtype=float) + ahead)
    assert seen["found"] == pytest.approx(wanted, abs=1e-5)


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
