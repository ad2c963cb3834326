"""States and instances: saved and restored, here and in another process; many at once; in two threads."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ...base import Array
from ..errors import FMUError
from ..foreign.subprocess_instance import environment
from .probe import Probe, Subject, same
from .report import Finding
from .runs import Experiment

MANY, REPEATED, STEPS = 100, 20, 8
ELSEWHERE = 120.0
SAID = "state: "


class Walk:
    """A few steps of an instance, and what it shows along them, to be equal to the last bit."""

    def __init__(self, subject: Subject, kind: str, experiment: Experiment) -> None:
        self.subject, self.kind, self.experiment = subject, kind, experiment
        self.names = subject.shown()
        self.step = min(experiment.step, (experiment.stop - experiment.begin) / STEPS)
        self.half = STEPS // 2

    def begin(self, probe: Probe) -> None:
        """Initialize."""
        e = self.experiment
        probe.begin(e.begin, e.stop, e.rtol, e.inputs)

    def steps(self, probe: Probe, first: int, last: int) -> Array:
        """Go from one step to another: by Co-Simulation, or by explicit Euler steps of Model Exchange."""
        seen = []
        for k in range(first, last):
            t, stop = (self.experiment.begin + j * self.step for j in (k, k + 1))
            if self.kind == "CS":
                probe.advance(t, stop)
                seen.append(probe.values(self.names))
            else:
                x = np.array(probe.states())
                rates = np.array(probe.derivatives(t, x.tolist(), []))
                probe.put(stop, x + 1e-3 * (stop - t) * rates)
                probe.completed_step()
                seen.append(np.concatenate([rates, probe.watched(), probe.values(self.names)]))
        return np.array(seen)

    def whole(self, probe: Probe) -> Array:
        """Initialize and go."""
        self.begin(probe)
        return self.steps(probe, 0, STEPS)


def state_findings(subject: Subject, kind: str, experiment: Experiment) -> Iterator[Finding]:
    """Yield what is found about states and instances of one kind."""
    walk, label = Walk(subject, kind, experiment), subject.label(kind)
    watched = kind == "ME" and bool(subject.fmu.states or subject.fmu.description.numberOfEventIndicators)
    if not walk.names and not watched:
        yield Finding(
            label, "states", None, told="no output or state is one number: there is nothing to compare"
        )
        return
    saves, serialises = (
        subject.fmu.capable(kind, name) for name in ("canGetAndSetFMUstate", "canSerializeFMUstate")
    )
    alone = subject.fmu.capable(kind, "canBeInstantiatedOnlyOncePerProcess")
    looks: list[tuple[str, bool, Callable[[Walk], bool]]] = [
        ("reset equals fresh", True, _reset),
        ("save and restore", saves, _restored),
        ("another process", saves and serialises, _elsewhere),
        ("one after another", True, _repeated),
        (f"{MANY} at once", not alone, _many),
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
    with walk.subject.probe(walk.kind) as probe:
        return walk.whole(probe)


def _reset(walk: Walk) -> bool:
    with walk.subject.probe(walk.kind) as probe:
        first = walk.whole(probe)
        probe.reset()
        return same(walk.whole(probe), first) and same(_fresh(walk), first)


def _restored(walk: Walk) -> bool:
    with walk.subject.probe(walk.kind) as probe:
        walk.begin(probe)
        walk.steps(probe, 0, walk.half)
        state = probe.kept()
        first = walk.steps(probe, walk.half, STEPS)
        probe.back(state)
        again = walk.steps(probe, walk.half, STEPS)
        probe.back(state)
        probe.forget(state)
        return same(again, first) and same(walk.steps(probe, walk.half, STEPS), first)


def _elsewhere(walk: Walk) -> bool:
    with walk.subject.probe(walk.kind) as probe, TemporaryDirectory(prefix="inertance-") as folder:
        walk.begin(probe)
        walk.steps(probe, 0, walk.half)
        state = probe.kept()
        data = Path(folder) / "state"
        data.write_bytes(probe.bytes_of(state))
        first = walk.steps(probe, walk.half, STEPS)
        probe.forget(state)
        e = walk.experiment
        told = [
            str(walk.subject.fmu.path),
            walk.kind,
            [e.begin, e.stop, e.step, e.rtol, dict(e.inputs)],
            str(data),
        ]
        command = [sys.executable, "-c", f"from {__name__} import answer; answer()", json.dumps(told)]
        done = subprocess.run(
            command, capture_output=True, text=True, env=environment(), timeout=ELSEWHERE, check=False
        )
        if done.returncode:
            raise FMUError(f"the other process failed: {(done.stderr.strip().splitlines() or ['?'])[-1]}")
        return done.stdout.strip().endswith(SAID + first.tobytes().hex())


def answer() -> None:
    """Go on from a state that another process saved, and print what is seen, as bytes in hexadecimal."""
    path, kind, numbers, data = json.loads(sys.argv[-1])
    with Subject(Path(path)) as subject, subject.probe(kind) as probe:
        walk = Walk(subject, kind, Experiment(*numbers))
        walk.begin(probe)
        state = probe.state_of(Path(data).read_bytes())
        probe.back(state)
        probe.forget(state)
        print(SAID + walk.steps(probe, walk.half, STEPS).tobytes().hex())


def _repeated(walk: Walk) -> bool:
    first = _fresh(walk)
    return all(same(_fresh(walk), first) for _ in range(REPEATED))


def _many(walk: Walk) -> bool:
    first = _fresh(walk)
    with ExitStack() as stack:
        probes = [stack.enter_context(walk.subject.probe(walk.kind)) for _ in range(MANY)]
        for probe in probes:
            walk.begin(probe)
        seen: list[list[Any]] = [[] for _ in probes]
        for k in range(STEPS):
            for probe, rows in zip(probes, seen, strict=True):
                rows.append(walk.steps(probe, k, k + 1)[0])
        return all(same(np.array(rows), first) for rows in seen)


def _threads(walk: Walk) -> bool:
    first = _fresh(walk)
    with ThreadPoolExecutor(2) as pool:
        return all(same(found, first) for found in pool.map(lambda _: _fresh(walk), range(8)))
