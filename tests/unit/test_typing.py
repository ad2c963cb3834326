"""What type checkers and editors know of elements and runs: stubs, signatures, wrong and right calls."""

import inspect
import json
import os
import re
import runpy
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import inertance as ia
import pytest
from inertance import rotational, signals

ROOT = Path(__file__).parents[2]
RIGHT, WRONG = (ROOT / "tests" / "typing" / name for name in ("right.py", "wrong.py"))
HOME = Path(ia.__file__).parents[1]  # where the package stands that is tested


def refused(checker: str, *options: str, folder: Path) -> dict[str, set[int]]:
    """Return by file the lines that a type checker refuses."""
    if not find_spec(checker):
        pytest.skip(f"{checker} is not installed; it comes with inertance[dev]")
    told = subprocess.run(
        [sys.executable, "-m", checker, *options], capture_output=True, text=True, cwd=folder,
        env=os.environ | {"MYPYPATH": str(HOME)},
    )  # fmt: skip
    print(told.stdout, told.stderr)
    assert told.returncode == 1, "nothing was refused, or the checker failed"
    found: dict[str, set[int]] = {}
    for file, line in re.findall(r"(\w+\.py):(\d+):(?:\d+ -)? error", told.stdout):
        found.setdefault(file, set()).add(int(line))
    return found


def meant() -> dict[str, set[int]]:
    """Return the lines that are wrong: each says why."""
    lines = enumerate(WRONG.read_text(encoding="utf-8").splitlines(), 1)
    return {WRONG.name: {number for number, line in lines if ")  # " in line}}


def test_mypy_refuses_wrong_calls_line_by_line_and_accepts_right_ones(
    tmp_path: Path, cache: pytest.Cache
) -> None:
    options = [f"--cache-dir={cache.mkdir('mypy')}", "--config-file=", "--strict", "--follow-imports=silent"]
    assert refused("mypy", *options, str(RIGHT), str(WRONG), folder=tmp_path) == meant()


def test_pyright_refuses_wrong_calls_line_by_line_and_accepts_right_ones(tmp_path: Path) -> None:
    for calls in (RIGHT, WRONG):
        shutil.copy(calls, tmp_path)
    (tmp_path / "pyrightconfig.json").write_text(json.dumps({"extraPaths": [str(HOME)]}), encoding="utf-8")
    assert refused("pyright", folder=tmp_path) == meant()


def test_right_calls_run() -> None:
    run = runpy.run_path(str(RIGHT))["run"]
    assert run.time[-1] == 1.0
    assert run.stats["solver"] == "idas"


def test_stubs_are_what_the_classes_say() -> None:
    told = subprocess.run(
        [sys.executable, str(ROOT / "docs" / "make_stubs.py"), "--check"], capture_output=True, text=True
    )
    assert told.returncode == 0, f"python docs/make_stubs.py makes them anew; {told.stdout}{told.stderr}"


def shown(kind: Any) -> dict[str, inspect.Parameter]:
    """Return the arguments that a class of components shows."""
    return dict(inspect.signature(kind).parameters)


def test_a_signature_shows_values_with_units_ranges_and_defaults() -> None:
    mass = shown(ia.Mass)
    assert list(mass) == ["m", "s", "v", "a"]
    assert mass["m"].default is inspect.Parameter.empty
    assert repr(mass["s"].default) == "<free>"
    assert mass["m"].annotation.__metadata__ == ("mass [kg], above 0",)
    assert shown(ia.Spring)["s_rel0"].default == 0.0
    assert repr(shown(ia.MassWithStopAndFriction)["f_s"].default) == "<computed>"
    assert repr(shown(ia.MassWithStopAndFriction)["lower"].default) == "<HardStop>"
    assert shown(rotational.CoulombFriction)["regularised"].default is None
    assert shown(signals.Delay)["n"].default == 5
    assert {argument.kind for argument in mass.values()} == {inspect.Parameter.KEYWORD_ONLY}


def test_a_class_of_ones_own_has_a_signature_too() -> None:
    class Own(ia.Spring):
        wear = ia.parameter("1/s", "loss of stiffness", min=0, default=0.0)

    class Made(ia.Component):
        def __init__(self, width: float, **values: Any) -> None:
            super().__init__(**values)

    assert list(shown(Own)) == ["k", "s_rel0", "wear", "s_rel", "f"]
    assert list(shown(Made)) == ["width", "values"]
    assert list(shown(ia.Network)) == ["name", "components"]
    assert list(shown(ia.Component)) == ["values"]


def test_a_network_runs_by_the_arguments_of_simulate() -> None:
    own = inspect.signature(ia.Network.simulate).parameters
    others = inspect.signature(ia.simulate).parameters
    assert list(own)[1:] == list(others)[1:]
    assert all(own[name].default == others[name].default for name in list(own)[1:])


def test_what_an_editor_shows_is_what_the_stub_says() -> None:
    page = (ROOT / "docs" / "write-your-own-component.md").read_text(encoding="utf-8")
    hover = page.partition("class Spring(")[2].partition("```")[0]
    stub = (ROOT / "components" / "translational" / "__init__.pyi").read_text(encoding="utf-8")
    spring = " ".join(stub.partition("class Spring(")[2].partition("-> None")[0].split())
    told = " ".join(hover.partition(")\n\n")[2].split())
    assert "stiffness [N/m], at least 0." in told
    assert told in spring
