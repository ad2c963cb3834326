"""The other process of a check: one for many questions; one that ends is told, and another begins."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from inertance import FMUError
from inertance.fmu.check.other_process import OtherProcess

MODULE = """
import os


def answer(what):
    print("what binaries print disturbs nothing")
    if what == "raise":
        raise ValueError("seven")
    if what == "end":
        os.write(2, b"ended, as binaries do\\n")
        os._exit(3)
    return str(os.getpid())
"""


def test_it_answers_and_begins_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "asked.py").write_text(MODULE)
    monkeypatch.syspath_prepend(str(tmp_path))
    with OtherProcess() as other:
        first, again = (other.ask("asked", "number") for _ in range(2))
        assert first == again
        with pytest.raises(FMUError, match="the other process failed: ValueError: seven"):
            other.ask("asked", "raise")
        anew = other.ask("asked", "number")
        with pytest.raises(FMUError, match="the other process failed: ended, as binaries do"):
            other.ask("asked", "end")
        last = other.ask("asked", "number")
    assert len({first, anew, last, str(os.getpid())}) == 4
    for number in (first, anew, last):
        with pytest.raises(ProcessLookupError):
            os.kill(int(number), 0)
