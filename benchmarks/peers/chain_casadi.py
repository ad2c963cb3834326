"""A wall and N masses in a row on bare CasADi, equations by hand: the peer of the chain benchmark.

Spring k and damper d join the wall to the first mass and each mass to the next; the last is free.
The first mass starts at v_1, all else at rest. 1 s, 100 outputs, CVODES.
"""

import argparse
from time import perf_counter

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


def measure(n: int) -> tuple[list[float], ca.Function, np.ndarray]:
    marks = [perf_counter()]
    dae = assemble(n)
    marks.append(perf_counter())
    integrator = build(dae)
    marks.append(perf_counter())
    states = integrator(x0=start(n))["xf"].full()
    marks.append(perf_counter())
    return list(np.diff(marks)), integrator, states


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sizes", type=int, nargs="*", default=[100, 1000, 10000])
    sizes = parser.parse_args().sizes
    ca.load_integrator("cvodes")
    totals = []
    for n in sizes:
        times, integrator, states = measure(n)
        totals.append(sum(times))
        print(
            f"N {n}: assemble {times[0]:.4f} s, build {times[1]:.4f} s, run {times[2]:.4f} s, "
            f"total {totals[-1]:.4f} s, steps {integrator.stats()['nsteps']}, "
            f"norm of s {np.linalg.norm(states[:n, -1]):.9e} m"
        )
    if len(sizes) > 1:
        exponent = np.polyfit(np.log(sizes), np.log(totals), 1)[0]
        print(f"exponent {exponent:.3f}")


if __name__ == "__main__":
    main()
