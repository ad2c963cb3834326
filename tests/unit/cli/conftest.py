"""What tests of commands share: the commands, which are built once."""

from collections.abc import Iterator
from functools import cache

import pytest
from typer import main, testing


@pytest.fixture(autouse=True, scope="session")
def built_once() -> Iterator[None]:
    """Let calls share the commands: building them takes longer than most calls do."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(testing, "_get_command", cache(main.get_command))
        yield
