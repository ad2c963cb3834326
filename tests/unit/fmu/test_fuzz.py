"""A small fuzz of exported FMUs; `tests/fuzz/fuzz.py` does the same at full size, and optimised."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest


def _fuzz() -> ModuleType:
    path = Path(__file__).parents[2] / "fuzz" / "fuzz.py"
    spec = importlib.util.spec_from_file_location("fmu_fuzz", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


fuzz = _fuzz()
pytestmark = pytest.mark.skipif(
    fuzz.compiler() is None or sys.platform != "linux", reason="needs a C compiler on Linux"
)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_random_calls_neither_crash_nor_hang_nor_leak(
    version: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fuzz, "STRICT", ["-O0" if flag == "-O1" else flag for flag in fuzz.STRICT])
    sanitized = fuzz.has_sanitizers(fuzz.compiler(), tmp_path)
    program = fuzz.build(version, tmp_path, sanitized)
    for kind in fuzz.KINDS:
        done = fuzz.run(program, kind, 250, seed=7)
        assert done.returncode == 0, (kind, done.stdout, done.stderr[-2000:])
        assert " error" in done.stdout
