"""The first run of an assembled model in a new process: solver "auto" over CVODES.

Measured: the planetary flywheel inerter of the two benchmarks before, 1 s, with nothing kept from earlier
runs, and with what earlier runs have kept; bytecode is compiled before, as an installer does.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from measure import Contender, Cost, compare
from table import show

SCRIPT = Path(__file__).parent / "ours" / "first_run.py"
TARGET = 1.2
RUNS_TO_KEEP = 200


def main(rounds: int) -> None:
    with TemporaryDirectory(prefix="inertance-") as bytecode:
        for kind in ("smooth", "hybrid"):
            _compare(kind, rounds, bytecode)


def _compare(kind: str, rounds: int, bytecode: str) -> None:
    with TemporaryDirectory(prefix="inertance-") as warm, TemporaryDirectory(prefix="inertance-") as cold:
        _run(kind, "auto", warm, bytecode, RUNS_TO_KEEP)
        for told, cache, target in (("nothing", cold, TARGET), ("the model", warm, None)):
            peer = [Contender("CVODES", _first(kind, "cvodes", cold, bytecode), target=target)]
            ours = Contender("library", _first(kind, "auto", cache, bytecode))
            show(f"First run, {kind} PFI, {told} kept from earlier ones", compare(ours, peer, rounds))


def _first(kind: str, solver: str, cache: str, bytecode: str) -> Callable[[], Cost]:
    return lambda: _run(kind, solver, cache, bytecode, 1)


def _run(kind: str, solver: str, cache: str, bytecode: str, count: int) -> Cost:
    places = {"XDG_CACHE_HOME": cache, "PYTHONPYCACHEPREFIX": bytecode, "PYTHONDONTWRITEBYTECODE": ""}
    command = [sys.executable, str(SCRIPT), kind, solver, str(count)]
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=os.environ | places)
    told = json.loads(done.stdout)
    return Cost(told["wall"], told["cpu"])
