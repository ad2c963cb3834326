"""`inertance new` writes what runs; `inertance docs` shows what comes with the package."""

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import inertance
import pytest
import typer
from inertance.cli import app
from typer.testing import CliRunner, Result


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def good(*arguments: str) -> str:
    result = call(*arguments)
    assert result.exit_code == 0, result.stderr
    return result.stdout


@pytest.mark.parametrize(("template", "file"), [("rig", "rig.py"), ("component", "component.py")])
def test_a_template_runs_as_a_model_and_as_a_script(template: str, file: str, folder: Path) -> None:
    told = good("new", template, "made/here")
    command = told.splitlines()[-1].removeprefix("now try: inertance ").split()
    assert command == ["run", str(Path("made/here") / file) + ":build"]
    assert " 0 to 10 s" in good(*command)
    script = [sys.executable, "-W", "error", file]
    done = subprocess.run(script, cwd=folder / "made/here", capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout


def test_the_commands_that_a_template_names_run(folder: Path) -> None:
    good("new", "rig", ".")
    text = (folder / "rig.py").read_text(encoding="utf-8")
    lines = [line.partition("  ")[0] for line in text.splitlines() if line.startswith("inertance run")]
    assert len(lines) == 2
    for line in lines:
        good(*line.replace("'", "").split()[1:])
    assert (folder / "build.png").exists()


def test_the_campaign_finds_what_its_records_were_made_with(folder: Path) -> None:
    told = good("new", "campaign", "bench")
    assert told.splitlines()[-1] == f"now try: inertance fit {Path('bench') / 'campaign.toml'}"
    good("fit", "bench/campaign.toml", "--json", "fit.json")
    fit = json.loads((folder / "fit.json").read_text(encoding="utf-8"))
    for name, made in {"spring.k": 1150.0, "damper.d": 14.0}.items():
        found, error = fit["parameters"][name]["value"], fit["parameters"][name]["error"]
        assert abs(found - made) < 4 * error < 0.02 * made
    assert fit["warnings"] == []


def test_files_that_are_there_are_left_alone(folder: Path) -> None:
    (folder / "test.csv").write_text("mine")
    refused = call("new", "campaign", ".")
    assert refused.exit_code == 2
    assert refused.stderr == "error: test.csv is there already; name another folder\n"
    assert [path.name for path in folder.iterdir()] == ["test.csv"]


def test_a_folder_that_cannot_be_made_is_told(folder: Path) -> None:
    (folder / "file").write_text("mine")
    refused = call("new", "rig", "file")
    assert (refused.exit_code, refused.stderr) == (2, "error: 'file' cannot be made: file exists\n")


def test_every_page_is_listed_and_printed_as_it_stands() -> None:
    pages = sorted((Path(inertance.__file__).parent / "docs").glob("*.md"))
    assert len(pages) > 10
    told = good("docs")
    for page in pages:
        text = page.read_text(encoding="utf-8")
        assert f"{page.stem} " in told
        assert text.splitlines()[0].removeprefix("# ") in told
        assert good("docs", page.stem) == text
    assert good("docs", "cli.md") == good("docs", "cli")


def test_an_unknown_page_gets_the_nearest() -> None:
    refused = call("docs", "idenification")
    assert refused.exit_code == 2
    assert refused.stderr == "error: there is no page 'idenification'; did you mean 'identification'?\n"


def commands(group: Any, *names: str) -> Iterator[tuple[str, ...]]:
    yield names
    for name, command in getattr(group, "commands", {}).items():
        yield from commands(command, *names, name)


@pytest.mark.parametrize("names", [*commands(typer.main.get_command(app))], ids=" ".join)
def test_help_of_every_command_points_to_a_page_that_there_is(names: tuple[str, ...]) -> None:
    told = " ".join(good(*names, "--help").split())
    assert "docs/" not in told
    pages = re.findall(r"`inertance docs ([a-z][\w-]+)`", told)
    assert pages or "inertance docs" in told
    for page in pages:
        assert good("docs", page)


def test_the_site_is_opened_at_a_page(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    (folder / "site" / "search").mkdir(parents=True)
    (folder / "site" / "search" / "search_index.js").write_text("")
    good("docs", "--site", "site")
    good("docs", "fmu", "--site", "site")
    assert opened == [(folder / "site" / f"{name}.html").as_uri() for name in ("index", "fmu")]


def test_what_stands_where_the_site_should_is_left_alone(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("inertance.cli.site.NEEDED", ())
    (folder / "mine.txt").write_text("mine")
    refused = call("docs", "--site", str(folder))
    assert refused.exit_code == 1
    assert "holds something else; name a folder for the site alone" in refused.stderr
    assert (folder / "mine.txt").read_text() == "mine"


def test_a_site_without_its_builder_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("inertance.cli.site.NEEDED", ("mkdocs_that_is_not_there",))
    refused = call("docs", "--site", "site")
    assert refused.exit_code == 1
    assert "pip install 'inertance[docs]'" in refused.stderr


def test_a_shell_can_complete() -> None:
    assert "--show-completion" in good("--help")
