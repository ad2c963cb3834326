"""Probes: instances of an FMU through FMPy, asked also for what a run never asks for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ...base import Array
from ..fmu import FMU
from ..foreign.in_process import LocalInstance
from ..foreign.inputs import groups
from ..foreign.instance import Stepped, Values
from ..foreign.unpacked import Unpacked
from ..foreign.variable import ForeignVariable

NUMBERS = (
    "Real", "Float64", "Float32", "Integer", "Boolean", "Enumeration",
    *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)),
)  # fmt: skip
LEAST = 1e-8


class Probe(LocalInstance):
    """An instance that shares its files with others; FMPy's names, whatever the FMI version."""

    def __init__(self, subject: Subject, kind: str, events: bool) -> None:
        super().__init__(subject.fmu.path, kind, files=subject.files, events=events)
        self.subject = subject

    def begin(self, begin: float, stop: float, rtol: float, inputs: Mapping[str, float]) -> None:
        """Initialize with constant inputs."""
        chosen = [(self.subject.fmu.variables[name], value) for name, value in inputs.items()]
        self.start(begin, stop, rtol, [((v.type, [v.reference], 1), [value]) for v, value in chosen], [])
        self.started()
        if self.kind == "ME" or self.event_mode:
            self.update()

    def values(self, names: Iterable[str]) -> Array:
        """Return variables by name."""
        return np.array(self.get(self.subject.groups(tuple(names))))

    def advance(self, t: float, stop: float) -> Stepped:
        """Go on to `stop`, events handled on the way.

        Raises:
            FMUError: if it does not get there.
        """
        while True:
            stepped = self.step(t, stop - t, [], [])
            if stepped.event and self.event_mode:
                self.enter_events()
                self.update()
            t, arrived = stepped.landed(self.name, t, stop)
            if arrived:
                return stepped

    def kept(self) -> Any:
        """Return a saved state."""
        return self._call("getFMUState")

    def back(self, state: Any) -> None:
        """Go back to a saved state."""
        self._call("setFMUState", state)

    def forget(self, state: Any) -> None:
        """Free a saved state."""
        self._call("freeFMUState", state)

    def bytes_of(self, state: Any) -> bytes:
        """Return a saved state as bytes."""
        return bytes(self._call("serializeFMUState", state))

    def state_of(self, data: bytes) -> Any:
        """Return a saved state from bytes."""
        return self._call("deserializeFMUState", data)

    def reset(self) -> None:
        """Go back to how it was after instantiation."""
        self._call("reset")

    def put(self, t: float, x: Array) -> None:
        """Set time and continuous states."""
        self._at(t, x.tolist(), [])

    def directional(
        self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float] | Array
    ) -> Array:
        """Return how unknowns change in a direction of knowns."""
        return np.array(self._call("getDirectionalDerivative", list(unknowns), list(knowns), list(seed)))

    def adjoint(self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float] | Array) -> Array:
        """Return how a weighted sum of unknowns changes with each of the knowns (FMI 3)."""
        arguments = (list(unknowns), list(knowns), list(seed), len(knowns))
        return np.array(self._call("getAdjointDerivative", *arguments))


class Subject:
    """An FMU that is looked at: unpacked once, for any number of instances."""

    def __init__(self, path: Path) -> None:
        self.fmu = FMU(path, validate=False)
        self.fmu.check_platform()
        self.files = Unpacked(path)
        self._groups: dict[tuple[str, ...], Any] = {}

    @contextmanager
    def probe(self, kind: str, events: bool = False) -> Iterator[Probe]:
        """Give an instance; in Co-Simulation with event mode if `events` and if it has it."""
        made = Probe(self, kind, events)
        try:
            yield made
        finally:
            made.close()

    def label(self, kind: str) -> str:
        """Return the name of a kind in reports."""
        return f"FMI {self.fmu.version} {kind}"

    def groups(self, names: tuple[str, ...]) -> Any:
        """Return names as groups to get."""
        if names not in self._groups:
            self._groups[names] = groups(self.fmu.variables[name] for name in names)
        return self._groups[names]

    def nominals(self, names: Iterable[str]) -> Array:
        """Return the nominal sizes of variables that declare one, else next to nothing."""
        declared = {v.name: v.nominal for v in self.fmu.description.modelVariables}
        return np.array([abs(float(declared[name] or 0.0)) or LEAST for name in names])

    def shown(self) -> list[str]:
        """Return outputs and states that are numbers."""
        names = dict.fromkeys([*self.fmu.outputs, *self.fmu.states])
        return [name for name in names if self.plain(self.fmu.variables[name])]

    def discrete(self) -> list[str]:
        """Return what changes at events only."""
        found = self.fmu.of("output", "local").values()
        return [v.name for v in found if v.variability == "discrete" and self.plain(v)]

    def plain(self, variable: ForeignVariable) -> bool:
        """Whether a variable is one number."""
        return variable.type in NUMBERS and variable.size == 1

    def close(self) -> None:
        """Remove the unpacked files."""
        self.files.remove()

    def __enter__(self) -> Subject:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def same(one: Values | Array, other: Values | Array) -> bool:
    """Tell whether numbers are equal to the last bit."""
    return np.asarray(one, dtype=float).tobytes() == np.asarray(other, dtype=float).tobytes()
