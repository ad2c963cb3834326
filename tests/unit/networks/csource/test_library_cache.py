"""Compiled libraries are kept for other processes: of the same C, in a private folder, not too many."""

import math
import os
from pathlib import Path
from typing import Any

import inertance as ia
import pytest
from inertance.networks.csource import library_cache, toolchain
from inertance.networks.csource.toolchain import ToolchainError

TEXTS = {
    "unit.c": '#include "unit.h"\nint answer(void) { return ANSWER; }\n',
    "unit.h": "#define ANSWER 42\n",
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("LOCALAPPDATA", raising=False)
    return tmp_path / "inertance"


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """What is compiled while a test runs."""
    made, compile_shared = list[Path](), toolchain.compile_shared

    def counted(*given: Any, **more: Any) -> Path:
        made.append(compile_shared(*given, **more))
        return made[-1]

    monkeypatch.setattr(library_cache, "compile_shared", counted)
    return made


def size(path: Path) -> int:
    return path.stat().st_size


def test_the_same_c_is_compiled_once(folder: Path, compiled: list[Path]) -> None:
    first, again = (library_cache.library(TEXTS, (), size) for _ in range(2))
    assert first == again > 0
    assert len(compiled) == 1
    assert [path.suffix for path in folder.iterdir()] == [".so"]
    assert not folder.stat().st_mode & 0o077


def test_whatever_differs_is_compiled_anew(compiled: list[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    library_cache.library(TEXTS, (), size)
    library_cache.library(TEXTS | {"unit.h": "#define ANSWER 43\n"}, (), size)
    library_cache.library(TEXTS, ("-DOTHER",), size)
    monkeypatch.setenv("CFLAGS", "-O1 -DOTHER")
    library_cache.library(TEXTS, (), size)
    monkeypatch.setattr("platform.node", lambda: "elsewhere")  # where CFLAGS may mean another processor
    library_cache.library(TEXTS, (), size)
    assert len(compiled) == 5


def test_a_damaged_library_is_replaced(folder: Path, compiled: list[Path]) -> None:
    def load(path: Path) -> int:
        if not size(path):
            raise OSError(f"{path}: file too short")
        return size(path)

    library_cache.library(TEXTS, (), load)
    (kept,) = folder.iterdir()
    kept.write_bytes(b"")
    assert library_cache.library(TEXTS, (), load) == size(kept) > 0
    assert len(compiled) == 2


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
@pytest.mark.parametrize("mode", [0o770, 0o707])
def test_a_folder_that_others_can_write_to_is_not_used(folder: Path, compiled: list[Path], mode: int) -> None:
    library_cache.library(TEXTS, (), size)
    folder.chmod(mode)
    library_cache.library(TEXTS, (), size)
    assert len(compiled) == 2


def test_without_a_folder_it_is_compiled_each_time(
    compiled: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert library_cache.library(TEXTS, (), size) == library_cache.library(TEXTS, (), size)
    assert len(compiled) == 2


def test_what_was_not_used_for_longest_goes_first(
    folder: Path, compiled: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(library_cache, "MOST_KEPT", 2)
    flags = [f"-DN={n}" for n in range(3)]
    for age, flag in enumerate(flags[:2]):
        library_cache.library(TEXTS, (flag,), size)
        for path in folder.iterdir():
            os.utime(path, (path.stat().st_atime, path.stat().st_mtime - 100 * (age + 1)))
    library_cache.library(TEXTS, (flags[0],), size)  # used again
    library_cache.library(TEXTS, (flags[2],), size)
    assert len(list(folder.iterdir())) == 2
    library_cache.library(TEXTS, (flags[0],), size)
    assert len(compiled) == 3


def test_c_that_does_not_compile_is_told_and_not_kept(folder: Path) -> None:
    with pytest.raises(ToolchainError, match="could not compile"):
        library_cache.library({"unit.c": "no C at all"}, (), size)
    assert not list(folder.iterdir())


def test_a_network_with_other_values_is_compiled_once(compiled: list[Path]) -> None:
    def end(k: float, s: float) -> float:
        net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=k), mass=ia.Mass(m=1.0, s=s))
        net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
        return float(net.simulate(2.0, solver="compiled", rtol=1e-10)["mass.s"][-1])

    assert end(4.0, 1.0) == pytest.approx(math.cos(4.0), abs=1e-7)
    assert end(9.0, 0.5) == pytest.approx(0.5 * math.cos(6.0), abs=1e-7)
    assert len(compiled) == 1
