"""Make records of the planetary flywheel inerter whose model lacks one effect, and tell the cause.

python benchmarks/blind/withheld.py FOLDER [--kind position_ripple] [--place screw] [--seed 17]

With the defaults these are the records that `inertance demo` diagnoses.
"""

from __future__ import annotations

import argparse
import json
import shutil
import tempfile
from pathlib import Path

import numpy as np
from case import WITHHELD, make, nominal_model
from effects import places
from plan import Draft
from rigs import RIGS

RECORDS = {"train_1": "random", "train_2": "sine", "test_1": "other_random"}
EVERY, LENGTH = 2, 10.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kind", default="position_ripple")
    parser.add_argument("--place", default="screw")
    parser.add_argument("--seed", type=int, default=17)
    given = parser.parse_args()
    wanted = given.kind, given.place
    options = tuple(("pfi", *offer) for offer in places(RIGS["pfi"]) if offer[:2] == wanted)
    if not options:
        parser.error(f"the rig has no {given.kind} at '{given.place}'; it has {places(RIGS['pfi'])}")
    given.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch)
        label = make(Draft("effect", 10.0, 0.01, given.seed, options), case)
        for name, told in RECORDS.items():
            with np.load(case / f"{name}.npz") as data:
                keep = data["time"] <= LENGTH
                kept = {key: values[keep][::EVERY] for key, values in data.items()}
                np.savez_compressed(given.folder / f"{told}.npz", **kept)
    for file in (nominal_model("pfi"), WITHHELD / "campaign.toml"):
        shutil.copy(file, given.folder / file.name)
    print(json.dumps({"effects": label["effects"], "values": label["values"]}, indent=1))


if __name__ == "__main__":
    main()
