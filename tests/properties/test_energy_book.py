"""The energy book closes for every component there is, over sticking, shocks and prescribed motions."""

from functools import cache
from typing import Any

import inertance as ia
import numpy as np
import pytest
from elements import STARTS, rig, with_flanges
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from inertance import rotational
from inertance.cli.catalogue import all_names
from inertance.components.language import (
    LOSS_POWER,
    Parameter,
)

FEW = settings(max_examples=5, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@pytest.mark.parametrize("name", with_flanges())
def test_the_book_closes_for_every_component(name: str) -> None:
    run = rig(name).simulate(4.0, step=5e-3, rtol=1e-9, atol=1e-11, start=STARTS.get(name))
    book = run.energy()
    assert book.undeclared == {}, f"{name} must declare kinetic, potential or lossPower"
    assert book.turnover > 1e-3
    assert book.closes < 1e-5  # corners of a law between two points are not followed
    if run.dae.derived.unit(f"element.{LOSS_POWER}") is not None:
        lost = run[f"element.{LOSS_POWER}"]
        assert lost.min() >= -1e-9 * lost.max()


PASSIVE: dict[str, tuple[str, ...]] = {  # parameters with other values of which a law is none, or gives power
    "BoucWen": ("beta", "gamma"),
    "BoucWenDamper": ("beta", "gamma"),
    "LeadScrew": ("mu", "lead", "d_m"),
    "SliderCrank": ("r", "l", "e"),
    "SpencerDamper": ("beta", "gamma"),
    "Tyre": ("C",),
    "rotational.BoucWen": ("beta", "gamma"),
}
NEW = (
    "AirSpring",
    "BoucWen",
    "BoucWenDamper",
    "Cam",
    "ConstantSpeed",
    "DahlFriction",
    "EddyCurrentBrake",
    "ElastoBacklash",
    "FluidInerter",
    "FractionalDamper",
    "InverseSpeedDependentForce",
    "Iwan",
    "LeadScrew",
    "LinearSpeedDependentForce",
    "LuGreFriction",
    "LumpedRod",
    "MapSpringDamper",
    "MassWithLength",
    "Maxwell",
    "ModalRod",
    "MonotubeDamper",
    "Move",
    "MultiSensor",
    "ObliqueSprings",
    "PositionDependentFriction",
    "PowerSensor",
    "QuadraticSpeedDependentForce",
    "RelaxingBacklash",
    "RollingResistance",
    "Rope",
    "SliderCrank",
    "SpencerDamper",
    "TabulatedDamper",
    "TabulatedForce",
    "TabulatedSpring",
    "TemperatureDependentFriction",
    "Tyre",
    "VariableInerter",
    "Vehicle",
    "VoiceCoil",
    "WireRope",
    "Zener",
    "machines.DualMassFlywheel",
    "machines.InterconnectedStruts",
    "machines.MechatronicInerter",
    "machines.NES",
    "machines.OleoStrut",
    "machines.RigidRingTyre",
    "machines.Servo",
    "machines.Shaker",
    "machines.TorsionalDamper",
    "machines.Unbalance",
    "rotational.Backlash",
    "rotational.BeltDrive",
    "rotational.BoucWen",
    "rotational.ConstantSpeed",
    "rotational.DCMotor",
    "rotational.Differential",
    "rotational.EddyCurrentBrake",
    "rotational.ElastoBacklash2",
    "rotational.Gearbox",
    "rotational.HarmonicDrive",
    "rotational.InverseSpeedDependentTorque",
    "rotational.Iwan",
    "rotational.LinearSpeedDependentTorque",
    "rotational.LuGreFriction",
    "rotational.LumpedShaft",
    "rotational.ModalShaft",
    "rotational.Move",
    "rotational.MultiSensor",
    "rotational.PowerSensor",
    "rotational.QuadraticSpeedDependentTorque",
    "rotational.RelaxingBacklash",
    "rotational.ShuntedMotor",
    "rotational.TabulatedDamper",
    "rotational.TabulatedForce",
    "rotational.TabulatedSpring",
    "rotational.TemperatureDependentFriction",
    "rotational.UniversalJoint",
)
FREE = {  # how many of the bodies on its flanges have a speed of their own
    "Cam": 1, "ConstantSpeed": 0, "LeadScrew": 1, "MassWithLength": 1, "Move": 0, "MultiSensor": 1,
    "PowerSensor": 1, "SliderCrank": 1, "Vehicle": 1, "rotational.ConstantSpeed": 0,
    "rotational.Differential": 2, "rotational.Move": 0, "rotational.MultiSensor": 1,
    "rotational.PowerSensor": 1, "rotational.UniversalJoint": 1,
}  # fmt: skip


@cache
def assembled(name: str) -> ia.DAE:
    return rig(name).dae()


def scaled(name: str, path: str, value: float, scale: float) -> float:
    """Return a parameter of an element, or of a part of it, times a factor, within its bounds."""
    field = all_names()[name].fields.get(path.removeprefix("element."))
    if not isinstance(field, Parameter):
        return value * scale
    least = max(b for b in (field.min, field.above, -np.inf) if b is not None)
    return min(max(value * scale, least), np.inf if field.max is None else field.max)


@pytest.mark.parametrize("name", NEW)
@settings(max_examples=3, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_the_book_closes_whatever_the_numbers_and_the_start(name: str, data: st.DataObject) -> None:
    dae = assembled(name)
    scales = st.floats(0.3, 3.0)
    kept = {f"element.{key}" for key in ("peak", "T", "TRef", *PASSIVE.get(name, ()))}
    own = {p: v for p, v in dae.parameter_values.items() if p.startswith("element.") and p not in kept}
    parameters = {path: scaled(name, path, v, data.draw(scales, label=path)) for path, v in own.items()}
    bodies = [f"{path}.{v}" for path in dae.flat.instances for v in ("v", "w") if path.startswith("body")]
    free = [n for n in bodies if n in set(dae.names())][: FREE.get(name)]
    start = {n: data.draw(st.floats(-2, 2), label=n) for n in free}
    run = ia.simulate(dae, 2.0, begin=0.6, step=2e-3, rtol=1e-8, parameters=parameters, start=start)
    book = run.energy()
    assert book.undeclared == {}
    assert book.closes < 1e-4
    if "element.lossPower" in run:
        assert run["element.lossPower"].min() >= -1e-9 * book.turnover


def test_what_follows_a_burst_counts_though_its_power_is_small_beside_it() -> None:
    dae, factors = assembled("FluidInerter"), {"A_p": 2.0, "D": 0.5, "zeta": 3.0}
    parameters = {f"element.{k}": dae.parameter_values[f"element.{k}"] * by for k, by in factors.items()}
    start = {"body0.v": 1.0, "body1.v": -2.0}
    run = ia.simulate(dae, 2.0, begin=0.6, step=2e-3, rtol=1e-8, parameters=parameters, start=start)
    assert run.energy().closes < 1e-6


LOSSY = [name for name in with_flanges() if "heatPort" in all_names()[name].fields]


@pytest.mark.parametrize("name", LOSSY)
def test_what_is_lost_heats_what_is_joined_to_it(name: str) -> None:
    run = rig(name, useHeatPort=True).simulate(2.0, step=5e-3, rtol=1e-9, atol=1e-11)
    book = run.energy()
    struck = sum(event.impulse is not None for event in run.events)
    if not struck:
        heat = 2.0 * (run["store.T"] - 293.15)
        assert heat == pytest.approx(book.dissipated["element"], abs=1e-5 * book.turnover)
    assert book.closes < 1e-5


def test_the_book_shows_what_an_element_keeps_silent() -> None:
    class Silent(ia.Compliant):
        """f = 5 s_rel."""

        def equations(self) -> Any:
            yield self.f == 5 * self.s_rel

    class Boastful(Silent):
        """Declares half of what it stores."""

        potential = ia.energy(lambda self: 5 * self.s_rel**2 / 4)

    for element, kind in ((Silent(), "undeclared"), (Boastful(), "potential")):
        net = ia.Network("own", wall=ia.Fixed(), element=element, mass=ia.Mass(m=1.0, v=1.0))
        net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)
        book = net.simulate(3.0, rtol=1e-9).energy()
        assert list(getattr(book, kind)) == ["element"]
        assert (book.closes < 1e-5) == (kind == "undeclared")
        assert ("no energy declared" in str(book)) == (kind == "undeclared")


def two_stops() -> ia.Network:
    """A carriage between two stops on a base that shakes, rubbing on it, with a rider behind play."""
    net = ia.Network(
        "stops",
        base=ia.Position(s_ref=lambda t: 0.2 * np.sin(4 * t)),
        carriage=ia.Mass(m=1.0),
        lower=ia.HardStop(s_min=-0.15),
        upper=ia.HardStop(s_min=-0.25),
        rub=ia.StribeckFriction(f_c=1.0, f_s=1.5, v_s=0.1),
        play=ia.Backlash(k=500.0, d=1.0, eps=0.02),
        rider=ia.Mass(m=0.5),
        push=ia.Force(f=lambda t: 3 * np.sin(7 * t)),
    )
    net.connect(net.base.flange, net.lower.flange_a, net.upper.flange_b, net.rub.flange_a)
    net.connect(
        net.carriage.flange, net.lower.flange_b, net.upper.flange_a, net.rub.flange_b, net.play.flange_a
    )
    return net.connect(net.play.flange_b, net.rider.flange, net.push.flange)


@pytest.mark.parametrize("solver", ["auto", "rosenbrock", "compiled"])
@FEW
@given(
    e=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
    speeds=st.tuples(st.floats(-2, 2), st.floats(-2, 2)),
    f_c=st.floats(0.1, 5.0),
    m=st.floats(0.2, 5.0),
)
def test_the_book_closes_over_shocks_and_sticking_on_a_shaken_base(
    solver: str, e: tuple[float, float], speeds: tuple[float, float], f_c: float, m: float
) -> None:
    run = ia.simulate(
        TWO_STOPS, 3.0, begin=0.7, rtol=1e-9, solver=solver, step=1e-3,
        parameters={"lower.e": e[0], "upper.e": e[1], "rub.f_c": f_c, "rub.f_s": 1.3 * f_c, "rider.m": m},
        start={"carriage.v": speeds[0], "rider.v": speeds[1]},
    )  # fmt: skip
    book = run.energy()
    assert book.closes < 1e-4
    for path in ("lower", "upper", "rub"):
        assert np.diff(book.dissipated[path]).min() >= -1e-9 * book.turnover


TWO_STOPS = two_stops().dae()


def test_the_book_of_a_bouncing_ball() -> None:
    """Each bounce keeps e^2 of the energy: the stop takes 1 - e^2 of it, weight supplies none in the end."""
    net = ia.Network(
        "ball", floor=ia.Fixed(), stop=ia.HardStop(e=0.8), ball=ia.Mass(m=2.0, s=1.0),
        weight=ia.ConstantForce(f_constant=-20.0),
    )  # fmt: skip
    net.connect(net.floor.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)
    run = net.simulate(1.2)
    book = run.energy()
    strikes = [event.time for event in run.events if event.impulse]
    assert strikes == pytest.approx([np.sqrt(0.2), np.sqrt(0.2) * 2.6])
    assert book.dissipated["stop"][-1] == pytest.approx(20.0 * (1 - 0.8**4), rel=1e-6)
    assert book.supplied["weight"] == pytest.approx(20.0 * (1.0 - run["ball.s"]), abs=1e-6)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("lone", [True, False])
def test_a_strike_through_a_lever_a_rack_and_a_gear(solver: str, lone: bool) -> None:
    """A stop at the end of rigid joints takes 1 - e^2 of all that moves; two side by side share it."""
    net = ia.Network(
        "lever",
        wall=ia.Fixed(),
        stop=ia.HardStop(e=0.5),
        lever=ia.Lever(ratio=-2.0),
        near=ia.Mass(m=1.0, s=0.2, v=-1.0),
        far=ia.Mass(m=2.0),
        rack=ia.RackPinion(R=0.1),
        fast=rotational.Inertia(J=0.01),
        gear=rotational.IdealGear(ratio=3.0),
        slow=rotational.Inertia(J=0.1),
    )
    net.connect(net.wall.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.near.flange, net.lever.flange_a)
    net.connect(net.lever.flange_b, net.far.flange, net.rack.flange_t)
    net.connect(net.rack.flange_r, net.fast.flange, net.gear.flange_a).connect(
        net.gear.flange_b, net.slow.flange
    )
    if not lone:
        net.add(twin=ia.HardStop(e=0.5)).connect(net.twin.flange_a, net.wall.flange)
        net.connect(net.twin.flange_b, net.near.flange)
    book = net.simulate(1.0, solver=solver).energy()
    lost = sum(book.dissipated.values(), np.zeros(len(book.time)))
    assert lost[-1] == pytest.approx(0.75 * book.stored[0])
    assert book.closes < 1e-12
    assert book.undeclared == {}
    if not lone:
        assert book.dissipated["twin"][-1] == pytest.approx(book.dissipated["stop"][-1])


def test_the_book_of_a_damped_oscillator() -> None:
    """Against the closed form of the motion, m = 1 kg, k = 100 N/m, d = 2 N.s/m."""
    net = ia.Network(
        "oscillator", wall=ia.Fixed(), strut=ia.SpringDamper(k=100.0, d=2.0), mass=ia.Mass(m=1.0, s=0.1)
    )
    net.connect(net.wall.flange, net.strut.flange_a).connect(net.strut.flange_b, net.mass.flange)
    run = net.simulate(2.0, rtol=1e-10)
    t, w = run.time, np.sqrt(99.0)
    s = 0.1 * np.exp(-t) * (np.cos(w * t) + np.sin(w * t) / w)
    v = -0.1 * np.exp(-t) * 100 / w * np.sin(w * t)
    book = run.energy()
    assert book.potential["strut"] == pytest.approx(50 * s**2, abs=1e-8)
    assert book.kinetic["mass"] == pytest.approx(v**2 / 2, abs=1e-8)
    assert book.dissipated["strut"] == pytest.approx(0.5 - 50 * s**2 - v**2 / 2, abs=2e-7)
    assert run["strut.lossPower"] == pytest.approx(2 * v**2, abs=1e-7)
    assert run.unit("strut.lossPower") == "W"
    assert run["lossPower"] == pytest.approx(run["strut.lossPower"])
    assert "strut.potential" in run.names()
    assert run.to_dataframe("*.kinetic").columns.tolist() == ["mass.kinetic"]


def test_a_jump_of_a_speed_does_work_at_once() -> None:
    net = ia.Network(
        "dragged", drive=ia.Speed(), step=ia.signals.Step(height=2.0, start_time=0.5),
        inerter=ia.Inerter(b=50.0), mass=ia.Mass(m=100.0),
    )  # fmt: skip
    net.connect(net.step.y, net.drive.v_ref)
    net.connect(net.drive.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange)
    book = net.simulate(1.0).energy()
    v = 2.0 / 3
    assert book.supplied["drive"][-1] == pytest.approx(50 * (2 - v) ** 2 / 2 + 100 * v**2 / 2)
    assert book.closes < 1e-12


def test_a_position_that_jumps_on_a_damper_has_no_book() -> None:
    net = ia.Network(
        "hit",
        drive=ia.Position(),
        step=ia.signals.Step(start_time=0.5),
        damper=ia.Damper(d=5.0),
        mass=ia.Mass(m=1.0),
    )
    net.connect(net.step.y, net.drive.s_ref).connect(net.drive.flange, net.damper.flange_a)
    net.connect(net.damper.flange_b, net.mass.flange)
    with pytest.raises(ia.ModelError, match=r"Position 'drive' jumps by 1 .* give a ramp"):
        net.simulate(1.0).energy()


def test_unknown_derived_names_get_an_error() -> None:
    run = two_stops().simulate(0.1)
    with pytest.raises(ia.UnknownNameError, match=r"carriage\.lossPower"):
        run["carriage.lossPower"]


def test_what_is_derived_has_no_rates_of_its_own() -> None:
    class Rushed(ia.Damper):
        """Its loss wants the rate of its force."""

        lossPower = ia.dissipation(lambda self: ia.der(self.f))

    with pytest.raises(ia.ModelError, match=r"lossPower uses der\(f\), which no equation has"):
        ia.Network("rushed", element=Rushed(d=1.0)).dae()
