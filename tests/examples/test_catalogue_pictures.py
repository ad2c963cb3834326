"""What catalogue.md shows: each of its elements has an example that runs, and stands in a small picture."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from inertance.cli.catalogue import all_names

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "catalogue.md").read_text(encoding="utf-8")
PICTURES = sorted((DOCS / "images").glob("catalogue_*.svg"))
NAME = re.compile(r"(?:rotational\.|signals\.|thermal\.|machines\.)?[A-Z]\w+")
# What stands around those elements, and is told elsewhere.
AROUND = {
    "ConstantForce", "Damper", "DiskFlywheel", "ElastoGap", "Fixed", "Force", "HardStop", "Mass", "NutScrew",
    "Position", "RackPinion", "Spring", "rotational.ConstantTorque", "rotational.Fixed", "rotational.Inertia",
    "rotational.Position", "rotational.Speed", "rotational.Torque",
}  # fmt: skip


def built(*pages: str) -> set[str]:
    """Return the components that the examples of some pages build."""
    text = "\n".join((DOCS / page).read_text(encoding="utf-8") for page in pages)
    blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    calls = [node for block in blocks for node in ast.walk(ast.parse(block)) if isinstance(node, ast.Call)]
    names = {ast.unparse(call.func) for call in calls}
    return (names | {f"machines.{name}" for name in names}) & set(all_names())


def drawn(picture: Path) -> set[str]:
    """Return the components that a picture names."""
    texts = re.findall(r"<text[^>]*>([^<]*)</text>", picture.read_text(encoding="utf-8"))
    return {name for text in texts for name in NAME.findall(text)} & set(all_names())


def test_every_element_of_the_page_is_in_a_picture_and_has_an_example() -> None:
    shown = set().union(*map(drawn, PICTURES))
    assert built("catalogue.md") - shown - AROUND == set()
    assert shown - built("catalogue.md", "components.md", "machines.md", "gallery.md") == set()


@pytest.mark.parametrize("picture", PICTURES, ids=lambda path: path.stem)
def test_pictures_are_small_and_shown(picture: Path) -> None:
    assert picture.stat().st_size < 60_000
    assert f"(images/{picture.name})" in PAGE
