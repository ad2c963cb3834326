"""`inertance cache` shows what is kept, and removes it."""

from pathlib import Path

import pytest
from inertance.base.kept_files import kept_files
from inertance.cli.app import app
from typer.testing import CliRunner


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    return tmp_path / "inertance"


def told(*options: str) -> str:
    done = CliRunner().invoke(app, ["cache", *options])
    assert done.exit_code == 0
    return done.stdout


def test_it_tells_where_how_many_and_how_large(folder: Path, tmp_path: Path) -> None:
    assert told() == f"0 compiled files, 0.0 MB of at most 128 MB, in {folder}\n"
    made = tmp_path / "made.so"
    made.write_bytes(bytes(3 * 2**20 // 2))
    kept_files().keep(made, "a")
    assert told() == f"1 compiled file, 1.5 MB of at most 128 MB, in {folder}\n"
    kept_files().keep(made, "b")
    assert told("--clear") == f"removed 2 compiled files, 3.0 MB from {folder}\n"
    assert not list(folder.iterdir())


def test_where_nothing_is_kept_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("inertance.base.kept_files._candidates", lambda: iter(()))
    assert told().startswith("nothing is kept")
