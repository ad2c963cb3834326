"""C is compiled once for all processes, beside what goes on."""

import ctypes
import math
import os
from pathlib import Path
from time import sleep
from typing import Any

import inertance as ia
import pytest
from inertance.base.kept_files import KeptFiles
from inertance.networks.csource import library_cache
from inertance.networks.csource.library_cache import CLibrary
from inertance.networks.csource.size_class import most_of_class
from inertance.networks.csource.toolchain import Compilation, ToolchainError

SHOWN = "#pragma GCC visibility push(default)\n"
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
    first, again = (CLibrary(TEXTS, ()).load(size) for _ in range(2))
    assert first == again > 0
    assert len(compiled) == 1
    assert [path.suffix for path in folder.iterdir()] == [".so"]
    assert not folder.stat().st_mode & 0o077


def test_whatever_differs_is_compiled_anew(compiled: list[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    CLibrary(TEXTS, ()).load(size)
    CLibrary(TEXTS | {"unit.h": "#define ANSWER 43\n"}, ()).load(size)
    CLibrary(TEXTS, ("-DOTHER",)).load(size)
    monkeypatch.setenv("CFLAGS", "-O1 -DOTHER")
    CLibrary(TEXTS, ()).load(size)
    monkeypatch.setattr("platform.node", lambda: "elsewhere")  # where CFLAGS may mean another processor
    CLibrary(TEXTS, ()).load(size)
    assert len(compiled) == 5


def test_a_damaged_library_is_replaced(folder: Path, compiled: list[Path]) -> None:
    CLibrary(TEXTS, ()).load(size)
    (kept,) = folder.iterdir()
    kept.write_bytes(kept.read_bytes()[:-1])
    assert CLibrary(TEXTS, ()).load(size) == size(kept) > 0
    assert len(compiled) == 2


def test_a_library_that_does_not_load_is_compiled_anew(compiled: list[Path]) -> None:
    def load(path: Path) -> int:
        if len(compiled) == 1:
            raise OSError(f"{path}: for another machine")
        return size(path)

    CLibrary(TEXTS, ()).load(size)
    assert CLibrary(TEXTS, ()).load(load) > 0
    assert len(compiled) == 2


def test_it_is_compiled_beside_what_goes_on(folder: Path, compiled: list[Path]) -> None:
    library = CLibrary(TEXTS, ())
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
    library = CLibrary(TEXTS, ())
    library.begin()
    while not library.is_ready():
        sleep(0.01)
    del library  # as at the end of the process
    assert len(list(folder.iterdir())) == 1
    assert not compiled[0].parent.exists()
    unfinished = CLibrary(TEXTS, ("-DOTHER",))
    unfinished.begin()
    del unfinished
    assert len(list(folder.iterdir())) == 1
    assert not compiled[1].parent.exists()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes that fork")
def test_a_forked_process_does_not_wait_for_what_another_one_compiles(compiled: list[Path]) -> None:
    library = CLibrary(TEXTS, ())
    library.begin()
    child = os.fork()
    if child == 0:
        os._exit(0 if library.load(size) > 0 else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert library.load(size) > 0


def test_c_that_does_not_compile_is_told_and_not_kept(folder: Path) -> None:
    with pytest.raises(ToolchainError, match="could not compile"):
        CLibrary({"unit.c": "no C at all"}, ()).load(size)
    assert not list(folder.iterdir())


def test_a_network_with_other_values_is_compiled_once(compiled: list[Path]) -> None:
    def end(k: float, s: float) -> float:
        net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=k), mass=ia.Mass(m=1.0, s=s))
        net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
        return float(net.simulate(2.0, solver="compiled", rtol=1e-10)["mass.s"][-1])

    assert end(4.0, 1.0) == pytest.approx(math.cos(4.0), abs=1e-7)
    assert end(9.0, 0.5) == pytest.approx(0.5 * math.cos(6.0), abs=1e-7)
    assert [path.suffix for path in compiled] == [".o", ".so"]


def test_networks_of_a_size_class_share_their_core(compiled: list[Path]) -> None:
    for masses in (1, 2, 3):
        net = ia.Network("chain", wall=ia.Fixed())
        last = net.wall.flange
        for i in range(masses):
            net.add(**{f"k{i}": ia.Spring(k=1.0), f"m{i}": ia.Mass(m=1.0, s=1.0)})
            net.connect(last, getattr(net, f"k{i}").flange_a)
            last = getattr(net, f"m{i}").flange
            net.connect(getattr(net, f"k{i}").flange_b, last)
        run = net.simulate(1.0, solver="compiled", rtol=1e-9)
        assert run["kinetic"][-1] + run["potential"][-1] == pytest.approx(run["potential"][0], rel=1e-7)
    assert sorted(path.suffix for path in compiled) == [".o", ".so", ".so", ".so"]


@pytest.mark.parametrize(("states", "room"), [(0, 8), (8, 8), (9, 16), (64, 64)])
def test_a_size_class_has_room_for_all(states: int, room: int) -> None:
    most = most_of_class({"MODEL_SPARSE": 0, "NX": states, "NP": 5})
    assert most == {"NX": room, "NP": 4 * room}


def test_what_is_too_large_for_all_classes_has_a_core_of_its_own() -> None:
    assert most_of_class({"MODEL_SPARSE": 0, "NX": 65}) is None
    assert most_of_class({"MODEL_SPARSE": 1, "NX": 1}) is None


def test_parts_are_compiled_before_what_they_are_linked_to(folder: Path, compiled: list[Path]) -> None:
    texts = {"whole.c": "int answer(void);\n" + SHOWN + "int doubled(void) { return 2 * answer(); }\n"}
    for flag in ("-DA", "-DB"):
        part = CLibrary(TEXTS, (), "part", suffix=".o")
        whole = CLibrary(texts, (flag,), parts=[part])
        whole.begin()
        while not whole.is_ready():
            sleep(0.01)
        assert whole.load(lambda path: ctypes.CDLL(str(path)).doubled()) == 84
    assert [path.suffix for path in compiled] == [".o", ".so", ".so"]


def test_parts_that_cannot_be_kept_are_linked_all_the_same(
    compiled: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(KeptFiles, "keep", lambda *_: None)
    texts = {"whole.c": "int answer(void);\n" + SHOWN + "int doubled(void) { return 2 * answer(); }\n"}
    whole = CLibrary(texts, (), parts=[CLibrary(TEXTS, (), suffix=".o")])
    assert whole.load(lambda path: ctypes.CDLL(str(path)).doubled()) == 84
    del whole
    assert not any(path.parent.exists() for path in compiled)
