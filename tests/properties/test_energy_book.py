"""The energy book closes for every component there is, over sticking, shocks and prescribed motions."""

from functools import cache
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from inertance import rotational, thermal
from inertance.cli.catalogue import all_names, is_base
from inertance.components.language import (
    LOSS_POWER,
    MISSING,
    Domain,
    Parameter,
    Part,
    Port,
    RealInput,
    RotationalFlange,
    TranslationalFlange,
)

FEW = settings(max_examples=10, deadline=None, suppress_health_check=[HealthCheck.too_slow])
BODIES: dict[type, tuple[Any, Any, Any]] = {
    TranslationalFlange: (lambda m: ia.Mass(m=m), lambda: ia.Spring(k=3.0), ia.Force),
    RotationalFlange: (
        lambda m: rotational.Inertia(J=m),
        lambda: rotational.Spring(c=3.0),
        rotational.Torque,
    ),
}
LOSSES = ((0.0, 0.9, 0.8, 0.1, 0.2), (5.0, 0.8, 0.7, 0.2, 0.3))
CURVE = ((-0.5, -2.0), (-0.1, -0.3), (0.0, 0.0), (0.05, 0.1), (0.4, 1.0))
MAP = tuple((x, v, 3 * x + (1 + x) * v) for x in (-0.5, -0.1, 0.3) for v in (-1.0, -0.2, 0.1, 1.0))
GAS = {"p_0": 3e5, "V_0": 5e-3}
OIL = {"A_p": 3e-3, "A_r": 1e-3, "A_e": 1e-4, "A_c": 2e-4, "V_r": 2e-3, "beta": 1e8, "p_t": 100.0}
OLEO = GAS | {"A_a": 1e-3, "A_h": 1e-3, "A_o": 1e-4, "C_d": 0.9, "rho": 900.0, "n": 1.2}
STRUTS = {"p_0": 3e5, "V_0": 0.5, "A_b": 3e-3, "A_r": 1e-3, "R": 1e5}
COILED = {
    "alpha_a": 2.0,
    "alpha_b": 3.0,
    "c_0a": 0.2,
    "c_0b": 0.5,
    "eta": 5.0,
    "A": 2.0,
    "beta": 4.0,
    "gamma": 1.0,
}
VALUES: dict[str, dict[str, Any]] = {
    "DahlFriction": {"f_c": 2.0, "s_p": 0.05},
    "rotational.DahlFriction": {"tau_c": 2.0, "phi_p": 0.05},
    "LargeAngleLever": {"l_a": 10.0, "l_b": 12.0, "alpha": 0.3},
    "HardStop": {"e": 0.4, "s_min": -0.3},
    "MassWithStopAndFriction": {"s_min": -0.2, "s_max": 0.3, "f_c": 0.2, "d": 0.1},
    "VariableDamper": {"d": 1.0, "d_u": 0.5},
    "ShearThinningDamper": {"v_e": 0.1},
    "rotational.LossyGear": {
        "ratio": 2.0,
        "lossTable": LOSSES,
    },
    "BoucWen": {"beta": 0.5, "gamma": 0.3},
    "rotational.BoucWen": {"beta": 0.5, "gamma": 0.3},
    "EddyCurrentBrake": {"f_nominal": 2.0, "alpha20": 0.004, "T": 350.0},
    "rotational.EddyCurrentBrake": {"tau_nominal": 2.0, "alpha20": 0.004, "T": 350.0},
    "rotational.Gearbox": {"ratio": 2.0, "lossTable": LOSSES, "b": 0.1},
    "rotational.ElastoBacklash2": {"b": 0.1, "c": 20.0, "d": 0.5},
    "QuadraticSpeedDependentForce": {"f_nominal": -0.5, "ForceDirection": False},
    "rotational.QuadraticSpeedDependentTorque": {"tau_nominal": -0.5, "TorqueDirection": False},
    "RollingResistance": {"CrConstant": 0.5},
    "Vehicle": {"CrConstant": 0.3, "inclinationConstant": 0.1, "vWindConstant": 1.0},
    "machines.TMDI": {"b": 0.5},
    "machines.BumpStop": {"s_min": -0.1, "s_max": 0.1, "k3": 100.0},
    "PositionDependentFriction": {"f_c": 1.0, "f_1": 0.4, "f_cos": 0.3, "f_sin": 0.2, "s_rel0": 0.1},
    "rotational.PositionDependentFriction": {"tau_c": 1.0, "tau_1": 0.4, "tau_cos": 0.3, "phi_rel0": 0.1},
    "rotational.ArmGravity": {"tau_sin": 2.0, "tau_cos": 0.5},
    "AirSpring": {"A": 1e-3, "p_0": 1.3e5, "V_0": 5e-3, "n": 1.0},
    "MonotubeDamper": GAS | OIL,
    "FluidInerter": {"A_p": 1e-3, "D": 0.01, "L": 0.1, "L_p": 0.2, "D_h": 0.2, "mu": 0.1},
    "SliderCrank": {"r": 0.3, "l": 1.0, "e": 0.1},
    "BoucWenDamper": COILED | {"k_0": 0.7},
    "SpencerDamper": COILED | {"k_0": 0.7, "k_1": 0.4, "c_1a": 4.0, "c_1b": 2.0},
    "LuGreFriction": {"f_c": 1.0, "f_s": 1.5, "v_s": 0.2, "sigma_0": 30.0, "sigma_2": 0.1},
    "rotational.LuGreFriction": {"tau_c": 1.0, "tau_s": 1.5, "w_s": 0.2, "sigma_0": 30.0},
    "WireRope": {"k_1": 1.0, "k_2": 0.2, "k_3": 0.4, "f_y": 1.0, "s_y": 0.1, "n": 1.5, "share": 0.7},
    "ObliqueSprings": {"k": 2.0, "l_0": 1.2, "a": 1.0},
    "Rope": {"k": 20.0, "d": 0.5, "s_rel0": 0.1},
    "VariableInerter": {"b": 1.0, "b_u": 0.8, "T": 0.2},
    "TabulatedSpring": {"table": CURVE, "interpolation": "smooth", "s_rel0": 0.1},
    "rotational.TabulatedSpring": {"table": CURVE, "phi_rel0": -0.1},
    "TabulatedDamper": {"table": CURVE, "interpolation": "smooth"},
    "TabulatedForce": {"table": MAP, "interpolation": "smooth", "s_rel0": 0.1},
    "rotational.TabulatedForce": {"table": CURVE, "over": "position", "phi_rel0": -0.1},
    "MapSpringDamper": {"table": MAP, "interpolation": "smooth", "s_rel0": 0.1},
    "rotational.BeltDrive": {"r_a": 0.5, "r_b": 0.8, "k": 40.0, "d": 1.0, "e_0": -0.05},
    "rotational.HarmonicDrive": {"ratio": 2.0, "c": 5.0, "c3": 2.0, "d": 0.2, "e_1": 0.05},
    "rotational.DCMotor": {"k": 0.5, "R": 0.3, "L": 0.05, "u_max": 1.0, "i_max": 0.9},
    "rotational.ShuntedMotor": {"k": 1.0, "R": 0.3, "L": 0.2, "elastance": 2.0},
    "ModalRod": {"m": 1.0, "k": 20.0, "d": 0.3, "L": 0.2, "modes": 2},
    "LumpedRod": {"m": 1.0, "k": 20.0, "d": 0.3, "L": 0.2, "segments": 3},
    "rotational.ModalShaft": {"J": 1.0, "c": 20.0, "d": 0.3, "modes": 2},
    "rotational.LumpedShaft": {"J": 1.0, "c": 20.0, "d": 0.3, "segments": 3},
    "Tyre": {"R": 0.5, "F_z": 3.0, "mu": 0.9, "B": 8.0, "C": 1.6, "E": 0.3, "sigma": 0.3},
    "machines.OleoStrut": OLEO,
    "machines.InterconnectedStruts": STRUTS,
    "machines.CrankInerter": {
        "crank": ia.SliderCrank(r=0.5, l=2.0),
        "flywheel": ia.DiskFlywheel(m=1.0, R=0.4),
    },
}
STARTS = {"machines.CrankInerter": {"element.crank.phi": np.pi / 2, "element.flywheel.w": 0.0}}
GRAVE = {"Fixed", "rotational.Fixed"}  # hold what they are joined to


def value_of(field: Parameter) -> float:
    bounds = [b for b in (field.min, field.above, field.max) if b is not None]
    tried = [0.7, *(b / 2 for b in bounds), *(b + 0.7 for b in bounds), *(b - 0.7 for b in bounds)]
    return next(v for v in tried if not field.problem(v))


def made(name: str, **others: Any) -> Any:
    """Return a component with values for what must be given, and signals that move."""
    kind, values = all_names()[name], dict[str, Any]()
    for key, field in kind.fields.items():
        if field.when:
            continue
        if isinstance(field, Parameter) and field.default is MISSING:
            values[key] = value_of(field)
        elif isinstance(field, RealInput):
            values[key] = lambda t: 0.3 + 0.2 * np.sin(3 * t)
        elif isinstance(field, Part) and any(field.default.problems()):
            given = {
                k: value_of(f) for k, f in type(field.default).fields.items() if isinstance(f, Parameter)
            }
            values[key] = type(field.default)(**given)
    return kind(**values | VALUES.get(name, {}) | others)


def flanges(name: str) -> list[Port]:
    fields = all_names()[name].fields.values()
    return [f for f in fields if isinstance(f, Port) and isinstance(f.domain, Domain)]


def rig(name: str, **others: Any) -> ia.Network:
    """Return a component whose every flange carries a body on a spring that a force shakes."""
    net = ia.Network(name.replace(".", " "), element=made(name, **others))
    ground = {TranslationalFlange: ia.Fixed(), RotationalFlange: rotational.Fixed()}
    ports = flanges(name)
    for kind in {type(port) for port in ports}:
        net.add(**{f"ground_{kind.__name__.lower()}": ground[kind]})
    for k, port in enumerate(ports):
        body, spring, force = BODIES[type(port)]
        net.add(**{f"body{k}": body(1.0 + 0.3 * k), f"spring{k}": spring()})
        push = lambda t, k=k: (2.0 - k) * np.sin((2.1 + 0.7 * k) * t + k)  # noqa: E731
        net.add(**{f"push{k}": force(**{port.through: push})})
        hold = getattr(net, f"ground_{type(port).__name__.lower()}").flange
        parts = [getattr(net, f"{part}{k}") for part in ("body", "spring", "push")]
        net.connect(getattr(net.element, port.name), parts[0].flange, parts[1].flange_b, parts[2].flange)
        net.connect(parts[1].flange_a, hold)
    return net


def with_flanges() -> list[str]:
    return [
        name
        for name, kind in all_names().items()
        if not is_base(kind) and name not in GRAVE and flanges(name)
    ]


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


PASSIVE: dict[str, tuple[str, ...]] = {  # parameters with other values of which a law may give power
    "BoucWen": ("beta", "gamma"),
    "BoucWenDamper": ("beta", "gamma"),
    "PositionDependentFriction": ("f_c", "f_1", "f_2", "f_cos", "f_sin"),
    "SpencerDamper": ("beta", "gamma"),
    "Tyre": ("C",),
    "rotational.BoucWen": ("beta", "gamma"),
}
NEW = (
    "AirSpring",
    "BoucWen",
    "BoucWenDamper",
    "DahlFriction",
    "EddyCurrentBrake",
    "ElastoBacklash",
    "FluidInerter",
    "FractionalDamper",
    "InverseSpeedDependentForce",
    "LinearSpeedDependentForce",
    "LuGreFriction",
    "LumpedRod",
    "MapSpringDamper",
    "Maxwell",
    "ModalRod",
    "MonotubeDamper",
    "ObliqueSprings",
    "PositionDependentFriction",
    "RollingResistance",
    "Rope",
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
    "machines.InterconnectedStruts",
    "machines.OleoStrut",
    "rotational.Backlash",
    "rotational.BeltDrive",
    "rotational.BoucWen",
    "rotational.DCMotor",
    "rotational.EddyCurrentBrake",
    "rotational.ElastoBacklash2",
    "rotational.Gearbox",
    "rotational.HarmonicDrive",
    "rotational.InverseSpeedDependentTorque",
    "rotational.LinearSpeedDependentTorque",
    "rotational.LuGreFriction",
    "rotational.LumpedShaft",
    "rotational.ModalShaft",
    "rotational.ShuntedMotor",
    "rotational.TabulatedForce",
    "rotational.TabulatedSpring",
    "rotational.TemperatureDependentFriction",
)


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
@settings(max_examples=4, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_the_book_closes_whatever_the_numbers_and_the_start(name: str, data: st.DataObject) -> None:
    dae = assembled(name)
    scales = st.floats(0.3, 3.0)
    kept = {f"element.{key}" for key in ("peak", "T", "TRef", *PASSIVE.get(name, ()))}
    own = {p: v for p, v in dae.parameter_values.items() if p.startswith("element.") and p not in kept}
    parameters = {path: scaled(name, path, v, data.draw(scales, label=path)) for path, v in own.items()}
    bodies = [f"{path}.{v}" for path in dae.flat.instances for v in ("v", "w") if path.startswith("body")]
    start = {n: data.draw(st.floats(-2, 2), label=n) for n in bodies if n in set(dae.names())}
    if name == "Vehicle":
        start = {"body0.w": start["body0.w"]}  # one motion with the vehicle
    run = ia.simulate(dae, 2.0, begin=0.6, step=2e-3, rtol=1e-8, parameters=parameters, start=start)
    book = run.energy()
    assert book.undeclared == {}
    assert book.closes < 1e-4
    if "element.lossPower" in run:
        assert run["element.lossPower"].min() >= -1e-9 * book.turnover


@pytest.mark.parametrize("name", NEW)
def test_what_is_new_is_linearised_about_a_run(name: str) -> None:
    run = ia.simulate(assembled(name), 1.0)
    linear = ia.analysis.linearise(assembled(name), at=run, time=0.7)
    assert linear.A.shape[0] >= 2
    assert np.isfinite(linear.A).all()


LOSSY = [name for name in with_flanges() if "heatPort" in all_names()[name].fields]


@pytest.mark.parametrize("name", LOSSY)
def test_what_is_lost_heats_what_is_joined_to_it(name: str) -> None:
    net = rig(name, useHeatPort=True).add(store=thermal.HeatCapacitor(C=2.0))
    net.connect(net.element.heatPort, net.store.port)
    run = net.simulate(2.0, step=5e-3, rtol=1e-9, atol=1e-11)
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
