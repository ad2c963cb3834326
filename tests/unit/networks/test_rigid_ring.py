"""A tyre with a rigid ring: against its matrices at rest, and against SciPy while it brakes and drives."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import machines, rotational
from inertance.analysis import linearise
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

RING: Any = {"J_b": 0.6, "m_b": 7.0, "c_phi": 4e4, "d_phi": 10.0, "k_x": 1.4e6, "d_x": 200.0}
ROAD: Any = {"R": 0.3, "F_z": 4000.0, "mu": 0.9, "B": 12.0, "C": 1.5, "E": 0.2, "sigma": 0.1}
J, M = 0.5, 300.0


def car(
    tyre: ia.Component, torque: Any = 0.0, v: float = 0.0, road: ia.Component | None = None
) -> ia.Network:
    net: Any = ia.Network("car", tyre=tyre, rim=rotational.Inertia(J=J), body=ia.Mass(m=M, v=v))
    net.add(motor=rotational.Torque(tau=torque))
    net.connect(net.motor.flange, net.rim.flange, net.tyre.flange_r)
    net.connect(net.tyre.flange_t, net.body.flange)
    if road is not None:
        net.add(road=road).connect(net.tyre.support_t, net.road.flange)
    built: ia.Network = net
    return built


def test_modes_at_rest_are_those_of_its_matrices() -> None:
    tyre = machines.RigidRingTyre(**RING | ROAD | {"d_phi": 0.0, "d_x": 0.0})
    c, k, R = RING["c_phi"], RING["k_x"], ROAD["R"]
    contact = ROAD["mu"] * ROAD["F_z"] * ROAD["B"] * ROAD["C"] / ROAD["sigma"]
    # rim, ring, belt, body
    stiffness = np.array([[c, -c, 0, 0], [-c, c, 0, 0], [0, 0, k, -k], [0, 0, -k, k]])
    slip = np.array([0, R, -1, 0])
    stiffness += contact * np.outer(slip, slip)
    mass = np.diag([J, RING["J_b"], RING["m_b"], M])
    expected = np.sqrt(np.maximum(eigh(stiffness, mass, eigvals_only=True), 0)) / (2 * np.pi)
    found = [mode.frequency for mode in linearise(car(tyre), at="start").modes() if mode.frequency > 1e-3]
    assert sorted(found) == pytest.approx(expected[expected > 1e-3], rel=1e-6)
    assert len(found) == 3


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("v_road", [0.0, 2.0])
def test_it_drives_and_brakes_as_its_equations_say(sign: float, v_road: float) -> None:
    def torque(t: Any) -> Any:
        return sign * 900.0 * np.tanh(20 * (t - 1.0)) + 150.0 * np.sin(200 * t)

    v_0 = 15.0 * sign
    road = ia.ConstantSpeed(v_fixed=v_road) if v_road else None
    net = car(machines.RigidRingTyre(**RING | ROAD), torque, v_0 + v_road, road)
    rolling = v_0 / ROAD["R"]
    start = {"rim.w": rolling, "tyre.ring.w": rolling, "tyre.belt.v": v_0 + v_road}
    run = net.simulate(1.8, begin=0.7, step=1e-3, rtol=1e-10, atol=1e-12, start=start)
    R, D, B, C, E = ROAD["R"], ROAD["mu"] * ROAD["F_z"], ROAD["B"], ROAD["C"], ROAD["E"]

    def rates(t: float, y: Any) -> Any:
        angle, stretch, w, w_b, v_b, v, kappa = y
        f = D * np.sin(C * np.arctan(B * kappa - E * (B * kappa - np.arctan(B * kappa))))
        tau = RING["c_phi"] * angle + RING["d_phi"] * (w_b - w)
        wall = RING["k_x"] * stretch + RING["d_x"] * (v_b - v)
        speed = v_b - v_road
        return [
            w_b - w, v_b - v, (torque(t) + tau) / J, (-tau - R * f) / RING["J_b"], (f - wall) / RING["m_b"],
            wall / M, (R * w_b - speed - abs(speed) * kappa) / ROAD["sigma"],
        ]  # fmt: skip

    first = [0.0, 0.0, rolling, rolling, v_0 + v_road, v_0 + v_road, 0.0]
    given: Any = {"method": "LSODA", "rtol": 1e-10, "atol": 1e-12, "t_eval": run.time}
    solved = solve_ivp(rates, (0.7, 1.8), first, **given)
    names = ["rim.w", "tyre.ring.w", "tyre.belt.v", "body.v", "tyre.contact.kappa"]
    for name, values in zip(names, solved.y[2:], strict=True):
        assert run[name] == pytest.approx(values, abs=2e-6 * np.abs(values).max()), name
    assert run["tyre.contact.f_x"].max() > 1000
    assert run["tyre.contact.f_x"].min() < -1000
    assert run.energy().closes < 1e-5
