"""Machines of buildings, cars, aircraft, railways, plants: closed forms, integrations written apart."""

from math import cos, pi, sin, sqrt
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from inertance import rotational
from inertance.analysis import den_hartog, linearise
from inertance.machines import InterconnectedStruts, OleoStrut, PitchingBody, Unbalance
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
FEW = settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow])
STRUTS: dict[str, Any] = {"A_b": 8e-4, "A_r": 5e-4, "p_0": 2e6, "V_0": 2e-4, "R": 2e9}
OLEO: dict[str, Any] = {
    "s_rel0": 0.8, "A_a": 2e-3, "A_h": 1.6e-3, "A_o": 3e-5, "p_0": 1.5e6, "V_0": 8e-4, "n": 1.3, "C_d": 0.9,
    "rho": 870.0,
}  # fmt: skip


def frequencies(M: Any, K: Any) -> Array:
    """Undamped natural frequencies of matrices by hand [rad/s]."""
    return np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(np.asarray(M), np.asarray(K))).real))


def integral(run: ia.Result, power: Any) -> Array:
    return np.concatenate([[0.0], np.cumsum(np.diff(run.time) * (power[1:] + power[:-1]) / 2)])


# ---- building -------------------------------------------------------------------------------------------


def test_a_rigid_building_on_bearings_with_a_tid_has_den_hartogs_height() -> None:
    """At the fixed points the bearings' motion per ground acceleration is sqrt(1 + 2/mu)/w^2, any damping."""
    m, mu, T = [200e3] * 4, 0.15, 2.5
    M, w = 300e3 + sum(m), 2 * pi / T
    rule, points = den_hartog(mu), np.sqrt((1 + np.array([-1, 1]) * sqrt(mu / (2 + mu))) / (1 + mu))
    for damping in (0.3, 1.0):
        tid = ia.machines.tid(rule.stiffness(mu * M, w), damping * rule.damping(mu * M, w), mu * M)
        building = ia.machines.isolated_building(m, [1e11] * 4, zeta_b=0.0, T_b=T, absorber=tid)
        system = linearise(building, ["der(der(ground.s_ref))"], ["storey1.s_rel"])
        for point in points:
            assert abs(system(1j * point * w).item()) == pytest.approx(sqrt(1 + 2 / mu) / w**2, rel=1e-3)


def test_a_building_on_bearings_swings_with_their_period_and_damping() -> None:
    building = ia.machines.isolated_building([200e3] * 4, [1e12] * 4, T_b=2.5, zeta_b=0.07)
    first = linearise(building).modes()[0]
    assert first.frequency == pytest.approx(0.4, rel=1e-4)
    assert first.damping == pytest.approx(0.07, rel=1e-4)


def test_an_elastic_building_is_eigenvalues_by_hand() -> None:
    m, k = [3e5, 2e5, 1e5], [250e6, 200e6]
    building = ia.machines.isolated_building(m[1:], k, m_b=m[0], T_b=2.0, zeta_b=0.0)
    k_b = sum(m) * pi**2
    K = [[k_b + k[0], -k[0], 0], [-k[0], k[0] + k[1], -k[1]], [0, -k[1], k[1]]]
    found = [2 * pi * mode.frequency for mode in linearise(building).modes()]
    assert found == pytest.approx(frequencies(np.diag(m), K), rel=1e-9)


# ---- interconnected car ---------------------------------------------------------------------------------


def changed(values: dict[str, Any], **others: float) -> dict[str, Any]:
    return {**values, **others}


def test_interconnected_struts_are_stiff_in_roll_and_soft_in_heave() -> None:
    """k = n p_0/V_0 (A_b -+ A_r)^2 a strut, each strut moved by hand over the static slope."""
    A_b, A_r, n = STRUTS["A_b"], STRUTS["A_r"], 1.4
    for other, area in ((1.0, A_b - A_r), (-1.0, A_b + A_r)):
        net: Any = ia.Network(
            "moved", struts=InterconnectedStruts(**STRUTS), base=ia.Fixed(), left=ia.Position(),
            right=ia.Position(),
        )  # fmt: skip
        net.connect(net.base.flange, net.struts.left_a, net.struts.right_a)
        net.connect(net.left.flange, net.struts.left_b).connect(net.right.flange, net.struts.right_b)
        t = np.linspace(0.0, 100.0, 11)
        slow = {"left.s_ref": (t, 1e-6 * t), "right.s_ref": (t, other * 1e-6 * t)}
        run = net.simulate(100.0, inputs=slow)
        stiffness = n * STRUTS["p_0"] / STRUTS["V_0"] * area**2
        resistance = STRUTS["R"] * area**2 * 1e-6  # what the valves add at this speed
        assert -run["left.flange.f"][-1] == pytest.approx(stiffness * 1e-4 + resistance, rel=2e-3)
        assert run["right.flange.f"][-1] == pytest.approx(other * run["left.flange.f"][-1], rel=2e-3)


def test_an_interconnected_car_is_four_equations_by_hand() -> None:
    car = ia.machines.interconnected_car(InterconnectedStruts(**changed(STRUTS, R=0.0)), d=0.0)
    found = sorted(2 * pi * mode.frequency for mode in linearise(car).modes())
    gas = 1.4 * STRUTS["p_0"] / STRUTS["V_0"]
    strut = {side: 15e3 + gas * (STRUTS["A_b"] + side * STRUTS["A_r"]) ** 2 for side in (-1, 1)}
    soft, stiff = 2 * strut[-1], 2 * 0.75**2 * strut[1]
    heave = frequencies(np.diag([700.0, 80.0]), [[soft, -soft], [-soft, soft + 400e3]])
    arm = 2 * 0.75**2  # the wheels' roll as an angle, both sides at half the track
    roll = frequencies(np.diag([230.0, 40.0 * arm]), [[stiff, -stiff], [-stiff, stiff + 200e3 * arm]])
    assert found == pytest.approx(sorted([*heave, *roll]), rel=1e-6)


@FEW
@given(
    V_0=st.floats(1e-4, 5e-4), R=st.floats(0.0, 5e9), A_r=st.floats(1e-4, 9e-4), n=st.floats(1.0, 1.6),
    size=st.floats(0.005, 0.03),
)  # fmt: skip
def test_interconnected_struts_store_and_lose_what_goes_in(
    V_0: float, R: float, A_r: float, n: float, size: float
) -> None:
    """Gas stores the integral of p - p_0 over V, valves lose R q^2; the two sides move differently."""
    net: Any = ia.Network(
        "rig", base=ia.Fixed(),
        struts=InterconnectedStruts(**changed(STRUTS, V_0=V_0, R=R, A_r=A_r, n=n)),
        left=ia.Position(), right=ia.Position(),
    )  # fmt: skip
    net.connect(net.base.flange, net.struts.left_a, net.struts.right_a)
    net.connect(net.left.flange, net.struts.left_b).connect(net.right.flange, net.struts.right_b)
    t = np.linspace(0.0, 1.0, 2001)
    moves = {"left": size * np.sin(9 * t), "right": -0.6 * size * np.sin(14 * t)}
    run = net.simulate(1.0, step=1e-3, rtol=1e-9, inputs={f"{k}.s_ref": (t, v) for k, v in moves.items()})
    p_0 = STRUTS["p_0"]
    stored = np.zeros(len(run.time))
    lost = np.zeros(len(run.time))
    for line in ("1", "2"):
        V = run[f"struts.V_{line}"]
        logarithm = -np.log(1 - V / V_0)
        stored += p_0 * V_0 * (logarithm if n == 1 else np.expm1((n - 1) * logarithm) / (n - 1)) - p_0 * V
        lost += R * run[f"struts.q_{line}"] ** 2
    assert run["struts.potential"] == pytest.approx(stored, abs=1e-9 * max(stored) + 1e-12)
    assert run["struts.lossPower"] == pytest.approx(lost, rel=1e-9)
    t = run.time
    speeds = {"left": 9 * size * np.cos(9 * t), "right": -8.4 * size * np.cos(14 * t)}
    work = sum(run[f"struts.{side}_b.f"] * v for side, v in speeds.items())
    balance = integral(run, work - lost)
    assert stored - stored[0] == pytest.approx(balance, abs=2e-3 * max(abs(balance)) + 1e-6)


# ---- landing gear ---------------------------------------------------------------------------------------


def dropped(sink: float, lift: float, m: float, m_w: float, k_t: float, stop: float) -> Any:
    """A drop written apart: locked until the tyre overcomes the gas, then two masses."""
    p, g = OLEO, 9.80665
    c = p["rho"] * p["A_h"] ** 3 / (2 * (p["C_d"] * p["A_o"]) ** 2)
    over = lift * (m + m_w) - m

    def tyre(z: float) -> float:
        return max(-k_t * z, 0.0)

    def locked(_: float, y: Any) -> list[float]:
        return [y[1], (tyre(y[0]) + (over - m_w) * g) / (m + m_w)]

    def pressed(_: float, y: Any) -> float:
        acceleration = locked(0.0, y)[1]
        return float(m * acceleration - over * g - p["p_0"] * p["A_a"])

    pressed.terminal = True  # type: ignore[attr-defined]
    first = solve_ivp(locked, (0, 1), [0.0, -sink], events=pressed, rtol=1e-11, atol=1e-13)
    z, v = first.y[:, -1]

    def moving(_: float, y: Any) -> list[float]:
        z_w, v_w, z_a, v_a = y
        stroke, speed = p["s_rel0"] - (z_a - z_w), -(v_a - v_w)
        strut = p["p_0"] * p["A_a"] * (p["V_0"] / (p["V_0"] - p["A_a"] * stroke)) ** p["n"] + c * speed * abs(
            speed
        )
        return [v_w, (tyre(z_w) - strut - m_w * g) / m_w, v_a, (strut + over * g) / m]

    return first.t[-1], solve_ivp(
        moving, (first.t[-1], stop), [z, v, z + p["s_rel0"], v], rtol=1e-10, atol=1e-12, dense_output=True
    )


@pytest.mark.parametrize(("sink", "lift", "m", "m_w"), [(3.0, 1.0, 1000.0, 20.0), (1.2, 0.0, 1600.0, 35.0)])
def test_a_drop_is_that_of_an_integration_written_apart(
    sink: float, lift: float, m: float, m_w: float
) -> None:
    gear = ia.machines.landing_gear(
        OleoStrut(**OLEO), L=OLEO["s_rel0"], sink=sink, lift=lift, m=m, m_w=m_w, k_t=300e3, d_t=0.0
    )
    run = gear.simulate(0.3, step=1e-3, rtol=1e-9, atol=1e-11)
    unlocked, exact = dropped(sink, lift, m, m_w, 300e3, 0.3)
    opened = next(event.time for event in run.events if event.target == "free")
    assert opened == pytest.approx(unlocked, abs=1e-7)
    t = run.time[run.time > unlocked]
    z_w, _, z_a, _ = exact.sol(t)
    assert run["wheel.s"][run.time > unlocked] == pytest.approx(z_w, abs=2e-6)
    assert run["airframe.s"][run.time > unlocked] == pytest.approx(z_a, abs=2e-6)
    load = -run["ground.flange.f"]
    assert load.max() == pytest.approx((300e3 * np.maximum(-z_w, 0)).max(), rel=1e-4)


@FEW
@given(sink=st.floats(0.5, 3.5), A_o=st.floats(2e-5, 8e-5), n=st.floats(1.05, 1.5), m_w=st.floats(5.0, 60.0))
def test_an_oleo_strut_stores_and_loses_what_the_airframe_brings(
    sink: float, A_o: float, n: float, m_w: float
) -> None:
    values = changed(OLEO, A_o=A_o, n=n)
    gear = ia.machines.landing_gear(OleoStrut(**values), L=0.8, sink=sink, m_w=m_w, d_t=0.0, lift=0.4)
    run = gear.simulate(0.12, step=1e-4, rtol=1e-9, atol=1e-11)
    stroke = 0.8 - run["strut.s_rel"]
    gas = (
        values["p_0"]
        * values["V_0"]
        / (n - 1)
        * ((1 - values["A_a"] * stroke / values["V_0"]) ** (1 - n) - 1)
    )
    c = values["rho"] * values["A_h"] ** 3 / (2 * (values["C_d"] * A_o) ** 2)
    elastic = 150e3 * np.minimum(run["wheel.s"], 0.0) ** 2
    kinetic = 500.0 * run["airframe.v"] ** 2 + m_w / 2 * run["wheel.v"] ** 2
    g = 9.80665
    heights = g * (1000.0 - 0.4 * (1000.0 + m_w)) * run["airframe.s"] + g * m_w * run["wheel.s"]
    energy = gas + elastic + kinetic + heights
    lost = integral(run, c * abs(run["strut.v_rel"]) ** 3)
    assert energy - energy[0] == pytest.approx(-lost, abs=2e-4 * kinetic[0])
    assert lost[-1] > 0.01 * kinetic[0]


# ---- clutch and drivetrain ------------------------------------------------------------------------------


def slipping(slope: float, d: float, run_for: float = 0.05) -> tuple[Any, Any]:
    """A drivetrain whose clutch slips at some 100 rad/s, linearised there, and its clutch's force."""
    table = ((0.0, 0.4), (200.0, 0.4 + 200 * slope))
    clutch = rotational.Clutch(fn_max=2000.0, cgeo=0.2, mu_pos=table, f_normalized=0.5)
    train = ia.machines.clutch_drivetrain(clutch, d=d)
    run = train.simulate(run_for, start={"engine.w": 100.0}, inputs={"engine_torque.tau": 80.0})
    return linearise(train, [], at=run, time=run_for), run


def by_hand(slope: float, d: float) -> Any:
    """The pole of engine, disc and car at the clutch, which is a damper of its slope."""
    i, J_v, c = 13.0, 1400.0 * 0.3**2 / 13.0**2, 9000.0 / 13.0**2
    J, clutch, shaft = np.diag([0.2, 0.02, J_v]), slope * 0.2 * 1000.0, d / i**2
    D = np.array([[clutch, -clutch, 0], [-clutch, clutch + shaft, -shaft], [0, -shaft, shaft]])
    C = np.array([[0, 0, 0], [0, c, -c], [0, -c, c]])
    A = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(J, C), -np.linalg.solve(J, D)]])
    poles = np.linalg.eigvals(A)
    return poles[np.argmax(poles.imag)]


@pytest.mark.parametrize("slope", [-6e-4, 0.0, 5e-4])
@pytest.mark.parametrize("d", [5.0, 40.0])
def test_judder_is_a_pole_of_equations_by_hand(slope: float, d: float) -> None:
    system, _ = slipping(slope, d)
    pole = max(system.poles, key=lambda p: p.imag)
    assert pole == pytest.approx(by_hand(slope, d), rel=1e-6)


def test_judder_begins_at_the_slope_in_closed_form() -> None:
    """-mu' cgeo fn i^2 = d (1 + i^2 J_d/(m R^2))^2: damped just above, growing just below."""
    d, i = 4.0, 13.0
    critical = -d / i**2 * (1 + i**2 * 0.02 / (1400.0 * 0.3**2)) ** 2 / (0.2 * 1000.0)
    for share, grows in ((0.97, False), (1.03, True)):
        system, _ = slipping(share * critical, d)
        pole = max(system.poles, key=lambda p: p.imag)
        assert (pole.real > 0) == grows
    assert abs(pole.imag) / (2 * pi) == pytest.approx(
        sqrt(9000.0 / i**2 * (1 / 0.02 + i**2 / (1400.0 * 0.3**2))) / (2 * pi), rel=1e-3
    )


@pytest.mark.parametrize("slope", [-8e-4, 8e-4])
def test_a_lining_that_falls_shakes_the_car_and_one_that_rises_calms_it(slope: float) -> None:
    """What the clutch's grip excites grows or dies as the pole says while it slips; sticking bounds it."""
    table = ((0.0, 0.4), (200.0, 0.4 + 200 * slope))
    clutch = rotational.Clutch(fn_max=2000.0, cgeo=0.2, mu_pos=table, f_normalized=0.5)
    train = ia.machines.clutch_drivetrain(clutch, d=2.0)
    run = train.simulate(0.6, step=1e-3, start={"engine.w": 150.0}, inputs={"engine_torque.tau": 60.0})
    pole = by_hand(slope, 2.0)
    period = 2 * pi / pole.imag
    swings = []
    for begin in (0.02, 0.02 + period):
        window = (run.time >= begin) & (run.time <= begin + period)
        assert (run["clutch.mode"][window] == 3).all()
        swings.append(np.ptp(run["shafts.tau"][window]))
    assert swings[1] / swings[0] == pytest.approx(np.exp(pole.real * period), rel=0.03)
    stuck = (run["clutch.mode"][run.time < 0.4] == 1).any()
    assert stuck == (slope < 0)
    assert (pole.real > 0) == (slope < 0)


# ---- bogie ----------------------------------------------------------------------------------------------


def test_a_bogie_bounces_and_pitches_as_equations_by_hand() -> None:
    train = ia.machines.bogie(
        ia.SpringDamper(k=1.2e6, d=0.0), ia.SpringDamper(k=0.6e6, d=0.0), m_c=15e3, m=2.5e3, J=2e3, l=1.25
    )
    found = sorted(2 * pi * mode.frequency for mode in linearise(train).modes())
    k_p, k_s, k_r = 1.2e6, 0.6e6, 1e9
    bounce = frequencies(
        np.diag([15e3, 2.5e3, 2.4e3]),
        [[k_s, -k_s, 0], [-k_s, k_s + 2 * k_p, -2 * k_p], [0, -2 * k_p, 2 * k_p + 2 * k_r]],
    )
    arm = 2 * 1.25**2
    pitch = frequencies(
        np.diag([2e3, 1.2e3 * arm]), [[k_p * arm, -k_p * arm], [-k_p * arm, (k_p + k_r) * arm]]
    )
    assert found == pytest.approx(sorted([*bounce, *pitch]), rel=1e-6)


@pytest.mark.parametrize(("n", "bounces"), [(1.5, False), (2.0, True)])
def test_the_wheelbase_filters_what_a_bogie_feels(n: float, bounces: bool) -> None:
    """A wave of length 2 l/n under both axles: the axles oppositely or alike, so no bounce or no pitch."""
    train = ia.machines.bogie()
    V, length = 30.0, 2 * 1.25 / n
    w, delay = 2 * pi * V / length, 2 * 1.25 / V
    system = linearise(train, ["front_rail.s_ref", "rear_rail.s_ref"], ["frame.s", "frame.theta"])
    felt = system(1j * w) @ np.array([1.0, np.exp(-1j * w * delay)])
    both = np.abs(system(1j * w)).max(axis=1)
    assert (abs(felt[0]) > 0.1 * both[0]) == bounces
    assert (abs(felt[1]) > 0.1 * both[1]) != bounces
    assert min(abs(felt) / both) < 1e-9


def test_a_load_on_the_middle_of_a_body_lifts_it_without_pitch() -> None:
    net: Any = ia.Network("body", body=PitchingBody(m=3.0, J=1.0, l_f=1.0, l_r=2.0), push=ia.Force(f=6.0))
    net.connect(net.push.flange, net.body.centre)
    run = net.simulate(1.0)
    assert run["body.s"] == pytest.approx(run.time**2)
    assert run["body.theta"] == pytest.approx(0.0)


# ---- unbalance ------------------------------------------------------------------------------------------


def test_an_unbalance_that_is_driven_shakes_with_m_e_w_squared() -> None:
    net: Any = ia.Network("held", drive=rotational.Speed(), exciter=Unbalance(m=2.0, e=0.03), wall=ia.Fixed())
    net.connect(net.drive.flange, net.exciter.shaft).connect(net.exciter.flange, net.wall.flange)
    run = net.simulate(0.5, step=1e-3, inputs={"drive.w_ref": -50.0})
    assert -run["wall.flange.f"] == pytest.approx(-2.0 * 0.03 * 2500.0 * np.sin(-50.0 * run.time), abs=1e-3)


def test_a_sieve_swings_as_two_equations_by_hand() -> None:
    """Steady motion of box and frame, and the force into the ground, at 95 rad/s."""
    M, M_f, k, d, k_f, d_f, m_e, e, w = 2500.0, 1500.0, 600e3, 2.5e3, 6e6, 10e3, 150.0, 0.1, 95.0
    sieve = ia.machines.sieve()
    run = sieve.simulate(24.0, step=2e-3, inputs={"drive.w_ref": w}, rtol=1e-8)
    link, pads = k + 1j * w * d, k_f + 1j * w * d_f
    dynamic = np.array([[link - (M + m_e) * w**2, -link], [-link, link + pads - M_f * w**2]])
    box, frame = np.linalg.solve(dynamic, [m_e * e * w**2, 0.0])
    late = run.time > 20.0
    assert np.ptp(run["box.s"][late]) / 2 == pytest.approx(abs(box), rel=2e-3)
    assert np.ptp(run["pads.f"][late]) / 2 == pytest.approx(abs(pads * frame), rel=5e-3)
    assert abs(box) == pytest.approx(m_e * e / (M + m_e), rel=0.05)


def test_a_foundation_has_the_damping_of_the_half_space() -> None:
    m, r, rho, nu, G = 60e3 + 100.0, 2.0, 1800.0, 0.33, 40e6
    block = linearise(ia.machines.machine_foundation(), [], at="start").modes()[-1]
    B = (1 - nu) * m / (4 * rho * r**3)
    assert block.damping == pytest.approx(0.425 / sqrt(B), rel=1e-9)
    assert 2 * pi * block.frequency == pytest.approx(sqrt(4 * G * r / (1 - nu) / m), rel=1e-9)


@FEW
@example(m=5.0, e=0.1875, phi=0.0, w=34.0, v=0.0, tau=0.0)
@given(
    m=st.floats(0.1, 5.0), e=st.floats(0.01, 0.2), phi=st.floats(-3.0, 3.0), w=st.floats(-40.0, 40.0),
    v=st.floats(-1.0, 1.0), tau=st.floats(-2.0, 2.0),
)  # fmt: skip
def test_an_unbalance_keeps_power_and_follows_lagrange(
    m: float, e: float, phi: float, w: float, v: float, tau: float
) -> None:
    """A free rotor in a free housing on a spring, against Lagrange's equations integrated by SciPy."""
    J, M, k = 0.3, 4.0, 200.0
    net: Any = ia.Network(
        "shaker", exciter=Unbalance(m=m, e=e), rotor=rotational.Inertia(J=J, phi=phi, w=w),
        box=ia.Mass(m=M, s=0.1, v=v),
        motor=rotational.Torque(tau=tau), wall=ia.Fixed(), spring=ia.Spring(k=k),
    )  # fmt: skip
    net.connect(net.motor.flange, net.rotor.flange, net.exciter.shaft)
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.box.flange, net.exciter.flange)
    run = net.simulate(1.0, step=1e-3, rtol=1e-10, atol=1e-12)

    def lagrange(_: float, y: Any) -> list[float]:
        s, angle, v_s, rate = y
        inertia = np.array([[M + m, m * e * cos(angle)], [m * e * cos(angle), J + m * e**2]])
        acting = [m * e * rate**2 * sin(angle) - k * s, tau]
        return [v_s, rate, *np.linalg.solve(inertia, acting)]

    exact = solve_ivp(lagrange, (0, 1), [0.1, phi, v, w], rtol=1e-12, atol=1e-13, t_eval=[0.25, 0.5, 1.0])
    for row, name in ((0, "box.s"), (1, "rotor.phi")):
        assert run.at(name, exact.t) == pytest.approx(exact.y[row], abs=1e-6)
    off = v_along(run, e)
    kinetic = (M * run["box.v"] ** 2 + J * run["rotor.w"] ** 2 + m * off) / 2
    energy = kinetic + k / 2 * run["box.s"] ** 2 - tau * (run["rotor.phi"] - phi)
    assert energy == pytest.approx(energy[0], abs=1e-6 * (1 + abs(kinetic).max()))


def v_along(run: ia.Result, e: float) -> Any:
    """Squared velocity of the mass off the axis."""
    w, phi = run["rotor.w"], run["rotor.phi"]
    return (run["box.v"] + e * w * np.cos(phi)) ** 2 + (e * w * np.sin(phi)) ** 2


# ---- what is wrong is told -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: ia.machines.isolated_building([1e5], [1e8, 1e8]), "as many m, k and d"),
        (lambda: ia.machines.isolated_building([1e5], [1e8], T_b=0.0), "T_b must be above 0 s"),
        (lambda: ia.machines.landing_gear(OleoStrut(**OLEO), L=0.8, lift=2.0), "lift"),
        (lambda: ia.machines.machine_foundation(nu=0.7), "nu"),
        (lambda: ia.machines.bogie(l=-1.0), "l must be above 0 m"),
        (
            lambda: ia.machines.interconnected_car(InterconnectedStruts(**STRUTS), w=0.0),
            "w must be above 0 m",
        ),
    ],
)
def test_what_makes_no_machine_is_told(make: Any, told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        make()
