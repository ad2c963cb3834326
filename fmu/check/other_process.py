"""Another process, which goes on from states that were saved here: one for all FMUs of a check."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from tempfile import TemporaryFile
from threading import Timer
from typing import Any, Self

from ..errors import FMUError
from ..foreign.subprocess_instance import environment

LONGEST_SECONDS = 120.0


class OtherProcess:
    """A Python that begins when it is first asked, and anew after one that ended.

    What is asked is the function `answer` of a module, the same one every time.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._errors = TemporaryFile("w+", encoding="utf-8", errors="replace")  # noqa: SIM115

    def ask(self, module: str, *told: Any) -> str:
        """Return what a module's `answer` returns there.

        Raises:
            FMUError: if it raises an error there, takes too long, or ends the process.
        """
        process = self._process = self._process or self._begun(module)
        assert process.stdin is not None
        assert process.stdout is not None
        timer = Timer(LONGEST_SECONDS, process.kill)
        timer.start()
        try:
            process.stdin.write(json.dumps(told) + "\n")
            process.stdin.flush()
            line = process.stdout.readline()
        except OSError:
            line = ""
        finally:
            timer.cancel()
        answered: dict[str, str] = json.loads(line) if line else {"error": ""}
        if "error" in answered:
            self._end()
            self._errors.seek(0)
            said = answered["error"] or (self._errors.read().strip().splitlines() or ["?"])[-1]
            raise FMUError(f"the other process failed: {said}")
        return answered["answer"]

    def _begun(self, module: str) -> subprocess.Popen[str]:
        self._errors.seek(0)
        self._errors.truncate()
        code = f"from {__name__} import serve; from {module} import answer; serve(answer)"
        return subprocess.Popen(
            [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors,
            env=environment(), text=True, encoding="utf-8",
        )  # fmt: skip

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.communicate()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._end()
        self._errors.close()


def serve(answer: Any) -> None:
    """Answer questions, lines of JSON; what a binary prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8", buffering=1)
    os.dup2(2, 1)
    for line in sys.stdin:
        try:
            told = {"answer": answer(*json.loads(line))}
        except Exception as error:
            told = {"error": f"{type(error).__name__}: {error}"}
        answers.write(json.dumps(told) + "\n")
