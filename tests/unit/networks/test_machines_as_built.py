"""Machines composed of new elements: their equivalent laws, in numbers written apart."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import machines, rotational
from scipy.integrate import solve_ivp


def test_a_nonlinear_energy_sink_pumps_energy_beyond_a_threshold() -> None:
    """Against an integration apart; from a hard blow it takes most of the energy, from a soft one little."""
    left = {}
    for v in (0.01, 0.1):
        sink = machines.NES(m=0.05, k3=2.0, d=0.015)
        net = ia.Network(
            "tower", wall=ia.Fixed(), body=ia.Mass(m=1.0, v=v), spring=ia.Spring(k=1.0), sink=sink
        )
        net.connect(net.wall.flange, net.spring.flange_a, net.sink.flange_a)
        net.connect(net.spring.flange_b, net.body.flange, net.sink.flange_b)
        run = net.simulate(60.0, begin=10.0, step=0.05, rtol=1e-9)

        def rates(_: float, y: Any) -> Any:
            x, u, x_d, u_d = y
            f = 2.0 * (u - x) ** 3 + 0.015 * (u_d - x_d)
            return [x_d, u_d, f - x, -f / 0.05]

        apart = solve_ivp(
            rates, (10.0, 60.0), [0, 0, v, 0], t_eval=np.minimum(run.time, 60), rtol=1e-10, atol=1e-12
        )
        assert run["body.s"] == pytest.approx(apart.y[0], abs=1e-5)
        left[v] = (run["body.v"][-1] ** 2 + run["body.s"][-1] ** 2) / v**2
    assert left[0.1] < 0.1 * left[0.01]


def test_a_crank_inerter_grows_heavier_towards_its_dead_centre() -> None:
    """f = b a + b' v^2/2 with b = J/(ds/dphi)^2, differentiated by complex steps."""
    inerter = machines.CrankInerter(
        crank=ia.SliderCrank(r=0.04, l=0.12), flywheel=ia.DiskFlywheel(m=0.8, R=0.05)
    )
    net = ia.Network("crank", rod=ia.Position(), inerter=inerter, frame=ia.Fixed())
    net.connect(net.rod.flange, net.inerter.flange_a).connect(net.inerter.flange_b, net.frame.flange)
    course: Any = lambda t: 0.115 + 0.025 * np.sin(6 * t)  # noqa: E731
    run = net.simulate(
        2.0, inputs={"rod.s_ref": course}, guess={"inerter.crank.phi": np.pi / 2}, rtol=1e-9, step=1e-3
    )
    phi, t = run["inerter.crank.phi"], run.time
    assert 0.2 < phi.min() < phi.max() < 3.0

    def position(angle: Any) -> Any:
        return 0.04 * np.cos(angle) + np.sqrt(0.12**2 - (0.04 * np.sin(angle)) ** 2)

    def inertance(angle: Any) -> Any:
        h = 1e-5
        slope = (position(angle + h) - position(angle - h)) / (2 * h)
        return 0.8 * 0.05**2 / 2 / slope**2

    assert position(phi) == pytest.approx(course(t), abs=1e-9)
    v, a = 0.15 * np.cos(6 * t), -0.9 * np.sin(6 * t)
    h = 1e-4
    slope = (position(phi + h) - position(phi - h)) / (2 * h)
    growth = (inertance(phi + h) - inertance(phi - h)) / (2 * h) / slope
    force = inertance(phi) * a + growth * v**2 / 2
    assert run["inerter.flange_a.f"] == pytest.approx(force, abs=1e-3 * np.abs(force).max())
    assert np.ptp(inertance(phi)) > 0.5


def test_a_mechatronic_inerter_answers_with_its_circuit() -> None:
    """Admittance of a flywheel beside a motor's R, L, C, seen through the screw."""
    inerter = machines.MechatronicInerter(
        screw=ia.NutScrew(lead=0.01),
        flywheel=ia.DiskFlywheel(m=0.1, R=0.03),
        motor=rotational.ShuntedMotor(k=0.05, L=0.02, R=1.5, elastance=1 / 0.01),
    )
    net = ia.Network("strut", rod=ia.Speed(), inerter=inerter, frame=ia.Fixed())
    net.connect(net.rod.flange, net.inerter.flange_b).connect(net.inerter.flange_a, net.frame.flange)
    system = ia.analysis.linearise(net, ["rod.v_ref"], ["inerter.motor.tau"])
    f = np.array([0.05, 1.0, 10.0, 100.0])
    s = 2j * np.pi * f
    circuit = 0.05**2 / (0.02 * s + 1.5 + 1 / (0.01 * s)) * (2 * np.pi / 0.01)
    assert np.abs(system.response(f)[:, 0, 0]) == pytest.approx(np.abs(circuit), rel=1e-9)
    low = 2j * np.pi * 0.05 * 0.05**2 * 0.01 * (2 * np.pi / 0.01)  # k^2 C
    assert np.abs(circuit[0]) == pytest.approx(np.abs(low), rel=0.01)


def test_a_dual_mass_flywheel_isolates_above_its_resonance() -> None:
    wheel = machines.DualMassFlywheel(J_1=0.1, J_2=0.06, c=600.0, d=2.0)
    net = ia.Network("drive", engine=rotational.Torque(), wheel=wheel, gearbox=rotational.Inertia(J=0.01))
    net.connect(net.engine.flange, net.wheel.flange_a).connect(net.wheel.flange_b, net.gearbox.flange)
    system = ia.analysis.linearise(net, ["engine.tau"], ["gearbox.a", "wheel.primary.a"])
    f = np.array([1.0, 8.0, 15.0, 40.0, 100.0])
    s = 2j * np.pi * f
    link = 600 + 2 * s
    ratio = link / (0.07 * s**2 + link)
    response = system.response(f)
    assert response[:, 0, 0] / response[:, 1, 0] == pytest.approx(ratio, rel=1e-6)
    rubbing = wheel.with_values(tau_c=20.0, phi_p=0.02)
    net = ia.Network("drive", wheel=rubbing, engine=rotational.Torque(tau=lambda t: 5 * np.sin(3 * t)))
    net.add(wall=rotational.Fixed())
    net.connect(net.engine.flange, net.wheel.flange_a).connect(net.wheel.flange_b, net.wall.flange)
    held = net.simulate(2.0)
    assert np.abs(held["wheel.phi_rel"]).max() < 5 / (600 + 20 / 0.02) * 1.3


@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
def test_a_torsional_damper_is_best_where_it_says(share: float) -> None:
    """Den Hartog's optimum of an untuned damper: the peak of |phi/tau| is (2 + mu)/mu statically."""
    inertia, ring, w_n = 1.0, 0.4, 20.0
    mu = ring / inertia
    best = 2 * ring * w_n / np.sqrt(2 * (1 + mu) * (2 + mu))
    net = ia.Network("shaft", wall=rotational.Fixed(), shaft=rotational.Spring(c=inertia * w_n**2))
    net.add(crank=rotational.Inertia(J=0.9), push=rotational.Torque())
    net.add(damper=machines.TorsionalDamper(J_h=0.1, J_r=ring, d=share * best))
    net.connect(net.wall.flange, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.crank.flange, net.damper.flange, net.push.flange)
    system = ia.analysis.linearise(net, ["push.tau"], ["crank.phi"])
    f = np.linspace(0.5, 6.0, 4000)
    peak = np.abs(system.response(f)[:, 0, 0]).max() * inertia * w_n**2
    optimum = (2 + mu) / mu
    assert (peak == pytest.approx(optimum, rel=1e-4)) == (share == 1.0)
    assert peak > optimum * (1 - 1e-4)


def test_a_shaker_shakes() -> None:
    shaker = machines.Shaker(m=0.3, k=4e3, d=8.0, Bl=15.0, R=2.0, L=1e-3)
    net = ia.Network("table", frame=ia.Fixed(), shaker=shaker, load=ia.Mass(m=1.2))
    net.connect(net.frame.flange, net.shaker.flange_a).connect(net.shaker.flange_b, net.load.flange)
    system = ia.analysis.linearise(net, ["shaker.u"], ["load.a", "shaker.i"])
    f = np.array([2.0, 8.0, 60.0, 500.0])
    s = 2j * np.pi * f
    electric = 2 + 1e-3 * s
    travel = 15 / electric / (1.5 * s**2 + 8 * s + 4e3 + 225 * s / electric)
    assert system.response(f)[:, 0, 0] == pytest.approx(s**2 * travel, rel=1e-9)
    assert system.response(f)[:, 1, 0] == pytest.approx((1 - 15 * s * travel) / electric, rel=1e-9)
