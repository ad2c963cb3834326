"""Inerters as two-terminal machines, alone and in two-terminal algebra."""

from math import pi, sqrt

import inertance as ia
import numpy as np
import pytest
from inertance.machines import BallScrewInerter, RackPinionInerter, RandomDisplacement, Sinusoid, ge_wang


def ball_screw() -> BallScrewInerter:
    return BallScrewInerter(screw=ia.NutScrew(lead=0.02), flywheel=ia.DiskFlywheel(m=2.0, R=0.1))


BALL_SCREW = (2 * pi / 0.02) ** 2 * 0.01


@pytest.mark.parametrize(
    ("inerter", "b"),
    [
        (ball_screw(), BALL_SCREW),
        (RackPinionInerter(pinion=ia.RackPinion(R=0.02), flywheel=ia.DiskFlywheel(m=2.0, R=0.1)), 25.0),
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
    run = net.simulate(5.0, start={"strut.spring.s_rel": stretch}, rtol=1e-9, atol=1e-12)
    assert run["strut.f"] == pytest.approx(1e5 * stretch * np.cos(3 * run.time), abs=1e-4)


def test_housing_keeps_the_torque() -> None:
    """The support takes what the flywheel is given."""
    run = ia.machines.run_on_rig(ge_wang.planetary_inerter(regularised=0.1), Sinusoid(0.01, 3.0), 0.5)
    inner = run["inerter.flywheel.bracket.a"] * (ge_wang.GEARS["J_s"] + 4 * ge_wang.GEARS["J_r"])
    inner -= 4 * ge_wang.GEARS["J_p"] * run["inerter.flywheel.planet.a_p"]
    assert run["inerter.support.tau"] == pytest.approx(inner, abs=1e-6 * np.abs(inner).max())


def test_power_goes_into_motion_contacts_and_friction() -> None:
    run = ia.machines.run_on_rig(ge_wang.planetary_inerter(lumped=False), Sinusoid(0.01, 3.0), 0.5)
    screw, bracket = "inerter.screw.", "inerter.flywheel.bracket."
    flows = [
        ge_wang.SCREW["m_r"] * run[f"{screw}nut.a"] * run[f"{screw}nut.v"],
        ge_wang.GEARS["J_s"] * run[f"{bracket}a"] * run[f"{bracket}w"],
        run[f"{screw}contact.f"] * run[f"{screw}contact.v_rel"],
        run[f"{screw}friction.tau"] * run[f"{screw}friction.w_rel"],
    ]
    for i in range(1, 5):
        planet = f"inerter.flywheel.planet_{i}."
        flows += [
            ge_wang.GEARS["J_r"] * run[f"{planet}a_s"] * run[f"{planet}w_s"],
            ge_wang.GEARS["J_p"] * run[f"{planet}a_p"] * run[f"{planet}w_p"],
            run[f"{planet}F_p"] * run[f"{planet}v_rel"],
            run[f"{planet}T_fp"] * run[f"{planet}w_p"],
        ]
    power = run["inerter.flange_a.f"] * run[f"{screw}nut.v"]
    assert power == pytest.approx(sum(flows), abs=1e-9 * np.ptp(power))
    assert min(flow.min() for flow in (flows[3], *flows[7::4])) >= -1e-15


def test_many_reversals_in_random_motion() -> None:
    """Screw and planets that come to rest within a tolerance, and break away from rest by a hair."""
    run = ia.machines.run_on_rig(ge_wang.planetary_inerter(), RandomDisplacement(seed=0), 2.0, step=1e-3)
    assert run.time[-1] == 2.0
    assert 100 < len(run.events) < 200
    smooth = ia.machines.run_on_rig(
        ge_wang.planetary_inerter(regularised=0.05), RandomDisplacement(seed=0), 2.0, step=1e-3
    )
    force = np.interp(smooth.time, run.time, run["inerter.flange_a.f"])
    assert force == pytest.approx(smooth["inerter.flange_a.f"], abs=5e-3 * np.ptp(force))


def test_parts_that_must_be_given_are_told_by_path() -> None:
    inerter = BallScrewInerter(screw=ia.NutScrew(lead=0.01))
    net = ia.machines.inerter_rig(inerter, Sinusoid(0.01, 1.0))
    with pytest.raises(ia.ModelError, match=r"DiskFlywheel 'inerter\.flywheel': m \[kg\]"):
        net.dae()
