"""Joints, gears that give way or lock, cranks, tyres and motors: closed forms, integrations, power."""

from functools import cache
from math import cos
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from numpy.typing import NDArray
from scipy.integrate import cumulative_simpson, cumulative_trapezoid, solve_ivp
from scipy.optimize import brentq

Array = NDArray[np.float64]


def turned(t: Any) -> Any:
    return -4.0 + 30 * t + 2 * np.sin(7 * t)


def speed(t: Any) -> Any:
    return 30 + 14 * np.cos(7 * t)


def test_a_universal_joint_turns_unevenly_and_keeps_the_power() -> None:
    net = ia.Network("shafts", drive=rotational.Position(phi_ref=turned), load=rotational.Damper(d=0.3))
    net.add(joint=rotational.UniversalJoint(beta=0.6), wheel=rotational.Inertia(J=0.02))
    net.add(wall=rotational.Fixed())
    net.connect(net.drive.flange, net.joint.flange_a)
    net.connect(net.joint.flange_b, net.wheel.flange, net.load.flange_b)
    net.connect(net.load.flange_a, net.wall.flange)
    run = net.simulate(1.5, begin=0.5, step=1e-3, rtol=1e-9)
    phi = turned(run.time)
    apart = np.unwrap(np.arctan2(np.sin(phi), np.cos(phi) * np.cos(0.6)))
    apart += 2 * np.pi * np.round((phi[0] - apart[0]) / (2 * np.pi))
    assert run["wheel.phi"] == pytest.approx(apart, abs=1e-8)
    power = run["joint.flange_a.tau"] * speed(run.time) + run["joint.flange_b.tau"] * run["wheel.w"]
    assert np.abs(power).max() < 1e-8 * np.abs(run["joint.flange_a.tau"] * speed(run.time)).max()
    assert np.ptp(run["wheel.w"] / speed(run.time)) == pytest.approx(1 / np.cos(0.6) - np.cos(0.6), rel=1e-2)


def test_two_universal_joints_undo_each_other() -> None:
    """The second, its fork a quarter turn on, takes out what the first puts in."""
    net = ia.Network("shafts", drive=rotational.Position(phi_ref=turned), wheel=rotational.Inertia(J=0.02))
    net.add(one=rotational.UniversalJoint(beta=0.5), two=rotational.UniversalJoint(beta=0.5))
    net.connect(net.drive.flange, net.one.flange_a).connect(net.one.flange_b, net.two.flange_b)
    net.connect(net.two.flange_a, net.wheel.flange)
    run = net.simulate(1.0, start={"wheel.phi": turned(0.0)}, rtol=1e-9)
    assert run["wheel.w"] == pytest.approx(speed(run.time), abs=1e-6)


def test_a_differential_shares_the_torque_whatever_the_speeds() -> None:
    net = ia.Network("axle", engine=rotational.Torque(tau=lambda t: 10 * np.sin(3 * t) + 5))
    net.add(axle=rotational.Differential(ratio=-4.0), left=rotational.Inertia(J=1.0, w=3.0))
    net.add(right=rotational.Inertia(J=2.0, w=-1.0), pinion=rotational.Inertia(J=0.1))
    net.connect(net.engine.flange, net.pinion.flange, net.axle.flange)
    net.connect(net.axle.left, net.left.flange).connect(net.axle.right, net.right.flange)
    run = net.simulate(2.0, begin=0.3, rtol=1e-9)
    t = run.time
    inertia = np.array([[1.0 + 0.4, 0.4], [0.4, 2.0 + 0.4]])  # with the pinion's 0.1 (4/2)^2
    impulse = 10 * (np.cos(0.9) - np.cos(3 * t)) / 3 + 5 * (t - 0.3)
    gained = np.linalg.solve(inertia, np.full(2, -2.0))[:, None] * impulse
    assert run["left.w"] == pytest.approx(3.0 + gained[0], abs=1e-6)
    assert run["right.w"] == pytest.approx(-1.0 + gained[1], abs=1e-6)
    assert run["axle.left.tau"] == pytest.approx(run["axle.right.tau"], abs=1e-12)
    total = sum(run[f"axle.{port}.tau"] for port in ("flange", "left", "right", "support"))
    assert np.abs(total).max() < 1e-9


def on_prescribed_shafts(element: Any, *ports: str) -> ia.Network:
    """The element's turning ports (phi) or sliding ones (s) driven by smooth signals of their own."""
    net = ia.Network("driven", element=element)
    for n, port in enumerate(ports):
        reference = lambda t, n=n: 0.02 * np.sin((5 + 4 * n) * t + n) + 0.013 * n * t  # noqa: E731
        sliding = type(element).fields[port].domain.across == "s"
        drive = ia.Position(s_ref=reference) if sliding else rotational.Position(phi_ref=reference)
        net.add(**{f"drive{n}": drive})
        net.connect(getattr(net, f"drive{n}").flange, getattr(net.element, port))
    return net


def course(n: int, t: Array) -> tuple[Array, Array]:
    w = 5 + 4 * n
    return 0.02 * np.sin(w * t + n) + 0.013 * n * t, 0.02 * w * np.cos(w * t + n) + 0.013 * n


def test_a_harmonic_drive_winds_up_and_ripples() -> None:
    drive = rotational.HarmonicDrive(ratio=50.0, c=8e3, c3=4e6, d=3.0, e_1=1e-3, phase=0.4)
    run = on_prescribed_shafts(drive, "flange_a", "flange_b", "support").simulate(
        2.5, begin=0.5, step=5e-4, rtol=1e-9
    )
    (a, w_a), (b, w_b), (s, w_s) = (course(n, run.time) for n in range(3))
    x = -(a - s) / 50 + 1e-3 * np.sin(2 * (a - s) + 0.4) - (b - s)
    x_dot = -(w_a - w_s) / 50 + 2e-3 * np.cos(2 * (a - s) + 0.4) * (w_a - w_s) - (w_b - w_s)
    tau = 8e3 * x + 4e6 * x**3 + 3 * x_dot
    assert run["element.flange_b.tau"] == pytest.approx(-tau, abs=1e-7 * np.abs(tau).max())
    into = [
        run[f"element.{port}.tau"] * w
        for port, w in zip(("flange_a", "flange_b", "support"), (w_a, w_b, w_s), strict=True)
    ]
    stored = 4e3 * x**2 + 1e6 * x**4
    balance = cumulative_simpson(sum(into) - run["element.lossPower"], x=run.time, initial=0)
    assert balance == pytest.approx(stored - stored[0], abs=1e-6 * stored.max())
    assert run["element.lossPower"] == pytest.approx(3 * x_dot**2, abs=1e-9)


@pytest.mark.parametrize("e_0", [0.004, 0.0, -0.002])
def test_a_belt_or_chain_pulls_and_never_pushes(e_0: float) -> None:
    belt = rotational.BeltDrive(r_a=0.05, r_b=0.1, k=2e4, d=150.0, e_0=e_0)
    run = on_prescribed_shafts(belt, "flange_a", "flange_b", "support").simulate(
        2.5, begin=0.5, step=2e-4, rtol=1e-9
    )
    (a, w_a), (b, w_b), (s, w_s) = (course(n, run.time) for n in range(3))
    e, v = 0.05 * (a - s) - 0.1 * (b - s), 0.05 * (w_a - w_s) - 0.1 * (w_b - w_s)
    strands = [
        np.clip(2e4 * (e_0 + x) + 150 * x_dot, 0, 2 * 2e4 * np.maximum(e_0 + x, 0))
        for x, x_dot in ((e, v), (-e, -v))
    ]
    assert run["element.f_1"] == pytest.approx(strands[0], abs=1e-6)
    assert run["element.f_2"] == pytest.approx(strands[1], abs=1e-6)
    assert strands[0].max() > 1.0
    assert strands[0].min() >= 0.0
    into = sum(
        run[f"element.{port}.tau"] * w
        for port, w in zip(("flange_a", "flange_b", "support"), (w_a, w_b, w_s), strict=True)
    )
    stored = 1e4 * (np.maximum(e_0 + e, 0) ** 2 + np.maximum(e_0 - e, 0) ** 2)
    balance = cumulative_simpson(into - run["element.lossPower"], x=run.time, initial=0)
    assert balance == pytest.approx(stored - stored[0], abs=1e-4 * stored.max())
    assert run["element.lossPower"].min() >= 0


def worm(mu: float, **start: float) -> ia.Network:
    gear = rotational.WormGear(ratio=20.0, lead_angle=0.15, mu=mu, tau_bf=0.02)
    net = ia.Network("hoist", gear=gear, motor=rotational.Torque(), rotor=rotational.Inertia(J=0.01, **start))
    net.add(drum=rotational.Inertia(J=0.5), weight=rotational.ConstantTorque(tau_constant=-40.0))
    net.connect(net.motor.flange, net.rotor.flange, net.gear.flange_a)
    return net.connect(net.gear.flange_b, net.drum.flange, net.weight.flange)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("mu", [0.05, 0.2])
def test_a_worm_lifts_holds_and_lowers_with_the_efficiency_of_an_inclined_plane(
    mu: float, solver: str
) -> None:
    """At a steady speed up and down; with mu = 0.2 the worm locks itself and must be driven down, too."""
    rho = np.arctan(mu)
    up = 40 / 20 * np.tan(0.15 + rho) / np.tan(0.15) + 0.02
    down = 40 / 20 * np.tan(0.15 - rho) / np.tan(0.15) - 0.02
    for torque, w in ((up, 30.0), (down, -30.0)):
        run = worm(mu, w=w).simulate(1.0, inputs={"motor.tau": lambda t, m=torque: m + 0 * t}, solver=solver)
        assert run["rotor.w"] == pytest.approx(np.full(len(run.time), w), abs=1e-6)
        assert run["gear.lossPower"].min() > 0
    locked = down < 0 < up
    assert locked == (mu > np.tan(0.15))
    run = worm(mu).simulate(0.5, inputs={"motor.tau": lambda t: 0.0 * t}, solver=solver)
    assert (np.abs(run["rotor.w"]).max() == 0.0) == locked


def test_a_worm_breaks_away_just_above_the_torque_that_lifts() -> None:
    up = 40 / 20 * np.tan(0.15 + np.arctan(0.2)) / np.tan(0.15) + 0.02
    run = worm(0.2).simulate(10.0, inputs={"motor.tau": lambda t: 0.1 * up * 2 * t})
    first = run.events[0]
    assert (first.source, first.target) == ("stuck", "forward")
    assert first.time == pytest.approx(5.0, abs=1e-6)
    assert run.at("rotor.w", 4.9) == 0.0


def test_a_lead_screw_holds_its_load_and_lifts_by_its_efficiency() -> None:
    screw = ia.LeadScrew(lead=0.004, d_m=0.018, mu=0.12)
    net = ia.Network("jack", screw=screw, load=ia.Mass(m=100.0), weight=ia.ConstantForce(f_constant=-981.0))
    net.add(hand=rotational.Torque(), rotor=rotational.Inertia(J=1e-3))
    net.connect(net.hand.flange, net.rotor.flange, net.screw.flange_r)
    net.connect(net.screw.flange_t, net.load.flange, net.weight.flange)
    still = net.simulate(1.0, inputs={"hand.tau": lambda t: 0.3 * np.sin(9 * t)})
    assert np.abs(still["load.v"]).max() == 0.0  # 0.3 N.m is too little either way
    slope, mu = 0.004 / (np.pi * 0.018), 0.12
    up = 981 * 0.009 * (slope + mu) / (1 - mu * slope)
    run = net.simulate(2.0, begin=0.5, inputs={"hand.tau": lambda t: up + 1e-3 + 0 * t}, rtol=1e-9)
    inertia = 1e-3 + 100 * 0.009 * (slope + mu) / (1 - mu * slope) * 0.004 / (2 * np.pi)
    assert run["rotor.w"] == pytest.approx(1e-3 / inertia * (run.time - 0.5), rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("e", [0.0, 0.03])
def test_a_slider_crank_coasts_with_all_its_energy(e: float) -> None:
    """Through both dead centres, a crank with a heavy slider: the kinetic energy stays, power is kept."""
    net = ia.Network("engine", crank=ia.SliderCrank(r=0.05, l=0.15, e=e), piston=ia.Mass(m=3.0))
    net.add(flywheel=rotational.Inertia(J=0.01, phi=-0.4, w=50.0))
    net.connect(net.crank.flange_r, net.flywheel.flange).connect(net.crank.flange_t, net.piston.flange)
    run = net.simulate(1.0, rtol=1e-10, atol=1e-12)
    phi = run["flywheel.phi"]
    assert phi[-1] > 12.0
    pin = 0.05 * np.exp(1j * phi)
    apart = pin.real + np.sqrt(0.15**2 - (pin.imag - e) ** 2)
    assert run["piston.s"] == pytest.approx(apart, abs=1e-12)
    energy = 0.005 * run["flywheel.w"] ** 2 + 1.5 * run["piston.v"] ** 2
    assert energy == pytest.approx(np.full(len(energy), energy[0]), rel=1e-6)
    assert np.ptp(run["flywheel.w"]) > 5.0


def magic(kappa: Any) -> Any:
    slip = 12 * kappa
    return 0.9 * 4000 * np.sin(1.5 * np.arctan(slip + 0.5 * (slip - np.arctan(slip))))


def test_a_tyre_against_an_integration_apart_through_start_and_braking() -> None:
    """From rest by a torque, then backwards: slip, wheel and car."""
    tyre = ia.Tyre(R=0.3, F_z=4000.0, mu=0.9, B=12.0, C=1.5, E=-0.5, sigma=0.4)
    net = ia.Network("car", tyre=tyre, wheel=rotational.Inertia(J=1.2), car=ia.Mass(m=350.0))
    net.add(engine=rotational.Torque(tau=lambda t: 1100 * np.sin(2.0 * t)))
    net.connect(net.engine.flange, net.wheel.flange, net.tyre.flange_r)
    net.connect(net.tyre.flange_t, net.car.flange)
    run = net.simulate(3.0, begin=0.2, step=1e-3, rtol=1e-9, atol=1e-11)

    def rates(t: float, y: Array) -> list[float]:
        w, v, kappa = y
        force = magic(kappa)
        slip = (0.3 * w - v - abs(v) * kappa) / 0.4
        return [(1100 * np.sin(2 * t) - 0.3 * force) / 1.2, force / 350, slip]

    apart = solve_ivp(
        rates, (0.2, 3.0), [0, 0, 0], t_eval=np.minimum(run.time, 3.0), method="LSODA", rtol=1e-10, atol=1e-12
    )
    assert run["tyre.kappa"] == pytest.approx(apart.y[2], abs=1e-6)
    assert run["car.v"] == pytest.approx(apart.y[1], abs=1e-5)
    assert np.ptp(apart.y[2]) > 0.2
    slipping = run["tyre.f_x"] * (0.3 * run["wheel.w"] - run["car.v"])
    kept = cumulative_trapezoid(slipping - run["tyre.lossPower"], x=run.time, initial=0)
    assert run["tyre.potential"] == pytest.approx(kept, abs=2e-3 * kept.max())
    assert run["tyre.lossPower"].min() >= 0


def test_a_tyre_rolls_with_the_slip_that_its_force_takes() -> None:
    tyre = ia.Tyre(R=0.3, F_z=4000.0, mu=0.9, B=12.0, C=1.5, E=-0.5, sigma=0.4)
    net = ia.Network("drum", tyre=tyre, road=ia.Speed(v_ref=20.0), rim=rotational.Speed(w_ref=68.0))
    net.connect(net.rim.flange, net.tyre.flange_r).connect(net.road.flange, net.tyre.flange_t)
    run = net.simulate(0.5)
    kappa = (0.3 * 68 - 20) / 20
    assert run["tyre.kappa"] == pytest.approx(kappa * (1 - np.exp(-20 * run.time / 0.4)), abs=1e-6)
    assert run["tyre.f_x"][-1] == pytest.approx(magic(kappa), rel=1e-6)


MOTOR: dict[str, Any] = {"k": 0.05, "R": 0.5, "L": 1e-3, "u_max": 12.0, "i_max": 15.0}


def motor(u: Any, **start: float) -> ia.Network:
    net = ia.Network("drive", motor=rotational.DCMotor(**MOTOR), rotor=rotational.Inertia(J=2e-4, **start))
    net.connect(net.motor.flange, net.rotor.flange)
    net.motor.u = u
    return net


def test_a_motor_turns_as_its_voltage_says() -> None:
    run = motor(lambda t: 6.0 + 0 * t).simulate(0.4, step=1e-4, rtol=1e-9)
    matrix = np.array([[-500.0, -50.0], [250.0, 0.0]])
    steady = np.array([0.0, 120.0])
    values, vectors = np.linalg.eig(matrix)
    weights = np.linalg.solve(vectors, -steady)
    y = np.real(vectors @ (weights[:, None] * np.exp(np.outer(values, run.time)))) + steady[:, None]
    assert run["motor.i"] == pytest.approx(y[0], abs=1e-5)
    assert run["rotor.w"] == pytest.approx(y[1], abs=1e-4)
    assert not run.events


@cache
def limited_motor() -> Array:
    """Return current and speed of the motor below, every 0.1 ms for 0.3 s, by steps of 2 us."""
    i, w, step = 0.0, 0.0, 2e-6
    found = []
    for k in range(150_001):
        if k % 50 == 0:
            found.append((i, w))
        voltage = min(max(60 * cos(40 * k * step), -12.0), 12.0) - 0.5 * i - 0.05 * w
        held = abs(i) >= 15 and voltage * i > 0
        i, w = i if held else min(max(i + step * voltage / 1e-3, -15.0), 15.0), w + step * 0.05 * i / 2e-4
    return np.array(found)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_a_motor_keeps_to_its_limits(solver: str) -> None:
    """60 V wanted is 12 V; the current rises to 15 A, stays, and falls once the motor has sped up."""
    run = motor(lambda t: 60.0 * np.cos(40 * t)).simulate(0.3, step=1e-4, rtol=1e-8, solver=solver)
    i, w, t = run["motor.i"], run["rotor.w"], run.time
    assert np.abs(i).max() == pytest.approx(15.0, rel=1e-6)
    assert {event.target for event in run.events} >= {"forward", "backward", "free"}
    coarse = np.interp(np.arange(3001) * 1e-4, t, w)
    assert coarse == pytest.approx(limited_motor()[:, 1], abs=0.2)
    assert np.ptp(w) > 50


def test_a_shunted_motor_with_a_capacitor_is_an_inertia() -> None:
    """The wheel coasts against k^2 C once the charge has settled."""
    shunt = rotational.ShuntedMotor(k=0.4, L=1e-5, R=0.01, elastance=1 / 0.5)
    net = ia.Network("shunted", wall=rotational.Fixed(), wheel=rotational.Inertia(J=0.01), shunt=shunt)
    net.add(push=rotational.Torque(tau=0.2))
    net.connect(net.wall.flange, net.shunt.flange_a)
    net.connect(net.wheel.flange, net.shunt.flange_b, net.push.flange)
    run = net.simulate(2.0, begin=0.4, rtol=1e-9)
    late = run.time > 1.0
    expected = 0.2 / (0.01 + 0.4**2 * 0.5)
    assert run["wheel.a"][late] == pytest.approx(np.full(late.sum(), expected), rel=1e-6)
    work = cumulative_simpson(0.2 * run["wheel.w"] - run["shunt.lossPower"], x=run.time, initial=0)
    stored = 0.005 * run["wheel.w"] ** 2 + run["shunt.q"] ** 2 / 2 / 0.5 + 0.5e-5 * run["shunt.i"] ** 2
    assert work == pytest.approx(stored, abs=1e-5 * stored.max())


def test_a_voice_coil_lags_and_brakes() -> None:
    coil = ia.VoiceCoil(Bl=12.0, R=3.0, L=2e-3)
    net = ia.Network("shaker", wall=ia.Fixed(), coil=coil, mass=ia.Mass(m=0.4), spring=ia.Spring(k=2e3))
    net.connect(net.wall.flange, net.coil.flange_a, net.spring.flange_a)
    net.connect(net.coil.flange_b, net.mass.flange, net.spring.flange_b)
    system = ia.analysis.linearise(net, ["coil.u"], ["mass.s", "coil.i"])
    f = np.array([1.0, 10.0, 11.3, 40.0, 300.0])
    s = 2j * np.pi * f
    electric = 3.0 + 2e-3 * s
    mechanical = 0.4 * s**2 + 2e3
    travel = 12 / electric / (mechanical + 144 * s / electric)
    assert system.response(f)[:, 0, 0] == pytest.approx(travel, rel=1e-9)
    assert system.response(f)[:, 1, 0] == pytest.approx(travel * mechanical / 12, rel=1e-9)


def test_what_a_worm_takes_at_a_speed_is_its_torque_times_that() -> None:
    root: Any = brentq(lambda rho: np.tan(0.15 + rho) / np.tan(0.15) - 2, 0.0, 0.5)
    run = worm(float(np.tan(root)), w=10.0).simulate(0.1, inputs={"motor.tau": lambda t: 4.02 + 0 * t})
    assert run["gear.lossPower"] == pytest.approx(
        np.full(len(run.time), 20.2), rel=1e-6
    )  # half of 4 N.m and 0.02


def test_a_worm_that_inertia_alone_would_lock_at_once_ends_the_run() -> None:
    """Friction in the bearings slows the worm; a heavy drum then presses the flanks more than it can push."""
    gear = rotational.WormGear(ratio=20.0, lead_angle=0.15, mu=0.2, tau_bf=0.1)
    net = ia.Network(
        "jam", gear=gear, rotor=rotational.Inertia(J=1e-3, w=30.0), drum=rotational.Inertia(J=50.0)
    )
    net.connect(net.rotor.flange, net.gear.flange_a).connect(net.gear.flange_b, net.drum.flange)
    with pytest.raises(ia.SimulationError, match="switch for ever: WormGear 'gear'"):
        net.simulate(1.0)
    run = net.simulate(1.0, parameters={"drum.J": 0.5})
    assert run.events[-1].target == "stuck"
