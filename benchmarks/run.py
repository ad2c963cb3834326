"""Run benchmarks and print what the library costs over its peers.

python benchmarks/run.py [--rounds N] [--peers-python PYTHON] [name ...]; the names are told if one is wrong
"""

from __future__ import annotations

import argparse
import sys

import chain
import cold_start
import ensembles
import first_run
import hybrid_pfi
import layouts
import pypi
import smooth_pfi
import sweep
import tmdi
import unasked

BENCHMARKS = {
    "smooth_pfi": smooth_pfi.main,
    "hybrid_pfi": hybrid_pfi.main,
    "first_run": first_run.main,
    "chain": chain.main,
    "cold_start": cold_start.main,
    "tmdi": tmdi.main,
    "layouts": layouts.main,
    "sweep": sweep.main,
    "unasked": unasked.main,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="name", help="benchmarks; all if none is named")
    parser.add_argument("--rounds", type=int, default=7, help="how often each contender has its turn")
    parser.add_argument("--peers-python", default=sys.executable, help="interpreter that has the PyPI peers")
    given = parser.parse_args()
    beside = {"ensembles": ensembles, "pypi": pypi}  # libraries that stand elsewhere
    benchmarks = BENCHMARKS | {
        name: lambda rounds, module=module: module.main(rounds, given.peers_python)
        for name, module in beside.items()
    }
    unknown = [name for name in given.names if name not in benchmarks]
    if unknown or given.rounds < 1:
        parser.error(f"there are {', '.join(benchmarks)}, and at least one round")
    for name in given.names or benchmarks:
        benchmarks[name](given.rounds)


if __name__ == "__main__":
    main()
