"""States and instances: saved and restored, here and in another process; many at once; in two threads."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import asdict
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ...base import Array
from ..errors import FMUError
from .other_process import OtherProcess
from .probe import CheckedFMU, Probe, same
from .report import Finding
from .runs import Scenario

INSTANCES, REPEATED, STEPS = 100, 20, 8
HALF = STEPS // 2


class Walk:
    """A few steps of an instance, and what it shows along them, to be equal to the last bit."""

    def __init__(self, fmu: CheckedFMU, kind: str, scenario: Scenario) -> None:
        self.fmu, self.kind, self.scenario = fmu, kind, scenario
        self.names = fmu.shown()
        self.step = min(scenario.step, (scenario.stop - scenario.begin) / STEPS)

    def probe(self) -> Probe:
        return Probe(self.fmu, self.kind)

    def begin(self, probe: Probe) -> None:
        s = self.scenario
        probe.begin(s.begin, s.stop, s.rtol, s.inputs)

    def steps(self, probe: Probe, first: int, last: int) -> Array:
        """Go from one step to another: by Co-Simulation, or by explicit Euler steps of Model Exchange."""
        seen = []
        for k in range(first, last):
            t, stop = (self.scenario.begin + j * self.step for j in (k, k + 1))
            if self.kind == "CS":
                probe.advance(t, stop)
                seen.append(probe.values(self.names))
            else:
                x = np.array(probe.states())
                rates = np.array(probe.derivatives(t, x.tolist(), []))
                probe.move_to(stop, x + 1e-3 * (stop - t) * rates)
                probe.completed_step()
                seen.append(np.concatenate([rates, probe.watched(), probe.values(self.names)]))
        return np.array(seen)

    def whole(self, probe: Probe) -> Array:
        """Initialize and go."""
        self.begin(probe)
        return self.steps(probe, 0, STEPS)

    def halved(self, probe: Probe) -> tuple[Any, Array]:
        """Initialize, save the state half of the way, and go on from there."""
        self.begin(probe)
        self.steps(probe, 0, HALF)
        return probe.save_state(), self.steps(probe, HALF, STEPS)


def state_findings(fmu: CheckedFMU, kind: str, scenario: Scenario, other: OtherProcess) -> Iterator[Finding]:
    """Yield what is found about states and instances of one kind."""
    walk, label = Walk(fmu, kind, scenario), fmu.label(kind)
    watched = kind == "ME" and bool(fmu.states or fmu.description.numberOfEventIndicators)
    if not walk.names and not watched:
        told = "no output or state is one number: there is nothing to compare"
        yield Finding(label, "states", None, told=told)
        return
    saves = fmu.capable(kind, "canGetAndSetFMUstate")
    serialises = saves and fmu.capable(kind, "canSerializeFMUstate")
    alone = fmu.capable(kind, "canBeInstantiatedOnlyOncePerProcess")
    looks: list[tuple[str, bool, Callable[[Walk], bool]]] = [
        ("reset equals fresh", True, _reset),
        ("save and restore", saves, _restored),
        ("another process", serialises, partial(_elsewhere, other)),
        ("one after another", True, _repeated),
        (f"{INSTANCES} at once", not alone, _many),
        ("two threads", not alone, _threads),
    ]
    for check, able, look in looks:
        if not able:
            yield Finding(label, check, None, told="the FMU cannot")
            continue
        try:
            good = look(walk)
            yield Finding(label, check, good, told="" if good else "differs in bits from a run of its own")
        except FMUError as error:
            yield Finding(label, check, False, told=str(error))


def _fresh(walk: Walk) -> Array:
    with walk.probe() as probe:
        return walk.whole(probe)


def _reset(walk: Walk) -> bool:
    with walk.probe() as probe:
        first = walk.whole(probe)
        probe.reset()
        return same(walk.whole(probe), first) and same(_fresh(walk), first)


def _restored(walk: Walk) -> bool:
    with walk.probe() as probe:
        state, first = walk.halved(probe)
        probe.restore_state(state)
        again = walk.steps(probe, HALF, STEPS)
        probe.restore_state(state)
        probe.free_state(state)
        return same(again, first) and same(walk.steps(probe, HALF, STEPS), first)


def _elsewhere(other: OtherProcess, walk: Walk) -> bool:
    with walk.probe() as probe, TemporaryDirectory(prefix="inertance-") as folder:
        state, first = walk.halved(probe)
        data = Path(folder) / "state"
        data.write_bytes(probe.serialized(state))
        probe.free_state(state)
        told = other.ask(__name__, str(walk.fmu.path), walk.kind, asdict(walk.scenario), str(data))
        return told == first.tobytes().hex()


def answer(path: str, kind: str, scenario: dict[str, Any], data: str) -> str:
    """Go on from a state that another process saved; return what is seen, as bytes in hexadecimal."""
    with CheckedFMU(Path(path)) as fmu, Probe(fmu, kind) as probe:
        walk = Walk(fmu, kind, Scenario(**scenario))
        walk.begin(probe)
        state = probe.deserialized(Path(data).read_bytes())
        probe.restore_state(state)
        probe.free_state(state)
        return walk.steps(probe, HALF, STEPS).tobytes().hex()


def _repeated(walk: Walk) -> bool:
    first = _fresh(walk)
    return all(same(_fresh(walk), first) for _ in range(REPEATED))


def _many(walk: Walk) -> bool:
    first = _fresh(walk)
    with ExitStack() as stack:
        probes = [stack.enter_context(walk.probe()) for _ in range(INSTANCES)]
        for probe in probes:
            walk.begin(probe)
        rows = [[walk.steps(probe, k, k + 1)[0] for probe in probes] for k in range(STEPS)]
        return all(same(np.array(seen), first) for seen in zip(*rows, strict=True))


def _threads(walk: Walk) -> bool:
    first = _fresh(walk)
    with ThreadPoolExecutor(2) as pool:
        return all(same(found, first) for found in pool.map(lambda _: _fresh(walk), range(8)))
