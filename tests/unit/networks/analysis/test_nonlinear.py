"""Nonlinear response: harmonic balance against simulation and closed forms, describing functions."""

from math import asin, exp, pi, sqrt

import inertance as ia
import numpy as np
import pytest


def driven(spring: ia.Component, d: float = 0.4) -> ia.Network:
    net = ia.Network(
        "driven", wall=ia.Fixed(), spring=spring, damper=ia.Damper(d=d), mass=ia.Mass(m=1.0), push=ia.Force()
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


@pytest.mark.parametrize("f", [1.2, 3.0])
def test_duffing_by_harmonic_balance_and_by_simulation(f: float) -> None:
    net = driven(ia.CubicSpring(k=100.0, k3=1e4))
    orbit = ia.analysis.harmonic_orbit(net, "push.f", 1.0, f, ["mass.s"], harmonics=11)
    stepped = ia.analysis.stepped_sine(
        net, "push.f", 1.0, [f], ["mass.s"], tolerance=1e-6, most=400, rtol=1e-9, atol=1e-11
    )
    assert stepped.settled.all()
    assert orbit.stable
    assert orbit.amplitude("mass.s") == pytest.approx(stepped.amplitude("mass.s")[0], rel=1e-5)
    assert orbit.phase("mass.s") == pytest.approx(np.angle(stepped.response("mass.s")[0]), abs=1e-5)
    assert abs(orbit.multipliers) == pytest.approx([exp(-0.2 / f)] * 2, rel=1e-9)  # Liouville


def test_duffing_curve_is_followed_through_its_folds() -> None:
    net = driven(ia.CubicSpring(k=100.0, k3=1e4))
    curve = ia.analysis.harmonic_response(net, "push.f", 1.0, (1.0, 4.0), ["mass.s"], harmonics=5)
    turning = np.flatnonzero(np.diff(np.sign(np.diff(curve.frequency))))
    assert len(turning) == 2
    between = slice(turning[0] + 2, turning[1])
    assert not curve.stable[between].any()
    assert curve.stable[: turning[0]].all()
    assert curve.stable[turning[1] + 2 :].all()
    top = int(np.argmax(curve.amplitude("mass.s")))
    force_of_damper = 0.4 * 2 * pi * curve.frequency[top] * curve.amplitude("mass.s")[top]
    assert force_of_damper == pytest.approx(1.0, rel=0.01)  # at the peak it takes all of the drive


def test_up_and_down_part_where_the_curve_folds() -> None:
    net = driven(ia.CubicSpring(k=100.0, k3=1e4))
    up, down = (
        ia.analysis.stepped_sine(net, "push.f", 1.0, f, ["mass.s"], tolerance=1e-3, most=80)
        for f in ([1.4, 1.7, 2.0], [3.0, 2.3, 2.0])
    )
    curve = ia.analysis.harmonic_response(net, "push.f", 1.0, (1.4, 3.0), ["mass.s"], harmonics=5)
    near = abs(curve.frequency - 2.0) < 0.05
    upper, lower = (np.max, np.min)
    size = curve.amplitude("mass.s")[near & curve.stable]
    assert up.amplitude("mass.s")[-1] == pytest.approx(upper(size), rel=0.05)
    assert down.amplitude("mass.s")[-1] == pytest.approx(lower(size), rel=0.15)
    assert up.amplitude("mass.s")[-1] > 3 * down.amplitude("mass.s")[-1]


@pytest.mark.parametrize("f", [2.5, 7.0])
def test_backlash_by_harmonic_balance_and_by_simulation(f: float) -> None:
    net = driven(ia.parallel(ia.Backlash(k=1e3, d=2.0, eps=1e-3), ia.Spring(k=100.0)), d=2.0)
    orbit = ia.analysis.harmonic_orbit(net, "push.f", 0.5, f, ["mass.s"], harmonics=21)
    stepped = ia.analysis.stepped_sine(
        net, "push.f", 0.5, [f], ["mass.s"], tolerance=1e-5, rtol=1e-9, atol=1e-12
    )
    assert orbit.stable
    assert orbit.amplitude("mass.s") == pytest.approx(stepped.amplitude("mass.s")[0], rel=1e-4)


def test_friction_takes_part_when_it_is_regularised() -> None:
    rub = ia.parallel(ia.CoulombFriction(f_c=0.3, regularised=1e-3), ia.Spring(k=100.0))
    orbit = ia.analysis.harmonic_orbit(driven(rub), "push.f", 1.0, 1.2, ["mass.s"], harmonics=15)
    true = driven(ia.parallel(ia.CoulombFriction(f_c=0.3), ia.Spring(k=100.0)))
    stepped = ia.analysis.stepped_sine(true, "push.f", 1.0, [1.2], ["mass.s"], tolerance=1e-4)
    assert orbit.amplitude("mass.s") == pytest.approx(stepped.amplitude("mass.s")[0], rel=3e-3)
    with pytest.raises(ia.ModelError, match="regularised="):
        ia.analysis.harmonic_orbit(true, "push.f", 1.0, 1.2, ["mass.s"])


def test_a_driven_position_brings_its_derivatives() -> None:
    """A linear network on a shaken base, against its transfer function."""
    net = ia.machines.isolated_machine(ia.parallel(ia.SpringDamper(k=1e4, d=100.0), ia.Inerter(b=20.0)))
    orbit = ia.analysis.harmonic_orbit(net, "floor.s_ref", 1e-3, 2.0, ["machine.a"], harmonics=3)
    gain = ia.analysis.linearise(net, ["floor.s_ref"], ["machine.a"]).response(2.0).item()
    assert orbit.amplitude("machine.a") == pytest.approx(1e-3 * abs(gain), rel=1e-9)
    assert orbit.phase("machine.a") == pytest.approx(np.angle(gain), abs=1e-9)


A = 2e-3
X = 0.5


@pytest.mark.parametrize(
    ("element", "exact"),
    [
        (ia.CoulombFriction(f_c=3.0), 4j * 3.0 / (pi * A)),
        (ia.Backlash(k=1e5, d=0.0, eps=X * A), 1e5 * (1 - 2 / pi * (asin(X) + X * sqrt(1 - X**2)))),
        (ia.CubicSpring(k=10.0, k3=1e6), 10.0 + 0.75e6 * A**2),
        (ia.QuadraticDamper(c=50.0), 8j / (3 * pi) * 50.0 * A * (2 * pi) ** 2),
        (ia.SpringDamper(k=10.0, d=2.0), 10.0 + 4j * pi),
        (ia.Inerter(b=2.0), -2.0 * (2 * pi) ** 2),
    ],
)
def test_describing_functions_are_those_of_the_textbook(element: ia.Component, exact: complex) -> None:
    assert ia.analysis.describing_function(element, A * 1.0) == pytest.approx(
        exact, rel=1e-4, abs=1e-4 * abs(exact)
    )
