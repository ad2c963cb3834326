"""Runs that go on when told, with inputs set on the way."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest
from inertance import (
    CoulombFriction,
    Fixed,
    Force,
    Mass,
    Network,
    Polynomial,
    Position,
    SimulationError,
    Spring,
    Stepwise,
    SupportFriction,
)


def test_pieces_of_a_force_make_the_motion_of_the_whole() -> None:
    net = Network("pushed", push=Force(), mass=Mass(m=2.0))
    net.connect(net.push.flange, net.mass.flange)
    run = Stepwise(net.dae(), 0.0, 1.0, {"push.f": Polynomial(2)}, {"push.f": [0.0]})
    for end in np.linspace(0.1, 1.0, 10):
        t = run.time
        run.set({"push.f": [t**2, 2 * t, 1.0]})
        run.advance(float(end))
    result = run.result()
    assert np.allclose(result.time, np.linspace(0, 1, 11))
    assert np.allclose(result["mass.s"], result.time**4 / 24, atol=1e-6)
    assert run.observe([("mass.s", 0), ("mass.s", 1), ("mass.s", 2), ("push.f", 1)]) == pytest.approx(
        [1 / 24, 1 / 6, 1 / 2, 2.0], rel=1e-4
    )


def test_a_prescribed_motion_follows_its_cubics() -> None:
    net = Network("driven", drive=Position(), spring=Spring(k=100.0), mass=Mass(m=1.0))
    net.connect(net.drive.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    run = Stepwise(net.dae(), 0.0, 1.0, {"drive.s_ref": Polynomial(3)}, {"drive.s_ref": [0.0, 1.0]})
    for k in range(1, 101):
        t = run.time
        sine, cosine = np.sin(t), np.cos(t)
        run.set({"drive.s_ref": [sine, cosine, -sine / 2, -cosine / 6]})
        run.advance(k / 100)
    whole = net.simulate(1.0, step=0.01, inputs={"drive.s_ref": np.sin}, start={"mass.v": 0.0}, rtol=1e-9)
    assert np.abs(run.result()["mass.s"] - whole["mass.s"]).max() < 1e-4


def test_a_break_away_within_a_piece_is_located() -> None:
    rub = SupportFriction(friction=CoulombFriction(f_c=1.0))
    net = Network("stuck", push=Force(), rub=rub, mass=Mass(m=1.0), wall=Fixed())
    net.connect(net.push.flange, net.rub.flange, net.mass.flange)
    net.connect(net.rub.support, net.wall.flange)
    run = Stepwise(net.dae(), 0.0, 1.0, {"push.f": Polynomial(1)}, {"push.f": [0.0, 2.0]})
    for end in (0.4, 0.8):
        run.set({"push.f": [2 * run.time, 2.0]})
        run.advance(end)
    (event,) = run.result().events
    assert event.time == pytest.approx(0.5, abs=1e-9)
    assert run.observe([("mass.v", 0)])[0] == pytest.approx(0.3**2, rel=1e-6)


def test_a_failure_keeps_what_was_computed() -> None:
    net = Network("pushed", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    run = Stepwise(net.dae(), 0.0, 1.0, {"push.f": Polynomial(1)}, {"push.f": [1.0]})
    run.advance(0.5)
    run.set({"push.f": [float("nan")]})
    with pytest.raises(SimulationError) as caught:
        run.advance(1.0)
    assert caught.value.result["mass.s"][-1] == pytest.approx(0.125, rel=1e-6)  # type: ignore[index]


@pytest.mark.parametrize("rubbing", [False, True])
def test_a_blow_between_two_points_is_seen(rubbing: bool) -> None:
    def blow(t: Any) -> Any:
        return ca.if_else(ca.logic_and(t > 40.0, t < 40.001), 1e3, 0.0) + 1e4 * ca.exp(
            -(((t - 70) / 1e-4) ** 2)
        )

    net = Network("struck", push=Force(), blow=Force(f=blow), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.blow.flange, net.mass.flange)
    if rubbing:
        net.add(rub=SupportFriction(friction=CoulombFriction(f_c=1e-9)))
        net.connect(net.mass.flange, net.rub.flange)
    run = Stepwise(net.dae(), 0.0, 100.0, {"push.f": Polynomial(1)}, {"push.f": [0.0]})
    for end in (30.0, 60.0, 100.0):
        run.advance(end)
    assert run.observe([("mass.v", 0)])[0] == pytest.approx(1 + np.sqrt(np.pi), rel=1e-4)
