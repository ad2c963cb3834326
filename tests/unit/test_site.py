"""The site: every public name is in the reference, every page is found and timed."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType
from typing import Any

import inertance
import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"


def loaded(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, DOCS / f"{name}.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def pages() -> dict[str, str]:
    found: dict[str, str] = loaded("site_reference").reference_pages()
    return found


def named() -> dict[str, Any]:
    """Return every class and function that a user finds, by its canonical name."""
    found = {}
    for name in dir(inertance):
        value = getattr(inertance, name)
        inner = [n for n in getattr(value, "__all__", dir(value)) if n[0] != "_"]
        values = [getattr(value, n) for n in inner] if isinstance(value, ModuleType) else [value]
        for one in values:
            if getattr(one, "__module__", "").startswith("inertance") and hasattr(one, "__qualname__"):
                found[one.__qualname__] = one
    return found


def test_every_public_name_is_in_the_reference_once(pages: dict[str, str]) -> None:
    told = [line for text in pages.values() for line in re.findall(r"^::: inertance\.(\S+)$", text, re.M)]
    assert len(set(told)) == len(told) > 350
    assert {name for name in named() if not any(path.endswith(f".{name}") for path in told)} == set()
    listed = set(re.findall(r"\(\w+\.md#inertance\.(\S+?)\)", pages["reference/index.md"]))
    assert listed == set(told)


def test_every_element_shows_its_picture_and_its_lines(pages: dict[str, str]) -> None:
    text = pages["reference/translational.md"]
    mass = text.partition(".translational.Mass\n")[2].partition(":::")[0]
    assert "```text\n" in mass
    assert "m*a == f" in mass.replace("self.", "").replace(" * ", "*")


def test_every_page_is_in_the_navigation() -> None:
    told = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    assert [page.name for page in DOCS.glob("*.md") if f"- {page.name}\n" not in told] == []


def test_every_page_that_runs_lines_is_timed() -> None:
    told = (DOCS / "tutorials.md").read_text(encoding="utf-8")
    running = [page for page in DOCS.glob("*.md") if "\n```python\n" in page.read_text(encoding="utf-8")]
    rows = dict(re.findall(r"^\| \[.*?\]\((\S+?\.md)\) \|.*\| (\d+) \|$", told, re.MULTILINE))
    assert {page.name for page in running} - {"cli.md"} == rows.keys()


def test_the_description_on_an_index_needs_nothing_else() -> None:
    made = loaded("make_description")
    text = made.DESCRIPTION.read_text(encoding="utf-8")
    assert text == made.description((ROOT / "README.md").read_text(encoding="utf-8")), (
        "python docs/make_description.py makes it anew"
    )
    links = re.findall(r"\]\(([^)]*)\)", text)
    assert [link for link in links if not link.startswith(("http", "#"))] == []
    assert not re.search(r"!\[|<img|<!--|pip install \.", text)
    assert "pip install inertance" in text
    made_too = made.description("# a\n\n![p](x.png)\n\n*of it*\n\n[b](c.md#d) [e](https://f)\n")
    assert made_too == f"# a\n\nb [e](https://f)\n{made.END}"
