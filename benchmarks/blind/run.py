"""Generate the blind cases, diagnose each in a process of its own, open the labels, print the table.

python benchmarks/blind/run.py [--generation 2] [--folder DIR] [--cases N | --sample N] [--seed 1]
                               [--only GROUP] [--jobs 2] [--cores 1] [--baselines] [--gate]

What is there already is kept, so a run that was broken off goes on where it stopped. With --gate the exit
code is 1 if a sample of this size, which tells no share well, says that something is broken.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from generate import CALIBRATION, GENERATIONS, SCORED, generate
from score import missed, report

LIMIT = 600.0
NAMES = {1: "blind", 2: "blind2", 3: "blind3", 4: "needles"}


def diagnose(case: Path, cores: int = 1) -> str:
    """Write verdict.json for a case through the command line, and verdict.run.json with what it took."""
    verdict, note = case / "verdict.json", case / "verdict.run.json"
    if note.exists():
        return case.name
    command = [sys.executable, "-m", "inertance", "diagnose", "campaign.toml", "--jobs", str(cores)]
    command += ["--json", verdict.name]
    alone = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    begin = time.perf_counter()
    try:
        done = subprocess.run(
            command, cwd=case, capture_output=True, text=True, timeout=LIMIT, env=alone, check=False
        )
        told, code = (done.stderr or done.stdout)[-2000:], done.returncode
    except subprocess.TimeoutExpired:
        told, code = f"no verdict within {LIMIT:g} s", -1
    seconds = time.perf_counter() - begin
    note.write_text(json.dumps({"seconds": seconds, "code": code, "told": "" if verdict.exists() else told}))
    return case.name


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--folder", type=Path, help="where cases go; blind_SEED_CASES if not given")
    parser.add_argument("--generation", type=int, choices=GENERATIONS, default=1)
    parser.add_argument("--cases", type=int, help="240, 300, 60 or 30 by generation, if not given")
    parser.add_argument("--sample", type=int, help="only so many cases; any first 24, 30 or 12 are balanced")
    parser.add_argument("--seed", type=int, default=SCORED, help=f"{CALIBRATION} is the calibration set")
    parser.add_argument("--only", default="", help="a group of these cases alone: effect, pair, none, ...")
    parser.add_argument("--jobs", type=int, default=2, help="cases at a time")
    parser.add_argument("--cores", type=int, default=1, help="processes of each diagnosis")
    parser.add_argument("--baselines", action="store_true", help="run the baselines, too")
    parser.add_argument("--gate", action="store_true", help="end with exit code 1 if the score is poor")
    given = parser.parse_args(arguments)
    count = given.sample or given.cases or GENERATIONS[given.generation][2]
    folder = given.folder or Path(f"{NAMES[given.generation]}_{given.seed}_{count}")
    generate(folder, count, given.seed, given.jobs, given.generation, given.only)
    cases = sorted(path for path in (folder / "cases").iterdir() if path.is_dir())
    with ThreadPoolExecutor(given.jobs) as pool:
        for done, name in enumerate(pool.map(partial(diagnose, cores=given.cores), cases), start=1):
            print(f"\r{done}/{len(cases)} cases diagnosed ({name})", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    if given.baselines:
        from baselines import judge

        judge(folder, given.jobs)
    scored = report(folder)
    poor = missed(scored) if given.gate else []
    if poor:
        sys.exit("\n".join(["", "the score is poor:", *poor]))


if __name__ == "__main__":
    main()
