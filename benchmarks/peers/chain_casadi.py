"""A wall and N masses in a row on bare CasADi, equations by hand: the peer of the chain benchmark.

Spring k and damper d join the wall to the first mass and each mass to the next; the last is free.
The first mass starts at v_1, all else at rest. 1 s, 100 outputs, CVODES. Prints JSON.

Counted: from the first symbol to the last value of the first mass. Not counted: the interpreter, the
imports, and a small problem of another kind run before.
"""

import json
import sys
from itertools import pairwise
from time import perf_counter, process_time

import casadi as ca
import numpy as np

MASS, STIFFNESS, DAMPING, SPEED = 1.0, 1.0e4, 10.0, 1.0  # kg, N/m, N.s/m, m/s
DURATION, OUTPUTS = 1.0, 100
OPTIONS = {"reltol": 1e-6, "abstol": 1e-8}


def assemble(n: int) -> dict[str, ca.SX]:
    s, v = ca.SX.sym("s", n), ca.SX.sym("v", n)
    stretch, rate = ca.diff(ca.vertcat(0, s)), ca.diff(ca.vertcat(0, v))
    f = STIFFNESS * stretch + DAMPING * rate
    a = (ca.vertcat(f[1:], 0) - f) / MASS
    return {"x": ca.vertcat(s, v), "ode": ca.vertcat(v, a)}


def build(dae: dict[str, ca.SX]) -> ca.Function:
    grid = np.linspace(0.0, DURATION, OUTPUTS + 1)[1:]
    return ca.integrator("chain", "cvodes", dae, 0.0, grid, OPTIONS)


def start(n: int) -> np.ndarray:
    x = np.zeros(2 * n)
    x[n] = SPEED
    return x


def warm_up() -> None:
    x = ca.SX.sym("x", 2)
    dae = {"x": x, "ode": ca.vertcat(x[1], -x[0])}
    ca.integrator("disc", "cvodes", dae, 0.0, np.linspace(0.0, 1.0, 501)[1:], OPTIONS)(x0=[1.0, 0.0])


def main() -> None:
    n = int(sys.argv[1])
    warm_up()
    cpu, marks = process_time(), [perf_counter()]
    dae = assemble(n)
    marks.append(perf_counter())
    integrator = build(dae)
    marks.append(perf_counter())
    value = integrator(x0=start(n))["xf"].full()[0, -1]
    marks.append(perf_counter())
    cpu, wall = process_time() - cpu, marks[-1] - marks[0]
    stages = [b - a for a, b in pairwise(marks)]
    print(json.dumps({"wall": wall, "cpu": cpu, "stages": stages, "value": value}))


if __name__ == "__main__":
    main()
