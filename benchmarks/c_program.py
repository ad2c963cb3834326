"""The C program, compiled on the fly."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from measure import Cost
from numpy.typing import NDArray

SOURCE = Path(__file__).parent / "peers" / "pfi.c"
LIBRARIES = ("cvode", "nvecserial")
PRINTED = re.compile(r"wall (\S+) s, cpu (\S+) s, steps (\d+)")


class MissingError(Exception):
    """Something that the C program needs is not there."""


class CProgram:
    """peers/pfi.c, `smooth` or `hybrid`.

    Raises:
        MissingError: without a C compiler or SUNDIALS.
    """

    def __init__(self, model: str) -> None:
        compiler = shutil.which("cc")
        if compiler is None:
            raise MissingError("no C compiler `cc`")
        self.model, self.directory = model, Path(mkdtemp(prefix="inertance-"))
        self.program = self.directory / "pfi"
        libraries = [f"-lsundials_{name}" for name in LIBRARIES]
        command = [compiler, "-O2", str(SOURCE), "-o", str(self.program), *libraries, "-lm"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise MissingError(
                f"not compiled, needs SUNDIALS 6 (libsundials-dev): {done.stderr.splitlines()[0]}"
            )

    def go(self) -> Cost:
        """Return the median cost of a few runs in one process."""
        return Cost(*(float(number) for number in self._print("-r", "5")[:2]))

    def steps(self) -> int:
        """Return the number of steps of a run."""
        return int(self._print("-r", "1")[2])

    def force(self, *options: str) -> NDArray[np.float64]:
        """Return the force at 1001 instants."""
        path = self.directory / "force.csv"
        self._print("-r", "1", "-o", str(path), *options)
        force: NDArray[np.float64] = np.loadtxt(path, delimiter=",", skiprows=1)[:, 1]
        return force

    def _print(self, *options: str) -> tuple[str, ...]:
        command = [str(self.program), self.model, *options]
        printed = PRINTED.match(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        assert printed
        return printed.groups()
