"""Make the cases of the blind benchmark; the library is not imported here.

python benchmarks/blind/generate.py FOLDER [--generation 1] [--cases 240] [--seed 1] [--jobs 2] [--only GROUP]

FOLDER/cases/0001/ holds campaign.toml, model.py and the records, without a hint of what is wrong;
FOLDER/sealed.json the hash of every label; FOLDER/labels/ the labels, for the scorer alone.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import case
import needles.case
import needles.plan
import numpy as np
import plan
import second.case
import second.plan
import third.case
import third.plan
from seal import seal

SCORED, CALIBRATION = 1, 1001
GENERATIONS: dict[int, tuple[Any, Any, int]] = {
    1: (plan.drafts, case.make, 240),
    2: (second.plan.drafts, second.case.make, 300),
    3: (third.plan.drafts, third.case.make, 60),
    4: (needles.plan.drafts, needles.case.make, 30),
}


def generate(
    folder: Path, count: int, seed: int = SCORED, jobs: int = 2, generation: int = 1, only: str = ""
) -> None:
    """Make a set of cases, or `only` those of a group of it, and seal its labels; what is there is kept."""
    drafts = enumerate(GENERATIONS[generation][0](count, seed), start=1)
    chosen = {f"{number:04d}": draft for number, draft in drafts if only in ("", draft.verdict)}
    if not chosen:
        sys.exit(f"no case of these {count} is of the group '{only}'")
    parts = folder / "labels" / "parts"
    parts.mkdir(parents=True, exist_ok=True)
    missing = [(generation, d, folder, n) for n, d in chosen.items() if not (parts / f"{n}.json").exists()]
    with ProcessPoolExecutor(jobs) as pool:
        for done, name in enumerate(pool.map(_made, missing), start=1):
            print(f"\r{done}/{len(missing)} cases made ({name})", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    labels = {name: json.loads((parts / f"{name}.json").read_text()) for name in chosen}
    salts = {name: _salt(draft.seed) for name, draft in chosen.items()}
    seal(folder, labels, salts, reopen=seed == CALIBRATION)


def _made(job: tuple[int, Any, Path, str]) -> str:
    generation, draft, folder, name = job
    label: dict[str, Any] = GENERATIONS[generation][1](draft, folder / "cases" / name)
    (folder / "labels" / "parts" / f"{name}.json").write_text(json.dumps(label))
    return name


def _salt(seed: int) -> str:
    return np.random.default_rng([seed, 1]).bytes(16).hex()


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--generation", type=int, choices=GENERATIONS, default=1)
    parser.add_argument("--cases", type=int, help="240, 300, 60 or 30 by generation, if not given")
    parser.add_argument("--seed", type=int, default=SCORED, help=f"{CALIBRATION} is the calibration set")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="a group of cases alone: effect, pair, none, ...")
    given = parser.parse_args(arguments)
    count = given.cases or GENERATIONS[given.generation][2]
    generate(given.folder, count, given.seed, given.jobs, given.generation, given.only)


if __name__ == "__main__":
    main()
