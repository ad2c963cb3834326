"""Springs, dampers and friction with memory, against integrations of their laws by SciPy, and their energy.

Both flanges move, away from rest, from t = 1 s on: f v_rel goes into what is stored or lost.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import gamma
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from numpy.typing import NDArray
from scipy.integrate import cumulative_simpson, solve_ivp

Array = NDArray[np.float64]
BEGIN, STOP = 1.0, 3.0
SIZE = 0.01


def one(t: Any) -> Any:
    return 0.4 * SIZE * np.sin(5 * t + 1)


def other(t: Any) -> Any:
    return SIZE * (np.sin(9 * t) + 0.3 * np.cos(23 * t))


def stretch(t: Any) -> Any:
    return other(t) - one(t)


def rate(t: Any) -> Any:
    return SIZE * (9 * np.cos(9 * t) - 0.3 * 23 * np.sin(23 * t) - 0.4 * 5 * np.cos(5 * t + 1))


def between_moving_flanges(element: ia.Component, turning: bool = False) -> ia.Network:
    kind, reference = (rotational, "phi_ref") if turning else (ia, "s_ref")
    ends = {"left": kind.Position(**{reference: one}), "right": kind.Position(**{reference: other})}
    net = ia.Network("between", element=element, **ends)
    net.connect(net.left.flange, net.element.flange_a)
    return net.connect(net.element.flange_b, net.right.flange)


@dataclass
class Law:
    """A law written apart: states, their rates, the force, and the energy stored."""

    element: ia.Component
    states: dict[str, float]
    rates: Callable[..., Any]
    force: Callable[..., Any]
    stored: Callable[..., Any] | None = None
    inputs: dict[str, Any] | None = None


def sgn_power(z: Any, n: float) -> Any:
    return np.sign(z) * np.abs(z) ** n


def wen(v: Any, z: Any, a: float, beta: float, gamma: float, n: float) -> Any:
    return a * v - beta * np.abs(v) * sgn_power(z, n) - gamma * v * np.abs(z) ** n


def lugre(v: Any, z: Any) -> Any:
    return v - 2e4 * np.abs(v) * z / (20 + 10 * np.exp(-((v / 0.02) ** 2)))


FLUID: dict[str, Any] = {
    "A_p": 1e-3,
    "D": 0.012,
    "L": 4.0,
    "D_h": 0.2,
    "rho": 800.0,
    "mu": 0.002,
    "zeta": 1.0,
    "L_p": 0.3,
}


def gas_pressure(e: Any, q: Any) -> Any:
    return 2e6 * (1e-4 / (1e-4 + 2e-4 * e + q)) ** 1.3


def flow(e: Any, q: Any) -> Any:
    dp = 2e6 + 1.4e9 * q / 1e-4 - gas_pressure(e, q)
    size = 0.7 * np.where(dp > 0, 4e-6, 1e-5) * np.sqrt(2 / 860.0)
    return size * dp / np.sqrt(np.sqrt(dp**2 + 1e3**2))


def gas_energy(e: Any, q: Any) -> Any:
    volume = 1e-4 + 2e-4 * e + q
    return 2e6 * 1e-4**1.3 * volume**-0.3 / 0.3 + 101325.0 * 2e-4 * e


SINE: Any = lambda t: 1 + np.sin(4 * t)  # noqa: E731
MR: dict[str, Any] = {
    "alpha_a": 14e3, "alpha_b": 69.5e3, "c_0a": 2100.0, "c_0b": 350.0, "k_0": 4690.0, "eta": 190.0,
    "A": 301.0, "beta": 3.63e6, "gamma": 3.63e6,
}  # fmt: skip


def spencer_rates(t: Any, e: Any, v: Any, i: Any, z: Any, y: Any) -> Any:
    c_0, c_1, alpha = 2100 + 350 * i, 28300 + 295 * i, 14e3 + 69.5e3 * i
    y_dot = (alpha * z + c_0 * v + 4690 * (e - y)) / (c_0 + c_1)
    return [190 * (SINE(t) - i), wen(v - y_dot, z, 301, 3.63e6, 3.63e6, 2), y_dot]


LAWS = {
    "Maxwell": Law(
        ia.Maxwell(k=3e3, d=200.0, s_rel0=0.002),
        {"z": 0.001},
        lambda t, e, v, z: [3e3 * (e - 0.002 - z) / 200],
        lambda t, e, v, z: 3e3 * (e - 0.002 - z),
        lambda e, v, z: 1.5e3 * (e - 0.002 - z) ** 2,
    ),
    "Zener": Law(
        ia.Zener(k_0=1e3, k=3e3, d=200.0, s_rel0=-0.003),
        {"z": 0.0},
        lambda t, e, v, z: [3e3 * (e + 0.003 - z) / 200],
        lambda t, e, v, z: 1e3 * (e + 0.003) + 3e3 * (e + 0.003 - z),
        lambda e, v, z: 1.5e3 * (e + 0.003 - z) ** 2 + 500 * (e + 0.003) ** 2,
    ),
    "LuGre": Law(
        ia.LuGreFriction(f_c=20.0, f_s=30.0, v_s=0.02, sigma_0=2e4, sigma_1=30.0, sigma_2=5.0),
        {"z": 2e-4},
        lambda t, e, v, z: [lugre(v, z)],
        lambda t, e, v, z: 2e4 * z + 30 * lugre(v, z) + 5 * v,
        lambda e, v, z: 1e4 * z**2,
    ),
    "turning LuGre": Law(
        rotational.LuGreFriction(tau_c=20.0, tau_s=30.0, w_s=0.02, sigma_0=2e4, sigma_1=30.0, sigma_2=5.0),
        {"z": 0.0},
        lambda t, e, v, z: [lugre(v, z)],
        lambda t, e, v, z: 2e4 * z + 30 * lugre(v, z) + 5 * v,
        lambda e, v, z: 1e4 * z**2,
    ),
    "wire rope": Law(
        ia.WireRope(k_1=1e3, k_2=2e4, k_3=3e6, f_y=15.0, s_y=0.002, n=1.5, share=0.8),
        {"z": -0.3},
        lambda t, e, v, z: [wen(v, z, 1, 0.8, 0.2, 1.5) / 0.002],
        lambda t, e, v, z: 1e3 * e + 2e4 * e**2 + 3e6 * e**3 + 15 * z,
        lambda e, v, z: 500 * e**2 + 2e4 * e**3 / 3 + 3e6 * e**4 / 4 + 15 * 0.002 * z**2 / 2,
    ),
    "Bouc-Wen damper": Law(
        ia.BoucWenDamper(**MR, s_rel0=0.001),
        {"i": 0.2, "z": 0.0},
        lambda t, e, v, i, z: [190 * (SINE(t) - i), wen(v, z, 301, 3.63e6, 3.63e6, 2)],
        lambda t, e, v, i, z: (14e3 + 69.5e3 * i) * z + (2100 + 350 * i) * v + 4690 * (e - 0.001),
        inputs={"element.u": SINE},
    ),
    "Spencer damper": Law(
        ia.SpencerDamper(**MR, c_1a=28.3e3, c_1b=295.0, k_1=500.0, s_rel0=0.143),
        {"i": 0.0, "z": 1e-3, "y": 0.002},
        spencer_rates,
        lambda t, e, v, i, z, y: (
            (28300 + 295 * i) * spencer_rates(t, e, v, i, z, y)[2] + 500 * (e - 0.143)
        ),
        inputs={"element.u": SINE},
    ),
    "air spring": Law(
        ia.AirSpring(A=2e-3, p_0=5e5, V_0=1e-4, n=1.3, s_rel0=0.002),
        {},
        lambda t, e, v: [],
        lambda t, e, v: -2e-3 * (5e5 * (1e-4 / (1e-4 + 2e-3 * (e - 0.002))) ** 1.3 - 101325.0),
        lambda e, v: 5e5 * 1e-4**1.3 * (1e-4 + 2e-3 * (e - 0.002)) ** -0.3 / 0.3 + 101325.0 * 2e-3 * e,
    ),
    "monotube": Law(
        ia.MonotubeDamper(A_p=1e-3, A_r=8e-4, A_e=4e-6, A_c=1e-5, V_r=1e-4, V_0=1e-4, p_0=2e6, n=1.3),
        {"q": 0.0},
        lambda t, e, v, q: [8e-4 * v - flow(e, q)],
        lambda t, e, v, q: (
            8e-4 * (2e6 + 1.4e9 * q / 1e-4) - 1e-3 * gas_pressure(e, q) + 2e-4 * 101325.0
        ),
        lambda e, v, q: 1.4e9 / 1e-4 * q**2 / 2 + 2e6 * q + gas_energy(e, q),
    ),
    "rope": Law(
        ia.Rope(k=4e3, d=60.0, s_rel0=-0.002),
        {},
        lambda t, e, v: [],
        lambda t, e, v: np.where(e > -0.002, np.clip(4e3 * (e + 0.002) + 60 * v, 0, 8e3 * (e + 0.002)), 0),
        lambda e, v: 2e3 * np.maximum(e + 0.002, 0) ** 2,
    ),
    "oblique springs": Law(
        ia.ObliqueSprings(k=2e3, l_0=0.05, a=0.04),
        {},
        lambda t, e, v: [],
        lambda t, e, v: 2 * 2e3 * (np.hypot(0.04, e) - 0.05) * np.sin(np.arctan2(e, 0.04)),
        lambda e, v: 2e3 * (np.hypot(0.04, e) - 0.05) ** 2,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", LAWS)
def test_follows_its_law_and_keeps_its_energy(name: str) -> None:
    law = LAWS[name]
    turning = isinstance(law.element, rotational.TwoFlanges)
    run = between_moving_flanges(law.element, turning).simulate(
        STOP, begin=BEGIN, step=2e-4, rtol=1e-9, atol=1e-12, inputs=law.inputs,
        start={f"element.{state}": value for state, value in law.states.items()},
    )  # fmt: skip
    t = run.time
    e, v = stretch(t), rate(t)
    states: Any = []
    if law.states:
        apart = solve_ivp(
            lambda t, y: law.rates(t, stretch(t), rate(t), *y), (BEGIN, STOP), list(law.states.values()),
            method="LSODA", rtol=1e-10, atol=1e-14, t_eval=np.minimum(t, STOP), max_step=1e-3,
        )  # fmt: skip
        states = list(apart.y)
    expected = law.force(t, e, v, *states)
    force = run["element.tau" if turning else "element.f"]
    assert force == pytest.approx(expected, abs=2e-5 * np.abs(expected).max())
    if law.stored is None:
        return
    loss = run["element.lossPower"] if "lossPower" in type(law.element).fields else 0 * t
    balance = cumulative_simpson(force * v - loss, x=t, initial=0)
    kept = law.stored(e, v, *states)
    assert balance == pytest.approx(kept - kept[0], abs=1e-4 * np.ptp(kept) + 1e-12)
    if loss.any():
        assert cumulative_simpson(loss, x=t, initial=0)[-1] > 0.05 * np.ptp(kept)


def test_liquid_in_a_coil() -> None:
    """Force and loss of the fluid inerter, laminar at reversals and turbulent between."""
    run = between_moving_flanges(ia.FluidInerter(**FLUID)).simulate(STOP, begin=BEGIN, step=1e-3)
    t = run.time
    area = np.pi * 0.012**2 / 4
    u = rate(t) * 1e-3 / area
    reynolds = np.maximum(800 * np.abs(u) * 0.012 / 0.002, 1e-9)
    factor = np.maximum(64 / reynolds, 0.304 * reynolds**-0.25 + 0.029 * np.sqrt(0.012 / 0.2))
    assert 64 / reynolds.max() < 0.5 * factor[np.argmax(reynolds)]  # turbulent
    assert np.sum(64 / reynolds >= factor) > 20  # laminar
    drop = 800 / 2 * u * np.abs(u) * (factor * 4.0 / 0.012 + 1.0)
    acceleration = SIZE * (-81 * np.sin(9 * t) - 0.3 * 529 * np.cos(23 * t) + 0.4 * 25 * np.sin(5 * t + 1))
    inertance = 800 * 4.0 * 1e-6 / area + 800 * 1e-3 * 0.3
    expected = inertance * acceleration + 1e-3 * drop
    assert run["element.f"] == pytest.approx(expected, rel=1e-6, abs=1e-6 * np.abs(expected).max())
    assert run["element.lossPower"] == pytest.approx(1e-3 * drop * rate(t), abs=1e-6)


def test_momentum_of_an_inerter_that_changes_is_kept() -> None:
    """Two bodies coast, joined by an inerter whose inertance falls: p + m_r v_rel stays."""
    net = ia.Network("coasting", one=ia.Mass(m=2.0), two=ia.Mass(m=3.0, v=1.0))
    net.add(inerter=ia.VariableInerter(b=4.0, b_u=-3.0, T=0.1))
    net.connect(net.one.flange, net.inerter.flange_a).connect(net.inerter.flange_b, net.two.flange)
    inputs = {"inerter.u": lambda t: 0.5 * (t - 0.5)}
    run = net.simulate(2.0, begin=0.5, inputs=inputs, rtol=1e-9, start={"inerter.x": 0.2})
    b = 4.0 - 3.0 * run["inerter.x"]
    momentum = (b + 2 * 3 / 5) * run["inerter.v_rel"]
    assert momentum == pytest.approx(np.full(len(momentum), momentum[0]), rel=1e-6)
    assert np.ptp(b) > 1.0


@pytest.mark.parametrize("alpha", [0.2, 0.5, 0.9])
def test_rubber_of_fractional_order(alpha: float) -> None:
    """Its dynamic stiffness, linearised, against (j w)^alpha; its told error against what it is."""
    rubber = ia.FractionalDamper(c=2e3, alpha=alpha, w_low=0.1, decades=5.0, n=10)
    net = ia.Network("shaken", wall=ia.Fixed(), rubber=rubber, drive=ia.Position())
    net.connect(net.wall.flange, net.rubber.flange_a).connect(net.rubber.flange_b, net.drive.flange)
    system = ia.analysis.linearise(net, ["drive.s_ref"], ["rubber.f"])
    w = np.geomspace(0.1, 1e4, 400)
    stiffness = system.response(w / (2 * np.pi))[:, 0, 0]
    off = np.abs(stiffness / (2e3 * (1j * w) ** alpha) - 1)
    middle = (w > 0.1 * 1e5**0.25) & (w < 0.1 * 1e5**0.75)
    assert off[middle].max() == pytest.approx(rubber.error(), rel=0.05)
    assert off.max() == pytest.approx(rubber.error(1.0), rel=0.05)
    assert rubber.error() < 0.06


def test_rubber_of_fractional_order_keeps_its_energy() -> None:
    """What is stored, by stiffnesses from a limit at each pole of the product of zeros and poles."""
    rubber = ia.FractionalDamper(c=2e3, alpha=0.4, w_low=1e-2, decades=7.0, n=5)
    run = between_moving_flanges(rubber).simulate(STOP, begin=BEGIN, step=2e-4, rtol=1e-9, atol=1e-12)
    zeros, poles = (1e-2 * 1e7 ** ((np.arange(5) + 0.5 + sign * 0.2) / 5) for sign in (-1, 1))

    def transfer(s: float) -> float:
        return float(2e3 * 1e5**0.4 * np.prod(s + zeros) / np.prod(s + poles))

    e = stretch(run.time)
    stored = transfer(0.0) * e**2 / 2
    for i, pole in enumerate(poles, start=1):
        tiny = 1e-7 * pole
        stiffness = transfer(-pole + tiny) * tiny / -pole
        assert stiffness > 0
        stored += stiffness * (e - run[f"element.branch{i}.z"]) ** 2 / 2
    assert run["element.lossPower"].min() >= 0
    flow = run["element.f"] * rate(run.time) - run["element.lossPower"]
    settled = run.time > BEGIN + 1e-3
    balance = cumulative_simpson(flow[settled], x=run.time[settled], initial=0)
    kept = stored[settled]
    assert balance == pytest.approx(kept - kept[0], abs=2e-3 * np.ptp(kept))


def test_rubber_of_fractional_order_relaxes_by_a_power() -> None:
    rubber = ia.FractionalDamper(c=2e3, alpha=0.4, w_low=1e-2, decades=7.0, n=14)
    net = ia.Network("relaxing", wall=ia.Fixed(), rubber=rubber, end=ia.Position(s_ref=0.01))
    net.connect(net.wall.flange, net.rubber.flange_a).connect(net.rubber.flange_b, net.end.flange)
    run = net.simulate(1.0, step=0.01, rtol=1e-9)
    later = run.time > 0.005
    expected = 2e3 * 0.01 * run.time[later] ** -0.4 / gamma(0.6)
    assert run["rubber.f"][later] == pytest.approx(expected, rel=0.02)


def test_a_share_that_cannot_be_is_told() -> None:
    rubber = ia.FractionalDamper(c=2e3, alpha=0.4, w_low=10.0, decades=2.0)
    with pytest.raises(ia.ModelError, match=r"share must be from 0\.001 to 1"):
        rubber.error(2.0)
