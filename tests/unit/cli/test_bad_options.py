"""Every option and argument of every command is given what it cannot use; none may end with a traceback."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from inertance.cli import app, site
from typer.main import get_command
from typer.testing import CliRunner

BAD = ("x", "", "nan", "inf", "-1", "0", "1e-12", "nowhere/x.csv", "a=b=c", "größe")
GOOD = {
    "components": ["Spring"],
    "run": ["model.py:free", "--stop", "0.1"],
    "fit": ["none.toml"],
    "diagnose": ["none.toml"],
    "design": ["none.toml", "--out", "next.csv"],
    "docs": ["cli"],
    "modelica": ["model.py:free"],
    "new rig": ["rig"],
    "new campaign": ["campaign"],
    "new component": ["component"],
    "fmu export": ["model.py:free", "none.txt"],
    "fmu check": ["none.fmu"],
    "fmu info": ["none.fmu"],
    "fmu import-test": ["none.fmu"],
}
LONG = {"demo"}
MODEL = """
from inertance import Fixed, Mass, Network, Spring


def free():
    net = Network("free", wall=Fixed(), spring=Spring(k=10.0), mass=Mass(m=1.0, s=0.1))
    return net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
"""


def commands(group: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    for name, command in group.commands.items():
        full = f"{path} {name}".strip()
        if hasattr(command, "commands"):
            yield from commands(command, full)
        elif full not in LONG:
            yield full, command


CASES = [
    (name, parameter.opts[-1] if parameter.param_type_name == "option" else place)
    for name, command in commands(get_command(app))
    for place, parameter in enumerate(command.params)
    if parameter.param_type_name == "argument" or not parameter.is_flag
]


@pytest.mark.parametrize(("command", "what"), CASES)
def test_a_bad_option_is_told(
    command: str, what: str | int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(site, "find_spec", lambda _: None)  # or a site would be built for each name
    (tmp_path / "model.py").write_text(MODEL)
    for bad in BAD:
        arguments = list(GOOD[command])
        if isinstance(what, int):
            arguments[what] = bad
        else:
            arguments += [what, bad]
        done = CliRunner().invoke(app, [*command.split(), *arguments])
        assert done.exception is None or isinstance(done.exception, SystemExit), (arguments, done.exception)
        assert done.exit_code in (0, 1, 2)
        assert "Traceback" not in done.output
        if done.exit_code == 0:
            assert str(math.nan) not in done.output.split(), arguments
        else:
            assert done.stderr.strip(), arguments
