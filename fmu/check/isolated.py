"""Checks of foreign binaries in a process of their own: a section that crashes is a finding."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from threading import Event, Timer

from ..errors import FMUError
from ..foreign.subprocess_instance import environment
from .probe import CheckedFMU
from .report import Finding
from .sections import SECTIONS, Plan


def isolated_findings(path: Path, plan: Plan, timeout: float) -> Iterator[Finding]:
    """Yield the findings of all sections; one that kills its process or takes too long fails as a whole."""
    for name in SECTIONS:
        yield from _section(name, json.dumps([str(path.resolve()), asdict(plan), name]), timeout)


def _section(name: str, told: str, timeout: float) -> Iterator[Finding]:
    command = [sys.executable, "-c", f"from {__name__} import serve; serve()", told]
    expired = Event()

    def end() -> None:
        expired.set()
        process.kill()

    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        env=environment(), text=True, encoding="utf-8",
    ) as process:  # fmt: skip
        timer = Timer(timeout, end)
        timer.start()
        try:
            assert process.stdout is not None
            yield from (Finding(**json.loads(line)) for line in process.stdout)
            process.wait()
        finally:
            timer.cancel()
            process.kill()
    if expired.is_set():
        yield Finding("FMU", name, False, told=f"did not end within {timeout:g} s and was stopped")
    elif process.returncode:
        yield Finding("FMU", name, False, told=_fate(process.returncode))


def _fate(code: int) -> str:
    if code < 0:
        return f"its binary crashed: the process was killed by {signal.Signals(-code).name}"
    return f"its binary ended the process with exit code {code}"


def serve() -> None:
    """Look at one section and print each finding as a line of JSON."""
    path, plan, name = json.loads(sys.argv[-1])
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8", buffering=1)
    os.dup2(2, 1)
    try:
        with CheckedFMU(Path(path)) as fmu:
            for finding in SECTIONS[name](fmu, Plan(**plan)):
                answers.write(json.dumps(asdict(finding)) + "\n")
    except Exception as error:
        told = str(error) if isinstance(error, FMUError) else f"{type(error).__name__}: {error}"
        answers.write(json.dumps(asdict(Finding("FMU", name, False, told=told))) + "\n")
