"""The planetary flywheel inerter of Ge & Wang on SciPy: the peer of pfi.c, in plain Python.

Equations (16)-(27), Tables 1-4; N identical planets as one coordinate, housing at rest, rod driven
by x1 = A sin(2 pi f t), friction tanh(w/w_s) (`smooth`) or truly sticking (`hybrid`).
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, field
from math import cos, exp, pi, sin, tanh
from statistics import median
from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp

N, LEAD, RING, PLANET, PRESSURE_ANGLE = 4, 0.010, 0.050, 0.017, np.radians(20.0)
J_P, J_SCREW = 1.66e-5, 2.89e-4 + 2.80e-5 + 4 * 1.02e-4
T_C, T_S, STRIBECK, T_V = 0.1975, 0.2231, 5.437e8, 2.703e-3
M_R, K_S, C_S, EPS = 1.701, 1.168e7, 1.223e3, 1.006e-7
K_R, C_R, G_R, T_PM, T_PV = 1.353e9, 4.671e4, 1.838e-9, 8.067e-4, 1.366e-4
PER_LEAD = 2 * pi / LEAD
R_SCREW = (RING - PLANET) * float(np.cos(PRESSURE_ANGLE))
R_PLANET = PLANET * float(np.cos(PRESSURE_ANGLE))
BREAK_AWAY = (T_S, T_PM)
METHODS = ("Radau", "BDF", "LSODA")

State = np.ndarray
Sign = Callable[[int, float], float]


@dataclass
class Drive:
    """Rod displacement x1 = A sin(omega t)."""

    amplitude: float
    omega: float

    def position(self, t: float) -> float:
        return self.amplitude * sin(self.omega * t)

    def velocity(self, t: float) -> float:
        return self.amplitude * self.omega * cos(self.omega * t)


@dataclass
class Run:
    """Terminal force on the output grid, and what it cost."""

    t: State
    force: State
    steps: int = 0
    evaluations: int = 0
    events: list[tuple[float, int, int]] = field(default_factory=list)


def dead_zone(force: float, half: float) -> float:
    """Clearance law (20), (24)."""
    return max(force - half, 0.0) + min(force + half, 0.0)


def screw_force(drive: Drive, t: float, y: State) -> float:
    stretch = drive.position(t) - y[0] / PER_LEAD
    rate = drive.velocity(t) - y[1] / PER_LEAD
    return dead_zone(K_S * stretch + C_S * rate, K_S * EPS)


def loads(drive: Drive, t: float, y: State) -> tuple[float, float]:
    """Torques on the screw and on one planet, all but friction."""
    stretch = R_SCREW * y[0] - R_PLANET * y[2]
    rate = R_SCREW * y[1] - R_PLANET * y[3]
    mesh = dead_zone(K_R * stretch + C_R * rate, K_R * G_R)
    return screw_force(drive, t, y) / PER_LEAD - N * mesh * R_SCREW, mesh * R_PLANET


def rates(drive: Drive, sign: Sign, t: float, y: State) -> list[float]:
    """(16), (21), (25)-(27)."""
    w_s, w_p = float(y[1]), float(y[3])
    screw, planet = loads(drive, t, y.tolist())
    level = T_C + (T_S - T_C) * exp(-abs(w_s) / STRIBECK)
    return [
        w_s,
        (screw - level * sign(0, w_s) - T_V * w_s) / J_SCREW,
        w_p,
        (planet - T_PM * sign(1, w_p) - T_PV * w_p) / J_P,
    ]


def jacobian(drive: Drive, w_smooth: float, t: float, y: State) -> State:
    """Of the smooth model; the Stribeck slope, below 1e-10 N.m.s/rad, is left out."""
    th_s, w_s, th_p, w_p = y.tolist()
    stretch = drive.position(t) - th_s / PER_LEAD
    rate = drive.velocity(t) - w_s / PER_LEAD
    screw = (abs(K_S * stretch + C_S * rate) >= K_S * EPS) / PER_LEAD**2
    stretch, rate = R_SCREW * th_s - R_PLANET * th_p, R_SCREW * w_s - R_PLANET * w_p
    mesh = abs(K_R * stretch + C_R * rate) >= K_R * G_R
    own, cross, planet = mesh * R_SCREW**2, mesh * R_SCREW * R_PLANET, mesh * R_PLANET**2
    friction_s = T_S * (1.0 - tanh(w_s / w_smooth) ** 2) / w_smooth + T_V
    friction_p = T_PM * (1.0 - tanh(w_p / w_smooth) ** 2) / w_smooth + T_PV
    screw_row = (
        -(screw * K_S + N * own * K_R),
        -(screw * C_S + N * own * C_R + friction_s),
        N * cross * K_R,
        N * cross * C_R,
    )
    planet_row = (cross * K_R, cross * C_R, -planet * K_R, -(planet * C_R + friction_p))
    return np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [entry / J_SCREW for entry in screw_row],
            [0.0, 0.0, 0.0, 1.0],
            [entry / J_P for entry in planet_row],
        ]
    )


def rolling_start(drive: Drive) -> State:
    w_s = PER_LEAD * drive.velocity(0.0)
    return np.array([0.0, w_s, 0.0, w_s * R_SCREW / R_PLANET])


def terminal_force(drive: Drive, t: State, y: State) -> State:
    """(22)."""
    acceleration = -(drive.omega**2) * np.array([drive.position(u) for u in t])
    screw = [screw_force(drive, u, state) for u, state in zip(t, y.T, strict=True)]
    return np.array(screw) + M_R * acceleration


def solve_smooth(drive: Drive, w_smooth: float, grid: State, exact_jacobian: bool, **options: object) -> Run:
    def rhs(t: float, y: State) -> list[float]:
        return rates(drive, lambda _, w: tanh(w / w_smooth), t, y)

    if exact_jacobian:
        options["jac"] = lambda t, y: jacobian(drive, w_smooth, t, y)

    answer = solve_ivp(rhs, (grid[0], grid[-1]), rolling_start(drive), dense_output=True, **options)
    if not answer.success:
        raise RuntimeError(answer.message)
    force = terminal_force(drive, grid, answer.sol(grid))
    return Run(grid, force, len(answer.t) - 1, answer.nfev)


def solve_hybrid(drive: Drive, grid: State, **options: object) -> Run:
    """True stick: modes -1, 0 (stuck), 1 for the screw and the planets, restarted at each event."""
    mode = [1, 1]
    run = Run(grid, np.empty_like(grid))
    t, y = float(grid[0]), rolling_start(drive)

    def rhs(t: float, y: State) -> list[float]:
        dy = rates(drive, lambda i, _: mode[i], t, y)
        return [dy[0], dy[1] if mode[0] else 0.0, dy[2], dy[3] if mode[1] else 0.0]

    def indicator(i: int) -> Callable[[float, State], float]:
        def margin(t: float, y: State) -> float:
            slip = mode[i] * y[2 * i + 1]
            return slip if mode[i] else BREAK_AWAY[i] - abs(loads(drive, t, y)[i])

        margin.terminal, margin.direction = True, -1  # type: ignore[attr-defined]
        return margin

    events = [indicator(0), indicator(1)]
    while t < grid[-1]:
        answer = solve_ivp(rhs, (t, grid[-1]), y, dense_output=True, events=events, **options)
        if not answer.success:
            raise RuntimeError(answer.message)
        now = (grid >= t) & (grid <= answer.t[-1])
        if now.any():
            run.force[now] = terminal_force(drive, grid[now], answer.sol(grid[now]))
        run.steps += len(answer.t) - 1
        run.evaluations += answer.nfev
        t, y = float(answer.t[-1]), answer.y[:, -1].copy()
        for i in (0, 1):
            if answer.t_events[i].size:
                y[2 * i + 1] = 0.0
                load = loads(drive, t, y)[i]
                holds = mode[i] != 0 and abs(load) <= BREAK_AWAY[i]
                mode[i] = 0 if holds else int(np.sign(load))
                run.events.append((t, i, mode[i]))
    return run


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("model", choices=("smooth", "hybrid"))
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS)
    parser.add_argument("--rtol", type=float, default=1e-6)
    parser.add_argument("--atol", type=float, default=1e-8)
    parser.add_argument("--w-smooth", type=float, default=0.1, help="rad/s")
    parser.add_argument("--amplitude", type=float, default=0.010, help="m")
    parser.add_argument("--frequency", type=float, default=3.0, help="Hz")
    parser.add_argument("--duration", type=float, default=1.0, help="s")
    parser.add_argument("--jacobian", action="store_true", help="exact Jacobian (smooth only)")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--csv", help="t, F at 1000 points; {} in the name becomes the method")
    args = parser.parse_args()
    if args.jacobian and args.model == "hybrid":
        parser.error("--jacobian is for the smooth model")
    return args


def main() -> None:
    args = arguments()
    drive = Drive(args.amplitude, 2 * pi * args.frequency)
    grid = np.linspace(0.0, args.duration, 1001)
    for method in args.methods:
        options = {"method": method, "rtol": args.rtol, "atol": args.atol}
        times = []
        for _ in range(args.repeats):
            begin = perf_counter()
            if args.model == "smooth":
                run = solve_smooth(drive, args.w_smooth, grid, args.jacobian, **options)
            else:
                run = solve_hybrid(drive, grid, **options)
            times.append(perf_counter() - begin)
        print(
            f"{method}: time {median(times):.6e} s, steps {run.steps}, "
            f"evaluations {run.evaluations}, events {len(run.events)}"
        )
        if args.csv:
            table = np.column_stack((run.t, run.force))
            path = args.csv.format(method)
            np.savetxt(path, table, fmt="%.17g", delimiter=",", header="t,F", comments="")


if __name__ == "__main__":
    main()
