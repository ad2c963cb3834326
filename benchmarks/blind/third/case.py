"""One case of the third generation: a machine of its own, its records, its campaign, its label."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from third.laws import drawn
from third.machines import MACHINES, Cause, Machine, run
from third.plan import Draft

Array = NDArray[np.float64]
RATE, LASTING, BEFORE = 4000, 10.0, 3.0  # steps in a second, seconds of a record, and before it
RECORDS = ("train_1", "train_2", "train_3", "test_1", "test_2")
SIZES = np.array([1.0, 0.8, 1.1, 0.9, 1.0])
PRIOR = 0.1
VISITED = 400
JAM = 0.5  # s
FILED = {"m": ("mm", 1e3), "rad": ("rad", 1.0), "rad/s": ("rad/s", 1.0)}
MODELS = Path(__file__).with_name("models")


def make(draft: Draft, folder: Path) -> dict[str, Any]:
    """Write campaign, model and records of a case, and return its label."""
    rng = np.random.default_rng(draft.seed)
    machine = MACHINES[draft.machine]
    values = off_nominal(machine, rng)
    begin = "motion" if rng.uniform() < 0.5 else "rest"
    given = drive(machine, begin, rng)
    row = np.array(machine.joints[draft.joint].row)
    travel, speed, force = usual(machine, draft.joint, values, given)
    cause = _cause(draft, machine, (travel, speed, draft.size * force), rng)
    q, v = run(machine, values, cause, given, 1 / RATE)
    filed = write(folder, machine, begin, draft.noise, given, q, v, rng)
    kept = slice(round(BEFORE * RATE) if begin == "motion" else 0, None)
    return {
        "generation": 3,
        "verdict": draft.verdict,
        "group": draft.verdict,
        "kind": draft.kind,
        "rig": machine.name,
        "severity": draft.size,
        "noise": draft.noise,
        "begin": begin,
        "filed": filed,
        "effects": [{"kind": draft.kind, "answers": []}],
        "sites": list(machine.joints[draft.joint].sites),
        "joint": {"k": machine.joints[draft.joint].k, "d": machine.joints[draft.joint].d},
        "values": values,
        "nominal": dict(machine.values),
        "visited": _visited(cause, q[kept, 3:] @ row, v[kept, 3:] @ row, rng),
    }


def off_nominal(machine: Machine, rng: np.random.Generator) -> dict[str, float]:
    """Return parameters of which those that are uncertain are off."""
    return {
        name: value * (1 + rng.choice([-1, 1]) * rng.uniform(0.03, 0.12))
        if name in machine.uncertain
        else value
        for name, value in machine.values.items()
    }


def usual(machine: Machine, joint: str, values: dict[str, float], given: Array) -> tuple[float, float, float]:
    """Return how far and fast a joint moves, and how much force acts there, where nothing else does."""
    row, rate = np.array(machine.joints[joint].row), 1 / RATE
    plain = run(machine, values, Cause(), given, rate)
    travel, speed = (float(np.std(part @ row)) for part in plain)
    inertia = machine.inertias[int(np.argmax(np.abs(row)))]
    return (
        travel,
        speed,
        max(machine.drive[0], inertia * float(np.std(np.gradient(plain[1] @ row, rate, axis=0)))),
    )


def write(
    folder: Path, machine: Machine, begin: str, noise: float, given: Array, q: Array, v: Array,
    rng: np.random.Generator,
) -> bool:  # fmt: skip
    """Write campaign, model and records, and tell whether they are in mm."""
    kept = slice(round(BEFORE * RATE) if begin == "motion" else 0, None)
    every = int(rng.choice([8, 16]))
    filed = bool(rng.uniform() < 0.4)
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(MODELS / f"{machine.name}.py", folder / "model.py")
    outputs = {name: (v if rate else q)[kept, :, at] for name, (at, rate, _, _) in machine.outputs.items()}
    sigma = {name: noise * float(np.std(seen)) for name, seen in outputs.items()}
    units = {name: FILED[unit] if filed else (unit, 1.0) for name, (*_, unit) in machine.outputs.items()}
    for number, name in enumerate(RECORDS):
        columns = {"u": given[::2][kept][::every, number]}
        for channel, seen in outputs.items():
            noisy = seen[::every, number] + sigma[channel] * rng.standard_normal(len(columns["u"]))
            columns[channel] = noisy * units[channel][1]
        time = np.arange(len(columns["u"])) * every / RATE
        np.savez_compressed(folder / f"{name}.npz", time=np.round(time, 6), **columns)
    (folder / "campaign.toml").write_text(_campaign(machine, units, begin))
    return filed


def drive(machine: Machine, begin: str, rng: np.random.Generator, rate: int = RATE) -> Array:
    """Return the input of all records at half steps: random, a sweep, a sine; random again, two sines."""
    size, low, high = machine.drive
    seconds = LASTING + (BEFORE if begin == "motion" else 0.0)
    t = np.arange(2 * round(seconds * rate) + 1) / (2 * rate)

    def random() -> Array:
        f = rng.uniform(low, high, 40)[:, None]
        return np.sin(2 * np.pi * (f * t + rng.uniform(0, 1, (40, 1)))).sum(axis=0) / 20**0.5

    sweep = np.sqrt(2) * np.sin(2 * np.pi * (low * t + (high - low) * t**2 / (2 * seconds)))
    levels = np.sqrt(2) * np.sin(2 * np.pi * rng.uniform(low, high) * t) * (0.4 + 0.8 * t / seconds)
    two = np.sin(2 * np.pi * rng.uniform(low, high, 2)[:, None] * t).sum(axis=0)
    columns = np.column_stack([random(), sweep, levels, random(), two]) * SIZES * size
    return columns * np.clip(t / 0.5, 0, 1)[:, None] if begin == "rest" else columns


def _cause(
    draft: Draft, machine: Machine, usual: tuple[float, float, float], rng: np.random.Generator
) -> Cause:
    travel, speed, force = usual
    lasting = LASTING + BEFORE
    if draft.verdict == "law":
        law = drawn(draft.kind, rng)
        return Cause(draft.joint, lambda t, s, v: force * law(s / travel, v / speed))
    if draft.kind == "jam":
        begun, held = rng.uniform(4.0, 9.0), 20 * machine.inertias[0] * 2 * np.pi * machine.drive[2]
        return Cause(draft.joint, lambda t, s, v: held * v * (begun < t < begun + JAM))
    if draft.kind == "loose_part":
        mass = rng.uniform(0.1, 0.25) * machine.inertias[0]
        return Cause(loose=(mass, rng.uniform(0.2, 0.6) * travel, mass * (2 * np.pi * 60.0) ** 2))
    most = rng.uniform(0.3, 0.6)
    if draft.kind == "varying_mass":
        return Cause(inertia=lambda t: 1 + most * t / lasting)
    return Cause(draft.joint, stiffness=lambda t: 1 - most * t / lasting)


def _visited(cause: Cause, s: Array, v: Array, rng: np.random.Generator) -> list[list[float]]:
    """Return elongation, speed and force at instants of the test records, where a law acts."""
    if cause.force is None:
        return []
    at = rng.integers(len(s), size=VISITED), rng.integers(s.shape[1], size=VISITED)
    return np.column_stack([s[at], v[at], cause.force(0.0, s[at], v[at])]).tolist()


def _campaign(machine: Machine, units: dict[str, tuple[str, float]], begin: str) -> str:
    path, unit = machine.input
    lines = ['model = "model.py:build"', "", "[channels]", f'u = {{ input = "{path}", unit = "{unit}" }}']
    for name, (_, _, path, _) in machine.outputs.items():
        lines.append(f'{name} = {{ output = "{path}", unit = "{units[name][0]}" }}')
    lines += ["", "[parameters]", *(f'"{name}" = {{ rel = {PRIOR} }}' for name in machine.uncertain)]
    for name in RECORDS:
        lines += ["", f"[[{name[:-2]}]]", f'file = "{name}.npz"']
        lines += ['initial = "rest"'] if begin == "rest" else []
    return "\n".join(lines) + "\n"
