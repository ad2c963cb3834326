"""Rubber that relaxes, eddy currents that brake, springs that pull other than they push, named from records.

What is measured comes from equations written here; the models know nothing of it, and stiffness, damping and
mass are up to 9 % off. Records begin in motion.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from inertance import Damper, Fixed, Force, Mass, Network, Spring, diagnose, rotational
from inertance.diagnosis import Verdict
from inertance.diagnosis.effects.effect import effect_of
from inertance.identification import Campaign, Record
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Law = Callable[[float, float, float], tuple[float, float]]  # (s, v, z) -> force, rate of z
RATE, LEAD, DURATION, NOISE = 200.0, 1.5, 5.0, 0.004
TIME = np.arange(round((LEAD + DURATION) * RATE)) / RATE
SEEN = TIME >= LEAD


def sines(seed: int, rms: float) -> Callable[[float | Array], Any]:
    rng = np.random.default_rng(seed)
    w, phase = 2 * np.pi * rng.uniform(0.3, 4.0, 10), rng.uniform(0, 2 * np.pi, 10)
    return lambda t: rms / np.sqrt(5) * np.sin(np.multiply.outer(t, w) + phase).sum(axis=-1)


def told(net: Network, channels: Any, parameters: list[str], rates: Any, row: int, rms: float) -> Verdict:
    """Return the verdict on three records, the third held against the others' fit."""
    records = []
    for seed, share in ((11, 1.0), (12, 0.8), (13, 0.9)):
        drive = sines(seed, share * rms)
        options: Any = {"rtol": 1e-8, "atol": 1e-10, "max_step": 4e-3}
        y = solve_ivp(
            lambda t, y, u=drive: rates(u(t), y), (0, TIME[-1]), np.zeros(3), "LSODA", TIME, **options
        )
        x = y.y[row][SEEN]
        noise = NOISE * x.std() * np.random.default_rng(seed).standard_normal(len(x))
        record = Record(f"run {seed}", TIME[SEEN] - LEAD, {"u": drive(TIME[SEEN]), "y": x + noise})
        records.append({"record": record})
    priors = {path: {"rel": 0.2} for path in parameters}
    return diagnose(Campaign(net, channels, priors, records[:2], records[2:]))


def mount(law: Law, rms: float = 12.0) -> Verdict:
    """Return the verdict on a mass on a spring and a damper, pushed, its place measured."""
    net = Network(
        "mount", wall=Fixed(), spring=Spring(k=220.0), damper=Damper(d=3.0), mass=Mass(m=1.0), push=Force()
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)

    def rates(u: float, y: Array) -> list[float]:
        force, rate = law(y[0], y[1], y[2])
        return [y[1], (u - 205.0 * y[0] - 2.8 * y[1] - force) / 1.06, rate]

    channels = {"u": {"input": "push.f", "unit": "N"}, "y": {"output": "mass.s", "unit": "m"}}
    return told(net, channels, ["spring.k", "damper.d", "mass.m"], rates, 0, rms)


def spindle(law: Law) -> Verdict:
    """Return the verdict on a wheel with a bearing, driven, its speed measured."""
    net = Network(
        "spindle",
        motor=rotational.Torque(),
        wheel=rotational.Inertia(J=0.02),
        bearing=rotational.Damper(d=0.02),
        wall=rotational.Fixed(),
    )
    net.connect(net.motor.flange, net.wheel.flange, net.bearing.flange_b)
    net.connect(net.wall.flange, net.bearing.flange_a)

    def rates(u: float, y: Array) -> list[float]:
        torque, rate = law(y[0], y[1], y[2])
        return [y[1], (u - 0.021 * y[1] - torque) / 0.0213, rate]

    channels = {"u": {"input": "motor.tau", "unit": "N.m"}, "y": {"output": "wheel.w", "unit": "rad/s"}}
    return told(net, channels, ["bearing.d", "wheel.J"], rates, 1, 1.0)


def labels(found: Verdict) -> list[str]:
    return [placed.label for placed in found.effects]


@pytest.mark.parametrize(("k", "T"), [(150.0, 0.08), (60.0, 0.3)])
def test_rubber_relaxes(k: float, T: float) -> None:
    """By its force z, which grows with what it is stretched and fades: z' = k v - z/T."""
    found = mount(lambda s, v, z: (z, k * v - z / T))
    assert labels(found) == ["relaxation at damper"]
    assert found.effects[0].values["d"] == pytest.approx(k * T, rel=0.1)
    assert found.effects[0].values["T"] == pytest.approx(T, rel=0.15)
    assert found.closed > 0.93


def test_a_coupling_that_relaxes() -> None:
    """A wheel held by rubber alone, by the stretch of its damper."""
    found = spindle(lambda s, v, z: (1.5 * (s - z), (s - z) / 0.12))
    assert labels(found) == ["relaxation at bearing"]
    assert found.effects[0].values["d"] == pytest.approx(1.5 * 0.12, rel=0.1)
    assert found.effects[0].values["T"] == pytest.approx(0.12, rel=0.15)


def test_a_brake_by_eddy_currents() -> None:
    """Currents that lag: the drag of a conducting sheet, v_c/(v^2 + v_c^2) of its induced field."""
    found = spindle(lambda s, v, z: (0.6 * 6.0 * v / (v**2 + 6.0**2) * 2, 0.0))
    assert labels(found) == ["eddy_current_damping at bearing"]
    assert found.effects[0].values["w_nominal"] == pytest.approx(6.0, rel=0.1)
    assert found.effects[0].values["d"] == pytest.approx(2 * 0.6 / 6.0, rel=0.1)


def test_a_spring_that_hardens_about_a_preload() -> None:
    """Cubic from where it is slack, 0.4 m away: it pulls other than it pushes, and hardens a little.

    The other way round it is the mirror image, and no bound of what may be found is in the way.
    """
    rest, k3 = -0.4, 400.0
    for quantity in (q for each in effect_of("quadratic_stiffness").quantities.values() for q in each):
        assert quantity.low == -np.inf
    found = mount(lambda s, v, z: (k3 * ((s + rest) ** 3 - rest**3), 0.0), 20.0)
    assert labels(found) == ["quadratic_stiffness at damper", "cubic_stiffness at damper"]
    assert found.effects[0].values["k2"] == pytest.approx(3 * k3 * rest, rel=0.1)
    assert found.effects[1].values["k3"] == pytest.approx(k3, rel=0.3)


def test_what_is_like_them_keeps_its_name() -> None:
    """What hardens alike both ways does so, too: see the Duffing oscillator of test_unseen_rigs."""
    assert mount(lambda s, v, z: (0.0, 0.0)).verdict == "parameters"
    assert spindle(lambda s, v, z: (0.0, 0.0)).verdict == "parameters"
    assert labels(spindle(lambda s, v, z: (0.1 * np.arcsinh(v / 1.5), 0.0))) == [
        "shear_thinning_damping at bearing"
    ]
