"""C is compiled once for all processes, beside what goes on."""

import math
import os
from pathlib import Path
from time import sleep
from typing import Any

import inertance as ia
import pytest
from inertance.networks.csource import library_cache
from inertance.networks.csource.library_cache import Library
from inertance.networks.csource.toolchain import Compilation, ToolchainError

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
    made = list[Path]()

    class Counted(Compilation):
        def __init__(self, sources: Any, out: Path, **more: Any) -> None:
            made.append(out)
            super().__init__(sources, out, **more)

    monkeypatch.setattr(library_cache, "Compilation", Counted)
    return made


def size(path: Path) -> int:
    return path.stat().st_size


def test_the_same_c_is_compiled_once(folder: Path, compiled: list[Path]) -> None:
    first, again = (Library(TEXTS, ()).load(size) for _ in range(2))
    assert first == again > 0
    assert len(compiled) == 1
    assert [path.suffix for path in folder.iterdir()] == [".so"]
    assert not folder.stat().st_mode & 0o077


def test_whatever_differs_is_compiled_anew(compiled: list[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    Library(TEXTS, ()).load(size)
    Library(TEXTS | {"unit.h": "#define ANSWER 43\n"}, ()).load(size)
    Library(TEXTS, ("-DOTHER",)).load(size)
    monkeypatch.setenv("CFLAGS", "-O1 -DOTHER")
    Library(TEXTS, ()).load(size)
    monkeypatch.setattr("platform.node", lambda: "elsewhere")  # where CFLAGS may mean another processor
    Library(TEXTS, ()).load(size)
    assert len(compiled) == 5


def test_a_damaged_library_is_replaced(folder: Path, compiled: list[Path]) -> None:
    Library(TEXTS, ()).load(size)
    (kept,) = folder.iterdir()
    kept.write_bytes(kept.read_bytes()[:-1])
    assert Library(TEXTS, ()).load(size) == size(kept) > 0
    assert len(compiled) == 2


def test_a_library_that_does_not_load_is_compiled_anew(compiled: list[Path]) -> None:
    def load(path: Path) -> int:
        if len(compiled) == 1:
            raise OSError(f"{path}: for another machine")
        return size(path)

    Library(TEXTS, ()).load(size)
    assert Library(TEXTS, ()).load(load) > 0
    assert len(compiled) == 2


def test_it_is_compiled_beside_what_goes_on(folder: Path, compiled: list[Path]) -> None:
    library = Library(TEXTS, ())
    assert not library.is_ready()
    library.begin()
    library.begin()
    while not library.is_ready():
        sleep(0.01)
    assert not folder.exists() or not list(folder.iterdir())  # until it is wanted
    assert library.load(size) > 0
    assert library.is_ready()
    assert len(compiled) == len(list(folder.iterdir())) == 1


def test_what_is_compiled_but_never_wanted_is_kept_and_leaves_nothing_else(
    folder: Path, compiled: list[Path]
) -> None:
    library = Library(TEXTS, ())
    library.begin()
    while not library.is_ready():
        sleep(0.01)
    del library  # as at the end of the process
    assert len(list(folder.iterdir())) == 1
    assert not compiled[0].parent.exists()
    unfinished = Library(TEXTS, ("-DOTHER",))
    unfinished.begin()
    del unfinished
    assert len(list(folder.iterdir())) == 1
    assert not compiled[1].parent.exists()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes that fork")
def test_a_forked_process_does_not_wait_for_what_another_one_compiles(compiled: list[Path]) -> None:
    library = Library(TEXTS, ())
    library.begin()
    child = os.fork()
    if child == 0:
        os._exit(0 if library.load(size) > 0 else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert library.load(size) > 0


def test_c_that_does_not_compile_is_told_and_not_kept(folder: Path) -> None:
    with pytest.raises(ToolchainError, match="could not compile"):
        Library({"unit.c": "no C at all"}, ()).load(size)
    assert not list(folder.iterdir())


def test_a_network_with_other_values_is_compiled_once(compiled: list[Path]) -> None:
    def end(k: float, s: float) -> float:
        net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=k), mass=ia.Mass(m=1.0, s=s))
        net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
        return float(net.simulate(2.0, solver="compiled", rtol=1e-10)["mass.s"][-1])

    assert end(4.0, 1.0) == pytest.approx(math.cos(4.0), abs=1e-7)
    assert end(9.0, 0.5) == pytest.approx(0.5 * math.cos(6.0), abs=1e-7)
    assert len(compiled) == 1
