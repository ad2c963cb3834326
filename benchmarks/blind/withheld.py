"""Make the campaign that `inertance demo` diagnoses, and tell its cause.

python benchmarks/blind/withheld.py FOLDER
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

import numpy as np
from case import make
from effects import places
from plan import Draft
from rigs import RIGS

SEED, KIND, PLACE = 17, "position_ripple", "screw"
RECORDS = {"train_1": "random", "train_2": "sine", "test_1": "other_random"}
EVERY, LENGTH = 2, 10.0


def main(folder: Path) -> None:
    options = tuple(("pfi", *offer) for offer in places(RIGS["pfi"]) if offer[:2] == (KIND, PLACE))
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch)
        label = make(Draft("effect", 10.0, 0.01, SEED, options), case)
        folder.mkdir(parents=True, exist_ok=True)
        for name, told in RECORDS.items():
            with np.load(case / f"{name}.npz") as data:
                keep = data["time"] <= LENGTH
                np.savez_compressed(folder / f"{told}.npz", **{k: v[keep][::EVERY] for k, v in data.items()})
    print(json.dumps(label["effects"], indent=1))
    print(json.dumps(label["values"], indent=1))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
