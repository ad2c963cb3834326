"""Labels sealed before the diagnosis runs: their hashes lie open, they are opened after all verdicts."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

Label = dict[str, Any]


class SealError(Exception):
    """Labels, hashes and verdicts do not belong together."""


def digest(salt: str, label: Label) -> str:
    """Return sha256(salt + label), the label written in one way only."""
    return hashlib.sha256((salt + json.dumps(label, sort_keys=True)).encode()).hexdigest()


def seal(folder: Path, labels: dict[str, Label], salts: dict[str, str], *, reopen: bool = False) -> None:
    """Write `sealed.json`, the hashes, and `labels/labels.json`, what they are the hashes of.

    Args:
        folder: of the set.
        labels, salts: by case.
        reopen: whether the labels may be opened again after verdicts have changed: of a calibration set.
    """
    hashes = {name: digest(salts[name], label) for name, label in sorted(labels.items())}
    (folder / "sealed.json").write_text(json.dumps({"reopen": reopen, "sha256": hashes}, indent=1) + "\n")
    kept = {name: {"salt": salts[name], "label": labels[name]} for name in sorted(labels)}
    (folder / "labels").mkdir(exist_ok=True)
    (folder / "labels" / "labels.json").write_text(json.dumps(kept, indent=1) + "\n")


def unseal(folder: Path) -> dict[str, Label]:
    """Return the labels; the first time verdicts are noted, afterwards they must be the same.

    Raises:
        SealError: if a label does not fit its hash, or a verdict came or changed after labels were opened.
    """
    kept = json.loads((folder / "labels" / "labels.json").read_text())
    sealed = json.loads((folder / "sealed.json").read_text())
    hashes = sealed["sha256"]
    if set(kept) != set(hashes):
        raise SealError(f"{folder}: labels and sealed hashes are of different cases")
    broken = [name for name, entry in kept.items() if digest(entry["salt"], entry["label"]) != hashes[name]]
    if broken:
        raise SealError(f"{folder}: labels do not fit their sealed hashes: {', '.join(broken)}")
    if not sealed["reopen"]:
        _note_verdicts(folder, hashes)
    return {name: entry["label"] for name, entry in kept.items()}


def _note_verdicts(folder: Path, cases: dict[str, str]) -> None:
    paths = {name: folder / "cases" / name / "verdict.json" for name in cases}
    now = {name: _hash(path) for name, path in paths.items() if path.exists()}
    opened = folder / "opened.json"
    if not opened.exists():
        opened.write_text(json.dumps(now, indent=1, sort_keys=True) + "\n")
        return
    then = json.loads(opened.read_text())
    changed = sorted(name for name in now.keys() | then.keys() if now.get(name) != then.get(name))
    if changed:
        raise SealError(
            f"{folder}: verdicts were written or changed after the labels were opened: {', '.join(changed)}; "
            "generate a set with another seed"
        )


def _hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
