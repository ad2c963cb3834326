"""One case of the second generation: true parameters, effects of the wanted size, its files, its label."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from assembly import Rig
from case import MODELS
from effects import Sized, Typical, typical_of
from excitations import DURATION, RATE, STEP
from plan import Draft
from second.effects import ONE_LAW, SERIES, draw, rivals, signals
from second.excitations import PREROLL, excitation
from second.recording import Logger, Taken, drawn, left, taken, write
from second.rigs import BIAS, FILED, RIGS
from second.severity import Bench
from stepper import Array, Drive

WANTED = {"effect": 1, "unknown": 1, "pair": 2, "twice": 2, "triple": 3}
RELS = (0.05, 0.1, 0.2, 0.4)
INPUT_NOISE = 5e-4  # of a measured force, over its root mean square
Placed = tuple[Sized, list[tuple[str, str]]]


@dataclass(frozen=True)
class Truth:
    """What a case really is; each effect stands with all kinds and sites that are right answers."""

    rig: Rig
    values: dict[str, float]
    rel: dict[str, float]
    placed: list[Placed]
    noise: Array
    gap: float
    drives: dict[str, Drive]
    typical: Mapping[str, Typical]
    logger: Logger

    def seen(self, name: str, step: float = STEP) -> Array:
        """Return what perfect instruments would see in a record, input first, at the stepping rate."""
        every = round(step / STEP)
        drive = Drive(*(x[::every] for x in vars(self.drives[name]).values()))
        effects = [sized for sized, _ in self.placed]
        return signals(self.rig, self.values, drive, effects, self.typical, step, self.logger.duration)


def make(draft: Draft, folder: Path) -> dict[str, Any]:
    """Write campaign, model and records of a case, and return its label.

    Raises:
        RuntimeError: if no option gives the wanted gap.
    """
    rng = np.random.default_rng(draft.seed)
    truth = true_case(draft, rng)
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(MODELS / f"{truth.rig.name}.py", folder / "model.py")
    records = recorded(truth, rng)
    entries = [
        entry
        for name, record in records.items()
        for entry in write(folder, name, record, truth.logger, truth.rig, rng)
    ]
    (folder / "campaign.toml").write_text(_campaign(truth, entries))
    tests = [record for name, record in records.items() if name.startswith("test")]
    return _label(draft, truth, dict(zip(truth.rig.outputs, left(tests).tolist(), strict=True)))


def true_case(draft: Draft, rng: np.random.Generator) -> Truth:
    """Return the first option of a draft whose effects leave the wanted gap."""
    wanted = WANTED.get(draft.verdict, 0)
    for option in draft.options:
        rig = RIGS[option[0]]
        rel = {name: float(rng.choice(RELS)) for name in rig.parameters}
        values = _true_values(rig, rel, draft.verdict, rng)
        logger = drawn(rig, rng, DURATION)
        drives = _drives(rig, logger, rng)
        typical = typical_of(rig, drives["train_1"])
        shown = [drives["train_1"], drives["train_3"]]
        bench = Bench(rig, values, shown, typical, draft.noise, rel, logger)
        placed = _placed(draft, option, rig, bench, rng) if wanted else []
        if len(placed) == wanted:
            noise = bench.noise * draft.noise / np.hypot(draft.noise, logger.grain)
            gap = bench.gap([sized for sized, _ in placed])[0] if placed else 0.0
            return Truth(rig, values, rel, placed, noise, gap, drives, typical, logger)
    raise RuntimeError(f"no option of {draft} gives the wanted gap")


def recorded(truth: Truth, rng: np.random.Generator) -> dict[str, Taken]:
    """Return all records; the noise of each is its own."""
    seen = {name: truth.seen(name) for name in truth.drives}
    kept = slice(round(PREROLL * RATE), None)
    reach = np.max([np.abs(fine[kept]).max(axis=0) for fine in seen.values()], axis=0)
    pushed = 0.0 if truth.rig.resolution else INPUT_NOISE * np.std(seen["train_1"][:, 0])
    noise = np.concatenate([[pushed], truth.noise])
    return {
        name: taken(fine, truth.logger, truth.rig, noise * rng.uniform(0.6, 1.6), reach, rng)
        for name, fine in seen.items()
    }


def _drives(rig: Rig, logger: Logger, rng: np.random.Generator) -> dict[str, Drive]:
    steady = [str(x) for x in rng.choice(["sine", "levels"], 2)]
    third = "decay" if logger.begin == "motion" and rng.uniform() < 0.6 else "chirp"
    wanted = {
        "train_1": ("random", 1.0),
        "train_2": (steady[0], 1.0),
        "train_3": (third, 1.0),
        "test_1": ("random", 1.2),
        "test_2": (steady[1], 0.8),
    }
    how = rig.band, rng, rig.prescribed, logger.duration, logger.rested, BIAS.get(rig.name, 0.0)
    return {name: excitation(shape, size * rig.amplitude, *how) for name, (shape, size) in wanted.items()}


def _true_values(
    rig: Rig, rel: Mapping[str, float], group: str, rng: np.random.Generator
) -> dict[str, float]:
    """Return true parameters: the nominal ones if nothing is wrong, else off as much as the campaign says."""
    if group == "none":
        return dict(rig.parameters)
    least = 0.5 if group == "parameters" else 0.0
    off = {name: rng.choice([-1, 1]) * rng.uniform(least, 1.5) * rel[name] for name in rig.parameters}
    return {name: float(value * (1 + off[name])) for name, value in rig.parameters.items()}


def _placed(
    draft: Draft, option: tuple[Any, ...], rig: Rig, bench: Bench, rng: np.random.Generator
) -> list[Placed]:
    """Return effects of the wanted size, beginning with that of `option`; too few if there are not enough."""
    wanted, found = WANTED[draft.verdict], list[Placed]()
    others = [other for other in draft.options if other != option]
    for offer in (o[1:] for o in (option, *others) if o[0] == rig.name):
        if found and not _joins(offer, [effect for (effect, _), _ in found], draft.verdict == "twice"):
            continue
        effect = draw(offer, rng, bench.logger.duration)
        size = bench.size(effect, draft.severity)
        if size is None and not found:
            return []
        if size is not None:
            answers = _answers(bench, (effect, size), rig, draft.verdict)
            if not any(answer in answers for _, others_ in found for answer in others_):
                found.append(((effect, size), answers))
        if len(found) == wanted:
            break
    return found


def _joins(offer: tuple[Any, ...], effects: list[Any], twice: bool) -> bool:
    """Return whether an effect may come to others: at another site, of the same kind only if `twice`."""
    kind, place, sites = offer
    apart = all(not set(sites) & set(effect.sites) and place != effect.place for effect in effects)
    series = sum(k in SERIES for k in (kind, *(effect.kind for effect in effects)))
    return apart and series < 2 and all((kind == effect.kind) == twice for effect in effects)


def _answers(bench: Bench, sized: Sized, rig: Rig, group: str) -> list[tuple[str, str]]:
    effect, size = sized
    if group == "unknown":
        return []
    kinds = ONE_LAW.get(effect.kind, (effect.kind,))
    own = [(kind, site) for kind in kinds for site in effect.sites]
    return own + bench.alike(effect, size, rivals(rig))


def _campaign(truth: Truth, entries: list[str]) -> str:
    rig, lines = truth.rig, ['model = "model.py:build"', "", "[channels]"]
    for name, (path, unit) in rig.channels.items():
        way = "input" if name == rig.input else "output"
        filed = FILED.get(unit, (unit,))[0] if truth.logger.filed else unit
        told = f', unit = "{filed}"' if unit else ""
        lines.append(f'{name} = {{ {way} = "{path}"{told} }}')
    lines += ["", "[parameters]", *(f'"{name}" = {{ rel = {rel} }}' for name, rel in truth.rel.items())]
    return "\n".join(lines) + "\n\n" + "\n\n".join(entries) + "\n"


def _label(draft: Draft, truth: Truth, unexplained: Mapping[str, float]) -> dict[str, Any]:
    effects = [
        {**asdict(effect), "size": size, "answers": [list(answer) for answer in answers]}
        for (effect, size), answers in truth.placed
    ]
    return {
        "generation": 2,
        "verdict": "effect" if draft.verdict in ("pair", "twice", "triple") else draft.verdict,
        "group": draft.verdict,
        "rig": truth.rig.name,
        "severity": draft.severity if truth.placed else 0.0,
        "noise": draft.noise,
        "gap": truth.gap,
        "effects": effects,
        "values": truth.values,
        "rel": truth.rel,
        "logger": asdict(truth.logger),
        "left": dict(unexplained),
    }
