"""Gyroscopes and inerters made of them, against the motion of a rotor in space and closed forms."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import machines, rotational
from scipy.integrate import solve_ivp

UP = np.array([0.0, 0.0, 1.0])
GYRO: dict[str, Any] = {
    "J_s": 0.02,
    "w_s": 80.0,
    "J_t": 0.012,
    "J_g": 0.004,
    "J_i": 0.003,
    "c": 6.0,
    "d": 0.05,
}


def gimbals(turn: Any, precession: Any) -> Any:
    """Return the inner gimbal's axes in space, as columns: of precession, of spin, and across."""
    c, s, o = np.cos(turn), np.sin(turn), 0 * turn
    ca, sa = np.cos(precession), np.sin(precession)
    outer = np.array([[c, -s, o], [s, c, o], [o, o, 1 + o]])
    return outer @ np.array([[1 + o, o, o], [o, ca, -sa], [o, sa, ca]])


def momentum(angles: Any, rates: Any, spun: float, across: float) -> Any:
    """Return the rotor's angular momentum in space."""
    axes = gimbals(angles[0], angles[1])
    w = rates[0] * UP + rates[1] * axes[:, 0] + rates[2] * axes[:, 1]
    return (across * np.eye(3) + (spun - across) * np.outer(axes[:, 1], axes[:, 1])) @ w


def in_space(times: Any, torque: Any, turned: list[float], g: dict[str, float]) -> Any:
    """Integrate turn, precession and spin of a rotor by the balance of its momentum about the three axes."""

    def rates(t: float, y: Any) -> Any:
        q, v = y[:3].astype(complex), y[3:].astype(complex)
        moved = momentum(q + 1e-30j * v, v, g["J_s"], g["J_t"]).imag / 1e-30
        of_rates = [momentum(q, np.eye(3)[k] + 0j, g["J_s"], g["J_t"]).real for k in range(3)]
        precession, spin = gimbals(y[0], y[1])[:, :2].T
        axes = np.array([UP, precession, spin])
        inertia = axes @ np.column_stack(of_rates) + np.diag([g["J_g"], g["J_i"], 0.0])
        torques = np.array([torque(t), -g["c"] * y[1] - g["d"] * y[4], 0.0])
        return np.concatenate([y[3:], np.linalg.solve(inertia, torques - axes @ moved)])

    phi, alpha, w, w_p = turned
    start = [phi, alpha, 0.0, w, w_p, g["w_s"] - w * np.sin(alpha)]
    run = solve_ivp(rates, (times[0], times[-1]), start, "DOP853", times, rtol=1e-10, atol=1e-12)
    return run.y


@pytest.mark.parametrize("w_s", [80.0, -80.0, 0.0])
@pytest.mark.parametrize("turned", [[0.2, 0.3, 2.0, -1.0], [0.0, 0.0, 0.0, 0.0]])
def test_a_gyroscope_moves_as_a_rotor_in_space(w_s: float, turned: list[float]) -> None:
    values: dict[str, Any] = {**GYRO, "w_s": w_s}
    net = ia.Network("gyro", gyro=ia.Gyroscope(**values), hand=rotational.Torque())
    net.connect(net.gyro.flange, net.hand.flange)
    names = "gyro.flange.phi", "gyro.alpha", "gyro.w", "gyro.w_p"

    def torque(t: Any) -> Any:
        return 1.5 * np.sin(7 * t) - 0.4

    run = net.simulate(
        2.5, begin=0.5, step=0.01, rtol=1e-9, inputs={"hand.tau": torque},
        start=dict(zip(names, turned, strict=True)),
    )  # fmt: skip
    apart = in_space(np.minimum(run.time, 2.5), torque, turned, values)
    for name, row in zip(names, (0, 1, 3, 4), strict=True):
        assert run[name] == pytest.approx(apart[row], abs=1e-6 * (1 + np.ptp(apart[row])))
    if w_s:
        assert np.ptp(apart[1]) > 0.4  # far beyond small angles
    assert run.energy().closes < 1e-7


@pytest.mark.parametrize("R", [0.03, 0.05])
def test_its_admittance_is_a_gyrator_of_spring_damper_and_inertia(R: float) -> None:
    """Force over speed: (J_g + J_t) s + H^2/(I s + d + c/s), over R^2."""
    g: dict[str, Any] = {**GYRO, "J_g": 0.0}
    inerter = machines.GyroInerter(pinion=ia.RackPinion(R=R), flywheel=ia.Gyroscope(**g))
    net = ia.Network("strut", frame=ia.Fixed(), inerter=inerter, rod=ia.Speed())
    net.connect(net.frame.flange, net.inerter.flange_b).connect(net.inerter.flange_a, net.rod.flange)
    system = ia.analysis.linearise(net, ["rod.v_ref"], ["inerter.f"])
    f = np.array([0.03, 1.0, 5.0, 40.0])
    s = 2j * np.pi * f
    H = g["J_s"] * g["w_s"]
    expected = (g["J_t"] * s + H**2 / ((g["J_t"] + g["J_i"]) * s + g["d"] + g["c"] / s)) / R**2
    assert abs(system.response(f)).ravel() == pytest.approx(abs(expected), rel=1e-6)
    inertance = abs(system.response(f)).ravel()[0] / abs(s[0])
    assert inertance == pytest.approx((H**2 / g["c"] + g["J_t"]) / R**2, rel=1e-2)


def test_without_a_spring_it_is_one() -> None:
    """A step of speed leaves a force that stays: stiffness H^2/(J_t + J_i)/R^2, for small angles."""
    free: dict[str, Any] = {**GYRO, "c": 0.0, "d": 0.0}
    inerter = machines.GyroInerter(pinion=ia.RackPinion(R=0.05), flywheel=ia.Gyroscope(**free))
    net = ia.Network("strut", frame=ia.Fixed(), inerter=inerter, body=ia.Mass(m=200.0, v=1e-3))
    net.connect(net.frame.flange, net.inerter.flange_a).connect(net.inerter.flange_b, net.body.flange)
    stiffness, added = 1.6**2 / 0.015 / 0.05**2, 0.016 / 0.05**2
    run = net.simulate(1.0, step=1e-3, rtol=1e-9, atol=1e-14)
    rate = np.sqrt(stiffness / (200.0 + added))
    assert run["body.s"] == pytest.approx(1e-3 / rate * np.sin(rate * run.time), abs=1e-7)
