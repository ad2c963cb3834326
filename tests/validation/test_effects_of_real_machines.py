"""Effects that measured machines have, named from records that begin in motion, of parameters not known well.

What is measured comes from equations written here, not the library's: bristles after LuGre, a Bouc-Wen loop
of another shape, a clipped amplifier.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from inertance import Damper, Fixed, ForceSensor, Mass, Network, Position, Spring, diagnose, rotational
from inertance.diagnosis import Verdict
from inertance.identification import Campaign, Record
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Law = Callable[[float, float, float], tuple[float, float]]  # (s, v, z) -> force, rate of z
RATE, LEAD, DURATION, NOISE = 200.0, 1.5, 4.0, 0.005
TIME = np.arange(round((LEAD + DURATION) * RATE)) / RATE
SEEN = TIME >= LEAD


class Sines:
    """A sum of sines with random phases, and its derivatives."""

    def __init__(self, seed: int, highest: float, rms: float) -> None:
        rng = np.random.default_rng(seed)
        self.w = 2 * np.pi * rng.uniform(0.4, highest, 10)
        self.phase = rng.uniform(0, 2 * np.pi, 10)
        self.size = rms / np.sqrt(5)

    def __call__(self, t: float | Array, order: int = 0) -> Array:
        angles = np.multiply.outer(t, self.w) + self.phase + order * np.pi / 2
        return np.asarray(self.size * (self.w**order * np.sin(angles)).sum(axis=-1))


def verdict(
    net: Network,
    channels: dict[str, dict[str, str]],
    parameters: list[str],
    measured: Callable[[Sines], Array],
    rms: float,
) -> Verdict:
    """Return the verdict on two records, held against a third of less than their size."""
    records = []
    for seed, share in ((1, 1.0), (2, 1.0), (3, 0.8)):
        drive = Sines(seed, 4.0, share * rms)
        y = measured(drive)[SEEN]
        noise = NOISE * y.std() * np.random.default_rng(seed).standard_normal(len(y))
        record = Record(f"run {seed}", TIME[SEEN] - LEAD, {"u": drive(TIME[SEEN]), "y": y + noise})
        records.append({"record": record})
    priors = {path: {"rel": 0.2} for path in parameters}
    return diagnose(Campaign(net, channels, priors, records[:2], records[2:]))


def moved(law: Law) -> Verdict:
    """Return the verdict on a sled that is moved as prescribed, its force measured: it has no states."""
    net = Network(
        "moved",
        drive=Position(),
        cell=ForceSensor(),
        spring=Spring(k=200.0),
        guide=Damper(d=8.0),
        mass=Mass(m=1.5),
        wall=Fixed(),
    )
    net.connect(net.drive.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.mass.flange, net.spring.flange_b, net.guide.flange_b)
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)

    def measured(drive: Sines) -> Array:
        s, v, a = (drive(TIME, order) for order in range(3))

        def rate(t: float, z: Array) -> list[float]:
            return [law(float(drive(t)), float(drive(t, 1)), z[0])[1]]

        z = solve_ivp(rate, (0, TIME[-1]), [0.0], "LSODA", TIME, rtol=1e-7, atol=1e-9, max_step=4e-3).y[0]
        extra = [law(*point)[0] for point in zip(s, v, z, strict=True)]
        return np.asarray(1.62 * a + 9.5 * v + 185.0 * s + extra)

    channels = {
        "u": {"input": "drive.s_ref", "unit": "m"},
        "y": {"output": "cell.f", "unit": "N"},
    }
    return verdict(net, channels, ["spring.k", "guide.d", "mass.m"], measured, 0.02)


def test_friction_of_bristles_before_it_slips() -> None:
    """LuGre with a Stribeck peak of 10 %, in a model that has no states."""

    def lugre(s: float, v: float, z: float) -> tuple[float, float]:
        level = 1.5 * (1 + 0.1 * np.exp(-((v / 0.01) ** 2)))
        rate = v - 1000.0 * abs(v) / level * z
        return 1000.0 * z + 0.3 * rate, rate

    found = moved(lugre)
    assert [placed.label for placed in found.effects] == ["presliding_friction at guide"]
    assert found.effects[0].values["f_c"] == pytest.approx(1.5, rel=0.1)
    assert found.effects[0].values["s_p"] == pytest.approx(1.5e-3, rel=0.3)
    assert found.closed > 0.93


def test_friction_of_bristles_that_falls_with_speed() -> None:
    """LuGre with twice the friction at rest, as its authors measured it: neither law alone has both."""

    def lugre(s: float, v: float, z: float) -> tuple[float, float]:
        level = 1.0 + 1.0 * np.exp(-((v / 0.02) ** 2))
        rate = v - 1000.0 * abs(v) / level * z
        return 1000.0 * z + 0.3 * rate, rate

    found = moved(lugre)
    assert [placed.label for placed in found.effects] == ["lugre_friction at guide"]
    values = found.effects[0].values
    assert values["f_c"] == pytest.approx(1.0, rel=0.1)
    assert values["f_s"] == pytest.approx(2.0, rel=0.1)
    assert values["v_s"] == pytest.approx(0.02, rel=0.2)
    assert values["s_p"] == pytest.approx(2e-3, rel=0.3)
    assert found.closed > 0.93


def test_hysteresis_that_yields_softly() -> None:
    """A Bouc-Wen loop with n = 1 whose beta and gamma differ."""

    def soft(s: float, v: float, z: float) -> tuple[float, float]:
        return 300.0 * z, v - 0.6 / 0.01 * abs(v) * z - 0.4 / 0.01 * v * abs(z)

    found = moved(soft)
    assert [placed.label for placed in found.effects] == ["hysteresis at guide"]
    assert found.effects[0].values["n"] == pytest.approx(1.0, abs=0.3)
    assert found.closed > 0.93


def shaft(law: Law, limit: float = np.inf) -> Verdict:
    """Return the verdict on a wheel that a torque drives and whose speed is measured."""
    net = Network(
        "shaft",
        motor=rotational.Torque(),
        wheel=rotational.Inertia(J=0.02),
        bearing=rotational.Damper(d=0.05),
        wall=rotational.Fixed(),
    )
    net.connect(net.motor.flange, net.wheel.flange, net.bearing.flange_b)
    net.connect(net.wall.flange, net.bearing.flange_a)

    def measured(drive: Sines) -> Array:
        def rate(t: float, y: Array) -> list[float]:
            force, slip = law(y[0], y[1], y[2])
            torque = np.clip(float(drive(t)), -limit, limit)
            return [y[1], (torque - 0.058 * y[1] - force) / 0.0215, slip]

        options: Any = {"rtol": 1e-7, "atol": 1e-9, "max_step": 4e-3}
        return np.asarray(solve_ivp(rate, (0, TIME[-1]), np.zeros(3), "LSODA", TIME, **options).y[1])

    channels = {
        "u": {"input": "motor.tau", "unit": "N.m"},
        "y": {"output": "wheel.w", "unit": "rad/s"},
    }
    return verdict(net, channels, ["bearing.d", "wheel.J"], measured, 0.5)


def test_an_amplifier_at_its_limit() -> None:
    found = shaft(lambda s, v, z: (0.0, 0.0), limit=0.7)
    assert [placed.label for placed in found.effects] == ["actuator_saturation at u"]
    assert found.effects[0].values["limit"] == pytest.approx(0.7, rel=0.02)
    assert found.effects[0].values["share"] == pytest.approx(1.0, rel=0.05)
    assert found.closed > 0.95


def test_an_arm_that_hangs() -> None:
    """A servo turns it by a spring; its angle is counted from 0.4 rad beside where it hangs."""
    net = Network(
        "servo",
        drive=rotational.Position(),
        spring=rotational.Spring(c=4.0),
        guide=rotational.Damper(d=0.06),
        arm=rotational.Inertia(J=0.01),
        wall=rotational.Fixed(),
    )
    net.connect(net.drive.flange, net.spring.flange_a).connect(net.wall.flange, net.guide.flange_a)
    net.connect(net.spring.flange_b, net.arm.flange, net.guide.flange_b)

    def measured(drive: Sines) -> Array:
        def rate(t: float, y: Array) -> list[float]:
            torque = 3.6 * (float(drive(t)) - y[0]) - 0.07 * y[1] - 0.4 * np.sin(y[0] + 0.4)
            return [y[1], torque / 0.0112]

        options: Any = {"rtol": 1e-7, "atol": 1e-9, "max_step": 4e-3}
        return np.asarray(solve_ivp(rate, (0, TIME[-1]), np.zeros(2), "LSODA", TIME, **options).y[0])

    channels = {
        "u": {"input": "drive.phi_ref", "unit": "rad"},
        "y": {"output": "arm.phi", "unit": "rad"},
    }
    found = verdict(net, channels, ["spring.c", "guide.d", "arm.J"], measured, 0.5)
    assert [placed.label for placed in found.effects] == ["arm_gravity at guide"]
    tau_sin, tau_cos = found.effects[0].values.values()
    # From angle to angle all torques may be larger by one factor: records tell them beside the spring's only.
    assert np.hypot(tau_sin, tau_cos) / found.parameters["spring.c"] == pytest.approx(0.4 / 3.6, rel=0.02)
    assert np.arctan2(tau_cos, tau_sin) == pytest.approx(0.4, abs=0.05)
    assert found.closed > 0.95


def test_nothing_of_all_this() -> None:
    assert shaft(lambda s, v, z: (0.0, 0.0)).verdict == "parameters"
    assert moved(lambda s, v, z: (0.0, 0.0)).verdict == "parameters"
