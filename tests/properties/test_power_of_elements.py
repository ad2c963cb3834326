"""Power balance of elements that store or dissipate, whatever their parameters and the motion of the ends."""

from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from inertance import rotational
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

Array = NDArray[np.float64]
Energy = Callable[[Any, dict[str, float]], Any]
FEW = settings(
    max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow],
    phases=(Phase.explicit, Phase.generate),
)  # fmt: skip
size = st.floats(0.4, 2.5)


def e(run: ia.Result, rest: float = 0.0) -> Array:
    return run["element.s_rel"] - rest


def gas(volume: Array, p: dict[str, float], p_0: float, V_0: float) -> Array:
    return np.asarray(p_0 * V_0 ** p["n"] * volume ** (1 - p["n"]) / (p["n"] - 1))


CURVE = tuple((x, 50 * x + 3e4 * x**3) for x in np.linspace(-0.1, 0.1, 9))
ELEMENTS: dict[str, tuple[Callable[..., ia.Component], dict[str, float], Energy | None]] = {
    "Maxwell": (
        ia.Maxwell, {"k": 500.0, "d": 40.0}, lambda r, p: p["k"] * (e(r) - r["element.z"]) ** 2 / 2,
    ),
    "Zener": (
        ia.Zener, {"k_0": 200.0, "k": 500.0, "d": 40.0},
        lambda r, p: p["k"] * (e(r) - r["element.z"]) ** 2 / 2 + p["k_0"] * e(r) ** 2 / 2,
    ),
    "LuGre": (
        ia.LuGreFriction, {"f_c": 5.0, "f_s": 7.0, "v_s": 0.1, "sigma_0": 2e3, "sigma_1": 2.0},
        lambda r, p: p["sigma_0"] * r["element.z"] ** 2 / 2,
    ),
    "wire rope": (
        ia.WireRope, {"k_1": 100.0, "k_2": 300.0, "k_3": 1e4, "f_y": 4.0, "s_y": 0.01, "n": 2.5},
        lambda r, p: (
            p["k_1"] * e(r) ** 2 / 2 + p["k_2"] * e(r) ** 3 / 3 + p["k_3"] * e(r) ** 4 / 4
            + p["f_y"] * p["s_y"] * r["element.z"] ** 2 / 2
        ),
    ),
    "air spring": (
        ia.AirSpring, {"A": 1e-3, "p_0": 3e5, "V_0": 1e-3, "n": 2.0},
        lambda r, p: gas(p["V_0"] + p["A"] * e(r), p, p["p_0"], p["V_0"]) + 101325 * p["A"] * e(r),
    ),
    "monotube": (
        ia.MonotubeDamper,
        {"A_p": 3e-3, "A_r": 8e-4, "A_e": 4e-5, "A_c": 6e-5, "V_r": 1e-4, "V_0": 2e-3, "p_0": 2e6, "n": 2.0},
        lambda r, p: (
            1.4e9 / p["V_r"] * r["element.q"] ** 2 / 2 + p["p_0"] * r["element.q"]
            + gas(p["V_0"] + (p["A_p"] - p["A_r"]) * e(r) + r["element.q"], p, p["p_0"], p["V_0"])
            + 101325 * (p["A_p"] - p["A_r"]) * e(r)
        ),
    ),
    "rope": (
        ia.Rope, {"k": 500.0, "d": 20.0}, lambda r, p: p["k"] * np.maximum(e(r), 0) ** 2 / 2,
    ),
    "oblique springs": (
        ia.ObliqueSprings, {"k": 300.0, "l_0": 0.06, "a": 0.05},
        lambda r, p: p["k"] * (np.hypot(p["a"], e(r)) - p["l_0"]) ** 2,
    ),
    "fluid inerter": (
        ia.FluidInerter, {"A_p": 1e-3, "D": 0.01, "L": 3.0, "D_h": 0.2, "rho": 900.0, "mu": 0.01},
        lambda r, p: 2 * p["rho"] * p["L"] * (p["A_p"] * r["element.v_rel"] / p["D"]) ** 2 / np.pi,
    ),
    "voice coil, shorted": (
        ia.VoiceCoil, {"Bl": 8.0, "R": 2.0, "L": 0.01}, lambda r, p: p["L"] * r["element.i"] ** 2 / 2,
    ),
    "shunted motor": (
        rotational.ShuntedMotor, {"k": 4.0, "R": 2.0, "L": 0.05, "elastance": 20.0},
        lambda r, p: (p["L"] * r["element.i"] ** 2 + p["elastance"] * r["element.q"] ** 2) / 2,
    ),
    "fractional": (ia.FractionalDamper, {"c": 50.0, "alpha": 0.4, "w_low": 0.1, "decades": 4.0}, None),
    "damper by points": (lambda **_: ia.TabulatedDamper(table=CURVE, interpolation="smooth"), {}, None),
}  # fmt: skip
SHAPES = "n", "alpha"  # exponents, which are not scaled


@pytest.mark.parametrize("name", ELEMENTS)
@FEW
@given(
    scales=st.lists(size, min_size=8, max_size=8), ends=st.tuples(size, size), phases=st.tuples(size, size),
    begin=st.floats(-3.0, 3.0), far=st.floats(0.01, 0.06),
)  # fmt: skip
def test_what_goes_in_is_stored_or_lost(
    name: str,
    scales: list[float],
    ends: tuple[float, float],
    phases: tuple[float, float],
    begin: float,
    far: float,
) -> None:
    kind, values, stored = ELEMENTS[name]
    p = {key: x * (1 if key in SHAPES else s) for (key, x), s in zip(values.items(), scales, strict=False)}
    if name == "monotube":
        p["A_r"] = min(p["A_r"], 0.7 * p["A_p"])
    element = kind(**p)
    turning = isinstance(element, rotational.TwoFlanges)
    kinds, reference = (rotational, "phi_ref") if turning else (ia, "s_ref")
    motions = [
        lambda t, w=5 * w, a=a: far / 2 * (np.sin(w * (t - begin) + a) - np.sin(a))
        for w, a in zip((ends[0], 1.3 * ends[0] + ends[1]), phases, strict=True)
    ]
    drives = {f"drive{n}": kinds.Position(**{reference: motion}) for n, motion in enumerate(motions)}
    net = ia.Network("between", element=element, **drives)
    net.connect(net.drive0.flange, net.element.flange_a).connect(net.element.flange_b, net.drive1.flange)
    inputs = {"element.u": lambda t: 0.0 * t} if "coil" in name else None
    run = net.simulate(begin + 2.0, begin=begin, step=5e-4, rtol=1e-9, atol=1e-12, inputs=inputs)
    force, speed = run["element.tau" if turning else "element.f"], rate(motions, run.time)
    fields = type(element).fields
    loss = run["element.lossPower"] if "lossPower" in fields else 0 * run.time
    kept = cumulative_trapezoid(force * speed - loss, x=run.time, initial=0)
    scale = np.abs(cumulative_trapezoid(np.abs(force * speed), x=run.time, initial=0)).max() + 1e-9
    if stored is None:
        assert kept.min() > -1e-4 * scale  # it began without any
    else:
        energy = stored(run, p)
        assert np.abs(kept - (energy - energy[0])).max() < 1e-3 * scale
    if name != "LuGre":
        assert loss.min() >= -1e-6 * np.abs(loss).max()


def rate(motions: list[Any], t: Array) -> Array:
    h = 1e-6
    first, second = ((motion(t + h) - motion(t - h)) / (2 * h) for motion in motions)
    return np.asarray(second - first)
