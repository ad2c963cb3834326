"""A wall and N masses in a row: the library's side of the chain benchmark; prints JSON.

Counted: from the first element to the last value of the first mass. Not counted: the interpreter, the
imports, and a small network of another kind run before.
"""

import json
import resource
import sys
from itertools import pairwise
from time import perf_counter, process_time

from inertance import Damper, Fixed, Mass, Network, Spring, rotational, simulate

MASS, STIFFNESS, DAMPING, SPEED = 1.0, 1.0e4, 10.0, 1.0  # kg, N/m, N.s/m, m/s
DURATION, OUTPUTS = 1.0, 100
RTOL, ATOL = 1e-6, 1e-8


def warm_up() -> None:
    net = Network("disc", shaft=rotational.Spring(c=1.0), disc=rotational.Inertia(J=1.0, phi=1.0))
    net.add(wall=rotational.Fixed())
    net.connect(net.wall.flange, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.disc.flange)
    net.simulate(1.0)["disc.w"]


def assemble(n: int) -> Network:
    net = Network("chain", wall=Fixed())
    previous = net.wall.flange
    for i in range(1, n + 1):
        start = {"v": SPEED} if i == 1 else {}
        net.add(**{f"k{i}": Spring(k=STIFFNESS), f"d{i}": Damper(d=DAMPING), f"m{i}": Mass(m=MASS, **start)})
        spring, damper, mass = (getattr(net, f"{kind}{i}") for kind in "kdm")
        net.connect(previous, spring.flange_a, damper.flange_a)
        net.connect(spring.flange_b, damper.flange_b, mass.flange)
        previous = mass.flange
    return net


def memory() -> float:
    """Return the most memory that this process has had [GiB]."""
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most / (2**30 if sys.platform == "darwin" else 2**20)


def main() -> None:
    n = int(sys.argv[1])
    warm_up()
    cpu, marks = process_time(), [perf_counter()]
    net = assemble(n)
    marks.append(perf_counter())
    dae = net.dae()
    marks.append(perf_counter())
    run = simulate(dae, DURATION, step=DURATION / OUTPUTS, rtol=RTOL, atol=ATOL)
    value = float(run["m1.s"][-1])
    marks.append(perf_counter())
    cpu, wall = process_time() - cpu, marks[-1] - marks[0]
    stages = [b - a for a, b in pairwise(marks)]
    told = {"wall": wall, "cpu": cpu, "stages": stages, "memory": memory(), "value": value}
    print(json.dumps(told | {"solver": run.stats["solver"], "steps": run.stats["steps"]}))


if __name__ == "__main__":
    main()
