"""Quarter cars over a kerb on heyoka: Taylor's method on vectors, compiled before it is measured."""

import heyoka as hy
import numpy as np
from ensemble_cars import DAMPERS, GRID, INERTERS, K_T, M_S, M_U, MEMBERS, K, tell

TOLERANCE = 1e-8  # with which it is fastest: with 1e-6 it takes lower orders, and more steps
LANES = hy.recommended_simd_size()
z_u, v_u, z_s, v_s, w = hy.make_vars("z_u", "v_u", "z_s", "v_s", "w")
d, b = hy.par[0], hy.par[1]
kerb = 0.02 / (1.0 + hy.exp(-40.0 * (hy.time - 1.0)))
pull = d * (v_s - v_u - w)
strut = K * (z_s - z_u) + pull
system = [
    (z_u, v_u),
    (v_u, (K_T * (kerb - z_u) + strut) / M_U),
    (z_s, v_s),
    (v_s, -strut / M_S),
    (w, pull / b),
]
integrator = hy.taylor_adaptive_batch(system, np.zeros((5, LANES)), pars=np.ones((2, LANES)), tol=TOLERANCE)
grid = np.repeat(GRID[:, None], LANES, axis=1)


def run() -> np.ndarray:
    accelerations = []
    for first in range(0, MEMBERS, LANES):
        integrator.set_time(np.zeros(LANES))
        integrator.state[:] = 0.0
        integrator.pars[0], integrator.pars[1] = (v[first : first + LANES] for v in (DAMPERS, INERTERS))
        x = integrator.propagate_grid(grid)[1]
        damper = integrator.pars[0] * (x[:, 3] - x[:, 1] - x[:, 4])
        accelerations.append((-(K * (x[:, 2] - x[:, 0]) + damper) / M_S).T)
    return np.concatenate(accelerations)


tell(run)
