"""The smooth planetary flywheel inerter on jaxonomy (JAX, its BDF), compiled before it is measured."""

import jax
import jax.numpy as jnp
import jaxonomy
import numpy as np
from pypi_run import AMPLITUDE, ATOL, GRID, OMEGA, RTOL, SMOOTH, tell
from scipy_pfi import (
    C_R,
    C_S,
    EPS,
    G_R,
    J_P,
    J_SCREW,
    K_R,
    K_S,
    M_R,
    PER_LEAD,
    R_PLANET,
    R_SCREW,
    STRIBECK,
    T_C,
    T_PM,
    T_PV,
    T_S,
    T_V,
    Drive,
    N,
    rolling_start,
)  # fmt: skip

jax.config.update("jax_enable_x64", True)


def dead_zone(force: jax.Array, half: float) -> jax.Array:
    return jnp.maximum(force - half, 0.0) + jnp.minimum(force + half, 0.0)


def screw(time: jax.Array, th_s: jax.Array, w_s: jax.Array) -> jax.Array:
    stretch = AMPLITUDE * jnp.sin(OMEGA * time) - th_s / PER_LEAD
    rate = AMPLITUDE * OMEGA * jnp.cos(OMEGA * time) - w_s / PER_LEAD
    return dead_zone(K_S * stretch + C_S * rate, K_S * EPS)


class Inerter(jaxonomy.LeafSystem):
    def __init__(self) -> None:
        super().__init__()
        start = jnp.array(rolling_start(Drive(AMPLITUDE, OMEGA)))
        self.declare_continuous_state(default_value=start, ode=self.rates, requires_inputs=False)
        self.declare_continuous_state_output(name="x")

    def rates(self, time: jax.Array, state: object, **parameters: object) -> jax.Array:
        th_s, w_s, th_p, w_p = state.continuous_state
        raw = K_R * (R_SCREW * th_s - R_PLANET * th_p) + C_R * (R_SCREW * w_s - R_PLANET * w_p)
        mesh = dead_zone(raw, K_R * G_R)
        level = T_C + (T_S - T_C) * jnp.exp(-jnp.abs(w_s) / STRIBECK)
        torque = screw(time, th_s, w_s) / PER_LEAD - N * mesh * R_SCREW
        a_s = (torque - level * jnp.tanh(w_s / SMOOTH) - T_V * w_s) / J_SCREW
        a_p = (mesh * R_PLANET - T_PM * jnp.tanh(w_p / SMOOTH) - T_PV * w_p) / J_P
        return jnp.array([w_s, a_s, w_p, a_p])


inerter = Inerter()
options = jaxonomy.SimulatorOptions(ode_solver_method="bdf", rtol=RTOL, atol=ATOL, buffer_length=20_000)
context = inerter.create_context()


def run() -> np.ndarray:
    signals = {"x": inerter.output_ports[0]}
    result = jaxonomy.simulate(inerter, context, (0.0, 1.0), options=options, recorded_signals=signals)
    time, x = np.asarray(result.time), np.asarray(result.outputs["x"])
    force = screw(time, x[:, 0], x[:, 1]) - M_R * OMEGA**2 * AMPLITUDE * np.sin(OMEGA * time)
    return np.interp(GRID, time, force)


tell(run)
