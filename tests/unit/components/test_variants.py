"""Friction by direction, load and time; ripple, bilinear and turning hysteretic springs."""

import re
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.components import translational
from inertance.components.language import Parameter


def driven(element: Any, turning: bool = False) -> ia.Network:
    """Return an element between the ground and a flange that moves as sin(t)."""
    wall, drive = (
        (rotational.Fixed(), rotational.Position(phi_ref=np.sin))
        if turning
        else (ia.Fixed(), ia.Position(s_ref=np.sin))
    )
    net = ia.Network("driven", wall=wall, element=element, drive=drive)
    net.connect(net.wall.flange, net.element.flange_a)
    return net.connect(net.element.flange_b, net.drive.flange)


PAIRS = [
    (ia.AsymmetricFriction(f_forward=1.0, f_backward=2.0), lambda s, v: np.where(v > 0, 1.0, -2.0)),
    (
        rotational.AsymmetricFriction(tau_forward=1.0, tau_backward=2.0),
        lambda s, v: np.where(v > 0, 1.0, -2.0),
    ),
    (ia.BilinearSpring(k_pull=3.0, k_push=5.0), lambda s, v: np.where(s > 0, 3.0 * s, 5.0 * s)),
    (rotational.BilinearSpring(c_pull=3.0, c_push=5.0), lambda s, v: np.where(s > 0, 3.0 * s, 5.0 * s)),
    (
        ia.Ripple(f_sin=2.0, f_cos=1.0, period=0.5),
        lambda s, v: 2 * np.sin(4 * np.pi * s) + np.cos(4 * np.pi * s),
    ),
    (
        rotational.Ripple(tau_sin=2.0, tau_cos=1.0, period=0.5),
        lambda s, v: 2 * np.sin(4 * np.pi * s) + np.cos(4 * np.pi * s),
    ),
    (rotational.CubicSpring(c=2.0, c3=3.0), lambda s, v: 2 * s + 3 * s**3),
]


@pytest.mark.parametrize(("element", "law"), PAIRS, ids=lambda x: type(x).__name__)
def test_force_follows_the_law(element: ia.Component, law: Any) -> None:
    turning = not isinstance(element, ia.Compliant)
    run = driven(element.clone(), turning).simulate(6.0, step=0.01)
    s, v = np.sin(run.time), np.cos(run.time)
    moving = np.abs(v) > 1e-3
    assert run["element.tau" if turning else "element.f"][moving] == pytest.approx(
        law(s, v)[moving], abs=1e-9
    )


@pytest.mark.parametrize("regularised", [None, 1e-3])
def test_friction_in_proportion_to_the_force_of_a_spring(regularised: float | None) -> None:
    net = driven(ia.LoadedFriction(mu=0.1, regularised=regularised))
    net.add(spring=ia.Spring(k=10.0), sensor=ia.ForceSensor())
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.sensor.flange_a)
    net.connect(net.sensor.flange_b, net.drive.flange).connect(net.sensor.f, net.element.load)
    run = net.simulate(6.0, step=0.01)
    v = np.cos(run.time)
    moving = np.abs(v) > 0.01
    law = 0.1 * np.abs(10 * np.sin(run.time)) * np.sign(v)
    assert run["element.f"][moving] == pytest.approx(law[moving], abs=1e-6)


@pytest.mark.parametrize("turning", [False, True])
def test_friction_that_follows_a_signal(turning: bool) -> None:
    element = (
        rotational.DriftingFriction(tau_c=1.0, tau_u=-0.3, regularised=1e-3)
        if turning
        else ia.DriftingFriction(f_c=1.0, f_u=-0.3, regularised=1e-3)
    )
    net = driven(element, turning)
    net.add(clock=ia.signals.Clock()).connect(net.clock.y, net.element.u)
    run = net.simulate(6.0, step=0.01)
    v = np.cos(run.time)
    moving = np.abs(v) > 0.01
    law = (1 - 0.3 * run.time) * np.sign(v)
    assert run["element.tau" if turning else "element.f"][moving] == pytest.approx(law[moving], abs=1e-6)


def test_turning_hysteresis_is_the_sliding_one_in_other_units() -> None:
    shape = {"alpha": 0.2, "beta": 3.0, "gamma": 1.0, "n": 2.0}
    slid = driven(ia.BoucWen(k=4.0, **shape)).simulate(6.0)
    turned = driven(rotational.BoucWen(c=4.0, **shape), turning=True).simulate(6.0)
    assert turned["element.tau"] == pytest.approx(slid["element.f"], abs=1e-6)
    assert slid["element.f"].max() > 1.5


def parameters(element: type[ia.Component]) -> list[Parameter]:
    return [field for field in element.fields.values() if isinstance(field, Parameter)]


def turned(unit: str) -> str:
    """Return the unit that a quantity has where things turn instead of sliding."""
    return re.sub(r"m(?=\d|\b)", "rad", unit).replace("N", "N.m").replace("kg", "kg.m2")


@pytest.mark.parametrize("name", sorted({*vars(translational)} & {*vars(rotational)} - {"Brake"}))
def test_parameters_stand_in_the_same_order_in_both_domains(name: str) -> None:
    sliding, turning = getattr(translational, name), getattr(rotational, name)
    if isinstance(sliding, type):
        assert [turned(p.unit) for p in parameters(sliding)] == [p.unit for p in parameters(turning)]
