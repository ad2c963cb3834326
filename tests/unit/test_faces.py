"""What packages show is one list: a stub that is the lazy map, `__all__` and what type checkers see."""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import inertance
import pytest

FACES = [
    "inertance",
    "inertance.networks",
    *(f"inertance.networks.{door}" for door in ("analysis", "machines", "sweeps", "synthesis")),
]


def stubbed(face: str) -> dict[str, str]:
    """Return by name the module that a stub takes it from."""
    place = Path(importlib.import_module(face).__file__ or "")
    tree = ast.parse(place.with_suffix(".pyi").read_text(encoding="utf-8"))
    return {
        alias.asname or alias.name: ".".join(filter(None, (face, node.module)))
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


@pytest.mark.parametrize("face", FACES)
def test_every_name_of_a_face_is_what_its_stub_says(face: str) -> None:
    shown, names = importlib.import_module(face), stubbed(face)
    assert sorted(names) == sorted(dir(shown))
    for name, module in names.items():
        assert getattr(shown, name) is getattr(importlib.import_module(module), name)


def test_a_star_import_gives_all() -> None:
    scope: dict[str, object] = {}
    exec("from inertance import *", scope)
    assert set(stubbed("inertance")) <= set(scope)


@pytest.mark.parametrize(
    ("wrong", "meant"),
    [
        ("Sprig", "Spring"),
        ("qarter_car", "machines.quarter_car"),
        ("Campaign", "identification.Campaign"),
        ("diagnos", "diagnose"),
    ],
)
def test_a_wrong_name_gets_the_nearest(wrong: str, meant: str) -> None:
    with pytest.raises(AttributeError, match=f"no '{wrong}'; did you mean '{meant}'?"):
        getattr(inertance, wrong)
    with pytest.raises(ImportError, match=wrong):
        exec(f"from inertance import {wrong}")


def test_the_face_alone_imports_next_to_nothing() -> None:
    code = "import inertance, sys; print(sum(m.startswith('inertance') for m in sys.modules))"
    told = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert int(told) < 20
