"""Friction by direction, load, time, place and displacement; ripples, cubic dampers, gravity, springs."""

import re
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.components import translational
from inertance.components.language import Parameter
from numpy.typing import NDArray

Array = NDArray[np.float64]


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


WAVES = {"sin": 1.0, "cos": 2.0, "sin_2": 3.0, "cos_2": 4.0, "sin_3": 5.0, "cos_3": 6.0}
WAVES_OF_FORCE = {f"f_{wave}": size for wave, size in WAVES.items()}
WAVES_OF_TORQUE = {f"tau_{wave}": size for wave, size in WAVES.items()}
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
    (ia.ShearThinningDamper(d=3.0, v_e=0.2), lambda s, v: 0.6 * np.arcsinh(5 * v)),
    (rotational.ShearThinningDamper(d=3.0, w_e=0.2), lambda s, v: 0.6 * np.arcsinh(5 * v)),
    (ia.CubicDamper(d3=3.0), lambda s, v: 3 * v**3),
    (rotational.CubicDamper(d3=3.0), lambda s, v: 3 * v**3),
    (ia.HarmonicRipple(**WAVES_OF_FORCE, period=0.5), lambda s, v: harmonics(4 * np.pi * s)),
    (
        rotational.HarmonicRipple(**WAVES_OF_TORQUE, period=0.5),
        lambda s, v: harmonics(4 * np.pi * s),
    ),
    (
        ia.PositionDependentFriction(f_c=2.0, f_1=0.5, f_2=0.3, s_rel0=0.2),
        lambda s, v: (2 + 0.5 * (s - 0.2) + 0.3 * (s - 0.2) ** 2) * np.sign(v),
    ),
    (
        rotational.PositionDependentFriction(tau_c=2.0, tau_1=0.5, tau_2=0.3, phi_rel0=0.2),
        lambda s, v: (2 + 0.5 * (s - 0.2) + 0.3 * (s - 0.2) ** 2) * np.sign(v),
    ),
    (
        ia.PositionDependentFriction(f_c=2.0, f_cos=0.7, f_sin=-0.4, period=0.5, s_rel0=0.2),
        lambda s, v: wavy(4 * np.pi * (s - 0.2)) * np.sign(v),
    ),
    (
        rotational.PositionDependentFriction(tau_c=2.0, tau_cos=0.7, tau_sin=-0.4, period=0.5, phi_rel0=0.2),
        lambda s, v: wavy(4 * np.pi * (s - 0.2)) * np.sign(v),
    ),
    (rotational.ArmGravity(tau_sin=2.0, tau_cos=-1.0), lambda s, v: 2 * np.sin(s) - np.cos(s)),
]


def wavy(x: Array) -> Array:
    return 2 + 0.7 * np.cos(x) - 0.4 * np.sin(x)


def harmonics(x: Array) -> Array:
    """Return three harmonics of amplitudes 1 to 6, written as turning pointers."""
    return np.asarray(sum(np.real((2 * h - (2 * h - 1) * 1j) * np.exp(1j * h * x)) for h in (1, 2, 3)))


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


@pytest.mark.parametrize("turning", [False, True])
def test_friction_that_fades_holds_until_it_no_longer_can(turning: bool) -> None:
    """Under 0.5 it slips at 5/3 s; from 10/3 s, where its level would turn negative, there is none."""
    if turning:
        net = ia.Network("held", wall=rotational.Fixed(), push=rotational.ConstantTorque(tau_constant=0.5))
        net.add(element=rotational.DriftingFriction(tau_c=1.0, tau_u=-0.3), body=rotational.Inertia(J=1.0))
    else:
        net = ia.Network("held", wall=ia.Fixed(), push=ia.ConstantForce(f_constant=0.5))
        net.add(element=ia.DriftingFriction(f_c=1.0, f_u=-0.3), body=ia.Mass(m=1.0))
    net.add(clock=ia.signals.Clock())
    net.connect(net.wall.flange, net.element.flange_a).connect(net.clock.y, net.element.u)
    net.connect(net.element.flange_b, net.body.flange, net.push.flange)
    run = net.simulate(5.0, step=0.01, rtol=1e-9, atol=1e-12)
    speed = run["body.w" if turning else "body.v"]
    slips = np.maximum(run.time - 5 / 3, 0.0)
    law = np.where(run.time < 10 / 3, 0.15 * slips**2, 0.15 * (5 / 3) ** 2 + 0.5 * (run.time - 10 / 3))
    assert np.abs(speed) == pytest.approx(law, abs=1e-6)


@pytest.mark.parametrize("turning", [False, True])
def test_friction_that_would_be_negative_at_places_is_none_there(turning: bool) -> None:
    element = (
        rotational.PositionDependentFriction(tau_c=0.2, tau_cos=0.5, period=1.0)
        if turning
        else ia.PositionDependentFriction(f_c=0.2, f_cos=0.5, period=1.0)
    )
    run = driven(element, turning).simulate(6.0, step=0.01)
    s, v = np.sin(run.time), np.cos(run.time)
    moving = np.abs(v) > 0.01
    law = np.maximum(0.2 + 0.5 * np.cos(2 * np.pi * s), 0.0) * np.sign(v)
    assert run["element.tau" if turning else "element.f"][moving] == pytest.approx(law[moving], abs=1e-6)


@pytest.mark.parametrize("turning", [False, True])
def test_friction_builds_up_before_it_slips(turning: bool) -> None:
    """From 0 to 1 it comes within exp(-1/0.2) of its end; then it falls from there."""
    element = rotational.DahlFriction(tau_c=3.0, phi_p=0.2) if turning else ia.DahlFriction(f_c=3.0, s_p=0.2)
    run = driven(element, turning).simulate(4.5, step=0.01, rtol=1e-9, atol=1e-11)
    s = np.sin(run.time)
    top = 1 - np.exp(-1 / 0.2)
    law = 3 * np.where(run.time < np.pi / 2, 1 - np.exp(-s / 0.2), (1 + top) * np.exp((s - 1) / 0.2) - 1)
    assert run["element.tau" if turning else "element.f"] == pytest.approx(law, abs=1e-6)


def test_stuck_friction_that_has_not_slipped_is_a_spring() -> None:
    net = ia.Network("held", wall=ia.Fixed(), guide=ia.DahlFriction(f_c=3.0, s_p=1e-3), body=ia.Mass(m=2.0))
    net.connect(net.wall.flange, net.guide.flange_a).connect(net.guide.flange_b, net.body.flange)
    run = net.simulate(0.5, step=1e-3, start={"body.v": 1e-5}, rtol=1e-9, atol=1e-14)
    w = np.sqrt(3.0 / 1e-3 / 2.0)
    assert run["body.s"] == pytest.approx(1e-5 / w * np.sin(w * run.time), abs=1e-9)


def test_turning_hysteresis_is_the_sliding_one_in_other_units() -> None:
    shape: dict[str, Any] = {"alpha": 0.2, "beta": 3.0, "gamma": 1.0, "n": 2.0}
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
