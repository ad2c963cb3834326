"""Speed-dependent sources, motions, power, gearboxes and vehicles, against closed forms and SciPy."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
BOTH = ("translational", "rotational")


def pushed(element: Any, start: float, inertia: float = 2.0) -> ia.Network:
    """Return a body on which a source acts."""
    turning = isinstance(element, rotational.SpeedDependentTorque | rotational.EddyCurrentBrake)
    turning = turning or type(element).__module__.split(".")[-2] == "rotational"
    body = rotational.Inertia(J=inertia, w=start) if turning else ia.Mass(m=inertia, v=start)
    net = ia.Network("pushed", source=element, body=body)
    return net.connect(net.source.flange, net.body.flange)


def speed(run: ia.Result) -> Array:
    return run["body.v"] if "body.v" in run else run["body.w"]


def source(domain: str, law: str, nominal: float, direction: bool) -> Any:
    if domain == "translational":
        kind = getattr(ia, f"{law}SpeedDependentForce")
        return kind(f_nominal=nominal, v_nominal=4.0, ForceDirection=direction)
    kind = getattr(rotational, f"{law}SpeedDependentTorque")
    return kind(tau_nominal=nominal, w_nominal=4.0, TorqueDirection=direction)


@pytest.mark.parametrize("domain", BOTH)
@pytest.mark.parametrize("start", [3.0, -3.0])
def test_a_load_that_turns_round_slows_either_way(domain: str, start: float) -> None:
    run = pushed(source(domain, "Linear", -1.2, False), start).simulate(5.0, rtol=1e-9)
    assert speed(run) == pytest.approx(start * np.exp(-1.2 / 4.0 / 2.0 * run.time), abs=1e-7)
    run = pushed(source(domain, "Quadratic", -1.6, False), start).simulate(5.0, rtol=1e-9)
    k = 1.6 / 16.0 / 2.0
    assert speed(run) == pytest.approx(start / (1 + k * abs(start) * run.time), abs=1e-7)
    run = pushed(source(domain, "Inverse", 0.8, False), start).simulate(5.0, rtol=1e-9)
    gained = np.sqrt(start**2 + 2 * 0.8 * 4.0 / 2.0 * run.time)  # at constant power
    assert speed(run) == pytest.approx(np.sign(start) * gained, abs=1e-7)


@pytest.mark.parametrize("domain", BOTH)
def test_a_source_of_one_direction_does_not_turn_round(domain: str) -> None:
    run = pushed(source(domain, "Linear", 1.2, True), -3.0).simulate(5.0, rtol=1e-9)
    assert speed(run) == pytest.approx(-3.0 * np.exp(-0.15 * run.time), abs=1e-7)
    run = pushed(source(domain, "Quadratic", 1.6, True), -3.0).simulate(5.0, rtol=1e-9)
    assert speed(run) == pytest.approx(-3.0 / (1 + 0.05 * 3.0 * run.time), abs=1e-7)
    run = pushed(source(domain, "Inverse", 0.8, True), 0.0).simulate(5.0, rtol=1e-9)
    until = 0.1 / 16.0  # below 0.1 the force is that at 0.1, 32
    gained = np.sqrt(0.1**2 + 2 * 0.8 * 4.0 / 2.0 * (run.time[1:] - until))
    assert speed(run)[1:] == pytest.approx(gained, abs=1e-6)


def test_a_load_at_rest_has_the_slope_of_its_law() -> None:
    """What is linearised at rest must not lose the damping."""
    net = pushed(source("translational", "Linear", -1.2, False), 0.0)
    net.add(push=ia.Force()).connect(net.push.flange, net.body.flange)
    linear = ia.analysis.linearise(net, ["push.f"], ["body.v"])
    assert np.linalg.eigvals(linear.A).real.min() == pytest.approx(-0.15)


@pytest.mark.parametrize("domain", BOTH)
def test_a_constant_speed_is_kept_against_any_load(domain: str) -> None:
    if domain == "translational":
        drive: Any = ia.ConstantSpeed(v_fixed=-2.0, s=0.5)
        net = ia.Network("kept", drive=drive, damper=ia.Damper(d=3.0), wall=ia.Fixed(), load=ia.Mass(m=5.0))
    else:
        net = ia.Network(
            "kept",
            drive=rotational.ConstantSpeed(w_fixed=-2.0, phi=0.5),
            damper=rotational.Damper(d=3.0),
            wall=rotational.Fixed(),
            load=rotational.Inertia(J=5.0),
        )
    net.connect(net.drive.flange, net.damper.flange_b, net.load.flange)
    net.connect(net.wall.flange, net.damper.flange_a)
    run = net.simulate(2.0)
    place, force = ("s", "f") if domain == "translational" else ("phi", "tau")
    assert run[f"load.{place}"] == pytest.approx(0.5 - 2.0 * run.time)
    assert run[f"drive.flange.{force}"] == pytest.approx(np.full(len(run.time), 6.0))


@pytest.mark.parametrize("domain", BOTH)
def test_a_motion_given_with_its_rates_is_followed_exactly(domain: str) -> None:
    signals: tuple[Any, ...] = (
        lambda t: 0.1 * np.sin(3 * t + 1),
        lambda t: 0.3 * np.cos(3 * t + 1),
        lambda t: -0.9 * np.sin(3 * t + 1),
    )
    if domain == "translational":
        drive: Any = ia.Move(**dict(zip(("s_ref", "v_ref", "a_ref"), signals, strict=True)))
        net = ia.Network("moved", drive=drive, load=ia.Mass(m=5.0))
        names = "load.s", "load.v", "load.flange.f"
    else:
        drive = rotational.Move(**dict(zip(("phi_ref", "w_ref", "a_ref"), signals, strict=True)))
        net = ia.Network("moved", drive=drive, load=rotational.Inertia(J=5.0))
        names = "load.phi", "load.w", "load.flange.tau"
    net.connect(net.drive.flange, net.load.flange)
    run = net.simulate(3.0, begin=0.4, rtol=1e-9)
    for name, signal, scale, close in zip(names, signals, (1, 1, 5), (1e-8, 1e-7, 1e-4), strict=True):
        assert run[name] == pytest.approx(scale * signal(run.time), abs=close)


@pytest.mark.parametrize("kind", ["PowerSensor", "MultiSensor"])
@pytest.mark.parametrize("domain", BOTH)
def test_power_is_what_a_body_gains(kind: str, domain: str) -> None:
    if domain == "translational":
        net = ia.Network(
            "gain",
            push=ia.Force(f=lambda t: 3 * np.cos(t)),
            meter=getattr(ia, kind)(),
            load=ia.Mass(m=2.0, v=-1.0),
        )
        energy = "load.v"
    else:
        net = ia.Network(
            "gain",
            push=rotational.Torque(tau=lambda t: 3 * np.cos(t)),
            meter=getattr(rotational, kind)(),
            load=rotational.Inertia(J=2.0, w=-1.0),
        )
        energy = "load.w"
    net.connect(net.push.flange, net.meter.flange_a).connect(net.meter.flange_b, net.load.flange)
    run = net.simulate(4.0, rtol=1e-9)
    assert run.mean("meter.power") * 4.0 == pytest.approx(run[energy][-1] ** 2 - 1.0, abs=1e-6)
    assert run["meter.power"] == pytest.approx(
        run["meter.f" if domain[0] == "t" else "meter.tau"] * run[energy]
    )
    assert run.unit("meter.power") == "W"


@pytest.mark.parametrize(
    ("reg", "law"),
    [
        ("Exp", lambda x: 2 / (1 + np.exp(-x / 0.01)) - 1),
        ("Sine", lambda x: np.where(np.abs(x) >= 1, np.sign(x), np.sin(np.pi / 2 * x))),
        ("Linear", lambda x: np.where(np.abs(x) >= 1, np.sign(x), x)),
        ("CoSine", lambda x: np.where(np.abs(x) >= 1, np.sign(x), np.sign(x) * (1 - np.cos(np.pi / 2 * x)))),
    ],
)
def test_rolling_resistance_is_rounded_as_told(reg: Any, law: Any) -> None:
    net = ia.Network(
        "rolling",
        drive=ia.Position(s_ref=lambda t: 0.3 * np.sin(t)),
        wheel=ia.RollingResistance(fWeight=200.0, CrConstant=0.02, inclinationConstant=0.5, v0=0.2, reg=reg),
    )
    net.connect(net.drive.flange, net.wheel.flange)
    run = net.simulate(6.0)
    expected = 0.02 * 200.0 * np.cos(np.arctan(0.5)) * law(0.3 * np.cos(run.time) / 0.2)
    assert run["wheel.f"] == pytest.approx(expected, abs=1e-9)
    assert run["wheel.flange.f"] == pytest.approx(expected, abs=1e-9)


def test_rolling_resistance_takes_signals() -> None:
    wheel = ia.RollingResistance(fWeight=200.0, useCrInput=True, useInclinationInput=True)
    net = ia.Network("rolling", drive=ia.ConstantSpeed(v_fixed=3.0), wheel=wheel)
    net.connect(net.drive.flange, net.wheel.flange)
    run = net.simulate(1.0, inputs={"wheel.cr": lambda t: 0.01 * (1 + t), "wheel.inclination": lambda t: t})
    assert run["wheel.f"] == pytest.approx(2.0 * (1 + run.time) * np.cos(np.arctan(run.time)))
    plain = ia.Network("plain", wheel=ia.RollingResistance(fWeight=1.0), u=ia.signals.Constant(k=1.0))
    plain.connect(plain.u.y, plain.wheel.cr)
    with pytest.raises(ia.ModelError, match=r"'wheel': cr is there with useCrInput=True only"):
        plain.dae()


def test_a_vehicle_in_wind_on_a_hill_moves_as_integrated_apart() -> None:
    m, J, R, A, Cd, rho, cr, slope = 1000.0, 4.0, 0.3, 2.2, 0.32, 1.2, 0.012, 0.06
    car = ia.Vehicle(
        m=m, J=J, R=R, A=A, Cd=Cd, CrConstant=cr, vReg=0.1, useInclinationInput=True, vWindConstant=-8.0
    )
    net = ia.Network("drive", car=car, motor=rotational.Torque(tau=lambda t: 400 * np.sin(0.4 * t + 0.5)))
    net.connect(net.motor.flange, net.car.flangeR)
    rise = {"car.inclination": lambda t: slope * np.sin(0.1 * t)}
    run = net.simulate(30.0, inputs=rise, start={"car.v": 5.0}, rtol=1e-9)

    def rates(t: float, y: Array) -> list[float]:
        v, angle = y[1], np.arctan(slope * np.sin(0.1 * t))
        air = Cd * A * rho / 2 * (v + 8) * abs(v + 8)
        rolling = cr * m * 9.80665 * np.cos(angle) * np.clip(v / 0.1, -1, 1)
        push = 400 * np.sin(0.4 * t + 0.5) / R
        return [v, (push - air - rolling - m * 9.80665 * np.sin(angle)) / (m + J / R**2)]

    known = solve_ivp(rates, (0, 30), [0.0, 5.0], t_eval=run.time, rtol=1e-9, atol=1e-9, max_step=0.05)
    assert run["car.s"] == pytest.approx(known.y[0], abs=1e-3)
    assert run["car.v"] == pytest.approx(known.y[1], abs=1e-4)
    assert run["car.v"].min() < 0 < run["car.v"].max()
    book = run.energy()
    assert book.closes < 1e-5
    assert {"motor", "car.wind", "car.slope"} <= book.supplied.keys()


def test_a_flank_strikes_with_its_whole_damping_and_lets_go_where_it_would_pull() -> None:
    c, d, b = 400.0, 4.0, 0.2
    net = ia.Network(
        "strike",
        wall=rotational.Fixed(),
        flanks=rotational.ElastoBacklash2(c=c, d=d, b=b, phi_rel0=0.3),
        wheel=rotational.Inertia(J=1.0, phi=0.3, w=-2.0),
    )
    net.connect(net.wall.flange, net.flanks.flange_a).connect(net.flanks.flange_b, net.wheel.flange)
    run = net.simulate(0.4, rtol=1e-10, atol=1e-12)
    w0 = np.sqrt(c - d**2 / 4)
    away = np.arctan2(-d * w0, c - d**2 / 2) % np.pi  # c x + d v = 0 for x = sin(w0 t) exp(-d t/2)
    leaves = 0.05 + away / w0
    touched, left = (event.time for event in run.events[:2])
    assert touched == pytest.approx(0.05)
    assert left == pytest.approx(leaves, abs=1e-7)
    assert run.at("flanks.tau", touched) == pytest.approx(-d * 2.0, rel=1e-6)  # the damping acts at once
    t = leaves - 0.05
    back = 2.0 * np.exp(-d * t / 2) * (np.cos(w0 * t) - d / 2 / w0 * np.sin(w0 * t))
    assert run.at("wheel.w", leaves + 0.02) == pytest.approx(-back, abs=1e-6)


def test_a_gearbox_is_a_lossy_gear_and_an_elastic_shaft() -> None:
    losses = ((0.0, 0.95, 0.9, 0.2, 0.3), (10.0, 0.9, 0.85, 0.4, 0.5))
    shaft: dict[str, Any] = {"c": 80.0, "d": 0.5, "b": 0.05}
    one = ia.Network("one", box=rotational.Gearbox(ratio=3.0, lossTable=losses, **shaft))
    two = ia.Network(
        "two", gear=rotational.LossyGear(ratio=3.0, lossTable=losses), link=rotational.ElastoBacklash(**shaft)
    )
    two.connect(two.gear.flange_b, two.link.flange_a)
    runs = []
    for net, a, b in ((one, one.box.flange_a, one.box.flange_b), (two, two.gear.flange_a, two.link.flange_b)):
        net.add(
            motor=rotational.Torque(tau=lambda t: 5 * np.sin(2 * t)),
            rotor=rotational.Inertia(J=0.1),
            load=rotational.Inertia(J=1.0),
            brake=rotational.Damper(d=1.0),
            wall=rotational.Fixed(),
        )
        net.connect(net.motor.flange, net.rotor.flange, a)
        net.connect(b, net.load.flange, net.brake.flange_b).connect(net.wall.flange, net.brake.flange_a)
        runs.append(net.simulate(5.0, rtol=1e-8))
    t = np.linspace(0, 5, 200)
    assert runs[0].at("load.phi", t) == pytest.approx(runs[1].at("load.phi", t), abs=1e-6)
    lost = runs[1].mean("gear.lossPower") + runs[1].mean("link.lossPower")
    assert runs[0].mean("box.lossPower") == pytest.approx(lost, rel=1e-5)


def test_backlash_is_alike_in_both_domains() -> None:
    numbers: dict[str, Any] = {"d": 3.0}
    pairs: list[tuple[Any, Any]] = [
        (
            ia.Backlash(k=50.0, eps=0.1, s_rel0=0.2, **numbers),
            rotational.Backlash(c=50.0, eps=0.1, phi_rel0=0.2, **numbers),
        ),
        (
            ia.ElastoBacklash(k=50.0, b=0.2, s_rel0=0.2, **numbers),
            rotational.ElastoBacklash(c=50.0, b=0.2, phi_rel0=0.2, **numbers),
        ),
    ]
    for sliding, turning in pairs:
        first = ia.Network("slides", wall=ia.Fixed(), play=sliding, body=ia.Mass(m=1.0, s=0.2, v=-2.0))
        second = ia.Network(
            "turns", wall=rotational.Fixed(), play=turning, body=rotational.Inertia(J=1.0, phi=0.2, w=-2.0)
        )
        runs = []
        for net in (first, second):
            net.connect(net.wall.flange, net.play.flange_a).connect(net.play.flange_b, net.body.flange)
            runs.append(net.simulate(2.0))
        assert runs[0]["play.f"] == pytest.approx(runs[1]["play.tau"], abs=1e-9)
        assert runs[0]["play.lossPower"] == pytest.approx(runs[1]["play.lossPower"], abs=1e-9)
        assert np.abs(runs[0]["play.f"]).max() > 1.0
