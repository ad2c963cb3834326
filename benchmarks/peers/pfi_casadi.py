"""The smooth planetary flywheel inerter of Ge & Wang on bare CasADi CVODES, equations by hand.

Equations (16)-(27), Tables 1-4; N identical planets as one coordinate, housing at rest, rod driven
by x1 = A sin(2 pi f t), friction tanh(w/w_s). All numbers are built in; nothing can be changed.
"""

from math import cos, pi, radians

import casadi as ca
import numpy as np

N, LEAD, RING, PLANET = 4, 0.010, 0.050, 0.017
J_P, J_SCREW = 1.66e-5, 2.89e-4 + 2.80e-5 + 4 * 1.02e-4
T_C, T_S, STRIBECK, T_V = 0.1975, 0.2231, 5.437e8, 2.703e-3
M_R, K_S, C_S, EPS = 1.701, 1.168e7, 1.223e3, 1.006e-7
K_R, C_R, G_R, T_PM, T_PV = 1.353e9, 4.671e4, 1.838e-9, 8.067e-4, 1.366e-4
PER_LEAD = 2 * pi / LEAD
R_SCREW, R_PLANET = (RING - PLANET) * cos(radians(20)), PLANET * cos(radians(20))


def dead_zone(force: ca.SX, half: float) -> ca.SX:
    return ca.fmax(force - half, 0) + ca.fmin(force + half, 0)


class SmoothInerter:
    """One compiled integrator over the grid, and the force at its points."""

    def __init__(self, amplitude: float, frequency: float, w_smooth: float, grid: np.ndarray) -> None:
        omega, t, x = 2 * pi * frequency, ca.SX.sym("t"), ca.SX.sym("x", 4)
        th_s, w_s, th_p, w_p = ca.vertsplit(x)
        x1, v1 = amplitude * ca.sin(omega * t), amplitude * omega * ca.cos(omega * t)
        stretch, rate = x1 - th_s / PER_LEAD, v1 - w_s / PER_LEAD
        screw = dead_zone(K_S * stretch + C_S * rate, K_S * EPS)
        stretch, rate = R_SCREW * th_s - R_PLANET * th_p, R_SCREW * w_s - R_PLANET * w_p
        mesh = dead_zone(K_R * stretch + C_R * rate, K_R * G_R)
        level = T_C + (T_S - T_C) * ca.exp(-ca.fabs(w_s) / STRIBECK)
        friction = level * ca.tanh(w_s / w_smooth) + T_V * w_s
        planet = T_PM * ca.tanh(w_p / w_smooth) + T_PV * w_p
        a_s = (screw / PER_LEAD - N * mesh * R_SCREW - friction) / J_SCREW
        a_p = (mesh * R_PLANET - planet) / J_P
        self.dae = {"x": x, "t": t, "ode": ca.vertcat(w_s, a_s, w_p, a_p)}
        self.force = ca.Function("force", [x, t], [screw - M_R * omega**2 * x1])
        speed = PER_LEAD * amplitude * omega
        self.start = np.array([0, speed, 0, speed * R_SCREW / R_PLANET])
        self.grid = grid

    def integrator(self, rtol: float, atol: float) -> ca.Function:
        options = {"reltol": rtol, "abstol": atol, "max_num_steps": 1_000_000}
        return ca.integrator("pfi", "cvodes", self.dae, self.grid[0], self.grid[1:], options)

    def run(self, integrator: ca.Function) -> np.ndarray:
        states = np.column_stack([self.start, integrator(x0=self.start)["xf"].full()])
        return self.force(states, self.grid[None, :]).full().ravel()
