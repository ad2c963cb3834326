"""Every threshold says its unit and what fixed it, and stands in one place."""

import re
from pathlib import Path

import pytest
from inertance.diagnosis import criteria

TEXT = Path(criteria.__file__).read_text(encoding="utf-8")
LINES = [line for line in TEXT.splitlines() if re.match(r"[A-Z_]+ =", line)]
FIXED_BY = re.findall(r"^\| (\w+) \| (?!meaning)", TEXT, re.M)


@pytest.mark.parametrize("line", LINES, ids=[line.split(" =")[0] for line in LINES])
def test_a_threshold_says_its_unit_and_what_fixed_it(line: str) -> None:
    assert re.search(rf"# \[[^]]+\].*; ({'|'.join(FIXED_BY)})\b", line)


def test_every_threshold_is_used() -> None:
    room = Path(criteria.__file__).parent
    used = "".join(
        path.read_text(encoding="utf-8") for path in room.rglob("*.py") if path.name != "criteria.py"
    )
    assert not [name for name in (line.split(" =")[0] for line in LINES) if name not in used]
