"""Friction in a bearing that a belt presses on: what loads it is a force from beside its site."""

from __future__ import annotations

import inertance as ia
import numpy as np
import pytest
from inertance.components.rotational import Damper, Fixed, IdealGear, Inertia, Spring, SpringDamper, Torque
from inertance.diagnosis.effects.sites import sites_of
from inertance.identification import Campaign, Record
from scipy.integrate import solve_ivp

MU, NOISE = 0.05, 1e-3
TIME = np.arange(0.0, 8.0, 8e-3)


def drive() -> ia.Network:
    net = ia.Network("drive", frame=Fixed(), motor=Torque(), rotor=Inertia(J=4e-3), wheel=Inertia(J=0.01))
    net.add(front=Damper(d=0.01), rear=Damper(d=0.02), belt=SpringDamper(c=20.0, d=0.02))
    net.connect(net.frame.flange, net.front.flange_a, net.rear.flange_a)
    net.connect(net.motor.flange, net.rotor.flange, net.front.flange_b, net.belt.flange_a)
    return net.connect(net.belt.flange_b, net.wheel.flange, net.rear.flange_b)


def measured(seed: int, turning: float) -> Record:
    """Return a record of such a drive whose rear bearing the belt presses on, integrated apart."""
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, 4)

    def torque(t: float) -> float:
        return turning + 0.5 * float(np.sin(2 * np.pi * np.array([0.3, 0.8, 1.7, 3.1]) * t + phase).sum())

    def rates(t: float, y: np.ndarray) -> list[float]:
        twist, w1, w2 = y
        belt = 20.0 * twist + 0.02 * (w1 - w2)
        rear = 0.021 * w2 + MU * abs(belt) * np.tanh(w2 / 0.05)
        return [w1 - w2, (torque(t) - 0.011 * w1 - belt) / 4e-3, (belt - rear) / 0.01]

    found = solve_ivp(rates, (0.0, TIME[-1]), [0.0, 0.0, 0.0], "LSODA", TIME, rtol=1e-8, atol=1e-10).y
    noise = NOISE * np.random.default_rng(seed + 100).standard_normal((2, len(TIME))) * 50
    m = np.array([torque(t) for t in TIME])
    return Record(f"{seed}", TIME, {"m": m, "w1": found[1] + noise[0], "w2": found[2] + noise[1]})


def resting() -> Record:
    noise = NOISE * np.random.default_rng(9).standard_normal((2, len(TIME))) * 50
    return Record("at rest", TIME, {"m": np.zeros(len(TIME)), "w1": noise[0], "w2": noise[1]})


@pytest.mark.parametrize(
    ("turning", "others"), [(0.0, []), (0.9, [resting()])], ids=["to and fro", "on, and one at rest"]
)
def test_friction_by_the_force_of_a_neighbour_is_named_with_it(turning: float, others: list[Record]) -> None:
    moving = [measured(seed, turning) for seed in (1, 2, 3)]
    records = [{"record": record, "initial": "rest"} for record in (*moving[:2], *others, moving[2])]
    channels = {
        "m": {"input": "motor.tau", "unit": "N.m"},
        "w1": {"output": "rotor.w", "unit": "rad/s"},
        "w2": {"output": "wheel.w", "unit": "rad/s"},
    }
    priors = {"front.d": {"rel": 0.2}, "rear.d": {"rel": 0.2}, "belt.c": {"rel": 0.1}}
    found = ia.diagnose(Campaign(drive(), channels, priors, records[:-1], records[-1:]))
    (placed,) = found.effects
    assert placed.key == ("load_dependent_friction", "rear")
    assert placed.values["mu"] == pytest.approx(MU, rel=0.05)
    assert found.to_dict()["effects"][0]["load"].startswith("belt.")
    assert found.closed > 0.97


def test_what_meets_at_a_site_is_told_but_not_what_lies_beside_it() -> None:
    neighbours = {site.path: site.neighbours for site in sites_of(drive())}
    assert neighbours["rear"] == neighbours["front"] == ("belt",)
    assert set(neighbours["belt"]) == {"front", "rear"}


RUB, RATIO = 0.2, 5.0  # of what a gear brings, so large that it matters whether friction takes of it before


def geared(held: bool) -> ia.Network:
    """Return a geared motor whose wheel is held by the ground, or by a far body that is free."""
    net = ia.Network("geared", frame=Fixed(), motor=Torque(), rotor=Inertia(J=2e-3), wheel=Inertia(J=0.08))
    net.add(bearing=Damper(d=4e-3), shaft=SpringDamper(c=60.0, d=0.03), gear=IdealGear(ratio=RATIO))
    net.add(guide=Damper(d=0.15), spiral=Spring(c=4.0))
    far = net.frame if held else net.add(far=Inertia(J=0.3)).far
    net.connect(net.frame.flange, net.bearing.flange_a)
    net.connect(far.flange, net.guide.flange_a, net.spiral.flange_a)
    net.connect(net.motor.flange, net.rotor.flange, net.bearing.flange_b, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.gear.flange_a)
    return net.connect(net.gear.flange_b, net.wheel.flange, net.guide.flange_b, net.spiral.flange_b)


def rubbing(seed: int, left: bool, held: bool) -> Record:
    """Return a record of a drive whose wheel rubs by what the gear brings, or by what that has `left`."""
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, 4)

    def torque(t: float) -> float:
        return 1.2 * float(np.sin(2 * np.pi * np.array([0.3, 0.8, 1.7, 3.1]) * t + phase).sum())

    def rates(t: float, y: np.ndarray) -> list[float]:
        twist, turn, w1, w2, far = y
        shaft = 60.0 * twist + 0.03 * (w1 - RATIO * w2)
        way, brought = np.tanh(w2 / 0.05), RATIO * shaft
        loading = brought / (1 + RUB * way * np.sign(brought)) if left else brought
        spiral = 0.15 * (w2 - far) + 4.0 * turn
        wheel, freed = brought - spiral - RUB * abs(loading) * way, 0.0 if held else spiral / 0.3
        return [w1 - RATIO * w2, w2 - far, (torque(t) - 4e-3 * w1 - shaft) / 2e-3, wheel / 0.08, freed]

    found = solve_ivp(rates, (0.0, TIME[-1]), [0.0] * 5, "LSODA", TIME, rtol=1e-8, atol=1e-10).y[2:4]
    found += (
        3e-3 * np.std(found, axis=1)[:, None] * np.random.default_rng(seed + 100).standard_normal(found.shape)
    )
    return Record(f"{seed}", TIME, {"m": np.array([torque(t) for t in TIME]), "w1": found[0], "w2": found[1]})


@pytest.mark.parametrize(
    ("left", "held", "site"),
    [(False, True, "guide"), (True, True, "gear"), (False, False, "gear"), (True, False, "gear")],
    ids=["before", "after", "before, alone", "after, alone"],
)
def test_what_a_gear_brings_loads_before_or_after_friction_takes_of_it(
    left: bool, held: bool, site: str
) -> None:
    records = [{"record": rubbing(seed, left, held), "initial": "rest"} for seed in (1, 2, 3)]
    channels = {
        "m": {"input": "motor.tau", "unit": "N.m"},
        "w1": {"output": "rotor.w", "unit": "rad/s"},
        "w2": {"output": "wheel.w", "unit": "rad/s"},
    }
    priors = {"bearing.d": {"rel": 0.2}, "shaft.c": {"rel": 0.1}, "guide.d": {"rel": 0.2}}
    found = ia.diagnose(Campaign(geared(held), channels, priors, records[:-1], records[-1:]))
    (placed,) = found.effects
    assert placed.key == ("load_dependent_friction", site)
    assert placed.values["mu"] == pytest.approx(RUB, rel=0.03)
    assert found.equivalent == ()
    assert placed.site.load == ("" if left else "gear.flange_b")
    assert found.to_dict()["effects"][0]["load"] == "gear.flange_b"
    assert found.closed > 0.99
