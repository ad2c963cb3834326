"""Laws of translational elements against closed forms."""

from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}
EXACT: dict[str, Any] = {"rtol": 1e-11, "atol": 1e-14}


def driven(element: ia.Component, motion: Any, stop: float = 2.0, **options: Any) -> ia.Result:
    """An element whose flanges move oppositely, half the given distance each."""
    net = ia.Network(
        "driven",
        left=ia.Position(s_ref=lambda t: -motion(t) / 2),
        right=ia.Position(s_ref=lambda t: motion(t) / 2),
        element=element,
    )
    net.connect(net.left.flange, net.element.flange_a).connect(net.right.flange, net.element.flange_b)
    run = net.simulate(stop, **TIGHT | options)
    assert run["element.flange_a.f"] == pytest.approx(-run["element.flange_b.f"], abs=1e-12)
    assert run["element.flange_b.f"] == pytest.approx(run["element.f"], abs=1e-12)
    return run


def wave(t: Any) -> Any:
    return 0.3 + 0.2 * ca.sin(3 * t)


@pytest.mark.parametrize(
    ("element", "law"),
    [
        (ia.Spring(k=50.0, s_rel0=0.1), lambda s, v, a: 50 * (s - 0.1)),
        (ia.Damper(d=4.0), lambda s, v, a: 4 * v),
        (ia.SpringDamper(k=50.0, d=4.0, s_rel0=0.1), lambda s, v, a: 50 * (s - 0.1) + 4 * v),
        (ia.Inerter(b=7.0), lambda s, v, a: 7 * a),
        (ia.CubicSpring(k=5.0, k3=-3.0, s_rel0=0.1), lambda s, v, a: 5 * (s - 0.1) - 3 * (s - 0.1) ** 3),
        (ia.QuadraticDamper(c=6.0), lambda s, v, a: 6 * v * abs(v)),
        (ia.CoulombFriction(f_c=2.0), lambda s, v, a: 2 * np.sign(v)),
        (
            ia.StribeckFriction(f_c=2.0, f_s=3.0, v_s=0.1, d=0.5),
            lambda s, v, a: (2 + np.exp(-abs(v) / 0.1)) * np.sign(v) + 0.5 * v,
        ),
        (
            ia.TabulatedFriction(table=((0.0, 3.0), (0.2, 1.0), (0.5, 2.0))),
            lambda s, v, a: np.interp(abs(v), [0, 0.2, 0.5, 1.5], [3, 1, 2, 2 + 1 / 0.3]) * np.sign(v),
        ),
        (
            ia.CoulombFriction(f_c=2.0, regularised=0.05),
            lambda s, v, a: 2 * np.tanh(v / 0.05),
        ),
    ],
)
def test_force_of_a_prescribed_motion(element: ia.Component, law: Any) -> None:
    run = driven(element.clone(), wave)
    t = run.time
    s, v, a = 0.3 + 0.2 * np.sin(3 * t), 0.6 * np.cos(3 * t), -1.8 * np.sin(3 * t)
    assert run["element.s_rel"] == pytest.approx(s, abs=1e-8)
    moving = abs(v) > 1e-6
    assert run["element.f"][moving] == pytest.approx(law(s, v, a)[moving], abs=1e-6)


def test_bouc_wen_is_a_spring_while_small_and_slips_at_its_limit() -> None:
    parameters: dict[str, Any] = {"k": 100.0, "alpha": 0.2, "beta": 30.0, "gamma": 20.0, "n": 2.0}
    small = driven(ia.BoucWen(**parameters), lambda t: 1e-4 * ca.sin(t), **EXACT)
    bent = 80.0 * 50.0 * 1e-4**3 / 3
    assert small["element.f"] == pytest.approx(100.0 * small["element.s_rel"], abs=1.2 * bent)
    pulled = driven(ia.BoucWen(**parameters), lambda t: 0.5 * t)
    limit = (1 / (30.0 + 20.0)) ** 0.5
    assert pulled["element.z"][-1] == pytest.approx(limit, rel=1e-4)
    assert pulled["element.f"][-1] == pytest.approx(20.0 * 1.0 + 80.0 * limit, rel=1e-4)


def test_bouc_wen_loses_energy_round_every_loop() -> None:
    """With n = 1, beta = gamma the loop is made of lines and exponentials; its area is the loss."""
    k, beta, amplitude = 100.0, 10.0, 0.2
    element = ia.BoucWen(k=k, alpha=0.0, beta=beta, gamma=beta, n=1.0)
    run = driven(element, lambda t: amplitude * ca.sin(2 * np.pi * t), stop=4.0, step=0.0005)
    power = run["element.f"] * run["element.v_rel"]
    t = run.time
    losses = [np.trapezoid(power[(t >= i) & (t <= i + 1)], t[(t >= i) & (t <= i + 1)]) for i in (1, 2, 3)]
    assert losses[1] == pytest.approx(losses[2], rel=1e-6)
    # On the way up from -a: first z rises linearly to zero, then to z_top = (1 - exp(-2 beta x)) / (2 beta).
    from scipy.optimize import root_scalar

    def top(z_low: float) -> float:
        return float((1 - np.exp(-2 * beta * (2 * amplitude - z_low))) / (2 * beta) - z_low)

    z = float(root_scalar(top, bracket=(0.0, amplitude)).root)
    x = 2 * amplitude - z
    risen = (x - (1 - np.exp(-2 * beta * x)) / (2 * beta)) / (2 * beta)
    assert losses[2] == pytest.approx(2 * k * (risen - z**2 / 2), rel=1e-5)


def test_rods_add_their_length_and_carry_force() -> None:
    net = ia.Network(
        "rod", wall=ia.Fixed(s0=1.0), spring=ia.Spring(k=10.0), rod=ia.Rod(L=-0.3), mass=ia.Mass(m=2.0)
    )
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.mass.flange)
    run = net.simulate(1.0, start={"mass.s": 0.9}, **TIGHT)
    assert run["spring.s_rel"] == pytest.approx(run["mass.s"] + 0.3 - 1.0)
    assert run["mass.s"] == pytest.approx(0.7 + 0.2 * np.cos(np.sqrt(5.0) * run.time), abs=1e-8)
    assert run["rod.flange_a.f"] == pytest.approx(-run["spring.f"], abs=1e-12)


def test_sources_react_on_their_support() -> None:
    for source in (ia.Force(f=3.0), ia.ConstantForce(f_constant=3.0)):
        net = ia.Network("reaction", a=ia.Mass(m=1.0), b=ia.Mass(m=2.0), source=source)
        net.connect(net.a.flange, net.source.support).connect(net.source.flange, net.b.flange)
        run = net.simulate(1.0)
        assert run["b.a"] == pytest.approx(1.5)
        assert run["a.a"] == pytest.approx(-3.0)
    net = ia.Network("reaction", a=ia.Mass(m=1.0), b=ia.Mass(m=2.0), source=ia.Position(s_ref=lambda t: t**2))
    net.connect(net.a.flange, net.source.support).connect(net.source.flange, net.b.flange)
    run = net.simulate(1.0)
    assert run["b.a"] - run["a.a"] == pytest.approx(2.0)
    assert 2 * run["b.v"] + run["a.v"] == pytest.approx(0.0, abs=1e-9)


def test_prescribed_speed_and_acceleration_start_where_they_are_told() -> None:
    net = ia.Network("speed", drive=ia.Speed(v_ref=lambda t: 2 * t, s=0.5), mass=ia.Mass(m=1.0))
    run = net.connect(net.drive.flange, net.mass.flange).simulate(1.0, **TIGHT)
    assert run["mass.s"] == pytest.approx(0.5 + run.time**2)
    net = ia.Network("pull", drive=ia.Accelerate(a_ref=6.0, s=0.5, v=-1.0), mass=ia.Mass(m=2.0))
    run = net.connect(net.drive.flange, net.mass.flange).simulate(1.0, **TIGHT)
    assert run["mass.s"] == pytest.approx(0.5 - run.time + 3 * run.time**2)
    assert run["drive.flange.f"] == pytest.approx(-12.0)


def test_friction_against_a_support_reacts_there() -> None:
    net = ia.Network(
        "guide",
        slide=ia.Mass(m=1.0, v=2.0),
        frame=ia.Mass(m=3.0),
        guide=ia.SupportFriction(friction=ia.CoulombFriction(f_c=3.0)),
    )
    net.connect(net.slide.flange, net.guide.flange).connect(net.guide.support, net.frame.flange)
    run = net.simulate(1.0)
    assert run["slide.v"][-1] == pytest.approx(0.5)
    assert run["frame.v"][-1] == pytest.approx(0.5)
    grounded = ia.Network(
        "grounded",
        slide=ia.Mass(m=1.0, v=2.0),
        guide=ia.SupportFriction(friction=ia.CoulombFriction(f_c=3.0)),
    )
    run = grounded.connect(grounded.slide.flange, grounded.guide.flange).simulate(1.0, **TIGHT)
    assert run["slide.s"][-1] == pytest.approx(2.0**2 / 6)


def test_a_stop_keeps_its_least_distance() -> None:
    net = ia.Network(
        "stop",
        wall=ia.Fixed(s0=0.5),
        stop=ia.HardStop(s_min=0.2, e=0.0),
        mass=ia.Mass(m=1.0, s=1.0, v=-1.0),
        push=ia.Force(f=-2.0),
    )
    net.connect(net.wall.flange, net.stop.flange_a).connect(
        net.stop.flange_b, net.mass.flange, net.push.flange
    )
    run = net.simulate(2.0, **TIGHT)
    assert run["mass.s"].min() == pytest.approx(0.7, abs=1e-10)
    assert run["stop.f"][-1] == pytest.approx(-2.0)
    assert run.events[0].impulse == pytest.approx(np.sqrt(1 + 2 * 2 * 0.3))
