"""Probes: instances of an FMU through FMPy, asked also for what a run never asks for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Self

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
SMALLEST_NOMINAL = 1e-8


class CheckedFMU(FMU):
    """An FMU that is looked at: unpacked once, for any number of instances."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, validate=False)
        self.check_platform()
        self.files = Unpacked(path)
        self._groups: dict[tuple[str, ...], Any] = {}

    def label(self, kind: str) -> str:
        """Return the name of a kind in reports."""
        return f"FMI {self.version} {kind}"

    def groups(self, names: tuple[str, ...]) -> Any:
        """Return names as groups to get."""
        if names not in self._groups:
            self._groups[names] = groups(self.variables[name] for name in names)
        return self._groups[names]

    def nominals(self, names: Iterable[str]) -> Array:
        """Return the nominal sizes of variables that declare one, else next to nothing."""
        declared = {v.name: v.nominal for v in self.description.modelVariables}
        return np.array([abs(float(declared[name] or 0.0)) or SMALLEST_NOMINAL for name in names])

    def shown(self) -> list[str]:
        """Return outputs and states that are numbers."""
        names = dict.fromkeys([*self.outputs, *self.states])
        return [name for name in names if _is_number(self.variables[name])]

    def discrete(self) -> list[str]:
        """Return numbers that change at events only."""
        found = self.of("output", "local").values()
        return [v.name for v in found if v.variability == "discrete" and _is_number(v)]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.files.remove()


def _is_number(variable: ForeignVariable) -> bool:
    return variable.type in NUMBERS and variable.size == 1


class Probe(LocalInstance):
    """An instance that shares its files with others, with event mode if `events` and if it has it."""

    def __init__(self, fmu: CheckedFMU, kind: str, events: bool = False) -> None:
        super().__init__(fmu.path, kind, files=fmu.files, events=events)
        self.fmu = fmu

    def begin(self, begin: float, stop: float, rtol: float, inputs: Mapping[str, float]) -> None:
        """Initialize with constant inputs."""
        chosen = [(self.fmu.variables[name], value) for name, value in inputs.items()]
        self.start(begin, stop, rtol, [((v.type, [v.reference], 1), [value]) for v, value in chosen], [])
        self.started()
        if self.kind == "ME" or self.event_mode:
            self.update()

    def values(self, names: Iterable[str]) -> Array:
        """Return variables by name."""
        return np.array(self.get(self.fmu.groups(tuple(names))))

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

    def save_state(self) -> Any:
        return self._call("getFMUState")

    def restore_state(self, state: Any) -> None:
        self._call("setFMUState", state)

    def free_state(self, state: Any) -> None:
        self._call("freeFMUState", state)

    def serialized(self, state: Any) -> bytes:
        return bytes(self._call("serializeFMUState", state))

    def deserialized(self, data: bytes) -> Any:
        return self._call("deserializeFMUState", data)

    def reset(self) -> None:
        self._call("reset")

    def move_to(self, t: float, x: Array) -> None:
        """Set time and continuous states."""
        self._at(t, x.tolist(), [])

    def directional(self, unknowns: list[int], knowns: list[int], seed: Sequence[float] | Array) -> Array:
        """Return how unknowns change in a direction of knowns."""
        return np.array(self._call("getDirectionalDerivative", unknowns, knowns, list(seed)))

    def adjoint(self, unknowns: list[int], knowns: list[int], seed: Array) -> Array:
        """Return how a weighted sum of unknowns changes with each of the knowns (FMI 3)."""
        return np.array(self._call("getAdjointDerivative", unknowns, knowns, list(seed), len(knowns)))


def same(one: Values | Array, other: Values | Array) -> bool:
    """Tell whether numbers are equal to the last bit."""
    return np.asarray(one, dtype=float).tobytes() == np.asarray(other, dtype=float).tobytes()
