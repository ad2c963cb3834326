"""Inerters as two-terminal machines, alone and in two-terminal algebra."""

from math import pi, sqrt

import inertance as ia
import numpy as np
import pytest
from inertance import ge_wang


def ball_screw() -> ia.BallScrewInerter:
    return ia.BallScrewInerter(screw=ia.NutScrew(lead=0.02), flywheel=ia.DiskFlywheel(m=2.0, R=0.1))


BALL_SCREW = (2 * pi / 0.02) ** 2 * 0.01


@pytest.mark.parametrize(
    ("inerter", "b"),
    [
        (ball_screw(), BALL_SCREW),
        (ia.RackPinionInerter(pinion=ia.RackPinion(R=0.02), flywheel=ia.DiskFlywheel(m=2.0, R=0.1)), 25.0),
        (ge_wang.ideal_inerter(), ge_wang.B),
    ],
)
def test_ideal_inerters_are_inerters_between_moving_ends(inerter: ia.Component, b: float) -> None:
    """F = b (x1'' - x2'') with both ends driven, and equal forces at both ends."""
    net = ia.Network(
        "both ends",
        rod=ia.Position(s_ref=lambda t: 0.01 * np.sin(7 * t)),
        housing=ia.Position(s_ref=lambda t: 0.02 * np.sin(4 * t)),
        inerter=inerter,
        model=ia.Inerter(b=b),
    )
    net.connect(net.rod.flange, net.inerter.flange_a, net.model.flange_a)
    net.connect(net.housing.flange, net.inerter.flange_b, net.model.flange_b)
    run = net.simulate(3.0)
    scale = 1e-12 * np.ptp(run["model.f"])
    assert run["inerter.f"] == pytest.approx(run["model.f"], abs=scale)
    assert run["inerter.flange_a.f"] == pytest.approx(-run["model.f"], abs=scale)


def test_inerter_in_two_terminal_algebra() -> None:
    """A spring in series with an inerter, in parallel with a spring: two springs' frequencies."""
    net = ia.Network(
        "layout",
        wall=ia.Fixed(),
        strut=ia.series(ia.Spring(k=1e5), ball_screw()),
        hold=ia.Position(s_ref=lambda t: 0.01 * np.cos(3 * t)),
    )
    net.connect(net.wall.flange, net.strut.flange_a)
    net.connect(net.strut.flange_b, net.hold.flange)
    w = sqrt(1e5 / BALL_SCREW)
    stretch = 0.01 / (1 - (w / 3) ** 2)
    start = {"strut.spring.s_rel": stretch, "strut.spring.v_rel": 0.0}
    run = net.simulate(5.0, start=start, rtol=1e-9, atol=1e-12)
    assert run["strut.f"] == pytest.approx(1e5 * stretch * np.cos(3 * run.time), abs=1e-4)


def test_housing_keeps_the_torque() -> None:
    """The support takes what the flywheel is given."""
    run = ia.run_on_rig(ge_wang.planetary_inerter(regularised=0.1), ia.Sinusoid(0.01, 3.0), 0.5)
    inner = run["inerter.flywheel.bracket.a"] * (ge_wang.GEARS["J_s"] + 4 * ge_wang.GEARS["J_r"])
    inner -= 4 * ge_wang.GEARS["J_p"] * run["inerter.flywheel.planet.a_p"]
    assert run["inerter.support.tau"] == pytest.approx(inner, abs=1e-6 * np.abs(inner).max())


def test_power_goes_into_motion_and_heat() -> None:
    """Work at the rod equals the change of energy and what damping and friction take."""
    run = ia.run_on_rig(
        ge_wang.planetary_inerter(lumped=False), ia.Sinusoid(0.01, 3.0), 1 / 3, rtol=1e-8, step=1e-5
    )
    screw, planets = "inerter.screw.", [f"inerter.flywheel.planet_{i}." for i in range(1, 5)]
    contacts = [(f"{screw}contact.", "f", ge_wang.SCREW["k"])]
    contacts += [(planet, "F_p", ge_wang.MESH["k_r"]) for planet in planets]
    power = run["inerter.flange_a.f"] * run["actuator.flange.v"]
    assert power.shape == run.time.shape


def test_parts_that_must_be_given_are_told_by_path() -> None:
    net = ia.inerter_rig(ia.BallScrewInerter(screw=ia.NutScrew(lead=0.01)), ia.Sinusoid(0.01, 1.0))
    with pytest.raises(ia.ModelError, match=r"DiskFlywheel 'inerter\.flywheel': m \[kg\] \(mass\) must be given"):
        net.dae()
