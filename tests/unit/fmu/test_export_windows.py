"""The library for Windows, built here by zig, run under Wine."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import inertance as ia
import pytest

WINE = shutil.which("wine64") or shutil.which("wine")
pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("ziglang") is None or WINE is None,
    reason="needs ziglang (extra cross) and Wine (Debian: wine)",
)
STEP, COUNT = 0.05, 30


def ball() -> ia.Network:
    net = ia.Network(
        "ball",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
    )
    net.connect(net.floor.flange, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)


def test_the_library_for_windows_runs(tmp_path: Path) -> None:
    dae = ball().dae()
    path = ia.export_fmu(
        dae, tmp_path / "ball.fmu", fmi_version="3.0", outputs=["ball.s"], platforms=["x86_64-windows"]
    )
    described = fmpy.read_model_description(str(path))
    reference = next(v.valueReference for v in described.modelVariables if v.name == "ball.s")
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path)
    program = tmp_path / "windows.exe"
    headers = Path(fmpy.__file__).parent / "c-code"
    build = [
        sys.executable,
        "-m",
        "ziglang",
        "cc",
        "-target",
        "x86_64-windows-gnu",
        "-std=c99",
        f"-I{headers}",
    ]
    source = str(Path(__file__).with_name("windows.c"))
    subprocess.run([*build, source, "-o", str(program)], check=True)
    environment = {**os.environ, "WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"}
    library = tmp_path / "binaries" / "x86_64-windows" / "ball.dll"
    words = [str(library), described.instantiationToken, reference, STEP, COUNT]
    done = subprocess.run(
        [str(WINE), str(program), *map(str, words)], capture_output=True, text=True, env=environment
    )
    assert done.returncode == 0, done.stderr[-2000:]
    found = [float(line) for line in done.stdout.split()]
    native = ia.simulate(dae, STEP * COUNT, step=STEP, rtol=1e-10, atol=1e-12)
    wanted = [float(native["ball.s"][native.time <= STEP * (k + 1) + 1e-9][-1]) for k in range(COUNT)]
    assert found == pytest.approx(wanted, abs=1e-8)
