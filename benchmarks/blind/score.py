"""Hold verdicts against labels and print the table.

python benchmarks/blind/score.py FOLDER

Opening the labels is noted in FOLDER/opened.json with the hashes of all verdicts; scoring refuses if a
verdict was written or changed after that.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import mean, median
from typing import Any

from measures import Scored, alarm, is_outside, null_cases, reliability, share
from needles import score as sharp
from seal import unseal
from second import score as later
from third import score as beyond

LEAST = 0.7  # share of single effects to be named even in a small sample


def table(cases: Sequence[Scored]) -> list[tuple[str, str, str]]:
    """Return rows of (measure, figure, target)."""
    single = [c for c in cases if c.label["group"] == "effect"]
    clean = null_cases(cases)
    rows = [
        share(f"kind and site, gap-to-noise {s:g}", at, lambda c: c.hit, target)
        for s, target in ((10.0, ">= 90 %"), (3.0, ">= 80 %"), (1.0, ""))
        for at in [[c for c in single if c.label["severity"] == s]]
    ]
    pairs = [c for c in cases if c.label["group"] == "pair"]
    rows.append(share("two effects, both and no other", pairs, lambda c: c.hit, ""))
    rows.append(share("two effects, first named is one of them", pairs, lambda c: c.is_right(c.first), ""))
    for group in ("none", "parameters"):
        some = [c for c in clean if c.label["group"] == group]
        rows.append(share(f"false alarms, {group}", some, alarm, ""))
    rows.append(share("false alarms, both", clean, alarm, "<= 3 %"))
    shown = [c for c in single if c.label["severity"] >= 3 and c.said in ("effect", "ambiguous")]
    rows.append(share("class holds the truth", shown, lambda c: any(map(c.is_right, c.members)), ">= 95 %"))
    sizes = [len(c.members) for c in shown]
    rows.append(("mean size of a class", f"{mean(sizes):.2f}" if sizes else "-", "<= 2"))
    strange = [c for c in cases if c.label["group"] == "unknown"]
    rows.append(share("unknown recognised", strange, is_outside, ">= 80 %"))
    rows.append(_closed(shown))
    rows += _times(cases)
    rows.append(share("no verdict", cases, lambda c: c.said == "failed", "0 %"))
    return rows


def missed(cases: Sequence[Scored]) -> list[str]:
    """Return what is wrong even in a small sample: it is far below what the whole set shows."""
    shown, clean = _strong(cases), null_cases(cases)
    right, alarms = sum(c.hit for c in shown), sum(map(alarm, clean))
    failed = sum(c.said == "failed" for c in cases)
    told = {
        f"{right} of {len(shown)} single effects named at gap-to-noise 3 and 10, {LEAST:.0%} wanted": right
        >= LEAST * len(shown),
        f"{alarms} false alarms in {len(clean)} cases, at most one in eight wanted": 8 * alarms <= len(clean),
        f"{failed} cases without a verdict": not failed,
    }
    return [text for text, good in told.items() if not good]


def by(cases: Sequence[Scored], key: Callable[[Scored], str]) -> list[tuple[str, str, str]]:
    """Return the share of right kind and site of single effects at gap-to-noise 3 and 10, by a key."""
    single = _strong(cases)
    return [
        share(name, [c for c in single if key(c) == name], lambda c: c.hit, "")
        for name in sorted({*map(key, single)})
    ]


def read(folder: Path, verdict: str = "verdict.json") -> list[Scored]:
    """Open the labels and return all cases that were run."""
    labels = unseal(folder)
    cases = []
    for name, label in labels.items():
        case = folder / "cases" / name
        note = _json(case / verdict.replace(".json", ".run.json"))
        if note or (case / verdict).exists():
            cases.append(Scored(label, _json(case / verdict), note.get("seconds")))
    return cases


def show(title: str, rows: Sequence[tuple[str, str, str]]) -> None:
    """Print rows under a title."""
    print(f"\n{title}")
    for measure, figure, target in rows:
        print(f"  {measure:42} {figure:34} {target}")


def _strong(cases: Sequence[Scored]) -> list[Scored]:
    """Return those with one effect at gap-to-noise 3 and 10."""
    return [c for c in cases if c.label["group"] == "effect" and c.label["severity"] >= 3]


def _closed(cases: Sequence[Scored]) -> tuple[str, str, str]:
    """Tell how much of all that is above the noise goes away; refitting the true effect closes no more."""
    shares = [float(c.verdict["closed"]) for c in cases if c.verdict.get("closed") is not None]
    figure = f"median {median(shares):.3f}, mean {mean(shares):.3f}, {len(shares)} cases" if shares else "-"
    return "closed, of all that is above the noise", figure, ">= 0.9"


def _times(cases: Sequence[Scored]) -> list[tuple[str, str, str]]:
    rows = []
    for rig in sorted({c.label["rig"] for c in cases}):
        seconds = [c.seconds for c in cases if c.label["rig"] == rig and c.seconds is not None]
        figure = f"median {median(seconds):.1f} s, most {max(seconds):.1f} s" if seconds else "-"
        rows.append((f"run time, {rig}", figure, "< 60 s" if rig == "pfi" else ""))
    return rows


def _json(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text()) if path.exists() else {}


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    given = parser.parse_args(arguments)
    report(given.folder)


def report(folder: Path) -> list[Scored]:
    """Print the table of a set, of the diagnosis and of every baseline that was run; return the cases."""
    cases = read(folder)
    if any(case.label.get("generation") == 3 for case in cases):
        show(f"diagnosis, {len(cases)} cases", beyond.table(cases))
        show("right by kind", beyond.by_kind(cases))
        return cases
    if any(case.label.get("generation") == 4 for case in cases):
        show(f"needles, {len(cases)} cases", sharp.table(cases))
        return cases
    second = any(case.label.get("generation") == 2 for case in cases)
    show(f"diagnosis, {len(cases)} cases", later.table(cases) if second else table(cases))
    if second:
        show("right verdicts by how records were taken, gap-to-noise 3 and 10", later.by_cause(cases))
    show("effects that are there, of those named, by how sure verdicts are", reliability(cases))
    show("kind and site by kind, gap-to-noise 3 and 10", by(cases, lambda c: c.label["effects"][0]["kind"]))
    show("kind and site by topology, gap-to-noise 3 and 10", by(cases, lambda c: c.label["rig"]))
    names = sorted({path.name for path in folder.glob("cases/*/baseline_*.json")} - {"verdict.json"})
    for name in (n for n in names if not n.endswith(".run.json")):
        baseline = read(folder, name)
        show(f"{name[:-5].replace('_', ' ')}, {len(baseline)} cases", table(baseline))
    return cases


if __name__ == "__main__":
    main()
