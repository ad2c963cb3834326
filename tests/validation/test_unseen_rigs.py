"""Diagnosis of rigs it was not made for: carts, a Duffing oscillator, a friction damper with clearance.

What is measured comes from equations written here and integrated by SciPy; the library sees records only.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
from inertance import CoulombFriction, Damper, Fixed, Force, Mass, Network, Spring, diagnose
from inertance.diagnosis import Verdict
from inertance.identification import Campaign, Record
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Motion = Callable[[float, Array, float], list[float]]
RATE = 200.0


def random_push(rng: np.random.Generator, rms: float, highest: float, time: Array) -> Array:
    duration = len(time) / RATE
    lines = np.arange(1, round(highest * duration))
    angles = 2 * np.pi * (lines[:, None] * time / duration + rng.random(len(lines))[:, None])
    push: Array = np.sin(angles).sum(axis=0)
    push *= rms / push.std()
    return push


def measured(
    motion: Motion,
    order: int,
    outputs: dict[str, int],
    rms: float,
    highest: float,
    noise: float,
    duration: float = 5.0,
) -> dict[str, list[dict[str, object]]]:
    """Return two training records and a test record of a machine that starts from rest."""
    found: dict[str, list[dict[str, object]]] = {"train": [], "test": []}
    time = np.arange(round(duration * RATE)) / RATE
    for seed in range(3):
        rng = np.random.default_rng(seed)
        push = random_push(rng, rms, highest, time)
        force = partial(np.interp, xp=time, fp=push)
        run = solve_ivp(
            partial(_pushed, motion, force),
            (0.0, time[-1]),
            np.zeros(order),
            "LSODA",
            t_eval=time,
            rtol=1e-7,
            atol=1e-10,
            max_step=1 / RATE,
        )
        values = {name: run.y[row] for name, row in outputs.items()}
        noisy = {name: v + noise * v.std() * rng.standard_normal(len(v)) for name, v in values.items()}
        record = Record(f"run {seed + 1}", time, {"u": push, **noisy})
        found["test" if seed == 2 else "train"].append({"record": record, "initial": "rest"})
    return found


def _pushed(motion: Motion, force: Callable[[float], float], t: float, y: Array) -> list[float]:
    return motion(t, y, float(force(t)))


def verdict(
    model: Network,
    outputs: dict[str, str],
    parameters: list[str],
    records: dict[str, list[dict[str, object]]],
) -> Verdict:
    channels = {"u": {"input": "push.f", "unit": "N"}}
    channels |= {name: {"output": path, "unit": "m"} for name, path in outputs.items()}
    priors = {path: {"rel": 0.2} for path in parameters}
    campaign = Campaign(
        model, channels=channels, parameters=priors, train=records["train"], test=records["test"]
    )
    return diagnose(campaign)


def sign(speed: float, slow: float) -> float:
    return float(np.tanh(speed / slow))


def test_friction_damper_with_clearance() -> None:
    """A friction damper that begins to rub after half a millimetre of play, modelled without play.

    It takes longest of all, so it is not the last of all, for which another process would wait.
    """
    stiff, oil, play = 2e5, 60.0, 0.5e-3

    def motion(_: float, y: Array, push: float) -> list[float]:
        s, v, r = y
        gap = s - r
        # The slider r has no mass: it follows the flank when it is pressed by more than its friction.
        press = stiff * (gap - np.clip(gap, -play, play))
        held = 4.0 * np.clip(press / 4.0, -1.0, 1.0)
        return [v, (push - 3000.0 * s - 6.0 * v - held) / 2.0, (press - held) / oil]

    records = measured(motion, 3, {"s": 0}, 12.0, 12.0, 0.005, duration=6.0)
    net = Network(
        "damped",
        wall=Fixed(),
        spring=Spring(k=2800.0),
        loss=Damper(d=5.0),
        slider=CoulombFriction(f_c=3.5),
        mass=Mass(m=2.0),
        push=Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.loss.flange_a, net.slider.flange_a)
    net.connect(net.spring.flange_b, net.loss.flange_b, net.slider.flange_b, net.mass.flange, net.push.flange)
    found = verdict(net, {"s": "mass.s"}, ["spring.k", "loss.d", "slider.f_c"], records)
    assert found.verdict == "effect"
    assert [placed.label for placed in found.effects] == ["backlash at slider"]
    assert found.effects[0].values["eps"] == pytest.approx(play, rel=0.15)
    assert found.closed > 0.9


def test_carts_of_which_one_rubs() -> None:
    """Two carts in line; the second one rubs on its rail."""

    def motion(_: float, y: Array, push: float) -> list[float]:
        s1, s2, v1, v2 = y
        between = 500.0 * (s2 - s1) + 3.0 * (v2 - v1)
        first = push - 900.0 * s1 - 4.0 * v1 + between
        return [v1, v2, first / 1.1, (-between - 0.35 * sign(v2, 1e-4)) / 0.75]

    records = measured(motion, 4, {"s1": 0, "s2": 1}, 4.0, 8.0, 0.005)
    net = Network(
        "carts",
        wall=Fixed(),
        anchor=Spring(k=1000.0),
        rail=Damper(d=5.0),
        first=Mass(m=1.0),
        link=Spring(k=450.0),
        buffer=Damper(d=3.0),
        second=Mass(m=0.8),
        push=Force(),
    )
    net.connect(net.wall.flange, net.anchor.flange_a, net.rail.flange_a)
    net.connect(net.anchor.flange_b, net.rail.flange_b, net.first.flange, net.push.flange)
    net.connect(net.first.flange, net.link.flange_a, net.buffer.flange_a)
    net.connect(net.link.flange_b, net.buffer.flange_b, net.second.flange)
    parameters = ["anchor.k", "rail.d", "link.k", "buffer.d", "first.m", "second.m"]
    found = verdict(net, {"s1": "first.s", "s2": "second.s"}, parameters, records)
    assert found.verdict == "effect"
    assert [placed.label for placed in found.effects] == ["coulomb_friction at second"]
    assert found.effects[0].values["f_c"] == pytest.approx(0.35, rel=0.05)
    assert found.closed > 0.95


def test_duffing_oscillator() -> None:
    """A spring that hardens, modelled as linear."""

    def motion(_: float, y: Array, push: float) -> list[float]:
        s, v = y
        return [v, (push - 1.8 * v - 180.0 * s - 4e5 * s**3) / 1.2]

    records = measured(motion, 2, {"s": 0}, 1.0, 5.0, 0.005)
    net = Network(
        "oscillator",
        wall=Fixed(),
        spring=Spring(k=200.0),
        damper=Damper(d=1.5),
        mass=Mass(m=1.2),
        push=Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    found = verdict(net, {"s": "mass.s"}, ["spring.k", "damper.d", "mass.m"], records)
    assert found.verdict == "effect"
    assert [placed.effect.kind for placed in found.effects] == ["cubic_stiffness"]
    assert found.effects[0].values["k3"] == pytest.approx(4e5, rel=0.03)
    assert found.closed > 0.95
