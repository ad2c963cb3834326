"""Isolated instances: a foreign binary in a process of its own, asked through a pipe.

Questions and answers are lines of JSON, so nothing that the other process writes can run here.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import wraps
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import IO, Any, Concatenate, ParamSpec, Self, TypeVar, cast

from ..errors import FMUError
from .in_process import LocalInstance
from .instance import Stepped, Update, Values
from .unpacked import Unpacked

STARTUP_TIMEOUT, EXIT_TIMEOUT = 60.0, 1.0
QUOTED_CHARACTERS = 2000
P = ParamSpec("P")
R = TypeVar("R")


def environment() -> dict[str, str]:
    """Return what another Python needs to find the same modules."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(p or os.getcwd() for p in sys.path)}


def _asked(
    method: Callable[Concatenate[LocalInstance, P], R], read: Callable[..., R] | None = None
) -> Callable[Concatenate[IsolatedInstance, P], R]:
    """Return a method that asks the other process for what a method of its instance does."""

    @wraps(method)
    def ask(self: IsolatedInstance, /, *arguments: P.args, **_: P.kwargs) -> R:
        answer = self._ask(method.__name__, *arguments)
        return cast(R, answer) if read is None else read(*answer)

    return ask


class IsolatedInstance:
    """An instance in another process; see `LocalInstance`.

    Raises:
        FMUError: from any call, if the process dies or does not answer in time; it is then gone.
    """

    def __init__(self, path: Path, name: str, kind: str, timeout: float) -> None:
        self.name, self.timeout = name, timeout
        self._folder = TemporaryDirectory(prefix="inertance-fmu-", ignore_cleanup_errors=True)
        self._errors = (Path(self._folder.name) / "errors.txt").open("w+", encoding="utf-8", errors="replace")
        self._process = subprocess.Popen(
            [sys.executable, "-c", f"from {__name__} import serve; serve()"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors,
            env=environment(), text=True, encoding="utf-8",
        )  # fmt: skip
        self._answers: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._reader = threading.Thread(target=self._listen, daemon=True)
        self._reader.start()
        try:
            self._ask("unpack", str(path.resolve()), self._folder.name, within=max(timeout, STARTUP_TIMEOUT))
            self.event_mode, self.interpolates = self._ask("instantiate", kind)
        except FMUError:
            self._end()
            raise

    def _listen(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self._answers.put(line)
        self._answers.put("")

    def _ask(self, method: str, *arguments: Any, within: float | None = None) -> Any:
        question = json.dumps([method, arguments], default=lambda number: number.item())  # of NumPy
        longest = self.timeout if within is None else within
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(question + "\n")
            self._process.stdin.flush()
            line = self._answers.get(timeout=longest)
        except queue.Empty:
            self._end()
            raise FMUError(
                f"FMU '{self.name}' did not return from '{method}' within {longest:g} s and was ended; "
                "give a longer timeout= if it needs it"
            ) from None
        except OSError:
            line = ""
        except KeyboardInterrupt:
            self._end()
            raise
        if not line:
            raise FMUError(f"FMU '{self.name}' crashed in '{method}': its process {self._fate()}")
        try:
            good, answer = json.loads(line)
        except ValueError:
            self._end()
            raise FMUError(f"FMU '{self.name}' disturbed the pipe in '{method}' and was ended") from None
        if not good:
            raise FMUError(answer)
        return answer

    def _fate(self) -> str:
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(EXIT_TIMEOUT)
        code = self._process.poll()
        self._errors.seek(0)
        said = self._errors.read()[-QUOTED_CHARACTERS:].strip().splitlines()[-1:]
        self._end()
        if code is not None and code < 0:
            fate = f"was killed by {signal.Signals(-code).name}"
        else:
            fate = f"ended itself with exit code {code}"
        return "; it says: ".join([fate, *said])

    def _end(self) -> None:
        self._process.kill()
        self._process.wait()
        self._reader.join(EXIT_TIMEOUT)
        for pipe in (self._process.stdin, self._process.stdout, self._errors):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()
        self._folder.cleanup()

    start, started = _asked(LocalInstance.start), _asked(LocalInstance.started)
    set, get = _asked(LocalInstance.set), _asked(LocalInstance.get)
    states, nominals = _asked(LocalInstance.states), _asked(LocalInstance.nominals)
    derivatives, indicators = _asked(LocalInstance.derivatives), _asked(LocalInstance.indicators)
    look = _asked(LocalInstance.look)
    completed_step, enter_events = _asked(LocalInstance.completed_step), _asked(LocalInstance.enter_events)
    update = _asked(LocalInstance.update, Update)
    step = _asked(LocalInstance.step, Stepped)
    save, restore = _asked(LocalInstance.save), _asked(LocalInstance.restore)

    def drive(self, inputs: Values) -> None:
        """Set the inputs chosen at the start; nothing is asked if there are none."""
        if inputs:
            self._ask("drive", inputs)

    def close(self) -> None:
        """Free the instance, remove its files and end the process."""
        if self._process.poll() is None:
            with suppress(FMUError):
                self._ask("close")
        self._end()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def serve() -> None:
    """Answer questions of the parent process, until it closes the pipe or asks to close."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    questions = os.fdopen(os.dup(0), encoding="utf-8")
    os.dup2(os.open(os.devnull, os.O_RDWR), 0)
    os.dup2(2, 1)
    _answer(questions, answers)


def _answer(questions: IO[str], answers: IO[str]) -> None:
    files: Unpacked | None = None
    instance: LocalInstance | None = None
    for line in questions:
        method, arguments = json.loads(line)
        try:
            answer: Any = None
            if files is None:
                files = Unpacked(Path(arguments[0]), Path(arguments[1]))
            elif instance is None:
                instance = LocalInstance(files.path, arguments[0], files=files)
                answer = [instance.event_mode, instance.interpolates]
            else:
                answer = getattr(instance, method)(*arguments)
            told = json.dumps([True, answer])
        except Exception as error:
            told = json.dumps([False, str(error)])
        answers.write(told + "\n")
        answers.flush()
        if method == "close":
            return
    if instance is not None:
        instance.close()
