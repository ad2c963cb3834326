"""The smooth planetary flywheel inerter in Modelica on rumoca (its BDF)."""

import numpy as np
import rumoca
from pypi_run import AMPLITUDE, ATOL, GRID, OMEGA, RTOL, SMOOTH, tell

MODEL = f"""
model Inerter
  parameter Real pi = 3.14159265358979323846;
  parameter Real N = 4, L = 0.010, Rs = (0.050 - 0.017) * cos(pi / 9), Rp = 0.017 * cos(pi / 9);
  parameter Real Jp = 1.66e-5, Js = 2.89e-4 + 2.80e-5 + 4 * 1.02e-4;
  parameter Real Tc = 0.1975, Ts = 0.2231, ws = 5.437e8, Tv = 2.703e-3, mr = 1.701;
  parameter Real ks = 1.168e7, cs = 1.223e3, epss = 1.006e-7;
  parameter Real kr = 1.353e9, cr = 4.671e4, gr = 1.838e-9, Tpm = 8.067e-4, Tpv = 1.366e-4;
  parameter Real A = {AMPLITUDE}, omega = {OMEGA!r}, smooth = {SMOOTH};
  parameter Real w0 = 2 * pi / L * A * omega;
  Real th_s(start = 0, fixed = true), w_s(start = w0, fixed = true);
  Real th_p(start = 0, fixed = true), w_p(start = w0 * Rs / Rp, fixed = true);
  Real raw_s, raw_r, screw, mesh, F;
equation
  raw_s = ks * (A * sin(omega * time) - L / (2 * pi) * th_s)
    + cs * (A * omega * cos(omega * time) - L / (2 * pi) * w_s);
  screw = max(raw_s - ks * epss, 0) + min(raw_s + ks * epss, 0);
  raw_r = kr * (Rs * th_s - Rp * th_p) + cr * (Rs * w_s - Rp * w_p);
  mesh = max(raw_r - kr * gr, 0) + min(raw_r + kr * gr, 0);
  der(th_s) = w_s;
  Js * der(w_s) = L / (2 * pi) * screw - N * mesh * Rs
    - (Tc + (Ts - Tc) * exp(-abs(w_s) / ws)) * tanh(w_s / smooth) - Tv * w_s;
  der(th_p) = w_p;
  Jp * der(w_p) = mesh * Rp - Tpm * tanh(w_p / smooth) - Tpv * w_p;
  F = screw - mr * omega * omega * A * sin(omega * time);
end Inerter;
"""
model = rumoca.Session().loads(MODEL, model="Inerter")


def run() -> np.ndarray:
    config = rumoca.SimConfig(solver="bdf", rtol=RTOL, atol=ATOL, dt=GRID[1] - GRID[0])
    result = model.simulate((GRID[0], GRID[-1]), config=config)
    return np.interp(GRID, np.array(result.time), np.array(result["F"]))


tell(run)
