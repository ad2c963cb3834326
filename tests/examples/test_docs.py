"""The README and docs/ tell the truth: blocks run and print what they say, links lead somewhere."""

from __future__ import annotations

import doctest
import re
import shlex
from collections.abc import Iterator
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any
from unittest.mock import patch

import inertance
import pytest
from inertance.cli import app
from inertance.diagnosis.effects.effect import EFFECTS
from matplotlib import pyplot
from typer.testing import CliRunner

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"^<!-- (\S+\.\w+) -->\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^inertance .*$", re.MULTILINE)
LONG = {"inertance demo --out pictures"}  # runs, with shorter tests, in tests/unit/cli/test_demo.py
CLI = (ROOT / "docs" / "cli.md").read_text(encoding="utf-8")
LINK = re.compile(r"\[[^\]]*\]\((?!https?://)([^)#\s]+)")


def blocks(page: Path) -> Iterator[tuple[str, str | None]]:
    """Yield each Python block, its line numbers kept, and the text block right below it, if any."""
    text = page.read_text(encoding="utf-8")
    fences = list(FENCE.finditer(text))
    for fence, below in zip(fences, [*fences[1:], None], strict=False):
        if fence[1] != "python":
            continue
        told = below is not None and below[1] == "text" and not text[fence.end() : below.start()].strip()
        padding = "\n" * text.count("\n", 0, fence.start(2))
        yield padding + fence[2], below[2] if told and below else None


def public(kind: type) -> dict[str, Any]:
    """Return the public objects of a kind by the name a user writes: `Mass`, `rotational.Spring`."""
    found: dict[str, Any] = {}
    for name in dir(inertance):
        value = getattr(inertance, name)
        if isinstance(value, ModuleType):
            found |= {
                f"{name}.{inner}": getattr(value, inner) for inner in getattr(value, "__all__", dir(value))
            }
        else:
            found[name] = value
    return {
        name: item
        for name, item in found.items()
        if isinstance(item, kind) and "_" not in (name[0], name.partition(".")[2][:1])
    }


def examples() -> list[doctest.DocTest]:
    finder = doctest.DocTestFinder()
    objects = {**public(type), **public(FunctionType)}
    tests = [test for name, item in objects.items() for test in finder.find(item, name, globs={})]
    return [test for test in tests if test.examples]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_blocks_run_and_print_what_stands_below(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    pyplot.switch_backend("Agg")
    namespace: dict[str, Any] = {"__name__": page.stem}
    with patch.dict(EFFECTS):  # what a page registers, other tests must not try
        for source, told in blocks(page):
            printed = StringIO()
            with redirect_stdout(printed):
                exec(compile(source, str(page), "exec"), namespace)
            if told is not None:
                assert printed.getvalue() == told
    pyplot.close("all")


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.name)
def test_examples_of_docstrings(example: doctest.DocTest) -> None:
    report = StringIO()
    failed, _ = doctest.DocTestRunner().run(example, out=report.write)
    assert not failed, report.getvalue()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_to_files(page: Path) -> None:
    links = LINK.findall(page.read_text(encoding="utf-8"))
    assert [link for link in links if not (page.parent / link).exists()] == []


def test_every_component_is_listed() -> None:
    page = (ROOT / "docs" / "components.md").read_text(encoding="utf-8")
    components = {name for name, item in public(type).items() if issubclass(item, inertance.Component)}
    assert {name for name in components if f"`{name}`" not in page} == set()


@pytest.mark.parametrize("command", [c for c in COMMAND.findall(CLI) if c not in LONG])
def test_commands_run(command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, content in FILE.findall(CLI):
        (tmp_path / name).write_text(content, encoding="utf-8")
    done = CliRunner().invoke(app, shlex.split(command)[1:])
    assert done.exit_code == 0, (done.output, done.exception)
