"""Run benchmarks and print what the library costs over its peers.

python benchmarks/run.py [--rounds N] [smooth_pfi hybrid_pfi chain cold_start]
"""

from __future__ import annotations

import argparse

import chain
import cold_start
import hybrid_pfi
import smooth_pfi

BENCHMARKS = {
    "smooth_pfi": smooth_pfi.main,
    "hybrid_pfi": hybrid_pfi.main,
    "chain": chain.main,
    "cold_start": cold_start.main,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="name", help="benchmarks; all if none is named")
    parser.add_argument("--rounds", type=int, default=7, help="how often each contender has its turn")
    given = parser.parse_args()
    unknown = [name for name in given.names if name not in BENCHMARKS]
    if unknown or given.rounds < 1:
        parser.error(f"there are {', '.join(BENCHMARKS)}, and at least one round")
    for name in given.names or BENCHMARKS:
        BENCHMARKS[name](given.rounds)


if __name__ == "__main__":
    main()
