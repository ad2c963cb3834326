"""A recipe stands alone, and is short; that it runs, and prints what it says, `test_docs.py` tells."""

import builtins
import dis
import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "recipes.md"
RECIPES = re.findall(
    r"^## (.+?)$.*?^```python\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL
)
MOST_LINES = 25


def test_the_tasks_of_a_newcomer_are_there() -> None:
    told = " ".join(title for title, _ in RECIPES)
    for task in ("quarter car", "tuned inerter damper", "Campbell", "CSV", "FMU", "element", "resumed"):
        assert task in told


@pytest.mark.parametrize(("title", "lines"), RECIPES, ids=lambda text: text.partition("\n")[0][:30])
def test_a_recipe_is_short_and_needs_no_other(title: str, lines: str) -> None:
    assert len([line for line in lines.splitlines() if line.strip()]) <= MOST_LINES
    steps = list(dis.get_instructions(compile(lines, title, "exec")))
    made = {step.argval for step in steps if step.opname == "STORE_NAME"}
    used = {step.argval for step in steps if step.opname == "LOAD_NAME"}
    assert used <= made | vars(builtins).keys()
