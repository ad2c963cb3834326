"""One case made from its draft: true parameters, effects of the wanted size, records, campaign, label."""

from __future__ import annotations

import shutil
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from acquisition import BITS, Instrument, record
from assembly import Rig
from effects import Effect, Sized, draw, rivals, signals, typical_of
from excitations import DURATION, excitation
from plan import Draft
from rigs import RIGS
from severity import PRIOR, Scale
from stepper import Array, Drive

TRAIN = (("random", 1.0), ("sine", 1.0), ("chirp", 0.8))
TEST = (("random", 1.2), ("sine", 0.8))
MODELS = Path(__file__).with_name("models")
WITHHELD = Path(__file__).parents[2] / "cli" / "withheld"  # what `inertance demo` ships


@dataclass(frozen=True)
class Truth:
    """What a case really is; `alike` holds, for each effect, kinds and sites that are as good an answer."""

    rig: Rig
    values: dict[str, float]
    effects: list[Sized]
    alike: list[list[tuple[str, str]]]
    noise: Array
    gap: float


def nominal_model(rig: str) -> Path:
    """Return the file of a rig's nominal model; the flywheel inerter's is the one that ships."""
    return WITHHELD / "rig.py" if rig == "pfi" else MODELS / f"{rig}.py"


def make(draft: Draft, folder: Path) -> dict[str, Any]:
    """Write campaign, model and records of a case, and return its label.

    Raises:
        RuntimeError: if no option gives the wanted gap.
    """
    rng = np.random.default_rng(draft.seed)
    truth, drives = _truth(draft, rng)
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(nominal_model(truth.rig.name), folder / "model.py")
    typical = typical_of(truth.rig, drives[0])
    seen = [signals(truth.rig, truth.values, drive, truth.effects, typical) for drive in drives]
    instrument = _instrument(truth, seen[0])
    names = ["train_1", "train_2", "train_3", "test_1", "test_2"]
    for name, fine in zip(names, seen, strict=True):
        _write(folder / f"{name}.npz", truth.rig, record(fine, instrument, rng))
    stated = dict(zip(truth.rig.outputs, truth.noise, strict=True)) if rng.uniform() < 0.5 else {}
    (folder / "campaign.toml").write_text(_campaign(truth.rig, names, stated))
    return _label(draft, truth)


def _truth(draft: Draft, rng: np.random.Generator) -> tuple[Truth, list[Drive]]:
    wanted = {"effect": 1, "unknown": 1, "pair": 2}.get(draft.verdict, 0)
    for rig_name, kind, place, sites in draft.options[:40]:
        rig = RIGS[rig_name]
        values = _wrong(rig, rng, (0.15, 0.4) if draft.verdict == "parameters" else (0.05, 0.2))
        drives = [
            excitation(shape, size * rig.amplitude, rig.band, rng, rig.prescribed)
            for shape, size in TRAIN + TEST
        ]
        shown = [drives[0], drives[2]]
        weight = len(drives) / len(shown)
        scale = Scale(rig, values, shown, typical_of(rig, drives[0]), draft.noise, weight=weight)
        if not wanted:
            return Truth(rig, values, [], [], scale.noise, 0.0), drives
        first = draw(kind, place, sites, rng)
        size = scale.size(first, draft.severity)
        effects = [(first, size)] if size is not None else []
        if effects and wanted == 2:
            effects += _second(draft, rig, effects[0], scale, rng)
        if len(effects) == wanted:
            alike = [[] if draft.verdict == "unknown" else scale.alike(*e, rivals(rig)) for e in effects]
            return Truth(rig, values, effects, alike, scale.noise, scale.gap(effects)[0]), drives
    raise RuntimeError(f"no option of {draft} gives the wanted gap")


def _second(draft: Draft, rig: Rig, first: Sized, scale: Scale, rng: np.random.Generator) -> list[Sized]:
    """Return a second effect of another kind at another place of the same rig."""
    for name, kind, place, sites in draft.options:
        if name == rig.name and kind != first[0].kind and not set(sites) & set(first[0].sites):
            effect = draw(kind, place, sites, rng)
            size = scale.size(effect, draft.severity)
            if size is not None:
                return [(effect, size)]
    return []


def _wrong(rig: Rig, rng: np.random.Generator, span: tuple[float, float]) -> dict[str, float]:
    """Return true parameters that part from the nominal ones by shares within a span."""
    return {
        name: float(value * (1 + rng.choice([-1, 1]) * rng.uniform(*span)))
        for name, value in rig.parameters.items()
    }


def _instrument(truth: Truth, seen: Array) -> Instrument:
    resolution = 4.0 * np.abs(seen).max(axis=0) / 2**BITS
    resolution[0] = truth.rig.resolution or resolution[0] / 16
    return Instrument(np.concatenate([[0.0], truth.noise]), resolution)


def _write(path: Path, rig: Rig, data: Array) -> None:
    time = np.round(np.linspace(0, DURATION, len(data)), 6)
    columns = dict(zip((rig.input, *rig.outputs), data.T, strict=True))
    np.savez_compressed(path, time=time, **columns)


def _campaign(rig: Rig, names: list[str], stated: dict[str, float]) -> str:
    lines = ['model = "model.py:build"', "", "[channels]"]
    for name, (path, unit) in rig.channels.items():
        way = "input" if name == rig.input else "output"
        lines.append(f'{name} = {{ {way} = "{path}", unit = "{unit}" }}')
    lines += ["", "[parameters]", *(f'"{name}" = {{ rel = {PRIOR} }}' for name in rig.parameters)]
    for name in names:
        lines += ["", f"[[{name[:-2]}]]", f'file = "{name}.npz"', 'initial = "rest"']
    if stated:
        lines += ["", "[noise]", *(f"{name} = {sd:.3g}" for name, sd in stated.items())]
    return "\n".join(lines) + "\n"


def kinds(effect: Effect, rig: Rig) -> list[str]:
    """Return by which kinds an effect is named rightly: those that are the same force.

    Bristles creep before they slip, and are LuGre's where friction falls with speed. Hysteresis is of cells
    here, as Iwan's is. Play between parts that are rigid in the model has flanks that are not. Where friction
    is fitted, what parts one way from the other is constant.
    """
    if effect.kind == "coulomb_friction" and effect.shape["bristles"]:
        return [effect.kind, "presliding_friction"]
    if effect.kind == "stribeck_friction" and effect.shape["bristles"]:
        return [effect.kind, "lugre_friction"]
    if (effect.kind, effect.place) == ("backlash", "drive_line"):
        return [effect.kind, "elastic_backlash"]
    if effect.kind == "hysteresis":
        return [effect.kind, "iwan_hysteresis"]
    fitted = any(f"{site}.tau_s" in rig.parameters for site in effect.sites)
    if effect.kind == "asymmetric_friction" and fitted:
        return [effect.kind, "constant_force"]
    return [effect.kind]


def _label(draft: Draft, truth: Truth) -> dict[str, Any]:
    verdict = {"pair": "effect"}.get(draft.verdict, draft.verdict)
    effects = [
        {
            **asdict(effect),
            "size": size,
            "answers": [[kind, site] for kind in kinds(effect, truth.rig) for site in effect.sites]
            + [list(answer) for answer in alike],
        }
        for (effect, size), alike in zip(truth.effects, truth.alike, strict=True)
    ]
    return {
        "verdict": verdict,
        "group": draft.verdict,
        "rig": truth.rig.name,
        "severity": draft.severity if truth.effects else 0.0,
        "noise": draft.noise,
        "gap": truth.gap,
        "effects": effects,
        "values": truth.values,
    }
