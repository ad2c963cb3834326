"""Quarter cars over a kerb on diffrax: one solve under `vmap`, compiled before it is measured."""

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
from ensemble_cars import ATOL, DAMPERS, GRID, INERTERS, K_T, M_S, M_U, RTOL, STOP, K, tell

jax.config.update("jax_enable_x64", True)
Numbers = tuple[jax.Array, jax.Array]


def rates(t: jax.Array, x: jax.Array, numbers: Numbers) -> jax.Array:
    z_u, v_u, z_s, v_s, w = x
    d, b = numbers
    kerb = 0.02 / (1 + jnp.exp(-40 * (t - 1)))
    pull = d * (v_s - v_u - w)
    strut = K * (z_s - z_u) + pull
    return jnp.stack([v_u, (K_T * (kerb - z_u) + strut) / M_U, v_s, -strut / M_S, pull / b])


def one(d: jax.Array, b: jax.Array) -> jax.Array:
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(rates),
        diffrax.Tsit5(),
        0.0,
        STOP,
        None,
        jnp.zeros(5),
        (d, b),
        saveat=diffrax.SaveAt(ts=jnp.asarray(GRID)),
        stepsize_controller=diffrax.PIDController(rtol=RTOL, atol=ATOL),
        max_steps=100_000,
    )
    return jax.vmap(lambda t, x: rates(t, x, (d, b))[3])(jnp.asarray(GRID), solution.ys)


together = jax.jit(jax.vmap(one))


def run() -> np.ndarray:
    return np.asarray(together(jnp.asarray(DAMPERS), jnp.asarray(INERTERS)))


tell(run)
