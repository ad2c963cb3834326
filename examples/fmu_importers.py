"""Tools that run FMUs and install from a package registry, each in a process of its own.

    from fmu_importers import IMPORTERS, imported
    times, values = imported("libcosim", "it.fmu", "2.0", "CS", step=0.01, count=200)

`values` has a row for each instant and a column for each output, in the order of the model description.
Inputs stay at their start values. libcosim reads FMI 2.0 alone, ecos and fmuloader step Co-Simulation,
PathSim and FMPy run both kinds. PathSim takes a first step of Co-Simulation as it starts, so its instants
are told a step later. fmuloader's own allocator of FMI 2.0 gives addresses that cannot be used, so the FMU
is told to take its own.
"""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from importlib import metadata, util
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from fmpy import read_model_description

SECONDS = 600.0  # until a run counts as failed

FMPY = """
import numpy as np
from fmpy import simulate_fmu
exchange = kind == "ME"  # CVODE's local errors add up, and from output to output it takes 500 steps at most
seen = simulate_fmu(path, fmi_type="ModelExchange" if exchange else "CoSimulation", stop_time=stop,
                    output_interval=step / 20 if exchange else step, step_size=None if exchange else step,
                    output=outputs, relative_tolerance=1e-12 if exchange else tolerance)
times = [k * step for k in range(count + 1)]
rows = np.searchsorted(seen["time"], np.array(times) + 1e-9 * step, side="right") - 1  # after events
found = [[float(seen[name][row]) for name in outputs] for row in rows]
"""
ECOS = """
import ctypes
from importlib.metadata import files
for file in files("tbb"):
    if file.name == "libtbb.so.12":
        ctypes.CDLL(str(file.locate()), ctypes.RTLD_GLOBAL)
from ecospy import EcosSimulation, EcosSimulationStructure
structure = EcosSimulationStructure()
structure.add_model("it", path)
run = EcosSimulation(structure=structure, step_size=step)
run.init()
for k in range(count + 1):
    if k:
        run.step()
    times.append(k * step)
    found.append([run.get_real(f"it::{name}") for name in outputs])
run.terminate()
"""
COSIM = """
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave
run = CosimExecution.from_step_size(step_size=step * 1e9)
number = run.add_local_slave(local_slave=CosimLocalSlave(fmu_path=path, instance_name="it"))
seen = CosimObserver.create_last_value()
run.add_observer(observer=seen)
for k in range(1, count + 1):
    run.step()
    times.append(k * step)
    found.append(list(seen.last_real_values(slave_index=number, variable_references=references)))
"""
FMULOADER = """
from fmuloader import fmi2, fmi3
if version == "2.0":
    it = fmi2.Fmi2Slave(path, model_identifier=identifier)
    it.instantiate("it", fmi2.Fmi2Type.CO_SIMULATION, guid=token, cannot_use_memory_management_functions=True)
    it.setup_experiment(start_time=0.0, stop_time=stop, tolerance=tolerance)
    it.enter_initialization_mode()
else:
    it = fmi3.Fmi3Slave(path, model_identifier=identifier)
    it.instantiate_co_simulation("it", instantiation_token=token)
    it.enter_initialization_mode(start_time=0.0, stop_time=stop, tolerance=tolerance)
it.exit_initialization_mode()
get = it.get_real if version == "2.0" else it.get_float64
for k in range(count + 1):
    if k:
        it.do_step((k - 1) * step, step)
    times.append(k * step)
    found.append(get(references))
it.terminate()
it.free_instance()
"""
PATHSIM = """
from pathsim import Connection, Simulation
from pathsim.blocks import Constant, Scope
from pathsim.solvers import RKCK54
from pathsim_fmi.blocks import CoSimulationFMU, ModelExchangeFMU
block = CoSimulationFMU(path, dt=step) if kind == "CS" else ModelExchangeFMU(path)
scope, fed = Scope(), [Constant(value) for value in inputs]
links = [Connection(block[k], scope[k]) for k in range(len(outputs))]
links += [Connection(constant, block[k]) for k, constant in enumerate(fed)]
solver = {"Solver": RKCK54, "tolerance_lte_rel": 1e-9, "tolerance_lte_abs": 1e-11} if kind == "ME" else {}
run = Simulation([block, scope, *fed], links, dt=step, log=False, **solver)
run.run(step * count, adaptive=kind == "ME")
times, columns = scope.read()
times, found = [float(t) + step * (kind == "CS") for t in times], [list(row) for row in zip(*columns)]
"""


@dataclass(frozen=True)
class Importer:
    """A tool: its distribution, the module that must be there, what it runs, and how."""

    package: str
    module: str
    versions: tuple[str, ...]
    kinds: tuple[str, ...]
    script: str

    @property
    def version(self) -> str:
        """What is installed, empty if nothing is."""
        return metadata.version(self.package) if util.find_spec(self.module) else ""


IMPORTERS = {
    "FMPy": Importer("fmpy", "fmpy", ("2.0", "3.0"), ("ME", "CS"), FMPY),
    "ecos": Importer("ecospy", "ecospy", ("2.0", "3.0"), ("CS",), ECOS),
    "libcosim": Importer("libcosimpy", "libcosimpy", ("2.0",), ("CS",), COSIM),
    "PathSim": Importer("pathsim-fmi", "pathsim_fmi", ("2.0", "3.0"), ("ME", "CS"), PATHSIM),
    "fmuloader": Importer("fmuloader", "fmuloader", ("2.0", "3.0"), ("CS",), FMULOADER),
}


class ImporterError(Exception):
    """A tool failed; the message is the end of what it said."""


def imported(
    name: str, path: str | Path, version: str, kind: str, step: float, count: int, tolerance: float = 1e-9
) -> tuple[np.ndarray, np.ndarray]:
    """Return instants and outputs of an FMU as a tool found them.

    Raises:
        ImporterError: if it did not get to the end.
    """
    told: Any = read_model_description(str(path), validate=False)
    outputs = [v for v in told.modelVariables if v.causality == "output"]
    given = {
        "path": str(path), "version": version, "kind": kind, "step": step, "count": count,
        "stop": step * count, "tolerance": tolerance, "outputs": [v.name for v in outputs],
        "references": [v.valueReference for v in outputs],
        "inputs": [float(v.start) for v in told.modelVariables if v.causality == "input"],
        "identifier": told.coSimulation.modelIdentifier,
        "token": told.guid if version == "2.0" else told.instantiationToken,
    }  # fmt: skip
    with TemporaryDirectory() as folder:
        result = Path(folder) / "found.json"
        script = (
            f"globals().update({given!r})\nfound, times = [], []\n{IMPORTERS[name].script}\nimport json\n"
        )
        script += f"json.dump([times, found], open({str(result)!r}, 'w'))\n"
        try:
            done = subprocess.run(
                [sys.executable, "-c", script], capture_output=True, text=True, check=False, timeout=SECONDS
            )
        except subprocess.TimeoutExpired:
            raise ImporterError(f"no end within {SECONDS:g} s") from None
        if done.returncode or not result.exists():
            raise ImporterError((done.stderr.strip() or f"exit code {done.returncode}")[-2000:])
        times, found = json.loads(result.read_text())
    return np.array(times), np.array(found)
